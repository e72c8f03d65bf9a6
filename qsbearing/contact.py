"""One contact of a ball with a groove: from the distance of two centres to force and stiffness.

A contact joins two points, the ball's centre and a groove centre, whose distance is l = (f - 1/2) D when the surfaces
just touch. Where it is longer by delta > 0, the contact pulls the points together with Q = K delta^1.5 along the unit
vector n; where it is shorter there is no load. The length is never clipped, only the load: no contact ever pulls the
bodies themselves together.
"""

from __future__ import annotations

from math import sqrt

from qsbearing.compiled import kernel


@kernel
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
    inverse = 1.0 / distance if distance > 0.0 else 0.0
    return approach, x1 * inverse, x2 * inverse, inverse


@kernel
def contact_load(stiffness: float, approach: float) -> tuple[float, float]:
    """Q = K max(delta, 0)^1.5 and dQ/d delta."""
    if approach <= 0.0:
        return 0.0, 0.0
    root = sqrt(approach)
    return stiffness * approach * root, 1.5 * stiffness * root


@kernel
def contact_tangent(
    load: float, load_slope: float, n1: float, n2: float, inverse_distance: float
) -> tuple[float, float, float]:
    """(H11, H12, H22) of d(Q n)/dv: load_slope n n' + Q/distance t t', with t = (n2, -n1)."""
    turn = load * inverse_distance
    return (
        load_slope * n1 * n1 + turn * n2 * n2,
        (load_slope - turn) * n1 * n2,
        load_slope * n2 * n2 + turn * n1 * n1,
    )
