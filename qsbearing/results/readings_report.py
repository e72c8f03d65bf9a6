"""Readings of a single case as tables for people."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.files.file_keys import reading_keys
from qsbearing.files.printed_numbers import is_printed
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import Result, printed_unit
from qsbearing.readings.asked import READINGS
from qsbearing.results.contact_table import per_contact
from qsbearing.results.tables import digits_of


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
