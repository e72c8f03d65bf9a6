"""Readings of a single case as tables for people."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.files.file_keys import reading_keys
from qsbearing.files.printed_numbers import is_printed
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import Place, Result, printed_unit
from qsbearing.readings.asked import READINGS
from qsbearing.results.tables import digits_of

NOISE = 1e-12
"""Below this part of the largest of its kind a number is rounding, and shown as zero."""


def readings_tables(readings: Mapping[str, Any], scene: Scene) -> list[Block]:
    """Tables of each reading: numbers of the bearing; of the contacts' numbers the smallest and the largest.

    Args:
        scene: that asks for them; beside a number that it may give stands whether it does.
    """
    parts: list[Block] = []
    for name, reading in readings.items():
        title = name.replace("_", " ").capitalize()
        of_bearing = _of_bearing(title, name, reading, scene)
        of_contacts = per_contact(title, READINGS[name].values(reading))
        if of_bearing and of_contacts:
            whose = "contacts" if READINGS[name].of_contact else "balls"
            of_contacts = replace(of_contacts, caption=f"{title}: {whose}")
        parts += [table for table in (of_bearing, of_contacts) if table]
        parts += [Paragraph(READINGS[name].scope)] if READINGS[name].scope else []
        for model in getattr(reading, "models", ()):
            what = f"{model.name}: the torque contains {model.contains}. It does not contain {model.lacks}."
            use = f"Range of validity: {model.range}. Its heat can be used for {model.heat}."
            parts.append(Paragraph(f"{what} {use}"))
    return parts


def _of_bearing(title: str, name: str, reading: Any, scene: Scene) -> Table | None:
    rows = [
        (f"{place.result.plain_name}{_origin(name, place.result, scene)}", digits_of(values), printed_unit(place.unit))
        for place, values in READINGS[name].values(reading)
        if not place.is_per_ball and values is not None
    ]
    if not rows:
        return None
    return Table(("quantity", "value", "unit"), rows, "lrl", title)


def _origin(name: str, result: Result, scene: Scene) -> str:
    """Of a number that a scene may give or leave to the geometry: which, in brackets; of others nothing."""
    key = next((each for each in reading_keys(name) if each.name == result.key), None)
    if key is None:
        return ""
    value = scene.readings.get(name, {}).get(key.field)
    if value is None:
        return " (from the geometry)"
    return " (catalogue)" if is_printed(scene.bearing, name, key.name, key.in_file(value)) else " (given)"


def per_contact(title: str, placed: Iterable[tuple[Place, NDArray | None]]) -> Table | None:
    """Of results of contacts or balls the smallest and the largest; None where there are none."""
    cells: dict[Result, dict[str, NDArray]] = {}
    for place, values in placed:
        if place.is_per_ball and values is not None and np.isfinite(values).any():
            cells.setdefault(place.result, {})[place.group.raceway or "ball"] = values
    if not cells:
        return None
    sides = [side for side in ("inner", "outer", "ball") if any(side in row for row in cells.values())]
    heading = [cell for side in sides for cell in (f"{side}\nsmallest", f"{side}\nlargest")]
    rows = []
    for result, row in cells.items():
        name = result.plain_name
        if result.is_signed and not _are_alike(row.values()) and any((values < 0.0).any() for values in row.values()):
            name, row = f"{name}, size", {side: np.abs(values) for side, values in row.items()}
        largest = max(float(np.nanmax(np.abs(values))) for values in row.values())
        spans = [_span(row[side], NOISE * largest) if side in row else ("", "") for side in sides]
        rows.append((name, spans, printed_unit(result.unit)))
    if not any(high for _, spans, _ in rows for _, high in spans):  # all balls are alike
        cells_of = [(name, *(low for low, _ in spans), unit) for name, spans, unit in rows]
        return Table(("quantity", *sides, "unit"), cells_of, f"l{'r' * len(sides)}l", title)
    cells_of = [(name, *(cell for span in spans for cell in span), unit) for name, spans, unit in rows]
    return Table(("quantity", *heading, "unit"), cells_of, f"l{'r' * len(heading)}l", title)


def _are_alike(row: Iterable[NDArray]) -> bool:
    """Whether each side's balls have one number, to the digits shown."""
    return all(digits_of(np.nanmin(values)) == digits_of(np.nanmax(values)) for values in row)


def _span(values: NDArray, noise: float) -> tuple[str, str]:
    """The smallest and the largest; one where they are the same to the digits shown."""
    values = np.where(np.abs(values) < noise, 0.0, values)
    low, high = digits_of(np.nanmin(values)), digits_of(np.nanmax(values))
    return (low, "") if low == high else (low, high)
