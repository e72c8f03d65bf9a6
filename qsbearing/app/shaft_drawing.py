"""What the page draws of a set: rows, shaft and what stands on it; and which number of the file each part of it moves.

The page has the numbers themselves, by their paths, and so draws what is typed before anything is solved.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from qsbearing.files.bearing_table import read_bearing
from qsbearing.files.keys import NUMBERED, OF_OPERATION
from qsbearing.files.row_bearing import whole_bearing
from qsbearing.files.scene_or_set import is_set
from qsbearing.files.set_file import is_deep_groove
from qsbearing.files.set_keys import SET_NUMBERS
from qsbearing.model.bearing import BallBearing
from qsbearing.model.operation import CHANNELS
from qsbearing.model.units import deg, mm
from qsbearing.pictures.deformed_shaft import BOX
from qsbearing.systems.sets.row import ONE_WAY, Direction
from qsbearing.systems.sets.shaft import LOADS

Tables = dict[str, Any]
Path = tuple[str | int, ...]
"""Where a number stands in the tables; those of a list count from 0."""
ALONG, LENGTH, TURNS, ACROSS = "along", "length", "turns", "across"
"""What a part moves: a place along the shaft, the end of a section, the side that a row carries, a diameter."""
WIDTHS = {
    "outer_diameter": "outer begins",
    "end_outer_diameter": "outer ends",
    "inner_diameter": "inner begins",
    "end_inner_diameter": "inner ends",
}
"""Diameters of a section, by their fields: of which surface, and where."""
FORCES = ("x", "y", "z", "turn", "turn")
"""How the load of each channel is drawn: along an axis, or as one that turns."""
WRITTEN = ""
"""How a number is drawn that is only written beside its thing."""
_OF_DRIVE = {"pitch_diameter": ACROSS, "torque": WRITTEN, "power": WRITTEN}
ON_SHAFT: dict[str, dict[str, str]] = {
    "load": dict(zip((name for name, _ in LOADS), FORCES, strict=True)),
    "gear": _OF_DRIVE,
    "belt": _OF_DRIVE,
    "mass": {"mass": WRITTEN},
    "support": dict.fromkeys(("axial", "radial_y", "radial_z"), WRITTEN),
}
"""What stands on the shaft: the fields that are drawn, and how; first of all its position."""


class DrawnPart(NamedTuple):
    """A number or word of one thing."""

    path: Path
    moves: str
    words: tuple[str, ...] = ()
    """Of a word, what it may be here."""


class Thing(NamedTuple):
    """One thing of the drawing."""

    kind: str
    """What one of its table is called: row, section, load."""
    name: str
    parts: list[DrawnPart]
    size: dict[str, float] | None = None
    """Of a row's bearing, in mm and degrees; None where its numbers are wrong."""


def drawing(document: Tables) -> list[dict[str, Any]]:
    """Everything that there is to draw of a set; of a single bearing nothing.

    Wrong numbers do not matter here: what can be drawn without them is there.
    """
    if not is_set(document):
        return []
    things = [*_of_shaft(document), *_rows(document), *_on_shaft(document), *_reference(document)]
    return [each._asdict() | {"parts": [part._asdict() for part in each.parts]} for each in things]


def _table(document: Tables, name: str) -> Tables:
    table = document.get(name)
    return table if isinstance(table, dict) else {}


def _listed(tables: Tables, name: str) -> Iterator[tuple[int, Tables]]:
    listed = tables.get(name)
    for number, table in enumerate(listed if isinstance(listed, list) else []):
        if isinstance(table, dict):
            yield number, table


def _names(table: str) -> dict[str, str]:
    """Keys of a table by their fields."""
    return {key.field: key.name for key in SET_NUMBERS[table]}


def _parts(table: Tables, before: Path, names: dict[str, str], moved: dict[str, str]) -> list[DrawnPart]:
    """Those that are given."""
    return [DrawnPart((*before, names[field]), what) for field, what in moved.items() if names.get(field) in table]


def _of_shaft(document: Tables) -> Iterator[Thing]:
    """Where it begins, and its sections."""
    shaft = _table(document, "shaft")
    sections = list(_listed(shaft, "sections"))
    if sections:
        yield Thing("start", "shaft", _parts(shaft, ("shaft",), _names("shaft"), {"start": ALONG}))
    for number, section in sections:
        before = ("shaft", "sections", number)
        parts = _parts(section, before, _names("sections"), {"length": LENGTH, **WIDTHS})
        yield Thing("section", f"section {number + 1}", parts)


def _rows(document: Tables) -> Iterator[Thing]:
    for number, row in _listed(document, "rows"):
        whole = {"bearing": whole_bearing(row, document.get("bearing"))}
        bearing = read_bearing(whole, "", [], is_of_row=True).bearing if whole["bearing"] is not None else None
        words = tuple(Direction) if is_deep_groove(bearing, row.get("bearing")) else ONE_WAY
        parts = _parts(row, ("rows", number), _names("rows"), {"position": ALONG})
        if "carries" in row:
            parts.append(DrawnPart(("rows", number, "carries"), TURNS, tuple(map(str, words))))
        yield Thing("row", f"row {number + 1}", parts, None if bearing is None else _size(bearing))


def _size(bearing: BallBearing) -> dict[str, float]:
    numbers = bearing.ball_diameter, bearing.pitch_diameter, bearing.free_contact_angle
    ball, pitch, angle = (float(np.asarray(each)) for each in numbers)
    return {"ball": ball / mm, "box": BOX * ball / mm, "pitch": pitch / mm, "angle": angle / deg}


def _on_shaft(document: Tables) -> Iterator[Thing]:
    shaft = _table(document, "shaft")
    for kind, drawn in ON_SHAFT.items():
        table = NUMBERED[kind]
        for number, each in _listed(shaft, table):
            parts = _parts(each, ("shaft", table, number), _names(table), {"position": ALONG, **drawn})
            yield Thing(kind, f"{kind} {number + 1}", parts)
    for key in _table(shaft, "points"):
        yield Thing("point", key.removesuffix("_mm"), [DrawnPart(("shaft", "points", key), ALONG)])


def _reference(document: Tables) -> Iterator[Thing]:
    """Where the loads of [operation] act, where it is stated."""
    parts = _parts(_table(document, "shaft"), ("shaft",), _names("shaft"), {"reference_position": ALONG})
    loads = dict(zip((channel.load for channel in CHANNELS), FORCES, strict=True))
    of_operation = {field: key.name for field, key in OF_OPERATION.items()}
    if parts:
        parts += _parts(_table(document, "operation"), ("operation",), of_operation, loads)
        yield Thing("operation", "operation", parts)
