"""Rows of CSV: with commas between the cells, or with semicolons, as spreadsheets of half the world write it.

Between semicolons a number may have a decimal comma or point. A file that never shows which is refused where it
matters: 10.000 is ten to one half of the world and ten thousand to the other.
"""

from __future__ import annotations

import csv
import re
from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused
from qsbearing.files.limits import LONGEST_CELL, MOST_CELLS, MOST_ROWS

_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}([.,])\d{3}(?:\1\d{3})*", re.ASCII)
"""What may be whole with separators of thousands; with one of them only, it may be decimals too."""
_GROUPED = {
    mark: re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:{re.escape(mark)}\d{{3}})+(?:{re.escape(other)}\d*)?", re.ASCII)
    for mark, other in ((".", ","), (",", "."))
}
"""A whole number with separators of thousands, and perhaps decimals after the other mark."""
_NUMBER = re.compile(r"[+-]?[\d.,]+(?:[eE][+-]?\d+)?", re.ASCII)
OTHER = {",": ".", ".": ","}


def rows_of_csv(text: str, path: Path, texts: tuple[str, ...], decimal: str | None) -> list[list[Any]]:
    """Headings and cells, numbers with a decimal point; blank lines are left out.

    Args:
        texts: headings, in small letters, of columns that hold no numbers.
        decimal: "," or "."; None: as the file shows.

    Raises:
        SceneFileError: it is too large, no CSV, or its decimals are ambiguous.
    """
    if "\0" in text:
        raise refused(path, "is not text: it holds null characters", "Is it a spreadsheet's own file? Save it as CSV")
    first = next((line for line in text.splitlines() if line.strip()), "")
    separator = ";" if _count(first, ";") > _count(first, ",") else ","
    if text.count("\n") > 2 * MOST_ROWS or text.count(separator) > MOST_CELLS:
        raise refused(path, f"has more than {MOST_ROWS:,} rows or {MOST_CELLS:,} cells, the most that are read")
    try:
        reader = csv.reader(text.splitlines(keepends=True), delimiter=separator, strict=True)
        rows: list[list[Any]] = [row for row in reader if any(map(str.strip, row))]
    except csv.Error as error:
        raise refused(path, f"is not CSV: {error}", "A quotation mark that is not closed?") from None
    if any(len(cell) > LONGEST_CELL for row in rows for cell in row):
        raise refused(path, f"a cell has more than {LONGEST_CELL:,} characters")
    if not rows:
        return rows
    places = [i for i, heading in enumerate(rows[0]) if heading.strip().lower() not in texts]
    if separator == "," and decimal is None:
        decimal = "."
    marked = [row[i] for row in rows[1:] for i in places if i < len(row) and ("," in row[i] or "." in row[i])]
    if not marked:
        return rows
    mark = decimal or _mark_shown(marked, path)
    if separator == "," and mark == ".":
        return rows
    for row in rows[1:]:
        for i in places:
            if i < len(row):
                row[i] = _with_point(row[i].strip(), mark)
    return rows


def _count(line: str, mark: str) -> int:
    """Outside quotation marks."""
    return sum(part.count(mark) for part in line.split('"')[::2])


def _mark_shown(cells: list[str], path: Path) -> str:
    """What stands before decimals, by the cells that leave no doubt."""
    shown: dict[str, str] = {}
    for cell in cells:
        text = cell.strip()
        if not _NUMBER.fullmatch(text):
            continue
        marks = [letter for letter in text if letter in ",."]
        if len(set(marks)) == 2:
            shown.setdefault(marks[-1], text)
        elif not _THOUSANDS.fullmatch(text):
            shown.setdefault(marks[0], text)
        elif len(marks) > 1:
            shown.setdefault(OTHER[marks[0]], text)
    if len(shown) == 1:
        return next(iter(shown))
    say = "--decimal , or --decimal . says which"
    if shown:
        problem = f"has decimals after a comma, {shown[','][:30]}, and after a point, {shown['.'][:30]}"
        raise refused(path, problem, say)
    text = next((cell.strip() for cell in cells if _THOUSANDS.fullmatch(cell.strip())), "")
    if not text:
        return "."  # no number among them
    whole, part = re.sub("[,.]", "", text), re.sub("[,.]", ".", text)
    problem = f"{text} may be {whole} or {part}: no cell shows what stands before the decimals"
    raise refused(path, problem, say)


def _with_point(text: str, mark: str) -> str:
    """A number with these decimals as Python writes it; what is none stays as it is."""
    other = OTHER[mark]
    if _GROUPED[other].fullmatch(text):
        text = text.replace(other, "")
    elif other in text:
        return f"{text} (decimals after {'a comma' if mark == ',' else 'a point'})"
    return text.replace(mark, ".")
