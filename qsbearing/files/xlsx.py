"""Rows of the first sheet of an .xlsx file, a zipped folder of XML, which is measured before it is parsed."""

from __future__ import annotations

import re
import warnings
from io import BytesIO
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused
from qsbearing.files.limits import LONGEST_CELL, MOST_COLUMNS, MOST_SHEET_CELLS
from qsbearing.files.zip_file import pieces, unzipped

MOST_PARTS = 1000
"""Files within the folder; a workbook has some tens."""
MOST_TAGS = 8 * MOST_SHEET_CELLS
"""A cell takes four to six."""
LARGEST_PART = 40 * MOST_TAGS
"""Bytes of all parts unpacked."""
_ENTRY = b"PK\x01\x02"
_DECLARES = re.compile(rb"<!(?:DOCTYPE|ENTITY)")


def rows_of_xlsx(data: bytes, path: Path) -> list[list[Any]]:
    """The cells of each row, by their stored values.

    Raises:
        SceneFileError: it is too large, or has formulas without a value. Of damaged files also other exceptions.
    """
    _measure(data, path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rows = _rows(data, path, True)
        widest = max(map(len, rows), default=0)
        if any(len(row) < widest or None in row for row in rows):
            _find_formula(rows, data, path)
    return rows


def _rows(data: bytes, path: Path, of_values: bool) -> list[list[Any]]:
    from openpyxl import load_workbook

    book = load_workbook(BytesIO(data), read_only=True, data_only=of_values, keep_links=False)
    sheet = book.worksheets[0]
    sheet.reset_dimensions()  # those of the file may be wrong, and are filled up with empty cells
    rows: list[list[Any]] = []
    count = 0
    for row in sheet.iter_rows(values_only=True):
        cells = list(row)
        while cells and cells[-1] is None:
            cells.pop()
        count += len(cells)
        if len(cells) > MOST_COLUMNS:
            raise refused(path, f"row {len(rows) + 1} reaches column {len(cells):,}; {MOST_COLUMNS:,} are read")
        if count > MOST_SHEET_CELLS:
            raise _too_large(path)
        if any(isinstance(cell, str) and len(cell) > LONGEST_CELL for cell in cells):
            raise refused(path, f"a cell has more than {LONGEST_CELL:,} characters")
        rows.append(cells)
    book.close()
    return rows


def _measure(data: bytes, path: Path) -> None:
    """See that unpacking and parsing end soon; a bomb of some kilobytes unpacks to gigabytes."""
    if data.count(_ENTRY) > MOST_PARTS:
        raise refused(path, f"has more than {MOST_PARTS:,} parts; a workbook has some tens")
    tags = size = 0
    with unzipped(data, path) as folder:
        read = [part for part in folder.infolist() if part.filename.endswith((".xml", ".rels"))]
        for piece in pieces(folder, read, path):
            tags += piece.count(b"<")
            size += len(piece)
            if _DECLARES.search(piece):
                raise refused(path, "declares entities, which no spreadsheet writes")
            if tags > MOST_TAGS or size > LARGEST_PART:
                raise _too_large(path)


def _too_large(path: Path) -> Exception:
    cause = "As .csv or .parquet more is read. Formatted cells count too, even empty ones"
    return refused(path, f"has more than {MOST_SHEET_CELLS:,} cells, the most that are read of .xlsx", cause)


def _find_formula(rows: list[list[Any]], data: bytes, path: Path) -> None:
    """End where a cell without a value has a formula: a program wrote it, and no spreadsheet has worked it out."""
    for number, written in enumerate(_rows(data, path, False), 1):
        known = rows[number - 1] if number <= len(rows) else []
        for place, cell in enumerate(written):
            if isinstance(cell, str) and cell.startswith("=") and (place >= len(known) or known[place] is None):
                problem = f"row {number}, column {place + 1} holds the formula {cell[:40]} without its value"
                raise refused(path, problem, "Open the file in a spreadsheet once and save it")
