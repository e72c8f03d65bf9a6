"""Columns as CSV text."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from io import StringIO
from typing import Any


def csv_text(columns: dict[str, Iterable[Any]]) -> str:
    """Columns of equal length under their names; a cell without a number, None or NaN, is empty."""
    text = StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in zip(*columns.values(), strict=True):
        writer.writerow("" if value != value else value for value in row)
    return text.getvalue()
