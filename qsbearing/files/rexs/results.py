"""Results of a scene or set as attributes of a REXS model, in SI, in the axes of each component."""

from __future__ import annotations

from math import isfinite, pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.rexs.axes import turned
from qsbearing.files.rexs.bearing_mapping import azimuths, elements_of
from qsbearing.files.rexs.model import Component
from qsbearing.files.rexs.reader import AttributeReader
from qsbearing.files.rexs.shaft_mapping import sides
from qsbearing.model.solution.solution import Solution
from qsbearing.systems.rotor_dynamics.springs import from_shaft
from qsbearing.systems.sets.system_life import system_life

Values = dict[str, float | list[float]]
_FORCES, _MOMENTS = ("f_u", "f_v", "f_w", "m_v", "m_w"), ("d_u", "d_v", "d_w", "rot_v", "rot_w")
_LOADS = (
    *(f"force_acting_on_inner_component_{axis}" for axis in "uvw"),
    *(f"torque_acting_on_inner_component_{axis}" for axis in "vw"),
)
_MOVES = (*(f"displacement_inner_side_{axis}" for axis in "uvw"), *(f"angular_deflection_in_{axis}" for axis in "vw"))
_CONTACT = {
    "rolling_element_force": "load", "operating_pressure_angle": "angle", "maximum_hertzian_pressure": "max_pressure",
    "half_length_of_contact_area": "semi_major_axis", "half_width_of_contact_area": "semi_minor_axis",
}  # fmt: skip


WRITTEN = (
    *(f"operating_point_stiffness_{force}_{move}" for force in _FORCES for move in _MOMENTS),
    *(*_LOADS, *_MOVES, *_CONTACT, "rolling_element_contact_type"),
    *("maximum_hertzian_pressure", "maximum_hertzian_pressure_inner_ring", "maximum_hertzian_pressure_outer_ring"),
    *("speed_rolling_element_set", "operating_radial_bearing_clearance", "static_safety_factor_iso_76_2006"),
    *(f"{kind}_reference_rating_life_time_iso_16281_2008" for kind in ("nominal", "modified")),
    *("u_coordinates_of_beam_nodes", *(f"displacement_{axis}_of_nodes" for axis in "uvw")),
)
"""Every attribute that results are put into."""


class RowResult(NamedTuple):
    """A solved row of a bearing."""

    solution: Solution
    readings: Any
    sign: float
    """1, or -1 where its x points along -u of the shaft."""
    arm: float
    """Of the balls' centres, from the middle of the bearing along the shaft [m]."""
    by_middle: bool = False
    """Whether those are in the plane of both grooves."""

    @property
    def lever(self) -> NDArray:
        """From the shaft's displacement in the middle of the bearing to the row's."""
        return from_shaft(self.solution, self.sign, self.arm, by_middle=self.by_middle)


def bearing_values(reader: AttributeReader, bearing: Component, rows: list[RowResult], moved: NDArray | None) -> Values:
    """What stands with the bearing.

    Loads, stiffness and displacements are meant in its middle.

    Args:
        moved: the shaft's displacement there, in its axes; None: that of the only row.
    """
    turn = turned(reader, bearing, sides(reader, bearing).get("inner_part"))
    stiffness, load = np.zeros((5, 5)), np.zeros(5)
    for row in rows:
        lever = row.lever
        stiffness += lever.T @ row.solution.stiffness @ lever
        load += lever.T @ row.solution.load
    if moved is None:
        only = rows[0]
        moved = np.linalg.solve(only.lever, only.solution.displacement)
    values: Values = {}
    matrix = turn @ stiffness @ turn.T
    for force, line in zip(_FORCES, matrix, strict=True):
        values |= {
            f"operating_point_stiffness_{force}_{move}": value for move, value in zip(_MOMENTS, line, strict=True)
        }
    values |= dict(zip(_LOADS, -(turn @ load), strict=True))
    values |= dict(zip(_MOVES, turn @ moved, strict=True))
    pressures = {side: max(float(np.nanmax(getattr(row.solution, side).max_pressure)) for row in rows)
                 for side in ("inner", "outer")}  # fmt: skip
    values |= {f"maximum_hertzian_pressure_{side}_ring": value for side, value in pressures.items()}
    values["maximum_hertzian_pressure"] = max(pressures.values())
    speeds = [float(np.nanmean(speed)) for row in rows if (speed := row.solution.orbital_speed) is not None]
    if speeds:
        values["speed_rolling_element_set"] = float(np.mean(speeds))
    values["operating_radial_bearing_clearance"] = min(
        float(row.solution.scene.operating_bearing.diametral_clearance) for row in rows
    )
    lives = [row.readings.get("life") for row in rows]
    if all(each is not None for each in lives):
        values["nominal_reference_rating_life_time_iso_16281_2008"] = float(
            system_life([each.basic_duration for each in lives])
        )
        if all(each.modified_reference_rating_life is not None for each in lives):
            values["modified_reference_rating_life_time_iso_16281_2008"] = float(
                system_life([each.duration for each in lives])
            )
    safeties = [row.readings.get("static_safety") for row in rows]
    if all(each is not None for each in safeties):
        values["static_safety_factor_iso_76_2006"] = min(float(each.static_safety) for each in safeties)
    return {name: float(value) + 0.0 for name, value in values.items() if isfinite(float(value))}  # type: ignore[arg-type]


def contact_values(
    reader: AttributeReader, part: Component, turn: NDArray, row: RowResult
) -> list[tuple[Component, dict[str, Values]]] | None:
    """What stands with the contacts of each rolling element, by raceway; None where the elements are not the balls."""
    elements = elements_of(reader, part)
    solution = row.solution
    count = len(solution.azimuth)
    balls = np.arange(count)
    angles = azimuths(reader, elements, turn)
    if len(elements) != count:
        return None
    if angles is not None:
        apart = np.abs((angles[:, None] - solution.azimuth + pi) % (2.0 * pi) - pi)
        balls = apart.argmin(axis=1)
        if len(set(balls.tolist())) < count or apart.min(axis=1).max() > 0.25 * 2.0 * pi / count:
            return None
    contacts = []
    for element, ball in zip(elements, balls, strict=True):
        values = {
            side: {name: float(getattr(getattr(solution, side), path)[ball]) + 0.0 for name, path in _CONTACT.items()}
            for side in ("inner", "outer")
        }
        contacts.append((element, {side: {name: each for name, each in one.items() if isfinite(each)}
                                for side, one in values.items()}))  # fmt: skip
    return contacts  # type: ignore[return-value]


def shaft_values(reader: AttributeReader, shaft: Component, solution: Any) -> Values:
    """The deflection of an elastic shaft at its nodes: those of the model, else where its sections begin and end."""
    nodes = reader.array(shaft, "u_coordinates_of_beam_nodes")
    if not nodes:
        of = solution.set.shaft
        nodes = [float(each) for each in np.cumsum([of.start, *(each.length for each in of.sections)])]
    moved = solution.deflection(nodes)
    values: Values = {"u_coordinates_of_beam_nodes": nodes}
    return values | {f"displacement_{axis}_of_nodes": [float(each) + 0.0 for each in moved[:, number]]
                    for number, axis in enumerate("uvw")}  # fmt: skip
