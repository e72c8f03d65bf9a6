"""A record as tables."""

from __future__ import annotations

from typing import Any

from rich.box import SIMPLE
from rich.console import Group
from rich.table import Table
from rich.text import Text

# The number that a quantity is shown with, and its unit.
DISPLAY = {"m": (1e6, "µm"), "Pa": (1e-6, "MPa")}


def shown(value: float, unit: str) -> tuple[float, str]:
    """A value in the unit that tables use."""
    factor, name = DISPLAY.get(unit, (1.0, "" if unit == "1" else unit))
    return value * factor, name


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
        for heading in ("reference", "found", "dev. %", "± %", "tol. %"):
            table.add_column(heading, justify="right", no_wrap=True)
        table.add_column("")
        table.add_column("")
        for row in entry["rows"]:
            if row["case"] != case:
                continue
            reference, unit = shown(row["reference"], row["unit"])
            found, _ = shown(row["found"], row["unit"])
            table.add_row(
                f"{row['quantity']} \\[{unit}]" if unit else row["quantity"],
                f"{reference:.6g}",
                f"{found:.6g}",
                f"{row['deviation_percent']:+.2g}",
                "" if row["uncertainty_percent"] is None else f"{row['uncertainty_percent']:.2g}",
                "" if row["tolerance_percent"] is None else f"{row['tolerance_percent']:.2g}",
                Text(row["verdict"], style=style.get(row["verdict"], "")),
                f"worst: {row['worst_at']}" if row["worst_at"] else "",
            )
        parts.append(table)
    return Group(*parts)
