"""The report's section on what accuracy costs, from the cost record."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fem_check import records_store
from fem_check.cost import figures, tables

HEAD = """## What accuracy costs

Measured by `fem-check cost` on one contact, whose exact solution is Hertz. `fem-check contact --accuracy` chooses its
mesh from these numbers.
"""


def section(record: dict[str, Any], pictures: Path, link: str) -> list[str]:
    """Paragraphs of the section; its pictures are drawn into a folder and linked to as `link`/name."""
    pictures.mkdir(parents=True, exist_ok=True)
    parts = [HEAD]
    for name, (draw, caption) in figures.FIGURES.items():
        file = f"cost-{name}.png"
        records_store.replace(pictures / file, figures.png(draw(record)))
        parts.append(f"![{caption}]({link}/{file})\n")
    parts += [f"{remark}\n" for remark in tables.remarks(record)]
    parts += [tables.markdown(make(record)) + "\n" for make in tables.TABLES]
    return parts
