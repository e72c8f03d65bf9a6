"""A record as tables."""

from __future__ import annotations

from typing import Any

from rich.console import Group
from rich.text import Text

from fem_check import row_text
from fem_check.cli.output import VERDICT
from qsbearing.io.tables import plain_table


def agreement_table(entry: dict[str, Any]) -> Group:
    """A record as tables, one per case."""
    parts: list[Any] = [
        Text.assemble(
            (f"{entry['check']} ({entry['level']}): ", "bold"),
            (entry["verdict"], VERDICT[entry["verdict"]]),
            f"   {entry['seconds']:.1f} s, {entry['peak_memory_MB']} MB"
            + (f", {entry['mesh']['dofs']} unknowns, {entry['solver']}" if entry["mesh"].get("dofs") else ""),
        )
    ]
    for case in dict.fromkeys(row["case"] for row in entry["rows"]):
        rows = [row for row in entry["rows"] if row["case"] == case]
        table = plain_table(case, ("", "reference", "found", "deviation %", "tolerance", ""), left=(0, 5))
        table.columns[0].no_wrap, table.columns[0].overflow = False, "fold"
        for row in rows:
            told, unit = row_text.of_row(row), row_text.in_unit(row)[1]
            name = Text(row["quantity"] + (f", {unit}" if unit else ""))
            verdict = Text(row["verdict"], style=VERDICT.get(row["verdict"], ""))
            table.add_row(name, told.reference, told.found, row_text.deviation(row), told.tolerance, verdict)
        parts += [Text(), table]
        parts += [Text(f"{row['quantity']}: worst at {row['worst_at']}") for row in rows if row["worst_at"]]
    return Group(*parts)
