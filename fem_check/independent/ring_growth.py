"""How rings grow by rotation, fits and heat: the plane-stress field of turning annuli, joined at their seats.

S. Timoshenko & J. N. Goodier, Theory of Elasticity, "Rotating disks": an annulus that turns at w has

    u = c1 r + c2/r - (1 - nu^2) rho w^2 r^3/(8 E),     sigma_r = E/(1 - nu^2) (du/dr + nu u/r).

c1 and c2 of every body follow together from the conditions at its surfaces: no radial stress where it is free, and at a
seat one radial stress for both, and displacements that make up for the interference. A seat that this would pull
together is open, and both bodies are free.

Radii are those before heating. A body that heat makes larger by 1 + s keeps its mass: its density falls by (1 + s)^3,
and rho r^2, on which the stress depends, by 1 + s.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fem_check.independent.contact_problem import Array


@dataclass(frozen=True)
class LameRing:
    """A ring, a shaft (bore 0: solid) or a housing; SI units."""

    bore_radius: float
    outside_radius: float
    elastic_modulus: float
    poisson_ratio: float
    density: float
    speed: float
    strain: float
    """Of heat, alpha dT."""

    def _rotation(self, radius: float) -> tuple[float, float]:
        """(u, sigma_r) of the last term."""
        nu = self.poisson_ratio
        size = self.density / (1.0 + self.strain) * self.speed**2 / 8.0
        return -(1.0 - nu**2) * size * radius**3 / self.elastic_modulus, -(3.0 + nu) * size * radius**2

    def displacement(self, radius: float, with_heat: bool = True) -> tuple[Array, float]:
        """Row of the coefficients of (c1, c2) in u, and its known part."""
        return np.array([radius, 1.0 / radius]), self._rotation(radius)[0] + with_heat * self.strain * radius

    def radial_stress(self, radius: float) -> tuple[Array, float]:
        """Row of the coefficients of (c1, c2) in sigma_r, and its known part; of a solid body at its centre the
        condition that u vanishes there."""
        if radius == 0.0:
            return np.array([0.0, 1.0]), 0.0
        e, nu = self.elastic_modulus, self.poisson_ratio
        return np.array([e / (1.0 - nu), -e / (1.0 + nu) / radius**2]), self._rotation(radius)[1]


def elastic_growth(ring: LameRing, radius: float, seat: LameRing | None = None, interference: float = 0.0) -> float:
    """Outward displacement of a ring at a radius, but for that by its own heat [m].

    Args:
        seat: the shaft inside the ring or the housing around it; None: the ring is free.
        interference: diametral, shaft less bore or outside diameter less housing [m].
    """
    row, known = ring.displacement(radius, with_heat=False)
    if seat is not None:
        inside, outside = (seat, ring) if seat.outside_radius == ring.bore_radius else (ring, seat)
        joined = _joined(inside, outside, interference)
        if joined is not None:
            return float(row @ joined[:2] if inside is ring else row @ joined[2:]) + known
    conditions = [ring.radial_stress(end) for end in (ring.bore_radius, ring.outside_radius)]
    free = np.linalg.solve(np.array([each for each, _ in conditions]), [-value for _, value in conditions])
    return float(row @ free) + known


def _joined(inside: LameRing, outside: LameRing, interference: float) -> Array | None:
    """(c1, c2) of both bodies; None where the seat is open."""
    seat, none = inside.outside_radius, np.zeros(2)
    (stress_in, known_in), (stress_out, known_out) = inside.radial_stress(seat), outside.radial_stress(seat)
    (moved_in, by_in), (moved_out, by_out) = inside.displacement(seat), outside.displacement(seat)
    bore, at_bore = inside.radial_stress(inside.bore_radius)
    end, at_end = outside.radial_stress(outside.outside_radius)
    rows = [[*bore, *none], [*none, *end], [*stress_in, *-stress_out], [*-moved_in, *moved_out]]
    right = [-at_bore, -at_end, known_out - known_in, 0.5 * interference + by_in - by_out]
    # Stiffnesses and lengths in one matrix: rows are brought to one size.
    size = np.abs(rows).max(axis=1)
    constants = np.linalg.solve(np.array(rows) / size[:, None], np.array(right) / size)
    return np.asarray(constants) if stress_in @ constants[:2] + known_in < 0.0 else None


def compliance_on_shaft(
    radii: tuple[float, float, float], ring: tuple[float, float], shaft: tuple[float, float]
) -> float:
    """Inward displacement of a ring's outer rim by a unit pressure round it, the ring on a hollow shaft [m/Pa].

    Plane stress; Lame's cylinders under pressure inside and outside, which share one displacement at the seat.

    Args:
        radii: the shaft's bore, the seat, the ring's outer rim [m].
        ring: Young's modulus [Pa] and Poisson's ratio.
        shaft: Young's modulus [Pa] and Poisson's ratio.
    """
    c, a, b = radii

    def of_ring(r: float, inside: float, outside: float) -> float:
        modulus, nu = ring
        uniform = (1.0 - nu) * (inside * a**2 - outside * b**2) * r
        return (uniform + (1.0 + nu) * a**2 * b**2 * (inside - outside) / r) / (modulus * (b**2 - a**2))

    of_shaft = -a / shaft[0] * ((a**2 + c**2) / (a**2 - c**2) - shaft[1])
    seat = -of_ring(a, 0.0, 1.0) / (of_ring(a, 1.0, 0.0) - of_shaft)
    return -of_ring(b, seat, 1.0)
