"""Materials of balls, rings, shafts and housings."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.model.described import given_in
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import DENSITY, EXPANSION, MODULUS, RATIO, ErrorDetail, within

RANGES = {
    "elastic_modulus": (1e9, 2e12),
    "poisson_ratio": (0.0, 0.499),
    "density": (100.0, 25000.0),
    "thermal_expansion": (-1e-5, 1e-4),
}
"""Of each number of a material, in SI."""


@dataclass(frozen=True)
class Material:
    """An isotropic elastic material; SI units. Any number may be an array, which spans cases."""

    elastic_modulus: ArrayLike = field(metadata=given_in("GPa", RANGES["elastic_modulus"]))
    """Young's modulus E [Pa]."""
    poisson_ratio: ArrayLike = field(metadata=given_in(range=RANGES["poisson_ratio"]))
    """Poisson's ratio [-]."""
    density: ArrayLike = field(metadata=given_in("kg/m3", RANGES["density"]))
    """Density [kg/m^3]."""
    thermal_expansion: ArrayLike | None = field(default=None, metadata=given_in("1/K", RANGES["thermal_expansion"]))
    """Linear expansion [1/K]; needed by ring and ball expansion where temperatures are given, and by nothing else."""
    name: str = "unnamed"
    """For headings and files."""
    source: str = ""
    """Where its numbers come from."""


STEEL = Material(
    elastic_modulus=208e9,
    poisson_ratio=0.3,
    density=7800.0,
    thermal_expansion=12e-6,
    name="steel",
    source="Wang, Yan, Zhang & Hong, table of the B218 bearing (E, Poisson's ratio, density); expansion: usual "
    "handbook value of bearing steel",
)
"""Bearing steel as the source of B218 takes it."""

SILICON_NITRIDE = Material(
    elastic_modulus=315e9,
    poisson_ratio=0.26,
    density=3200.0,
    thermal_expansion=3.2e-6,
    name="silicon nitride",
    source="GMN catalogue 4000 0813 EN, material characteristics; grades differ by some per cent",
)
"""Silicon nitride, the ceramic of hybrid bearings."""

BEARING_STEEL = Material(
    elastic_modulus=210e9,
    poisson_ratio=0.3,
    density=7800.0,
    thermal_expansion=12e-6,
    name="100Cr6",
    source="GMN catalogue 4000 0813 EN, material characteristics (E, density); Poisson's ratio and expansion: usual "
    "handbook values. The 'steel' of this program has 208 GPa",
)
"""100Cr6, which is AISI 52100 and SUJ2."""

M50 = Material(
    elastic_modulus=214e9,
    poisson_ratio=0.29,
    density=7870.0,
    thermal_expansion=11.2e-6,
    name="M50",
    source="BTI Metals, data sheet of M50 VIM-VAR (E 214 GPa hardened, 7.87 g/cm3, 11.21e-6 per K from 21 to 93 C); "
    "Poisson's ratio: makeitfrom.com, M50, annealed. Others print 203 GPa and 7.81 to 8.03 g/cm3",
)
"""High-speed steel of aircraft engines."""

ALUMINIUM = Material(
    elastic_modulus=70e9,
    poisson_ratio=0.3,
    density=2700.0,
    thermal_expansion=23e-6,
    name="aluminium",
    source="EN 1999-1-1 (draft of 05-2004), 3.2.5: constants of wrought and cast structural alloys",
)
"""Structural aluminium alloys, as those of housings."""

CAST_IRON = Material(
    elastic_modulus=110e9,
    poisson_ratio=0.26,
    density=7200.0,
    thermal_expansion=11.7e-6,
    name="cast iron",
    source="EN 1561, annex of typical properties, EN-GJL-250: E 103 to 118 GPa (falls with the stress), 7.20 g/cm3, "
    "11.7e-6 per K from 20 to 200 C (values at second hand)",
)
"""Grey cast iron EN-GJL-250."""

STAINLESS_BEARING_STEEL = Material(
    elastic_modulus=200e9,
    poisson_ratio=0.28,
    density=7650.0,
    thermal_expansion=10.1e-6,
    name="440C",
    source="qinghesteels.com, 440C (E, density, expansion from 0 to 100 C); Poisson's ratio: makeitfrom.com, 440C, "
    "annealed. Rolled Alloys prints 210 GPa, EN 10088-1 of its group 215 GPa and 10.4e-6 per K",
)
"""Martensitic stainless steel of bearings, 1.4125."""

STAINLESS_STEEL = Material(
    elastic_modulus=200e9,
    poisson_ratio=0.3,
    density=7900.0,
    thermal_expansion=16e-6,
    name="1.4301",
    source="EN 10088-1, 1.4301, at ambient temperature (rolextube.com); Poisson's ratio: usual handbook value",
)
"""Austenitic stainless steel 1.4301, as of shafts and housings; rings and balls are 440C."""

TITANIUM = Material(
    elastic_modulus=114e9,
    poisson_ratio=0.33,
    density=4430.0,
    thermal_expansion=8.6e-6,
    name="titanium",
    source="asm.matweb.com, Ti-6Al-4V (Grade 5), annealed bar; expansion from 20 to 100 C",
)
"""Ti-6Al-4V."""

_OTHER_NAMES = {
    "aluminium": ("aluminum",),
    "cast iron": ("grey cast iron", "gray cast iron", "EN-GJL-250", "GJL-250", "GG25"),
    "440C": ("AISI 440C", "1.4125", "SUS440C"),
    "1.4301": ("stainless steel", "stainless", "AISI 304", "304"),
    "titanium": ("Ti-6Al-4V", "Ti6Al4V"),
    "silicon nitride": ("Si3N4",),
    "100Cr6": ("1.3505", "AISI 52100", "SAE 52100", "52100", "SUJ2"),
    "M50": ("AISI M50",),
}
OF_BODIES = (ALUMINIUM, CAST_IRON, STAINLESS_BEARING_STEEL, STAINLESS_STEEL, TITANIUM)
BY_NAME = {
    spelling.lower(): material
    for material in (STEEL, SILICON_NITRIDE, BEARING_STEEL, M50, *OF_BODIES)
    for spelling in (material.name, *_OTHER_NAMES.get(material.name, ()))
}
"""The materials a scene file may name, by all that they are called, in small letters."""

EXPANSION_HOLDS = (-50.0 + zero_celsius, 300.0 + zero_celsius)
"""Where the coefficients above, one number each, are within 10 % of the mean coefficient between 20 °C and there [K].

By steel: 55Cr3 (data sheets to EN 10089) has 10.5e-6 per kelvin at -100 °C, 11.5 at 20, 12.1 at 100, 12.7 at 200, 13.2
at 300 and 13.6e-6 at 400 °C, EN 1993-1-2, 3.4.1.1, 1.2e-5 + 0.4e-8 (T + 20) from 20 to 750 °C; iron contracts by 0.19 %
down to 77 K and 0.197 % to 20 K (Ekin, Experimental Techniques for Low-Temperature Measurements, appendix A6.4), on
average by 8.8e-6 and 7.2e-6 per kelvin. For silicon nitride no such table was found; its range is taken to be no wider.
Of the others, aluminium (EN 1999-1-2, 3.3.1: 22.5e-6 + 1e-8 (T + 20), 24.7e-6 up to 200 °C and 25.7e-6 up to 300 °C)
and cast iron (10.0e-6 from -100 to 20 °C, 11.7e-6 up to 200 °C, 13.0e-6 up to 400 °C) end earlier.
"""
EXPANSION_HOLDS_OF = {
    "aluminium": (EXPANSION_HOLDS[0], 250.0 + zero_celsius),
    "cast iron": (0.0 + zero_celsius, EXPANSION_HOLDS[1]),
}
"""The narrower ranges, by the names of materials [K]."""


def expansion_holds(material: Material) -> tuple[float, float]:
    """Between which temperatures this program's coefficient of a material is good [K]."""
    return EXPANSION_HOLDS_OF.get(material.name, EXPANSION_HOLDS)


def is_own_expansion(material: Material) -> Any:
    """Where the coefficient is one of this program, rather than one that is given for a temperature of its own."""
    known = [each.thermal_expansion for each in BY_NAME.values()]
    return np.isin(np.asarray(material.thermal_expansion, float), np.asarray(known, float))


def material_errors(field: str, material: Material) -> list[ErrorDetail]:
    """Every error of a material in this field."""
    if not isinstance(material, Material):
        cause = "qs.STEEL, qs.SILICON_NITRIDE or qs.Material"
        return [ErrorDetail(field, "is not a material", material, cause=cause)]
    given = material.thermal_expansion
    return [
        *within(f"{field}.elastic_modulus", material.elastic_modulus, MODULUS, *RANGES["elastic_modulus"]),
        *within(f"{field}.poisson_ratio", material.poisson_ratio, RATIO, *RANGES["poisson_ratio"]),
        *within(f"{field}.density", material.density, DENSITY, *RANGES["density"]),
        *(
            []
            if given is None
            else within(f"{field}.thermal_expansion", given, EXPANSION, *RANGES["thermal_expansion"])
        ),
    ]


def material_named(word: str) -> Material | None:
    """The material of `BY_NAME` that a word names, in any letters, with an underscore in place of a space too."""
    return BY_NAME.get(word.lower().replace("_", " "))
