"""What there is to say about solved cases: how they ended, and what to beware of in their numbers.

A remark is data (`remark`); its sentence is made of its code (`kinds`) when somebody reads it. `bearing` speaks for the
cases of a bearing and `bearing_set` for those of a set. Each other file makes the remarks of one subject, for a stretch
of cases: `balls`, `expansion`, `preload`, `missing_effects`. Other readings remark on their own numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.model.solution.case_index import Index, place_of
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks import bearing
from qsbearing.remarks.remark import Remark, Warned, in_order, told

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution


def message(solution: Solution | SetSolution, index: Index = None) -> str:
    """One sentence on how a case of a bearing or set ended; for several without an index, how many have each status.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Raises:
        ValueError: the index does not name one case of this solution.
    """
    if isinstance(solution, Solution):
        return bearing.message(solution, index)
    from qsbearing.remarks import bearing_set

    return bearing_set.message(solution, index)


def warnings(solution: Solution | SetSolution, index: Index = None) -> list[Warned]:
    """Warnings about the results of a case of a bearing or set; an empty list if there are none.

    Those that say that the model does not describe the case come first, then those on input data to check, then
    remarks. Each warning is a sentence with a `rank`, and `see` names the page of the guide that explains it; `remark`
    has it as data. Readings have their own (`warnings` of each).

    For several cases without an index, there is one sentence for each kind of warning: how many cases have it, which
    case is the first, and the warning of that case.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Raises:
        ValueError: the index does not name one case of this solution.
    """
    return [each.said() for each in remarks(solution, index)]


def remarks(solution: Solution | SetSolution, index: Index = None) -> list[Remark]:
    """Likewise as data."""
    if isinstance(solution, Solution):
        return bearing.remarks(solution, index)
    from qsbearing.remarks import bearing_set

    return bearing_set.remarks(solution, index)


def with_readings(solution: Solution | SetSolution, readings: Any, index: Index = None) -> list[Remark]:
    """Those of a solution and of its readings, which are taken.

    Args:
        readings: that are taken, by their names; of a set, those of each row.
    """
    if isinstance(solution, Solution):
        place = None if index is None else place_of(index, solution.shape)
        is_solved = np.any(np.asarray(solution.converged)[() if place is None else place])
        return in_order(bearing.remarks(solution, index) + (of_readings(readings, place) if is_solved else []))
    from qsbearing.remarks import bearing_set

    rows = [with_readings(row, own, index) for row, own in zip(solution.rows, readings, strict=True)]
    return bearing_set.with_rows(solution, rows, index)


def of_readings(readings: Mapping[str, Any], place: Sequence[int] | None = None) -> list[Remark]:
    """Those of readings alone, with the name of each."""
    return [
        replace(each, of=replace(each.of, readings=(name,)))
        for name, reading in readings.items()
        for each in told(getattr(reading, "remarks", ()), None if place is None else tuple(place))
    ]
