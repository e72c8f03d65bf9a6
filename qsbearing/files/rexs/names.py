"""What REXS calls its attributes in each version: `names.csv`, by the numeric id that stays when a name changes.

In code an attribute has the last of its names.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import NamedTuple

from qsbearing.model.validation import whole_number

NEWEST = (2, 0, 0)
_OTHERS = {"name"}
"""What a name also means in other versions: it counts only where the version gives it this meaning."""


class _Name(NamedTuple):
    since: tuple[int, ...]
    name: str
    unit: str


@cache
def _histories() -> dict[str, list[list[_Name]]]:
    """By the last name: of each numeric id that has it, all names with their units."""
    by_id: dict[str, list[_Name]] = {}
    lines = Path(__file__).with_name("names.csv").read_text("utf-8").splitlines()
    for line in lines:
        if whole_number(line[:1]) is not None:
            number, since, name, unit = line.split(",")
            by_id.setdefault(number, []).append(_Name(version_of(since), name, unit))
    histories: dict[str, list[list[_Name]]] = {}
    for history in by_id.values():
        last = next(each.name for each in reversed(history) if each.name)
        histories.setdefault(last, []).append(history)
    return histories


def version_of(text: str) -> tuple[int, ...]:
    """1.4 as (1, 4); empty where the text is no version."""
    parts = [whole_number(part) if len(part) < 5 else None for part in text.strip().split(".")]
    return tuple(part for part in parts if part is not None) if None not in parts else ()


@cache
def spellings(name: str, version: tuple[int, ...]) -> tuple[str, ...]:
    """Every name that an attribute ever had, the last first."""
    names = [each.name for history in _histories()[name] for each in reversed(history) if each.name]
    own = current(name, version)
    return tuple(each for each in dict.fromkeys(names) if each not in _OTHERS or (own and own[0] == each))


@cache
def current(name: str, version: tuple[int, ...]) -> tuple[str, str] | None:
    """Name and unit of an attribute in a version; None where the version has none."""
    name_and_unit = None
    for history in _histories()[name]:
        known = [each for each in history if each.since <= version]
        if known and known[-1].name:
            name_and_unit = known[-1].name, known[-1].unit
    return name_and_unit


def unit_of(name: str) -> str:
    """A unit that the attribute has had, which tells its kind."""
    return next(each.unit for each in reversed(_histories()[name][0]) if each.name)
