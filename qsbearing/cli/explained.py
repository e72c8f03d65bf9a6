"""Explained effects as a table for people, with what to write to include what is needed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

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


def predicted_table(rows: Sequence[Row], tolerance: float) -> Table:
    """What indicators predict, and where it was found by solving, that below it."""
    from qsbearing.effects import QUANTITIES
    from qsbearing.io.tables import plain_table

    title = f"Effects and choices: what leaving each out changes; needed above {100 * tolerance:g} %"
    table = plain_table(title, ("", "in\nscene", "indi-\ncator", "time", *HEADINGS, "verdict"), left=(0, 1, 9))
    for row in rows:
        ratio = "-" if row.time_with_over_without is None else f"x{row.time_with_over_without:.2g}"
        head = (row.effect, "yes" if row.in_scene else "no", _short(row.indicator), ratio)
        table.add_row(*head, *_changes(row.predicted), row.verdict.replace(", ", ",\n"))
        if row.actual is not None:
            changes = (_short(row.actual[name], 100.0) for name in QUANTITIES)
            table.add_row("  solved", "", "", "", *changes, "", style="dim")
    return table


def found_table(rows: Sequence[Row], tolerance: float) -> Table:
    """What was found by solving with and without each."""
    from qsbearing.io.tables import plain_table

    title = f"Effects and choices: what leaving each out is found to change; needed above {100 * tolerance:g} %"
    table = plain_table(title, ("", "in\nscene", *HEADINGS, "verdict"), left=(0, 1, 7))
    for row in rows:
        found = row.actual if row.actual is not None else row.predicted
        table.add_row(row.effect, "yes" if row.in_scene else "no", *_changes(found), row.verdict.replace(", ", ",\n"))
    return table


def _changes(found: dict[str, Any] | None) -> list[str]:
    """In per cent; a quantity that is not named does not change."""
    from qsbearing.effects import QUANTITIES

    return [_short(None if not found else found.get(name, 0.0), 100.0) for name in QUANTITIES]


def _short(value: float | None, size: float = 1.0) -> str:
    """Two digits; nothing below a millionth is worth showing."""
    if value is None:
        return "-"
    return "0" if value < 1e-6 else f"{value * size:.2g}" if value * size < 100.0 else f"{value * size:.0f}"
