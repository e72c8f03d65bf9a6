"""What the tables of effects may hold: a field for every key, filled in or not; and an effect that is switched on.

Its numbers are those that the bearing's own table tells, else usual ones, as `Entry.assume` has them; what neither
tells has an empty field, at which it is asked for.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

from qsbearing.app.scenes import Tables, named, read, solution_of
from qsbearing.files.fits import CLASS, FITTED, classes, names
from qsbearing.files.keys import EFFECT_SECTIONS, EFFECT_TABLES, RING_EFFECTS, SEATS, key_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.described import lists_of
from qsbearing.model.effects import Entry, RingExpansion
from qsbearing.model.effects.elastic_ring_errors import SIDES
from qsbearing.model.effects.elastic_rings import USUAL_HOUSING
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.changes import rows_of
from qsbearing.model.validation import SceneError
from qsbearing.systems.sets.bearing_set import BearingSet

Path = tuple[str | int, ...]
_LISTS = {name: {key_of(each).name for each in lists_of(of)} for name, of in RING_EFFECTS.items()} | {
    Traction.name: {key_of(each).name for each in lists_of(Traction)}
}
"""Keys of lists, which the page leaves to the file."""
_HELD_BY = {f"{side}.{what}": words for side, (_, what, _, words) in SIDES.items() if f"{side}.{what}" in SEATS}
"""What holds a ring of elastic rings, where that is no body."""


def options(path: Path) -> list[str]:
    """The words that a key in a table of an effect may have; none where it is a number."""
    name, seat = str(path[-1]), str(path[-1]).removesuffix("_fit")
    if seat in FITTED and seat != name:
        return list(names(seat))
    if name == CLASS:
        return list(classes())
    return list(_HELD_BY.get(".".join(map(str, path[-2:])), ()))


def order(path: Path) -> tuple[bool, bool, int]:
    """Of a field within its table: what is picked from a list first, filled in or not, so that no field moves."""
    number = next((k for k, step in enumerate(path[:-1]) if step in EFFECT_SECTIONS), None)
    if number is None:
        return False, False, 0
    known, name = EFFECT_SECTIONS[str(path[number])], ".".join(map(str, path[number + 1 :]))
    return True, not options(path), known.index(name) if name in known else len(known)


def tables_of_effects(document: Tables) -> Iterator[tuple[Path, Tables]]:
    """Those of this document, of all rows and of one alone, with where they stand."""
    rows = document.get("rows", [])
    holders: list[tuple[Path, Any]] = [(("effects",), document.get("effects"))]
    holders += [(("rows", number), row) for number, row in enumerate(rows if isinstance(rows, list) else ())]
    for path, holder in holders:
        for name in EFFECT_SECTIONS if isinstance(holder, dict) else ():
            if isinstance(holder.get(name), dict):
                yield (*path, name), holder[name]


def not_given(document: Tables) -> Iterator[Path]:
    """Where a key may be given that is not, in the tables of effects that there are."""
    for path, table in tables_of_effects(document):
        for name in EFFECT_SECTIONS[str(path[-1])]:
            steps = name.split(".")
            holder: Any = table
            for step in steps[:-1]:
                holder = holder.get(step, {}) if isinstance(holder, dict) else None
            is_open = isinstance(holder, dict) and not isinstance(holder.get(steps[-1]), str | int | float)
            if is_open and name not in _LISTS[str(path[-1])]:
                yield (*path, *steps)


def replaces(path: Path) -> list[Path]:
    """What a key of a table of an effect stands in place of: a fit of its interference, and the other way round."""
    name, table = str(path[-1]), path[:-1]
    seat = name.partition("_")[0]
    if table[-1:] == (RingExpansion.name,) and seat in FITTED:
        fit, number = f"{seat}_fit", f"{seat}_interference_um"
        return [(*table, other) for one, other in ((fit, number), (number, fit)) if name == one]
    return []


def brings(path: Path, document: Tables) -> list[dict[str, Any]]:
    """What is usual beside a key and would be missing without: with a fit in it, a housing of some outside diameter."""
    table: Any = document
    for step in path[:-1]:
        table = table.get(step, {}) if isinstance(table, dict) else table[step]
    outside, housing = "outside_diameter_mm", "housing_outside_diameter_mm"
    if path[-1] not in ("housing_fit", "housing_interference_um") or housing in table:
        return []
    size = table.get(outside)
    usual = float(f"{USUAL_HOUSING * size:.4g}") if isinstance(size, int | float) else None
    words = f"a housing {USUAL_HOUSING:g} times as large as the outer ring: change it below where it is another"
    return [] if usual is None else [{"path": (*path[:-1], housing), "value": usual, "words": words}]


def with_effect(entry: Entry, document: Tables, label: str) -> tuple[Tables, str]:
    """The tables with an effect that they lack, as far as its numbers are known; and what is assumed for it."""
    of = named(document, label)
    if (finer := entry.finer(of)) is not of:
        return input_tables(finer), ""
    if entry.name not in EFFECT_TABLES:
        return input_tables(of), ""
    bare = copy.deepcopy(input_tables(of))
    bare["effects"][entry.name] = {}
    try:
        return input_tables(read(bare, label)), ""
    except SceneError:
        pass
    points = [row.operating_point for row in rows_of(solution_of(document, label))]
    for assumed in entry.assume(of, points):
        if assumed.of is not of:
            which = "Assumed is the first of these" if assumed.under else "Assumed"
            return _as_of_all(entry, of, assumed.of, bare), f"{which}: {assumed.what}."
    return bare, ""


def _as_of_all(entry: Entry, of: Any, assumed: Any, bare: Tables) -> Tables:
    """With one table for all rows of a set, where none has effects of its own and it is the same for all of them."""
    tables = input_tables(assumed)
    if not isinstance(of, BearingSet) or any(row.ring_effects is not None for row in of.rows):
        return tables
    first, *others = (row.get(entry.name) for row in tables["rows"])
    if any(each != first for each in others):
        return tables
    bare["effects"][entry.name] = first
    return bare


def without_printed(document: Tables) -> Tables:
    """The tables without what those of effects have from the bearing: another one has other dimensions."""
    tables = copy.deepcopy(document)
    for path, table in tables_of_effects(tables):
        for key in EFFECT_TABLES.get(str(path[-1]), ()):
            *steps, last = key.name.split(".")
            holder: Any = table
            for step in steps:
                holder = holder.get(step, {}) if isinstance(holder, dict) else {}
            if key.printed and isinstance(holder, dict):
                holder.pop(last, None)
    return tables


def can_be_added(entry: Entry, of: Any) -> bool:
    """Whether a switch puts it in, if need be with fields that are empty."""
    return entry.finer(of) is not of or (entry.name in EFFECT_TABLES and entry.applies(of))
