"""Tables side by side where a page is wide enough: a report of few pages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Columns, Picture, RowGroup, Table
from qsbearing.pictures.style import legend


def side_by_side(blocks: Iterable[Block]) -> list[Block]:
    """Blocks in their order, neighbouring tables beside each other as far as they fit; on a phone their cells wrap."""
    placed: list[Block] = []
    wrapping = (replace(each, stack=True) if isinstance(each, Table) else each for each in blocks)
    for are_tables, each in groupby(wrapping, lambda block: isinstance(block, Table)):
        alike = list(each)
        placed += [Columns([[table] for table in alike], True)] if are_tables and len(alike) > 1 else alike
    return placed


HALF = 4.4
"""Width of a picture that has half of a page's [inches]."""


TITLE = 0.4
"""Height of a title above a picture [inches]."""


def untitled(figure: Any) -> Any:
    """A figure without what was solved, which a report says above all of them."""
    width, height = figure.get_size_inches()
    figure.suptitle("")
    figure.set_size_inches(width, height - TITLE)
    return figure


def half(figure: Any, alt: str, caption: str) -> Picture:
    """A picture for half of a page's width: its letters are as large as in those of the whole width."""
    width, height = untitled(figure).get_size_inches()
    figure.set_size_inches(HALF, height * (0.6 + 0.4 * HALF / width))
    for each in figure.legends:  # which has its lines by the width
        each.remove()
    legend(figure, *figure.axes)
    return picture(figure, alt, caption, 1.0)


LONG = 12
"""Letters of a last cell that stands below its table instead, with a mark in its place."""
PER_LINE, LOW, ACROSS = 72, 0.8, 1.3
"""Letters of a line of notes; its height, and that of a row across the table, over those of other rows."""


def halves(headings: Sequence[str], rows: Sequence[Sequence[str] | RowGroup], align: str) -> Columns:
    """A long table of short rows as two beside each other, parted where a group of rows begins; long words in the last
    column, which many rows share, are notes below."""
    notes: dict[str, str] = {}
    short: list[Sequence[str] | RowGroup] = []
    lines = [0.0]
    for row in rows:
        added = ACROSS if isinstance(row, RowGroup) else 1.0
        if not isinstance(row, RowGroup) and len(row[-1]) > LONG:
            *others, last = row
            added += 0.0 if last in notes else LOW * -(-len(last) // PER_LINE)
            row = [*others, notes.setdefault(last, f"[{len(notes) + 1}]")]
        short.append(row)
        lines.append(lines[-1] + added)
    starts = [number for number, row in enumerate(short) if isinstance(row, RowGroup)]
    middle = min(starts[1:], key=lambda each: abs(2 * lines[each] - lines[-1]), default=len(short))
    marks = [(mark, text) for text, mark in notes.items()]
    parts = [part for part in (short[:middle], short[middle:]) if part]
    used = [{row[-1] for row in part if not isinstance(row, RowGroup)} for part in parts]
    return Columns(
        [
            [Table(headings, part, align, stack=True, notes=[each for each in marks if each[0] in own])]
            for part, own in zip(parts, used, strict=True)
        ]
    )
