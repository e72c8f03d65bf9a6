"""Shear below every contact, where fatigue begins, and the permanent dent of a static overload.

Sources: largest shear under the centre by `contact/hertz.py` (Johnson). Orthogonal shear, which reverses as a ball
passes: G. Lundberg & A. Palmgren 1947: with b/a = sqrt((t^2 - 1)(2 t - 1)),

    tau0/p0 = sqrt(2 t - 1)/(2 t (t + 1))          z0/b = 1/((t + 1) sqrt(2 t - 1))

Dent: A. Palmgren, as Harris & Kotzalas print it for point contact of hardened bearing steel, ball and raceway together
(unconfirmed: the constant is from memory, no text with it was found; below it is held against ISO 76's limit),

    depth = 1.3e-7 (Q^2/D) rho_x rho_y             N, mm; rho: sums of both bodies' curvatures in the principal planes

It was measured where dents are of the order of 1e-4 D, and comes to 1.1e-4 to 2.6e-4 D at 4200 MPa, ISO 76's limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from math import log, nan, sqrt

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import entry, formula
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import subsurface_shear
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm
from qsbearing.readings.ball_motion import gamma
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.entry import Reading, check_solution, simply
from qsbearing.readings.passes import SAME_SHAPE, filled, of_balls, of_cases
from qsbearing.remarks.kinds import NOTE, SEE_CHOICES, Kind
from qsbearing.remarks.remark import Remarked, Remarks, remark, remarks

TABLE = 33
"""Ellipses between which the largest shear is interpolated: to 1e-5 of it and of its depth."""

SLENDEREST = 1e-3
"""b/a of the last of them; beyond, a line contact."""

NOTICEABLE = 1e-4
"""A dent of this part of the ball's diameter is where ISO 76 sets the static limit."""

NEEDS = ("load", "cosine", "semi_major_axis", "semi_minor_axis", "max_pressure"), ()

DENT_NOTICEABLE = Kind(
    "dent_noticeable", NOTE, "limits",
    "the dent of {raceways:an} contact is deeper than {limit:g} of the ball's diameter",
)  # fmt: skip
DENT_OF_CERAMIC = Kind(
    "dent_of_ceramic", NOTE, SEE_CHOICES,
    "dents were measured on steel; ceramic balls keep their shape, the raceway alone yields",
)  # fmt: skip


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
class Stress(Remarked):
    """Subsurface stresses of a solution."""

    inner: RacewayStress
    outer: RacewayStress
    remarks: Remarks


def stress(solution: Solution) -> Stress:
    """Shear stresses and dents of every contact.

    Returns:
        Stresses below every contact, and dents.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(f"{qs.readings.stress(solution).inner.max_shear[0] / qs.MPa:.0f} MPa")
        462 MPa
    """
    check_solution("stress", solution)
    solution.read_at_once(*NEEDS)
    inner, outer = (_raceway(solution, *side) for side in ((solution.inner, INNER), (solution.outer, OUTER)))
    numbers = BearingNumbers(solution.scene.operating_bearing)
    holding = []
    for name, raceway in (("inner", inner), ("outer", outer)):
        deep = raceway.dent > NOTICEABLE * numbers.ball_diameter[..., None]
        holding.append((deep.any(axis=-1), remark(DENT_NOTICEABLE, name, limit=NOTICEABLE)))
    holding.append((numbers.is_hybrid, remark(DENT_OF_CERAMIC)))
    return Stress(inner, outer, remarks(holding, solution.shape))


def _raceway(solution: Solution, contacts: RacewayContacts, side: float) -> RacewayStress:
    bearing = solution.scene.operating_bearing
    numbers = BearingNumbers(bearing)
    poisson = np.asarray(bearing.ring_material.poisson_ratio, float)
    kinds, which = np.unique(poisson, return_inverse=True)
    tables = np.stack([shear_table(float(value)) for value in kinds])
    f = numbers.groove_coefficient(side)
    given = of_cases(solution, gamma(solution)[..., 0], numbers.ball_diameter, f, which.reshape(poisson.shape))
    shape = contacts.semi_major_axis, contacts.semi_minor_axis
    arrays = of_balls(contacts.load, contacts.cosine, *shape, contacts.max_pressure)
    return RacewayStress(*filled(solution, 5, _fill, side, *given, tables, *arrays))


@entry(
    float, *[array_of(float)] * 4, array_of(float, 4), *[array_of(float, 2)] * 5, int, int, array_of(float, 3)
)  # fmt: skip
def _fill(
    side: float, gamma: NDArray, diameter: NDArray, groove: NDArray, kind: NDArray, shears: NDArray, load: NDArray,
    cosine: NDArray, semi_major_axis: NDArray, semi_minor_axis: NDArray, max_pressure: NDArray,
    begin: int, stop: int, out: NDArray,
) -> None:  # fmt: skip
    """The tables of a `RacewayStress`."""
    ratio_before, kind_before = 0.0, -1
    shear, depth, orthogonal, orthogonal_depth = 0.0, 0.0, 0.0, 0.0
    for k in range(begin, stop):
        D, f = diameter[k] / mm, groove[k]
        transverse = (2.0 * f - 1.0) / (f * D)
        table = int(kind[k])
        for j in range(load.shape[1]):
            Q = load[k, j]
            if not Q > 0.0:
                for i in range(5):
                    out[i, k, j] = nan
                continue
            p0, b = max_pressure[k, j], semi_minor_axis[k, j]
            ratio = b / semi_major_axis[k, j]
            if table != kind_before or abs(ratio - ratio_before) > SAME_SHAPE * ratio:
                ratio_before, kind_before = ratio, table
                shear, depth = max_shear(shears, table, ratio)
                orthogonal, orthogonal_depth = orthogonal_shear(ratio)
            rolling = 2.0 / (D * (1.0 + side * gamma[k] * cosine[k, j]))
            out[0, k, j] = p0 * shear
            out[1, k, j] = b * depth
            out[2, k, j] = p0 * orthogonal
            out[3, k, j] = b * orthogonal_depth
            out[4, k, j] = 1.3e-7 * Q * Q / D * rolling * transverse * mm


@formula
def orthogonal_shear(ratio: float) -> tuple[float, float]:
    """(tau0/p0, z0/b) of an ellipse b/a; t of (t^2 - 1)(2 t - 1) = (b/a)^2 by Newton's method from the slender side."""
    square = ratio * ratio
    t = 1.0 + 0.28 * square
    for _ in range(6):
        t = t - ((t * t - 1.0) * (2.0 * t - 1.0) - square) / (6.0 * t * t - 2.0 * t - 2.0)
    root = sqrt(2.0 * t - 1.0)
    return root / (2.0 * t * (t + 1.0)), 1.0 / ((t + 1.0) * root)


@formula
def max_shear(shears: NDArray, kind: int, ratio: float) -> tuple[float, float]:
    """Largest shear over p0, and its depth over b."""
    step = -log(SLENDEREST) / (TABLE - 1)
    place = log(max(ratio, SLENDEREST)) - log(SLENDEREST)
    i = min(int(place / step), TABLE - 2)
    x = place - i * step
    c = shears[kind]
    shear = ((c[0, 0, i] * x + c[0, 1, i]) * x + c[0, 2, i]) * x + c[0, 3, i]
    return shear, ((c[1, 0, i] * x + c[1, 1, i]) * x + c[1, 2, i]) * x + c[1, 3, i]


@cache
def shear_table(poisson_ratio: float) -> NDArray:
    """Largest shear over p0 and its depth over b, as cubic splines of ln(b/a); shape (2, power falling, interval)."""
    from scipy.interpolate import CubicSpline

    places = np.linspace(np.log(SLENDEREST), 0.0, TABLE)
    shears = [subsurface_shear(float(np.exp(-x)), poisson_ratio) for x in places]
    values = [[each.stress for each in shears], [each.depth for each in shears]]
    return np.stack([CubicSpline(places, each).c for each in values])


ENTRY = Reading(
    name="stress",
    gives="largest and orthogonal shear below every contact and their depths; permanent dent",
    by="Johnson; Lundberg & Palmgren; Palmgren",
    take=simply(stress),
    needs=NEEDS,
    of_contact=(
        Result("max_shear", "MPa", "largest shear stress"),
        Result("max_shear_depth", "mm", "its depth"),
        Result("orthogonal_shear", "MPa", "orthogonal shear stress, amplitude"),
        Result("orthogonal_shear_depth", "mm", "its depth"),
        Result("dent", "um", "permanent dent"),
    ),
)
