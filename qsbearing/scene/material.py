"""Materials of balls and rings."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Material:
    """An isotropic elastic material; SI units. Any number may be an array, which spans cases."""

    elastic_modulus: ArrayLike
    """Young's modulus E [Pa]."""
    poisson_ratio: ArrayLike
    """Poisson's ratio [-]."""
    density: ArrayLike
    """Density [kg/m^3]."""
    thermal_expansion: float | None = None
    """Linear expansion [1/K]; None where nothing asks for it."""
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
