"""How a ball's inertia loads change beyond the turning of its contact lines, where the case makes them do so.

By the approaches, through the axis under minimum dissipation, whose weight follows the loads; and by the orbit's
radius, where it is the ball's own.
"""

from __future__ import annotations

from numpy import recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.effects.gyroscopic_moment import moment_shares
from qsbearing.model.effects.raceway_control import INNER, MINIMUM_DISSIPATION, weight_slopes
from qsbearing.model.kernel.ball_size import ball_inertia, ball_mass


@kernel
def directional(
    case: recarray,
    work: recarray,
    lines: tuple[float, float, float, float],
    axis: tuple[float, ...],
    diameter: float,
    radius: float,
    dp: float,
    dq: float,
    dradius: float,
) -> tuple[float, float]:
    """d(Fc, Mg/D) for a change of the axis (p, q) and of the orbit's radius, the contact angles fixed.

    Of omega_m = (omega_i b u + omega_o a v)/S, omega_R/|(p, q)| = -Delta a b/(g S) and what follows from them.
    """
    if case.common_motion:
        return 0.0, 0.0
    si, ci, so, co = lines
    p, q, _, _, _, _ = axis
    g = 0.5 * diameter / radius
    dg = -g * dradius / radius
    inner_speed, outer_speed = work.speed_factor * case.inner_speed, work.speed_factor * case.outer_speed
    a, b, u, v = 1.0 + g * co, 1.0 - g * ci, q * co + p * so, q * ci + p * si
    av, bu = a * v, b * u
    dav, dbu = dg * co * v + a * (dq * ci + dp * si), -dg * ci * u + b * (dq * co + dp * so)
    inverse = 1.0 / (av + bu)
    orbit = (inner_speed * bu + outer_speed * av) * inverse
    dorbit = (inner_speed * dbu + outer_speed * dav - orbit * (dav + dbu)) * inverse
    dfc, dmg = 0.0, 0.0
    if case.centrifugal:
        dfc = ball_mass(diameter) * orbit * (2.0 * radius * dorbit + orbit * dradius)
    if case.gyroscopic:
        spin = (outer_speed - inner_speed) * a * b * inverse / g
        dspin = spin * (dg * co / a - dg * ci / b - dg / g - (dav + dbu) * inverse)
        dmg = ball_inertia(diameter) / diameter * (dspin * p * orbit + spin * dp * orbit + spin * p * dorbit)
    return dfc, dmg


@kernel
def weight_changes(
    case: recarray,
    ball: recarray,
    weight: float,
    radius: float,
    lines: tuple[float, float, float, float],
    seen: tuple[float, float, float],
    inner: tuple[float, float, float],
    outer: tuple[float, float, float],
) -> tuple[float, float, float, float, float]:
    """dw by ai, ao, both approaches and the radius; zeros but for minimum dissipation.

    Args:
        seen: derivatives of the seen line's angle by ai, ao and the inner approach.
        inner, outer: of each contact (Q, dQ/d approach, d ln Q/d alpha).
    """
    if ball.control != MINIMUM_DISSIPATION:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    g = 0.5 * ball.diameter / radius
    si, ci, so, co = lines
    seen_by_inner, seen_by_outer, seen_by_approach = seen
    qi, qi_slope, by_inner_angle = inner
    qo, qo_slope, by_outer_angle = outer
    by_seen, by_outer, by_inner_approach, by_outer_approach, by_g = weight_slopes(
        weight, g, si, ci, so, co, qi, qi_slope, qo, qo_slope
    )
    through_load = 4.0 / 3.0 * weight * (1.0 - weight)
    return (
        by_seen * seen_by_inner + through_load * by_inner_angle,
        by_seen * seen_by_outer + by_outer - through_load * by_outer_angle,
        by_seen * seen_by_approach + by_inner_approach,
        by_outer_approach,
        -by_g * g / radius,
    )


@kernel
def axis_by_g(control: int, weight: float) -> float:
    """dq/dg of the ball's axis, p being free of g."""
    if control == MINIMUM_DISSIPATION:
        return 1.0 - 2.0 * weight
    return -1.0 if control == INNER else 1.0


@inlined
def inner_share_slope(case: recarray, ball: recarray) -> float:
    """d lambda_i/dw; what the outer raceway's share loses."""
    if ball.control != MINIMUM_DISSIPATION or not case.gyroscopic:
        return 0.0
    whole, _ = moment_shares(case.shares, True)
    return whole
