"""Quantities of a solved contact: approach, semi-axes, peak pressure, largest shear; and what shows that it is sound.

The semi-axes come from the pressure's second moments, a = sqrt(5 <x^2>), which for Hertz's pressure is exact and
averages over the contact. The largest pressure is read from the pressure itself: load over ellipse, 3Q/(2 pi a b),
holds for Hertz's shape only, and a true groove's is another.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lstsq

from fem_check.elements.elastic_body import CondensedBody
from fem_check.independent.contact_problem import QUANTITIES, Array, ContactQuantities
from fem_check.mechanics.contact import ContactSolution

PRESSURE_REACH = 0.5
"""The pressure within this part of each semi-axis from the centre is fitted for its maximum."""
SHEAR_REACH = 0.3
"""Stresses within this part of each semi-axis from the centre are fitted."""
SHEAR_DEPTH = 1.7
"""... and down to this many semi-minor axes."""
MAX_DEGREE = 8


@dataclass(frozen=True)
class Soundness:
    """Self-checks of one contact; each must stay below its limit in `LIMITS`."""

    asymmetry: float
    """Of the flexibility, relative: how far the discrete bodies are from Betti's theorem."""
    force_imbalance: float
    """Of the far faces' reaction and the load, relative: the linear solve and the assembly."""
    penetration: float
    """Left after the active set, over the approach."""
    load_error: float
    """Of the pressure's force and the load, relative."""


# Asymmetry comes from the far field being exact where the mesh is not: 5e-4 at the coarsest mesh of the most slender
# contact, falling with it. The others are rounding, 1e-13; the active set ends only where it leaves no penetration.
LIMITS = Soundness(asymmetry=1e-3, force_imbalance=1e-11, penetration=1e-8, load_error=1e-12)


@dataclass(frozen=True)
class Measured:
    """Quantities of a contact at each position of its edge in the mesh, and their mean."""

    each: dict[str, Array]
    """Quantity to its values, shape (position,)."""
    soundness: Soundness

    @property
    def mean(self) -> ContactQuantities:
        """The result: the mean over all positions."""
        return ContactQuantities(**{name: float(values.mean()) for name, values in self.each.items()})

    def position_uncertainty(self, quantity: str) -> float:
        """How far the mean over every second position is from the mean over all."""
        values = self.each[quantity]
        return float(abs(values[::2].mean() - values.mean()))


def ellipse(solution: ContactSolution) -> tuple[Array, Array]:
    """Semi-axes a and b from the pressure's moments, each of shape (position,); NaN where tension leaves none."""
    basis = solution.basis
    forces = basis.forces @ solution.pressures
    with np.errstate(invalid="ignore"):
        a = solution.unit_lengths * np.sqrt(5.0 * (basis.weighted(lambda x, y: x**2) @ solution.pressures) / forces)
        b = solution.unit_lengths * np.sqrt(5.0 * (basis.weighted(lambda x, y: y**2) @ solution.pressures) / forces)
    return a, b


def largest_pressure(solution: ContactSolution, a: Array, b: Array) -> Array:
    """Largest pressure, at the centre by symmetry, shape (position,) [Pa]."""
    (x, y), area = solution.basis.samples
    pressures = solution.basis.values(x, y) @ solution.pressures
    return np.array(
        [
            central_pressure(x * length / a[case], y * length / b[case], area, pressures[:, case])
            for case, length in enumerate(solution.unit_lengths)
        ]
    )


def central_pressure(x: Array, y: Array, area: Array, pressure: Array) -> float:
    """Pressure at the centre from a smooth fit of a pressure that is even in x and y.

    Hertz's pressure times a quadratic is fitted by least squares, weighted so that samples fade out towards the reach
    of the fit. Hertz's own pressure is of that form; an exact gap changes it by less than 0.01 % where its largest
    pressure is 1 % off Hertz's.

    Args:
        x: over the semi-major axis, shape (sample,).
        y: over the semi-minor axis.
        area: that each sample stands for, any unit.
        pressure: at each sample.
    """
    rho2 = x**2 + y**2
    near = rho2 < PRESSURE_REACH**2
    x2, y2, rho2 = x[near] ** 2, y[near] ** 2, rho2[near]
    weight = np.sqrt(area[near] * (PRESSURE_REACH**2 - rho2))
    table = np.sqrt(1.0 - rho2) * np.stack([np.ones_like(x2), x2, y2])
    return float(lstsq((weight * table).T, weight * pressure[near])[0][0])


def central_shape(x: Array, y: Array, area: Array, pressure: Array) -> tuple[float, float, float]:
    """Of a pressure that is even in y alone, as where the groove is inclined to the contact, near its centre.

    As `central_pressure`, with a part that is odd in x.

    Args:
        x: over the semi-major axis, from the pressure's centre, shape (sample,).
        y: over the semi-minor axis.
        area: that each sample stands for, any unit.
        pressure: at each sample.

    Returns:
        the pressure p at the centre, and s and c of p sqrt(1 - x^2) (1 + s x + c x^2) along the middle.
    """
    rho2 = x**2 + y**2
    near = rho2 < PRESSURE_REACH**2
    x, y2, rho2 = x[near], y[near] ** 2, rho2[near]
    weight = np.sqrt(area[near] * (PRESSURE_REACH**2 - rho2))
    table = np.sqrt(1.0 - rho2) * np.stack([np.ones_like(x), x, x * x, y2])
    middle, slant, bend, _ = lstsq((weight * table).T, weight * pressure[near])[0]
    return float(middle), float(slant / middle), float(bend / middle)


def largest_shear(solution: ContactSolution, body: CondensedBody, a: Array, b: Array) -> tuple[Array, Array]:
    """Largest shear stress on the axis [Pa] and its depth [m], each of shape (position,)."""
    unit_lengths = solution.unit_lengths
    size = body.stress_points
    reach_x = max(SHEAR_REACH * float((a / unit_lengths).max()), 1.01 * solution.basis.lines_x[1])
    reach_y = max(SHEAR_REACH * float((b / unit_lengths).max()), 1.01 * solution.basis.lines_y[1])
    deepest = SHEAR_DEPTH * float((b / unit_lengths).max())
    near = (size[0] < reach_x) & (size[1] < reach_y) & (size[2] < deepest)
    positions = size[:, near]
    stresses = np.einsum("cph,hm->pcm", body.stresses[:3, near], solution.pressures, optimize=True)
    x2, y2, depth = (positions[0] / reach_x) ** 2, (positions[1] / reach_y) ** 2, positions[2]
    degree = min(MAX_DEGREE, max(2, len(np.unique(np.round(depth, 6))) - 3))
    top = float(depth.max())
    profile = np.polynomial.chebyshev.chebvander(2.0 * depth / top - 1.0, degree)
    # Even in x and y by symmetry: the stress off the axis is carried by these and does not bend the profile.
    table = np.concatenate(
        [profile * side[:, None] for side in (np.ones_like(x2), x2, y2, x2 * x2, x2 * y2, y2 * y2)], axis=1
    )
    # One fit in the mesh's own lengths serves all positions. QR with pivoting: the coarsest mesh has fewer columns of
    # points than powers.
    fitted = lstsq(table, stresses.reshape(len(depth), -1), lapack_driver="gelsy")[0][: degree + 1]
    fitted = fitted.reshape(degree + 1, 3, -1)
    largest = np.zeros((2, len(unit_lengths)))
    over_b = np.linspace(0.25, 1.25, 2001)
    for case, length in enumerate(unit_lengths):
        depths = over_b * b[case] / length
        principal = np.polynomial.chebyshev.chebvander(2.0 * depths / top - 1.0, degree) @ fitted[:, :, case]
        shear = 0.5 * (principal.max(axis=1) - principal.min(axis=1))
        best = int(np.clip(np.argmax(shear), 1, len(shear) - 2))
        # The vertex of a parabola through the three largest: the steps alone would leave 0.05 % of the depth.
        left, middle, right = shear[best - 1 : best + 2]
        vertex = over_b[best] + 0.5 * (left - right) / (left - 2.0 * middle + right) * (over_b[1] - over_b[0])
        largest[:, case] = middle, vertex * b[case]
    return largest[0], largest[1]


def measure(solution: ContactSolution, ball: CondensedBody, race: CondensedBody) -> Measured:
    """All quantities of a solved contact; the shear is the race's. Without an ellipse: NaN, but for the approach."""
    a, b = ellipse(solution)
    p0 = shear = depth = np.full(len(a), np.nan)
    if np.isfinite([a, b]).all():
        p0 = largest_pressure(solution, a, b)
        shear, depth = largest_shear(solution, race, a, b)
    force = solution.basis.forces @ solution.pressures
    imbalance = max(float(np.abs(body.reaction @ solution.pressures / force + 1.0).max()) for body in (ball, race))
    each = dict(zip(QUANTITIES, (solution.approaches, a, b, p0, shear, depth), strict=True))
    return Measured(
        each, Soundness(max(ball.asymmetry, race.asymmetry), imbalance, solution.penetration, solution.load_error)
    )
