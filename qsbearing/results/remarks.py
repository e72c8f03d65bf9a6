"""The one list of remarks on a solution, for people and for programs: `run`, `explain`, `find`, `compare`, reports, the
page and notebooks all show it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from qsbearing.documents.model import Callout
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.case_index import Index
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks import of_solution
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.of_solution import OfRows
from qsbearing.remarks.remark import Remark, in_order
from qsbearing.remarks.wording import Span, Words
from qsbearing.results.readings_record import all_taken

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution

COLOURS = {Severity.WRONG_MODEL: "red", Severity.INCOMPLETE_MODEL: "yellow", Severity.CHECK_DATA: "yellow"}
AXES = ("readings", "raceways", "rows", "points", "bearings")
"""Whom a remark is about, in the order in which equal ones are put together."""


def every_remark(solution: Solution | SetSolution, readings: OfRows | None = None, index: Index = None) -> list[Remark]:
    """The one list: those of a solution and those of what its scene or set asks to be read off.

    Args:
        readings: where they are taken already; of a set, those of each row.
        index: the case, along the case axes; of several cases without it, in how many each holds.
    """
    return of_solution.every_remark(solution, all_taken(solution) if readings is None else readings, index)


def of_points(solution: Solution | SetSolution, readings: Any) -> list[Remark]:
    """Those of each operating point of a load spectrum."""
    return [
        replace(each, of=replace(each.of, points=(k + 1,)))
        for k in range(solution.shape[0])
        for each in every_remark(solution, readings, k)
    ]


def remarks_record(said: Sequence[Remark]) -> dict[str, Any]:
    """As JSON has them, each by itself; the sentences alone are those of the solution, for readings have their own."""
    warnings = [each.written(IN_FILE) for each in said if not each.of.readings]
    return {"warnings": warnings, "remarks": [each.record(IN_FILE) for each in said]}


def blocks(said: Iterable[Remark], is_apart: bool = False, words: Words = IN_FILE) -> list[Callout]:
    """For people: what is the same of several rows, raceways or points once; apart: an empty line before them in a
    terminal."""
    lines = [each.said(words) for each in together(said)]
    return [
        Callout(
            each.line,
            each.rank.status,
            f"{each.rank.words}:",
            COLOURS.get(each.rank, ""),
            is_apart and number == 0,
            each.remark.paste(words),
        )
        for number, each in enumerate(lines)
    ]


def together(said: Iterable[Remark]) -> list[Remark]:
    """Equal remarks once, with all that they are about and the range of their numbers; what matters most first."""
    remarks = in_order(said)
    for axis in AXES:
        alike: dict[Any, list[Remark]] = {}
        for each in remarks:
            alike.setdefault((each.code, each.of.about(axis, ()), _names(each.values)), []).append(each)
        remarks = [each for several in alike.values() for each in _in_one(several, axis)]
    return in_order(remarks)


def _in_one(several: list[Remark], axis: str) -> list[Remark]:
    """Remarks that differ in one thing that they are about, and in numbers."""
    about = [place for each in several for place in getattr(each.of, axis)]
    if len(several) == 1 or len(set(about)) < len(several) or not all(getattr(each.of, axis) for each in several):
        return several
    values = {name: _span([each.values[name] for each in several]) for name in several[0].values}
    return [replace(several[0], of=several[0].of.about(axis, tuple(about)), values=values)]


def _names(value: Any) -> Any:
    """What of values is not a number; these differ between remarks that are different things."""
    if isinstance(value, Mapping):
        return tuple((name, _names(each)) for name, each in value.items())
    if isinstance(value, str | bool):
        return value
    return tuple(map(_names, value)) if isinstance(value, tuple) and not isinstance(value, Span) else None


def _span(values: Sequence[Any]) -> Any:
    """A value of several remarks, equal but for numbers."""
    if isinstance(values[0], str | bool):
        return values[0]
    if isinstance(values[0], tuple) and not isinstance(values[0], Span):
        return tuple(_span(each) for each in zip(*values, strict=True))
    numbers = [number for each in values for number in (each if isinstance(each, Span) else (each,))]
    return Span(numbers) if len(set(numbers)) > 1 else numbers[0]
