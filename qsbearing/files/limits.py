"""How much is read of a file: what is far longer is something else, and would take all memory or hours.

Of tables also when a cell counts as empty.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from qsbearing.files.file_errors import refused

LARGEST_FILE = 1_000_000
"""Bytes of a scene, set or study; a scene takes about a thousand."""
MOST_KEYS = 10_000
"""Keys and tables of one; the largest load spectra have some thousands."""
DEEPEST_KEY = 16
"""Parts of a dotted key; a scene has six at most. The parser's time and memory grow with the square of them."""

LARGEST_RESULT = 50_000_000
"""Bytes of a result as JSON; a row of a thousand balls takes one million."""
MOST_VALUES = 2_000_000
"""Numbers, texts, lists and tables of one."""
DEEPEST_JSON = 64
"""Lists and tables within each other; a result has about ten."""

LARGEST_MODEL = 20_000_000
"""Bytes of a REXS model, packed or not; a gearbox of three shafts takes a tenth of a million."""
MOST_TAGS = 1_000_000
"""Of one as XML; as JSON it has the values of a result at most."""
MOST_MODEL_FILES = 5000
"""That are made of one: bearings times load cases."""
MOST_OF_SHAFT = 1000
"""Load cases of one, and rows and relations of each of its shafts; 3,000 rows took 19 s, 4,900 load cases 24 s."""

LARGEST_TABLE = 100_000_000
"""Bytes of a table."""
MOST_ROWS = 1_000_000
MOST_COLUMNS = 500
MOST_CELLS = 10_000_000
LARGEST_SHEET = 20_000_000
"""Bytes of an .xlsx file."""
MOST_SHEET_CELLS = 1_000_000
"""Of a sheet of an .xlsx file, which takes ten times as long to read as .csv."""
LONGEST_CELL = 10_000
"""Characters of a text."""


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
