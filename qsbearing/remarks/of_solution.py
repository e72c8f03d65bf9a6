"""What there is to say of solved cases, whatever was solved.

How cases ended and what holds of them, each kind of solution tells by functions of its own: a bearing's are in
`bearing`, those of a set register themselves in `qsbearing.systems.sets.remarks`, what is said of heat in
`qsbearing.systems.heat.state`. Who speaks of a solution calls these, and need not know its kind.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial, singledispatch
from typing import Any

import numpy as np

from qsbearing.model.solution.case_index import Index, case_place
from qsbearing.model.solution.of_cases import SolutionOfCases
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import check_kind
from qsbearing.remarks import bearing
from qsbearing.remarks.case_range import CaseRange, in_case
from qsbearing.remarks.remark import Holding, Remark, Warned, in_order, told

Readings = Mapping[str, Any]
"""Results by the name of their reading."""
OfRows = Readings | Sequence[Readings]
"""Those of a bearing, or of each row of a set."""


@singledispatch
def ended(solution: Any, index: Index) -> str:
    """How a case ended, as far as its equilibrium goes; of several without an index, how many ended how."""
    raise NotImplementedError(type(solution))


@singledispatch
def every_remark(solution: Any, readings: Any, index: Index = None) -> list[Remark]:
    """The one list: those of a solution and those of its readings, what matters most first.

    Args:
        readings: of a set, those of each row.
        index: the case, along the case axes; of several cases without it, in how many each holds.
    """
    raise NotImplementedError(type(solution))


@singledispatch
def holding(solution: Any, readings: Any, part: slice, may_solve: bool) -> Iterator[Holding]:
    """What there is to say of a stretch of cases: where each holds, and the remark of the i-th of them.

    Args:
        may_solve: whether cases may be solved again, differently, to tell; else what takes that is left out.
    """
    raise NotImplementedError(type(solution))


@singledispatch
def no_steady_state(thermal: Any, k: int, index: Index) -> str:
    """Why a case, by its number along the flattened axes, has no steady temperatures; empty if it has, or has no
    heat."""
    return ""


def message(solution: SolutionOfCases, index: Index = None) -> str:
    """One sentence on how a case of a bearing or set ended; for several without an index, how many have each status.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Returns:
        A sentence; empty for a case that is solved.

    Raises:
        ValueError: the index does not name one case of this solution.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(repr(qs.message(solution)))
        'Balls and ring are in equilibrium: largest imbalance 1.1e-17 of the largest force, after 4 iterations.'
    """
    check_kind("message", solution, "Solution", "SetSolution")
    if index is None and solution.shape:
        return ended(solution, index)
    return no_steady_state(solution.thermal, solution.flat_index(index), index) or ended(solution, index)


def warnings(solution: SolutionOfCases, index: Index = None) -> list[Warned]:
    """Warnings about the results of a case of a bearing or set; an empty list if there are none.

    Those that say that the model does not describe the case come first, then those on input data to check, then
    remarks. Each warning is a sentence with a `rank`, and `see` names the page of the guide that explains it; `remark`
    has it as data. Readings have their own (`warnings` of each).

    For several cases without an index, there is one sentence for each kind of warning: how many cases have it, which
    case is the first, and the warning of that case.

    Args:
        index: the case, along the solution's case axes; negative numbers count from the end.

    Returns:
        Remarks, in the order in which they are printed; a list for all cases or those of `index`.

    Raises:
        ValueError: the index does not name one case of this solution.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(qs.warnings(solution)[0].remark.code)
        effect_data_missing
    """
    check_kind("warnings", solution, "Solution", "SetSolution")
    none: Any = {} if isinstance(solution, Solution) else [{} for _ in solution.rows]  # type: ignore[attr-defined]
    return [each.said() for each in every_remark(solution, none, index)]


ended.register(Solution, bearing.message)


@every_remark.register
def _(solution: Solution, readings: Mapping, index: Index = None) -> list[Remark]:
    place = None if index is None else case_place(index, solution.shape)
    is_solved = np.any(np.asarray(solution.converged)[() if place is None else place])
    return in_order(in_case(solution, bearing.SUBJECTS, index) + (of_readings(readings, place) if is_solved else []))


@holding.register
def _(solution: Solution, readings: Mapping, part: slice, may_solve: bool) -> Iterator[Holding]:
    yield from bearing.SUBJECTS(CaseRange(solution, part, may_solve))
    for name, reading in readings.items():
        for where, each in getattr(reading, "remarks", ()):
            yield where, partial(_of_reading, name, each)


def of_readings(readings: Readings, place: Sequence[int] | None = None) -> list[Remark]:
    """The remarks of readings alone, with the name of each."""
    return [
        _of_reading(name, each)
        for name, reading in readings.items()
        for each in told(getattr(reading, "remarks", ()), None if place is None else tuple(place))
    ]


def _of_reading(name: str, make: Any, i: int = 0) -> Remark:
    said: Remark = make if isinstance(make, Remark) else make(i)
    return replace(said, of=replace(said.of, readings=(name,)))
