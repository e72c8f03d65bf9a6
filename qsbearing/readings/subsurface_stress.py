"""Shear below every contact, where fatigue begins, and the permanent dent of a static overload.

Sources: largest shear under the centre by `contact/hertz.py` (Johnson). Orthogonal shear, which reverses as a ball
passes: G. Lundberg & A. Palmgren 1947: with b/a = sqrt((t^2 - 1)(2 t - 1)),

    tau0/p0 = sqrt(2 t - 1)/(2 t (t + 1))          z0/b = 1/((t + 1) sqrt(2 t - 1))

Dent: A. Palmgren, as Harris & Kotzalas print it for point contact of hardened bearing steel, ball and raceway together,

    depth = 1.3e-7 (Q^2/D) rho_x rho_y             N, mm; rho: sums of both bodies' curvatures in the principal planes

It was measured where dents are of the order of 1e-4 D, and comes to 1.1e-4 to 2.6e-4 D at 4200 MPa, ISO 76's limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.contact.hertz import subsurface_shear
from qsbearing.raceway_contacts import RacewayContacts
from qsbearing.readings.ball_motion import gamma
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.remarks import Remarks, remarks
from qsbearing.solution import Solution
from qsbearing.units import mm

TABLE = 33
"""Ellipses between which the largest shear is interpolated: to 1e-5 of it and of its depth."""

SLENDEREST = 1e-3
"""b/a of the last of them; beyond, a line contact."""

NOTICEABLE = 1e-4
"""A dent of this part of the ball's diameter is where ISO 76 sets the static limit."""


@dataclass(frozen=True)
class RacewayStress:
    """Stresses below the contacts of one raceway; arrays of shape (*cases, ball), NaN without load."""

    max_shear: NDArray
    """Largest shear stress on the axis through the centre [Pa], in the ring."""
    max_shear_depth: NDArray
    """[m]."""
    orthogonal_shear: NDArray
    """Amplitude of the shear stress parallel to the surface along rolling, which reverses at each passage [Pa]."""
    orthogonal_shear_depth: NDArray
    """[m]."""
    dent: NDArray
    """Permanent indentation, ball and raceway together, after standing under this load [m]."""


@dataclass(frozen=True)
class Stress:
    """Subsurface stresses of a solution."""

    inner: RacewayStress
    outer: RacewayStress
    warnings: Remarks


def stress(solution: Solution) -> Stress:
    """Shear stresses and dents of every contact."""
    inner, outer = (_raceway(solution, *side) for side in ((solution.inner, INNER), (solution.outer, OUTER)))
    numbers = BearingNumbers(solution.scene.operating_bearing)
    found = []
    for name, raceway in (("inner", inner), ("outer", outer)):
        deep = np.nan_to_num(raceway.dent) > NOTICEABLE * numbers.ball_diameter[..., None]
        found.append((deep.any(axis=-1), f"an {name} contact dents by more than {NOTICEABLE:g} of the ball's diameter"))
    ceramic = "dents were measured on steel; ceramic balls keep their shape, the raceway alone yields"
    found.append((numbers.is_hybrid, ceramic))
    return Stress(inner, outer, remarks(found, solution.shape))


def _raceway(solution: Solution, contacts: RacewayContacts, side: float) -> RacewayStress:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    loaded = contacts.load > 0.0
    p0, b = (np.where(loaded, each, np.nan) for each in (contacts.max_pressure, contacts.semi_minor_axis))
    ratio = b / np.where(loaded, contacts.semi_major_axis, np.nan)
    shear, depth = _max_shear(ratio, np.asarray(solution.scene.operating_bearing.ring_material.poisson_ratio, float))
    t = _orthogonal_parameter(ratio)
    root = np.sqrt(2.0 * t - 1.0)
    D = numbers.ball_diameter[..., None]
    rolling = 2.0 / (D * (1.0 + side * gamma(solution) * np.cos(contacts.angle)))
    f = numbers.groove_coefficient(side)[..., None]
    transverse = (2.0 * f - 1.0) / (f * D)
    dent = 1.3e-7 * contacts.load**2 / (D / mm) * (rolling * mm) * (transverse * mm) * mm
    return RacewayStress(
        p0 * shear,
        b * depth,
        p0 * root / (2.0 * t * (t + 1.0)),
        b / ((t + 1.0) * root),
        np.where(loaded, dent, np.nan),
    )


def _orthogonal_parameter(ratio: NDArray) -> NDArray:
    """t of (t^2 - 1)(2 t - 1) = (b/a)^2: Newton's method from the slender side."""
    square = ratio**2
    t = 1.0 + 0.28 * square
    for _ in range(6):
        t = t - ((t * t - 1.0) * (2.0 * t - 1.0) - square) / (6.0 * t * t - 2.0 * t - 2.0)
    return np.asarray(t)


def _max_shear(ratio: NDArray, poisson_ratio: NDArray) -> tuple[NDArray, NDArray]:
    """Largest shear over p0, and its depth over b."""
    shear, depth = np.full(ratio.shape, np.nan), np.full(ratio.shape, np.nan)
    spread = np.broadcast_to(poisson_ratio[..., None], ratio.shape)
    for value in np.unique(poisson_ratio):
        of_stress, of_depth = _shear_table(float(value))
        where = spread == value
        x = np.log(np.maximum(ratio[where], SLENDEREST))
        shear[where], depth[where] = of_stress(x), of_depth(x)
    return shear, depth


@cache
def _shear_table(poisson_ratio: float) -> tuple[Any, Any]:
    """Largest shear over p0 and its depth over b, as splines of ln(b/a)."""
    from scipy.interpolate import CubicSpline

    places = np.linspace(np.log(SLENDEREST), 0.0, TABLE)
    found = [subsurface_shear(float(np.exp(-x)), poisson_ratio) for x in places]
    return (
        CubicSpline(places, [each.stress for each in found]),
        CubicSpline(places, [each.depth for each in found]),
    )
