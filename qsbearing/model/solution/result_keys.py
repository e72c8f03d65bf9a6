"""The results of a solution: the key of each, unit included, where it is found, its plain name, symbol and source.

Columns, JSON, tables for people, xarray, studies and the guide's page of symbols show results by what stands here;
those of a reading stand with it.
"""

from __future__ import annotations

import re
from functools import reduce
from typing import Any, NamedTuple

import numpy as np

from qsbearing.model.units import MPa, Nmm, deg, mm, mrad, rpm, um

UNITS = {
    **{"N_per_um": "N/um", "Nm_per_mrad": "N m/mrad", "MPa_m_s": "MPa m/s", "m_s": "m/s", "mm_rpm": "mm rpm"},
    **{"Nmm": "N mm", "Nm": "N m"},
    **{unit: unit for unit in ("Mrev", "N", "h", "Hz", "W", "deg", "mrad", "rpm", "um", "mm", "MPa", "C")},
}
"""What keys end with, and the unit that it stands for."""


def split(key: str) -> tuple[str, str]:
    """A key without its unit, and the unit, "1" where it has none: `tilt_y_Nm_per_mrad` is tilt_y in N m/mrad."""
    for ending, unit in UNITS.items():
        if key.endswith(f"_{ending}"):
            return key.removesuffix(f"_{ending}"), unit
    return key, "1"


def printed_unit(unit: str) -> str:
    """A unit as people write it: µm, °C, m³; nothing for "1". In keys and attributes it is plain ASCII."""
    plain = unit.replace("um", "µm").replace("m2", "m²").replace("m3", "m³")
    return {"1": "", "C": "°C", "Mrev": "million rev"}.get(unit, plain)


class Shown(NamedTuple):
    """One number of a result."""

    key: str
    """Unit included."""
    path: str
    """Of the attribute; of one raceway's for contacts."""
    size: float = 1.0
    """One of the key's unit in SI."""
    words: str = ""
    """What it is, where the key's own words do not state it."""
    symbol: str = ""
    """In formulas, in LaTeX, without the index of a raceway."""
    source: str = ""
    """Of its equation; of a reading's result the reading states it."""
    is_signed: bool = False
    """Whether its sign is a direction, so that the largest of several is the one of the largest size."""

    def of(self, holder: Any) -> Any:
        """The number in the key's unit; None where the holder has none, or there is no holder."""
        parts = self.path.split(".")
        found = reduce(lambda part, name: None if part is None else getattr(part, name), parts, holder)
        return None if found is None else np.asarray(found, float) / self.size

    @property
    def plain_name(self) -> str:
        """For people."""
        return self.words or split(self.key)[0].replace("_", " ")

    @property
    def plain_symbol(self) -> str:
        """For tables of plain text: p0 for p_0, δ for \\delta."""
        plain = self.symbol.replace(r"\delta", "δ").replace(r"\mu", "µ")
        return re.sub(r"[\\\\{}_]", "", plain)


def attributes(unit: str, words: str, symbol: str, source: str) -> dict[str, str]:
    """What datasets say of a result; what it has not is left out."""
    found = {"units": unit, "long_name": words, "symbol": symbol, "source": source}
    return {name: value for name, value in found.items() if value}


_STRAIGHT, _TILTS = ("axial", "radial_y", "radial_z"), ("tilt_y", "tilt_z")
DISPLACEMENT = *((f"{name}_um", um) for name in _STRAIGHT), *((f"{name}_mrad", mrad) for name in _TILTS)
LOAD = *((f"{name}_N", 1.0) for name in _STRAIGHT), ("moment_y_Nm", 1.0), ("moment_z_Nm", 1.0)
STIFFNESS = (
    *((f"{name}_N_per_um", 1.0 / um) for name in _STRAIGHT),
    *((f"{name}_Nm_per_mrad", 1.0 / mrad) for name in _TILTS),
)
"""Keys of the five channels, and the size of each key's unit in SI."""

BALANCE, HERTZ, NO_SLIP = "Jones 1960; Harris & Kotzalas 2006", "Hertz 1881; Johnson 1985", "Jones 1960"
"""Sources."""

CONTACT = (
    Shown("load_N", "load", 1.0, "normal load of a contact", "Q", BALANCE),
    Shown("angle_deg", "angle", deg, "angle of the loaded contact", r"\alpha", BALANCE, True),
    Shown("approach_um", "approach", um, "negative: gap of an unloaded contact", r"\delta", HERTZ),
    Shown("semi_major_axis_mm", "semi_major_axis", mm, "semi-axis of the contact ellipse, across rolling", "a", HERTZ),
    Shown("semi_minor_axis_mm", "semi_minor_axis", mm, "semi-axis of the contact ellipse, along rolling", "b", HERTZ),
    Shown("max_pressure_MPa", "max_pressure", MPa, "pressure at the centre of the ellipse", "p_0", HERTZ),
    Shown("required_friction", "required_friction", 1.0, "coefficient that the moment Mg requires", r"\mu", BALANCE),
)
BALL = (
    Shown("centrifugal_force_N", "centrifugal_force", 1.0, "on the ball", "F_c", BALANCE),
    Shown("gyroscopic_moment_Nmm", "gyroscopic_moment", Nmm, "on the ball", "M_g", BALANCE, True),
    Shown("orbital_speed_rpm", "orbital_speed", rpm, "of the ball's centre round x", r"\omega_m", NO_SLIP, True),
    Shown("rotation_speed_rpm", "rotation_speed", rpm, "of the ball about its axis", r"\omega_R", NO_SLIP, True),
    Shown("ball_diameter_deviation_um", "ball_diameter_deviation", um, is_signed=True),
    Shown("groove_deflection_um", "groove_deflection", um, is_signed=True),
)
"""Arrays of a solution (*cases, ball), those of contacts for either raceway."""

GEOMETRY = (
    Shown("ball_diameter_mm", "ball_diameter", mm),
    Shown("pitch_diameter_mm", "pitch_diameter", mm),
    Shown("inner_groove_radius_mm", "inner_groove_radius", mm),
    Shown("outer_groove_radius_mm", "outer_groove_radius", mm),
    Shown("free_contact_angle_deg", "free_contact_angle", deg),
    Shown("diametral_clearance_um", "diametral_clearance", um),
)
"""Of the bearing that ring effects have changed."""
RING_STATE = (
    Shown("groove_growth_um", "groove_growth", um),
    Shown("seat_pressure_MPa", "seat_pressure", MPa),
    Shown("seat_gap_um", "seat_gap", um),
    Shown("bore_hoop_stress_MPa", "bore_hoop_stress", MPa),
    Shown("equivalent_stress_MPa", "equivalent_stress", MPa),
)
"""Of a `RingState`."""
RING_SHAPE = (
    Shown("growth_um", "growth", um),
    Shown("bending_um", "bending", um),
    Shown("seat_pressure_MPa", "seat_pressure", MPa),
    Shown("least_seat_pressure_MPa", "least_seat_pressure", MPa),
    Shown("largest_seat_pressure_MPa", "largest_seat_pressure", MPa),
)
"""Of a `RingShape`."""

OF_EACH_ROW = ("inner_ring", "balls", "outer_ring")
NODES = (*OF_EACH_ROW, "oil", "shaft", "housing", "ambient")
"""Of a heat balance; a set has the first three once for each row."""
