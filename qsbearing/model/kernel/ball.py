"""One ball: the forces on it, the residual of its equilibrium, and both condensed to the ring.

In the ball's own plane, axial and radial: X is its centre from the outer groove centre, W = A - X the inner groove
centre from the ball. With n = (sin a, cos a) along a contact, t = (cos a, -sin a) across it and T = lambda Mg/D the
friction that carries the gyroscopic moment, equations (19.9) and (19.10) are the two components of

    r = Qi ni - Qo no + f = 0,      f = -Ti ti + To to + Fc (0, 1),

and the ball's force on the inner ring is h = Qi ni - Ti ti (19.13, 19.14 with the sign that action and reaction
demand; the source prints a minus in 19.14), with a moment about the groove centre, where the friction acts at the
groove's radius: h3 = lever h1 + fi D Ti (the last term is missing in 19.15).
"""

from __future__ import annotations

from typing import NamedTuple

from numpy import recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.contact.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.model.effects.gyroscopic_moment import carried_friction
from qsbearing.model.effects.raceway_control import MINIMUM_DISSIPATION
from qsbearing.model.kernel.ball_inertia import (
    ball_axis,
    control_of,
    control_weight,
    friction_shares,
    is_moving,
    is_rolled,
    motion_loads,
    orbit_radius,
    rolling_line,
)
from qsbearing.model.kernel.contact_line import contact_load, contact_tangent, inverse_of, line_displacement
from qsbearing.model.kernel.inertia_slopes import axis_by_g, directional, inner_share_slope, weight_changes
from qsbearing.model.kernel.loop_closure import (
    ball_displacement,
    closure_residual,
    inner_closure,
    inner_length,
    outer_length,
    whole_length,
)
from qsbearing.model.kernel.raceway_stiffness import groove_stiffness, series_stiffness

# A ball whose inner load is below this many centrifugal forces: its inertia says where it lies, not the ring. A choice:
# it says only whether the ball may shorten the ring's step.
INERTIA_DOMINATES = 3.0


class Evaluated(NamedTuple):
    """A ball evaluated where it is, its own unknowns eliminated."""

    imbalance: float  # the force that the residual of loop closure hides included
    load: float  # the larger of its contacts'
    lighter: float  # the smaller of them; a contact without load is none
    fc: float
    friction: float  # |Mg|/D as far as it is carried
    r1: float
    r2: float
    h1: float
    h2: float
    h3: float
    c1: float  # h after the ball's own step
    c2: float
    c3: float
    k11: float  # the stiffness of c
    k12: float
    k21: float
    k22: float
    k31: float
    k32: float
    y1: float
    y2: float
    y11: float
    y12: float
    y21: float
    y22: float
    outer_force: float  # of elastic rings
    outer_condensed: float
    outer_stiffness_1: float
    outer_stiffness_2: float
    follows_inertia: bool
    outer_inverse: float
    inner_inverse: float
    closure1: float
    closure2: float


@kernel
def moving_ball(
    case: recarray, work: recarray, ball: recarray, a1: float, a2: float
) -> tuple[float, float, float, float, float]:
    """Evaluate one ball where it is, and eliminate its own unknowns into its record.

    Returns:
        imbalance, load, lighter, fc and friction of `Evaluated`.
    """
    terms = evaluated(case, work, ball, rolling_line(case, ball), a1, a2)
    ball.imbalance[0], ball.imbalance[1] = terms.r1, terms.r2
    ball.force[0], ball.force[1], ball.force[2] = terms.h1, terms.h2, terms.h3
    ball.condensed[0], ball.condensed[1], ball.condensed[2] = terms.c1, terms.c2, terms.c3
    ball.stiffness[0, 0], ball.stiffness[0, 1] = terms.k11, terms.k12
    ball.stiffness[1, 0], ball.stiffness[1, 1] = terms.k21, terms.k22
    ball.stiffness[2, 0], ball.stiffness[2, 1] = terms.k31, terms.k32
    ball.y1, ball.y2, ball.y11, ball.y12, ball.y21, ball.y22 = (
        terms.y1, terms.y2, terms.y11, terms.y12, terms.y21, terms.y22,
    )  # fmt: skip
    if case.elastic_rings:
        ball.outer_force, ball.outer_condensed = terms.outer_force, terms.outer_condensed
        ball.outer_stiffness_1, ball.outer_stiffness_2 = terms.outer_stiffness_1, terms.outer_stiffness_2
    ball.follows_inertia = terms.follows_inertia
    ball.outer_inverse, ball.inner_inverse = terms.outer_inverse, terms.inner_inverse
    ball.closure1, ball.closure2 = terms.closure1, terms.closure2
    return terms.imbalance, terms.load, terms.lighter, terms.fc, terms.friction


@inlined
def evaluated(
    case: recarray,
    work: recarray,
    ball: recarray,
    seen: tuple[float, float, float, float, float],
    a1: float,
    a2: float,
) -> Evaluated:
    """The equations of one ball where it is, condensed; nothing is written.

    Args:
        seen: the inner contact line as rolling sees it, of `rolling_line`.
        a1, a2: displacement of the inner groove centre from touching at the free angle.
    """
    li, lo, diameter = inner_length(case, ball), outer_length(case, ball), ball.diameter
    so, co, delta_o = ball.outer_sine, ball.outer_cosine, ball.outer_approach
    si, ci, delta_i = ball.inner_sine, ball.inner_cosine, ball.inner_approach
    inverse_o, inverse_i = inverse_of(lo + delta_o), inverse_of(li + delta_i)
    u1, u2 = ball_displacement(case, ball)
    v1, v2 = line_displacement(li, case.sin_free, case.cos_free, si, ci, delta_i)
    closure1, closure2 = closure_residual(li + lo, a1, a2, u1 + v1, u2 + v2)
    ki, ki_slope = groove_stiffness(case, ball, INNER_SIDE, si, ci)
    ko, ko_slope = groove_stiffness(case, ball, OUTER_SIDE, so, co)
    qi, qi_slope = contact_load(ki, delta_i)
    qo, qo_slope = contact_load(ko, delta_o)
    s_seen, c_seen, by_inner, by_outer, by_approach = seen
    radius = orbit_radius(case, ball)
    weight = control_weight(ball, radius, c_seen, co, qi, qo)
    axis = ball_axis(case, ball, weight, radius, s_seen, c_seen, so, co)
    fc, fc_s, fc_o, mg, mg_s, mg_o = motion_loads(case, work, axis, diameter, radius, s_seen, c_seen, so, co)
    fc_i, fc_o = fc_s * by_inner, fc_o + fc_s * by_outer
    mg_i, mg_o = mg_s * by_inner, mg_o + mg_s * by_outer
    share_i, share_o = friction_shares(case, control_of(case, ball), weight)
    share_w = inner_share_slope(case, ball)
    if not is_rolled(ball):
        share_i, share_o, share_w = 0.0, 0.0, 0.0
    ti, ti_m, ti_s, ti_q = carried_friction(share_i, mg, qi, work.friction_bound)
    to, to_m, to_s, to_q = carried_friction(share_o, mg, qo, work.friction_bound)
    ti_w, to_w = ti_s * share_w, -to_s * share_w
    fc_w, mg_w, w_di, w_do, w_r = 0.0, 0.0, 0.0, 0.0, 0.0
    if ball.control == MINIMUM_DISSIPATION:  # the axis, and the shares with it, follow the loads
        lines = (s_seen, c_seen, so, co)
        fc_w, mg_w = directional(
            case, work, lines, axis, diameter, radius, s_seen - so, c_seen - co - diameter / radius, 0.0
        )
        w_i, w_o, w_di, w_do, w_r = weight_changes(
            case, ball, weight, radius, lines, (by_inner, by_outer, by_approach), (qi, qi_slope, ki_slope),
            (qo, qo_slope, ko_slope),
        )  # fmt: skip
        fc_i, fc_o, mg_i, mg_o = fc_i + fc_w * w_i, fc_o + fc_w * w_o, mg_i + mg_w * w_i, mg_o + mg_w * w_o
        ti_i, ti_o = ti_m * mg_i + ti_w * w_i, ti_m * mg_o + ti_w * w_o
        to_i, to_o = to_m * mg_i + to_w * w_i, to_m * mg_o + to_w * w_o
    else:
        ti_i, ti_o, to_i, to_o = ti_m * mg_i, ti_m * mg_o, to_m * mg_i, to_m * mg_o

    r1 = qi * si - qo * so - ti * ci + to * co
    r2 = qi * ci - qo * co + ti * si - to * so + fc
    h1 = qi * si - ti * ci
    h2 = qi * ci + ti * si
    h3 = case.tilt_lever * h1 + case.inner_coefficient * ti

    # d alpha = e . dv with e = t/distance
    ei1, ei2 = ci * inverse_i, -si * inverse_i
    eo1, eo2 = co * inverse_o, -so * inverse_o
    hi11, hi12, hi21, hi22 = contact_tangent(qi, qi_slope, ti_q, si, ci, inverse_i)
    ho11, ho12, ho21, ho22 = contact_tangent(qo, qo_slope, to_q, so, co, inverse_o)
    # Derivatives by the two angles of everything but the contacts' own turning, which the tangents hold.
    qi_a = qi * ki_slope
    qo_a = qo * ko_slope
    ti_i, to_o = ti_i + ti_q * qi_a, to_o + to_q * qo_a
    h1_i = qi_a * si - ti_i * ci + ti * si
    h2_i = qi_a * ci + ti_i * si + ti * ci
    h1_o, h2_o = -ti_o * ci, ti_o * si
    r1_i, r2_i = h1_i + to_i * co, h2_i - to_i * so + fc_i
    r1_o = h1_o - qo_a * so + to_o * co - to * so
    r2_o = h2_o - qo_a * co - to_o * so - to * co + fc_o

    # By A (through ai, and the inner approach where speeds follow it), then by X (through -W, and ao).
    fi = case.inner_coefficient
    ra11, ra12 = hi11 + r1_i * ei1, hi12 + r1_i * ei2
    ra21, ra22 = hi21 + r2_i * ei1, hi22 + r2_i * ei2
    ha11, ha12 = hi11 + h1_i * ei1, hi12 + h1_i * ei2
    ha21, ha22 = hi21 + h2_i * ei1, hi22 + h2_i * ei2
    ma1, ma2 = fi * (ti_i * ei1 + ti_q * qi_slope * si), fi * (ti_i * ei2 + ti_q * qi_slope * ci)
    fc_a, fc_x, fc_r = 0.0, 0.0, 0.0
    if by_approach != 0.0 or w_di != 0.0:
        fc_d, mg_d = fc_s * by_approach + fc_w * w_di, mg_s * by_approach + mg_w * w_di
        ti_d, to_d = ti_m * mg_d + ti_w * w_di, to_m * mg_d + to_w * w_di
        h1_d, h2_d = -ti_d * ci, ti_d * si
        r1_d, r2_d = h1_d + to_d * co, h2_d - to_d * so + fc_d
        ra11, ra12, ra21, ra22 = ra11 + r1_d * si, ra12 + r1_d * ci, ra21 + r2_d * si, ra22 + r2_d * ci
        ha11, ha12, ha21, ha22 = ha11 + h1_d * si, ha12 + h1_d * ci, ha21 + h2_d * si, ha22 + h2_d * ci
        ma1, ma2 = ma1 + fi * ti_d * si, ma2 + fi * ti_d * ci
        fc_a = fc_d
    rx11, rx12 = -ra11 - ho11 + r1_o * eo1 - work.regularisation, -ra12 - ho12 + r1_o * eo2
    rx21, rx22 = -ra21 - ho21 + r2_o * eo1, -ra22 - ho22 + r2_o * eo2 - work.regularisation
    hx11, hx12 = -ha11 + h1_o * eo1, -ha12 + h1_o * eo2
    hx21, hx22 = -ha21 + h2_o * eo1, -ha22 + h2_o * eo2
    mx1, mx2 = -ma1 + fi * ti_o * eo1, -ma2 + fi * ti_o * eo2
    if w_do != 0.0:  # by the outer approach, which X changes along the outer line
        ti_d, to_d = ti_m * mg_w * w_do + ti_w * w_do, to_m * mg_w * w_do + to_w * w_do
        h1_d, h2_d = -ti_d * ci, ti_d * si
        r1_d, r2_d = h1_d + to_d * co, h2_d - to_d * so + fc_w * w_do
        rx11, rx12, rx21, rx22 = rx11 + r1_d * so, rx12 + r1_d * co, rx21 + r2_d * so, rx22 + r2_d * co
        hx11, hx12, hx21, hx22 = hx11 + h1_d * so, hx12 + h1_d * co, hx21 + h2_d * so, hx22 + h2_d * co
        mx1, mx2 = mx1 + fi * ti_d * so, mx2 + fi * ti_d * co
        fc_x = fc_w * w_do
    if case.displaced_orbit:  # by the radius, which X2 changes
        dq = -axis_by_g(control_of(case, ball), weight) * 0.5 * diameter / (radius * radius)
        fc_d, mg_d = directional(case, work, (s_seen, c_seen, so, co), axis, diameter, radius, 0.0, dq, 1.0)
        fc_d, mg_d = fc_d + fc_w * w_r, mg_d + mg_w * w_r
        ti_d, to_d = ti_m * mg_d + ti_w * w_r, to_m * mg_d + to_w * w_r
        h1_d, h2_d = -ti_d * ci, ti_d * si
        rx12, rx22 = rx12 + h1_d + to_d * co, rx22 + h2_d - to_d * so + fc_d
        hx12, hx22, mx2 = hx12 + h1_d, hx22 + h2_d, mx2 + fi * ti_d
        fc_r = fc_d

    # Where rounding leaves no stiffness across its line (an approach below that of a position), the ball keeps still.
    determinant = rx11 * rx22 - rx12 * rx21
    inverse = 1.0 / determinant if determinant != 0.0 else 0.0
    # What closing the loop at the inner line would change counts as imbalance.
    p1, p2 = r1 + ra11 * closure1 + ra12 * closure2, r2 + ra21 * closure1 + ra22 * closure2
    y1, y2 = (rx22 * p1 - rx12 * p2) * inverse, (rx11 * p2 - rx21 * p1) * inverse
    y11, y12 = (rx22 * ra11 - rx12 * ra21) * inverse, (rx22 * ra12 - rx12 * ra22) * inverse
    y21, y22 = (rx11 * ra21 - rx21 * ra11) * inverse, (rx11 * ra22 - rx21 * ra12) * inverse

    lever = case.tilt_lever
    k11, k12 = ha11 - hx11 * y11 - hx12 * y21, ha12 - hx11 * y12 - hx12 * y22
    k21, k22 = ha21 - hx21 * y11 - hx22 * y21, ha22 - hx21 * y12 - hx22 * y22
    k31, k32 = lever * k11 + ma1 - mx1 * y11 - mx2 * y21, lever * k12 + ma2 - mx1 * y12 - mx2 * y22
    c1 = h1 + ha11 * closure1 + ha12 * closure2 - hx11 * y1 - hx12 * y2
    c2 = h2 + ha21 * closure1 + ha22 * closure2 - hx21 * y1 - hx22 * y2
    c3 = lever * c1 + fi * ti + ma1 * closure1 + ma2 * closure2 - mx1 * y1 - mx2 * y2
    on_outer, on_outer_condensed, on_outer_1, on_outer_2 = 0.0, 0.0, 0.0, 0.0
    if case.elastic_rings:  # Qo cos ao + To sin ao = h2 + Fc, since the ball's own step leaves r2 = 0
        fa1, fa2 = fc_i * ei1 + fc_a * si, fc_i * ei2 + fc_a * ci
        fx1, fx2 = fc_o * eo1 + fc_x * so - fa1, fc_o * eo2 + fc_x * co + fc_r - fa2
        on_outer = qo * co + to * so
        on_outer_condensed = c2 + fc + fa1 * closure1 + fa2 * closure2 - fx1 * y1 - fx2 * y2
        on_outer_1 = k21 + fa1 - fx1 * y11 - fx2 * y21
        on_outer_2 = k22 + fa2 - fx1 * y12 - fx2 * y22
    open_force = max(qi_slope, qi * inverse_i) * max(abs(closure1), abs(closure2))
    lighter = min(qi, qo) if qi > 0.0 and qo > 0.0 else max(qi, qo)
    friction = min(abs(mg), max(abs(ti), abs(to)))
    return Evaluated(
        max(abs(r1), abs(r2)) + open_force, max(qi, qo), lighter, fc, friction, r1, r2, h1, h2, h3, c1, c2, c3,
        k11, k12, k21, k22, k31, k32, y1, y2, y11, y12, y21, y22, on_outer, on_outer_condensed, on_outer_1, on_outer_2,
        qi <= INERTIA_DOMINATES * fc, inverse_o, inverse_i, closure1, closure2,
    )  # fmt: skip


@kernel
def resting_ball(case: recarray, ball: recarray, a1: float, a2: float) -> tuple[float, float]:
    """One ball at rest between its grooves, springs in series: one contact line from groove centre to groove centre.

    Fills its record; returns (the force that the residual of loop closure hides, its load).
    """
    length = whole_length(case, ball)
    n1, n2, approach = ball.inner_sine, ball.inner_cosine, ball.inner_approach
    inverse = inverse_of(length + approach)
    closure1, closure2 = inner_closure(case, ball, length, a1, a2)
    stiffness, slope = series_stiffness(case, ball, n1, n2)
    load, load_slope = contact_load(stiffness, approach)
    k11, k12, _, k22 = contact_tangent(load, load_slope, 0.0, n1, n2, inverse)
    turn = load * slope * inverse  # of the stiffness with the contact angle
    k11, k12, k21, k22 = k11 + turn * n1 * n2, k12 - turn * n1 * n1, k12 + turn * n2 * n2, k22 - turn * n2 * n1
    lever = case.tilt_lever
    ball.force[0], ball.force[1], ball.force[2] = load * n1, load * n2, lever * load * n1
    ball.stiffness[0, 0], ball.stiffness[0, 1] = k11, k12
    ball.stiffness[1, 0], ball.stiffness[1, 1] = k21, k22
    ball.stiffness[2, 0], ball.stiffness[2, 1] = lever * k11, lever * k12
    for row in range(3):
        ball.condensed[row] = ball.force[row] + ball.stiffness[row, 0] * closure1 + ball.stiffness[row, 1] * closure2
    if case.elastic_rings:
        ball.outer_force, ball.outer_condensed = ball.force[1], ball.condensed[1]
        ball.outer_stiffness_1, ball.outer_stiffness_2 = k21, k22
    ball.inner_inverse = inverse
    ball.closure1, ball.closure2 = closure1, closure2
    ball.follows_inertia = load == 0.0
    return max(load_slope, load * inverse) * max(abs(closure1), abs(closure2)), load


@kernel
def evaluate_ball(case: recarray, work: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Fill the record of a ball that lies between its two contacts, moving or at rest."""
    if is_moving(case):
        moving_ball(case, work, ball, a1, a2)
        return
    inner_approach = ball.inner_approach
    ball.inner_approach += ball.outer_approach
    resting_ball(case, ball, a1, a2)
    ball.inner_approach = inner_approach
