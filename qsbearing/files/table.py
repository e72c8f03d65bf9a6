"""A table as columns under their headings: .csv, .xlsx or .parquet; an empty cell is None."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qsbearing.documents.installation import pip_install
from qsbearing.files.csv_rows import rows_of_csv
from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.limits import LARGEST_SHEET, LARGEST_TABLE, check_size, is_empty
from qsbearing.files.raw import decoded, read_bytes

ENDINGS = (".csv", ".xlsx", ".parquet")
Columns = dict[str, list[Any]]


def read_table(path: Path, texts: tuple[str, ...] = (), decimal: str | None = None) -> Columns:
    """The columns of a file.

    Args:
        texts: headings, in small letters, of columns whose cells are no numbers.
        decimal: what stands before the decimals in a .csv file, "," or "."; None: as the file shows.

    Raises:
        SceneFileError: it cannot be read, is too large, or is no table.
    """
    ending = path.suffix.lower()
    if ending not in ENDINGS:
        raise refused(path, f"the name must end in one of {', '.join(ENDINGS)}")
    data = read_bytes(path, LARGEST_SHEET if ending == ".xlsx" else LARGEST_TABLE, f"a table {ending}")
    if not data:
        raise refused(path, "is empty")
    try:
        if ending == ".parquet":
            from qsbearing.files.parquet import columns_of_parquet

            return _checked(columns_of_parquet(data, path), path)
        if ending == ".xlsx":
            from qsbearing.files.xlsx import rows_of_xlsx

            rows = rows_of_xlsx(data, path)
        else:
            rows = rows_of_csv(decoded(data, path), path, texts, decimal)
    except ImportError as error:
        raise refused(path, f"needs {error.name or 'a package'} to be read", pip_install("tables")) from None
    except (SceneFileError, MemoryError):
        raise
    except Exception as error:  # of damaged bytes the packages raise almost anything
        told = str(error).partition("\n")[0][:200] or type(error).__name__
        raise refused(path, f"cannot be read: {told}", f"Is it a damaged file, or not {ending}?") from None
    return _checked(_columns(rows, path), path)


def _columns(rows: list[list[Any]], path: Path) -> Columns:
    """Below a first row of headings; cells and columns at the end that are empty throughout are none."""
    rows = [_cut(row) for row in rows]
    while rows and not rows[-1]:
        rows.pop()
    if not rows:
        raise refused(path, "is empty")
    headings = ["" if cell is None else str(cell).strip() for cell in rows.pop(0)]
    check_size(path, len(rows), len(headings))
    for number, row in enumerate(rows, 1):
        if len(row) > len(headings):
            problem = f"row {number} has {len(row):,} cells, but {len(headings):,} columns have a heading"
            raise refused(path, problem, "Is a heading missing, or are there decimal commas between commas?")
    twice = [name for name in dict.fromkeys(headings) if headings.count(name) > 1]
    if twice or "" in headings:
        raise refused(path, "a column has no heading" if "" in headings else f"two columns {twice[0][:60]}")
    width = range(len(headings))
    full = [row + [None] * (len(headings) - len(row)) for row in rows]
    return {headings[i]: [row[i] for row in full] for i in width}


def _cut(row: list[Any]) -> list[Any]:
    cells = [None if is_empty(cell) else cell for cell in row]
    while cells and cells[-1] is None:
        cells.pop()
    return cells


def _checked(columns: Columns, path: Path) -> Columns:
    count = len(next(iter(columns.values()), []))
    if not count:
        raise refused(path, "has no rows below the headings" if columns else "is empty")
    return columns
