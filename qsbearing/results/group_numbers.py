"""The numbers of groups of results, of one case, as JSON has them: under their keys, in their tables."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from qsbearing.model.solution.case_index import CasePlace
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.result_keys import Group, Place
from qsbearing.model.solution.solution import Solution
from qsbearing.results.readings_record import number
from qsbearing.results.record_type import Record

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution


def numbers_of(
    group: Group, solution: Solution | SetSolution, index: CasePlace = (), row: int = 0, readings: Any = None
) -> Record | None:
    """Of one case, which may share one number with all; None where none of them is called for.

    Args:
        row: of a set, from 1, of what each row has.
        readings: where they are of one; of a set those of each row.
    """
    if group.is_requested is not None and not group.is_requested(requested(solution)):
        return None
    numbers = {each.in_record: Place(group, each, row).of(solution, readings) for each in group.results}
    if all(values is None for values in numbers.values()):
        return None
    return {key: None if values is None else number(values[index]) for key, values in numbers.items()}


def numbers_or_none(group: Group, *of: Any) -> Record:
    """As `numbers_of`; each None where none is called for."""
    return numbers_of(group, *of) or no_numbers(group)


def no_numbers(group: Group) -> dict[str, None]:
    """Of each None."""
    return {each.in_record: None for each in group.results}


def tables_of(groups: Iterable[Group], solution: Solution | SetSolution, index: CasePlace = ()) -> Record:
    """The numbers of these groups in their tables, each within another."""
    tables: Record = {}
    for group in groups:
        table = tables
        for name in group.table or ():
            table = table.setdefault(name, {})
        table.update(numbers_or_none(group, solution, index))
    return tables
