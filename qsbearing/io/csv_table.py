"""Columns as CSV."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from enum import StrEnum
from io import StringIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""With these a cell begins that spreadsheets evaluate."""


def csv_bytes(columns: Mapping[str, NDArray | Sequence[Any]]) -> bytes:
    """Columns of equal length under their names, as a file holds them; a cell without a number, None or NaN, is empty.

    Text that a spreadsheet would take for a formula has an apostrophe before it; words of this program's own choices,
    such as +x, stay as they are.
    """
    text = StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    cells = [values.tolist() if isinstance(values, np.ndarray) else values for values in columns.values()]
    for row in zip(*cells, strict=True):
        writer.writerow("" if value != value else inert(value) for value in row)
    return text.getvalue().encode("utf-8")


def inert(value: Any) -> Any:
    """A cell that no spreadsheet evaluates."""
    is_formula = isinstance(value, str) and value.startswith(FORMULA) and not isinstance(value, StrEnum)
    return f"'{value}" if is_formula else value
