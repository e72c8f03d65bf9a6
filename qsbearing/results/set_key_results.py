"""The results of a set that most readers look for first: of its shaft and points, and of each row."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from qsbearing.documents.model import Facts, Table
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.groups import CONTACT_LOAD, CONTACTS, FRICTION, MAX_PRESSURE
from qsbearing.model.solution.result_keys import DISPLACEMENT, STIFFNESS, Place
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import capital, listed
from qsbearing.results.key_results import (
    KeyNumber,
    KeyResult,
    angles_of,
    contact_lines,
    facts,
    heat_lines,
    largest_of,
    life_lines,
    number_of_life,
    numbers_at,
    of_channels,
    ring_lines,
)
from qsbearing.systems.sets.set_groups import AXIAL_LOAD, PRELOAD, SYSTEM
from qsbearing.systems.sets.set_solution import SetSolution

OF_EACH_ROW = (
    ("largest pressure\nMPa", MAX_PRESSURE),
    ("largest ball load\nN", CONTACT_LOAD),
    ("friction\ncoefficient", FRICTION),
)
"""Of each row, its largest of each raceway."""
LOAD_OF_ROW = Place(AXIAL_LOAD, AXIAL_LOAD.results[0])
IN_OPERATION_OF_ROW = Place(PRELOAD, next(each for each in PRELOAD.results if each.name == "in_operation"))
MOUNTED_OF_ROW = Place(PRELOAD, next(each for each in PRELOAD.results if each.name == "mounted"))


def results_of_shaft(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[KeyResult]:
    """Those of a set's shaft, its points first."""
    return [
        *_point_lines(solution),
        *ring_lines(solution, "shaft"),
        *heat_lines(solution),
        *_system_life_lines(solution, readings),
    ]


def answer(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> Facts:
    """Those of the shaft, its points first, and the largest of all rows, for a terminal."""
    points = _point_lines(solution)
    shaft = results_of_shaft(solution, readings)[len(points) :]
    return facts([*points, *_rows_lines(solution), *shaft])


def _rows_lines(solution: SetSolution) -> list[KeyResult]:
    """The largest ball load and pressure of all rows, and what is left of the preload of each."""
    lines = []
    for name, result in (("maximum contact load", CONTACT_LOAD), ("maximum contact pressure", MAX_PRESSURE)):
        of_rows = [largest_of(row, result) for row in solution.rows]
        worst = [max(range(len(of_rows)), key=lambda row: of_rows[row][side].values) for side in range(len(CONTACTS))]
        both = ((row, of_rows[row][side]) for side, row in enumerate(worst))
        lines.append(KeyResult(name, tuple(each._replace(of=f"row {row + 1} {each.of}") for row, each in both)))
    left: dict[str, list[str]] = {}
    for number in range(1, len(solution.rows) + 1):
        for each in numbers_at(IN_OPERATION_OF_ROW._replace(row=number), solution):
            left.setdefault(each.text, []).append(str(number))
    said = [f"row{'s' * (len(numbers) > 1)} {listed(numbers)} {text}" for text, numbers in left.items()]
    return [*lines, KeyResult("preload in operation", note=", ".join(said))]


def results_of_row(solution: SetSolution, number: int, readings: Mapping[str, Any]) -> list[KeyResult]:
    """Those of one row of a set.

    Args:
        number: from 0.
        readings: what the row was asked to be read off, by name.
    """
    own = (("axial load", LOAD_OF_ROW), ("preload mounted", MOUNTED_OF_ROW))
    numbers = ((words, numbers_at(place._replace(row=number + 1), solution)) for words, place in own)
    lines = [KeyResult(words, parts) for words, parts in numbers if parts]
    return [*lines, *contact_lines(solution.rows[number]), *life_lines(readings)]


def rows_table(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> Table:
    """A line for each row; what no row has is left out."""
    rows: list[dict[str, str]] = []
    for number, (row, of_row) in enumerate(zip(solution.rows, readings, strict=True)):
        cells = {"": capital(row_name(solution.set.rows[number], number))}
        for title, place in (("axial load\nN", LOAD_OF_ROW), ("preload mounted\nN", MOUNTED_OF_ROW)):
            for each in numbers_at(place._replace(row=number + 1), solution):
                cells[title] = each.number
        for title, result in OF_EACH_ROW:
            if largest := largest_of(row, result):
                cells[title] = " / ".join(each.number for each in largest)
        cells["contact angles\ndeg"] = " / ".join(angles_of(row, side).number for side in CONTACTS)
        if "life" in of_row and np.isfinite(of_row["life"].duration):
            cells["life\nh"] = number_of_life("duration", of_row["life"]).number
        rows.append(cells)
    titles = list(dict.fromkeys(title for cells in rows for title in cells))
    lines = [[cells.get(title, "-") for title in titles] for cells in rows]
    return Table(titles, lines, caption="Rows: inner / outer raceway", stack=True)


def _point_lines(solution: SetSolution) -> list[KeyResult]:
    """Deflection and stiffness of the shaft's named points: of a spindle, of its tool."""
    lines = []
    for name, point in solution.points.items():
        moved = of_channels(DISPLACEMENT, point.displacement, np.ones(len(CHANNELS)), {0, 1, 2})
        stiff = of_channels(STIFFNESS, point.effective_stiffness, np.ones(len(CHANNELS)), {0, 1, 2})
        lines += [KeyResult(f"{name}: deflection", moved), KeyResult(f"{name}: stiffness", stiff)]
    return lines


def _system_life_lines(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[KeyResult]:
    """Where every row has a life in hours."""
    lives = [Place(SYSTEM, each).of(solution, readings) for each in SYSTEM.results]
    if any(each is None or not np.isfinite(each) for each in lives):
        return []
    basic, modified = (KeyNumber("", (float(np.asarray(each)),), SYSTEM.results[0].unit) for each in lives)
    lines = [KeyResult("basic life of the set", (basic,)), KeyResult("modified life of the set", (modified,))]
    return lines if modified.number != basic.number else lines[:1]
