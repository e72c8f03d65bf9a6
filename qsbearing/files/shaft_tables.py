"""What is around the rows of a set as tables of its file: [shaft], [housing], [[spacers]], [[floating]]; read and
written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, fields
from functools import partial
from typing import Any

import numpy as np

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.housing_table import MODEL as HOUSING
from qsbearing.files.scene_file import preload_of
from qsbearing.files.table_checks import (
    Errors,
    TableModel,
    as_it_is,
    as_number,
    checked,
    list_of,
    made,
    material,
    si,
    table_model,
)
from qsbearing.model.material import Material
from qsbearing.model.scene.keys import (
    FLOATING,
    HEATED,
    HOUSING_STIFFNESS,
    NUMBERED,
    PRELOAD,
    SECTION,
    SHAFT,
    SHAFT_LOAD,
    SHAFT_MASS,
    SHAFT_SUPPORT,
    SPACER,
    Key,
)
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.shaft import (
    FloatingGroup,
    Housing,
    HousingStiffness,
    Shaft,
    ShaftLoad,
    ShaftMass,
    ShaftSection,
    ShaftSupport,
    Spacer,
)

_ELASTIC = "Each with length_mm and outer_diameter_mm; they make the shaft elastic"
_LISTED = ("section", "load", "support", "mass")
WITHIN_SHAFT = (*(NUMBERED[kind] for kind in _LISTED), "points", "gravity_m_s2")
_MATERIAL = {"material": as_it_is}
_SHAFT = table_model("shaft", SHAFT)
_STIFFNESS = table_model("housing_stiffness", HOUSING_STIFFNESS, {"matrix_SI": as_it_is})
_LISTS: dict[str, tuple[Any, tuple[Key, ...], TableModel]] = {
    "section": (ShaftSection, SECTION, table_model("sections", SECTION, _MATERIAL)),
    "load": (ShaftLoad, SHAFT_LOAD, table_model("loads", SHAFT_LOAD)),
    "support": (ShaftSupport, SHAFT_SUPPORT, table_model("supports", SHAFT_SUPPORT)),
    "mass": (ShaftMass, SHAFT_MASS, table_model("masses", SHAFT_MASS)),
    "spacer": (
        Spacer,
        SPACER,
        table_model("spacers", SPACER, dict.fromkeys(("rows", "inner_material", "outer_material"), as_it_is)),
    ),
    "floating": (
        FloatingGroup,
        FLOATING,
        table_model("floating", FLOATING, dict.fromkeys(("rows", "preload"), as_it_is)),
    ),
}
"""Of each table of which there are several: what it makes, its numbers, and how it is built."""


def surroundings(document: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """The arguments of a BearingSet that these tables give."""
    table = document.get("shaft", {})
    plain = {k: v for k, v in table.items() if k not in WITHIN_SHAFT} if isinstance(table, dict) else table
    good, _ = checked(_SHAFT, "shaft", plain, errors)
    numbers: dict[str, Any] = si(SHAFT, good)
    found = {"reference_position": numbers.pop("reference_position", None)}
    if isinstance(table, dict) and any(name in table for name in WITHIN_SHAFT):
        found["shaft"] = _shaft(table, numbers, errors)
    elif numbers:
        errors.append(FileErrorDetail("[[shaft.sections]]", "missing", cause=_ELASTIC))
    if "housing" in document:
        found["housing"] = _housing(document["housing"], errors)
    found["spacers"] = tuple(_listed(document, "spacers", "spacer", "spacer", errors))
    found["floating"] = tuple(_listed(document, "floating", "floating", "floating", errors))
    return found


def surroundings_tables(
    of: BearingSet, numbers: Callable[..., Any], named: Callable[[Material], Any]
) -> dict[str, Any]:
    """The tables that these are read from.

    Args:
        numbers: of the keys of a table, those that an object holds.
        named: a material as a file has it.
    """
    tables: dict[str, Any] = {}
    if of.shaft is not None or of.reference_position is not None:
        tables["shaft"] = numbers(SHAFT[:1], of)
    if of.shaft is not None:
        tables["shaft"] |= numbers(SHAFT[1:], of.shaft)
        for kind in _LISTED:
            name, keys = NUMBERED[kind], _LISTS[kind][1]
            listed = [numbers(keys, each) for each in getattr(of.shaft, name)]
            tables["shaft"] |= {name: listed} if listed else {}
        for table, section in zip(tables["shaft"].get("sections", ()), of.shaft.sections, strict=True):
            table["material"] = named(section.material)
        if of.shaft.gravity is not None:
            tables["shaft"]["gravity_m_s2"] = list(of.shaft.gravity)
        if of.shaft.points:
            tables["shaft"]["points"] = {
                f"{name}_mm": float(f"{at * 1e3:.12g}") for name, at in of.shaft.points.items()
            }
    if of.housing is not None:
        tables["housing"] = numbers(HEATED, of.housing) | {"material": named(of.housing.material)}
    if of.spacers:
        sides = ("inner_material", "outer_material")
        tables["spacers"] = [
            {"rows": list(each.rows), **numbers(SPACER, each), **{side: named(getattr(each, side)) for side in sides}}
            for each in of.spacers
        ]
    if of.floating:
        tables["floating"] = [
            {"rows": list(each.rows), **numbers(FLOATING, each)}
            | ({} if each.preload is None else {"preload": numbers(PRELOAD, each.preload)})
            for each in of.floating
        ]
    return tables


def stiffness_table(of: HousingStiffness, numbers: Callable[..., Any]) -> dict[str, Any]:
    """The table [rows.housing_stiffness]."""
    given: dict[str, Any] = numbers(HOUSING_STIFFNESS, of)
    return given if of.matrix is None else {"matrix_SI": np.asarray(of.matrix, float).tolist()}


def _shaft(table: dict[str, Any], numbers: dict[str, Any], errors: Errors) -> Shaft | None:
    before = len(errors)
    parts: dict[str, Any] = {}
    for kind in _LISTED:
        parts[NUMBERED[kind]] = tuple(_listed(table, NUMBERED[kind], kind, f"shaft.{kind}", errors))
    if "gravity_m_s2" in table:
        refused: list[Any] = []
        gravity = list_of(as_number)(table["gravity_m_s2"], refused)
        if refused or len(gravity) != 3:
            cause = "Three numbers, along x, y and z: gravity_m_s2 = [0, -9.81, 0]"
            errors.append(FileErrorDetail("shaft.gravity_m_s2", "is not an acceleration", cause=cause))
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
    good, _ = checked(HOUSING, "housing", table, errors)
    given: dict[str, Any] = si(HEATED, good)
    if "material" in good:
        given["material"] = material("housing.material", good["material"], errors)
    return made(partial(Housing, **given), errors)


def housing_stiffness(table: Any, path: str, errors: Errors) -> HousingStiffness | None:
    """Of a row's table within [[rows]]."""
    good, unusable = checked(_STIFFNESS, path, table, errors)
    if unusable:
        return None
    given: dict[str, Any] = si(HOUSING_STIFFNESS, good)
    if "matrix_SI" in good:
        given["matrix"] = good["matrix_SI"]
    return made(partial(HousingStiffness, **given), errors)


def _listed(document: dict[str, Any], name: str, kind: str, path: str, errors: Errors) -> list[Any]:
    """What a list of tables makes."""
    make, keys, model = _LISTS[kind]
    tables = document.get(name, [])
    if not isinstance(tables, list):
        errors.append(FileErrorDetail(f"[[{'shaft.' * ('.' in path)}{name}]]", "is not a list of tables"))
        return []
    found = []
    for number, table in enumerate(tables, 1):
        at, before = f"{path} {number}", len(errors)
        good, unusable = checked(model, at, table, errors)
        given: dict[str, Any] = si(keys, good)
        needed = [field.name for field in fields(make) if field.default is MISSING]
        for key in keys:
            if key.field in needed and key.name not in good and key.name not in unusable:
                errors.append(FileErrorDetail(f"{at}.{key.name}", "missing"))
        for side in ("material", "inner_material", "outer_material"):
            if side in good:
                given[side] = material(f"{at}.{side}", good[side], errors)
        if "rows" in model.checks:
            rows = good.get("rows")
            if not isinstance(rows, list) or not all(type(row) is int for row in rows):
                cause = "Numbers of rows, from 1 in the order of the file: rows = [1, 2]"
                problem = "missing" if rows is None else "are no numbers"
                errors.append(FileErrorDetail(f"{at}.rows", problem, rows, cause=cause))
            else:
                given["rows"] = tuple(rows)
        if "preload" in good:
            given["preload"] = preload_of({"preload": good["preload"]}, None, errors)
        one = made(partial(make, **given), errors) if len(errors) == before else None
        found += [] if one is None else [one]
    return found
