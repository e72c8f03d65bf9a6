"""A thick ring under pressure, in rotation and in heat: how far its material moves, and what stress that makes.

Source        Timoshenko & Goodier, Theory of Elasticity: "Stress distribution symmetrical about an axis" (Lame's
              cylinder) and "Rotating disks", both in plane stress
Equation      sigma_r, sigma_theta as below; u = r (sigma_theta - nu sigma_r)/E, with u = 0 in the undeformed ring
Assumes       an elastic ring of rectangular section a < r < b, free to contract along its axis; a = 0 is a solid disk
When not      a ring held axially, or one whose section varies much along its axis, as high shoulders make it

All arguments are SI and may be arrays, which broadcast; inner_radius < outer_radius, and radius between the two.
"""

from __future__ import annotations

from typing import Any, NamedTuple


class Elastic(NamedTuple):
    """Constants of a ring's material, SI."""

    modulus: Any
    poisson_ratio: Any
    density: Any


class PlaneStress(NamedTuple):
    """Radial and hoop stress [Pa], tension positive."""

    radial: Any
    hoop: Any


def stress_by_pressure(radius: Any, a: Any, b: Any, inner_pressure: Any, outer_pressure: Any) -> PlaneStress:
    """Lame: A -+ B/r^2 with A = (a^2 pi - b^2 po)/(b^2 - a^2) and B = a^2 b^2 (pi - po)/(b^2 - a^2)."""
    area = b * b - a * a
    mean = (a * a * inner_pressure - b * b * outer_pressure) / area
    varying = a * a * b * b * (inner_pressure - outer_pressure) / (area * radius * radius)
    return PlaneStress(mean - varying, mean + varying)


def stress_by_rotation(radius: Any, a: Any, b: Any, speed: Any, material: Elastic) -> PlaneStress:
    """Rotating annulus: (3 + nu)/8 rho w^2 (a^2 + b^2 -+ a^2 b^2/r^2 - r^2 {1 | (1 + 3 nu)/(3 + nu)})."""
    _, nu, rho = material
    size = (3.0 + nu) / 8.0 * rho * speed * speed
    even, varying, square = a * a + b * b, a * a * b * b / (radius * radius), radius * radius
    return PlaneStress(
        size * (even - varying - square), size * (even + varying - (1.0 + 3.0 * nu) / (3.0 + nu) * square)
    )


def displacement(radius: Any, stress: PlaneStress, material: Elastic) -> Any:
    """u = r (sigma_theta - nu sigma_r)/E, outward [m]."""
    return radius * (stress.hoop - material.poisson_ratio * stress.radial) / material.modulus
