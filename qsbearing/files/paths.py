"""Any number of a file by its path, as it stands there: `shaft.loads.1.radial_y_N`; tables of a list count from 1."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Iterator
from typing import Any

from qsbearing.files import catalogue
from qsbearing.files.file_keys import numbers, set_numbers, thermal_numbers
from qsbearing.files.keys import EFFECT_TABLES, IN_PLACE, MATERIAL, MATERIALS, SET_TABLES, WITHIN_SET_TABLES, Key
from qsbearing.model.material import STEEL, material_named
from qsbearing.model.units import mm
from qsbearing.model.validation import LENGTH, alike, question, whole_number

Path = tuple[str, ...]
ONE_EACH = (
    "rows.offset_um", "rows.bearing.", *(f"rows.{name}." for name in EFFECT_TABLES), "rows.readings.",
    "shaft.temperature_C", "shaft.loads.", "shaft.gears.", "shaft.belts.",
    "housing.temperature_C", "housing.outside_diameter_mm",
    *(f"spacers.{side}_{what}" for side in ("inner", "outer") for what in ("length_mm", "temperature_C")),
    "floating.spring_N", "rows.housing_radial_", "rows.housing_tilt_", "shaft.masses.mass_kg",
)  # fmt: skip
"""What may differ between the cases of one set; every other number that only a set or a heat balance has makes another
one."""
MOST_MEANT = 3
"""How many numbers that are likely meant are told."""


def plain(path: Iterable[str]) -> str:
    """A path without its numbers."""
    return ".".join(step for step in path if whole_number(step) is None)


def key_at(path: Path) -> Key | None:
    """The key of a path, by the tables that it goes through; None: no file has it."""
    tables, name = plain(path[:-1]).split("."), path[-1]
    last = tables[-1]
    if tables == ["shaft", "points"]:
        return Key(name, name.removesuffix("_mm"), "mm", mm, LENGTH) if name.endswith("_mm") else None
    if "elastic_rings" in tables:
        last, name = "elastic_rings", ".".join((*tables[tables.index("elastic_rings") + 1 :], name))
    if last.endswith("material"):
        keys: tuple[Key, ...] = MATERIAL
    elif tables[0] == "thermal":
        keys = thermal_numbers().get(last, ())
    else:
        keys = set_numbers().get(last) or numbers().get(last, ())
        keys = (*keys, *(key for key in IN_PLACE if key.name != "ball_set")) if last == "bearing" else keys
    return next((key for key in keys if key.name == name), None)


def spans_cases(path: Path, document: dict[str, Any]) -> bool:
    """Whether one scene or set of this document can have the number at many values, a case for each."""
    name = plain(path)
    if name == "rows.position_mm":  # rings that expand belong to the section of the shaft that their row is on
        rows = document.get("rows")
        holders = [document.get("effects"), *(rows if isinstance(rows, list) else [])]
        return not any(isinstance(each, dict) and "ring_expansion" in each for each in holders)
    if path[0] not in (*SET_TABLES, *WITHIN_SET_TABLES, "thermal"):
        return True
    return name.startswith(ONE_EACH) and not name.endswith(".position_mm")


def numbers_of(table: Any, before: Path = ()) -> Iterator[Path]:
    """The path of every number that stands in these tables, lists of numbers left out."""
    steps = enumerate(table, 1) if isinstance(table, list) else table.items() if isinstance(table, dict) else ()
    for step, value in steps:
        if isinstance(value, int | float):
            yield from [] if isinstance(value, bool) or isinstance(table, list) else [(*before, str(step))]
        else:
            yield from numbers_of(value, (*before, str(step)))


def missing_table(document: dict[str, Any], path: Path) -> str:
    """What is wrong with a path of which the document lacks a table of a list; empty where it has it."""
    table: Any = document
    for number, step in enumerate(path[:-1]):
        within, table = table, _inner(table, step)
        is_listed = number + 2 < len(path) and whole_number(path[number + 1]) is not None
        if table is None and (isinstance(within, list) or is_listed):
            there = len(within) if isinstance(within, list) else 0
            listed = ".".join(path[: number + (0 if isinstance(within, list) else 1)])
            return f"there {'is' if there == 1 else 'are'} {there or 'no'} {listed}"
    return "" if not isinstance(table, list) else "is a list of tables, not a number"


def _inner(table: Any, step: str) -> Any:
    if isinstance(table, list):
        return table[at - 1] if 1 <= (at := whole_number(step) or 0) <= len(table) else None
    return table.get(step) if isinstance(table, dict) else None


def put(document: dict[str, Any], path: Path, value: Any) -> None:
    """Put a number, or one for each case, into the tables of a file, which change.

    Tables that are missing are made: of a row from those of the set, of a material from its name.
    """
    table: Any = document
    for step in path[:-1]:
        inner = _inner(table, step)
        if not isinstance(inner, dict | list):
            inner = _made(document, table, step, inner)
            table[step] = inner
        table = inner
    table[path[-1]] = value


def _made(document: dict[str, Any], table: dict[str, Any], step: str, word: Any) -> dict[str, Any]:
    """A table that a file has by its name, by its default, or nowhere yet."""
    if step.endswith("material"):
        return _material_table(table, step, word)
    if table is not document and step in ("bearing", "readings", *EFFECT_TABLES):  # of a row
        effects = document.get("effects")
        common = (effects if isinstance(effects, dict) else {}) if step in EFFECT_TABLES else document
        if table is not effects and isinstance(common.get(step), dict):
            return copy.deepcopy(common[step])
    return {}


def _material_table(holder: dict[str, Any], step: str, word: Any) -> dict[str, Any]:
    """The numbers of a material that the file, or the catalogue, calls by name."""
    if word is None and step in MATERIALS:
        entry = catalogue.find(holder["name"]) if isinstance(holder.get("name"), str) else None
        word = entry.bearing.get(step) if entry else None
    material = material_named(word) if isinstance(word, str) else STEEL if step not in MATERIALS else None
    if material is None:
        return {}
    in_si = {key: getattr(material, key.field) for key in MATERIAL}
    return {key.name: key.in_file(value) for key, value in in_si.items() if value is not None}


def take_out(document: dict[str, Any], path: Path) -> None:
    """Leave a number out, and a table at the top that is then empty."""
    table: Any = document
    for step in path[:-1]:
        table = _inner(table, step)
    if isinstance(table, dict) and table.pop(path[-1], None) is not None and not table and len(path) == 2:
        del document[path[0]]


def value_at(document: dict[str, Any], path: Path) -> Any:
    """What the document has there; None: nothing."""
    table: Any = document
    for step in path:
        table = _inner(table, step)
    return table


def meant(name: str, document: dict[str, Any]) -> list[str]:
    """Paths of the document's own numbers that a name is likely to mean; the most likely first, or none."""
    own = [".".join(path) for path in numbers_of(document)]
    steps = plain(name.split("."))
    same = [path for path in own if f".{plain(path.split('.'))}".endswith(f".{steps}")]
    if not same and "." in name:
        same = alike(name, own)
    if not same:
        last = alike(steps.rpartition(".")[2], [path.rpartition(".")[2] for path in own])
        same = [path for path in own if path.rpartition(".")[2] in last]
    return same


def told(meant: list[str]) -> str:
    """A question after what is likely meant; empty where nothing is."""
    more = "" if len(meant) <= MOST_MEANT else f", of {len(meant)} such numbers of the file?"
    requested = question(meant[:MOST_MEANT])
    return requested.removesuffix("?") + more if more else requested
