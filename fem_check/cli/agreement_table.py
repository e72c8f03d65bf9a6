"""A record as tables."""

from __future__ import annotations

from typing import Any

from rich.box import SIMPLE
from rich.console import Group
from rich.table import Table
from rich.text import Text

from fem_check import row_text


def agreement_table(entry: dict[str, Any]) -> Group:
    """A record as tables, one per case."""
    style = {"pass": "green", "fail": "bold red"}
    parts: list[Any] = [
        Text.assemble(
            (f"{entry['check']} ({entry['level']}): ", "bold"),
            (entry["verdict"], style[entry["verdict"]]),
            f"   {entry['seconds']:.1f} s, {entry['peak_memory_MB']} MB"
            + (f", {entry['mesh']['dofs']} unknowns, {entry['solver']}" if entry["mesh"].get("dofs") else ""),
        )
    ]
    for case in dict.fromkeys(row["case"] for row in entry["rows"]):
        table = Table(title=case, title_justify="left", box=SIMPLE, padding=(0, 1), pad_edge=False)
        table.add_column("", no_wrap=True)
        for heading in ("reference", "found", "dev. %", "± %", "tolerance"):
            table.add_column(heading, justify="right", no_wrap=True)
        table.add_column("")
        table.add_column("")
        for row in entry["rows"]:
            if row["case"] != case:
                continue
            unit = row_text.in_unit(row)[1]
            table.add_row(
                f"{row['quantity']} \\[{unit}]" if unit else row["quantity"],
                *row_text.of_row(row),
                Text(row["verdict"], style=style.get(row["verdict"], "")),
                f"worst: {row['worst_at']}" if row["worst_at"] else "",
            )
        parts.append(table)
    return Group(*parts)
