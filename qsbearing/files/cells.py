"""What tables of every kind have in common: how large they may be, and when a cell is empty."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qsbearing.files.errors import refused
from qsbearing.files.limits import MOST_CELLS, MOST_COLUMNS, MOST_ROWS


def check_size(path: Path, rows: int, columns: int, most: int = MOST_CELLS) -> None:
    """See that a table is no larger than is read.

    Raises:
        SceneFileError: it is.
    """
    for count, limit, what in ((rows, MOST_ROWS, "rows"), (columns, MOST_COLUMNS, "columns")):
        if count > limit:
            raise refused(path, f"has {count:,} {what}; at most {limit:,} are read")
    if rows * columns > most:
        raise refused(
            path, f"has {rows * columns:,} cells; at most {most:,} are read", "Leave out columns, or split it"
        )


def is_empty(cell: Any) -> bool:
    """Whether a cell holds nothing: NaN and blanks are nothing."""
    return cell is None or cell != cell or (isinstance(cell, str) and not cell.strip())
