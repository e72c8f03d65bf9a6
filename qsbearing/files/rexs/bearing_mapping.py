"""A rolling bearing of a REXS model as tables of a scene file: geometry, materials, direction, fits, oil.

What the file leaves open is assumed, and each assumption stands beside the key that it made.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files import catalogue
from qsbearing.files.bearing_table import bearing_of
from qsbearing.files.designations import read
from qsbearing.files.fits import names as fit_names
from qsbearing.files.keys import BALL_EXPANSION, BEARING, MATERIAL, MATERIALS, PRINTED, RING_EXPANSION, Key, key_of
from qsbearing.files.rexs.axes import turned
from qsbearing.files.rexs.model import Component
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.scene_text import NotedTable
from qsbearing.files.table_checks import Errors
from qsbearing.model.bearing import BearingKind
from qsbearing.model.material import STEEL
from qsbearing.model.units import mm
from qsbearing.systems.sets.shaft import REFERENCE_TEMPERATURE

ROLLING = ("rolling_bearing_with_detailed_geometry", "rolling_bearing_with_catalog_geometry")
KINDS = {
    "angular_contact_ball_bearing": BearingKind.ANGULAR_CONTACT,
    "axial_angular_contact_ball_bearing": BearingKind.ANGULAR_CONTACT,
    "radial_grooved_ball_bearing": BearingKind.DEEP_GROOVE,
}
"""Bearings that are ours, by their type; rollers and four-point contact are not."""
ASSUMED = "assumed: the model does not say"
_KEYS = {key.name: key for keys in (BEARING, PRINTED, MATERIAL, RING_EXPANSION, BALL_EXPANSION) for key in keys}
_OF_BEARING = {
    "bore_diameter_mm": "inner_diameter", "outside_diameter_mm": "outer_diameter", "width_mm": "width",
    "dynamic_load_rating_N": "radial_dynamic_load_rating", "static_load_rating_N": "radial_static_load_rating",
}  # fmt: skip
_OF_ROW = {
    "pitch_diameter_mm": "reference_diameter_rolling_bearing",
    "inner_groove_radius_mm": "raceway_radius_of_inner_ring",
    "outer_groove_radius_mm": "raceway_radius_of_outer_ring",
}
_OF_MATERIAL = {
    "elastic_modulus_GPa": "elastic_modulus", "poisson_ratio": "poisson_ratio", "density_kg_m3": "density",
    "thermal_expansion_per_K": "thermal_expansion_coefficient_plus",
}  # fmt: skip
_SEATS = (
    ("shaft", "bore", 1.0, ("shaft", "bearing_bore"), "shaft_tolerance_class",
     "shaft_bore_diameter_mm", "shaft_inner_diameter"),
    ("housing", "outside", -1.0, ("casing_bore", "bearing_outer"), "casing_bore_tolerance_class",
     "housing_outside_diameter_mm", "casing_outer_diameter"),
)  # fmt: skip
"""Of each seat: what of the bearing it is fitted to, the sign of interference, whose limits make it, and its wall."""
_ENDS = ("minimum", "maximum")
SAME_PLACE = 1e-6
"""Metres: places of inner and outer side that are nearer are the same (files round to a micrometre)."""
_DIRECTIONS = {"positive": 1.0, "negative": -1.0, "both_directions": 1.0}
NO_DIRECTION = "no_direction"


@dataclass
class BearingRow:
    """One row of balls of a bearing."""

    bearing: Component
    table: NotedTable
    """[bearing]"""
    turn: NDArray
    """`axes.turned`"""
    direction: float | None
    """Of the axial load on the shaft that it carries, along the shaft's u: 1 or -1; None: not told."""
    floats: bool
    """Whether the outer ring carries no axial load."""
    located: str
    """How the outer ring of a deep-groove row is held, as `carries` has it; empty: not told, or of another row."""
    position: float | None
    """Of the balls' centres along the shaft [m]."""
    effects: NotedTable
    """Ring and ball expansion, where the model tells of fits or temperatures."""
    first_azimuth: float | None
    """Of the first ball, in the axes of the scene [rad]."""
    offset: float | None = None
    """By which it is preloaded [m]."""
    out_of_line: tuple[float | None, ...] = (None,) * 4
    """Of its housing along y and z [m] and about them [rad], in the shaft's axes; None: not told."""


def is_ours(reader: AttributeReader, component: Component) -> bool:
    """Whether a component is a bearing that is solved here."""
    return component.kind in ROLLING and reader.word(component, "bearing_type") in KINDS


def rows_of(reader: AttributeReader, bearing: Component, shaft: Component | None) -> list[BearingRow]:
    """The rows of a bearing, in its order along the shaft."""
    parts: list[Component | None] = [*reader.model.parts(bearing.number, "rolling_bearing_row")]
    count = max(reader.whole(bearing, "number_of_bearing_rows") or 1, 1)
    parts = parts or [None] * min(count, 4)
    turn = turned(reader, bearing, shaft)
    middle = reader.number(bearing, "u_coordinate_on_shaft_inner_side")
    outside = reader.number(bearing, "u_coordinate_on_shaft_outer_side")
    distance = reader.number(bearing, "distance_between_bearing_rows") or 0.0
    offset, out_of_line = reader.positive(bearing, "preload_distance"), _out_of_line(reader, bearing, turn)
    rows = []
    for number, part in enumerate(parts):
        along = (number - 0.5 * (len(parts) - 1)) * distance * turn[0, 0]
        absorbs = (reader.word(part, "axial_force_absorption_of_row") if part else "") or reader.word(
            bearing, "axial_force_absorption"
        )
        direction = _DIRECTIONS.get(absorbs)
        table = _bearing(reader, bearing, part)
        is_either = table.get("kind") == BearingKind.DEEP_GROOVE
        effects = _expansion(reader, bearing, part, table)
        _materials(reader, bearing, part, table, needs_expansion=bool(effects))
        _name(reader, bearing, table)
        if middle is not None and outside is not None and abs(outside - middle) > SAME_PLACE:
            shift = f"{(outside - middle) / mm:.6g} mm"
            table.note("", f"its outer side lies {shift} from its inner side along the shaft, which is left out")
        rows.append(
            BearingRow(
                bearing, table, turn, 1.0 if is_either else None if direction is None else direction * turn[0, 0],
                absorbs == NO_DIRECTION, _located(absorbs, turn[0, 0]) if is_either else "",
                None if middle is None else middle + along, effects, _first_azimuth(reader, part, turn, table), offset,
                out_of_line,
            )
        )  # fmt: skip
    return rows


def _located(absorbs: str, along: float) -> str:
    """Of a deep-groove row; empty: the model does not say.

    Args:
        along: 1, or -1 where its own axis points along -u of the shaft.
    """
    if absorbs in ("positive", "negative"):
        return "+x" if _DIRECTIONS[absorbs] * along > 0.0 else "-x"
    return {"both_directions": "both", NO_DIRECTION: "none"}.get(absorbs, "")


def _out_of_line(reader: AttributeReader, bearing: Component, turn: NDArray) -> tuple[float | None, ...]:
    """How far the place of its outer ring is off the shaft's line, in the shaft's axes."""
    both: list[float | None] = []
    for names in (
        [f"misalignment_in_{axis}_direction" for axis in "vw"],
        [f"angular_misalignment_around_{axis}_axis" for axis in "vw"],
    ):
        given = [reader.number(bearing, name) for name in names]
        own = turn[3:, 3:].T @ np.array([each or 0.0 for each in given])
        both += [float(each) or None for each in own] if any(given) else [None, None]
    return tuple(both)


def elements_of(reader: AttributeReader, part: Component | None) -> list[Component]:
    """The rolling elements of a row, in order."""
    return [] if part is None else reader.model.parts(part.number, "rolling_element")


def azimuths(reader: AttributeReader, elements: list[Component], turn: NDArray) -> NDArray | None:
    """Of rolling elements, in the axes of the scene [rad]; None unless each states its position."""
    angles = [reader.number(each, "angular_position_around_u") for each in elements]
    if not angles or None in angles:
        return None
    own = np.asarray(angles, float)
    y, z = turn[3:, 3:].T @ np.stack([np.cos(own), np.sin(own)])
    return np.asarray(np.round(np.arctan2(z, y), 12) % (2.0 * pi))  # a multiple of 22.5 degrees stays one


def _bearing(reader: AttributeReader, bearing: Component, part: Component | None) -> NotedTable:
    table = NotedTable(kind=str(KINDS[reader.word(bearing, "bearing_type")]))
    if part is not None:
        elements = elements_of(reader, part)
        count = reader.whole(part, "number_of_rolling_elements") or len(elements)
        if count:
            table.set("ball_count", count)
        diameters = {reader.positive(each, "diameter_of_rolling_element") for each in elements} - {None}
        if len(diameters) == 1:
            table.put(_KEYS["ball_diameter_mm"], diameters.pop())
        elif diameters:
            said = "balls differ: give their mean, and ball_diameter_deviations_um in [effects]"
            table.note("ball_diameter_mm", f"ball_diameter_mm: {said}")
        for name, attribute in _OF_ROW.items():
            table.put(_KEYS[name], reader.positive(part, attribute))
    for name, attribute in _OF_BEARING.items():
        table.put(_KEYS[name], reader.positive(bearing, attribute))
    angle = reader.positive(part, "pressure_angle") if part is not None else None
    clearance = reader.number(bearing, "radial_bearing_clearance")
    if table["kind"] == BearingKind.DEEP_GROOVE and clearance is not None:
        said = "the radial clearance, read as the whole play across the bearing before it is mounted"
        table.put(_KEYS["diametral_clearance_mm"], clearance, said)
    elif angle is not None:
        said = "assumed: the pressure angle is the free one, before it is mounted; programs differ"
        table.put(_KEYS["free_contact_angle_deg"], angle, said)
    elif word := reader.word(bearing, "radial_clearance_class"):
        table.note("", f"clearance class {word}: its clearance is not in the model")
    return table


def _materials(
    reader: AttributeReader, bearing: Component, part: Component | None, table: NotedTable, needs_expansion: bool
) -> None:
    rings = reader.model.parts(bearing.number, "bearing_ring")
    owners = {"ball_material": elements_of(reader, part), "ring_material": [bearing, *rings]}
    for name, components in owners.items():
        materials = [reader.model.referenced(each.number, "material") for each in components]
        known = {each.number: each for each in materials if each is not None}
        if len(known) > 1:
            table.note(name, "the parts have different materials: that of the first is taken")
        table.set(name, *material(reader, next(iter(known.values()), None), needs_expansion))


def material(reader: AttributeReader, of: Component | None, needs_expansion: bool) -> tuple[Any, str]:
    """A material as a file has it, and what is assumed of it."""
    if of is None:
        return "steel", ASSUMED
    numbers = {name: (_KEYS[name], reader.positive(of, attribute)) for name, attribute in _OF_MATERIAL.items()}
    given = {name: key.in_file(value) for name, (key, value) in numbers.items() if value is not None}
    notes = []
    if not needs_expansion:
        given.pop("thermal_expansion_per_K", None)
    for name in ("density_kg_m3", *(("thermal_expansion_per_K",) if needs_expansion else ())):
        if name not in given:
            given[name] = _KEYS[name].in_file(float(np.asarray(getattr(STEEL, _KEYS[name].field))))
            notes.append(f"{name} of steel {ASSUMED}")
    return given, "; ".join([f"{of.name or of.kind} [{of.number}]", *notes])


def _name(reader: AttributeReader, bearing: Component, table: NotedTable) -> None:
    """Look the bearing up by its designation, where its own numbers are not enough."""
    errors: Errors = []
    bearing_of({"bearing": dict(table)}, "", errors, may_infer=True)
    word = reader.word(bearing, "catalogue_designation")
    if not errors or not word:
        return
    told = read(word)
    if catalogue.named(word) is not None or (told is not None and not told.is_refused and told.kind == table["kind"]):
        table.set("name", word, "what the model lacks is looked up by this designation")
        for name in MATERIALS:
            if table.notes[name] == ASSUMED:  # the designation may tell ceramic balls
                del table[name], table.notes[name]
    else:
        table.note("", f"designation {word}: not in the catalogue of this program")


def _first_azimuth(reader: AttributeReader, part: Component | None, turn: NDArray, table: NotedTable) -> float | None:
    elements = elements_of(reader, part)
    angles = azimuths(reader, elements, turn)
    if angles is None or len(angles) != table.get("ball_count"):
        return None
    steps = np.diff(np.sort(angles), append=angles.min() + 2.0 * pi)
    if np.ptp(steps) > 1e-3 * float(steps.mean()):
        table.note("ball_count", "assumed: evenly spaced from the first; the model has them unevenly")
    return float(angles[0])


def _expansion(reader: AttributeReader, bearing: Component, part: Component | None, of: NotedTable) -> NotedTable:
    """The tables ring_expansion and ball_expansion within [effects]; none where the model tells of neither."""
    effects, rings = NotedTable(), NotedTable()
    for seat, ring, sign, bodies, word, key, wall in _SEATS:
        limits = [reader.positive(bearing, f"{end}_{body}_diameter") for body in bodies for end in _ENDS]
        known, fit = [each for each in limits if each is not None], reader.word(bearing, word)
        if len(known) == len(limits):
            interference = sign * 0.5 * (sum(known[:2]) - sum(known[2:]))
            rings.put(_KEYS[f"{seat}_interference_um"], interference, "the mean of the limits in the model")
        elif fit in fit_names(seat) and f"{ring}_diameter_mm" in of:
            rings.set(f"{seat}_fit", fit, "the mean of its limits is used")
            rings.set("tolerance_class", reader.word(bearing, "bearing_tolerance_class") or "P0")
        else:
            if fit:
                effects.note("", f"{word} {fit}: not known here, the seat is left out")
            continue
        rings.put(_KEYS[key], reader.positive(bearing, wall))
    for side in ("inner", "outer"):
        rings.put(
            _KEYS[f"{side}_ring_temperature_C"], reader.number(bearing, f"mean_operating_temperature_{side}_ring")
        )
    if not rings:
        return effects
    rings.put(_KEYS["reference_temperature_C"], *_reference_temperature(reader))
    effects["ring_expansion"] = rings
    balls = {reader.number(each, "mean_operating_temperature") for each in elements_of(reader, part)} - {None}
    if balls:
        table = effects["ball_expansion"] = NotedTable()
        table.put(_KEYS["ball_temperature_C"], sum(each for each in balls if each is not None) / len(balls))
        table.put(_KEYS["reference_temperature_C"], *_reference_temperature(reader))
    return effects


def _reference_temperature(reader: AttributeReader) -> tuple[float, str]:
    units = (each for each in reader.model.components.values() if each.kind == "gear_unit")
    temperatures = [value for each in units if (value := reader.number(each, "reference_temperature")) is not None]
    return (temperatures[0], "") if temperatures else (REFERENCE_TEMPERATURE, ASSUMED)


def readings(reader: AttributeReader, bearing: Component, casing: Component | None) -> NotedTable:
    """[readings]: life, and the oil where the model tells it whole."""
    tables = NotedTable(life=NotedTable())
    oil = reader.model.referenced(bearing.number, "lubricant") or (
        reader.model.referenced(casing.number, "lubricant") if casing is not None else None
    )
    temperature = next(
        (value for each in (bearing, casing) if each and (value := reader.number(each, "temperature_lubricant"))), None
    )
    if oil is None or temperature is None:
        return tables
    viscosities = {at: reader.positive(oil, f"viscosity_at_{at}_degree_celsius") for at in (40, 100)}
    if None in viscosities.values():
        return tables
    from qsbearing.readings.lubricant import TABLE

    keys: dict[str, Key] = {key.field: key for key in map(key_of, TABLE.inputs)}
    table = tables["lubricant"] = NotedTable()
    for at, value in viscosities.items():
        table.put(keys[f"viscosity_at_{at}"], value)
    table.put(keys["oil_temperature"], temperature)
    table.put(keys["oil_density"], reader.positive(oil, "density_at_15_degree_celsius"))
    contamination = reader.positive(bearing, "contamination_factor_iso_281_2007")
    if contamination is not None:
        tables["life"].set("contamination_factor", contamination)
    return tables
