"""Paragraphs, remarks and tables of a document for a terminal, laid out by rich."""

from __future__ import annotations

import os
from collections.abc import Sequence

from rich import box
from rich.console import Console, Group, RenderableType
from rich.padding import Padding
from rich.table import Table as RichTable
from rich.text import Text

from qsbearing.documents.model import Badge, Block, Cell, Paragraph, Remark, Table
from qsbearing.documents.model import Group as Across

NARROWEST, WIDEST = 80, 100
"""Columns: a narrower terminal breaks the lines itself, which loses no digit; wider, no table is easier to read."""

WHOLE = 20
"""Letters of a word that is not folded while other columns can give way; longer is only a name that a user gave."""

STYLES = {"pass": "green", "fail": "bold red", "finding": "yellow", "refused": "magenta"}
"""Of verdicts."""


def text_of(shown: RenderableType | Sequence[Block], width: int | None = None) -> str:
    """Blocks, or what rich prints, as text for standard output: colours and lines only where it understands them."""
    console = Console(width=width, highlight=False, soft_wrap=False)
    if width is None:
        # A file has no width to ask for; a terminal keeps its own, within reason.
        known = console.is_terminal or "COLUMNS" in os.environ
        console.width = max(min(console.width, WIDEST), NARROWEST) if known else WIDEST
    with console.capture() as capture:
        console.print(laid_out(shown) if isinstance(shown, Sequence) and not isinstance(shown, str) else shown)
    return "\n".join(line.rstrip() for line in capture.get().splitlines()) + "\n"


def laid_out(blocks: Sequence[Block]) -> Group:
    """Blocks below each other, an empty line before every table."""
    parts: list[RenderableType] = []
    for block in blocks:
        below: list[RenderableType] = []
        match block:
            case Table():
                part: RenderableType = _table(block)
                below = [Padding(_notes(block), (1, 0, 0, 0))] if block.notes else []
            case Paragraph():
                part = _text(block.text, block.lead, "bold")
            case Remark():
                part = _text(block.text, block.lead, f"bold {block.colour}")
            case _:
                raise TypeError(f"a terminal shows no {type(block).__name__}")
        is_apart = isinstance(block, Table) or block.is_apart
        parts += [Padding(part, (1, 0, 0, 0)) if is_apart and parts else part, *below]
    return Group(*parts)


def _text(text: str, lead: str, style: str) -> Text:
    found = Text(text)
    found.stylize(style, 0, len(lead))
    return found


def _table(table: Table) -> RichTable:
    """Without frames; where it is too wide, columns of words and long names give way first."""
    title = Text(table.caption, "bold") if table.caption else None
    found = RichTable(title=title, box=box.SIMPLE_HEAD, show_edge=False, title_justify="left")
    found.pad_edge, found.padding = False, (0, 1, 0, 0)
    for heading, side in zip(table.headings, table.alignment, strict=True):
        found.add_column(Text(heading), justify="right" if side == "r" else "left", overflow="fold")
    for number, row in enumerate(table.rows):
        cells = [row.text] if isinstance(row, Across) else map(_cell, row)
        found.add_row(*cells, style="dim" if number in table.faint else None)
    for column in found.columns:
        column.no_wrap = not any(" " in text or len(text) > WHOLE for text in map(str, (column.header, *column.cells)))
    return found


def _notes(table: Table) -> RichTable:
    found = RichTable(box=None, show_header=False, pad_edge=False)
    found.add_column(no_wrap=True)
    for mark, note in table.notes:
        found.add_row(Text(mark), Text(note))
    return found


def _cell(cell: Cell) -> Text:
    return Text(cell.word, STYLES.get(cell.kind, "")) if isinstance(cell, Badge) else Text(cell)
