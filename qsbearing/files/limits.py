"""How much is read of a file: what is far longer is something else, and would take all memory or hours."""

from __future__ import annotations

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
