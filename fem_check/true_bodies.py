"""The true bodies: half a ball between two opposite contacts, and a block of raceway under the true groove.

Conventions, on which the approach depends. The ball's reference is its equator, the plane through its centre normal to
the contact: half a ball is supported there by a plane of symmetry, as between two equal and opposite contacts, its
sides free. The raceway's reference is infinity: a block of 0.9 ball radii each way, whose far faces move as a half-
space's would. Gap and pressure count along the contact's normal, as in Hertz's and the boundary elements' linear
problem, so that what differs is the bodies alone. A pressure that turns with the surface is a second-order effect,
looked at apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
from scipy.optimize import brentq
from skfem import MeshHex

from fem_check import elastic_body, meshing
from fem_check.contact_problem import Array
from fem_check.elastic_body import CondensedBody, Progress, Support, silent
from fem_check.groove import BallInGroove
from fem_check.pressure_basis import PressureBasis

BLOCK = 0.9
"""Half-width and depth of the raceway's block, in ball radii: 10 mm for B218."""
BALL_SURFACE_ORDER = 9
"""Quadrature on the ball's contact: its facets do not match the cells of the pressure basis, whose kinks fall inside
them."""


@dataclass(frozen=True)
class TrueBodies:
    """Both bodies, and the flat half-space on the raceway's own mesh, all under the same pressure basis."""

    ball: CondensedBody
    race: CondensedBody
    half_space: CondensedBody
    basis: PressureBasis
    unit_length: float
    """[m]"""


def graded(values: Array, near: float, near_size: float, elements: int, far: float, element: float) -> Array:
    """Brick coordinate to body coordinate: the contact part scaled, the far part grown smoothly to the body's size.

    Args:
        values: brick coordinates, the contact part up to `near`, the far part from there over a length of 1.
        near_size: length of the contact part in the body.
        elements: number of elements in the far part.
        far: size of the body.
        element: size in the body of the contact part's last element, with which the far part begins.
    """
    rest = far - near_size

    def misfit(growth: float) -> float:
        return float(element * elements * (np.expm1(growth) / growth if growth else 1.0) - rest)

    # Elements may have to shrink outwards too, where the contact is large in its body.
    growth = brentq(misfit, -50.0, 60.0) or 1e-9
    part = np.clip(values - near, 0.0, None)
    return np.where(
        values <= near, values * near_size / near, near_size + element * elements / growth * np.expm1(growth * part)
    )


def condensed_bodies(
    groove: BallInGroove,
    a: float,
    b: float,
    elements: int,
    progress: Progress = silent,
    *,
    pressure_turns: bool = False,
) -> TrueBodies:
    """Condense ball and raceway for a contact of about the given semi-axes [m].

    Args:
        pressure_turns: let the pressure act along the normal of the surface that the deformed bodies share, not along
            the contact's normal.
    """
    recipe = meshing.finite_body(elements)
    brick = meshing.load(recipe)
    radius = groove.ball_radius / b
    race_brick = _sized(brick, recipe, a / b, (BLOCK * radius,) * 3)
    basis = _pressure_basis(race_brick, recipe, a / b)

    def race_shape(points: Array) -> Array:
        height = groove.race_height(points[0] * b, points[1] * b) / b
        return np.stack([points[0], points[1], points[2] + height * (1.0 - points[2] / (BLOCK * radius))])

    # The deformed bodies share one surface: each gives way by its share of the compliance, so that surface lies between
    # the undeformed two, and with it the normal along which the pressure acts on both.
    share = groove.ball.compliance / (groove.ball.compliance + groove.race.compliance)

    def common_slope(x: Array, y: Array) -> tuple[Array, Array]:
        ball_x, ball_y = groove.ball_slope(x * b, y * b)
        race_x, race_y = groove.race_slope(x * b, y * b)
        return (1.0 - share) * ball_x + share * race_x, (1.0 - share) * ball_y + share * race_y

    # Half the side of a cube inflated to the ball: near the pole, x on the ball is x of this brick.
    side = radius / sqrt(2.0)
    ball_brick = _sized(brick, recipe, a / b, (side, side, radius))

    def ball_shape(points: Array) -> Array:
        return inflated(points[0] / side, points[1] / side, 1.0 - points[2] / radius) * radius

    def slope_into_ball(x: Array, y: Array) -> tuple[Array, Array]:
        # The ball's own z points into it, away from the raceway.
        slope_x, slope_y = common_slope(x, y)
        return -slope_x, -slope_y

    return TrueBodies(
        ball=elastic_body.condense(
            ball_brick,
            basis,
            groove.ball.poisson_ratio,
            Support.SYMMETRY_PLANE,
            ball_shape,
            slope_into_ball if pressure_turns else None,
            progress,
            surface_order=BALL_SURFACE_ORDER,
        ),
        race=elastic_body.condense(
            race_brick,
            basis,
            groove.race.poisson_ratio,
            Support.HALF_SPACE,
            race_shape,
            common_slope if pressure_turns else None,
            progress,
        ),
        half_space=elastic_body.condense(
            race_brick, basis, groove.race.poisson_ratio, Support.HALF_SPACE, progress=progress
        ),
        basis=basis,
        unit_length=b,
    )


def inflated(xi: Array, eta: Array, zeta: Array) -> Array:
    """A cube's octant blown up to a ball's, shape (3, point): pole at zeta = 1, depth counted from it along z.

    The classical mapping x = xi sqrt(1 - eta^2/2 - zeta^2/2 + eta^2 zeta^2/3) and its cyclic kin: the cube's faces go
    to the sphere, its planes of symmetry to themselves.
    """
    x2, y2, z2 = xi * xi, eta * eta, zeta * zeta
    return np.stack(
        [
            xi * np.sqrt(1.0 - y2 / 2.0 - z2 / 2.0 + y2 * z2 / 3.0),
            eta * np.sqrt(1.0 - z2 / 2.0 - x2 / 2.0 + z2 * x2 / 3.0),
            1.0 - zeta * np.sqrt(1.0 - x2 / 2.0 - y2 / 2.0 + x2 * y2 / 3.0),
        ]
    )


def _sized(brick: MeshHex, recipe: meshing.Recipe, ellipticity: float, size: tuple[float, ...]) -> MeshHex:
    """The brick, graded to a body of `size`; lengths in units of b."""
    points = np.empty_like(brick.p)
    for axis, (segments, scale) in enumerate(zip((recipe.x, recipe.y, recipe.z), (ellipticity, 1.0, 1.0), strict=True)):
        near, far = segments
        points[axis] = graded(
            brick.p[axis],
            near.length,
            near.length * scale,
            far.elements,
            size[axis],
            near.length * scale / near.elements,
        )
    return MeshHex(points, brick.t, _boundaries=brick.boundaries, sort_t=False)


def _pressure_basis(brick: MeshHex, recipe: meshing.Recipe, ellipticity: float) -> PressureBasis:
    every = elastic_body.pressure_basis_of(brick)
    reach = recipe.x[0].length * (1.0 + 1e-6)
    return PressureBasis(every.lines_x[every.lines_x <= reach * ellipticity], every.lines_y[every.lines_y <= reach])
