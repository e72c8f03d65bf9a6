"""The report's section on what accuracy costs, from the cost record."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from fem_check import records_store
from fem_check.cost import picture, table

HEAD = """## What accuracy costs

One contact whose exact solution is Hertz. `fem-check contact --accuracy` chooses its mesh from these numbers.
"""
PICTURE = "cost.png"


def section(record: dict[str, Any], pictures: Path, link: str) -> list[str]:
    """Paragraphs of the section; its picture is drawn into a folder and linked to as `link`/name."""
    pictures.mkdir(parents=True, exist_ok=True)
    records_store.replace(pictures / PICTURE, picture.png(record))
    return [
        HEAD,
        f"![Error against time, by element family and mesh]({link}/{PICTURE})\n",
        f"{table.remark(record)}\n",
        f"{table.mesh_choices(record).markdown()}\n",
        f"{table.measured(record).markdown()}\n",
    ]
