"""The keys of a scene file: for each its Python name, its unit, and that unit's size in SI."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from qsbearing.units import GPa, MPa, N, Nm, deg, kg_m3, mm, mrad, rpm, um, zero_celsius
from qsbearing.validation import ANGLE, DENSITY, FORCE, LENGTH, MODULUS, MOMENT, PRESSURE, SPEED, TEMPERATURE, Quantity


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
    """What other units it is given in; None where there are none."""
    zero: float = 0.0
    """The file's zero in SI."""

    def si(self, value: Any) -> Any:
        """A value of the file in SI."""
        return value * self.size + self.zero

    def in_file(self, value: float) -> float:
        """An SI value in the file's unit, without the rounding of its way there and back."""
        return float(f"{(value - self.zero) / self.size:.12g}")


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
    Key("speed_rpm", "speed", "rpm", rpm, SPEED),
    Key("outer_speed_rpm", "outer_speed", "rpm", rpm, SPEED),
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

SPECTRUM = (Key("share", "share"), *OPERATION)
"""Of an operating point of a load spectrum: its share of the time, and how it is operated."""

PRELOAD = (
    Key("spring_N", "spring", "N", N, FORCE),
    Key("rigid_N", "rigid", "N", N, FORCE),
    Key("mounted_N", "mounted", "N", N, FORCE),
    Key("axial_displacement_um", "axial_displacement", "um", um, LENGTH),
)


def _celsius(field: str) -> Key:
    return Key(f"{field}_C", field, "C", 1.0, TEMPERATURE, zero_celsius)


RING_EXPANSION = (
    Key("bore_diameter_mm", "bore_diameter", "mm", mm, LENGTH),
    Key("outside_diameter_mm", "outside_diameter", "mm", mm, LENGTH),
    Key("shaft_interference_um", "shaft_interference", "um", um, LENGTH),
    Key("shaft_bore_diameter_mm", "shaft_bore_diameter", "mm", mm, LENGTH),
    Key("housing_interference_um", "housing_interference", "um", um, LENGTH),
    Key("housing_outside_diameter_mm", "housing_outside_diameter", "mm", mm, LENGTH),
    *map(_celsius, ("shaft_temperature", "inner_ring_temperature", "outer_ring_temperature", "housing_temperature")),
    _celsius("reference_temperature"),
    Key("yield_strength_MPa", "yield_strength", "MPa", MPa, PRESSURE),
)
ELASTIC_RINGS = (
    Key("outer.outside_diameter_mm", "outside_diameter", "mm", mm, LENGTH),
    Key("outer.width_mm", "outer_width", "mm", mm, LENGTH),
    Key("outer.housing.outside_diameter_mm", "housing_outside_diameter", "mm", mm, LENGTH),
    Key("outer.housing.elastic_modulus_GPa", "housing_elastic_modulus", "GPa", GPa, MODULUS),
    Key("outer.housing.poisson_ratio", "housing_poisson_ratio"),
    Key("inner.bore_diameter_mm", "bore_diameter", "mm", mm, LENGTH),
    Key("inner.width_mm", "inner_width", "mm", mm, LENGTH),
    Key("inner.shaft.bore_diameter_mm", "shaft_bore_diameter", "mm", mm, LENGTH),
    Key("inner.shaft.elastic_modulus_GPa", "shaft_elastic_modulus", "GPa", GPa, MODULUS),
    Key("inner.shaft.poisson_ratio", "shaft_poisson_ratio"),
)
"""In tables within the effect's own, which the points say."""
SEATS = {"outer.housing": "housing", "inner.shaft": "shaft"}
"""What holds a ring, as a word."""
RING_COMPLIANCES = (
    Key("outer.housing.compliance_um_per_N", "outer_compliance", "um/N", um, None),
    Key("inner.shaft.compliance_um_per_N", "inner_compliance", "um/N", um, None),
)
"""Lists by harmonic, in place of all else about a ring."""
BALL_EXPANSION = (_celsius("ball_temperature"), _celsius("reference_temperature"))

_SHOULDERS = ("inner_shoulder_diameter", "outer_shoulder_diameter", "inner_open_diameter", "outer_open_diameter")
READING_TABLES: dict[str, tuple[Key, ...]] = {
    "life": (
        Key("dynamic_load_rating_N", "dynamic_load_rating", "N", N, FORCE),
        Key("rating_factor", "rating_factor"),
        Key("reliability", "reliability"),
        Key("viscosity_ratio", "viscosity_ratio"),
        Key("contamination_factor", "contamination_factor"),
        Key("fatigue_load_limit_N", "fatigue_load_limit", "N", N, FORCE),
    ),
    "static_safety": (Key("static_load_rating_N", "static_load_rating", "N", N, FORCE),),
    "kinematics": (),
    "frequencies": (),
    "lubricant": (
        Key("iso_viscosity_grade", "iso_viscosity_grade"),
        Key("viscosity_index", "viscosity_index"),
        Key("viscosity_at_40C_mm2_s", "viscosity_at_40", "mm2/s", mm**2),
        Key("viscosity_at_100C_mm2_s", "viscosity_at_100", "mm2/s", mm**2),
        _celsius("oil_temperature"),
        Key("oil_density_kg_m3", "oil_density", "kg/m3", kg_m3, DENSITY),
        Key("pressure_viscosity_per_GPa", "pressure_viscosity", "1/GPa", 1.0 / GPa),
    ),
    "film": (
        Key("ball_roughness_um", "ball_roughness", "um", um, LENGTH),
        Key("raceway_roughness_um", "raceway_roughness", "um", um, LENGTH),
    ),
    "friction": (
        Key("friction_coefficient", "friction_coefficient"),
        Key("hysteresis_loss", "hysteresis_loss"),
        Key("drag_coefficient", "drag_coefficient"),
        Key("fluid_density_kg_m3", "fluid_density", "kg/m3", kg_m3, DENSITY),
    ),
    "pivot_points": (),
    "friction_estimate": (
        Key("bore_diameter_mm", "bore_diameter", "mm", mm, LENGTH),
        Key("outside_diameter_mm", "outside_diameter", "mm", mm, LENGTH),
        Key("static_load_rating_N", "static_load_rating", "N", N, FORCE),
        Key("lubrication_factor", "lubrication_factor"),
        Key("speed_rating_rpm", "speed_rating", "rpm", rpm, SPEED),
    ),
    "overrun": tuple(Key(f"{field}_mm", field, "mm", mm, LENGTH) for field in _SHOULDERS),
    "stress": (),
}
"""Tables within [readings]: each asks for its reading and holds its numbers; the lubricant is what others need."""
READING_CHOICES = {
    "life": ("rating", "capacity", "cleanliness", "fatigue_limit_by"),
    "friction_estimate": ("series",),
}
EFFECTS = (Key("friction_coefficient", "friction_coefficient"),)
BALL_DEVIATIONS = Key("ball_diameter_deviations_um", "deviations", "um", um, LENGTH)
"""A list, of as many numbers as there are balls, which names its effect."""

ROW = (Key("position_mm", "position", "mm", mm, LENGTH), Key("offset_um", "offset", "um", um, LENGTH))
SHAFT = (Key("reference_position_mm", "reference_position", "mm", mm, LENGTH),)
SET_NUMBERS = {"rows": ROW, "shaft": SHAFT}
"""The keys that hold numbers in what a file of a set has beside the tables of a scene."""

MATERIALS = ("ball_material", "ring_material")
SEAT_MATERIALS = ("shaft_material", "housing_material")
EFFECT_TABLES = {
    "ring_expansion": RING_EXPANSION,
    "ball_expansion": BALL_EXPANSION,
    "elastic_rings": ELASTIC_RINGS,
}
"""Effects that have a table of their own within [effects], which names them and holds their numbers."""
NUMBERS = {
    "bearing": BEARING,
    "operation": OPERATION,
    "preload": PRELOAD,
    "effects": EFFECTS,
    "unequal_balls": (BALL_DEVIATIONS,),
    "material": MATERIAL,
    **EFFECT_TABLES,
    **READING_TABLES,
}
"""The keys that hold numbers, by their table; a material is a table within others."""

SECTIONS: dict[str, tuple[str, ...]] = {
    "bearing": ("name", "kind", *(key.name for key in BEARING), *MATERIALS),
    "operation": tuple(key.name for key in OPERATION),
    "preload": tuple(key.name for key in PRELOAD),
    "effects": (
        "ball",
        "raceway_control",
        "moment_shares",
        *(key.name for key in EFFECTS),
        "orbit_radius",
        "hertz_angle",
        "hertz_form",
        "tilt_lever",
        BALL_DEVIATIONS.name,
        *EFFECT_TABLES,
    ),
    "readings": tuple(READING_TABLES),
}
"""Every key a file may hold, by its table."""

SET_SECTIONS: dict[str, tuple[str, ...]] = {
    "rows": (*(key.name for key in ROW), "carries", "sprung", "bearing", *EFFECT_TABLES, "readings"),
    "shaft": tuple(key.name for key in SHAFT),
}
"""Likewise, of the tables that only a set has."""

EFFECT_SECTIONS = {
    name: (*(key.name for key in keys), *(SEAT_MATERIALS if name == "ring_expansion" else ()))
    for name, keys in EFFECT_TABLES.items()
}
EFFECT_SECTIONS["elastic_rings"] += (*SEATS, *(key.name for key in RING_COMPLIANCES))
"""Likewise, by the tables within [effects]."""

READING_SECTIONS = {
    name: (*(key.name for key in keys), *READING_CHOICES.get(name, ())) for name, keys in READING_TABLES.items()
}
"""Likewise, by the tables within [readings]."""

SPECTRUM_POINT = "spectrum point"
"""What a point of a spectrum is called in errors, its number following."""

MATERIAL_KEYS = tuple(key.name for key in MATERIAL)

_KEY_OF_FIELD = {key.field: key.name for keys in NUMBERS.values() for key in keys} | {"ball_effects": "ball"}
_FIELD = re.compile(r"(?<!\")\b(" + "|".join(sorted(_KEY_OF_FIELD, key=len, reverse=True)) + r")\b(?!\")")


def find(path: str) -> Key | None:
    """The key of a path such as `bearing.ball_diameter_mm`, or `bearing.ball_material.density` as Python has it."""
    before, _, within = path.partition("elastic_rings.")
    section, _, name = path.rpartition(".")
    if within and before in ("", "effects."):
        section, name = f"{before}elastic_rings", within
    table = "material" if section.endswith("_material") else section.rpartition(".")[2]
    if table.startswith("row "):
        table = "rows"
    keys = SPECTRUM if table.startswith(SPECTRUM_POINT) else SET_NUMBERS.get(table) or NUMBERS.get(table, ())
    return next((key for key in keys if name in (key.field, key.name)), None)


def path_in_file(path: str) -> str:
    """A Python path as the file spells it: `bearing.ball_diameter` is `bearing.ball_diameter_mm`."""
    if path in ("ball_effects", "raceway_control", "orbit_radius", "friction_coefficient"):
        return f"effects.{_KEY_OF_FIELD.get(path, path)}"
    key = find(path)
    if key is BALL_DEVIATIONS:
        return f"effects.{key.name}"
    if path.startswith("elastic_rings."):
        other = {field: name for name, field in SEATS.items()} | {key.field: key.name for key in RING_COMPLIANCES}
        field = path.removeprefix("elastic_rings.")
        return f"effects.elastic_rings.{key.name if key else other.get(field, field)}"
    path = f"{path.rpartition('.')[0]}.{key.name}" if key else path
    return f"effects.{path}" if path.partition(".")[0] in (*EFFECT_TABLES, "ring_effects") else path


def with_file_keys(sentence: str) -> str:
    """A sentence with every Python name replaced by the file's key, but for words in quotation marks."""
    return _FIELD.sub(lambda match: _KEY_OF_FIELD[match.group()], sentence)
