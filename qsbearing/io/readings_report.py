"""Readings of a single case as tables for people."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io.tables import plain_table
from qsbearing.readings.shown import ball_values, case_values

UNITS = {
    "Mrev": "million rev", "m_s": "m/s", "MPa_m_s": "MPa m/s", "N": "N", "h": "h", "Hz": "Hz", "rpm": "rpm", "um": "um",
    "mm": "mm", "MPa": "MPa", "W": "W", "Nmm": "Nmm", "deg": "deg",
}  # fmt: skip


NOISE = 1e-12
"""Below this part of the largest of its kind a number is rounding, and shown as zero."""


def readings_tables(readings: Mapping[str, Any]) -> list[RenderableType]:
    """Tables of each reading: numbers of the bearing; of the contacts' numbers the least and the largest."""
    parts: list[RenderableType] = []
    for name, reading in readings.items():
        title = name.replace("_", " ").capitalize()
        tables = [table for table in (_of_bearing(title, name, reading), _of_contacts(title, name, reading)) if table]
        parts += [Padding(table, (1, 0, 0, 0)) for table in tables]
        parts += [Text.assemble(("Warning: ", "bold yellow"), each) for each in getattr(reading, "warnings", ())]
    return parts


def _of_bearing(title: str, name: str, reading: Any) -> Table | None:
    found = [(key, values) for key, values in case_values(name, reading) if values is not None]
    if not found:
        return None
    table = plain_table(title, ("", "", ""), left=(0, 2))
    for key, values in found:
        words, unit = _words(key)
        table.add_row(words, _text(values), unit)
    return table


def _of_contacts(title: str, name: str, reading: Any) -> Table | None:
    cells: dict[str, dict[str, NDArray]] = {}
    for side, key, values in ball_values(name, reading):
        if values is not None and np.isfinite(values).any():
            cells.setdefault(key, {})[side or "ball"] = values
    if not cells:
        return None
    sides = [side for side in ("inner", "outer", "ball") if any(side in row for row in cells.values())]
    heading = [cell for side in sides for cell in (side, "to")]
    table = plain_table(f"{title}: of the balls the least to the largest", ("", *heading, ""), (0, 1 + len(heading)))
    for key, row in cells.items():
        words, unit = _words(key)
        largest = max(float(np.nanmax(np.abs(values))) for values in row.values())
        spans = [_span(row[side], NOISE * largest) if side in row else ("", "") for side in sides]
        table.add_row(words, *(cell for span in spans for cell in span), unit)
    return table


def _span(values: NDArray, noise: float) -> tuple[str, str]:
    """The least and the largest; one where they are the same to the digits shown."""
    values = np.where(np.abs(values) < noise, 0.0, values)
    if not np.isfinite(values).any():
        return "-", ""
    low, high = _text(np.nanmin(values)), _text(np.nanmax(values))
    return (low, "") if low == high else (low, high)


def _text(value: Any) -> str:
    return "-" if not np.isfinite(value) else f"{float(value) + 0.0:.5g}"


def _words(key: str) -> tuple[str, str]:
    """A key as words, and its unit."""
    for ending, unit in UNITS.items():
        if key.endswith(f"_{ending}"):
            if ending == "m_s" and key.endswith("_MPa_m_s"):
                continue
            return key.removesuffix(f"_{ending}").replace("_", " "), unit
    return key.replace("_", " "), ""
