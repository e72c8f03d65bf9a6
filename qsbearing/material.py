"""Materials of balls, rings, shafts and housings."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from qsbearing.validation import DENSITY, EXPANSION, MODULUS, RATIO, ErrorDetail, within


@dataclass(frozen=True)
class Material:
    """An isotropic elastic material; SI units. Any number may be an array, which spans cases."""

    elastic_modulus: ArrayLike
    """Young's modulus E [Pa]."""
    poisson_ratio: ArrayLike
    """Poisson's ratio [-]."""
    density: ArrayLike
    """Density [kg/m^3]."""
    thermal_expansion: ArrayLike | None = None
    """Linear expansion [1/K]; needed by ring and ball expansion where temperatures are given, and by nothing else."""
    name: str = "unnamed"
    source: str = ""


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

BY_NAME = {material.name: material for material in (STEEL, SILICON_NITRIDE)}
"""The materials a scene file may name."""


def material_errors(field: str, material: Material) -> list[ErrorDetail]:
    """Every error of a material in this field."""
    if not isinstance(material, Material):
        cause = "qs.STEEL, qs.SILICON_NITRIDE or qs.Material"
        return [ErrorDetail(field, "is not a material", material, cause=cause)]
    expansion = material.thermal_expansion
    return [
        *within(f"{field}.elastic_modulus", material.elastic_modulus, MODULUS, 1e9, 2e12),
        *within(f"{field}.poisson_ratio", material.poisson_ratio, RATIO, 0.0, 0.499),
        *within(f"{field}.density", material.density, DENSITY, 100.0, 25000.0),
        *([] if expansion is None else within(f"{field}.thermal_expansion", expansion, EXPANSION, -1e-5, 1e-4)),
    ]
