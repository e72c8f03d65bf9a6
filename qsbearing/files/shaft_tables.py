"""What is around the rows of a set as tables of its file: [shaft], [housing], [[spacers]], [[floating]]; read and
written."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.keys import DIAMETERS, NUMBERED, PRELOAD, keys_of
from qsbearing.files.scene_file import preload_of
from qsbearing.files.set_keys import GRAVITY, MATRIX, OF_SET, OTHERS, RECORDS, SET_NUMBERS
from qsbearing.files.shaft_spans import with_lengths
from qsbearing.files.table_checks import (
    UNUSABLE,
    Errors,
    add_missing,
    as_it_is,
    as_number,
    checked,
    judged,
    list_of,
    made,
    read_fields,
    si,
    table_model,
)
from qsbearing.model.described import choices_of, parts_of
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.belts import belt_errors
from qsbearing.systems.sets.gears import gear_errors
from qsbearing.systems.sets.shaft import (
    Housing,
    HousingStiffness,
    Shaft,
)

_ELASTIC = "Each with length_mm and outer_diameter_mm; they make the shaft elastic"
_LISTED = tuple(kind for kind, name in NUMBERED.items() if name in parts_of(Shaft))


_JUDGES: dict[str, Callable[[str, Any], Any]] = {"gears": gear_errors, "belts": belt_errors}
"""What finds every fault of one of a list's tables, whatever else the file has."""
_SHAFT = table_model("shaft", SET_NUMBERS["shaft"])


def surroundings(document: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """The arguments of a BearingSet that these tables give."""
    table = document.get("shaft", {})
    table = with_lengths(table, errors) if isinstance(table, dict) else table
    plain = {k: v for k, v in table.items() if k not in OTHERS["shaft"]} if isinstance(table, dict) else table
    good, _ = checked(_SHAFT, "shaft", plain, errors)
    numbers: dict[str, Any] = si(keys_of(Shaft), good)
    arguments: dict[str, Any] = si(OF_SET, good)
    if isinstance(table, dict) and any(name in table for name in OTHERS["shaft"]):
        arguments["shaft"] = _shaft(table, numbers, errors)
    elif numbers:
        errors.append(FileErrorDetail("[[shaft.sections]]", "missing", cause=_ELASTIC))
    if "housing" in document:
        arguments["housing"] = _housing(document["housing"], errors)
    arguments["spacers"] = tuple(_listed(document, "spacers", "spacer", errors))
    arguments["floating"] = tuple(_listed(document, "floating", "floating", errors))
    return arguments


def surroundings_tables(
    of: BearingSet, numbers: Callable[..., Any], written: Callable[[Any], dict[str, Any]]
) -> dict[str, Any]:
    """The tables that these are read from.

    Args:
        numbers: of the keys of a table, those that an object holds.
        written: what is described at the fields of an object.
    """
    tables: dict[str, Any] = {}
    if of.shaft is not None or numbers(OF_SET, of):
        tables["shaft"] = numbers(OF_SET, of)
    if of.shaft is not None:
        # Where it begins and how warm it is, only its sections know.
        tables["shaft"] |= numbers(SET_NUMBERS["shaft"], of.shaft) if of.shaft.sections else {}
        for kind in _LISTED:
            name = NUMBERED[kind]
            listed = [written(each) for each in getattr(of.shaft, name)]
            tables["shaft"] |= {name: listed} if listed else {}
        if of.shaft.gravity is not None:
            tables["shaft"][GRAVITY.name] = list(of.shaft.gravity)
        if of.shaft.points:
            tables["shaft"]["points"] = {
                f"{name}_mm": float(f"{at * 1e3:.12g}") for name, at in of.shaft.points.items()
            }
    if of.housing is not None:
        tables["housing"] = written(of.housing)
    if of.spacers:
        tables["spacers"] = [{"rows": list(each.rows), **written(each)} for each in of.spacers]
    if of.floating:
        tables["floating"] = [
            {"rows": list(each.rows), **written(each)}
            | ({} if each.preload is None else {"preload": numbers(PRELOAD, each.preload)})
            for each in of.floating
        ]
    return tables


def _shaft(table: dict[str, Any], numbers: dict[str, Any], errors: Errors) -> Shaft | None:
    before = len(errors)
    parts: dict[str, Any] = {}
    for kind in _LISTED:
        parts[NUMBERED[kind]] = tuple(_listed(table, NUMBERED[kind], f"shaft.{kind}", errors))
    if GRAVITY.name in table:
        refused: list[Any] = []
        gravity = list_of(as_number)(table[GRAVITY.name], refused)
        if refused or len(gravity) != 3:
            cause = f"Three numbers, along x, y and z: {GRAVITY.name} = [0, -9.81, 0]"
            errors.append(FileErrorDetail(f"shaft.{GRAVITY.name}", "is not an acceleration", cause=cause))
        else:
            parts["gravity"] = tuple(gravity)
    points = table.get("points", {})
    named = {}
    if not isinstance(points, dict):
        cause = "Write it as [shaft.points], positions below it, such as tool_mm = -70"
        errors.append(FileErrorDetail("shaft.points", "is not a table", points, cause=cause))
    for name, value in points.items() if isinstance(points, dict) else ():
        if type(value) not in (int, float) or not name.endswith("_mm") or not np.isfinite(value):
            cause = "A position, such as tool_mm = -70"
            errors.append(FileErrorDetail(f"shaft.points.{name}", "is not a position", value, "mm", cause=cause))
        else:
            named[name.removesuffix("_mm")] = value * 1e-3
    if not parts["sections"] and numbers and len(errors) == before:
        errors.append(FileErrorDetail("[[shaft.sections]]", "missing", cause=_ELASTIC))
    return made(partial(Shaft, **parts, points=named, **numbers), errors) if len(errors) == before else None


def _housing(table: Any, errors: Errors) -> Housing | None:
    given = read_fields(Housing, "housing", "housing", table, errors, {DIAMETERS[1].name: as_number})
    given.pop(DIAMETERS[1].name, None)  # which fits count with: `stated`
    return made(partial(Housing, **given), errors)


def housing_stiffness(table: Any, path: str, errors: Errors) -> HousingStiffness | None:
    """Of a row's table within [[rows]]."""
    before = len(errors)
    given = read_fields(HousingStiffness, "housing_stiffness", path, table, errors, {MATRIX.name: as_it_is})
    given |= {MATRIX.field: given.pop(MATRIX.name)} if MATRIX.name in given else {}
    return made(partial(HousingStiffness, **given), errors) if len(errors) == before else None


def _listed(document: dict[str, Any], name: str, path: str, errors: Errors) -> list[Any]:
    """What a list of tables makes."""
    make = RECORDS[name]
    tables = document.get(name, [])
    if not isinstance(tables, list):
        errors.append(FileErrorDetail(f"[[{'shaft.' * ('.' in path)}{name}]]", "is not a list of tables"))
        return []
    records = []
    for number, table in enumerate(tables, 1):
        at, before = f"{path} {number}", len(errors)
        # Of words, the object says which it knows, and of others why they are not computed.
        given = read_fields(make, name, at, table, errors, dict.fromkeys(choices_of(make), as_it_is))
        add_missing(make, at, given, errors)
        if "rows" in OTHERS[name]:
            rows = given.get("rows")
            if rows is not UNUSABLE and (not isinstance(rows, list) or not all(type(row) is int for row in rows)):
                cause = "Numbers of rows, from 1 in the order of the file: rows = [1, 2]"
                problem = "missing" if rows is None else "are no numbers"
                errors.append(FileErrorDetail(f"{at}.rows", problem, rows, cause=cause))
            given["rows"] = tuple(rows) if isinstance(rows, list) else ()
        if given.get("preload", UNUSABLE) is not UNUSABLE:
            given["preload"] = preload_of(given["preload"], None, errors)
        if judge := _JUDGES.get(name):
            told = {each.key for each in errors[before:]}
            wrong = map(translate, judged(judge(at, make(**given))))
            errors += [each for each in wrong if each.key not in told]
        one = made(partial(make, **given), errors) if len(errors) == before else None
        records += [] if one is None else [one]
    return records
