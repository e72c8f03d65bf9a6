"""Contact of half-spaces with any gap, by boundary elements: a reference that shares nothing with the finite elements.

Pressure constant over each rectangle of a regular grid, the gap held at the rectangles' centres, the influence of one
rectangle on another in closed form (Love 1929; Johnson 1985, eq. 3.25), summed by fast Fourier transforms, and solved
by conjugate gradients (I. A. Polonsky and L. M. Keer, Wear 231, 1999). Displacements are measured from infinity.

The grid's own error, about 0.01 %, cancels: each contact is solved with its own gap and, on the same grid, with its
parabola, whose exact solution is Hertz's; of the ratio of the two a coarser grid tells what error is left, 0.001 %. The
largest pressure is that of the central rectangle, so it too comes from the pressure.

For any contact that stays within the half-spaces' linear theory: gap and pressure along the contact's normal. Where the
pressure follows the surface that the bodies share, of slope s across the groove, the half-space between two rectangles
lies along their chord, of slope (s + s')/2; their forces and displacements, along the normals at its two ends, are
inclined to it by half their difference either way. With the influence A of a pressure, B = x^2/r^3 summed as A is, and
e = nu/(1 - nu), the tangential influence along x is A + e B (Cerruti; Johnson 1985, eq. 3.75), and to the second order

    A -> A - (s^2 + s'^2)(1/2 + e)/4 B + s s' (A + (e - 1/2)/2 B).

Left out: what is odd in the curvature, which ball and groove of one material have opposite; the slope along rolling,
whose square is a hundredth of that across.

The torus is inclined to the contact by the contact angle. Its gap is then not even in x, and the ball moves along the
groove until no force acts on it there, which turns the gap about the contact's middle. The largest pressure lies beside
the middle: it is read from a parabola through the three largest along the groove.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy import fft

from fem_check.independent.contact_problem import Array, ContactProblem, ElasticConstants, GapFunction
from fem_check.independent.groove import BallInGroove
from fem_check.independent.references import hertz
from fem_check.mechanics.contact import ContactError

SOURCE = "boundary elements on half-spaces, exact gap (Love 1929; Polonsky and Keer 1999)"
ALONG_NORMALS = "boundary elements on half-spaces, exact gap, pressure along the surface's normal (Love; Cerruti)"
QUANTITIES = ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure")
GRIDS = (45, 65)
"""Rectangles along each side; odd, so that one lies at the centre."""
SEMI_AXIS_SPAN = 2.25
"""Side of the grid in Hertz's semi-axes: room for an ellipse 12 % longer than his."""
POSITIONS = 4
"""Of the contact's edge within a rectangle, over which each result is averaged: without it the error is ragged."""
ACCURACY = 1e-10
"""Change of the pressure in one iteration at which it is converged."""
MAX_ITERATIONS = 1000
BALANCED, MAX_TURNS = 1e-7, 12
"""Force along the groove that is left, over what the same pressure on one side alone would have; secant steps."""


@dataclass(frozen=True)
class BoundaryElementRatios:
    """A contact's quantities over Hertz's."""

    ratio: dict[str, float]
    uncertainty_percent: dict[str, float]
    """The change from the coarser grid."""


@lru_cache(maxsize=256)
def over_hertz(
    groove: BallInGroove, load: float, follows_surface: bool = False, inclined: bool = False, strain: float = 0.0
) -> BoundaryElementRatios:
    """A ball in its groove with the exact gap; about a second.

    Args:
        groove: ball and raceway.
        load: normal load [N].
        follows_surface: pressure along the normals of the surface that the bodies share, not along the contact's axis.
        inclined: the torus as it stands; otherwise with its axis parallel to the tangent plane.
        strain: curvature across the groove that the strain of the whole bodies adds, to the exact gap and to the
            parabola that it is compared with alike [1/m].

    Raises:
        ContactError: the contact fills the grid, or the iteration did not converge.
    """
    problem = groove.problem(load)
    slope = groove.shared_slope if follows_surface else None
    gap = groove.inclined_gap if inclined else groove.gap
    coarse, fine = (_over_parabola(problem, gap, slope, points, inclined, strain) for points in GRIDS)
    return BoundaryElementRatios(fine, {name: 100.0 * abs(fine[name] - coarse[name]) for name in QUANTITIES})


def _over_parabola(
    problem: ContactProblem, gap: GapFunction, slope: GapFunction | None, points: int, turns: bool, strain: float
) -> dict[str, float]:
    true = quantities(problem, lambda x, y: gap(x, y) + 0.5 * strain * x**2, points, slope, turns)
    parabola = _parabola(problem.curvature_x / problem.curvature_y, points, strain / problem.curvature_y)
    return {name: true[name] / parabola[name] for name in QUANTITIES}


@lru_cache(maxsize=64)
def _parabola(curvature_ratio: float, points: int, strain: float) -> dict[str, float]:
    # Hertz's contacts of one shape are similar: a unit one serves every load.
    rigid = ElasticConstants(float("inf"), 0.0)
    unit = ContactProblem("unit", curvature_ratio, 1.0, ElasticConstants(1.0, 0.0), rigid, 1.0)
    return quantities(unit, lambda x, y: unit.parabolic_gap(x, y) + 0.5 * strain * x**2, points)


def quantities(
    problem: ContactProblem, gap: GapFunction, points: int, slope: GapFunction | None = None, turns: bool = False
) -> dict[str, float]:
    """Approach, semi-axes (from the pressure's moments) and largest pressure on one grid, each over Hertz's.

    Args:
        problem: the contact.
        gap: over the tangent plane.
        points: rectangles along each side of the grid.
        slope: of the surface that the pressure follows; None: flat.
        turns: the gap is not even in x, and turns until no force acts along the groove.
    """
    exact = hertz(problem)
    a, b = exact.semi_major_axis, exact.semi_minor_axis
    compliance = problem.ball.compliance + problem.race.compliance
    at_positions = []
    for position in range(POSITIONS):
        # Rectangles per semi-axis, from half a rectangle less to half a rectangle more.
        resolution = points / SEMI_AXIS_SPAN + (position + 0.5) / POSITIONS - 0.5
        index = (np.arange(points) - points // 2) / resolution
        # Lengths over b and pressures over E*.
        at = np.meshgrid(index * a, index * b, indexing="ij")
        heights = np.asarray(gap(*at)) / b
        inclined = None
        if slope is not None:
            poisson = (
                problem.ball.poisson_ratio * problem.ball.compliance
                + problem.race.poisson_ratio * problem.race.compliance
            )
            inclined = (np.asarray(slope(*at)), poisson / compliance)
        sides = (a / b / resolution, 1.0 / resolution)
        hertzian = np.sqrt(np.maximum(1.0 - index[:, None] ** 2 - index**2, 0.0))
        force = problem.load * compliance / b**2
        if turns:
            along = np.broadcast_to(index[:, None], heights.shape) if inclined is None else inclined[0]
            pressure, approach = balanced(heights, force, sides, along, inclined, hertzian)
        else:
            pressure, approach = solve(heights, force, sides, inclined, hertzian)
        share = pressure / pressure.sum()
        # The slope balances the forces, not the moments: the middle of the pressure need not lie at 0.
        across = index - share.sum(axis=1) @ index
        at_positions.append(
            (
                approach * b / exact.approach,
                np.sqrt(5.0 * (share.sum(axis=1) @ across**2)),
                np.sqrt(5.0 * (share.sum(axis=0) @ index**2)),
                _largest(pressure[:, points // 2]) / compliance / exact.max_pressure,
            )
        )
    return dict(zip(QUANTITIES, (float(mean) for mean in np.mean(at_positions, axis=0)), strict=True))


def _largest(pressure: Array) -> float:
    """Of a smooth row of values, the vertex of the parabola through the three largest."""
    middle = int(np.argmax(pressure))
    left, top, right = pressure[middle - 1 : middle + 2]
    return float(top - 0.125 * (left - right) ** 2 / (left - 2.0 * top + right))


def balanced(
    gap: Array,
    load: float,
    spacing: tuple[float, float],
    along: Array,
    inclined: tuple[Array, float] | None = None,
    start: Array | float = 1.0,
) -> tuple[Array, float]:
    """The same as `solve`, of a body that moves along the groove until no force acts on it there.

    Args:
        along: force along the groove per pressure at each rectangle, and so by how much that motion closes the gap.

    Raises:
        ContactError: the motion is not found.
    """
    pressure, approach = solve(gap, load, spacing, inclined, start)
    turns, forces = [0.0], [float((along * pressure).sum() / (np.abs(along) * pressure).sum())]
    while abs(forces[-1]) > BALANCED:
        if len(turns) == MAX_TURNS:
            raise ContactError(f"the boundary elements are not balanced along the groove in {MAX_TURNS} steps")
        # The force answers the turn about as the approach over the slope at the contact's end does.
        step = approach / np.abs(along[pressure > 0.0]).max() if len(turns) == 1 else 0.0
        if len(turns) > 1:
            step = -(turns[-1] - turns[-2]) / (forces[-1] - forces[-2])
        turns.append(turns[-1] + step * forces[-1])
        pressure, approach = solve(gap + turns[-1] * along, load, spacing, inclined, pressure)
        forces.append(float((along * pressure).sum() / (np.abs(along) * pressure).sum()))
    return pressure, approach


def solve(
    gap: Array,
    load: float,
    spacing: tuple[float, float],
    inclined: tuple[Array, float] | None = None,
    start: Array | float = 1.0,
) -> tuple[Array, float]:
    """Pressure and approach of a contact with E* = 1.

    Args:
        gap: at the rectangles' centres, shape (x, y).
        load: sum of pressure times area.
        spacing: sides of a rectangle.
        inclined: slope of the surface at the rectangles' centres along x, and Poisson's ratio; None: flat.
        start: pressure to begin with, over any other.

    Returns:
        pressure, shape (x, y), and the approach.
    """
    # Twice the grid: the transform's periodic images must not reach it.
    shape = [fft.next_fast_len(2 * count - 1, real=True) for count in gap.shape]
    offsets = [np.fft.fftfreq(count, 1.0 / count) for count in shape]
    at = offsets[0][:, None] * spacing[0], offsets[1] * spacing[1]
    direct = fft.rfft2(normal_influence(*at, *spacing))

    def forward(values: Array) -> Array:
        return np.asarray(fft.rfft2(values, s=shape))

    def back(values: Array) -> Array:
        return np.asarray(fft.irfft2(values, s=shape)[: gap.shape[0], : gap.shape[1]])

    if inclined is None:

        def displacement(pressure: Array) -> Array:
            return back(direct * forward(pressure))

    else:
        slope, poisson_ratio = inclined
        e = poisson_ratio / (1.0 - poisson_ratio)
        along = fft.rfft2(lengthwise_influence(*at, *spacing))
        square, shared = -0.25 * (0.5 + e) * along, direct + 0.5 * (e - 0.5) * along

        def displacement(pressure: Array) -> Array:
            spread = forward(pressure)
            return (
                back(direct * spread + square * forward(slope**2 * pressure))
                + slope**2 * back(square * spread)
                + slope * back(shared * forward(slope * pressure))
            )

    total = load / (spacing[0] * spacing[1])
    pressure = start + np.zeros(gap.shape)
    pressure *= total / pressure.sum()
    direction = np.zeros(gap.shape)
    last_norm, keep = 1.0, 0.0
    for _ in range(MAX_ITERATIONS):
        loaded = pressure > 0.0
        residual = displacement(pressure) + gap
        residual -= residual[loaded].mean()
        norm = float((residual[loaded] ** 2).sum())
        direction = np.where(loaded, residual + keep * norm / last_norm * direction, 0.0)
        last_norm = norm
        curved = displacement(direction)
        curved -= curved[loaded].mean()
        step = float((residual * direction)[loaded].sum() / (curved * direction)[loaded].sum())
        previous = pressure
        pressure = np.maximum(pressure - step * direction, 0.0)
        # Where the bodies overlap outside the contact it grows, and the directions start anew.
        overlap = (pressure == 0.0) & (residual < 0.0)
        keep = 0.0 if overlap.any() else 1.0
        pressure = np.where(overlap, -step * residual, pressure)
        pressure *= total / pressure.sum()
        if np.abs(pressure - previous).sum() < ACCURACY * total:
            break
    else:
        raise ContactError(f"the boundary elements did not converge in {MAX_ITERATIONS} iterations")
    if any(edge.any() for edge in (pressure[0], pressure[-1], pressure[:, 0], pressure[:, -1])):
        raise ContactError("the contact fills the boundary elements' grid: its gap is too far from its parabola")
    return pressure, float(((displacement(pressure) + gap) * pressure).sum() / total)


def normal_influence(x: Array, y: Array, width: float | Array, height: float) -> Array:
    """Displacement at (x, y) of a half-space of E* = 1 under unit pressure on a rectangle about the origin."""
    return _over_rectangle(
        lambda u, v: u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v)), x, y, width, height
    )


def lengthwise_influence(x: Array, y: Array, width: float, height: float) -> Array:
    """x^2/(pi r^3) integrated over a rectangle about the origin."""
    return _over_rectangle(lambda u, v: v * np.arcsinh(u / np.abs(v)), x, y, width, height)


def _over_rectangle(
    corner: Callable[[Array, Array], Array], x: Array, y: Array, width: float | Array, height: float
) -> Array:
    left, right, low, high = x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height
    return (corner(right, high) - corner(left, high) - corner(right, low) + corner(left, low)) / np.pi
