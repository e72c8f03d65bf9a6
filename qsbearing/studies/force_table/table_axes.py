"""The axes of a table: which displacements and speeds it spans, and from where to where.

A channel that is not among them stays as its scene has it: held in its place, or free under its load.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import ceil, floor, log10, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.keys import OF_OPERATION, Key
from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import ErrorDetail, alike, question, raise_if_any
from qsbearing.studies.chooser.choose import solve

SPEED = "speed"
FIELDS = (SPEED, *(each.displacement for each in CHANNELS))
"""What may be an axis, in the order of a table's axes."""
REACH = 2.0
"""An axis without a range goes to so many times the displacement under the scene's load (chosen: 2.8 times the load,
by Hertz)."""
BEHIND = 0.25
"""And to this part of it on the side where an angular-contact bearing comes off its load (chosen)."""

Range = tuple[float, float]


@dataclass(frozen=True)
class TableAxis:
    """A field of the operation and its range, SI."""

    field: str
    low: float
    high: float
    is_assumed: bool
    """Whether nobody has given the range."""

    @property
    def key(self) -> Key:
        """As a file spells it, and its unit."""
        return OF_OPERATION[self.field]


def held(axes: list[TableAxis]) -> dict[str, float]:
    """Those of one value, which is no axis: where the table holds them."""
    return {each.field: each.low for each in axes if each.low == each.high}


def over_errors(over: Mapping[str, Any]) -> list[ErrorDetail]:
    """What is wrong with the axes that are named, whatever the scene."""
    errors = []
    for field, given in over.items():
        where = f"over.{field}"
        if field not in FIELDS:
            cause = question(alike(field, FIELDS)) or f"One of: {', '.join(FIELDS)}"
            errors.append(ErrorDetail(where, "is no axis of a table", cause=cause))
        elif given is not None:
            errors += _range_errors(where, OF_OPERATION[field], given)
    return errors


def _range_errors(where: str, key: Key, given: Any) -> list[ErrorDetail]:
    try:
        low, high = (float(each) for each in given)
    except (TypeError, ValueError):
        return [ErrorDetail(where, "is no range", cause="Give its two ends, the lower one first; or None")]
    for end in (low, high):
        if key.range is not None and not key.range[0] <= end <= key.range[1]:
            return [ErrorDetail(where, "is out of range", end, key.quantity, key.range)]
    if high < low:
        return [ErrorDetail(where, "is reversed: it ends below its start", low, key.quantity, cause="Swap the two")]
    return []


def axes_of(scene: Scene, over: Mapping[str, Range | None], solution: Solution) -> list[TableAxis]:
    """The axes of a scene's table, in the order of `FIELDS`.

    Args:
        over: those that are named, each with its range or None; without any channel, those that carry a load.
        solution: of the scene, from which ranges follow that are not given.

    Raises:
        SceneError: ranges that nothing tells.
    """
    named = {field: over[field] for field in FIELDS if field in over}
    if SPEED not in named and _turns(scene) and float(np.asarray(scene.operation.speed)) != 0.0:
        named[SPEED] = None
    if not named.keys() - {SPEED}:
        named |= dict.fromkeys(loaded(scene))
    reaches = _Reaches(scene, solution)
    raise_if_any([reaches.error(field) for field, given in named.items() if given is None and not reaches.tells(field)])
    return [_axis(field, named[field], reaches) for field in FIELDS if field in named]


def _axis(field: str, given: Range | None, reaches: _Reaches) -> TableAxis:
    low, high = reaches.of(field) if given is None else map(float, given)
    return TableAxis(field, low, high, given is None)


def _turns(scene: Scene) -> bool:
    """Whether anything of the scene depends on its speed."""
    return bool(scene.ball_effects) or scene.ring_expansion is not None


def loaded(scene: Scene) -> list[str]:
    """The displacements of the channels that carry a load, or are held out of their place."""
    of = scene.operation
    some = [
        each.displacement
        for each in CHANNELS
        if any(np.any(value) for name in (each.load, each.displacement) if (value := getattr(of, name)) is not None)
    ]
    is_pressed = scene.preload is not None and CHANNELS[0].displacement not in some
    return [CHANNELS[0].displacement] * is_pressed + some


def at_points(scene: Scene, points: Mapping[str, NDArray]) -> Scene:
    """The scene with these displacements and speeds in place of its own."""
    given: dict[str, Any] = dict(points)
    given |= {each.load: None for each in CHANNELS if each.displacement in points}
    preload = None if CHANNELS[0].displacement in points else scene.preload
    # Both at once: a preload and an axial displacement exclude each other.
    return replace(scene, preload=preload, operation=replace(scene.operation, **given))


class _Reaches:
    """How far the load of a scene moves its ring, at its speed and at rest."""

    def __init__(self, scene: Scene, solution: Solution) -> None:
        self.scene, self.solution = scene, solution
        self.alpha = float(np.asarray(scene.bearing.free_contact_angle))
        self.radius = 0.5 * float(np.asarray(scene.bearing.pitch_diameter))

    def tells(self, field: str) -> bool:
        """Whether a range of this field follows."""
        return field == SPEED or bool(self.solution.converged and np.any(self._moved))

    def error(self, field: str) -> ErrorDetail:
        """Where none does."""
        why = "no load moves its ring" if self.solution.converged else "its load has no equilibrium"
        return ErrorDetail(
            f"over.{field}", "has no range, and the scene tells none", cause="Give the range", detail=why
        )

    def of(self, field: str) -> Range:
        """Its range."""
        if field == SPEED:
            speed = float(np.asarray(self.scene.operation.speed))
            return min(0.0, speed), max(0.0, speed)
        number = next(i for i, each in enumerate(CHANNELS) if each.displacement == field)
        if number == 0:
            middle, reach = self._middle, self._axial
            back = reach if middle is not None else BEHIND * reach
            return _rounded(field, (middle or 0.0) - back), _rounded(field, (middle or 0.0) + reach)
        reach = self._radial if number < 3 else self._tilt
        end = _rounded(field, reach)
        return -end, end

    @property
    def _moved(self) -> NDArray:
        """Of both speeds the larger displacement; axially from the middle of a bearing that has one."""
        if not hasattr(self, "_known"):
            speeds = replace(self.scene.operation, speed=0.0) if _turns(self.scene) else self.scene.operation
            at_rest = solve(replace(self.scene, operation=speeds))
            both = [each for each in (self.solution, at_rest) if each.converged]
            moved = np.abs([each.displacement - (self._middle or 0.0) * (np.arange(5) == 0) for each in both])
            self._known = np.max(moved, axis=0) if both else np.zeros(5)
        return self._known

    @property
    def _middle(self) -> float | None:
        """Where the grooves of both rings lie in one plane, as displacements count."""
        from_middle = self.solution.axial_from_middle
        return None if from_middle is None else float(self.solution.displacement[0] - from_middle)

    @property
    def _axial(self) -> float:
        """Where nothing moves the ring along its axis, as far as it is moved across."""
        moved = self._moved
        return REACH * float(moved[0] or max(moved[1:3]) or max(moved[3:]) * self.radius)

    @property
    def _radial(self) -> float:
        """Where nothing moves it across, what presses a contact as much as the axial motion does."""
        return REACH * float(max(self._moved[1:3])) or self._axial * tan(self.alpha)

    @property
    def _tilt(self) -> float:
        """Where nothing tilts it, what moves the pitch circle along the axis as far."""
        return REACH * float(max(self._moved[3:])) or self._axial / self.radius


def _rounded(field: str, value: float) -> float:
    """Away from zero, to two digits in the unit of files."""
    if value == 0.0:
        return 0.0
    key = OF_OPERATION[field]
    size = key.in_file(abs(value))
    step = 10.0 ** (floor(log10(size)) - 1)
    return float(np.sign(value)) * key.si(float(f"{ceil(size / step - 1e-9) * step:.12g}"))
