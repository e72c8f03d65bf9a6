"""The keys of a scene file: for each its Python name, its unit, and that unit's size in SI."""

from __future__ import annotations

import re
from dataclasses import dataclass

from qsbearing.faults import ANGLE, DENSITY, FORCE, LENGTH, MODULUS, MOMENT, Quantity
from qsbearing.units import GPa, N, Nm, deg, kg_m3, mm, mrad, rpm, um


@dataclass(frozen=True)
class Key:
    """A number of a scene file."""

    name: str
    """As the file spells it, unit included."""
    field: str
    """As Python spells it."""
    unit: str = ""
    size: float = 1.0
    """One of the file's unit in SI."""
    quantity: Quantity | None = None
    """What units it is given in by mistake; None where no mistake is likely."""


BEARING = (
    Key("ball_count", "ball_count", "balls"),
    Key("ball_diameter_mm", "ball_diameter", "mm", mm, LENGTH),
    Key("pitch_diameter_mm", "pitch_diameter", "mm", mm, LENGTH),
    Key("inner_groove_radius_mm", "inner_groove_radius", "mm", mm, LENGTH),
    Key("outer_groove_radius_mm", "outer_groove_radius", "mm", mm, LENGTH),
    Key("free_contact_angle_deg", "free_contact_angle", "deg", deg, ANGLE),
    Key("diametral_clearance_mm", "diametral_clearance", "mm", mm, LENGTH),
)

MATERIAL = (
    Key("elastic_modulus_GPa", "elastic_modulus", "GPa", GPa, MODULUS),
    Key("poisson_ratio", "poisson_ratio"),
    Key("density_kg_m3", "density", "kg/m3", kg_m3, DENSITY),
    Key("thermal_expansion_per_K", "thermal_expansion", "1/K"),
)

OPERATION = (
    Key("speed_rpm", "speed", "rpm", rpm),
    Key("outer_speed_rpm", "outer_speed", "rpm", rpm),
    Key("axial_load_N", "axial_load", "N", N, FORCE),
    Key("axial_displacement_um", "axial_displacement", "um", um, LENGTH),
    Key("radial_load_y_N", "radial_load_y", "N", N, FORCE),
    Key("radial_displacement_y_um", "radial_displacement_y", "um", um, LENGTH),
    Key("radial_load_z_N", "radial_load_z", "N", N, FORCE),
    Key("radial_displacement_z_um", "radial_displacement_z", "um", um, LENGTH),
    Key("moment_y_Nm", "moment_y", "N m", Nm, MOMENT),
    Key("tilt_y_mrad", "tilt_y", "mrad", mrad, ANGLE),
    Key("moment_z_Nm", "moment_z", "N m", Nm, MOMENT),
    Key("tilt_z_mrad", "tilt_z", "mrad", mrad, ANGLE),
    Key("first_ball_azimuth_deg", "first_ball_azimuth", "deg", deg, ANGLE),
)

EFFECTS = ("ball", "raceway_control", "moment_shares", "hertz_angle", "hertz_form", "tilt_lever")

SECTIONS: dict[str, tuple[str, ...]] = {
    "bearing": ("name", "kind", *(key.name for key in BEARING), "ball_material", "ring_material"),
    "operation": tuple(key.name for key in OPERATION),
    "effects": EFFECTS,
}
"""Every key a file may hold, by its table."""

MATERIAL_KEYS = tuple(key.name for key in MATERIAL)

_KEY_OF_FIELD = {key.field: key.name for key in (*BEARING, *OPERATION, *MATERIAL)} | {"ball_effects": "ball"}
_FIELD = re.compile(r"\b(" + "|".join(sorted(_KEY_OF_FIELD, key=len, reverse=True)) + r")\b")


def find(path: str) -> Key | None:
    """The key of a Python path such as `bearing.ball_diameter` or `bearing.ball_material.density`."""
    section, _, field = path.partition(".")
    if "." in field:
        field = field.partition(".")[2]
        keys: tuple[Key, ...] = MATERIAL
    else:
        keys = {"bearing": BEARING, "operation": OPERATION}.get(section, ())
    return next((key for key in keys if key.field == field), None)


def path_in_file(path: str) -> str:
    """A Python path as the file spells it: `bearing.ball_diameter` is `bearing.ball_diameter_mm`."""
    if path in ("ball_effects", "raceway_control"):
        return f"effects.{_KEY_OF_FIELD.get(path, path)}"
    key = find(path)
    return f"{path.rpartition('.')[0]}.{key.name}" if key else path


def in_file_words(sentence: str) -> str:
    """A sentence with every Python name replaced by the file's key."""
    return _FIELD.sub(lambda match: _KEY_OF_FIELD[match.group()], sentence)
