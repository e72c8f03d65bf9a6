"""The tables among a document's blocks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from qsbearing.documents.model import Columns, RowGroup, Table


def rows_of(blocks: Sequence[Any]) -> list[Any]:
    """The rows of all tables of a document's blocks, those side by side too, with notes in place of their marks."""
    rows: list[Any] = []
    for block in blocks:
        if isinstance(block, Columns):
            rows += [row for column in block.columns for row in rows_of(column)]
        elif isinstance(block, Table):
            notes = dict(block.notes)
            rows += [
                row if isinstance(row, RowGroup) else tuple(notes.get(str(cell), cell) for cell in row)
                for row in block.rows
            ]
    return rows
