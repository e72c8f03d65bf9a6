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
        is_of_blocks = isinstance(shown, Sequence) and not isinstance(shown, str)
        console.print(laid_out(shown, console.width) if is_of_blocks else shown)  # type: ignore[arg-type]
    return "\n".join(line.rstrip() for line in capture.get().splitlines()) + "\n"


def laid_out(blocks: Sequence[Block], width: int = WIDEST) -> Group:
    """Blocks below each other, an empty line before every table."""
    parts: list[RenderableType] = []
    part: RenderableType
    for block in blocks:
        below: list[RenderableType] = []
        match block:
            case Table():
                part, *rest = _tables(block, width)
                below = [Padding(each, (1, 0, 0, 0)) for each in rest]
                below += [Padding(_notes(block), (1, 0, 0, 0))] if block.notes else []
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


BETWEEN = 2
"""Columns of the terminal between those of a table."""


def _tables(table: Table, width: int) -> list[RichTable]:
    """Without frames. Where it is too wide, columns of words and long names give way first, each at its spaces; where
    that does not do, the columns that do not fit follow below, beside the first one: no number is ever cut."""
    lines = [_lines(table, number) for number in range(len(table.headings))]
    least = [_least(each, side) for each, side in zip(lines, table.alignment, strict=True)]
    most = [max(map(len, each)) for each in lines]
    # A group's text stands in the first column, which it widens as far as the others leave room.
    most[0] = max([most[0], *(len(row.text) for row in table.rows if isinstance(row, Across))])
    parts, used = [[0]], least[0]
    for number, need in enumerate(least[1:], 1):
        if used + BETWEEN + need > width and len(parts[-1]) > 1:
            parts.append([0])
            used = least[0]
        parts[-1].append(number)
        used += BETWEEN + need
    return [_part(table, part, _widths(part, least, most, width), number) for number, part in enumerate(parts)]


def _lines(table: Table, number: int) -> list[str]:
    """Of a column, its heading's among them."""
    cells = [str(_cell(row[number])) for row in table.rows if not isinstance(row, Across)]
    return [line for text in (table.headings[number], *cells) for line in (text.split("\n") or [""])] or [""]


def _least(lines: list[str], side: str) -> int:
    """The width below which a column would cut a number or a word; a number and what stands with it are kept together,
    and a name of more letters than `WHOLE` may be folded."""
    pieces = lines if side == "r" else [word for line in lines for word in line.split(" ")]
    return max(min(len(each), WHOLE) if side == "l" else len(each) for each in pieces)


def _widths(part: list[int], least: list[int], most: list[int], width: int) -> dict[int, int]:
    """Of columns that must give way, the widest first."""
    found = {number: most[number] for number in part}
    while sum(found.values()) + BETWEEN * (len(part) - 1) > width:
        able = [number for number in part if found[number] > least[number]]
        if not able:
            break
        found[max(able, key=lambda number: found[number])] -= 1
    return {number: each for number, each in found.items() if each < most[number]}


def _part(table: Table, part: list[int], widths: dict[int, int], count: int) -> RichTable:
    title = Text(table.caption, "bold") if table.caption and not count else None
    found = RichTable(title=title, box=box.SIMPLE_HEAD, show_edge=False, title_justify="left")
    found.pad_edge, found.padding = False, (0, 1, 0, 0)
    for number in part:
        justify = "right" if table.alignment[number] == "r" else "left"
        found.add_column(Text(table.headings[number]), justify=justify, overflow="fold", width=widths.get(number))  # type: ignore[arg-type]
        found.columns[-1].no_wrap = number not in widths
    for number, row in enumerate(table.rows):
        cells = [row.text] if isinstance(row, Across) else [_cell(row[each]) for each in part]
        found.add_row(*cells, style="dim" if number in table.faint else None)
    return found


def _notes(table: Table) -> RichTable:
    found = RichTable(box=None, show_header=False, pad_edge=False)
    found.add_column(no_wrap=True)
    for mark, note in table.notes:
        found.add_row(Text(mark), Text(note))
    return found


def _cell(cell: Cell) -> Text:
    return Text(cell.word, STYLES.get(cell.kind, "")) if isinstance(cell, Badge) else Text(cell)
