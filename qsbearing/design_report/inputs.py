"""What the scene says: every number in the field's units, with the source of a catalogue's; the file as read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Code, Group, Paragraph, Section, Table
from qsbearing.effects import ElasticRings, RingExpansion
from qsbearing.io import catalogue
from qsbearing.io.bearing_table import MODIFIED
from qsbearing.io.file_keys import reading_tables
from qsbearing.io.scene_file import load_scene
from qsbearing.io.tables import digits_of
from qsbearing.io.thermal_keys import BY_NODE, CONDUCTANCE, OIL, THERMAL, WORDS
from qsbearing.material import BY_NAME, Material
from qsbearing.result_keys import printed_unit
from qsbearing.scene.bearing import BallBearing
from qsbearing.scene.keys import BEARING, EFFECTS, MATERIAL, MATERIALS, NUMBERS, OPERATION, PRELOAD, SEATS, Key
from qsbearing.scene.scene import CHOICES, Scene
from qsbearing.thermal.network import Thermal
from qsbearing.units import zero_celsius
from qsbearing.validation import printable

Line = tuple[str, str, str, str]
FOLLOWS = {
    "diametral_clearance_mm": "follows from the free contact angle",
    "free_contact_angle_deg": "follows from the clearance",
}
"""Of a catalogue entry, which gives one of the two."""
ELASTIC = {field: key for key, field in SEATS.items()}
"""Keys of what elastic rings touch, by its field."""
HEADINGS = ("key of a scene file", "value", "unit", "from")


def section(scene: Scene, source: str, heat: Thermal | None = None) -> Section:
    """All of the input.

    Args:
        source: the text of the scene file; empty for an example of the catalogue.
        heat: [thermal] as given; the scene has the temperatures that were found.
    """
    rows = grouped(
        ("Bearing", bearing_lines(scene.bearing, "scene")),
        ("Operation", numbers(OPERATION, scene.operation)),
        ("Preload", numbers(PRELOAD, scene.preload)),
        (
            "Effects and choices",
            [*effect_lines((*scene.ring_effects, *scene.ball_effects), heat), *choice_lines(scene)],
        ),
        ("Readings", reading_lines(scene.readings)),
        *thermal_groups(heat),
    )
    words = (
        "All input data, in the units and by the keys of a scene file. A channel of the "
        "ring that is not named carries no load and is free to move."
    )
    blocks: list[Block] = [Paragraph(words), Table(HEADINGS, rows, "lrll", stack=True)]
    return Section("Input", blocks + as_read(source))


def grouped(*parts: tuple[str, Sequence[Line]]) -> list[Line | Group]:
    """The lines of each part below its title; of a part without lines nothing."""
    rows: list[Line | Group] = []
    for title, lines in parts:
        rows += [Group(title), *lines] if lines else []
    return rows


LINES, COLUMNS = 400, 200
"""Of a file's text that a report shows: it is typeset at half a millisecond a line."""


def as_read(source: str) -> list[Block]:
    """The text of the file, as far as a reader goes through it, with nothing in it that reorders or hides text."""
    lines = source.rstrip("\n").split("\n")
    shown = [printable(line.expandtabs(4)) for line in lines[:LINES]]
    cut = "\n".join(line if len(line) <= COLUMNS else f"{line[:COLUMNS]} ..." for line in shown)
    part = "The file" if len(lines) <= LINES else f"The first {LINES} of {len(lines):,} lines of the file,"
    return [Paragraph(f"{part} as it was read:"), Code(cut, "toml")] if source else []


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
    follows = _what_follows(bearing)
    for line in numbers(BEARING, bearing):
        source = origin(line[0], published is not None and line in numbers(BEARING, published))
        if line[0] in follows:
            line, source = (line[0], follows[line[0]], line[2], ""), FOLLOWS[line[0]] if source == given_by else source
        found.append((*line[:3], source))
    for name in MATERIALS:
        material = getattr(bearing, name)
        if entry is not None and published is not None and getattr(published, name) == material:
            sources = entry.material_provenance
            found += [
                (f"{name}.{line[0]}", *line[1:3], sources.get(f"{name}.{line[0]}") or origin(name, True))
                for line in numbers(MATERIAL, material)
            ]
        else:
            found += _material(name, material)
    if entry is not None:
        found.append(("catalogue entry", entry.name, "", entry.source))
    return found


def _what_follows(bearing: BallBearing) -> dict[str, str]:
    """The clearance or the angle, whichever follows from the other: the one of many digits, in six of them."""
    values = {key.name: key.in_file(float(getattr(bearing, key.field))) for key in BEARING if key.name in FOLLOWS}
    short = {name: f"{value:.6g}" for name, value in values.items()}
    long = [name for name, value in values.items() if short[name] != _text(value)]
    return {long[0]: short[long[0]]} if len(long) == 1 else {}


def _material(name: str, material: Material) -> list[Line]:
    """The numbers of a material that no catalogue entry gives: named by the scene, or given by it."""
    known = any(material == each for each in BY_NAME.values())
    origin = f"this program's {material.name}" if known else "scene"
    return [(f"{name}.{line[0]}", *line[1:3], origin) for line in numbers(MATERIAL, material)]


def effect_lines(effects: Iterable[Any], heat: Thermal | None = None) -> list[Line]:
    """Effects with their numbers and choices; temperatures of nodes are not given, but found by the heat balance."""
    nodes = heat.found_nodes if heat is not None else ()
    of_nodes = {f"{'ball' if node == 'balls' else node}_temperature" for node in nodes}
    found: list[Line] = []
    for effect in effects:
        found.append((effect.name, "on", "", ""))
        for each in fields(effect):
            value = getattr(effect, each.name)
            key = _key(NUMBERS.get(effect.name, EFFECTS), each.name)
            if value is None:
                continue
            if isinstance(value, Material):
                found += _material(f"{effect.name}.{each.name}", value)
            elif key is not None and np.ndim(value):
                found.append(_list(key, np.asarray(value, float)))
            elif key is not None:
                origin = "heat balance" if each.name in of_nodes else ""
                found.append(
                    (
                        f"{effect.name}.{key.name}",
                        (digits_of if origin else _text)(key.in_file(float(value))),
                        printed_unit(key.unit),
                        origin,
                    )
                )
            elif isinstance(value, str):
                name = f"{effect.name}.{ELASTIC[each.name]}" if isinstance(effect, ElasticRings) else each.name
                found.append((name, str(value), "", ""))
        if isinstance(effect, RingExpansion) and effect.is_warm:
            found += [
                (
                    f"{effect.name}.{body}_temperature_C",
                    _text(each.value - zero_celsius),
                    "°C",
                    f"left out: {each.taken_from}",
                )
                for body, each in effect.temperatures.items()
                if each.taken_from != "given"
            ]
    return found


def choice_lines(holder: Any) -> list[Line]:
    """What a scene or set chooses among several models."""
    return [(name, str(getattr(holder, name)), "", "") for name in CHOICES if getattr(holder, name) is not None]


def _list(key: Key, values: NDArray) -> Line:
    """Numbers of which there are many: between which they lie, and beside it all of them."""
    found = [key.in_file(float(value)) for value in values]
    return (
        key.name,
        f"{_text(min(found))} ... {_text(max(found))}",
        printed_unit(key.unit),
        ", ".join(map(_text, found)),
    )


def reading_lines(asked: Mapping[str, Mapping[str, Any]]) -> list[Line]:
    """Asked for, with their numbers; those of no key of a file in SI, as Python has them."""
    found: list[Line] = []
    for name, arguments in asked.items():
        found.append((name, "on", "", ""))
        for key, value in arguments.items():
            if isinstance(value, float | int | str) and not isinstance(value, bool):
                keys = reading_tables()[name].keys if name in reading_tables() else ()
                known = None if isinstance(value, str) else _key(keys, key)
                text = value if isinstance(value, str) else _text(known.in_file(value) if known else value)
                unit = printed_unit(known.unit) if known else "" if isinstance(value, str) else "SI"
                found.append((f"{name}.{known.name if known else key}", text, unit, ""))
    return found


def thermal_groups(thermal: Thermal | None) -> list[tuple[str, list[Line]]]:
    """The tables of [thermal]: friction, given temperatures, oil, other heats, heat capacities, conductances."""
    if thermal is None:
        return []
    words: list[Line] = [(word, getattr(thermal, word), "", "") for word in WORDS if getattr(thermal, word)]
    parts = [("Heat", [*words, *numbers(THERMAL, thermal)]), ("Heat: oil", numbers(OIL, thermal.oil))]
    for name, keys in BY_NODE.items():
        given = getattr(thermal, name)
        known = [(key.name, key.in_file(float(given[key.field])), key.unit) for key in keys if key.field in given]
        parts.append((f"Heat: {name}", [(key, _text(value), printed_unit(unit), "") for key, value, unit in known]))
    conductances: list[Line] = []
    for each in thermal.conductances:
        ((name, value, unit, origin),) = numbers(CONDUCTANCE, each)
        row = "" if each.row is None else f" of row {each.row}"
        conductances.append((f"{name}, {' to '.join(each.between)}{row}", value, unit, origin))
    return [*parts, ("Heat: conductances", conductances)]


def numbers(keys: tuple[Key, ...], holder: Any) -> list[Line]:
    """The numbers that an object holds, by the keys of a scene file."""
    found = []
    for key in keys:
        value = getattr(holder, key.field, None)
        if value is not None:
            found.append((key.name, _text(key.in_file(float(value))), printed_unit(key.unit), ""))
    return found


def _key(keys: tuple[Key, ...], field: str) -> Key | None:
    return next((key for key in keys if key.field == field), None)


def _text(value: float) -> str:
    return f"{value:.7g}"
