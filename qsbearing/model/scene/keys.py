"""The keys of a scene file: for each its Python name, its unit, and that unit's size in SI."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from qsbearing.model.bearing_errors import BALL_COUNT_RANGE, FREE_ANGLES, LENGTH_RANGES
from qsbearing.model.effects.ring_expansion_errors import RANGES as OF_RINGS
from qsbearing.model.material import RANGES
from qsbearing.model.operation import AZIMUTHS, DISPLACEMENTS, LOADS, SPEEDS, TILTS
from qsbearing.model.scene.preload import PRELOADS
from qsbearing.model.units import GPa, MPa, N, Nm, deg, kg_m3, mm, mrad, rpm, um, zero_celsius
from qsbearing.model.validation import (
    ANGLE,
    DENSITY,
    FORCE,
    LENGTH,
    MODULUS,
    MOMENT,
    PRESSURE,
    SPEED,
    TEMPERATURE,
    Quantity,
)


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
    range: tuple[float, float] | None = None
    """Which values its table accepts at all, in SI; None where that depends on others."""

    def si(self, value: Any) -> Any:
        """A value of the file in SI."""
        return value * self.size + self.zero

    def in_file(self, value: float) -> float:
        """An SI value in the file's unit, without the rounding of its way there and back."""
        return float(f"{(value - self.zero) / self.size:.12g}")


BEARING = (
    Key("ball_count", "ball_count", "balls", range=BALL_COUNT_RANGE),
    Key("ball_diameter_mm", "ball_diameter", "mm", mm, LENGTH, range=LENGTH_RANGES["ball_diameter"]),
    Key("pitch_diameter_mm", "pitch_diameter", "mm", mm, LENGTH, range=LENGTH_RANGES["pitch_diameter"]),
    Key("inner_groove_radius_mm", "inner_groove_radius", "mm", mm, LENGTH, range=LENGTH_RANGES["inner_groove_radius"]),
    Key("outer_groove_radius_mm", "outer_groove_radius", "mm", mm, LENGTH, range=LENGTH_RANGES["outer_groove_radius"]),
    Key("free_contact_angle_deg", "free_contact_angle", "deg", deg, ANGLE, range=FREE_ANGLES),
    Key("diametral_clearance_mm", "diametral_clearance", "mm", mm, LENGTH),
)

COEFFICIENTS = {
    **{f"{side}_groove_radius_coefficient": (f"{side}_groove_radius_mm",) for side in ("inner", "outer")},
    "groove_radius_coefficient": ("inner_groove_radius_mm", "outer_groove_radius_mm"),
}
"""f = r/D of a groove, or of both, with the ball diameter of the same bearing; each stands for these radii."""
RACEWAYS = tuple(
    Key(f"{side}_raceway_diameter_mm", f"{side}_raceway_diameter", "mm", mm, LENGTH) for side in ("inner", "outer")
)
"""At the bottom of each groove; both together stand for the pitch diameter and the clearance."""
DIAMETERS = (
    Key("bore_diameter_mm", "bore_diameter", "mm", mm, LENGTH),
    Key("outside_diameter_mm", "outside_diameter", "mm", mm, LENGTH),
)
"""Of the bearing as a whole."""
SHOULDERS = tuple(
    Key(f"{side}_shoulder_diameter_mm", f"{side}_shoulder_diameter", "mm", mm, LENGTH) for side in ("inner", "outer")
)
RATINGS = tuple(Key(f"{kind}_load_rating_N", f"{kind}_load_rating", "N", N, FORCE) for kind in ("dynamic", "static"))
PRINTED = (*DIAMETERS, Key("width_mm", "width", "mm", mm, LENGTH), *SHOULDERS, *RATINGS)
"""What a catalogue prints of a bearing besides: what needs one takes it from here, so that a file states it once."""
DATA_SHEET = (
    *(Key(f"{kind}_rating_factor", f"{kind}_rating_factor") for kind in ("dynamic", "static")),
    Key("f0", "f0"),
    Key("pair_rigidity_N_per_um", "pair_rigidity", "N/um", N / um),
    Key("pair_preload_N", "pair_preload", "N", N, FORCE),
    Key("ball_set", "ball_set", range=(1.0, 30.0)),
)
SHEET_WORDS = ("maker", "rating_practice")
"""What of a data sheet tells the balls and grooves that it does not print."""
IN_PLACE = (*(Key(name, name) for name in COEFFICIENTS), *RACEWAYS, *PRINTED, *DATA_SHEET)
"""What a file's [bearing] may hold besides, which is no length of the model."""

MATERIAL = (
    Key("elastic_modulus_GPa", "elastic_modulus", "GPa", GPa, MODULUS, range=RANGES["elastic_modulus"]),
    Key("poisson_ratio", "poisson_ratio", range=RANGES["poisson_ratio"]),
    Key("density_kg_m3", "density", "kg/m3", kg_m3, DENSITY, range=RANGES["density"]),
    Key("thermal_expansion_per_K", "thermal_expansion", "1/K", range=RANGES["thermal_expansion"]),
)

OPERATION = (
    Key("speed_rpm", "speed", "rpm", rpm, SPEED, range=SPEEDS),
    Key("outer_speed_rpm", "outer_speed", "rpm", rpm, SPEED, range=SPEEDS),
    Key("axial_load_N", "axial_load", "N", N, FORCE, range=LOADS),
    Key("axial_displacement_um", "axial_displacement", "um", um, LENGTH, range=DISPLACEMENTS),
    Key("radial_load_y_N", "radial_load_y", "N", N, FORCE, range=LOADS),
    Key("radial_displacement_y_um", "radial_displacement_y", "um", um, LENGTH, range=DISPLACEMENTS),
    Key("radial_load_z_N", "radial_load_z", "N", N, FORCE, range=LOADS),
    Key("radial_displacement_z_um", "radial_displacement_z", "um", um, LENGTH, range=DISPLACEMENTS),
    Key("moment_y_Nm", "moment_y", "N m", Nm, MOMENT, range=LOADS),
    Key("tilt_y_mrad", "tilt_y", "mrad", mrad, ANGLE, range=TILTS),
    Key("moment_z_Nm", "moment_z", "N m", Nm, MOMENT, range=LOADS),
    Key("tilt_z_mrad", "tilt_z", "mrad", mrad, ANGLE, range=TILTS),
    Key("first_ball_azimuth_deg", "first_ball_azimuth", "deg", deg, ANGLE, range=AZIMUTHS),
)

SPECTRUM = (Key("share", "share"), Key("hours", "hours", "h"), *OPERATION)
"""Of an operating point of a load spectrum: its share of the time, and how it is operated."""

PRELOAD = (
    Key("spring_N", "spring", "N", N, FORCE, range=PRELOADS),
    Key("rigid_N", "rigid", "N", N, FORCE, range=PRELOADS),
    Key("mounted_N", "mounted", "N", N, FORCE, range=PRELOADS),
    Key("axial_displacement_um", "axial_displacement", "um", um, LENGTH, range=DISPLACEMENTS),
)


def celsius(field: str) -> Key:
    """A temperature."""
    return Key(f"{field}_C", field, "C", 1.0, TEMPERATURE, zero_celsius)


RING_EXPANSION = (
    *(replace(key, range=OF_RINGS[key.field]) for key in DIAMETERS),
    Key("shaft_interference_um", "shaft_interference", "um", um, LENGTH),
    Key("shaft_bore_diameter_mm", "shaft_bore_diameter", "mm", mm, LENGTH, range=OF_RINGS["shaft_bore_diameter"]),
    Key("housing_interference_um", "housing_interference", "um", um, LENGTH),
    Key(
        "housing_outside_diameter_mm",
        "housing_outside_diameter",
        "mm",
        mm,
        LENGTH,
        range=OF_RINGS["housing_outside_diameter"],
    ),
    *map(celsius, ("shaft_temperature", "inner_ring_temperature", "outer_ring_temperature", "housing_temperature")),
    celsius("reference_temperature"),
    Key("yield_strength_MPa", "yield_strength", "MPa", MPa, PRESSURE, range=OF_RINGS["yield_strength"]),
)
ELASTIC_RINGS = (
    Key("outer.outside_diameter_mm", "outside_diameter", "mm", mm, LENGTH),
    Key("outer.width_mm", "outer_width", "mm", mm, LENGTH),
    Key("outer.shoulder_diameter_mm", "outer_shoulder_diameter", "mm", mm, LENGTH),
    Key("outer.open_diameter_mm", "outer_open_diameter", "mm", mm, LENGTH),
    Key("outer.housing.outside_diameter_mm", "housing_outside_diameter", "mm", mm, LENGTH),
    Key("outer.housing.elastic_modulus_GPa", "housing_elastic_modulus", "GPa", GPa, MODULUS),
    Key("outer.housing.poisson_ratio", "housing_poisson_ratio"),
    Key("inner.bore_diameter_mm", "bore_diameter", "mm", mm, LENGTH),
    Key("inner.width_mm", "inner_width", "mm", mm, LENGTH),
    Key("inner.shoulder_diameter_mm", "inner_shoulder_diameter", "mm", mm, LENGTH),
    Key("inner.open_diameter_mm", "inner_open_diameter", "mm", mm, LENGTH),
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
BALL_EXPANSION = (celsius("ball_temperature"), celsius("reference_temperature"))

EFFECTS = (Key("friction_coefficient", "friction_coefficient"),)
BALL_DEVIATIONS = Key("ball_diameter_deviations_um", "deviations", "um", um, LENGTH)
"""A list, of as many numbers as there are balls, which names its effect."""

ROW = (
    Key("position_mm", "position", "mm", mm, LENGTH),
    Key("offset_um", "offset", "um", um, LENGTH),
    *(Key(f"housing_{name}_um", f"housing_{name}", "um", um, LENGTH) for name in ("radial_y", "radial_z")),
    *(Key(f"housing_{name}_mrad", f"housing_{name}", "mrad", mrad, ANGLE) for name in ("tilt_y", "tilt_z")),
)
HEATED = (celsius("temperature"), celsius("reference_temperature"))
SHAFT = (
    Key("reference_position_mm", "reference_position", "mm", mm, LENGTH),
    Key("start_mm", "start", "mm", mm, LENGTH),
    *HEATED,
)
_POSITION = Key("position_mm", "position", "mm", mm, LENGTH)
SECTION = (
    Key("length_mm", "length", "mm", mm, LENGTH),
    Key("outer_diameter_mm", "outer_diameter", "mm", mm, LENGTH),
    Key("inner_diameter_mm", "inner_diameter", "mm", mm, LENGTH),
    *(Key(f"end_{side}_diameter_mm", f"end_{side}_diameter", "mm", mm, LENGTH) for side in ("outer", "inner")),
)
SHAFT_MASS = (
    _POSITION,
    Key("mass_kg", "mass", "kg"),
    *(Key(f"{way}_inertia_kg_m2", f"{way}_inertia", "kg m2") for way in ("polar", "diametral")),
)
SHAFT_LOAD = (
    _POSITION,
    *(Key(f"{name}_N", name, "N", N, FORCE) for name in ("axial", "radial_y", "radial_z")),
    *(Key(f"{name}_Nm", name, "N m", Nm, MOMENT) for name in ("moment_y", "moment_z")),
)


def stiffness(field: str, is_of_tilt: bool) -> Key:
    """A stiffness of a support or a housing."""
    if is_of_tilt:
        return Key(f"{field}_stiffness_kNm_per_rad", field, "kN m/rad", 1e3)
    return Key(f"{field}_stiffness_N_per_um", field, "N/um", N / um)


SHAFT_SUPPORT = (
    _POSITION,
    *(stiffness(name, False) for name in ("axial", "radial_y", "radial_z")),
    *(stiffness(name, True) for name in ("tilt_y", "tilt_z")),
)
HOUSING_STIFFNESS = (stiffness("axial", False), stiffness("radial", False), stiffness("tilt", True))
SPACER = (
    *(Key(f"{side}_length_mm", f"{side}_length", "mm", mm, LENGTH) for side in ("inner", "outer")),
    *(celsius(f"{side}_temperature") for side in ("inner", "outer")),
)
FLOATING = (Key("spring_N", "spring", "N", N, FORCE),)
SET_NUMBERS = {
    "rows": ROW,
    "shaft": SHAFT,
    "housing": (*HEATED, DIAMETERS[1]),
    "spacers": SPACER,
    "floating": FLOATING,
    "sections": SECTION,
    "loads": SHAFT_LOAD,
    "supports": SHAFT_SUPPORT,
    "masses": SHAFT_MASS,
    "housing_stiffness": HOUSING_STIFFNESS,
}
"""The keys that hold numbers in what a file of a set has in addition to the tables of a scene."""

MATERIALS = ("ball_material", "ring_material")
SEAT_MATERIALS = ("shaft_material", "housing_material")
SEAT_FITS = ("shaft_fit", "housing_fit", "tolerance_class")
"""Words: of each seat in place of its interference, and of the bearing."""
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
}
"""The keys that hold numbers, by their table; a material is a table within others."""

SECTIONS: dict[str, tuple[str, ...]] = {
    "bearing": ("name", "kind", *(key.name for key in (*BEARING, *IN_PLACE)), *SHEET_WORDS, *MATERIALS),
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
    "readings": (),
    "thermal": (),
}
"""Every key a file may hold, by its table; those of readings and of heat stand with each of them."""

SET_SECTIONS: dict[str, tuple[str, ...]] = {
    "rows": (
        *(key.name for key in ROW), "carries", "sprung", "housing_stiffness", "bearing", *EFFECT_TABLES, "readings",
    ),
    "shaft": (*(key.name for key in SHAFT), "gravity_m_s2", "sections", "loads", "supports", "masses", "points"),
    "housing": (*(key.name for key in (*HEATED, DIAMETERS[1])), "material"),
    "spacers": ("rows", *(key.name for key in SPACER), "inner_material", "outer_material"),
    "floating": ("rows", *(key.name for key in FLOATING), "preload"),
}  # fmt: skip
"""Likewise, of the tables that only a set has."""
MAKES_SET = tuple(name for name in SET_SECTIONS if name != "housing")
"""Those that make a file one of a set; a single bearing may be in a housing as well."""
SHAFT_SECTIONS: dict[str, tuple[str, ...]] = {
    "sections": (*(key.name for key in SECTION), "material"),
    "loads": tuple(key.name for key in SHAFT_LOAD),
    "supports": tuple(key.name for key in SHAFT_SUPPORT),
    "masses": tuple(key.name for key in SHAFT_MASS),
    "housing_stiffness": (*(key.name for key in HOUSING_STIFFNESS), "matrix_SI"),
}
"""Likewise, of the tables within [shaft] and [[rows]]."""
NUMBERED = {
    "row": "rows", "spacer": "spacers", "floating": "floating",
    "section": "sections", "load": "loads", "support": "supports", "mass": "masses",
}  # fmt: skip
"""What one of several tables is called in errors, its number following; and its table."""

EFFECT_SECTIONS = {
    name: (*(key.name for key in keys), *((*SEAT_MATERIALS, *SEAT_FITS) if name == "ring_expansion" else ()))
    for name, keys in EFFECT_TABLES.items()
}
EFFECT_SECTIONS["elastic_rings"] += (*SEATS, *(key.name for key in RING_COMPLIANCES))
"""Likewise, by the tables within [effects]."""

SPECTRUM_POINT = "spectrum point"
"""What a point of a spectrum is called in errors, its number following."""

MATERIAL_KEYS = tuple(key.name for key in MATERIAL)
