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
from qsbearing.kinematics import orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.raceway_control import INNER, rotation_axis


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
    return fc, fc_i, fc_o, mg, mg_i, mg_o


@kernel
def moving_ball(
    case: recarray, ball: recarray, a1: float, a2: float, floor: float
) -> tuple[float, float, float, float, float]:
    """Evaluate one ball where it is, and eliminate its own unknowns into its record.

    Args:
        a1, a2: displacement of the inner groove centre from touching at the free angle.
        floor: least stiffness of the ball [force/length].

    Returns:
        (r1, r2, largest contact load, Fc, |Mg|/D).
    """
    u1, u2 = ball.u1, ball.u2
    s, c = case.sin_free, case.cos_free
    delta_o, so, co, inverse_o = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
    delta_i, si, ci, inverse_i = direction(case.inner_coefficient - 0.5, s, c, a1 - u1, a2 - u2)
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
    y1, y2 = (rx22 * r1 - rx12 * r2) * inverse, (rx11 * r2 - rx21 * r1) * inverse
    y11, y12 = (rx22 * ra11 - rx12 * ra21) * inverse, (rx22 * ra12 - rx12 * ra22) * inverse
    y21, y22 = (rx11 * ra21 - rx21 * ra11) * inverse, (rx11 * ra22 - rx21 * ra12) * inverse

    k11, k12 = ha11 - hx11 * y11 - hx12 * y21, ha12 - hx11 * y12 - hx12 * y22
    lever = case.tilt_lever
    c1 = h1 - hx11 * y1 - hx12 * y2
    ball.force[0], ball.force[1], ball.force[2] = h1, h2, h3
    ball.condensed[0], ball.condensed[1] = c1, h2 - hx21 * y1 - hx22 * y2
    ball.condensed[2] = lever * c1 + fi * ti - mx1 * y1 - mx2 * y2
    ball.stiffness[0, 0], ball.stiffness[0, 1] = k11, k12
    ball.stiffness[1, 0] = ha21 - hx21 * y11 - hx22 * y21
    ball.stiffness[1, 1] = ha22 - hx21 * y12 - hx22 * y22
    ball.stiffness[2, 0] = lever * k11 + ma1 - mx1 * y11 - mx2 * y21
    ball.stiffness[2, 1] = lever * k12 + ma2 - mx1 * y12 - mx2 * y22
    ball.y1, ball.y2, ball.y11, ball.y12, ball.y21, ball.y22 = y1, y2, y11, y12, y21, y22
    ball.outer_sine, ball.outer_cosine, ball.outer_inverse, ball.outer_approach = so, co, inverse_o, delta_o
    return r1, r2, max(qi, qo), fc, abs(mg)


@kernel
def resting_ball(case: recarray, ball: recarray, a1: float, a2: float) -> float:
    """One ball at rest between its grooves, springs in series: fills its record, returns its load."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    approach, n1, n2, inverse = direction(length, case.sin_free, case.cos_free, a1, a2)
    stiffness, slope = series_stiffness(case, n1, n2)
    load, load_slope = contact_load(stiffness, approach)
    k11, k12, k22 = contact_tangent(load, load_slope, n1, n2, inverse)
    turn = load * slope * inverse  # of the stiffness with the contact angle
    lever = case.tilt_lever
    ball.force[0], ball.force[1], ball.force[2] = load * n1, load * n2, lever * load * n1
    for row in range(3):
        ball.condensed[row] = ball.force[row]
    ball.stiffness[0, 0], ball.stiffness[0, 1] = k11 + turn * n1 * n2, k12 - turn * n1 * n1
    ball.stiffness[1, 0], ball.stiffness[1, 1] = k12 + turn * n2 * n2, k22 - turn * n2 * n1
    ball.stiffness[2, 0], ball.stiffness[2, 1] = lever * ball.stiffness[0, 0], lever * ball.stiffness[0, 1]
    # the ball follows its grooves: it has no step of its own
    ball.y1, ball.y2, ball.y11, ball.y12, ball.y21, ball.y22 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    return load
