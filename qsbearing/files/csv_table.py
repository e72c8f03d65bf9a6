"""Columns as CSV, and as a spreadsheet."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from enum import StrEnum
from io import BytesIO, StringIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""With these a cell begins that spreadsheets evaluate."""

_NOT_IN_XML = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
LONGEST_CELL = 32_767
"""Characters of a spreadsheet's."""


def csv_bytes(columns: Mapping[str, NDArray | Sequence[Any]], with_headings: bool = True) -> bytes:
    """Columns of equal length under their names, as a file holds them; a cell without a number, None or NaN, is empty.

    Args:
        with_headings: whether the first line has the names.

    Text that a spreadsheet would take for a formula has an apostrophe before it; words of this program's own choices,
    such as +x, stay as they are.
    """
    text = StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    if with_headings:
        writer.writerow(columns)
    cells = [values.tolist() if isinstance(values, np.ndarray) else values for values in columns.values()]
    for row in zip(*cells, strict=True):
        writer.writerow("" if value != value else inert(value) for value in row)
    return text.getvalue().encode("utf-8")


def inert(value: Any) -> Any:
    """A cell that no spreadsheet evaluates."""
    is_formula = isinstance(value, str) and value.startswith(FORMULA) and not isinstance(value, StrEnum)
    return f"'{value}" if is_formula else value


def xlsx_bytes(columns: Mapping[str, Sequence[Any]]) -> bytes:
    """Columns of equal length under their names as a spreadsheet.

    Control characters, which it cannot hold, are spelled as in Python.
    """
    from openpyxl import Workbook

    book, data = Workbook(write_only=True), BytesIO()
    sheet = book.create_sheet()
    sheet.append([_held(name) for name in columns])
    for row in zip(*columns.values(), strict=True):
        sheet.append([_held(value) for value in row])
    book.save(data)
    return data.getvalue()


def _held(value: Any) -> Any:
    if value is None or value != value:
        return None
    if isinstance(value, bool | int | float):
        return value if abs(value) < 1e300 else str(value)
    text = _NOT_IN_XML.sub(lambda match: repr(match[0])[1:-1], str(inert(value)))
    return text[:LONGEST_CELL]
