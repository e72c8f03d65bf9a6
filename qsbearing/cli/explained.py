"""Explained effects as a table for people, with what to write to include what is needed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import RenderableType
    from rich.table import Table

    from qsbearing.chooser.explain import Row

HEADINGS = ("angles\n%", "loads\n%", "press-\nures %", "displ.\n%", "stiff-\nness %")
"""Of `QUANTITIES`, in their order."""


def remarks(rows: Sequence[Row]) -> list[RenderableType]:
    """Why a verdict cannot be given, and how to include what is needed."""
    from rich.text import Text

    said: list[RenderableType] = []
    for row in rows:
        if row.why or (row.add and row.verdict == "needed"):
            lines = f"to include it, under [effects]: {', '.join(row.add)}" if row.add else ""
            said.append(Text(f"{row.effect}: {'; '.join(each for each in (row.why, lines) if each)}"))
    return said


def table(rows: Sequence[Row], tolerance: float) -> Table:
    """What leaving each out changes, found by solving; estimated, with ≈, where its parameters are not known."""
    from qsbearing.chooser.explain import two_digits
    from qsbearing.effects import QUANTITIES
    from qsbearing.io.tables import plain_table

    title = f"Effects and choices: what leaving each out changes (≈ estimated); needed above {100 * tolerance:g} %"
    is_timed = any(row.time_with_over_without is not None for row in rows)  # those of a set are not
    headings = ("", "in\nscene", *(("indi-\ncator", "time") if is_timed else ()), *HEADINGS, "verdict")
    found = plain_table(title, headings, left=(0, 1, len(headings) - 1))
    for row in rows:
        ratio = two_digits(row.time_with_over_without)
        cells = (two_digits(row.indicator), "-" if ratio == "-" else f"x{ratio}") if is_timed else ()
        changes = map(row.change, QUANTITIES)
        found.add_row(row.effect, "yes" if row.in_scene else "no", *cells, *changes, row.verdict.replace(", ", ",\n"))
    return found
