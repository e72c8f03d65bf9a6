"""Small tables in pairs, side by side where a page is wide enough: a report of few pages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from qsbearing.documents.model import Badge, Bar, Block, Cell, Columns, RowGroup, Table

NARROW = 66
"""Letters of a row, gaps included, that fit into half of a page's width."""
GAP = 2
"""Letters between columns."""


def in_pairs(blocks: Iterable[Block]) -> list[Block]:
    """Blocks in their order, neighbouring narrow tables beside each other."""
    placed: list[Block] = []
    waiting: Table | None = None
    for each in blocks:
        if not isinstance(each, Table) or _letters(each) > NARROW:
            placed += [each] if waiting is None else [waiting, each]
            waiting = None
        elif waiting is None:
            waiting = each
        else:
            placed.append(Columns([[waiting], [each]]))
            waiting = None
    return placed if waiting is None else [*placed, waiting]


LONG = 12
"""Letters of a last cell that stands below its table instead, with a mark in its place."""
PER_LINE = 70
"""Letters of a line of notes."""


def halves(headings: Sequence[str], rows: Sequence[Sequence[str] | RowGroup], align: str) -> Columns:
    """A long table of short rows as two beside each other, parted where a group of rows begins; long words in the last
    column, which many rows share, are notes below."""
    notes: dict[str, str] = {}
    short: list[Sequence[str] | RowGroup] = []
    lines = [0]
    for row in rows:
        added = 1
        if not isinstance(row, RowGroup) and len(row[-1]) > LONG:
            *others, last = row
            added += 0 if last in notes else -(-len(last) // PER_LINE)
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


def _letters(table: Table) -> int:
    """Of its longest row, column by column."""
    rows = [row for row in table.rows if not isinstance(row, RowGroup)]
    columns = zip(table.headings, *rows, strict=True)
    return sum(max(map(_length, column)) + GAP for column in columns)


def _length(cell: Cell) -> int:
    """Of its longest line."""
    return len(cell.word) if isinstance(cell, Badge | Bar) else max(map(len, cell.split("\n")))
