"""What is required and what holds anyway, as one table with bars: what was found and asked, and the answer."""

from __future__ import annotations

import math
from collections.abc import Sequence

from qsbearing.documents.model import Bar, Block, Cell, Paragraph, RowGroup, Table
from qsbearing.model.solution.limit import Answer, Origin
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.remarks.wording import capital
from qsbearing.reports.verdict import of_requirements
from qsbearing.results.requirements import (
    COLOURS,
    SIGNS,
    Answered,
    as_badge,
    name_of,
    numbers_of,
    requested_for,
    unchecked,
    whose,
    why_open,
)

HEADINGS = ("requirement", "found", "asked", "used", "answer")
ANYWAY = "Limits that hold anyway"


def answers_table(of: Answered, solution: object) -> list[Block]:
    """The table, why an answer is open, whose numbers the limits are, and what was not checked."""
    rows: list[Sequence[Cell] | RowGroup] = [_row(each) for each in of.required]
    rows += [RowGroup(ANYWAY)] if of.required and of.built_in else []
    rows += [_row(each) for each in of.built_in]
    sources = [f"{words_of(each)}: {each.limit.source}" for each in (*of.required, *of.built_in) if each.limit.source]
    from_whom = f"Limits by: {'; '.join(dict.fromkeys(sources))}." if sources else ""
    small = " ".join(filter(None, (from_whom, unchecked(of))))
    return [
        Table((HEADINGS[0] if of.required else ANYWAY, *HEADINGS[1:]), rows, "lrrll", stack=True),
        *_why_open(of.required, solution),
        *([Paragraph(small, is_small=True)] if small else []),
    ]


def required_first(required: Sequence[Answer], solution: object) -> list[Block]:
    """The answers to what is required alone, with their verdict; nothing where nothing is required."""
    if not required:
        return []
    table = Table(HEADINGS, [_row(each) for each in required], "lrrll", stack=True)
    return [of_requirements(required), table, *_why_open(required, solution)]


def _why_open(required: Sequence[Answer], solution: object) -> list[Block]:
    said = [f"Open: {words_of(each)}: {why_open(each, solution)}." for each in required if each.reason is not None]
    return [Paragraph(each) for each in dict.fromkeys(said)]


def words_of(answer: Answer) -> str:
    """What is limited: a limit that holds anyway by its name, of what is required the words for the result."""
    if answer.limit.origin is not Origin.INPUT:
        return answer.limit.name
    place = answer.place
    words = ", ".join(filter(None, (place.label, place.result.direction)))
    return f"size of {words}" if answer.limit.is_of_sizes else words or name_of(answer)


def _row(answer: Answer) -> list[Cell]:
    value, bound = numbers_of(answer)
    unit = printed_unit(answer.limit.unit)
    asked = (
        requested_for(answer.limit)
        if math.isnan(answer.bound)
        else f"{SIGNS[answer.limit.sense]}\N{NO-BREAK SPACE}{bound}"
    )
    name = ", ".join(filter(None, (capital(words_of(answer)), whose(answer))))
    has_number = math.isfinite(answer.value)
    status = COLOURS[answer.state]
    bar: Cell = Bar(answer.used, status) if has_number else ""
    return [name, f"{value} {unit}".rstrip() if has_number else "-", asked, bar, as_badge(answer)]
