"""The readings that a scene asks for, taken once for all that show them; and a case's as plain data and as columns."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.columns import columns
from qsbearing.model.solution.result_keys import Group
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.of_solution import Readings, of_readings
from qsbearing.results.record_type import Record

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution


def taken(solution: Solution) -> Readings:
    """What the scene asks to be read off; nothing where it asks for nothing, or its one case is not solved."""
    if not solution.scene.readings or not (solution.shape or solution.converged):
        return {}
    from qsbearing.readings.asked import take_asked  # a scene without readings does not load them

    return take_asked(solution)


def all_taken(solution: Solution | SetSolution) -> Any:
    """Likewise; of a set a list, by row."""
    return taken(solution) if isinstance(solution, Solution) else [taken(row) for row in solution.rows]


def all_columns(solution: Solution, readings: Readings) -> dict[str, NDArray]:
    """All of a solution and its readings as the columns of a table: one row per ball of every case."""
    table = columns(solution)
    if readings:
        from qsbearing.readings.asked import reading_columns

        table |= reading_columns(solution, readings)
    return table


def readings_record(solution: Solution, readings: Readings, index: CasePlace = ()) -> Record | None:
    """One case's readings, each under its name: the bearing's numbers, then its balls', then what to beware of.

    None stands for what was not asked for, or has no number.
    """
    if not readings:
        return None
    balls = np.flatnonzero(np.isfinite(solution.azimuth[index]))
    return {name: _one(name, reading, solution, index, balls) for name, reading in readings.items()}


def _one(name: str, reading: Any, solution: Solution, index: CasePlace, balls: Any) -> Record:
    from qsbearing.readings.asked import READINGS

    out: Record = {}
    rows: list[Record] = [{} for _ in balls]
    for place, values in READINGS[name].values(reading):
        side, key = place.group.raceway, place.result.key
        if not place.is_per_ball:
            out[key] = None if values is None else number(np.broadcast_to(values, solution.shape)[index])
            continue
        for row, ball in zip(rows, balls, strict=True):
            holder = row.setdefault(side, {}) if side else row
            holder[key] = None if values is None else number(values[index][ball])
    if any(rows):
        out["balls"] = rows
    if hasattr(reading, "models"):
        out["models"] = [model._asdict() for model in reading.models]
    out["warnings"] = [each.written(IN_FILE) for each in of_readings({name: reading})]
    return out


def number(value: Any) -> float | None:
    """The value as a float; None for NaN and infinity, which JSON has not."""
    return float(value) if math.isfinite(value) else None


def within(record: dict[str, Any], group: Group, table: str) -> dict[str, Any]:
    """The table of a group within one of its record, of this name."""
    path = group.table or ()
    for name in path[path.index(table) + 1 :]:
        record = record.setdefault(name, {})
    return record
