"""The results that most readers look for first: pressures, angles, displacement, stiffness, friction, life."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Table
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, deg, mrad, um
from qsbearing.readings.rating_life import HOUR, MILLION
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import capital
from qsbearing.results.report import freedom
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.system_life import system_life

HEADINGS = ("key result", "value")
OF_ROWS = (
    ("largest pressure\nMPa", "max_pressure", MPa),
    ("largest ball load\nN", "load", 1.0),
    ("friction\ncoefficient", "required_friction", 1.0),
)
"""Of each row, its largest of each raceway."""
NOISE = 1e-10
"""Part of the largest of its kind up to which a displacement or load of the ring is rounding."""


class Part(NamedTuple):
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
    parts: tuple[Part, ...] = ()
    condition: str = ""
    """Under which it holds."""
    note: str = ""
    """Words besides the numbers, or in place of them."""

    @property
    def line(self) -> tuple[str, str]:
        """Of a table."""
        name = f"{self.name}, {self.condition}" if self.condition else self.name
        return name, ": ".join(filter(None, (", ".join(part.text for part in self.parts), self.note)))


def key_results(solution: Solution, readings: Mapping[str, Any]) -> Table:
    """Those of a single case, as `results_of` has them."""
    return Table(HEADINGS, [each.line for each in results_of(solution, readings)], "ll")


def results_of(solution: Solution, readings: Mapping[str, Any]) -> list[KeyResult]:
    """Those of a single case of a bearing.

    Args:
        readings: what the scene asked to be read off, by name.
    """
    lever = 0.5 * float(np.asarray(solution.scene.bearing.pitch_diameter))
    ring = ring_lines(solution, "inner ring", lever)
    heat = _heat_lines(solution)
    return [*contact_lines(solution), *ring, *_preload_lines(solution), *heat, *_life_lines(readings)]


def key_results_of_set(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[Table]:
    """Those of a single case of a set: of the shaft, and of each row.

    Args:
        readings: what each row was asked to be read off, by name.
    """
    lines = [each.line for each in results_of_shaft(solution, readings)]
    return [Table(HEADINGS, lines, "ll"), _rows_table(solution, readings)]


def results_of_shaft(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[KeyResult]:
    """Those of a set's shaft, its points first."""
    lever = 0.5 * max(float(np.asarray(row.bearing.pitch_diameter)) for row in solution.set.rows)
    return [
        *_point_lines(solution),
        *ring_lines(solution, "shaft", lever),
        *_heat_lines(solution),
        *_system_life_lines(readings),
    ]


def results_of_row(solution: SetSolution, number: int, readings: Mapping[str, Any]) -> list[KeyResult]:
    """Those of one row of a set.

    Args:
        number: from 0.
        readings: what the row was asked to be read off, by name.
    """
    results = [KeyResult("axial load", (Part("", (float(solution.axial_loads[number]),), "N"),))]
    if solution.preload_mounted is not None:
        results.append(KeyResult("preload mounted", (Part("", (float(solution.preload_mounted[number]),), "N"),)))
    return [*results, *contact_lines(solution.rows[number]), *_life_lines(readings)]


def _rows_table(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> Table:
    """A line for each row; what no row has is left out."""
    rows: list[dict[str, str]] = []
    for number, (row, of_row) in enumerate(zip(solution.rows, readings, strict=True)):
        cells = {"": capital(row_name(solution.set.rows[number], number))}
        cells["axial load\nN"] = _number(float(solution.axial_loads[number]))
        if solution.preload_mounted is not None:
            cells["preload mounted\nN"] = _number(float(solution.preload_mounted[number]))
        sides = row.inner, row.outer
        for title, name, unit in OF_ROWS:
            if getattr(row.inner, name) is not None:
                cells[title] = " / ".join(_number(_largest(side, name) / unit) for side in sides)
        cells["contact angles\ndeg"] = " / ".join(_angles("", side).number for side in sides)
        if "life" in of_row and np.isfinite(of_row["life"].duration):
            cells["life\nh"] = _number(float(of_row["life"].duration) / HOUR)
        rows.append(cells)
    titles = list(dict.fromkeys(title for cells in rows for title in cells))
    lines = [[cells.get(title, "-") for title in titles] for cells in rows]
    return Table(titles, lines, caption="Rows: inner / outer raceway", stack=True)


def _point_lines(solution: SetSolution) -> list[KeyResult]:
    """Deflection and stiffness of the shaft's named points: of a spindle, of its tool."""
    lines = []
    for name, point in solution.points.items():
        moved = _channels(point.displacement, np.ones(len(CHANNELS)), (um, "µm"), (mrad, "mrad"), {0, 1, 2})
        units = (1.0 / um, "N/µm"), (1.0 / mrad, "N m/mrad")
        stiff = _channels(point.effective_stiffness, np.ones(len(CHANNELS)), *units, {0, 1, 2})
        lines += [KeyResult(f"{name}: deflection", moved), KeyResult(f"{name}: stiffness", stiff)]
    return lines


def contact_lines(solution: Solution) -> list[KeyResult]:
    """Maximum pressure, range of the contact angles, maximum load and required friction, of each raceway."""
    sides = {"inner": solution.inner, "outer": solution.outer}

    def largest(name: str, size: float, unit: str, digits: int = 4) -> tuple[Part, ...]:
        return tuple(Part(of, (_largest(side, name) / size,), unit, digits) for of, side in sides.items())

    lines = [
        KeyResult("maximum contact pressure", largest("max_pressure", MPa, "MPa")),
        KeyResult("contact angles", tuple(_angles(of, side) for of, side in sides.items())),
        KeyResult("maximum contact load", largest("load", 1.0, "N")),
    ]
    if solution.inner.required_friction is not None:
        lines.append(KeyResult("required friction coefficient", largest("required_friction", 1.0, "", 2)))
    is_ball = np.isfinite(solution.azimuth)
    empty = int((is_ball & (solution.inner.load == 0.0)).sum())
    if empty:
        count = Part("", (empty,), f"of {is_ball.sum()}")
        lines.append(KeyResult("balls without load on the inner raceway", (count,)))
    return lines


def _largest(side: RacewayContacts, name: str) -> float:
    return float(np.nanmax(np.where(side.load > 0.0, getattr(side, name), 0.0)))


def _angles(of: str, side: RacewayContacts) -> Part:
    loaded = side.angle[side.load > 0.0] / deg
    return Part(of, (float(loaded.min()), float(loaded.max())) if loaded.size else (), "deg", None)


def ring_lines(solution: Solution | SetSolution, what: str, lever: float) -> list[KeyResult]:
    """Displacement and effective stiffness where ring or shaft is free to move, loads where it is not.

    Args:
        what: moves.
        lever: at which its turning is compared with its shift [m].
    """
    free = set(map(int, solution.free_channels))
    levers = np.array([1.0 if not channel.is_rotation else lever for channel in CHANNELS])
    lengths, turns = (um, "µm"), (mrad, "mrad")
    moved = _channels(solution.displacement, levers, lengths, turns, free)
    stiff = _channels(solution.effective_stiffness, 1.0 / levers**2, (1.0 / um, "N/µm"), (1.0 / mrad, "N m/mrad"), free)
    given = set(range(len(CHANNELS))) - free
    reactions = _channels(solution.load, 1.0 / levers, (1.0, "N"), (1.0, "N m"), given)
    lines = [KeyResult(f"displacement of the {what}", moved), KeyResult("effective stiffness", stiff, freedom(free))]
    middle = solution.axial_from_middle if isinstance(solution, Solution) else None
    if middle is not None:
        lines.insert(1, KeyResult("axial displacement from the middle", (Part("", (float(middle) / um,), "µm"),)))
    lines.append(KeyResult("load where a displacement is given", reactions))
    return [line for line in lines if line.parts]


def _preload_lines(solution: Solution) -> list[KeyResult]:
    if solution.scene.preload is None:
        return []
    loads = (solution.preload_unmounted, solution.preload_mounted, solution.load[0])
    words = ("before fitting", "mounted at rest", "in operation")
    parts = tuple(Part(word, (float(load),), "N") for load, word in zip(loads, words, strict=True))
    return [KeyResult("preload", parts)]


def _channels(
    values: NDArray, levers: NDArray, straight: tuple[float, str], turning: tuple[float, str], which: set[int]
) -> tuple[Part, ...]:
    """Channels with their values; what is rounding beside the largest, measured at the pitch circle, is left out."""
    sizes = np.abs(np.nan_to_num(values, nan=0.0)) * levers
    parts = []
    for i, channel in enumerate(CHANNELS):
        size, unit = turning if channel.is_rotation else straight
        if i in which and np.isfinite(values[i]) and sizes[i] > NOISE * sizes.max():
            parts.append(Part(channel.label, (float(values[i]) / size,), unit))
    return tuple(parts)


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
    lines = [KeyResult("basic reference rating life", _life(life.basic_reference_rating_life, life.basic_duration))]
    if factors:
        parts = _life(life.reference_rating_life, life.duration)
        lines.append(KeyResult("modified reference rating life", parts, note=", ".join(factors)))
    return lines


def _life(turns: NDArray, duration: NDArray) -> tuple[Part, ...]:
    parts = (Part("", (float(turns) / MILLION,), "million revolutions"),)
    return (*parts, Part("", (float(duration) / HOUR,), "h")) if np.isfinite(duration) else parts


def _system_life_lines(readings: Sequence[Mapping[str, Any]]) -> list[KeyResult]:
    """Where every row has a life in hours."""
    lives = [of_row["life"] for of_row in readings if "life" in of_row]
    if len(lives) < len(readings) or not np.isfinite([life.duration for life in lives]).all():
        return []
    basic, modified = (
        Part("", (float(system_life([getattr(life, name) for life in lives])) / HOUR,), "h")
        for name in ("basic_duration", "duration")
    )
    lines = [KeyResult("basic life of the set", (basic,)), KeyResult("modified life of the set", (modified,))]
    return lines if modified.number != basic.number else lines[:1]


def _number(value: float, digits: int = 4) -> str:
    """So many digits, without an exponent where it is long."""
    return f"{value:.0f}" if 10**digits <= abs(value) < 1e9 else f"{value:.{digits}g}"
