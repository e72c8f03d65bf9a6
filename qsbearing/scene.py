"""The scene: a bearing, its operation, and the effects and choices that it calls for."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from qsbearing.bearing import BallBearing
from qsbearing.effects import BallEffect, CentrifugalForce, GyroscopicMoment
from qsbearing.faults import MM, RPM, SPEED, Fault, choose, likely_slip, raise_if_any
from qsbearing.hertz import HertzForm
from qsbearing.operation import Operation
from qsbearing.raceway_control import RacewayControl

SPEED_PARAMETER_MAX = 1.0e7
"""dm n [mm rpm]; the fastest bearings ever run reached about 3.5e6."""


class HertzAngle(StrEnum):
    """The contact angle at which a raceway's curvature in the rolling direction is taken."""

    FREE = "free"
    """The free contact angle: the contact stiffnesses are constants of the bearing."""
    ACTUAL = "actual"
    """Each contact's own angle: finer and dearer; it moves B218's angles by about 0.004 degrees."""
    ZERO = "zero"
    """Angle zero, as ISO/TS 16281 takes it."""


class TiltLever(StrEnum):
    """The radius at which a tilt moves the inner groove centres axially, and axial contact forces make moments."""

    GROOVE_CENTRE = "groove_centre"
    """Ri, the circle of inner groove centres: exact for a rigid rotation (19.3)."""
    PITCH_CIRCLE = "pitch_circle"
    """dm/2, as ISO/TS 16281 takes it."""


CHOICES: dict[str, type[StrEnum]] = {
    "raceway_control": RacewayControl,
    "hertz_angle": HertzAngle,
    "hertz_form": HertzForm,
    "tilt_lever": TiltLever,
}
"""The fields of a scene that choose one of several; each may be given as a member or as its word."""


@dataclass(frozen=True)
class Scene:
    """All that a solve needs. An effect that is not named here is not evaluated.

    Raises:
        SceneError: parts that do not fit together; all faults at once.
    """

    bearing: BallBearing
    operation: Operation = field(default_factory=Operation)
    ball_effects: tuple[BallEffect, ...] = ()
    raceway_control: RacewayControl | None = None
    """Needed by the ball effects, and by nothing else."""
    hertz_angle: HertzAngle = HertzAngle.FREE
    hertz_form: HertzForm = HertzForm.EXACT
    tilt_lever: TiltLever = TiltLever.GROOVE_CENTRE

    def __post_init__(self) -> None:
        faults = []
        for name, choices in CHOICES.items():
            if getattr(self, name) is not None or name != "raceway_control":
                choice, wrong = choose(name, getattr(self, name), choices)
                object.__setattr__(self, name, choice)
                faults += wrong
        raise_if_any(faults + scene_faults(self))

    @property
    def centrifugal_force(self) -> CentrifugalForce | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ball_effects if isinstance(effect, CentrifugalForce)), None)

    @property
    def gyroscopic_moment(self) -> GyroscopicMoment | None:
        """The effect, where the scene names it."""
        return next((effect for effect in self.ball_effects if isinstance(effect, GyroscopicMoment)), None)


def scene_faults(scene: Scene) -> list[Fault]:
    """Faults of the parts together; each part has checked itself."""
    return [
        *effect_faults(scene.ball_effects, scene.raceway_control),
        *speed_faults(scene.bearing, scene.operation),
    ]


def effect_faults(ball_effects: tuple[BallEffect, ...], raceway_control: RacewayControl | None) -> list[Fault]:
    """Faults of what is asked for, whatever the bearing."""
    if not isinstance(ball_effects, tuple) or not all(isinstance(effect, BallEffect) for effect in ball_effects):
        cause = "Write (qs.CentrifugalForce(), qs.GyroscopicMoment()): a tuple of effects, each with its brackets"
        return [Fault("ball_effects", "is not a tuple of ball effects", value=ball_effects, cause=cause)]
    faults = []
    names = [effect.name for effect in ball_effects]
    if len(set(names)) < len(names):
        faults.append(Fault("ball_effects", "names an effect twice", value=names))
    if names and raceway_control is None:
        need = f"{names[0]} needs" if len(names) == 1 else f"{' and '.join(names)} need"
        faults.append(
            Fault(
                "raceway_control",
                f"missing: {need} the balls' motion, which raceway control sets",
                cause="State raceway_control: outer, inner or per_ball",
            )
        )
    if raceway_control is not None and not names:
        faults.append(
            Fault(
                "raceway_control",
                "is given, but no ball effect needs it",
                value=str(raceway_control),
                cause="Leave it out, or ask for centrifugal_force or gyroscopic_moment",
            )
        )
    return faults


def speed_faults(bearing: BallBearing, operation: Operation) -> list[Fault]:
    """Faults of speeds that no bearing of this size survives."""
    faults = []
    pitch, speed, outer = np.broadcast_arrays(
        np.asarray(bearing.pitch_diameter, float),
        np.asarray(operation.speed, float),
        np.asarray(0.0 if operation.outer_speed is None else operation.outer_speed, float),
    )
    for field_name, value in (("operation.speed", speed), ("operation.outer_speed", outer)):
        parameter = pitch / MM * np.abs(value) / RPM
        if (parameter > SPEED_PARAMETER_MAX).any():
            worst = parameter.argmax()
            most = float(SPEED_PARAMETER_MAX * RPM * MM / pitch.flat[worst])
            found = float(value.flat[worst])
            faults.append(
                Fault(
                    field_name,
                    f"is too fast: dm n = {parameter.flat[worst]:.3g} mm rpm is beyond any bearing "
                    f"({SPEED_PARAMETER_MAX:g})",
                    found,
                    SPEED,
                    (-most, most),
                    likely_slip(found, SPEED, -most, most),
                )
            )
    return faults
