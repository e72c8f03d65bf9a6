"""`qsbearing explain`: which effects and choices a scene calls for, and why."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

import click

from qsbearing.cli.output import UNSOLVED, note, print_table, print_text, refuse
from qsbearing.cli.scene import load, solving

if TYPE_CHECKING:
    from rich.table import Table

    from qsbearing.chooser.explain import Row


@click.command(short_help="Show which effects a scene calls for, and by how much.")
@click.argument("scene")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of a table, and nothing else.")
@click.option("--verify", is_flag=True, help="Also solve with and without each, and show what it really changes.")
@click.option(
    "--tolerance", type=float, default=0.01, show_default=True, help="The relative change below which none is needed."
)
def explain(scene: str, as_json: bool, verify: bool, tolerance: float) -> None:
    """Show for every effect and choice, named by SCENE or not, how much it matters at this operating point.

    Each has an indicator, a dimensionless number that its influence follows; what leaving it out is predicted to change
    of contact angles, loads, pressures, displacement and stiffness; how much longer a solve takes with it; and a
    verdict: needed, not needed, likely needed but without the data that it takes, or not assessed and why.

    Exit codes: 0 explained, 1 the scene has no solution, 2 bad input.
    """
    from dataclasses import replace

    from rich.text import Text

    from qsbearing.chooser.explain import explain
    from qsbearing.messages import message

    if not 0.0 < tolerance <= 1.0:
        refuse(f"--tolerance {tolerance:g}: a relative change, above 0 and at most 1 (0.01 is one per cent)")
    loaded = replace(load(scene), tolerance=None)
    with solving():
        solution, rows = explain(loaded, tolerance, verify)
    if as_json:
        found = {"status": str(solution.status), "message": message(solution), "tolerance": tolerance}
        print_text(json.dumps(found | {"effects": [vars(row) for row in rows]}, indent=1, allow_nan=False) + "\n")
    else:
        print_table(_table(rows, tolerance))
        for row in rows:
            if row.why or (row.add and row.verdict == "needed"):
                lines = f"to include it, under [effects]: {', '.join(row.add)}" if row.add else ""
                print_table(Text(f"{row.effect}: {'; '.join(each for each in (row.why, lines) if each)}"))
    if not solution.converged:
        note(message(solution))
        sys.exit(UNSOLVED)


HEADINGS = ("angles\n%", "loads\n%", "press-\nures %", "displ.\n%", "stiff-\nness %")
"""Of `QUANTITIES`, in their order."""


def _table(rows: list[Row], tolerance: float) -> Table:
    from qsbearing.effects import QUANTITIES
    from qsbearing.io.tables import plain_table

    title = f"Effects and choices: what leaving each out changes; needed above {100 * tolerance:g} %"
    table = plain_table(title, ("", "in\nscene", "indi-\ncator", "time", *HEADINGS, "verdict"), left=(0, 1, 9))
    for row in rows:
        ratio = "-" if row.time_with_over_without is None else f"x{row.time_with_over_without:.2g}"
        found = dict(row.predicted or {}) or dict.fromkeys(QUANTITIES)
        head = (row.effect, "yes" if row.in_scene else "no", _short(row.indicator), ratio)
        changes = [_short(found.get(name, 0.0), 100.0) for name in QUANTITIES]
        table.add_row(*head, *changes, row.verdict.replace(", ", ",\n"))
        if row.actual is not None:
            changes = [_short(row.actual[name], 100.0) for name in QUANTITIES]
            table.add_row("  solved", "", "", "", *changes, "", style="dim")
    return table


def _short(value: float | None, size: float = 1.0) -> str:
    """Two digits; nothing below a millionth is worth showing."""
    if value is None:
        return "-"
    return "0" if value < 1e-6 else f"{value * size:.2g}" if value * size < 100.0 else f"{value * size:.0f}"
