"""What the scene says: every number in the field's units, with the source of a catalogue's; the file as read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import Any

from qsbearing.documents.model import Block, Code, Group, Paragraph, Section, Table
from qsbearing.io import catalogue
from qsbearing.io.bearing_table import MODIFIED
from qsbearing.io.scene_file import load_scene
from qsbearing.scene.bearing import BallBearing
from qsbearing.scene.keys import (
    BEARING,
    EFFECT_TABLES,
    EFFECTS,
    MATERIAL,
    MATERIALS,
    OPERATION,
    PRELOAD,
    READING_TABLES,
    Key,
)
from qsbearing.scene.scene import CHOICES, Scene

Line = tuple[str, str, str, str]
FOLLOWS = {
    "diametral_clearance_mm": "follows from the free contact angle",
    "free_contact_angle_deg": "follows from the clearance",
}
"""Of a catalogue entry, which gives one of the two."""
HEADINGS = ("key of a scene file", "value", "unit", "from")


def section(scene: Scene, source: str) -> Section:
    """All of the input.

    Args:
        source: the text of the scene file; empty for an example of the catalogue.
    """
    rows: list[Line | Group] = []
    for title, lines in (
        ("Bearing", bearing_lines(scene.bearing, "scene")),
        ("Operation", numbers(OPERATION, scene.operation)),
        ("Preload", numbers(PRELOAD, scene.preload)),
        ("Effects and choices", [*effect_lines((*scene.ring_effects, *scene.ball_effects)), *choice_lines(scene)]),
        ("Readings", reading_lines(scene.readings)),
    ):
        if lines:
            rows += [Group(title), *lines]
    words = (
        "Every number that the solution rests on, in the units and by the keys of a scene file. A channel of the ring "
        "that is not named carries no load and is free to move."
    )
    blocks: list[Block] = [Paragraph(words), Table(HEADINGS, rows, "lrll")]
    if source:
        blocks += [Paragraph("The scene file as it was read:"), Code(source.rstrip("\n"), "toml")]
    return Section("Input", blocks)


def bearing_lines(bearing: BallBearing, given_by: str) -> list[Line]:
    """A bearing and its materials.

    Args:
        given_by: a word for where numbers come from that are not a catalogue's.
    """
    entry = catalogue.find((bearing.name or "").removesuffix(MODIFIED))
    published = None if entry is None else load_scene(entry.name).bearing

    def origin(key: str, same: bool) -> str:
        """Of a number: the catalogue's source where it is the catalogue's number."""
        if entry is None or not same:
            return given_by
        return entry.provenance.get(key) or FOLLOWS.get(key, "")

    found: list[Line] = [("name", bearing.name or "-", "", ""), ("kind", str(bearing.kind), "", "")]
    found += [
        (*line[:3], origin(line[0], published is not None and line in numbers(BEARING, published)))
        for line in numbers(BEARING, bearing)
    ]
    for material in MATERIALS:
        same = published is not None and getattr(published, material) == getattr(bearing, material)
        lines = numbers(MATERIAL, getattr(bearing, material))
        found += [(f"{material}.{line[0]}", *line[1:3], origin(material, same)) for line in lines]
    if entry is not None:
        found.append(("catalogue entry", entry.name, "", entry.source))
    return found


def effect_lines(effects: Iterable[Any]) -> list[Line]:
    """Effects with their numbers and choices."""
    found: list[Line] = []
    for effect in effects:
        found.append((effect.name, "on", "", ""))
        for each in fields(effect):
            value = getattr(effect, each.name)
            key = _key(EFFECT_TABLES.get(effect.name, EFFECTS), each.name)
            if value is not None and key is not None:
                found.append((f"{effect.name}.{key.name}", _text(key.in_file(float(value))), key.unit, ""))
            elif value is not None and isinstance(value, str):
                found.append((each.name, str(value), "", ""))
    return found


def choice_lines(holder: Any) -> list[Line]:
    """What a scene or set chooses among several models."""
    return [(name, str(getattr(holder, name)), "", "") for name in CHOICES if getattr(holder, name) is not None]


def reading_lines(asked: Mapping[str, Mapping[str, Any]]) -> list[Line]:
    """Asked for, with their numbers; those of no key of a file in SI, as Python has them."""
    found: list[Line] = []
    for name, arguments in asked.items():
        found.append((name, "asked for", "", ""))
        for key, value in arguments.items():
            if isinstance(value, float | int | str) and not isinstance(value, bool):
                known = None if isinstance(value, str) else _key(READING_TABLES.get(name, ()), key)
                text = value if isinstance(value, str) else _text(known.in_file(value) if known else value)
                unit = known.unit if known else "" if isinstance(value, str) else "SI"
                found.append((f"{name}.{known.name if known else key}", text, unit, ""))
    return found


def numbers(keys: tuple[Key, ...], holder: Any) -> list[Line]:
    """The numbers that an object holds, by the keys of a scene file."""
    found = []
    for key in keys:
        value = getattr(holder, key.field, None)
        if value is not None:
            found.append((key.name, _text(key.in_file(float(value))), key.unit, ""))
    return found


def _key(keys: tuple[Key, ...], field: str) -> Key | None:
    return next((key for key in keys if key.field == field), None)


def _text(value: float) -> str:
    return f"{value:.9g}"
