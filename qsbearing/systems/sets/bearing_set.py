"""The set: rows of bearings on one rigid shaft, where they stand, which way each carries, and what presses them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.above import InNotebooks
from qsbearing.model.bearing import BallBearing, BearingKind
from qsbearing.model.contact.hertz import HertzForm
from qsbearing.model.described import given_in
from qsbearing.model.effects import BallEffect, RingEffect, RingExpansion
from qsbearing.model.effects.ball_motion import MotionOfBalls
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.tilt_lever import TiltLever
from qsbearing.model.operation import Operation
from qsbearing.model.scene.elastic_seats import clearance_errors
from qsbearing.model.scene.preload import Preload
from qsbearing.model.scene.requirement import Requirement, read_requirements
from qsbearing.model.scene.scene import CHOICES, Scene, tolerance_errors
from qsbearing.model.validation import LENGTH, ErrorDetail, Field, SceneError, Sentence, raise_if_any, within
from qsbearing.systems.sets import location
from qsbearing.systems.sets.axial_growth import HOUSING, SHAFT, Growth, seat_strains
from qsbearing.systems.sets.drives import drive_errors, drive_loads
from qsbearing.systems.sets.preload_errors import preload_errors
from qsbearing.systems.sets.row import FARTHEST, OUT_OF_LINE, Direction, Row, row_errors
from qsbearing.systems.sets.shaft import (
    FloatingGroup,
    Housing,
    Shaft,
    ShaftLoad,
    Spacer,
    diameter_at,
    outside,
    section_number,
)

if TYPE_CHECKING:
    from qsbearing.systems.heat.network import Thermal

SAME_PLACE = 0.01
"""Of the ball diameter: rows that are nearer have the same balls (chosen: more than any clearance parts them)."""


@dataclass(frozen=True)
class BearingSet(InNotebooks):
    """Rows on one rigid shaft in one rigid housing. SI units and radians; numbers may be arrays that span cases.

    The shaft has five channels at its reference position, each with its load or its displacement: forces, moments and
    tilts are those of the shaft there. A row at x moves as the shaft does there; from the tilts it gets

        y + tilt_z (x - reference),      z - tilt_y (x - reference).

    Positions and the reference are those of planes of ball centres, at rest and unloaded. So a set's moments are about
    another point than those of a bearing alone, which are about the plane of its inner groove centres: `Operation`.

    A row that carries load in -x is solved as its mirror image in a plane across the shaft: the same azimuths and
    speeds, axial displacement and tilts reversed.

    A deep-groove row that no preload presses carries on either side of its middle plane (`location`).

    A preload presses the rows that carry in +x against those that carry in -x:
        rigid: the axial load of the rows of either direction together at rest and cold, before fitting; the rings are
            then held;
        mounted: their axial load at rest after fitting, at the reference temperature;
        axial_displacement: how far both directions together are pressed beyond first contact, half each; also held;
        spring: the force on the outer rings of the sprung rows, which slide together.
    It leaves the shaft's axial channel free for a load or a displacement of its own.

    With ring expansion, inner rings part as the shaft grows between them and outer ones as the housing does, both from
    the reference position; offsets and held displacements are lengths of the shaft. Spacers move all rows but the one
    of `axial_datum`.

    Raises:
        SceneError: parts that do not fit together; every error, at once.
    """

    rows: tuple[Row, ...]
    """From the first to the last along +x."""
    operation: Operation = field(default_factory=Operation)
    """Speed, and the loads or displacements of the shaft at the reference position."""
    preload: Preload | None = None
    """With which the rows press each other; None: with what their offsets and spacers make."""
    reference_position: ArrayLike | None = field(default=None, metadata=given_in("mm"))
    """Where the shaft's channels are meant [m]; None: midway between the first and the last row."""
    ball_effects: tuple[BallEffect, ...] = ()
    """Of all rows, as `Scene.ball_effects`."""
    raceway_control: RacewayControl | None = None
    """Of all rows; needed by the ball effects, and by nothing else."""
    hertz_angle: HertzAngle = HertzAngle.FREE
    hertz_form: HertzForm = HertzForm.EXACT
    tilt_lever: TiltLever = TiltLever.GROOVE_CENTRE
    orbit_radius: OrbitRadius = OrbitRadius.PITCH_CIRCLE
    ball_motion: MotionOfBalls = MotionOfBalls.OWN
    """Each ball's own: a common one is known to a bearing alone."""
    ring_effects: tuple[RingEffect, ...] = ()
    """Of rows that have none of their own."""
    readings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict, compare=False)
    """Of rows that have none of their own, as `Scene.readings`."""
    name: str = ""
    """For headings; no solve looks at it."""
    thermal: Thermal | None = None
    """With it, `qs.solve_set` finds the temperatures at which the set runs."""
    shaft: Shaft | None = None
    """Its sections, loads and supports; None: rigid, and loaded at the reference alone."""
    housing: Housing | None = None
    """Its temperature, which parts outer rings; None: that of ring expansion."""
    spacers: tuple[Spacer, ...] = ()
    floating: tuple[FloatingGroup, ...] = ()
    tolerance: float | None = None
    """As `Scene.tolerance`: `qs.solve_set` chooses the effects [-]."""
    require: tuple[Requirement, ...] = field(default=(), compare=False)
    """As `Scene.require`."""

    def __post_init__(self) -> None:
        if not isinstance(self.rows, tuple) or not self.rows or not all(isinstance(row, Row) for row in self.rows):
            raise SceneError([ErrorDetail("rows", "is not a tuple of rows", cause="Write (qs.Row(...), qs.Row(...))")])
        numbers = _number_errors(self)
        # Whether a preload has rows to press against is known only once groups name rows that there are.
        preload = [] if numbers else preload_errors(self)
        errors = [*row_errors(self.rows), *numbers, *_place_errors(self), *preload, *tolerance_errors(self)]
        errors += [*_friction_errors(self), *_motion_errors(self.ball_motion)]
        raise_if_any(errors + read_requirements(self))
        rows = (
            row if isinstance(row.carries, Direction) else replace(row, carries=location.usual(row))
            for row in self.rows
        )
        object.__setattr__(self, "rows", tuple(rows))
        raise_if_any(_temperature_errors(self) or _scene_errors(self))
        for name in CHOICES:
            object.__setattr__(self, name, getattr(self.turning_scene(0), name))

    def effects_of(self, row: Row) -> tuple[RingEffect, ...]:
        """What changes the bearing of a row of the set: its own ring effects, or the set's."""
        if id(row) not in self._effects:
            self._effects[id(row)] = self._seated_effects(row)
        return self._effects[id(row)]

    @cached_property
    def _effects(self) -> dict[int, tuple[RingEffect, ...]]:
        """What is asked for again and again, by the rows' identities."""
        return {}

    def _seated_effects(self, row: Row) -> tuple[RingEffect, ...]:
        effects = self.ring_effects if row.ring_effects is None else row.ring_effects
        if self.shaft is None and self.housing is None:
            return effects
        return tuple(self._seated(each, row) if isinstance(each, RingExpansion) else each for each in effects)

    def _seated(self, rings: RingExpansion, row: Row) -> RingExpansion:
        """Rings on this shaft and in this housing: what they leave out of their seats is the shaft's and housing's."""
        seats: dict[str, Any] = {}
        if self.shaft is not None and self.shaft.sections and rings.shaft_interference is not None:
            seats["shaft_bore_diameter"] = diameter_at(self.shaft, row.position, "inner")
            seats["shaft_material"] = self.shaft.sections[section_number(self.shaft, row.position)].material
            seats["shaft_temperature"] = self.shaft.temperature
        if self.housing is not None and rings.housing_interference is not None:
            seats |= {"housing_material": self.housing.material, "housing_temperature": self.housing.temperature}
        missing = {name: value for name, value in seats.items() if getattr(rings, name) is None and value is not None}
        return replace(rings, **missing)

    def turning_scene(self, number: int) -> Scene:
        """A row alone, turning without any load."""
        if number not in self._turning_scenes:
            turning = Operation(**self.operation.turning)  # type: ignore[arg-type]
            self._turning_scenes[number] = row_scene(self, number, turning)
        return self._turning_scenes[number]

    @cached_property
    def _turning_scenes(self) -> dict[int, Scene]:
        """Checked when the set is made, and solved later."""
        return {}

    @cached_property
    def alike(self) -> tuple[int, ...]:
        """Of each row, from 0, the first that as a bearing is the very same: solved alike, checked once."""
        known: dict[tuple[Any, ...], int] = {}
        firsts = []
        for number, row in enumerate(self.rows):
            effects = self.ring_effects if row.ring_effects is None else row.ring_effects
            effects = effects if isinstance(effects, tuple) else (effects,)
            seat: tuple[float, ...] = ()
            if self.shaft is not None and self.shaft.sections and any(isinstance(e, RingExpansion) for e in effects):
                seat = section_number(self.shaft, row.position), diameter_at(self.shaft, row.position, "inner")
            own = row.bearing, row.readings, *effects
            firsts.append(known.setdefault((seat, *map(id, own)), number))
        return tuple(firsts)

    @cached_property
    def growth(self) -> tuple[Growth, Growth]:
        """Along the shaft and in the housing."""
        return Growth(self, SHAFT), Growth(self, HOUSING)

    @cached_property
    def is_two_sided(self) -> tuple[bool, ...]:
        """Of each row, whether it stands by the plane of both grooves and carries on either side of it."""
        return location.two_sided(self)

    @cached_property
    def sleeves(self) -> tuple[tuple[int, ...], ...]:
        """Numbers of rows, from 0, whose outer rings slide along the housing together; floating groups first."""
        return location.sleeves(self)

    @cached_property
    def axial_datum(self) -> int:
        """Number, from 0, of the row that spacers leave in its place on the shaft and in the housing: the one of least
        x that carries in +x and does not float; without such a row, the first in +x, or the first of all."""
        floating = {number - 1 for group in self.floating for number in group.rows}
        floating |= {number for number, row in enumerate(self.rows) if row.carries == Direction.NONE}

        def rank(number: int) -> tuple[bool, bool, float]:
            row = self.rows[number]
            return row.sign < 0.0, number in floating or row.sprung, float(np.ravel(row.position)[0])

        return min(range(len(self.rows)), key=rank)

    @cached_property
    def reference(self) -> NDArray:
        """Where the shaft's channels are meant [m]."""
        if self.reference_position is not None:
            return np.asarray(self.reference_position, float)
        positions = np.broadcast_arrays(*(np.asarray(row.position, float) for row in self.rows))
        return np.asarray(0.5 * (np.min(positions, axis=0) + np.max(positions, axis=0)))

    @cached_property
    def shaft_loads(self) -> tuple[ShaftLoad, ...]:
        """What loads the shaft where it stands: loads, gears and belts."""
        return () if self.shaft is None else (*self.shaft.loads, *drive_loads(self.shaft, self.operation.speed))

    @property
    def groups(self) -> tuple[tuple[tuple[int, ...], Preload | None], ...]:
        """(numbers of rows, from 0, that hold each other axially through one outer body; their preload): the housing's
        rows, then each floating group's."""
        floating = [tuple(number - 1 for number in group.rows) for group in self.floating]
        away = {number for group in floating for number in group}
        fixed = tuple(number for number in range(len(self.rows)) if number not in away)
        own = [self.preload if group.preload is None else group.preload for group in self.floating]
        return ((fixed, self.preload), *zip(floating, own, strict=True))

    @property
    def is_opposed(self) -> bool:
        """Whether some rows that are pressed to one side carry in +x and some in -x."""
        return location.opposes(self, tuple(range(len(self.rows))))

    @property
    def arrangement(self) -> str:
        """DB, DF or DT for pairs; else the directions that rows carry, from the least x to the largest; of rows that
        stand by their middle planes, how they are held."""
        if any(self.is_two_sided):
            return location.in_words(self)
        if len(self.rows) == 2 and _share_place(*self.rows):
            return "four-point contact (two opposed rows at one place)"
        order = sorted(self.rows, key=lambda row: float(np.ravel(row.position)[0]))
        pair = tuple(str(row.carries) for row in order)
        names = {("+x", "-x"): "DB (back to back)", ("-x", "+x"): "DF (face to face)"}
        if len(pair) == 2:
            return names.get(pair, "DT (tandem)")
        return " ".join(pair)


def row_scene(of: BearingSet, number: int, operation: Operation) -> Scene:
    """A row alone under an operation of its own, in its own mirror image where it carries in -x."""
    row = of.rows[number]
    return Scene(
        row.bearing,
        operation,
        ring_effects=of.effects_of(row),
        readings=of.readings if row.readings is None else row.readings,
        ball_effects=of.ball_effects,
        **{name: getattr(of, name) for name in CHOICES},
    )


def offset_in_operation(of: BearingSet, number: int, offset: NDArray) -> NDArray:
    """How far a row is pressed together while the shaft is at its zero, and as warm as it is in operation [m].

    What its offset was grows as the shaft. Inner rings move with the shaft, outer ones with the housing, both from
    the reference position. A row that stands by its middle is as far from touching as its grooves then are.
    """
    row = of.rows[number]
    along, outside = (growth(row.position) for growth in of.growth)
    moved = offset * (1.0 + seat_strains(of, row)[SHAFT]) + row.sign * (along - outside)
    if of.is_two_sided[number]:
        scene = of.turning_scene(of.alike[number])
        moved = moved - (scene.operating_bearing.touching_offset - scene.axial_datum_shift)
    return np.asarray(moved)


def numbers_around(of: BearingSet) -> list[ArrayLike | None]:
    """Of shaft, housing, spacers and sleeves, which may span cases."""
    numbers = [each.temperature for each in (of.shaft, of.housing) if each is not None]
    if of.shaft is not None:
        numbers += [value for load in of.shaft_loads for value in load.values]
        numbers += [each.mass for each in of.shaft.masses]
    numbers += [getattr(row, name) for row in of.rows for name, *_ in OUT_OF_LINE]
    for each in of.spacers:
        numbers += [each.inner_length, each.outer_length, each.inner_temperature, each.outer_temperature]
    return numbers + [group.spring for group in of.floating]


def places_on_shaft(of: BearingSet) -> dict[str, float]:
    """What stands on the shaft, and its ends, in the order of their positions [m]; without what varies over cases."""
    shaft = of.shaft
    assert shaft is not None
    places: dict[str, Any] = {"begin": shaft.ends[0], "end": shaft.ends[-1]} if shaft.sections else {}
    places |= shaft.points
    parts: dict[str, Sequence[Any]] = {"row": of.rows}
    for kind, several in (parts | shaft.standing).items():
        places |= {f"{kind} {i}": part.position for i, part in enumerate(several, 1)}
    at = {name: float(position) for name, position in places.items() if np.ndim(position) == 0}
    return dict(sorted(at.items(), key=lambda item: item[1]))


def _friction_errors(of: BearingSet) -> list[ErrorDetail]:
    """Of a law of friction, which needs rows that neither tilt nor share balls with others."""
    if of.raceway_control != RacewayControl.FRICTION:
        return []
    cause = "Choose a hypothesis, such as outer; a bearing of the set alone is solved with friction"
    return [ErrorDetail("raceway_control", "moves no balls of a set", str(of.raceway_control), cause=cause)]


def _number_errors(of: BearingSet) -> list[ErrorDetail]:
    """Errors of spacers and floating groups that name rows."""
    errors: list[ErrorDetail] = []
    taken: set[int] = set()
    cause = f"Rows count from 1 to {len(of.rows)}"
    named: dict[str, tuple[Spacer | FloatingGroup, ...]] = {"spacer": of.spacers, "floating": of.floating}
    for kind, parts in named.items():
        for number, part in enumerate(parts, 1):
            path, rows = f"{kind} {number}.rows", tuple(part.rows)
            known = all(isinstance(row, int) and 1 <= row <= len(of.rows) for row in rows)
            if not known or len(set(rows)) < len(rows) or not rows or (kind == "spacer" and len(rows) != 2):
                errors.append(ErrorDetail(path, "are not valid numbers of rows", list(rows), cause=cause))
            elif kind == "floating" and (taken & set(rows) or any(of.rows[row - 1].sprung for row in rows)):
                errors.append(ErrorDetail(path, "name a row that is sprung, or in another group", list(rows)))
            taken |= set(rows) if kind == "floating" else set()
    return errors


def _place_errors(of: BearingSet) -> list[ErrorDetail]:
    errors = []
    if of.reference_position is not None:
        errors += within("reference_position", of.reference_position, LENGTH, -FARTHEST, FARTHEST)
    if of.shaft is not None and not isinstance(of.shaft, Shaft):
        errors.append(ErrorDetail("shaft", "is not a shaft", of.shaft, cause="Write qs.Shaft(...)"))
    elif of.shaft is not None:
        errors += outside(of.shaft, [(f"row {number}", row.position) for number, row in enumerate(of.rows, 1)])
        errors += drive_errors(of.shaft, of.operation.speed)
        if of.reference_position is not None and not errors:
            errors += outside(of.shaft, [("reference", of.reference_position)])
    for number, row in enumerate(of.rows, 1):
        for before, other in enumerate(of.rows[: number - 1], 1):
            if _share_place(row, other):
                errors += _shared_place_errors(of, number, before)
    return errors


def _share_place(row: Row, other: Row) -> bool:
    """Whether two rows are so near each other that they can only have the same balls."""
    if np.ndim(row.position) or np.ndim(other.position) or not isinstance(row.bearing, BallBearing):
        return False
    apart = abs(float(row.position) - float(other.position))  # type: ignore[arg-type]
    return apart < SAME_PLACE * float(np.min(row.bearing.ball_diameter))


def _shared_place_errors(of: BearingSet, number: int, before: int) -> list[ErrorDetail]:
    """Two rows at one place are a four-point bearing, whose balls each row has for itself: right at rest only."""
    row, other = of.rows[number - 1], of.rows[before - 1]
    effects = [effect.name for each in (row, other) for effect in each.ring_effects or of.ring_effects]
    turns = any(np.any(each) for each in (of.operation.speed, of.operation.outer_speed) if each is not None)
    beyond = {"are ball effects": of.ball_effects, "is a speed": turns, "are elastic rings": "elastic_rings" in effects}
    problem = f"is the position of row {before} too"
    is_deep = BearingKind.DEEP_GROOVE in (row.bearing.kind, other.bearing.kind)
    if is_deep or {row.carries, other.carries} != {Direction.PLUS, Direction.MINUS}:
        cause = (
            "Give the position of the balls of each row along the shaft. Only two angular-contact rows that carry "
            "opposite directions may share one: they are a four-point bearing at rest"
        )
    elif given := [what for what, there in beyond.items() if there]:
        problem += f", and there {given[0]}: two opposed rows at one place are a four-point bearing at rest only"
        cause = (
            "Four-point bearings are solved at rest only, without ball effects and elastic rings: set speed_rpm = 0. "
            'Lives in revolutions need no speed. At speed, solve one bearing of kind = "four_point" alone'
        )
    else:
        return []
    return [ErrorDetail(f"row {number}.position", problem, float(row.position), LENGTH, cause=cause)]  # type: ignore[arg-type]


def _temperature_errors(of: BearingSet) -> list[ErrorDetail]:
    """Errors of a temperature that rings and body both have."""
    errors = []
    for number, row in enumerate(of.rows, 1):
        for rings in of.ring_effects if row.ring_effects is None else row.ring_effects:
            for body in ("shaft", "housing"):
                own, its = getattr(rings, f"{body}_temperature", None), getattr(getattr(of, body), "temperature", None)
                if own is not None and its is not None and np.any(np.asarray(own) != np.asarray(its)):
                    there = Field(f"{body}.temperature")
                    cause = Sentence("Give {there} only: the rows take it from there", there=there)
                    path = f"row {number}.ring_expansion.{body}_temperature"
                    errors.append(ErrorDetail(path, Sentence("differs from {there}", there=there), cause=cause))
    return errors


def _motion_errors(motion: MotionOfBalls) -> list[ErrorDetail]:
    """Of a common motion, which the balance of a set does not look for."""
    if motion != MotionOfBalls.COMMON:
        return []
    cause = "Leave it out: the balls of a set have the motion of their azimuths"
    return [ErrorDetail("ball_motion", "is known of single bearings alone", str(motion), cause=cause)]


def _scene_errors(of: BearingSet) -> list[ErrorDetail]:
    """What is wrong with the rows as bearings; what all have alike is said once, without a row."""
    of_rows: list[list[ErrorDetail]] = []
    for number, same in enumerate(of.alike):
        if same < number:
            of_rows.append(of_rows[same])
            continue
        try:
            row = of.turning_scene(number)
            of_rows.append(clearance_errors(row.elastic_rings, row.ring_expansion, row.bearing, row.operation))
        except SceneError as error:
            of_rows.append(list(error.errors))
    common = [each for each in of_rows[0] if all(str(each) in map(str, others) for others in of_rows)]
    said = set(map(str, common))
    own = [
        replace(each, field=f"row {number}.{each.field}")
        for number, errors in enumerate(of_rows, 1)
        for each in errors
        if str(each) not in said
    ]
    return common + own
