"""The results that most readers look for first: pressures, angles, displacement, stiffness, friction, life."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Table
from qsbearing.documents.numbers import that_matter
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.groups import (
    ANGLE,
    CONTACT_LOAD,
    CONTACTS,
    FRICTION,
    MAX_PRESSURE,
    OF_MIDDLE,
    OF_PRELOAD,
)
from qsbearing.model.solution.result_keys import (
    DISPLACEMENT,
    LOAD,
    STIFFNESS,
    Group,
    Place,
    Result,
    printed_unit,
)
from qsbearing.model.solution.solution import Solution
from qsbearing.readings import rating_life
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import capital
from qsbearing.results.report import freedom
from qsbearing.systems.sets.set_groups import AXIAL_LOAD, PRELOAD, SYSTEM
from qsbearing.systems.sets.set_solution import SetSolution

OF_EACH_ROW = (
    ("largest pressure\nMPa", MAX_PRESSURE),
    ("largest ball load\nN", CONTACT_LOAD),
    ("friction\ncoefficient", FRICTION),
)
"""Of each row, its largest of each raceway."""
FROM_MIDDLE = Place(OF_MIDDLE, OF_MIDDLE.results[0])
LOAD_OF_ROW = Place(AXIAL_LOAD, AXIAL_LOAD.results[0])
MOUNTED_OF_ROW = Place(PRELOAD, next(each for each in PRELOAD.results if each.name == "mounted"))
OF_LIFE = {each.name: each for each in rating_life.ENTRY.of_case}
OF_LIFE["reference_rating_life"] = OF_LIFE["basic_reference_rating_life"]._replace(path="reference_rating_life")
"""With the factors that are given."""
NOISE = 1e-10
"""Part of the largest of its kind up to which a displacement or load of the ring is rounding."""


class KeyNumber(NamedTuple):
    """One number of a key result, or the smallest and the largest of several."""

    of: str
    """Whose it is: a raceway, a channel; empty for the only one."""
    values: tuple[float, ...]
    unit: str
    digits: int | None = 4
    """None: one decimal."""

    @property
    def number(self) -> str:
        """As it reads, without its unit."""
        if self.digits is None:
            return " to ".join(dict.fromkeys(f"{each + 0.0:.1f}" for each in np.round(self.values, 1))) or "none"
        return " to ".join(_number(each, self.digits) for each in self.values)

    @property
    def text(self) -> str:
        """With whose it is and its unit."""
        return " ".join(filter(None, (self.of, self.number, self.unit if self.values else "")))


class KeyResult(NamedTuple):
    """One result with its numbers."""

    name: str
    parts: tuple[KeyNumber, ...] = ()
    condition: str = ""
    """Under which it holds."""
    note: str = ""
    """Words besides the numbers, or in place of them."""

    @property
    def line(self) -> tuple[str, str]:
        """Of a table."""
        name = f"{self.name}, {self.condition}" if self.condition else self.name
        return name, ": ".join(filter(None, (", ".join(part.text for part in self.parts), self.note)))


def results_of(solution: Solution, readings: Mapping[str, Any]) -> list[KeyResult]:
    """Those of a single case of a bearing.

    Args:
        readings: what the scene asked to be read off, by name.
    """
    lever = 0.5 * float(np.asarray(solution.scene.bearing.pitch_diameter))
    ring = ring_lines(solution, "inner ring", lever)
    heat = _heat_lines(solution)
    return [*contact_lines(solution), *ring, *_preload_lines(solution), *heat, *_life_lines(readings)]


def results_of_shaft(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[KeyResult]:
    """Those of a set's shaft, its points first."""
    lever = 0.5 * max(float(np.asarray(row.bearing.pitch_diameter)) for row in solution.set.rows)
    return [
        *_point_lines(solution),
        *ring_lines(solution, "shaft", lever),
        *_heat_lines(solution),
        *_system_life_lines(solution, readings),
    ]


def results_of_row(solution: SetSolution, number: int, readings: Mapping[str, Any]) -> list[KeyResult]:
    """Those of one row of a set.

    Args:
        number: from 0.
        readings: what the row was asked to be read off, by name.
    """
    own = (("axial load", LOAD_OF_ROW), ("preload mounted", MOUNTED_OF_ROW))
    numbers = ((words, _numbers(place._replace(row=number + 1), solution)) for words, place in own)
    lines = [KeyResult(words, parts) for words, parts in numbers if parts]
    return [*lines, *contact_lines(solution.rows[number]), *_life_lines(readings)]


def rows_table(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> Table:
    """The key results of each row, a line for each; what no row has is left out.

    Args:
        readings: what each row was asked to be read off, by name.
    """
    rows: list[dict[str, str]] = []
    for number, (row, of_row) in enumerate(zip(solution.rows, readings, strict=True)):
        cells = {"": capital(row_name(solution.set.rows[number], number))}
        for title, place in (("axial load\nN", LOAD_OF_ROW), ("preload mounted\nN", MOUNTED_OF_ROW)):
            for each in _numbers(place._replace(row=number + 1), solution):
                cells[title] = each.number
        for title, result in OF_EACH_ROW:
            if largest := _largest(row, result):
                cells[title] = " / ".join(each.number for each in largest)
        cells["contact angles\ndeg"] = " / ".join(_angles(row, side).number for side in CONTACTS)
        if "life" in of_row and np.isfinite(of_row["life"].duration):
            cells["life\nh"] = _of_life("duration", of_row["life"]).number
        rows.append(cells)
    titles = list(dict.fromkeys(title for cells in rows for title in cells))
    lines = [[cells.get(title, "-") for title in titles] for cells in rows]
    return Table(titles, lines, caption="Rows: inner / outer raceway", stack=True)


def _point_lines(solution: SetSolution) -> list[KeyResult]:
    """Deflection and stiffness of the shaft's named points: of a spindle, of its tool."""
    lines = []
    for name, point in solution.points.items():
        moved = _channels(DISPLACEMENT, point.displacement, np.ones(len(CHANNELS)), {0, 1, 2})
        stiff = _channels(STIFFNESS, point.effective_stiffness, np.ones(len(CHANNELS)), {0, 1, 2})
        lines += [KeyResult(f"{name}: deflection", moved), KeyResult(f"{name}: stiffness", stiff)]
    return lines


def contact_lines(solution: Solution) -> list[KeyResult]:
    """Maximum pressure, range of the contact angles, maximum load and required friction, of each raceway."""
    lines = [
        KeyResult("maximum contact pressure", _largest(solution, MAX_PRESSURE)),
        KeyResult("contact angles", tuple(_angles(solution, side, side.raceway) for side in CONTACTS)),
        KeyResult("maximum contact load", _largest(solution, CONTACT_LOAD)),
        KeyResult("required friction coefficient", _largest(solution, FRICTION, 2)),
    ]
    lines = [each for each in lines if each.parts]
    is_ball = np.isfinite(solution.azimuth)
    empty = int((is_ball & (solution.inner.load == 0.0)).sum())
    if empty:
        count = KeyNumber("", (empty,), f"of {is_ball.sum()}")
        lines.append(KeyResult("balls without load on the inner raceway", (count,)))
    return lines


def _largest(solution: Solution, result: Result, digits: int = 4) -> tuple[KeyNumber, ...]:
    """Of the contacts of each raceway."""
    places = (Place(side, result, over="max") for side in CONTACTS)
    return tuple(one for each in places for one in _numbers(each, solution, each.group.raceway, digits))


def _angles(solution: Solution, side: Group, of: str = "") -> KeyNumber:
    """From the least to the largest of the loaded contacts."""
    angles, loads = (np.asarray(Place(side, each).of(solution)) for each in (ANGLE, CONTACT_LOAD))
    loaded = angles[loads > 0.0]
    ends = (float(loaded.min()), float(loaded.max())) if loaded.size else ()
    return KeyNumber(of, ends, printed_unit(ANGLE.unit), None)


def ring_lines(solution: Solution | SetSolution, what: str, lever: float) -> list[KeyResult]:
    """Displacement and effective stiffness where ring or shaft is free to move, loads where it is not.

    Args:
        what: moves.
        lever: at which its turning is compared with its shift [m].
    """
    free = set(map(int, solution.free_channels))
    levers = np.array([1.0 if not channel.is_rotation else lever for channel in CHANNELS])
    moved = _channels(DISPLACEMENT, solution.displacement, levers, free)
    stiff = _channels(STIFFNESS, solution.effective_stiffness, 1.0 / levers**2, free)
    given = set(range(len(CHANNELS))) - free
    reactions = _channels(LOAD, solution.load, 1.0 / levers, given)
    lines = [KeyResult(f"displacement of the {what}", moved), KeyResult("effective stiffness", stiff, freedom(free))]
    if isinstance(solution, Solution):
        lines.insert(1, KeyResult("axial displacement from the middle", _numbers(FROM_MIDDLE, solution)))
    lines.append(KeyResult("load where a displacement is given", reactions))
    return [line for line in lines if line.parts]


def _preload_lines(solution: Solution) -> list[KeyResult]:
    if solution.scene.preload is None:
        return []
    words = {"unmounted": "before fitting", "mounted": "mounted at rest", "in_operation": "in operation"}
    places = (Place(OF_PRELOAD, each) for each in OF_PRELOAD.results if each.name in words)
    return [KeyResult("preload", tuple(_numbers(each, solution, words[each.result.name])[0] for each in places))]


def _numbers(place: Place, solution: Any, of: str = "", digits: int = 4) -> tuple[KeyNumber, ...]:
    """The number of a place, in a single case; none where there is none."""
    value = place.of(solution)
    return () if value is None else (KeyNumber(of, (float(value),), printed_unit(place.unit), digits),)


def _channels(channels: tuple[Result, ...], values: NDArray, levers: NDArray, which: set[int]) -> tuple[KeyNumber, ...]:
    """Channels with their values; what is rounding beside the largest, measured at the pitch circle, is left out."""
    sizes = np.abs(np.nan_to_num(values, nan=0.0)) * levers
    return tuple(
        KeyNumber(channel.label, (float(np.asarray(each.of(values))),), printed_unit(each.unit))
        for i, (channel, each) in enumerate(zip(CHANNELS, channels, strict=True))
        if i in which and np.isfinite(values[i]) and sizes[i] > NOISE * sizes.max()
    )


def _heat_lines(solution: Solution | SetSolution) -> list[KeyResult]:
    return [] if solution.thermal is None else [KeyResult("heat balance", note=solution.thermal.message())]


def _life_lines(readings: Mapping[str, Any]) -> list[KeyResult]:
    life = readings.get("life")
    if life is None:
        return []
    factors = [] if life.reliability_factor == 1.0 else [f"a1 {life.reliability_factor:.2g}"]
    if life.life_modification_factor is not None:
        limit = ", at its limit" if life.is_at_limit else ""
        factors.append(f"aISO {_number(float(life.life_modification_factor), 3)}{limit}")
    lines = [KeyResult("basic reference rating life", _life(life, "basic_reference_rating_life", "basic_duration"))]
    if factors:
        parts = _life(life, "reference_rating_life", "duration")
        lines.append(KeyResult("modified reference rating life", parts, note=", ".join(factors)))
    return lines


def _life(life: Any, turns: str, duration: str) -> tuple[KeyNumber, ...]:
    """In revolutions and, where there is a speed, in hours."""
    both = (_of_life(name, life) for name in (turns, duration))
    return tuple(each for each in both if each.unit != "h" or np.isfinite(each.values[0]))


def _of_life(name: str, life: Any) -> KeyNumber:
    result = OF_LIFE[name]
    unit = "million revolutions" if result.unit == "Mrev" else result.unit
    return KeyNumber("", (float(np.asarray(result.of(life))),), unit)


def _system_life_lines(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[KeyResult]:
    """Where every row has a life in hours."""
    lives = [Place(SYSTEM, each).of(solution, readings) for each in SYSTEM.results]
    if any(each is None or not np.isfinite(each) for each in lives):
        return []
    basic, modified = (KeyNumber("", (float(np.asarray(each)),), SYSTEM.results[0].unit) for each in lives)
    lines = [KeyResult("basic life of the set", (basic,)), KeyResult("modified life of the set", (modified,))]
    return lines if modified.number != basic.number else lines[:1]


def _number(value: float, digits: int = 4) -> str:
    """So many digits, without an exponent where it is long."""
    if digits == 3:
        return that_matter(value)
    return f"{value:.0f}" if 10**digits <= abs(value) < 1e9 else f"{value:.{digits}g}"
