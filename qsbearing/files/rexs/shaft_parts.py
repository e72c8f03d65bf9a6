"""What stands on a shaft of a REXS model and loads it by results of the other program, or by its weight: gears whose
forces are known, masses, and gravity."""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.rexs.axes import turned, unit_vectors
from qsbearing.files.rexs.bearing_mapping import ASSUMED
from qsbearing.files.rexs.model import Component
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.scene_text import NotedTable
from qsbearing.files.set_keys import GRAVITY, SET_NUMBERS

GEARS = ("cylindrical_gear", "bevel_gear", "ring_gear", "worm_gear", "worm_wheel", "general_gear")
MASS = "additional_mass"
_FORCES = tuple(f"force_acting_on_shaft_{axis}" for axis in "uvw")
_TORQUES = tuple(f"torque_acting_on_shaft_{axis}" for axis in "vw")
_INERTIA = {"polar_inertia": ("u",), "diametral_inertia": ("v", "w")}
_MASSES = {key.field: key for key in SET_NUMBERS["masses"]}
STANDARD_GRAVITY = 9.80665
GAUSS = 0.5 / sqrt(3.0)
"""Of the width of a load: two halves at this distance to either side of its middle bend a shaft as it does, wherever
it is seen from outside (Gauss's rule of two points)."""


def gears(reader: AttributeReader, shaft: Component) -> list[Component]:
    """The gears on a shaft."""
    return [each for kind in GEARS for each in reader.model.parts(shaft.number, kind)]


def has_forces(reader: AttributeReader, gear: Component) -> bool:
    """Whether the model holds the forces of its teeth, as results of the program that wrote it."""
    return all(reader.number(gear, name) is not None for name in _FORCES)


def gear_forces(reader: AttributeReader, gear: Component, shaft: Component) -> tuple[NDArray, str]:
    """Forces and moments on the shaft in its axes, in the order of the channels; and what there is to say of them."""
    values = [reader.number(gear, name) for name in (*_FORCES, *_TORQUES)]
    turn = np.eye(5) if reader.array(gear, "u_axis_vector") is None else turned(reader, gear, shaft)
    said = "the forces of a solved model"
    if None in values[3:]:
        said += f"; {ASSUMED}, they have no moment about v and w (an axial force at the teeth has one)"
    return turn.T @ np.array([each or 0.0 for each in values]), said


def gravity_of(reader: AttributeReader, shaft: Component) -> tuple[list[float] | None, str, str]:
    """Acceleration in the shaft's axes [m/s^2], None where nothing has weight; what is assumed; what is missing."""
    units = [each for each in reader.model.components.values() if each.kind == "gear_unit"]
    for unit in units:
        counts, size = reader.flag(unit, "account_for_gravity"), reader.number(unit, "gravitational_acceleration")
        way = np.array([reader.number(unit, f"direction_vector_gravity_{axis}") or 0.0 for axis in "uvw"])
        if counts is False or (counts is None and not size):
            continue
        if not way.any():
            return None, "", f"the direction of gravity, with which {unit} counts: write gravity_m_s2 under [shaft]"
        notes = [] if size else [f"{STANDARD_GRAVITY} m/s2 {ASSUMED}"]
        notes += [] if counts else ["assumed: the model gives it, and does not say whether it counts"]
        along = unit_vectors(reader, shaft) @ (way / np.linalg.norm(way)) * (size or STANDARD_GRAVITY)
        return [float(each) + 0.0 for each in np.round(along, 9)], "; ".join(notes), ""
    return None, "", ""


def masses(
    reader: AttributeReader, shaft: Component, has_weight: bool
) -> tuple[list[NotedTable], list[str], list[str]]:
    """[[shaft.masses]] of additional masses and gears; what is left out, and what is missing."""
    tables, left_out, lacks = [], [], []
    for part in [*reader.model.parts(shaft.number, MASS), *gears(reader, shaft)]:
        mass = reader.positive(part, "mass_of_component")
        inertia = {name: [reader.number(part, f"moment_of_inertia_{axis}_axis") or 0.0 for axis in axes]
                   for name, axes in _INERTIA.items()}  # fmt: skip
        if mass is None:
            continue
        position = reader.number(part, "u_coordinate_on_shaft")
        if position is None:
            if has_weight:
                lacks.append(f"the position of {part}, whose weight loads the shaft: write it as [[shaft.masses]]")
            else:
                left_out.append(f"the mass of {part} ({mass:g} kg) has no position and, without gravity, no weight")
            continue
        one = NotedTable()
        one.note("", str(part))
        one.put(_MASSES["position"], position)
        one.put(_MASSES["mass"], mass)
        for name, values in inertia.items():
            if any(values):
                one.put(_MASSES[name], sum(values) / len(values))
        tables.append(one)
    return tables, left_out, lacks


def put_weight(reader: AttributeReader, shaft: Component, table: NotedTable) -> list[str]:
    """Put masses and gravity into [shaft]; what is missing."""
    gravity, note, lacking = gravity_of(reader, shaft)
    listed, left_out, lacks = masses(reader, shaft, gravity is not None or bool(lacking))
    for each in left_out:
        table.note("", each)
    if listed:
        table["masses"] = listed
    if gravity is not None and ("sections" in table or listed):
        table.set(GRAVITY.name, gravity, note)
    return [*([lacking] if lacking else []), *lacks]
