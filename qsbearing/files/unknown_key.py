"""What is meant by a key that no scene file has: the same number in another unit, or the nearest known key."""

from __future__ import annotations

from typing import Any, NamedTuple

from qsbearing.files.file_keys import OTHER_TABLES, numbers, reading_tables, sections
from qsbearing.files.thermal_keys import CONDUCTANCES
from qsbearing.files.thermal_keys import NUMBERS as THERMAL_NUMBERS
from qsbearing.files.usual_words import is_preload, usual
from qsbearing.model.scene.keys import (
    EFFECT_SECTIONS,
    MATERIAL_KEYS,
    SET_NUMBERS,
    SET_SECTIONS,
    SHAFT_SECTIONS,
    SPECTRUM,
    Key,
)
from qsbearing.model.validation import near

TITLES = ("name", "title")
"""Outside all tables they would be a title."""
LARGEST = 1e30
"""Of a number that is worth converting: far beyond any load, far within floats."""


def _tables() -> dict[str, tuple[str, ...]]:
    return sections() | {
        **OTHER_TABLES,
        "material": MATERIAL_KEYS,
        **SET_SECTIONS,
        **SHAFT_SECTIONS,
        "spectrum": tuple(key.name for key in SPECTRUM),
    }


def _keys(section: str) -> tuple[Key, ...]:
    return (numbers() | THERMAL_NUMBERS | SET_NUMBERS | {"spectrum": SPECTRUM}).get(section, ())


class Suggestion(NamedTuple):
    """What to write instead."""

    sentence: str
    key: str = ""
    """The key of the same table that is meant; empty where none is."""


def suggest(name: str, section: str, value: Any) -> Suggestion:
    """What to write instead of an unknown key.

    Args:
        section: bearing, operation, effects, the table of an effect, or material; empty for a key outside all tables.
        value: what the file gives under that key.
    """
    if not section and name in TITLES:
        own = "`name` under [bearing] is an entry of the catalogue, `title` under [report] heads the design report"
        return Suggestion(f"A scene is called after its file; {own}")
    for table, keys in _tables().items():
        if table != section and name in keys:
            own = next((each for each in _tables().get(section, ()) if each.endswith(f"_{name}")), "")
            meant = f"Did you mean {own}? {name} alone" if own else "It"
            return Suggestion(f"{meant} belongs under {_title(table)}", own)
    converted = _in_known_unit(name, section, value)
    if converted is not None:
        return converted
    by_word = usual(name)
    if by_word and by_word.key in _tables().get(section, ()):
        return Suggestion(f"Did you mean {by_word}?", by_word.key)
    # Without its unit a name resembles its key less than it should.
    stems = {key.field: key.name for key in _keys(section)}
    meant = near(name, _tables().get(section, ()), 0.6) or stems.get(near(name, stems, 0.6), "")
    if meant:
        return Suggestion(f"Did you mean {meant}?", meant)
    if is_preload(name):
        return Suggestion(f"A preload has a table of its own: [preload], with one of {', '.join(_tables()['preload'])}")
    if by_word:
        table = next(table for table, keys in _tables().items() if by_word.key in keys)
        return Suggestion(f"Did you mean {by_word}? It belongs under {_title(table)}")
    everywhere = {key: table for table, keys in _tables().items() for key in keys}
    elsewhere = near(name, everywhere, 0.7)
    if elsewhere:
        return Suggestion(f"Did you mean {elsewhere}, under {_title(everywhere[elsewhere])}?")
    known = f"Known here: {', '.join(_tables()[section])}" if section else ""
    return Suggestion(known or "A scene has [bearing], [operation] and [effects]")


def _title(table: str) -> str:
    if table == "material":
        return "a material's table"
    if table in ("sections", "loads", "supports", "masses"):
        return f"[[shaft.{table}]]"
    if table == "housing_stiffness":
        return "[rows.housing_stiffness]"
    if table in ("rows", "spectrum", "spacers", "floating"):
        return f"[[{table}]]"
    if table in THERMAL_NUMBERS and table != "thermal":
        return f"[[thermal.{table}]]" if table == CONDUCTANCES else f"[thermal.{table}]"
    outer = "effects." if table in EFFECT_SECTIONS else "readings." if table in reading_tables() else ""
    return f"[{outer}{table}]"


def _in_known_unit(name: str, section: str, value: Any) -> Suggestion | None:
    """`axial_load_kN = 8` is `axial_load_N = 8000`."""
    for key in _keys(section):
        ending = name.removeprefix(f"{key.field}_")
        if key.quantity is None or ending == name:
            continue
        for unit, _, size in key.quantity.units:
            if ending.replace("_", "").lower() == unit.replace("_", "").lower():
                if type(value) not in (int, float) or not -LARGEST < value < LARGEST:
                    return Suggestion(f"Did you mean {key.name}?", key.name)
                found = f"{key.name} = {key.in_file(value * size):.10g}"
                return Suggestion(f"Did you mean {found}? ({value:.10g} {unit.replace('_', '/')})", key.name)
    return None
