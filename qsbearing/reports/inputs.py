"""What the scene says: every number in the field's units, with the source of a catalogue's; the file as read."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Block, Code, Paragraph, RowGroup, Section
from qsbearing.files.bearing_table import entry_of
from qsbearing.files.file_keys import reading_keys
from qsbearing.files.keys import (
    BEARING,
    COEFFICIENTS,
    EFFECTS,
    MATERIAL,
    MATERIALS,
    NUMBERS,
    OPERATION,
    PRELOAD,
    SEATS,
    Key,
    key_of,
)
from qsbearing.files.printed_numbers import is_printed
from qsbearing.files.scene_file import load_scene
from qsbearing.files.thermal_keys import BY_NODE, CONDUCTANCE, OIL, THERMAL, WORDS
from qsbearing.files.thermal_table import NODE_KEYS
from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import lists_of
from qsbearing.model.effects import ElasticRings, RingExpansion
from qsbearing.model.effects.body_temperature import body_temperatures
from qsbearing.model.material import BY_NAME, Material
from qsbearing.model.scene.scene import CHOICES, Scene
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import printable
from qsbearing.reports.layout import halves
from qsbearing.results.tables import digits_of
from qsbearing.systems.heat.network import Thermal

Line = tuple[str, str, str, str]
FOLLOWS = {
    "diametral_clearance_mm": "computed from the free contact angle",
    "free_contact_angle_deg": "computed from the clearance",
}
"""Of the two, the one that is not given."""
CATALOGUE = "catalogue"
ELASTIC = {field: key for key, field in SEATS.items()}
"""Keys of what elastic rings touch, by its field."""
KEY_OF = {body: f"{effect}.{key}" for effect, keys in NODE_KEYS.items() for key, body in keys.items()}
"""Of each part with a temperature, the key that gives it."""
HEADINGS = ("key of a scene file", "value", "unit", "from")


def section(scene: Scene, source: str, heat: Thermal | None = None) -> Section:
    """All of the input.

    Args:
        source: the text of the scene file; empty for an example of the catalogue.
        heat: [thermal] as given; the scene has the temperatures that were found.
    """
    own, of_file = scene.bearing, document(source).get("bearing")
    rows = grouped(
        ("Bearing", bearing_lines(own, "scene", of_file)),
        ("Operation", numbers(OPERATION, scene.operation)),
        ("Preload", numbers(PRELOAD, scene.preload)),
        (
            "Effects and choices",
            [*effect_lines((*scene.ring_effects, *scene.ball_effects), heat, own), *choice_lines(scene)],
        ),
        ("Readings", reading_lines(scene.readings, own)),
        *thermal_groups(heat),
    )
    words = (
        "All input data, in the units and by the keys of a scene file. A channel of the "
        "ring that is not named carries no load and is free to move."
    )
    blocks: list[Block] = [Paragraph(words), halves(HEADINGS, rows, "lrll")]
    return Section("Input", blocks + as_read(source))


def grouped(*parts: tuple[str, Sequence[Line]]) -> list[Line | RowGroup]:
    """The lines of each part below its title; of a part without lines nothing."""
    rows: list[Line | RowGroup] = []
    for title, lines in parts:
        rows += [RowGroup(title), *lines] if lines else []
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


def document(source: str) -> dict[str, Any]:
    """The tables of a file by its text, which was read before; none of no text."""
    return tomllib.loads(source)


def bearing_lines(bearing: BallBearing, given_by: str, of_file: Any = None) -> list[Line]:
    """A bearing and its materials.

    Args:
        given_by: a word for where numbers come from that are not a catalogue's.
        of_file: the table [bearing] that it was read from, where there is one: what is not in it was computed.
    """
    entry = entry_of(bearing)
    published = None if entry is None else load_scene(entry.name).bearing

    def origin(key: str, same: bool) -> str:
        """Of a number: the catalogue's source where it is the catalogue's number."""
        if entry is None or not same:
            return given_by
        return entry.provenance.get(key) or FOLLOWS.get(key, "")

    lines: list[Line] = [("name", bearing.name or "-", "", ""), ("kind", str(bearing.kind), "", "")]
    computed = _computed(of_file) if isinstance(of_file, dict) else {}
    follows = {name: short for name, short in _what_follows(bearing).items() if computed.get(name, FOLLOWS[name])}
    computed = {name: FOLLOWS[name] for name in follows} | computed | _of_arches(bearing, of_file)
    for line in numbers(BEARING, bearing):
        source = origin(line[0], published is not None and line in numbers(BEARING, published))
        if source == given_by:
            source = computed.get(line[0], "") or given_by
        lines.append((line[0], follows.get(line[0], line[1]), line[2], source))
    for name in MATERIALS:
        material = getattr(bearing, name)
        if entry is not None and published is not None and getattr(published, name) == material:
            sources = entry.material_provenance
            lines += [
                (f"{name}.{line[0]}", *line[1:3], sources.get(f"{name}.{line[0]}") or origin(name, True))
                for line in numbers(MATERIAL, material)
            ]
        else:
            lines += _material(name, material)
    if entry is not None:
        lines.append(("catalogue entry", entry.name, "", entry.source))
    return lines


def _of_arches(bearing: BallBearing, of_file: Any) -> dict[str, str]:
    """From what shims, or the clearances of arched rings, were computed."""
    if not bearing.is_arched or not isinstance(of_file, dict):
        return {}
    by_play = "axial_clearance_mm" in of_file
    shims = dict.fromkeys(("inner_shim_mm", "outer_shim_mm"), "computed from the axial clearance") if by_play else {}
    from_angle = "computed from the free contact angle and the shims"
    play = {} if by_play else {"axial_clearance_mm": from_angle}
    return shims | play | {"diametral_clearance_mm": from_angle}


def _computed(of_file: dict[str, Any]) -> dict[str, str]:
    """From what the bearing's numbers that this table does not give were computed; empty for those that it gives."""
    origins: dict[str, str] = {}
    for name, radii in sorted(COEFFICIENTS.items(), key=lambda each: -len(each[1])):  # that of one groove goes last
        if name in of_file:
            origins |= dict.fromkeys(radii, f"computed from {name} = {_text(of_file[name])}")
    angle, clearance = (name in of_file for name in reversed(FOLLOWS))
    if angle or clearance:
        origins |= {"free_contact_angle_deg": "" if angle else FOLLOWS["free_contact_angle_deg"]}
        origins |= {"diametral_clearance_mm": "" if clearance else FOLLOWS["diametral_clearance_mm"]}
    return {name: "" if name in of_file else origin for name, origin in origins.items()}


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


def effect_lines(effects: Iterable[Any], heat: Thermal | None = None, bearing: BallBearing | None = None) -> list[Line]:
    """Effects with their numbers and choices; temperatures of nodes are not given, but found by the heat balance.

    Args:
        bearing: whose catalogue may have given a number; None: of several.
    """
    nodes = heat.found_nodes if heat is not None else ()
    of_nodes = {f"{'ball' if node == 'balls' else node}_temperature" for node in nodes}
    lines: list[Line] = []
    for effect in effects:
        keys = *NUMBERS.get(effect.name, EFFECTS), *map(key_of, lists_of(type(effect)))
        lines.append((effect.name, "on", "", ""))
        for each in fields(effect):
            value = getattr(effect, each.name)
            key = _key(keys, each.name)
            if value is None:
                continue
            if isinstance(value, Material):
                lines += _material(f"{effect.name}.{each.name}", value)
            elif key is not None and np.ndim(value):
                lines.append(_list(key, np.asarray(value, float)))
            elif key is not None:
                number = key.in_file(float(value))
                is_found = each.name in of_nodes
                origin = "heat balance" if is_found else _origin(bearing, effect.name, key.name, number)
                if isinstance(effect, RingExpansion) and (fit := effect.fit_of(each.name)) is not None:
                    limits = " to ".join(_text(key.in_file(float(limit))) for limit in (fit.least, fit.most))
                    origin = f"mean of {fit.name} and class {fit.tolerance_class}, {limits}"
                text = (digits_of if is_found else _text)(number)
                lines.append((f"{effect.name}.{key.name}", text, printed_unit(key.unit), origin))
            elif isinstance(value, str):
                name = f"{effect.name}.{ELASTIC[each.name]}" if isinstance(effect, ElasticRings) else each.name
                lines.append((name, str(value), "", ""))
    return lines + [
        (KEY_OF[body], _text(each.value - zero_celsius), "°C", f"assumed: {each.taken_from}")
        for body, each in body_temperatures(effects).items()
        if each.is_assumed
    ]


def choice_lines(holder: Any) -> list[Line]:
    """What a scene or set chooses among several models."""
    return [(name, str(getattr(holder, name)), "", "") for name in CHOICES if getattr(holder, name) is not None]


def _list(key: Key, values: NDArray) -> Line:
    """Numbers of which there are many: between which they lie, and beside it all of them."""
    in_file = [key.in_file(float(value)) for value in values]
    return (
        key.name,
        f"{_text(min(in_file))} ... {_text(max(in_file))}",
        printed_unit(key.unit),
        ", ".join(map(_text, in_file)),
    )


def _origin(bearing: BallBearing | None, table: str, key: str, value: float) -> str:
    """Where a number of an effect or a reading comes from, if not from the file."""
    return CATALOGUE if bearing is not None and is_printed(bearing, table, key, value) else ""


def reading_lines(requested: Mapping[str, Mapping[str, Any]], bearing: BallBearing | None = None) -> list[Line]:
    """Asked for, with their numbers; those of no key of a file in SI, as Python has them."""
    lines: list[Line] = []
    for name, arguments in requested.items():
        lines.append((name, "on", "", ""))
        for key, value in arguments.items():
            if isinstance(value, float | int | str) and not isinstance(value, bool):
                known = None if isinstance(value, str) else _key(reading_keys(name), key)
                text = value if isinstance(value, str) else _text(known.in_file(value) if known else value)
                unit = printed_unit(known.unit) if known else "" if isinstance(value, str) else "SI"
                origin = _origin(bearing, name, known.name, known.in_file(value)) if known else ""  # type: ignore[arg-type]
                lines.append((f"{name}.{known.name if known else key}", text, unit, origin))
    return lines


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
        row = "" if each.row is None else f" of row {each.row}"
        whose = f"{' to '.join(each.between)}{row}"
        lines = numbers(CONDUCTANCE, each)
        conductances += [(f"{name}, {whose}", value, unit, origin) for name, value, unit, origin in lines]
    return [*parts, ("Heat: conductances", conductances)]


def numbers(keys: tuple[Key, ...], holder: Any) -> list[Line]:
    """The numbers that an object holds, by the keys of a scene file."""
    lines = []
    for key in keys:
        value = getattr(holder, key.field, None)
        if value is not None:
            lines.append((key.name, _text(key.in_file(float(value))), printed_unit(key.unit), ""))
    return lines


def _key(keys: tuple[Key, ...], field: str) -> Key | None:
    return next((key for key in keys if key.field == field), None)


def _text(value: float) -> str:
    return f"{value:.7g}"
