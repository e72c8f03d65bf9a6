"""Whether a terminal shows every name of a table whole."""

from __future__ import annotations

from qsbearing.documents import terminal
from qsbearing.documents.model import Badge, RowGroup, Table
from qsbearing.documents.numbers import with_minus

WIDTHS = (60, 80, 100)
shown = terminal.text_of
"""The terminal's own, whatever a test puts in its place."""


def words_of(table: Table) -> set[str]:
    """Those of headings and of columns of words, but for columns that a narrow terminal may leave out."""
    kept = [number for number in range(len(table.headings)) if number not in table.spare]
    rows = [row for row in table.rows if not isinstance(row, RowGroup)]
    cells = [row[number] for row in rows for number in kept if table.alignment[number] == "l"]
    texts = [*(table.headings[number] for number in kept), *cells]
    return {word for text in texts for word in with_minus(str(text.word if isinstance(text, Badge) else text)).split()}


def broken(table: Table, *widths: int) -> set[str]:
    """What is not there as it should be, at any of these widths."""
    lacking: set[str] = set()
    longest = max(widths) + 1
    for width in sorted(widths, reverse=True):
        if longest <= width:
            break  # as it stands at the wider one (`test_what_fits_is_laid_out_alike`)
        lines = shown([table], width).splitlines()
        longest = max(map(len, lines))
        assert longest <= width
        lacking |= words_of(table) - {word for line in lines for word in line.split()}
    return lacking
