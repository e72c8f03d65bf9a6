"""What a catalogue prints of a bearing besides the model's lengths: diameters, width, shoulders and ratings.

A file states them once, in [bearing], or names a bearing of the catalogue; every effect and reading that takes such a
number and does not state it itself gets it from there. Where a file changes a number of the bearing that it names, the
ratings are no longer those of the bearing, nor, where it changes a length, are the shoulders.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np

from qsbearing.files import catalogue
from qsbearing.files.bearing_table import MODIFIED, bearing_of, changed_keys, designated, entry_of, kept
from qsbearing.files.designations import read
from qsbearing.files.effects_table import flattened
from qsbearing.files.file_keys import reading_keys, reading_tables
from qsbearing.files.fits import CLASS
from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    BEARING,
    EFFECT_TABLES,
    MATERIALS,
    PRINTED,
    SEAT_FITS,
)
from qsbearing.model.bearing import BallBearing
from qsbearing.model.effects import ElasticRings, RingExpansion

_OF_RINGS = {
    "outer.outside_diameter_mm": "outside_diameter_mm",
    "outer.width_mm": "width_mm",
    "outer.shoulder_diameter_mm": "outer_shoulder_diameter_mm",
    "inner.bore_diameter_mm": "bore_diameter_mm",
    "inner.width_mm": "width_mm",
    "inner.shoulder_diameter_mm": "inner_shoulder_diameter_mm",
}
"""What elastic rings take, if their table describes the ring at all."""
_BY_GEOMETRY = {"dynamic_load_rating_N": {"rating", "rating_factor"}}
"""Keys beside which a rating is asked for by the geometry, so that it is none of a catalogue."""


def with_printed(document: dict[str, Any]) -> dict[str, Any]:
    """The tables of a file, with what the catalogue prints of its bearing in every table that takes it; rows likewise.

    A row with a bearing of its own gets effects and readings of its own where such numbers are in them.
    """
    given, document = document, dict(document)
    for place in _PLACES:
        document[place] = _filled(given.get(place), place, _known(given.get("bearing")))
        if place not in given:
            del document[place]
    if not isinstance(given.get("rows"), list):
        return document
    rows = document["rows"] = [_row(row, given) if isinstance(row, dict) else row for row in given["rows"]]
    for place in _PLACES:
        all_have = all(isinstance(row, dict) and _has(row, place) for row in rows)
        if all_have and "bearing" not in given and isinstance(document.get(place), dict):
            document[place] = {key: each for key, each in document[place].items() if key not in _names(place)}
    return document


def catalogue_numbers(bearing: BallBearing) -> dict[str, float]:
    """What the catalogue prints of the bearing that this one is by its name and its numbers, as drawn; in SI.

    Of `bore_diameter`, `outside_diameter`, `width`, `inner_shoulder_diameter`, `outer_shoulder_diameter`,
    `dynamic_load_rating` and `static_load_rating` those that are known: none of a bearing of no catalogue; of one with
    changed numbers (", modified" behind its name) what `with_printed` would hand on.

    The rings of the bearing of a scene, free, where all of these are known:

        p = catalogue_numbers(scene.bearing)
        ElasticRings(
            outside_diameter=p["outside_diameter"], outer_width=p["width"], housing="free",
            outer_shoulder_diameter=p.get("outer_shoulder_diameter"),
            bore_diameter=p["bore_diameter"], inner_width=p["width"], shaft="free",
            inner_shoulder_diameter=p.get("inner_shoulder_diameter"),
        )
    """
    found = _printed(bearing)
    return {key.field: key.si(found[key.name]) for key in PRINTED if key.name in found}


def is_printed(bearing: BallBearing, table: str, key: str, value: float) -> bool:
    """Whether a number of an effect's or a reading's table is the one that the catalogue prints of the bearing.

    Args:
        table: the effect's or the reading's name; key and value: in the words and the unit of a file.
    """
    printed = _taken(table).get(key)
    return printed is not None and _printed(bearing).get(printed) == value


def _printed(bearing: BallBearing) -> dict[str, float]:
    """In the units of a file."""
    entry = entry_of(bearing)
    drawn = None if entry is None else _drawn(entry.name)
    if entry is None or drawn is None:
        return {}
    numbers, words = [key.field for key in BEARING], ["kind", *MATERIALS]
    changed = {each for each in numbers if not np.allclose(getattr(bearing, each), getattr(drawn, each), rtol=1e-9)}
    changed |= {each for each in words if getattr(bearing, each) != getattr(drawn, each)}
    if changed and not bearing.name.endswith(MODIFIED):
        return {}  # another bearing of this name, such as that of a file called so
    return kept(entry, changed)


@cache
def _drawn(name: str) -> BallBearing | None:
    return bearing_of({"bearing": {"name": name}}, "", [])


def _known(bearing: Any) -> dict[str, Any]:
    """What a file's [bearing] gives of such numbers, and what the catalogue prints of the one that it names."""
    if not isinstance(bearing, dict):
        return {}
    bearing = designated(bearing)
    own = {key.name: bearing[key.name] for key in PRINTED if key.name in bearing}
    name = bearing["name"] if isinstance(bearing.get("name"), str) else ""
    told, entry = read(name), catalogue.find(name)
    by_name = {CLASS: told.tolerance_class} if told is not None and told.tolerance_class else {}
    if entry is None:
        return by_name | own
    changed = changed_keys(entry, {key: each for key, each in bearing.items() if key not in own})
    return kept(entry, changed) | by_name | own


_PLACES = ("effects", "readings")


def _names(place: str) -> Iterable[str]:
    """Of the tables within [effects] or [readings]; readings are loaded only for a file that has some."""
    return EFFECT_TABLES if place == "effects" else reading_tables()


def _has(row: dict[str, Any], place: str) -> bool:
    """Whether a row has effects or readings of its own."""
    return place in row if place == "readings" else any(name in row for name in EFFECT_TABLES)


def _row(row: dict[str, Any], document: dict[str, Any]) -> dict[str, Any]:
    known = _known(row.get("bearing", document.get("bearing")))
    for place in _PLACES:
        of_all = document.get(place)
        if "bearing" not in row or _has(row, place) or not isinstance(of_all, dict) or BALL_DEVIATIONS.name in of_all:
            continue
        inherited = {name: of_all[name] for name in _names(place) if name in of_all}
        if any(_given(name, table, known) for name, table in inherited.items()):
            row = {**row, **(inherited if place == "effects" else {place: inherited})}
    row = _filled(row, "effects", known)
    return {**row, "readings": _filled(row["readings"], "readings", known)} if "readings" in row else row


def _filled(holder: Any, place: str, known: dict[str, Any]) -> Any:
    """The tables of effects or readings within this one, with the numbers that they take and do not state."""
    if not isinstance(holder, dict) or not known:
        return holder
    found = dict(holder)
    for name in _names(place):
        if given := _given(name, holder.get(name), known):
            found[name] = {**given, **({} if holder[name] is True else holder[name])}
    return found


def _given(name: str, table: Any, known: dict[str, Any]) -> dict[str, Any]:
    """What of the known numbers a table takes and does not state."""
    if not isinstance(table, dict) and table is not True:
        return {}
    own = set() if table is True else set(flattened(table))
    found = {
        key: known[printed]
        for key, printed in _taken(name).items()
        if printed in known and key not in own and not own & _BY_GEOMETRY.get(key, set()) and _has_section(key, own)
    }
    if name == RingExpansion.name and CLASS in known and own & set(SEAT_FITS) and CLASS not in own:
        found[CLASS] = known[CLASS]  # a designation's, as P4
    return found


def _has_section(key: str, own: set[str]) -> bool:
    """Whether a ring of elastic rings, which the key begins with, is described, and not by its compliances."""
    side = key.rpartition(".")[0]
    of_ring = {each for each in own if each.startswith(f"{side}.")}
    return not side or (bool(of_ring) and not any(each.endswith(".compliance_um_per_N") for each in of_ring))


@cache  # a search asks a thousand times
def _taken(name: str) -> dict[str, str]:
    """The keys of an effect's or a reading's table that a catalogue's number fills, and which number."""
    if name == ElasticRings.name:
        return _OF_RINGS
    printed = {key.name for key in PRINTED}
    keys = EFFECT_TABLES.get(name) or (reading_keys(name) if name in reading_tables() else ())
    return {key.name: key.name for key in keys if key.name in printed}
