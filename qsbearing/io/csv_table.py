"""A solution as CSV text: the columns of `to_dataframe`, a cell without a number empty."""

from __future__ import annotations

import csv
from io import StringIO

from qsbearing.columns import columns
from qsbearing.solution import Solution


def csv_text(solution: Solution) -> str:
    """One row per ball, units in the headings; the ring's values follow on every row, so that files can be stacked."""
    found = columns(solution)
    text = StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(found)
    for row in zip(*(values.tolist() for values in found.values()), strict=True):
        writer.writerow("" if value != value else value for value in row)
    return text.getvalue()
