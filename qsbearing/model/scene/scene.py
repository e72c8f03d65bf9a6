"""The scene: a bearing, its operation, and the effects and choices that it calls for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.above import InNotebooks
from qsbearing.model.accuracy import COARSEST, FINEST
from qsbearing.model.bearing import BallBearing
from qsbearing.model.bearing_errors import clash_errors, shapes_of
from qsbearing.model.contact.hertz import HertzForm
from qsbearing.model.described import choices_of, one_of
from qsbearing.model.effects import (
    BallDiameterDeviations,
    BallEffect,
    BallExpansion,
    CentrifugalForce,
    ElasticRings,
    GyroscopicMoment,
    RingEffect,
    RingExpansion,
    SeatsOutOfRound,
    as_fitted,
    as_made,
    types_in,
)
from qsbearing.model.effects.ball_motion import MotionOfBalls, motion_errors
from qsbearing.model.effects.body_temperature import BodyTemperature, assumed_of_balls, body_temperatures
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.tilt_lever import TiltLever
from qsbearing.model.effects.traction import Traction
from qsbearing.model.operation import STRAIGHT, Operation
from qsbearing.model.scene.arched_rings import arched_errors
from qsbearing.model.scene.elastic_seats import seat_errors
from qsbearing.model.scene.moved_by_friction import friction_errors
from qsbearing.model.scene.preload import NOT_A_PRELOAD, Preload, axial_channel_errors
from qsbearing.model.scene.requirement import Requirement, read_requirements
from qsbearing.model.units import mm, rpm
from qsbearing.model.validation import (
    RATIO,
    SPEED,
    ErrorDetail,
    SceneError,
    Sentence,
    all_where,
    choose,
    raise_if_any,
    unit_mistake,
    within,
)

SPEED_PARAMETER_MAX = 1.0e7
"""dm n [mm rpm]; the fastest bearings ever run reached about 3.5e6."""


@dataclass(frozen=True)
class Scene(InNotebooks):
    """All the input of a solve. An effect that is not named here is not simulated.

    Raises:
        SceneError: parts that do not fit together; every error, at once.
    """

    bearing: BallBearing
    """Whose balls and rings are solved for."""
    operation: Operation = field(default_factory=Operation)
    """Speeds, and of each channel its load or its displacement."""
    ball_effects: tuple[BallEffect, ...] = ()
    """Centrifugal force, gyroscopic moment: what a ball's motion asks of its contacts."""
    raceway_control: RacewayControl | None = field(default=None, metadata=one_of(RacewayControl))
    """Needed by the ball effects, and by nothing else."""
    hertz_angle: HertzAngle = field(default=HertzAngle.FREE, metadata=one_of(HertzAngle))
    hertz_form: HertzForm = field(default=HertzForm.EXACT, metadata=one_of(HertzForm))
    tilt_lever: TiltLever = field(default=TiltLever.GROOVE_CENTRE, metadata=one_of(TiltLever))
    ring_effects: tuple[RingEffect, ...] = ()
    """What changes the bearing before it is loaded."""
    preload: Preload | None = None
    """In place of an axial load or displacement of the operation."""
    readings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict, compare=False)
    """What is to be read off the solution: by name, with arguments (`qsbearing.readings.take_asked`). No solve looks
    at it."""
    tolerance: float | None = None
    """With one, `solve` chooses the effects, to this relative error of results [-]: effects = "auto" of a file."""
    orbit_radius: OrbitRadius = field(default=OrbitRadius.PITCH_CIRCLE, metadata=one_of(OrbitRadius))
    """Of the balls, for their motion; only the ball effects ask for it."""
    ball_motion: MotionOfBalls = field(default=MotionOfBalls.OWN, metadata=one_of(MotionOfBalls))
    """Whether each ball has the axis and orbit of its azimuth, or all have the mean; likewise."""
    thermal: Any = None
    """A `qsbearing.Thermal`; with it `qs.solve` finds the temperatures at which the bearing runs."""
    traction: Traction | None = None
    """With raceway_control = "friction", the law of friction; None: `Traction()`, whose coefficient is assumed."""
    require: tuple[Requirement, ...] = field(default=(), compare=False)
    """What results must keep; a table as that of a file, {"inner.max_pressure_MPa": "<= 1700"}, becomes this. No solve
    looks at it."""

    def __post_init__(self) -> None:
        errors = []
        for name, choices in CHOICES.items():
            if getattr(self, name) is not None or name != "raceway_control":
                choice, wrong = choose(name, getattr(self, name), choices)
                object.__setattr__(self, name, choice)
                errors += wrong
        errors += read_requirements(self)
        errors += effect_errors(self.ball_effects, self.raceway_control, self.orbit_radius)
        errors += motion_errors(self)
        if self.preload is not None:
            errors += _preload_errors(self.preload, self.operation)
        clashes = clash_errors(shapes_of(self._parts()))
        raise_if_any([*errors, *clashes] if clashes else [])  # what follows takes them together
        wrong = ring_effect_errors(self.ring_effects, self.bearing)
        if not wrong and self.elastic_rings is not None and self.ring_expansion is not None:
            wrong = seat_errors(self.elastic_rings, self.ring_expansion, self.bearing)
        errors += wrong
        errors += tolerance_errors(self)
        if self.traction is not None or self.raceway_control is RacewayControl.FRICTION:
            errors += friction_errors(self)
        if self.bearing.is_arched:
            errors += arched_errors(self)
        raise_if_any(errors + speed_errors(self.bearing, self.operation))
        if self.ring_effects:
            self.operating_bearing  # noqa: B018 - made once here, where what is no bearing can still be refused

    def _parts(self) -> list[tuple[str, Any]]:
        """The objects that hold the scene's numbers, by the paths that errors name."""
        effects = [each for slot in (self.ball_effects, self.ring_effects) if isinstance(slot, tuple) for each in slot]
        own = [("bearing", self.bearing), ("operation", self.operation), ("preload", self.preload)]
        own += [] if self.traction is None else [(Traction.name, self.traction)]
        return own + [(getattr(effect, "name", ""), effect) for effect in effects]

    @cached_property
    def operating_bearing(self) -> BallBearing:
        """The bearing as its ring effects leave it: hot, fitted and turning, before loads act; `bearing` without any.

        Raises:
            SceneError: they leave no bearing.
        """
        bearing = self.bearing
        for effect in _with_balls(self.ring_effects):
            try:
                bearing = effect.reshape(bearing, self.operation)
            except SceneError as error:
                why, where = Sentence("{reasons}", reasons=error.errors), all_where(error.errors)
                raise SceneError([ErrorDetail(effect.name, "leaves no bearing", where=where, detail=why)]) from None
        return bearing

    @property
    def axial_datum_shift(self) -> NDArray:
        """By how much further in +x the inner ring touches at the free contact angle than at rest and cold [m],
        over the cases that it depends on.

        Displacements count from where it does so at rest and cold; heat moves the groove centres axially in their
        rings, fits and rotation do not.
        """
        moved = 0.0 if self.ring_expansion is None else sum(self.ring_expansion.axial_growth(self.bearing))
        return np.asarray(self.operating_bearing.touching_offset - self.bearing.touching_offset - moved)

    @property
    def is_reshaped(self) -> bool:
        """Whether ring effects change the bearing's own lengths."""
        return self.operating_bearing is not self.bearing

    @property
    def as_preloaded(self) -> Scene | None:
        """The bearing at rest and cold under its preload alone, in the state in which that is given.

        None without a preload, and with a spring, whose force says all that there is to know.
        """
        preload = self.preload
        if preload is None or preload.kind == "spring":
            return None
        load = preload.mounted if preload.is_given_mounted else preload.rigid
        return self.at_rest(preload.is_given_mounted, axial_load=load, axial_displacement=preload.axial_displacement)

    def at_rest(self, fitted: bool, **axial: Any) -> Scene:
        """The bearing at rest and cold, before or after fitting, straight and centred, by the same Hertz contacts."""
        choices = {name: getattr(self, name) for name in CHOICES_OF_CONTACT}
        effects = (as_fitted if fitted else as_made)(self.ring_effects)
        return Scene(self.bearing, Operation(**axial, **STRAIGHT), **choices, ring_effects=effects)

    @property
    def ring_expansion(self) -> RingExpansion | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ring_effects if isinstance(effect, RingExpansion)), None)

    @property
    def temperatures(self) -> dict[str, BodyTemperature]:
        """Of shaft, rings, housing and balls, and where each comes from; empty where the scene gives none."""
        return body_temperatures(self.ring_effects)

    @property
    def elastic_rings(self) -> ElasticRings | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ring_effects if isinstance(effect, ElasticRings)), None)

    @property
    def ball_diameter_deviations(self) -> BallDiameterDeviations | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ring_effects if isinstance(effect, BallDiameterDeviations)), None)

    @property
    def seats_out_of_round(self) -> SeatsOutOfRound | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ring_effects if isinstance(effect, SeatsOutOfRound)), None)

    @property
    def centrifugal_force(self) -> CentrifugalForce | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ball_effects if isinstance(effect, CentrifugalForce)), None)

    @property
    def gyroscopic_moment(self) -> GyroscopicMoment | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ball_effects if isinstance(effect, GyroscopicMoment)), None)


CHOICES: dict[str, Any] = dict(choices_of(Scene))
"""The fields of a scene that choose one of several; each may be given as a member or as its word."""
CHOICES_OF_CONTACT = ("hertz_angle", "hertz_form", "tilt_lever")
"""Those that a bearing at rest has too."""


def tolerance_errors(of: Any) -> list[ErrorDetail]:
    """Errors of the tolerance to which effects of a scene or set are chosen."""
    if of.tolerance is None:
        return []
    errors = within("tolerance", of.tolerance, RATIO, FINEST, COARSEST)
    if of.thermal is None:
        return errors
    cause = "Name the effects instead: with a heat balance they are not chosen automatically"
    return [ErrorDetail("tolerance", "is given together with a heat balance", cause=cause), *errors]


def _preload_errors(preload: object, operation: Operation) -> list[ErrorDetail]:
    if isinstance(preload, Preload):
        return axial_channel_errors(operation)
    return [ErrorDetail("preload", "is not a preload", preload, cause=NOT_A_PRELOAD)]


def effect_errors(
    ball_effects: tuple[BallEffect, ...],
    raceway_control: RacewayControl | None,
    orbit_radius: OrbitRadius = OrbitRadius.PITCH_CIRCLE,
) -> list[ErrorDetail]:
    """Errors of what is asked for, whatever the bearing."""
    if not _are_all(ball_effects, "ball_effects"):
        cause = "Write (qs.CentrifugalForce(), qs.GyroscopicMoment()): a tuple of effects, each with its brackets"
        return [ErrorDetail("ball_effects", "is not a tuple of ball effects", ball_effects, cause=cause)]
    errors = []
    names = [effect.name for effect in ball_effects]
    if len(set(names)) < len(names):
        errors.append(ErrorDetail("ball_effects", "names an effect twice", names))
    if names and raceway_control is None:
        need = f"{names[0]} needs" if len(names) == 1 else f"{' and '.join(names)} need"
        detail = f"{need} the balls' motion, which raceway control sets"
        *others, last = RacewayControl
        cause = f"Give raceway_control: {', '.join(others)} or {last}"
        errors.append(ErrorDetail("raceway_control", "missing", cause=cause, detail=detail))
    if raceway_control is not None and not names:
        problem = "is given, but no ball effect needs it"
        cause = "Leave it out, or ask for centrifugal_force or gyroscopic_moment"
        errors.append(ErrorDetail("raceway_control", problem, str(raceway_control), cause=cause))
    if orbit_radius == OrbitRadius.DISPLACED and not names:
        problem = "is given, but no ball effect depends on the balls' orbit"
        cause = "Leave it out, or ask for centrifugal_force or gyroscopic_moment"
        errors.append(ErrorDetail("orbit_radius", problem, str(orbit_radius), cause=cause))
    return errors


def _are_all(effects: object, slot: str) -> bool:
    """Whether this is a tuple of effects of the list."""
    return isinstance(effects, tuple) and all(isinstance(effect, tuple(types_in(slot).values())) for effect in effects)


def ring_effect_errors(ring_effects: tuple[RingEffect, ...], bearing: BallBearing) -> list[ErrorDetail]:
    """Errors of what is asked to change the bearing."""
    if not _are_all(ring_effects, "ring_effects"):
        cause = "Write (qs.RingExpansion(...), qs.BallExpansion(...)): a tuple of effects"
        return [ErrorDetail("ring_effects", "is not a tuple of ring effects", ring_effects, cause=cause)]
    names = [effect.name for effect in ring_effects]
    errors = [error for effect in _with_balls(ring_effects) for error in effect.errors(bearing)]
    if len(set(names)) < len(names):
        errors.append(ErrorDetail("ring_effects", "names an effect twice", names))
    return errors


def _with_balls(ring_effects: tuple[RingEffect, ...]) -> tuple[RingEffect, ...]:
    """These, and the expansion of balls that are assumed to be as warm as their rings."""
    known = assumed_of_balls(ring_effects)
    return ring_effects if known is None else (*ring_effects, BallExpansion(*known))


def speed_errors(bearing: BallBearing, operation: Operation) -> list[ErrorDetail]:
    """Errors of speeds that no bearing of this size survives."""
    errors = []
    for name, speed in (("operation.speed", operation.speed), ("operation.outer_speed", operation.outer_speed)):
        pitch, value = np.broadcast_arrays(
            np.asarray(bearing.pitch_diameter, float), np.asarray(0.0 if speed is None else speed, float)
        )
        parameter = pitch / mm * np.abs(value) / rpm
        too_fast = parameter > SPEED_PARAMETER_MAX
        if too_fast.any():
            worst = parameter.argmax()
            most = float(SPEED_PARAMETER_MAX * rpm * mm / pitch.flat[worst])
            given = float(value.flat[worst])
            fast = parameter.flat[worst]
            detail = f"dm n = {fast:.3g} mm rpm is beyond any bearing ({SPEED_PARAMETER_MAX:g})"
            cause = unit_mistake(given, SPEED, -most, most)
            errors.append(ErrorDetail(name, "is too fast", given, SPEED, (-most, most), cause, too_fast, detail))
    return errors
