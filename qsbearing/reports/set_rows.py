"""What rows of a set have besides their lines in the table of rows: what is alike of all of them in one table, a column
for each row, and the rest row by row."""

from __future__ import annotations

from collections.abc import Sequence

from qsbearing.documents.drawing import picture
from qsbearing.documents.model import Block, Columns, Paragraph, RowGroup, Section, Table
from qsbearing.pictures import contact_ellipses
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import capital
from qsbearing.reports.layout import side_by_side
from qsbearing.results import report
from qsbearing.results.readings_record import Readings
from qsbearing.results.readings_report import readings_tables
from qsbearing.systems.sets.set_solution import SetSolution

NUMBERS = ("quantity", "value", "unit")
"""Headings of a table that rows may share."""


def rows_sections(solution: SetSolution, readings: Sequence[Readings], is_each_ball: bool) -> list[Section]:
    """Nothing where no row has anything.

    Args:
        readings: of each row.
        is_each_ball: whether the balls of each row are asked for.
    """
    of_rows = [_blocks(solution, number, of_row, is_each_ball) for number, of_row in enumerate(readings)]
    together, rest = shared(of_rows)
    sections = [
        Section(
            capital(row_name(solution.set.rows[number], number)),
            side_by_side(blocks) if is_each_ball else blocks,
            f"row-{number + 1}",
        )
        for number, blocks in enumerate(rest)
        if blocks
    ]
    placed: list[Block] = side_by_side(together)
    pairs = [sections[n : n + 2] for n in range(0, len(sections), 1 if is_each_ball else 2)]
    if is_each_ball:
        placed += sections
    else:
        placed += [pair[0] if len(pair) == 1 else Columns([[each] for each in pair]) for pair in pairs]
    return [Section("Rows", placed)] if placed else []


def _blocks(solution: SetSolution, number: int, readings: Readings, is_each_ball: bool) -> list[Block]:
    """Its rings, its balls where they are asked for, and what was read off."""
    row = solution.rows[number]
    heat = None if solution.thermal is None else solution.thermal.thermal
    blocks: list[Block] = [*(report.tables_of_balls if is_each_ball else report.tables_of_rings)(row, heat)]
    if is_each_ball:
        blocks.append(
            picture(
                contact_ellipses(row),
                f"Outlines of the contact ellipses of row {number + 1} to one scale, with their maximum pressures.",
                f"Contact ellipses of row {number + 1}; loads are those of the row alone, in the direction that it "
                "carries",
            )
        )
    return blocks + readings_tables(readings, row.scene)


def shared(of_rows: Sequence[Sequence[Block]]) -> tuple[list[Block], list[list[Block]]]:
    """What all rows have, told once, and what is left of each.

    Tables of the same quantities become one with a column for each row; a sentence that all rows have stands once.
    """
    if len(of_rows) < 2:
        return [], [list(blocks) for blocks in of_rows]
    every = [{_kind(each): each for each in blocks if _kind(each)} for blocks in of_rows]
    kinds = [kind for kind in every[0] if all(kind in each for each in every[1:])]
    together = [_in_one([each[kind] for each in every]) for kind in kinds]
    return together, [[each for each in blocks if _kind(each) not in kinds] for blocks in of_rows]


def _kind(block: Block) -> tuple[object, ...]:
    """Equal for blocks that rows may share; empty for those that they may not."""
    if isinstance(block, Paragraph):
        return (block,)
    if isinstance(block, Table) and tuple(block.headings) == NUMBERS:
        names = [each.text if isinstance(each, RowGroup) else (each[0], each[2]) for each in block.rows]
        return (block.caption, *names)
    return ()


def _in_one(alike: Sequence[Block]) -> Block:
    first = alike[0]
    if not isinstance(first, Table):
        return first
    tables = [each.rows for each in alike if isinstance(each, Table)]
    rows = [
        own[0] if isinstance(own[0], RowGroup) else (own[0][0], *(each[1] for each in own), own[0][2])
        for own in zip(*tables, strict=True)
    ]
    names = [f"row {number + 1}" for number in range(len(alike))]
    return Table((NUMBERS[0], *names, NUMBERS[2]), rows, f"l{'r' * len(alike)}l", first.caption, stack=True)
