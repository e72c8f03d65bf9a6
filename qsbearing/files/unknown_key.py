"""What is meant by a key that no scene file has: the same number in another unit, or the nearest known key."""

from __future__ import annotations

from typing import Any, NamedTuple

from qsbearing.files.file_keys import OTHER_TABLES, numbers, reading_tables, sections, set_numbers, thermal_numbers
from qsbearing.files.keys import EFFECT_SECTIONS, MATERIAL, ON_SHAFT, SPECTRUM, Key, named
from qsbearing.files.usual_words import is_preload, usual
from qsbearing.model.effects.seats_out_of_round import LOBES, OTHER_LOBES, SeatsOutOfRound
from qsbearing.model.validation import alike, question

TITLES = ("name", "title")
"""Outside all tables they would be a title."""
LARGEST = 1e30
"""Of a number that is worth converting: far beyond any load, far within floats."""


def _tables() -> dict[str, tuple[str, ...]]:
    from qsbearing.files.set_keys import SET_SECTIONS  # loaded for a mistake only

    return sections() | {**OTHER_TABLES, "material": named(MATERIAL), **SET_SECTIONS, "spectrum": named(SPECTRUM)}


def _keys(section: str) -> tuple[Key, ...]:
    return (numbers() | thermal_numbers() | set_numbers() | {"spectrum": SPECTRUM}).get(section, ())


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
        others = "`name` under [bearing] is an entry of the catalogue, `title` under [report] heads the design report"
        return Suggestion(f"A scene is called after its file; {others}")
    if is_preload(name):
        return Suggestion(f"A preload has a table of its own: [preload], with one of {', '.join(_tables()['preload'])}")
    if (
        section == SeatsOutOfRound.name
        and "lobe" in name
        and not any(f"_{each}_lobe" in name for each in LOBES.values())
    ):
        return Suggestion(OTHER_LOBES)
    # Without its unit a name is its key's.
    stems = {key.field: key.name for key in _keys(section)}
    own = [stems[name]] if name in stems else alike(name, _tables().get(section, ()))
    key = own[0] if len(own) == 1 else ""
    there = [table for table, keys in _tables().items() if table != section and name in keys]
    if there := [table for table in there if table != "spectrum" or "operation" not in there]:
        belongs = f"belongs under {' or '.join(map(_title, there))}"
        return Suggestion(f"{question(own)} {name} alone {belongs}", key) if own else Suggestion(f"It {belongs}")
    converted = _in_known_unit(name, section, value)
    if converted is not None:
        return converted
    by_word = usual(name)
    if by_word and by_word.key in _tables().get(section, ()):
        return Suggestion(f"Did you mean {by_word}?", by_word.key)
    own = own or [stems[each] for each in alike(name, stems)]
    if own:
        return Suggestion(question(own), key or (own[0] if len(own) == 1 else ""))
    if by_word:
        table = next(table for table, keys in _tables().items() if by_word.key in keys)
        return Suggestion(f"Did you mean {by_word}? It belongs under {_title(table)}")
    everywhere = {key: table for table, keys in reversed(_tables().items()) for key in keys}  # of several the first
    elsewhere = alike(name, everywhere)
    if elsewhere:
        return Suggestion(question([f"{each} under {_title(everywhere[each])}" for each in elsewhere]))
    known = f"Known here: {', '.join(_tables()[section])}" if section else ""
    return Suggestion(known or "A scene has [bearing], [operation] and [effects]")


def _title(table: str) -> str:
    if table == "material":
        return "a material's table"
    if table in ON_SHAFT:
        return f"[[shaft.{table}]]"
    if table == "housing_stiffness":
        return "[rows.housing_stiffness]"
    if table in ("rows", "spectrum", "spacers", "floating"):
        return f"[[{table}]]"
    if table in thermal_numbers() and table != "thermal":
        return f"[[thermal.{table}]]" if table == "conductances" else f"[thermal.{table}]"
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
                setting = f"{key.name} = {key.in_file(value * size):.10g}"
                return Suggestion(f"Did you mean {setting}? ({value:.10g} {unit.replace('_', '/')})", key.name)
    return None
