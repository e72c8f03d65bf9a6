"""The results that most readers look for first: pressures, angles, displacement, stiffness, friction, life."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

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

Line = tuple[str, str]
HEADINGS = ("key result", "value")
OF_ROWS = (
    ("largest pressure\nMPa", "max_pressure", MPa),
    ("largest ball load\nN", "load", 1.0),
    ("friction\ncoefficient", "required_friction", 1.0),
)
"""Of each row, its largest of each raceway."""
NOISE = 1e-10
"""Part of the largest of its kind up to which a displacement or load of the ring is rounding."""


def key_results(solution: Solution, readings: Mapping[str, Any]) -> Table:
    """Those of a single case.

    Args:
        readings: what the scene asked to be read off, by name.
    """
    lever = 0.5 * float(np.asarray(solution.scene.bearing.pitch_diameter))
    ring = ring_lines(solution, "inner ring", lever)
    heat = _heat_lines(solution)
    lines = [*contact_lines(solution), *ring, *_preload_lines(solution), *heat, *_life_lines(readings)]
    return Table(HEADINGS, lines, "ll")


def key_results_of_set(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[Table]:
    """Those of a single case of a set: of the shaft, and of each row.

    Args:
        readings: what each row was asked to be read off, by name.
    """
    lever = 0.5 * max(float(np.asarray(row.bearing.pitch_diameter)) for row in solution.set.rows)
    lines = [
        *_point_lines(solution),
        *ring_lines(solution, "shaft", lever),
        *_heat_lines(solution),
        *_system_life_lines(readings),
    ]
    return [Table(HEADINGS, lines, "ll"), _rows_table(solution, readings)]


def _rows_table(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> Table:
    """A line for each row; what no row has is left out."""
    rows: list[dict[str, str]] = []
    for number, (row, found) in enumerate(zip(solution.rows, readings, strict=True)):
        cells = {"": capital(row_name(solution.set.rows[number], number))}
        cells["axial load\nN"] = _number(float(solution.axial_loads[number]))
        if solution.preload_mounted is not None:
            cells["preload mounted\nN"] = _number(float(solution.preload_mounted[number]))
        sides = row.inner, row.outer
        for title, name, unit in OF_ROWS:
            if getattr(row.inner, name) is not None:
                cells[title] = " / ".join(_largest(side, name, unit) for side in sides)
        cells["contact angles\ndeg"] = " / ".join(_angles(side) for side in sides)
        if "life" in found and np.isfinite(found["life"].duration):
            cells["life\nh"] = _number(float(found["life"].duration) / HOUR)
        rows.append(cells)
    titles = list(dict.fromkeys(title for cells in rows for title in cells))
    lines = [[cells.get(title, "-") for title in titles] for cells in rows]
    return Table(titles, lines, caption="Rows: inner / outer raceway", stack=True)


def _point_lines(solution: SetSolution) -> list[Line]:
    """Deflection and stiffness of the shaft's named points: of a spindle, of its tool."""
    lines = []
    for name, point in solution.points.items():
        moved = _channels(point.displacement, np.ones(len(CHANNELS)), (um, "µm"), (mrad, "mrad"), {0, 1, 2})
        units = (1.0 / um, "N/µm"), (1.0 / mrad, "N m/mrad")
        stiff = _channels(point.effective_stiffness, np.ones(len(CHANNELS)), *units, {0, 1, 2})
        lines += [(f"{name}: deflection", moved), (f"{name}: stiffness", stiff)]
    return lines


def contact_lines(solution: Solution) -> list[Line]:
    """Maximum pressure, range of the contact angles, maximum load and required friction, of each raceway."""
    lines = [
        ("maximum contact pressure", _of_sides(solution, lambda side: f"{_largest(side, 'max_pressure', MPa)} MPa")),
        ("contact angles", _of_sides(solution, lambda side: _angles(side, " deg"))),
        ("maximum contact load", _of_sides(solution, lambda side: f"{_largest(side, 'load', 1.0)} N")),
    ]
    if solution.inner.required_friction is not None:
        friction = _of_sides(solution, lambda side: _largest(side, "required_friction", 1.0, 2))
        lines.append(("required friction coefficient", friction))
    empty = np.isfinite(solution.azimuth) & (solution.inner.load == 0.0)
    if empty.any():
        lines.append(
            ("balls without load on the inner raceway", f"{empty.sum()} of {np.isfinite(solution.azimuth).sum()}")
        )
    return lines


def _of_sides(solution: Solution, text: Callable[[RacewayContacts], str]) -> str:
    return ", ".join(f"{name} {text(getattr(solution, name))}" for name in ("inner", "outer"))


def _largest(side: RacewayContacts, name: str, size: float, digits: int = 4) -> str:
    return _number(float(np.nanmax(np.where(side.load > 0.0, getattr(side, name), 0.0))) / size, digits)


def _angles(side: RacewayContacts, unit: str = "") -> str:
    loaded = side.angle[side.load > 0.0] / deg
    if not loaded.size:
        return "none"
    low, high = (f"{each + 0.0:.1f}" for each in np.round([loaded.min(), loaded.max()], 1))
    return f"{low}{unit}" if low == high else f"{low} to {high}{unit}"


def ring_lines(solution: Solution | SetSolution, what: str, lever: float) -> list[Line]:
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
    lines = [(f"displacement of the {what}", moved), (f"effective stiffness, {freedom(free)}", stiff)]
    middle = solution.axial_from_middle if isinstance(solution, Solution) else None
    if middle is not None:
        lines.insert(1, ("axial displacement from the middle", f"{_number(float(middle) / um)} µm"))
    lines.append(("load where a displacement is given", reactions))
    return [line for line in lines if line[1]]


def _preload_lines(solution: Solution) -> list[Line]:
    if solution.scene.preload is None:
        return []
    loads = (solution.preload_unmounted, solution.preload_mounted, solution.load[0])
    words = ("before fitting", "mounted, at rest", "in operation")
    return [("preload", ", ".join(f"{_number(float(load))} N {word}" for load, word in zip(loads, words, strict=True)))]


def _channels(
    values: NDArray, levers: NDArray, straight: tuple[float, str], turning: tuple[float, str], which: set[int]
) -> str:
    """Channels with their values; what is rounding beside the largest, measured at the pitch circle, is left out."""
    sizes = np.abs(np.nan_to_num(values, nan=0.0)) * levers
    found = []
    for i, channel in enumerate(CHANNELS):
        size, unit = turning if channel.is_rotation else straight
        if i in which and np.isfinite(values[i]) and sizes[i] > NOISE * sizes.max():
            found.append(f"{channel.label} {_number(float(values[i]) / size)} {unit}")
    return ", ".join(found)


def _heat_lines(solution: Solution | SetSolution) -> list[Line]:
    return [] if solution.thermal is None else [("heat balance", solution.thermal.message())]


def _life_lines(readings: Mapping[str, Any]) -> list[Line]:
    life = readings.get("life")
    if life is None:
        return []
    factors = [] if life.reliability_factor == 1.0 else [f"a1 {life.reliability_factor:.2g}"]
    if life.life_modification_factor is not None:
        limit = ", at its limit" if life.is_at_limit else ""
        factors.append(f"aISO {_number(float(life.life_modification_factor), 3)}{limit}")
    lines = [("basic reference rating life", _life(life.basic_reference_rating_life, life.basic_duration))]
    if factors:
        text = f"{_life(life.reference_rating_life, life.duration)}: {', '.join(factors)}"
        lines.append(("modified reference rating life", text))
    return lines


def _life(turns: NDArray, duration: NDArray) -> str:
    text = f"{_number(float(turns) / MILLION)} million revolutions"
    return f"{text}, {_number(float(duration) / HOUR)} h" if np.isfinite(duration) else text


def _system_life_lines(readings: Sequence[Mapping[str, Any]]) -> list[Line]:
    """Where every row has a life in hours."""
    lives = [found["life"] for found in readings if "life" in found]
    if len(lives) < len(readings) or not np.isfinite([life.duration for life in lives]).all():
        return []
    basic, modified = (
        f"{_number(float(system_life([getattr(life, name) for life in lives])) / HOUR)} h"
        for name in ("basic_duration", "duration")
    )
    lines = [("basic life of the set", basic), ("modified life of the set", modified)]
    return lines if modified != basic else lines[:1]


def _number(value: float, digits: int = 4) -> str:
    """So many digits, without an exponent where it is long."""
    return f"{value:.0f}" if 10**digits <= abs(value) < 1e9 else f"{value:.{digits}g}"
