"""The contact problem: two elastic bodies, the gap between them, the load."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

Array = NDArray[Any]


@dataclass(frozen=True)
class ElasticConstants:
    """An isotropic elastic body."""

    elastic_modulus: float
    """Young's modulus E [Pa]."""
    poisson_ratio: float
    """Poisson's ratio [-]."""

    @property
    def compliance(self) -> float:
        """(1 - nu^2)/E [1/Pa]: the compliance of a half-space's surface under normal pressure."""
        return (1.0 - self.poisson_ratio**2) / self.elastic_modulus


@dataclass(frozen=True)
class ContactProblem:
    """Two bodies that touch at a point; x runs along the contact ellipse's long axis, y along its short one."""

    name: str
    curvature_x: float
    """Sum of both bodies' curvatures in the x plane [1/m], the smaller one, > 0."""
    curvature_y: float
    """Sum of both bodies' curvatures in the y plane [1/m]."""
    ball: ElasticConstants
    race: ElasticConstants
    load: float
    """Normal load Q [N]."""

    def __post_init__(self) -> None:
        if not 0.0 < self.load < float("inf"):
            raise ValueError(f"load = {self.load} N: a contact carries a positive, finite load")
        if not 0.0 < self.curvature_x <= self.curvature_y < float("inf"):
            raise ValueError(
                f"curvatures {self.curvature_x} and {self.curvature_y} 1/m: both must be positive and the first the "
                "smaller (the gap opens slowest along x, the long axis)"
            )

    @property
    def bodies(self) -> tuple[ElasticConstants, ElasticConstants]:
        """The two bodies, ball first."""
        return self.ball, self.race

    def parabolic_gap(self, x: Array, y: Array) -> Array:
        """Hertz's gap between the undeformed surfaces [m]."""
        return 0.5 * self.curvature_x * x**2 + 0.5 * self.curvature_y * y**2


GapFunction = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class ContactQuantities:
    """Quantities of a contact, computed or predicted; SI units."""

    approach: float
    """Approach delta of points far inside the two bodies [m]."""
    semi_major_axis: float
    """a [m]."""
    semi_minor_axis: float
    """b [m]."""
    max_pressure: float
    """p0 at the centre [Pa]."""
    max_shear_stress: float = float("nan")
    """Largest shear stress on the axis below the centre, in the race [Pa]."""
    max_shear_depth: float = float("nan")
    """Its depth [m]."""


QUANTITIES = {
    "approach": "m",
    "semi_major_axis": "m",
    "semi_minor_axis": "m",
    "max_pressure": "Pa",
    "max_shear_stress": "Pa",
    "max_shear_depth": "m",
}
"""The quantities of a contact and their SI units."""
