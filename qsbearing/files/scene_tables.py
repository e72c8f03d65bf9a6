"""A scene or a set as the tables of its file: what `scene_file` and `set_file` read, written by the same keys."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from math import inf, nextafter
from typing import Any

import numpy as np

from qsbearing.files import catalogue
from qsbearing.files.bearing_table import entry_of, is_in_radians, label_of
from qsbearing.files.data_sheet_table import sheet_tables
from qsbearing.files.effects_table import AUTO
from qsbearing.files.file_keys import REQUIRE, reading_keys, reading_tables
from qsbearing.files.keys import (
    BALL_DEVIATIONS,
    BEARING,
    CLEARANCE,
    EFFECTS,
    FREE_ANGLE,
    MATERIAL,
    MATERIALS,
    OPERATION,
    PLAY,
    PRELOAD,
    PRINTED,
    SEATS,
    Key,
    key_of,
    keys_of,
)
from qsbearing.model.bearing import BallBearing, free_angle_from_clearance
from qsbearing.model.described import choices_of, lists_of, materials_of
from qsbearing.model.effects import BallDiameterDeviations, ElasticRings, GyroscopicMoment
from qsbearing.model.effects.traction import Traction
from qsbearing.model.material import BY_NAME, Material
from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.requirement import requirement_table
from qsbearing.model.scene.scene import CHOICES, Scene
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.row import Row

Tables = dict[str, Any]
_BEARING = tuple(key for key in BEARING if key not in (FREE_ANGLE, CLEARANCE, PLAY))
NEIGHBOURS = 8
"""Floats on either side among which a file's number is looked for: on its way to SI it was rounded once or twice."""


def input_tables(of: Scene | BearingSet) -> Tables:
    """The tables of the file that describes a scene or set, defaults and the catalogue's numbers filled in.

    Read back they make the same scene, to the last bit where it came from a file; a number made in Python may lie
    between those that a file can give, and is off by a rounding (1e-16).

    Raises:
        SceneError: something that no file has a key for.
    """
    if isinstance(of, BearingSet):
        from qsbearing.files.shaft_tables import surroundings_tables  # a scene does not load it

        common = of.rows[0].bearing
        is_common = all(row.bearing is common and row.ring_effects is None for row in of.rows)
        tables: Tables = {"bearing": _bearing(common)} if is_common else {}
        tables["rows"] = [_row(row, not is_common) for row in of.rows]
        tables |= surroundings_tables(of, _numbers, _written)
    else:
        tables = {"bearing": _bearing(of.bearing)}
    if "spectrum" in of.readings:
        tables["spectrum"] = [
            {"share": float(share), **_numbers(OPERATION, of.operation, point)}
            for point, share in enumerate(of.readings["spectrum"]["time_share"])
        ]
    else:
        tables["operation"] = _numbers(OPERATION, of.operation)
        channels = {name for channel in CHANNELS for name in (channel.load, channel.displacement)}
        if of.preload is None and not any(getattr(of.operation, name) is not None for name in channels):
            tables["operation"]["axial_load_N"] = 0.0  # a file states that nothing acts
    if of.preload is not None:
        tables["preload"] = _numbers(PRELOAD, of.preload)
    tables |= _effects(of) | {"readings": _readings(of.readings)}
    tables |= {REQUIRE: requirement_table(of.require)} if of.require else {}
    tables = _at_points(tables.get("spectrum"), tables)
    if of.thermal is None:
        return tables
    from qsbearing.files.thermal_table import thermal_tables  # loaded only where there is heat

    return thermal_tables(tables, of.thermal, _numbers)


def _written(of: Any) -> Tables:
    """What is described at the fields of an object, but the parts that are tables of their own."""
    bodies, words = ({name: getattr(of, name) for name in each(type(of))} for each in (materials_of, choices_of))
    lists = {key.name: (key, getattr(of, key.field)) for key in map(key_of, lists_of(type(of)))}
    table: Tables = _numbers(keys_of(type(of)), of)
    table |= {name: _material(body) for name, body in bodies.items() if body is not None}
    table |= {name: word if isinstance(word, bool) else str(word) for name, word in words.items() if word is not None}
    given = {name: (key, each) for name, (key, each) in lists.items() if each is not None}
    return table | {name: np.array([_number(key, one) for one in each]).tolist() for name, (key, each) in given.items()}


def _row(row: Row, with_bearing: bool) -> Tables:
    table = _written(row)
    if row.housing_stiffness is not None:
        table["housing_stiffness"] = _written(row.housing_stiffness)
    if with_bearing:
        table["bearing"] = _bearing(row.bearing)
    table |= _ring_effects(row.ring_effects or ())
    return table if row.readings is None else table | {"readings": _readings(row.readings)}


def _bearing(bearing: BallBearing) -> Tables:
    if bearing.inferred is not None:
        tables = sheet_tables(bearing) | {side: _material(getattr(bearing, side)) for side in MATERIALS}
        return tables | _outline(bearing, None)
    entry = entry_of(bearing)
    table: Tables = {"kind": str(bearing.kind), **_numbers(_BEARING, bearing), **_angle(bearing, entry)}
    table["ball_count"] = int(table["ball_count"])
    table |= {side: _material(getattr(bearing, side)) for side in MATERIALS}
    is_named = entry is not None and label_of(entry, table) == bearing.name
    table |= _outline(bearing, entry if is_named else None)
    return {"name": entry.name, **table} if entry is not None and is_named else table


def _outline(bearing: BallBearing, entry: catalogue.CatalogueEntry | None) -> Tables:
    """What is known of the rings from outside, but what the catalogue's entry of its name has."""
    numbers = {} if bearing.outline is None else _numbers(PRINTED, bearing.outline)
    printed = {} if entry is None else entry.dimensions
    return {name: value for name, value in numbers.items() if not np.isclose(printed.get(name, 0.0), value, rtol=1e-12)}


def _angle(bearing: BallBearing, entry: catalogue.CatalogueEntry | None) -> dict[str, float]:
    """The free contact angle, or the clearance that it was made from."""
    angle, clearance = FREE_ANGLE, CLEARANCE
    if np.any(bearing.radial_interference):
        wedged = _single(clearance, bearing.radial_interference)
        about = -2.0 * wedged / clearance.size
        short = _read_as(wedged, about, lambda given: -0.5 * clearance.si(given), NEIGHBOURS)
        return {clearance.name: about if short is None else short}
    value, distance = _single(angle, bearing.free_contact_angle), bearing.groove_centre_distance
    near = {angle: value / angle.size, clearance: float(bearing.diametral_clearance) / clearance.size}
    read = {angle: angle.si, clearance: lambda given: float(free_angle_from_clearance(clearance.si(given), distance))}
    forms = [clearance, angle] if entry is not None and clearance.name in entry.bearing else [angle, clearance]
    if bearing.is_arched:
        forms = [angle]
    if is_in_radians(bearing.kind, near[angle]):
        forms = [clearance]
    for count in (0, NEIGHBOURS):
        for key in forms:
            short = _read_as(value, near[key], read[key], count)
            if short is not None:
                return {key.name: short}
    return {forms[0].name: near[forms[0]]}


def _material(material: Material) -> str | dict[str, float]:
    """A material's name, or its numbers."""
    return material.name if material in BY_NAME.values() else _numbers(MATERIAL, material)


def _effects(of: Scene | BearingSet) -> Tables:
    if of.tolerance is not None:
        requested = {each.name: each.default for each in fields(Scene) if each.name in (*CHOICES, "ball_effects")}
        if of.ring_effects or any(getattr(of, name) != usual for name, usual in requested.items()):
            raise _without_key("tolerance", "a file chooses all effects by it, or names them")
        return {"effects": AUTO, "tolerance": of.tolerance}
    table: Tables = {"ball": [effect.name for effect in of.ball_effects]}
    table |= {name: str(getattr(of, name)) for name in CHOICES if getattr(of, name) is not None}
    for effect in of.ball_effects:
        if isinstance(effect, GyroscopicMoment):
            shares = {} if of.raceway_control == "friction" else {"moment_shares": str(effect.moment_shares)}
            table |= {**shares, **_numbers(EFFECTS, effect)}
    if (law := getattr(of, Traction.name, None)) is not None:
        table[Traction.name] = _traction(law)
    return {"effects": table | _ring_effects(of.ring_effects)}


def _traction(law: Traction) -> Tables:
    if not law.has_curvature:
        raise _without_key("traction.has_curvature", "only Python gives it")
    return {"law": str(law.law)} | _written(law)


def _ring_effects(effects: Iterable[Any]) -> Tables:
    tables: Tables = {}
    for effect in effects:
        if isinstance(effect, BallDiameterDeviations):
            tables[BALL_DEVIATIONS.name] = [_number(BALL_DEVIATIONS, value) for value in effect.array]
            continue
        tables[effect.name] = _written(effect)
        if isinstance(effect, ElasticRings):
            tables[effect.name] = _elastic_rings(effect, tables[effect.name])
        for seat, fit in getattr(effect, "fits", {}).items():
            if getattr(effect, f"{seat}_interference") == fit.mean:  # else it was changed since
                del tables[effect.name][f"{seat}_interference_um"]
                tables[effect.name] |= {f"{seat}_fit": fit.name, "tolerance_class": fit.tolerance_class}
        bodies = [name for name in materials_of(type(effect)) if name in tables[effect.name]]
        tables[effect.name] |= {name: tables[effect.name].pop(name) for name in bodies}
    return tables


def _elastic_rings(effect: ElasticRings, flat: Tables) -> Tables:
    """Tables within tables, as the points in the keys say."""
    flat |= {name: str(getattr(effect, field)) for name, field in SEATS.items() if getattr(effect, field) is not None}
    tables: Tables = {}
    for name, value in flat.items():
        *path, last = name.split(".")
        table = tables
        for each in path:
            table = table.setdefault(each, {})
        table[last] = value
    return tables


def _readings(requested: Mapping[str, Mapping[str, Any]]) -> Tables:
    if not requested:
        return {}
    from qsbearing.readings.asked import with_defaults  # a scene without readings does not load them

    tables: Tables = {}
    for name, arguments in requested.items():
        if name == "spectrum":
            continue  # its points are the file's operation
        given = with_defaults(name, arguments)
        keys, choices = reading_keys(name), reading_tables()[name].choices
        words = {choice: str(given[choice]) for choice in choices if choice in given}
        for field in set(given) - set(words) - {key.field for key in keys}:
            raise _without_key(f"readings.{name}.{field}", "only Python gives it")
        tables[name] = words | _numbers(keys, given)
    return tables


def _numbers(keys: Iterable[Key], holder: Any, case: int | None = None) -> dict[str, float]:
    """The numbers that an object or a mapping holds, under the keys of a file.

    Args:
        case: which of the cases that they may span; None: they span none.
    """
    numbers = {}
    for key in keys:
        value = holder.get(key.field) if isinstance(holder, Mapping) else getattr(holder, key.field, None)
        if value is not None:
            numbers[key.name] = _number(key, np.ravel(value)[case] if np.ndim(value) and case is not None else value)
    return numbers


def _at_points(points: list[Tables] | None, table: Any, before: str = "") -> Any:
    """Tables without the numbers that differ between the points of a spectrum, which get these by their paths."""
    if isinstance(table, list):
        return [_at_points(points, each, f"{before}{number}.") for number, each in enumerate(table, 1)]
    if not isinstance(table, dict):
        return table
    kept = {}
    for name, value in table.items():
        if isinstance(value, np.ndarray):
            if points is None or value.size != len(points):
                raise _without_key(name, "it spans cases, and a file has one")
            for point, number in zip(points, value.tolist(), strict=True):
                point[before + name] = number
        else:
            kept[name] = _at_points(points, value, f"{before}{name}.")
    return kept


def _number(key: Key, value: Any) -> Any:
    """A value in the file's unit: the number, of few digits if there is one, that is read as just this value."""
    if np.ndim(value) == 1:
        return np.array([_number(key, each) for each in value])
    alone = _single(key, value)
    near = (alone - key.zero) / key.size
    short = _read_as(alone, near, key.si, NEIGHBOURS)
    return near if short is None else short


def _single(key: Key, value: Any) -> float:
    if np.ndim(value):
        raise _without_key(key.name, "it spans cases, and a file has one")
    return float(value)


def _read_as(value: float, near: float, read: Callable[[float], float], neighbours: int) -> float | None:
    """A number that is read as this value: of twelve digits, or among so many floats on either side; None: none is."""
    up = down = near
    candidates = [float(f"{near:.12g}"), near][: 2 if neighbours else 1]
    for _ in range(neighbours):
        up, down = nextafter(up, inf), nextafter(down, -inf)
        candidates += [up, down]
    return next((each for each in candidates if read(each) == value), None)


def _without_key(field: str, cause: str) -> SceneError:
    return SceneError([ErrorDetail(field, "has no form in a file", cause=cause[0].upper() + cause[1:])])
