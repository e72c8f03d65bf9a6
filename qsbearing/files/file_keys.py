"""The keys of a scene file by their place in it; those of readings, sets and heat are loaded only where they matter."""

from __future__ import annotations

from enum import StrEnum
from functools import cache
from itertools import chain
from typing import TYPE_CHECKING, Any

from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    EFFECT_SECTIONS,
    EFFECT_TABLES,
    IN_PLACE,
    NUMBERED,
    NUMBERS,
    RING_COMPLIANCES,
    SEATS,
    SECTIONS,
    SET_TABLES,
    SPECTRUM,
    SPECTRUM_POINT,
    WITHIN_SET_TABLES,
    Key,
    key_of,
    named,
)
from qsbearing.model.validation import Setting, whole_number
from qsbearing.remarks.wording import Audience, Words

if TYPE_CHECKING:
    from qsbearing.readings.entry import ReadingTable

REPORT = "report"
"""The table that says what a design report is about and for whom."""
BALL_TABLES = "ball_tables"
"""Its key for how much a report of a set has of single balls."""


class ShownBalls(StrEnum):
    """Which balls of a set's rows a design report has tables of."""

    FOLDED = "folded"
    """None: each row is a line, with the range over its balls."""
    EACH = "each"


REQUIRE = "require"
"""The table of limits that results must keep, under their names."""
ORIGIN = "rexs"
"""The table that says of which part of a REXS model a file was made; and what must still be given, under `missing`."""
OTHER_TABLES = {
    REPORT: ("title", "customer", "author", "document", BALL_TABLES),
    ORIGIN: ("bearings", "shaft", "load_case", "x_along", "missing"),
}
"""Tables that change no result, with their keys."""
_EFFECTS = (
    "ball_effects",
    "raceway_control",
    "orbit_radius",
    "ball_motion",
    "friction_coefficient",
    "moment_shares",
    "hertz_angle",
)
_OF_EFFECTS = {"ball_effects": "ball"}


def reading_tables() -> dict[str, ReadingTable]:
    """The tables within [readings]."""
    from qsbearing.readings.asked import tables

    return tables()


@cache
def reading_keys(name: str) -> tuple[Key, ...]:
    """The keys that hold numbers in a table within [readings]; none where there is no such table."""
    table = reading_tables().get(name)
    return () if table is None else tuple(map(key_of, table.inputs))


def numbers() -> dict[str, tuple[Key, ...]]:
    """The keys that hold numbers, by their table; those of sets and of heat: `set_numbers`, `thermal_numbers`."""
    return NUMBERS | {name: reading_keys(name) for name in reading_tables()}


def set_numbers() -> dict[str, tuple[Key, ...]]:
    """The keys that hold numbers, by their table, of the tables that only a set has."""
    from qsbearing.files.set_keys import SET_NUMBERS

    return SET_NUMBERS


def thermal_numbers() -> dict[str, tuple[Key, ...]]:
    """The keys that hold numbers, by their table, of [thermal] and the tables within it."""
    from qsbearing.files.thermal_keys import THERMAL_NUMBERS

    return THERMAL_NUMBERS


@cache
def words_of(name: str) -> str:
    """What the number of a key is; empty where its name states it."""
    every = chain(IN_PLACE, *NUMBERS.values())
    return next((key.words for key in every if key.name == name and key.words), "")


def sections() -> dict[str, tuple[str, ...]]:
    """Every key a file may hold, by its table, and by the tables within [effects] and [readings]."""
    from qsbearing.files.thermal_keys import THERMAL_SECTIONS

    own = {name: (*named(reading_keys(name)), *it.choices) for name, it in reading_tables().items()}
    return SECTIONS | {"readings": tuple(own)} | EFFECT_SECTIONS | THERMAL_SECTIONS | own


def find(path: str) -> Key | None:
    """The key of a path such as `bearing.ball_diameter_mm`, or `bearing.ball_material.density` as Python has it."""
    before, _, within = path.partition("elastic_rings.")
    section, _, name = path.rpartition(".")
    if within and before in ("", "effects."):
        section, name = f"{before}elastic_rings", within
    table = "material" if section.endswith("_material") else section.rpartition(".")[2]
    kind, _, number = table.partition(" ")
    if whole_number(number) is not None:
        table = NUMBERED.get(kind, table)
    if path.startswith("thermal."):
        keys = thermal_numbers().get(table.partition(" ")[0], ())
        return next((key for key in keys if name in (key.field, key.name)), None)
    known = numbers() if _is_of_reading(path) else NUMBERS
    known = set_numbers() if table in (*SET_TABLES, *WITHIN_SET_TABLES) else known
    keys = SPECTRUM if table.startswith(SPECTRUM_POINT) else known.get(table, ())
    keys = (*keys, *IN_PLACE) if table == "bearing" else keys
    return next((key for key in keys if name in (key.field, key.name)), None)


def path_in_file(path: str) -> str:
    """A Python path as the file spells it: `bearing.ball_diameter` is `bearing.ball_diameter_mm`."""
    if path in _EFFECTS:
        return f"effects.{_OF_EFFECTS.get(path, path)}"
    key = find(path)
    if key is BALL_DEVIATIONS:
        return f"effects.{key.name}"
    if path.startswith("elastic_rings."):
        other = {field: name for name, field in SEATS.items()} | {key.field: key.name for key in RING_COMPLIANCES}
        field = path.removeprefix("elastic_rings.")
        return f"effects.elastic_rings.{key.name if key else other.get(field, field)}"
    path = f"{path.rpartition('.')[0]}.{key.name}" if key else path
    return f"effects.{path}" if path.partition(".")[0] in (*EFFECT_TABLES, "traction", "ring_effects") else path


def spelled(name: str, path: str) -> str:
    """A name within a sentence on a path as the file spells it: `axial_load` of `operation.speed` is `axial_load_N`.

    A name with its table, such as `preload.spring`, keeps the table.
    """
    if isinstance(name, Setting):
        return line(name)
    table = name.rpartition(".")[0]
    key = find(name if table else f"{path.rpartition('.')[0]}.{name}")
    return (f"{table}.{key.name}" if table else key.name) if key else name


def line(setting: Setting) -> str:
    """What to write under [effects] or in another table; of an effect with numbers, where they go."""
    field, value = setting.field, setting.value
    if isinstance(value, type):
        name = value.name  # type: ignore[attr-defined]
        return f"[effects.{name}]" if name in EFFECT_TABLES else numbers()[name][0].name
    names = [effect.name for effect in value] if isinstance(value, tuple) else value
    keys = _OF_EFFECTS | {own: key for key, own in SEATS.items()}
    return f"{keys.get(field, field)} = {_toml(names)}"


def _toml(value: Any) -> str:
    return "[" + ", ".join(map(_toml, value)) + "]" if isinstance(value, list) else f'"{value}"'


IN_FILE = Words(Audience.FILE, spelled)
"""How remarks name fields to whoever reads or writes files."""


def _is_of_reading(path: str) -> bool:
    return ".readings." in f".{path}"
