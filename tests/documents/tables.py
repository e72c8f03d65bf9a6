"""The tables among a document's blocks."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from qsbearing.documents.model import Columns, Table


def rows_of(blocks: Sequence[Any]) -> list[Any]:
    """The rows of all tables of a document's blocks, those side by side too."""
    rows: list[Any] = []
    for block in blocks:
        if isinstance(block, Columns):
            rows += [row for column in block.columns for row in rows_of(column)]
        elif isinstance(block, Table):
            rows += block.rows
    return rows
