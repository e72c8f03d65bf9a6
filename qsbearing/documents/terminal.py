"""Paragraphs, remarks and tables of a document for a terminal, laid out by rich."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace

from rich import box
from rich.console import Console, Group, RenderableType
from rich.padding import Padding
from rich.table import Table as RichTable
from rich.text import Text

from qsbearing.documents.model import Badge, Bar, Block, Callout, Cell, Facts, Paragraph, RowGroup, Table
from qsbearing.documents.numbers import with_minus

NARROWEST, USUAL, WIDEST = 80, 100, 140
"""Columns: a narrower terminal breaks the lines itself, which loses no digit; a file has the usual ones; wider than the
last, no table is easier to read."""
MOST_OF_NAME = 40
"""Columns of the name of a fact."""

STYLES = {"pass": "green", "fail": "bold red", "finding": "yellow", "refused": "magenta"}
"""Of verdicts."""


def text_of(shown: RenderableType | Sequence[Block], width: int | None = None) -> str:
    """Blocks, or what rich prints, as text for standard output: colours and lines only where it understands them."""
    console = Console(width=width, highlight=False, soft_wrap=False)
    if width is None:
        # A file has no width to ask for; a terminal keeps its own, within reason.
        known = console.is_terminal or "COLUMNS" in os.environ
        console.width = max(min(console.width, WIDEST), NARROWEST) if known else USUAL
    with console.capture() as capture:
        is_of_blocks = isinstance(shown, Sequence) and not isinstance(shown, str)
        # Lines to be pasted are longer than the terminal: it breaks them where they may be marked as one.
        console.print(laid_out(shown, console.width) if is_of_blocks else shown, crop=False)  # type: ignore[arg-type]
    return "\n".join(line.rstrip() for line in capture.get().splitlines()) + "\n"


def laid_out(blocks: Sequence[Block], width: int = USUAL) -> Group:
    """Blocks below each other, an empty line before every table."""
    parts: list[RenderableType] = []
    part: RenderableType
    for block in blocks:
        below: list[RenderableType] = []
        match block:
            case Table():
                left_out = _left_out(block, width)
                part, *rest = _tables(_without(block, left_out), width)
                below = [Padding(each, (1, 0, 0, 0)) for each in rest]
                if left_out:
                    names = ", ".join(" ".join(block.headings[each].split("\n")).strip() for each in left_out)
                    below.append(Text(f"Too narrow for: {names}.", "dim"))
                below += [Padding(_notes(block), (1, 0, 0, 0))] if block.notes else []
            case Facts():
                part = _facts(block)
            case Paragraph():
                part = _text(block.text, block.lead, "bold")
                below = _to_paste(block.paste)
            case Callout():
                part = _text(block.said, block.lead, f"bold {block.colour}")
                below = _to_paste(block.paste)
            case _:
                raise TypeError(f"a terminal shows no {type(block).__name__}")
        is_apart = isinstance(block, Table | Facts) or block.is_apart
        parts += [Padding(part, (1, 0, 0, 0)) if is_apart and parts else part, *below]
    return Group(*parts)


def _text(text: str, lead: str, style: str) -> Text:
    styled = Text(with_minus(text))
    styled.stylize(style, 0, len(lead))
    return styled


def _to_paste(line: str) -> list[RenderableType]:
    """A line that is never broken, whatever the terminal's width."""
    return [Text(f"    {line}", "dim", no_wrap=True, overflow="ignore")] if line else []


BETWEEN = 2
"""Columns of the terminal between those of a table."""


def _left_out(table: Table, width: int) -> list[int]:
    """Columns that it may go without, as many as have no room, in the order of the table."""
    left: list[int] = []
    for number in table.spare:
        if _width([_least(table, each) for each in range(len(table.headings)) if each not in left]) <= width:
            break
        left.append(number)
    return sorted(left)


def _without(table: Table, left_out: list[int]) -> Table:
    """A table without some columns."""
    if not left_out:
        return table
    kept = [number for number in range(len(table.headings)) if number not in left_out]
    of = lambda cells: [cells[number] for number in kept]  # noqa: E731
    rows = [row if isinstance(row, RowGroup) else of(row) for row in table.rows]
    return replace(table, headings=of(table.headings), rows=rows, align="".join(of(table.alignment)), spare=())


def _width(columns: Sequence[int]) -> int:
    """Of several columns side by side."""
    return sum(columns) + BETWEEN * (len(columns) - 1)


def _tables(table: Table, width: int) -> list[RichTable]:
    """Without frames. Where it is too wide, columns of words give way first, each at its spaces; where that does not
    do, the columns that do not fit follow below, beside the first one, and where even two do not fit, what is in the
    other one stands below the name of its row: no number and no name is ever cut."""
    least = [_least(table, number) for number in range(len(table.headings))]
    parts = [[0]]
    for number in range(1, len(least)):
        if _width([least[each] for each in (*parts[-1], number)]) > width and len(parts[-1]) > 1:
            parts.append([0])
        parts[-1].append(number)
    return [
        _part(table, part, width, number)
        if _width([least[each] for each in part]) <= width
        else _part(_stacked(table, part), [0], width, number)
        for number, part in enumerate(parts)
    ]


def _stacked(table: Table, part: list[int]) -> Table:
    """Columns of a table below each other, as one."""
    below = lambda cells: "\n  ".join(str(_cell(cells[each])).replace("\n", " ") for each in part)  # noqa: E731
    rows = [row if isinstance(row, RowGroup) else (below(row),) for row in table.rows]
    return replace(table, headings=(below(table.headings),), rows=rows, align="l", spare=())


def _lines(table: Table, number: int) -> list[str]:
    """Of a column, its heading's among them."""
    cells = [str(_cell(row[number])) for row in table.rows if not isinstance(row, RowGroup)]
    return [line for text in (table.headings[number], *cells) for line in (text.split("\n") or [""])] or [""]


def _least(table: Table, number: int) -> int:
    """The width below which a column would cut a number or a word; a number and what stands with it are kept
    together."""
    lines = _lines(table, number)
    pieces = lines if table.alignment[number] == "r" else [word for line in lines for word in line.split(" ")]
    return max(map(len, pieces))


def _widths(table: Table, part: list[int], width: int) -> dict[int, int]:
    """Of columns that must give way, the widest first."""
    most = {number: max(map(len, _lines(table, number))) for number in part}
    # A group's text stands in the first column, which it widens as far as the others leave room.
    most[0] = max([most[0], *(len(row.text) for row in table.rows if isinstance(row, RowGroup))])
    least, widths = {number: _least(table, number) for number in part}, dict(most)
    while _width(list(widths.values())) > width:
        able = [number for number in part if widths[number] > least[number]]
        if not able:
            break
        widths[max(able, key=lambda number: widths[number])] -= 1
    return {number: each for number, each in widths.items() if each < most[number]}


def _part(table: Table, part: list[int], width: int, count: int) -> RichTable:
    title = Text(with_minus(table.caption), "bold") if table.caption and not count else None
    rich_table = RichTable(title=title, box=box.SIMPLE_HEAD, show_edge=False, title_justify="left")
    rich_table.pad_edge, rich_table.padding, widths = False, (0, 1, 0, 0), _widths(table, part, width)
    for number in part:
        justify = "right" if table.alignment[number] == "r" else "left"
        rich_table.add_column(Text(table.headings[number]), justify=justify, overflow="fold", width=widths.get(number))  # type: ignore[arg-type]
        rich_table.columns[-1].no_wrap = number not in widths
    for number, row in enumerate(table.rows):
        cells = [with_minus(row.text)] if isinstance(row, RowGroup) else [_cell(row[each]) for each in part]
        rich_table.add_row(*cells, style="dim" if number in table.faint else None)
    return rich_table


def _facts(facts: Facts) -> RichTable:
    """Names, and what they are beside them."""
    lines = RichTable(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    lines.add_column(max_width=MOST_OF_NAME)
    lines.add_column()
    for name, cell in facts.pairs:
        lines.add_row(Text(name), _cell(cell))
    return lines


def _notes(table: Table) -> RichTable:
    notes = RichTable(box=None, show_header=False, pad_edge=False)
    notes.add_column(no_wrap=True)
    for mark, note in table.notes:
        notes.add_row(Text(mark), Text(note))
    return notes


def _cell(cell: Cell) -> Text:
    if isinstance(cell, Bar):
        return Text(with_minus(cell.word))
    return Text(cell.word, STYLES.get(cell.kind, "")) if isinstance(cell, Badge) else Text(with_minus(cell))
