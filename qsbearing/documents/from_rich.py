"""Tables and sentences laid out for the terminal, as pieces of a document: the same words and digits in both."""

from __future__ import annotations

from typing import Any

from qsbearing.documents.model import Block, Paragraph, Remark, Table
from qsbearing.ranked_warning import Rank

SIDES = {"right": "r", "center": "c"}


def blocks(renderable: Any) -> list[Block]:
    """What rich would print, one piece after another."""
    from rich.console import Group
    from rich.padding import Padding
    from rich.table import Table as RichTable
    from rich.text import Text

    match renderable:
        case Group():
            return [block for each in renderable.renderables for block in blocks(each)]
        case Padding():
            return blocks(renderable.renderable)
        case RichTable():
            return [_table(renderable)]
        case Text():
            return _sentences(renderable.plain)
    raise TypeError(f"{type(renderable).__name__} is nothing that a document holds")


def _table(table: Any) -> Table:
    columns = [[_plain(cell) for cell in column.cells] for column in table.columns]
    align = "".join(SIDES.get(column.justify, "l") for column in table.columns)
    headings = [_plain(column.header).strip() for column in table.columns]
    return Table(headings, [list(row) for row in zip(*columns, strict=True)], align, _plain(table.title or ""))


def _sentences(text: str) -> list[Block]:
    for rank in Rank:
        if text.startswith(f"{rank.words}: "):
            return [Remark(text, rank.status)]
    return [Paragraph(line) for line in text.split("\n") if line.strip()]


def _plain(cell: Any) -> str:
    from rich.text import Text

    return cell.plain if isinstance(cell, Text) else Text.from_markup(str(cell)).plain
