"""One moving ball: the forces on it, the residual of its equilibrium, and both condensed to the ring.

In the ball's own plane, axial and radial: X is its centre from the outer groove centre, W = A - X the inner groove
centre from the ball. With n = (sin a, cos a) along a contact, t = (cos a, -sin a) across it and T = lambda Mg/D the
friction that carries the gyroscopic moment, equations (19.9) and (19.10) are the two components of

    r = Qi ni - Qo no + f = 0,      f = -Ti ti + To to + Fc (0, 1),

and the ball's force on the inner ring is h = Qi ni - Ti ti (19.13, 19.14 with the sign that action and reaction
demand; the source prints a minus in 19.14), with a moment about the groove centre, where the friction acts at the
groove's radius: h3 = lever h1 + fi D Ti (the last term is missing in 19.15).
"""

from __future__ import annotations

from math import sqrt

from numpy import recarray

from qsbearing.case import BALL_INERTIA, BALL_MASS
from qsbearing.compiled import kernel
from qsbearing.contact import contact_load, contact_tangent, direction
from qsbearing.effects.centrifugal_force import centrifugal_force
from qsbearing.effects.gyroscopic_moment import gyroscopic_moment, moment_shares
from qsbearing.hertz import (
    INNER_SIDE,
    OUTER_SIDE,
    ellipse_constants,
    rolling_curvature,
    stiffness_at_angle,
    transverse_curvature,
)
from qsbearing.kinematics import inner_line, orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.raceway_control import INNER, rotation_axis

# A ball whose inner load is below this many centrifugal forces: where it lies its own inertia says, not the ring.
IDLE = 3.0
# Contact lines closer to one line than this sine: the corner between the grooves says little about loads.
STRAIGHT = 0.2
# Of a place, in units of its size: a few roundings.
ROUNDING = 5e-16
# Lengths below this many ball diameters have no direction.
SHORTEST = 1e-12


@kernel
def is_moving(case: recarray) -> bool:
    """Whether a named effect has some speed to act at."""
    return (case.centrifugal or case.gyroscopic) and (case.inner_speed != 0.0 or case.outer_speed != 0.0)


@kernel
def groove_stiffness(case: recarray, side: float, n1: float, n2: float) -> tuple[float, float]:
    """K of a raceway's contact and d ln K/d alpha: constants of the bearing, or at the contact's own angle."""
    if not case.actual_angle:
        return (case.inner_stiffness if side < 0 else case.outer_stiffness), 0.0
    coefficient = case.inner_coefficient if side < 0 else case.outer_coefficient
    return stiffness_at_angle(case.form, 1.0, case.pitch_diameter, coefficient, 1.0, n1, n2, side)


@kernel
def raceway_ellipse(case: recarray, side: float, cosine: float) -> tuple[float, float, float, float]:
    """(a/Q^(1/3), b/Q^(1/3), Q/approach^1.5, E) of a raceway's contact at an angle of this cosine."""
    coefficient = case.inner_coefficient if side < 0 else case.outer_coefficient
    rolling = rolling_curvature(1.0, case.pitch_diameter, cosine, side)
    return ellipse_constants(case.form, rolling, transverse_curvature(1.0, coefficient), 1.0)


@kernel
def series_stiffness(case: recarray, n1: float, n2: float) -> tuple[float, float]:
    """K of both contacts in series, K^(-2/3) = Ki^(-2/3) + Ko^(-2/3), and d ln K/d alpha."""
    if not case.actual_angle:
        return case.series_stiffness, 0.0
    ki, ki_slope = groove_stiffness(case, INNER_SIDE, n1, n2)
    ko, ko_slope = groove_stiffness(case, OUTER_SIDE, n1, n2)
    inner, outer = ki ** (-2.0 / 3.0), ko ** (-2.0 / 3.0)
    compliance = inner + outer
    return compliance**-1.5, (inner * ki_slope + outer * ko_slope) / compliance


@kernel
def inertia(
    case: recarray, control: int, si: float, ci: float, so: float, co: float
) -> tuple[float, float, float, float, float, float]:
    """(Fc, Mg) of the effects that the case names, each with its derivatives by ai and ao."""
    g = 1.0 / case.pitch_diameter
    si, ci, is_beyond = inner_line(si, ci, so, co)
    axis = rotation_axis(control, g, si, ci, so, co)
    terms = rolling_terms(g, si, ci, so, co, axis)
    orbit = orbital_speed(terms, case.inner_speed, case.outer_speed)
    fc, fc_i, fc_o = 0.0, 0.0, 0.0
    if case.centrifugal:
        fc, fc_i, fc_o = centrifugal_force(BALL_MASS, case.pitch_diameter, orbit)
    mg, mg_i, mg_o = 0.0, 0.0, 0.0
    if case.gyroscopic:
        rotation = rotation_per_axis_length(terms, g, case.inner_speed, case.outer_speed)
        mg, mg_i, mg_o = gyroscopic_moment(BALL_INERTIA, orbit, rotation, axis)
    if is_beyond:  # then ai follows ao
        return fc, 0.0, fc_o + fc_i, mg, 0.0, mg_o + mg_i
    return fc, fc_i, fc_o, mg, mg_i, mg_o


@kernel
def inertia_force(case: recarray, control: int, si: float, ci: float, so: float, co: float) -> tuple[float, float]:
    """f: the inertia force on the ball and the friction that carries its gyroscopic moment."""
    fc, _, _, mg, _, _ = inertia(case, control, si, ci, so, co)
    share_i, share_o = 0.0, 0.0
    if case.gyroscopic:
        share_i, share_o = moment_shares(case.shares, control == INNER)
    return mg * (share_o * co - share_i * ci), mg * (share_i * si - share_o * so) + fc


@kernel
def put_in_groove(case: recarray, ball: recarray, so: float, co: float, load: float) -> None:
    """Put a ball on the outer groove, in this direction and under this load."""
    length, approach = case.outer_coefficient - 0.5, (load / case.outer_stiffness) ** (2.0 / 3.0)
    ball.u1 = length * (so - case.sin_free) + approach * so
    ball.u2 = length * (co - case.cos_free) + approach * co


@kernel
def throw(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball where its inertia throws it: into a corner between its grooves, or to the outer groove's bottom.

    In a corner both contact lines have their free length: two circles meet, outward or inward of the line between the
    grooves' centres, and Qi ni - Qo no + f = 0 gives the loads. The ball lies in the corner where both press. Where
    friction lets neither press, Newton's method starts from the outward one and the centrifugal force alone.
    """
    s, c = case.sin_free, case.cos_free
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    p1, p2 = (li + lo) * s + a1, (li + lo) * c + a2
    if p1 * p1 + (p2 - lo) * (p2 - lo) < li * li:
        size = max(sqrt(p1 * p1 + (p2 - lo) * (p2 - lo)), SHORTEST)
        fc, _, _, _, _, _ = inertia(case, ball.control, p1 / size, (p2 - lo) / size, 0.0, 1.0)
        put_in_groove(case, ball, 0.0, 1.0, fc)
        close_chain(ball, a1, a2)
        return
    square = p1 * p1 + p2 * p2
    distance = sqrt(square)
    along = min(0.5 * (square + lo * lo - li * li) / distance, lo)
    across = sqrt(lo * lo - along * along)
    d1, d2 = p1 / distance, p2 / distance
    outward = 1.0 if d1 >= 0.0 else -1.0
    so, co, si, ci, qi, qo = 0.0, 1.0, 0.0, 1.0, 0.0, 0.0
    for attempt in range(3):
        side = -outward if attempt == 1 else outward
        so, co = (along * d1 - side * across * d2) / lo, (along * d2 + side * across * d1) / lo
        si, ci = (p1 - lo * so) / li, (p2 - lo * co) / li
        f1, f2 = inertia_force(case, ball.control, si, ci, so, co)
        if attempt == 2:
            f1, f2 = 0.0, inertia(case, ball.control, si, ci, so, co)[0]
        sine = so * ci - co * si
        sine = max(sine, STRAIGHT) if sine > 0.0 else min(sine, -STRAIGHT)
        qi, qo = (f1 * co - f2 * so) / sine, (f1 * ci - f2 * si) / sine
        if qi > 0.0 and qo > 0.0:
            break
    qi, qo = abs(qi), abs(qo)
    put_in_groove(case, ball, so, co, qo)
    inner = (qi / case.inner_stiffness) ** (2.0 / 3.0)
    ball.v1, ball.v2 = li * (si - s) + inner * si, li * (ci - c) + inner * ci


@kernel
def close_chain(ball: recarray, a1: float, a2: float) -> None:
    """Let the inner link be what ring and outer link leave; at rest there is no outer link, its step is none."""
    ball.v1, ball.v2 = a1 - ball.u1, a2 - ball.u2


@kernel
def moving_ball(
    case: recarray, ball: recarray, a1: float, a2: float, floor: float
) -> tuple[float, float, float, float, float]:
    """Evaluate one ball where it is, and eliminate its own unknowns into its record.

    Args:
        a1, a2: displacement of the inner groove centre from touching at the free angle.
        floor: least stiffness of the ball [force/length].

    Returns:
        (imbalance, largest contact load, Fc, |Mg|/D, what rounding of its place may do to its loads); the imbalance
        counts what the chain's gap keeps from acting.
    """
    s, c = case.sin_free, case.cos_free
    delta_o, so, co, inverse_o = direction(case.outer_coefficient - 0.5, s, c, ball.u1, ball.u2)
    delta_i, si, ci, inverse_i = direction(case.inner_coefficient - 0.5, s, c, ball.v1, ball.v2)
    gap1, gap2 = a1 - ball.u1 - ball.v1, a2 - ball.u2 - ball.v2
    ki, ki_slope = groove_stiffness(case, INNER_SIDE, si, ci)
    ko, ko_slope = groove_stiffness(case, OUTER_SIDE, so, co)
    qi, qi_slope = contact_load(ki, delta_i)
    qo, qo_slope = contact_load(ko, delta_o)
    fc, fc_i, fc_o, mg, mg_i, mg_o = inertia(case, ball.control, si, ci, so, co)
    share_i, share_o = 0.0, 0.0
    if case.gyroscopic:
        share_i, share_o = moment_shares(case.shares, ball.control == INNER)
    ti, ti_i, ti_o = share_i * mg, share_i * mg_i, share_i * mg_o
    to, to_i, to_o = share_o * mg, share_o * mg_i, share_o * mg_o

    r1 = qi * si - qo * so - ti * ci + to * co
    r2 = qi * ci - qo * co + ti * si - to * so + fc
    h1 = qi * si - ti * ci
    h2 = qi * ci + ti * si
    h3 = case.tilt_lever * h1 + case.inner_coefficient * ti

    # d alpha = e . dv with e = t/distance
    ei1, ei2 = ci * inverse_i, -si * inverse_i
    eo1, eo2 = co * inverse_o, -so * inverse_o
    hi11, hi12, hi22 = contact_tangent(qi, qi_slope, si, ci, inverse_i)
    ho11, ho12, ho22 = contact_tangent(qo, qo_slope, so, co, inverse_o)
    # Derivatives by the two angles of everything but the contacts' own turning, which the tangents hold.
    qi_a = qi * ki_slope
    qo_a = qo * ko_slope
    r1_i = qi_a * si - ti_i * ci + ti * si + to_i * co
    r2_i = qi_a * ci + ti_i * si + ti * ci - to_i * so + fc_i
    r1_o = -qo_a * so - ti_o * ci + to_o * co - to * so
    r2_o = -qo_a * co + ti_o * si - to_o * so - to * co + fc_o
    h1_i = qi_a * si - ti_i * ci + ti * si
    h2_i = qi_a * ci + ti_i * si + ti * ci
    h1_o, h2_o = -ti_o * ci, ti_o * si

    # By A (through ai only), then by X (through -W, and ao).
    ra11, ra12 = hi11 + r1_i * ei1, hi12 + r1_i * ei2
    ra21, ra22 = hi12 + r2_i * ei1, hi22 + r2_i * ei2
    rx11, rx12 = -ra11 - ho11 + r1_o * eo1 - floor, -ra12 - ho12 + r1_o * eo2
    rx21, rx22 = -ra21 - ho12 + r2_o * eo1, -ra22 - ho22 + r2_o * eo2 - floor
    ha11, ha12 = hi11 + h1_i * ei1, hi12 + h1_i * ei2
    ha21, ha22 = hi12 + h2_i * ei1, hi22 + h2_i * ei2
    hx11, hx12 = -ha11 + h1_o * eo1, -ha12 + h1_o * eo2
    hx21, hx22 = -ha21 + h2_o * eo1, -ha22 + h2_o * eo2
    fi = case.inner_coefficient
    ma1, ma2 = fi * ti_i * ei1, fi * ti_i * ei2
    mx1, mx2 = -ma1 + fi * ti_o * eo1, -ma2 + fi * ti_o * eo2

    inverse = 1.0 / (rx11 * rx22 - rx12 * rx21)
    # What the links' gap would change if it were closed at the inner link counts as imbalance.
    p1, p2 = r1 + ra11 * gap1 + ra12 * gap2, r2 + ra21 * gap1 + ra22 * gap2
    y1, y2 = (rx22 * p1 - rx12 * p2) * inverse, (rx11 * p2 - rx21 * p1) * inverse
    y11, y12 = (rx22 * ra11 - rx12 * ra21) * inverse, (rx22 * ra12 - rx12 * ra22) * inverse
    y21, y22 = (rx11 * ra21 - rx21 * ra11) * inverse, (rx11 * ra22 - rx21 * ra12) * inverse

    k11, k12 = ha11 - hx11 * y11 - hx12 * y21, ha12 - hx11 * y12 - hx12 * y22
    lever = case.tilt_lever
    c1 = h1 + ha11 * gap1 + ha12 * gap2 - hx11 * y1 - hx12 * y2
    c2 = h2 + ha21 * gap1 + ha22 * gap2 - hx21 * y1 - hx22 * y2
    ball.force[0], ball.force[1], ball.force[2] = h1, h2, h3
    ball.condensed[0], ball.condensed[1] = c1, c2
    ball.condensed[2] = lever * c1 + fi * ti + ma1 * gap1 + ma2 * gap2 - mx1 * y1 - mx2 * y2
    ball.stiffness[0, 0], ball.stiffness[0, 1] = k11, k12
    ball.stiffness[1, 0] = ha21 - hx21 * y11 - hx22 * y21
    ball.stiffness[1, 1] = ha22 - hx21 * y12 - hx22 * y22
    ball.stiffness[2, 0] = lever * k11 + ma1 - mx1 * y11 - mx2 * y21
    ball.stiffness[2, 1] = lever * k12 + ma2 - mx1 * y12 - mx2 * y22
    ball.y1, ball.y2, ball.y11, ball.y12, ball.y21, ball.y22 = y1, y2, y11, y12, y21, y22
    ball.is_idle = qi <= IDLE * fc
    ball.outer_sine, ball.outer_cosine, ball.outer_inverse, ball.outer_approach = so, co, inverse_o, delta_o
    ball.inner_sine, ball.inner_cosine, ball.inner_inverse, ball.inner_approach = si, ci, inverse_i, delta_i
    ball.gap1, ball.gap2 = gap1, gap2
    open_force = max(qi_slope, qi * inverse_i) * max(abs(gap1), abs(gap2))
    place = abs(ball.u1) + abs(ball.u2) + abs(a1) + abs(a2)
    return max(abs(r1), abs(r2)) + open_force, max(qi, qo), fc, abs(mg), ROUNDING * place * (qi_slope + qo_slope)


@kernel
def resting_ball(case: recarray, ball: recarray, a1: float, a2: float) -> tuple[float, float, float]:
    """One ball at rest between its grooves, springs in series: one link from groove centre to groove centre.

    Fills its record; returns (what the link's gap keeps from acting, its load, what rounding may do to that).
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    approach, n1, n2, inverse = direction(length, case.sin_free, case.cos_free, ball.v1, ball.v2)
    gap1, gap2 = a1 - ball.v1, a2 - ball.v2
    stiffness, slope = series_stiffness(case, n1, n2)
    load, load_slope = contact_load(stiffness, approach)
    k11, k12, k22 = contact_tangent(load, load_slope, n1, n2, inverse)
    turn = load * slope * inverse  # of the stiffness with the contact angle
    k11, k12, k21, k22 = k11 + turn * n1 * n2, k12 - turn * n1 * n1, k12 + turn * n2 * n2, k22 - turn * n2 * n1
    lever = case.tilt_lever
    ball.force[0], ball.force[1], ball.force[2] = load * n1, load * n2, lever * load * n1
    ball.stiffness[0, 0], ball.stiffness[0, 1] = k11, k12
    ball.stiffness[1, 0], ball.stiffness[1, 1] = k21, k22
    ball.stiffness[2, 0], ball.stiffness[2, 1] = lever * k11, lever * k12
    for row in range(3):
        ball.condensed[row] = ball.force[row] + ball.stiffness[row, 0] * gap1 + ball.stiffness[row, 1] * gap2
    ball.inner_sine, ball.inner_cosine, ball.inner_inverse, ball.inner_approach = n1, n2, inverse, approach
    ball.gap1, ball.gap2 = gap1, gap2
    ball.is_idle = load == 0.0
    open_force = max(load_slope, load * inverse) * max(abs(gap1), abs(gap2))
    return open_force, load, ROUNDING * (abs(a1) + abs(a2)) * load_slope
