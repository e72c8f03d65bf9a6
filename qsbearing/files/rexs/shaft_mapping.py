"""A shaft of a REXS model: its sections and loads as tables of a set, and what carries or loads it that is not ours."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.rexs.bearing_mapping import ASSUMED, is_ours, material
from qsbearing.files.rexs.model import Component
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.scene_text import NotedTable
from qsbearing.files.rexs.shaft_parts import GAUSS, GEARS, gear_forces, gears, has_forces, put_weight
from qsbearing.files.set_keys import SET_NUMBERS
from qsbearing.model.units import mm
from qsbearing.systems.sets.shaft import LOADS

SECTION = {key.name: key for key in SET_NUMBERS["sections"]}
_SHAFT, _LOADS = ({key.field: key for key in SET_NUMBERS[name]} for name in ("shaft", "loads"))
SAME = 1e-6
"""Metres within which one section ends where the next begins (chosen: files round to a micrometre)."""
HARMLESS = {
    *(
        "shaft_section",
        "external_load",
        "additional_mass",
        "shaft_shoulder",
        "shaft_shoulder_with_undercut",
        "round_groove",
    ),
    *("rectangular_groove", "v_notch", "transverse_bore", "notch_effect_shaft_hub_connection", "notch_effect_generic"),
}
"""Parts of a shaft that neither load nor carry it, and those that are read."""
_QUIET = ("assembly", "ordered_assembly", "reference", "flank", "stage_gear_data", "manufacturing_step")
"""Kinds of relations by which nothing holds or drives a shaft."""
_FORCES = ("force_u_direction", "force_v_direction", "force_w_direction")
_TORQUES = ("torque_around_v_axis", "torque_around_w_axis")
_LOAD = {own: _LOADS[name] for own, (name, _) in zip((*_FORCES, *_TORQUES), LOADS, strict=True)}


class Load(NamedTuple):
    """A load on a shaft."""

    component: Component
    position: float | None
    """[m]"""
    values: NDArray
    """Forces x, y, z and moments about y, z; SI."""
    said: str = ""
    """What there is to say of it."""


def shafts(reader: AttributeReader) -> list[Component]:
    """All shafts of the model."""
    return [each for each in reader.model.components.values() if each.kind == "shaft"]


def sides(reader: AttributeReader, bearing: Component) -> dict[str, Component]:
    """What a bearing's `inner_part` and `outer_part` sit on and in."""
    by_role: dict[str, Component] = {}
    for each in reader.model.related("side", "assembly", bearing.number):
        by_role |= {role: reader.model.components[number] for role, number in each.parts if role != "assembly"}
    return by_role


def bearings_on(reader: AttributeReader, shaft: Component) -> list[Component]:
    """The bearings that are solved here and whose inner ring sits on the shaft, along it."""
    bearings = [reader.model.components[each.of("assembly") or -1]
             for each in reader.model.related("side", "inner_part", shaft.number) if each.of("assembly")]  # fmt: skip
    ours = [each for each in bearings if is_ours(reader, each)]
    return sorted(ours, key=lambda each: reader.number(each, "u_coordinate_on_shaft_inner_side") or 0.0)


def lacking(reader: AttributeReader, shaft: Component) -> list[str]:
    """What carries or loads a shaft and is not solved here, one sentence each."""
    model, sentences = reader.model, []
    for number in {each.of("part"): each for each in model.related("assembly", "assembly", shaft.number)}:
        part = model.components[number] if number is not None else None
        if part is not None and part.kind in GEARS and has_forces(reader, part):
            continue
        if part is not None and part.kind not in HARMLESS:
            sentences.append(f"the forces of {part}: write them as [[shaft.loads]]")
    for each in model.relations_of(shaft.number):
        if each.kind in _QUIET:
            continue
        other = model.components[next((n for role, n in each.parts if n != shaft.number), shaft.number)]
        holder = model.components.get(each.of("assembly") or -1, other)
        if not is_ours(reader, holder):
            sentences.append(
                f"the stiffness of {holder}: write it as [[shaft.supports]], or its forces as [[shaft.loads]]"
            )
        elif each.of("inner_part") != shaft.number:
            sentences.append(
                f"{holder} has its inner ring on {other}: as [[shaft.supports]], if the other part stands still"
            )
        elif (part := sides(reader, holder).get("outer_part")) is not None and part.kind != "gear_casing":
            sentences.append(f"{holder} stands in {part}, which may move: a rigid housing is written")
    return sentences


def loads(reader: AttributeReader, shaft: Component) -> list[Load]:
    """The external loads on a shaft, one over a width as its halves; and the forces of gears that the model holds in
    some load case."""
    acting = []
    for each in reader.model.parts(shaft.number, "external_load"):
        values = np.array([reader.number(each, name) or 0.0 for name in _LOAD])
        position, width = reader.number(each, "u_coordinate_on_shaft"), reader.positive(each, "width_of_external_load")
        if width is None or position is None:
            acting.append(Load(each, position, values))
            continue
        said = f"half of a load over {width / mm:.6g} mm, {ASSUMED}, evenly and about its position"
        acting += [Load(each, position + way * GAUSS * width, 0.5 * values, said) for way in (-1.0, 1.0)]
    for each in gears(reader, shaft):
        cases = [AttributeReader(reader.model, case, []) for case in reader.model.load_cases]
        if any(has_forces(one, each) for one in (reader, *cases)):
            forces, said = gear_forces(reader, each, shaft)
            acting.append(Load(each, reader.number(each, "u_coordinate_on_shaft"), forces, said))
    return acting


def _ever(reader: AttributeReader, shaft: Component) -> NDArray:
    """Which components of each external load there are in any load case; (load, component)."""
    cases = [AttributeReader(reader.model, case, []) for case in reader.model.load_cases] or [reader]
    return np.any([[load.values != 0.0 for load in loads(each, shaft)] for each in (reader, *cases)], axis=0)


def shaft_table(
    reader: AttributeReader, shaft: Component, given: list[Load], is_warm: bool
) -> tuple[NotedTable, list[str]]:
    """[shaft] with its sections, loads and weight; without sections it is rigid. And what is missing of them.

    Args:
        is_warm: whether rings on it have temperatures, so that its material needs an expansion.
    """
    table = NotedTable()
    sections, start = _sections(reader, shaft, table, is_warm)
    if sections:
        table.put(_SHAFT["start"], start)
        table["sections"] = sections
    else:
        table.note("", "without sections: rigid")
    listed = []
    for load, ever in zip(given, _ever(reader, shaft), strict=True):
        one = NotedTable()
        one.put(_LOADS["position"], load.position)
        for key, value, acts in zip(_LOAD.values(), load.values, ever, strict=True):
            one.put(key, value if acts else None)
        if reader.number(load.component, "torque_around_u_axis"):
            one.note("", "its torque about the axis is no part of the model")
        one.note("", "; ".join(filter(None, (str(load.component), load.said))))
        listed += [one] if ever.any() else []
    if listed:
        table["loads"] = listed
    return table, put_weight(reader, shaft, table)


def _sections(
    reader: AttributeReader, shaft: Component, table: NotedTable, is_warm: bool
) -> tuple[list[NotedTable], float]:
    """The sections along the shaft, and where the first begins [m]; what is between them is noted."""
    parts = reader.model.parts(shaft.number, "shaft_section")
    placed = [(reader.number(each, "u_coordinate_on_shaft"), each) for each in parts]
    if any(at is None for at, _ in placed):
        table.note("", f"sections without u_coordinate_on_shaft: {ASSUMED}, they follow one another as in the file")
        placed = [(None, each) for each in parts]
    placed.sort(key=lambda each: each[0] or 0.0)
    of, note = material(reader, reader.model.referenced(shaft.number, "material"), needs_expansion=is_warm)
    sections: list[NotedTable] = []
    start = end = placed[0][0] or 0.0 if placed else 0.0
    for at, part in placed:
        if at is not None and abs(at - end) > SAME:
            kind = "a gap" if at > end else "an overlap"
            table.note("sections", f"{kind} of {abs(at - end) / mm:.6g} mm before {part}")
        one = NotedTable()
        one.note("", str(part))
        length = reader.positive(part, "length")
        one.put(SECTION["length_mm"], length)
        for side in ("outer", "inner"):
            first, last = (reader.number(part, f"{side}_diameter_{place}") for place in ("begin", "end"))
            one.put(SECTION[f"{side}_diameter_mm"], (last if first is None else first) or None)
            if first is not None and last is not None and first != last:
                one.put(SECTION[f"end_{side}_diameter_mm"], last)
        one.set("material", of, note)
        sections.append(one)
        end = (end if at is None else at) + (length or 0.0)
    return sections, start
