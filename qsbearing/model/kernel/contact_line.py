"""One contact of a ball with a groove: from the distance of two centres to force and stiffness.

A contact joins two points, the ball's centre and a groove centre, whose distance is l = (f - 1/2) D when the surfaces
just touch. Where it is longer by delta > 0, the contact pulls the points together with Q = K delta^1.5 along the unit
vector n; where it is shorter there is no load. The length is never clipped, only the load: no contact ever pulls the
bodies themselves together.
"""

from __future__ import annotations

from math import sqrt

from qsbearing.model.compiler.compiled import inlined


@inlined
def inverse_of(distance: float) -> float:
    """1/distance; 0 where the points meet, since a line without direction does not turn."""
    return 1.0 / distance if distance > 0.0 else 0.0


@inlined
def direction(
    length: float, sin_free: float, cos_free: float, v1: float, v2: float
) -> tuple[float, float, float, float]:
    """(approach, n1, n2, 1/distance) of two points displaced by v from their touching position l (sin a0, cos a0).

    The approach comes from |r + v|^2 - l^2 = 2 r.v + v.v, not from a difference of lengths a thousand times larger.
    """
    r1, r2 = length * sin_free, length * cos_free
    x1, x2 = r1 + v1, r2 + v2
    distance = sqrt(x1 * x1 + x2 * x2)
    approach = (2.0 * (r1 * v1 + r2 * v2) + v1 * v1 + v2 * v2) / (distance + length)
    inverse = inverse_of(distance)
    return approach, x1 * inverse, x2 * inverse, inverse


@inlined
def line_displacement(
    length: float, sin_free: float, cos_free: float, n1: float, n2: float, approach: float
) -> tuple[float, float]:
    """The converse: the displacement v of a line of this direction and approach."""
    return length * (n1 - sin_free) + approach * n1, length * (n2 - cos_free) + approach * n2


@inlined
def contact_load(stiffness: float, approach: float) -> tuple[float, float]:
    """Q = K max(delta, 0)^1.5 and dQ/d delta."""
    if approach <= 0.0:
        return 0.0, 0.0
    root = sqrt(approach)
    return stiffness * approach * root, 1.5 * stiffness * root


@inlined
def contact_tangent(
    load: float, load_slope: float, friction_slope: float, n1: float, n2: float, inverse_distance: float
) -> tuple[float, float, float, float]:
    """(H11, H12, H21, H22) of d(Q n - T t)/dv, t = (n2, -n1), T only as far as it grows with Q, by dT/dQ:

    load_slope (n - dT/dQ t) n' + Q/distance t t'.
    """
    turn = load * inverse_distance
    m1, m2 = n1 - friction_slope * n2, n2 + friction_slope * n1
    across = turn * n1 * n2
    return (
        load_slope * m1 * n1 + turn * n2 * n2,
        load_slope * m1 * n2 - across,
        load_slope * m2 * n1 - across,
        load_slope * m2 * n2 + turn * n1 * n1,
    )
