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

from math import atan2, cos, sin, sqrt

from numpy import ndarray, recarray

from qsbearing.case import BALL_INERTIA, BALL_MASS
from qsbearing.compiled import kernel
from qsbearing.contact import contact_load, contact_tangent, direction, inverse_of, link
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
# Of lengths, in units of their sum: what the roundings of all steps add up to (each line makes some 2e-16 a step).
ROUNDING = 4e-15
# No limit to the friction that a contact carries.
UNLIMITED = 0.0
# The most friction over load where it is limited: what oiled steel carries (0.06 to 0.1); what no material exceeds.
OILED_GRIP, FULL_GRIP = 0.1, 1.0
# An approach, in ball diameters, that is none: the rounding of a place, the sum of ring's, grooves' and both links'.
TOUCHING = 4.0 * 2.0**-52
# Lengths below this many ball diameters have no direction.
SHORTEST = 1e-12


@kernel
def is_moving(case: recarray) -> bool:
    """Whether a named effect has some speed to act at."""
    return (case.centrifugal or case.gyroscopic) and (case.inner_speed != 0.0 or case.outer_speed != 0.0)


@kernel
def set_speed(case: recarray, part: float, inner: float, outer: float) -> None:
    """Turn the rings at this part of these speeds."""
    case.inner_speed, case.outer_speed = part * inner, part * outer


@kernel
def limit_friction(ring: recarray, limit: float) -> None:
    """Let contacts carry no more friction than this many times their load."""
    ring.limit, ring.grip = limit, limit


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
    """(Fc, Mg) of the effects that the case names, each with its derivatives by ai and ao, as rolling sees them."""
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
def line_to_inner(case: recarray, ball: recarray) -> tuple[float, float, float, float, float]:
    """The ball's inner contact line as rolling sees it, with its derivatives."""
    distance = 1.0 + ball.inner_approach / (case.inner_coefficient - 0.5)
    return inner_line(ball.inner_sine, ball.inner_cosine, ball.outer_sine, ball.outer_cosine, distance)


@kernel
def inertia_of(case: recarray, ball: recarray) -> tuple[float, float]:
    """(Fc, Mg) of a ball where it is."""
    s, c, _, _, _ = line_to_inner(case, ball)
    fc, _, _, mg, _, _ = inertia(case, ball.control, s, c, ball.outer_sine, ball.outer_cosine)
    return fc, mg


@kernel
def is_rolled(ball: recarray) -> bool:
    """Whether some raceway rolls the ball: it must be pressed by more than the rounding of its place."""
    return bool(max(ball.inner_approach, ball.outer_approach) > TOUCHING)


@kernel
def friction_shares(case: recarray, control: int) -> tuple[float, float]:
    """(lambda_i, lambda_o) of a ball; none where no gyroscopic moment is asked for."""
    if not case.gyroscopic:
        return 0.0, 0.0
    return moment_shares(case.shares, control == INNER)


@kernel
def inertia_force(case: recarray, control: int, si: float, ci: float, so: float, co: float) -> tuple[float, float]:
    """f: the inertia force on the ball and the friction that carries its gyroscopic moment."""
    si, ci, _, _, _ = inner_line(si, ci, so, co, 1.0)
    fc, _, _, mg, _, _ = inertia(case, control, si, ci, so, co)
    share_i, share_o = friction_shares(case, control)
    return mg * (share_o * co - share_i * ci), mg * (share_i * si - share_o * so) + fc


@kernel
def set_outer(ball: recarray, sine: float, cosine: float, approach: float) -> None:
    """Give the outer link this direction and approach."""
    ball.outer_sine, ball.outer_cosine, ball.outer_approach = sine, cosine, approach


@kernel
def set_inner(ball: recarray, sine: float, cosine: float, approach: float) -> None:
    """Give the inner link this direction and approach."""
    ball.inner_sine, ball.inner_cosine, ball.inner_approach = sine, cosine, approach


@kernel
def outer_vector(case: recarray, ball: recarray) -> tuple[float, float]:
    """The ball's centre from the outer groove's, less touching at the free angle."""
    n1, n2, approach = ball.outer_sine, ball.outer_cosine, ball.outer_approach
    return link(case.outer_coefficient - 0.5, case.sin_free, case.cos_free, n1, n2, approach)


@kernel
def gap_in_chain(length: float, a1: float, a2: float, w1: float, w2: float) -> tuple[float, float]:
    """What links that come to w lack of the groove centres' displacement A; nothing where rounding could make it.

    Loads follow from the links' own approaches, so that rounding of places is no imbalance: it is a change of the
    bearing's measures by their own rounding.
    """
    gap1, gap2 = a1 - w1, a2 - w2
    if max(abs(gap1), abs(gap2)) <= ROUNDING * (length + abs(a1) + abs(a2)):
        return 0.0, 0.0
    return gap1, gap2


@kernel
def inner_rest(case: recarray, ball: recarray, at_rest: bool, a1: float, a2: float) -> tuple[float, float, float]:
    """(length, w1, w2): what the ring leaves to the inner link, which at rest is the only one."""
    if at_rest:
        return case.inner_coefficient + case.outer_coefficient - 1.0, a1, a2
    u1, u2 = outer_vector(case, ball)
    return case.inner_coefficient - 0.5, a1 - u1, a2 - u2


@kernel
def longer_link(case: recarray, length: float) -> float:
    """The longer of the outer link and the inner one, of this length: its rounding is in what is left to the other."""
    return max(length, case.outer_coefficient - 0.5)


@kernel
def inner_gap(case: recarray, ball: recarray, length: float, w1: float, w2: float) -> tuple[float, float]:
    """What the inner link, of this free length, lacks of what the ring leaves it, w."""
    n1, n2, approach = ball.inner_sine, ball.inner_cosine, ball.inner_approach
    v1, v2 = link(length, case.sin_free, case.cos_free, n1, n2, approach)
    return gap_in_chain(longer_link(case, length), w1, w2, v1, v2)


@kernel
def set_inner_by_places(case: recarray, ball: recarray, length: float, w1: float, w2: float) -> None:
    """Give the inner link what the ring leaves it, but keep an approach that differs by the rounding of places only.

    Steps give the approach more digits than places have: read off places, light loads would never come to rest.
    """
    approach, sine, cosine, _ = direction(length, case.sin_free, case.cos_free, w1, w2)
    if abs(approach - ball.inner_approach) <= ROUNDING * (longer_link(case, length) + abs(w1) + abs(w2)):
        approach = ball.inner_approach
    set_inner(ball, sine, cosine, approach)


@kernel
def close_chain(case: recarray, ball: recarray, at_rest: bool, a1: float, a2: float) -> None:
    """Let the inner link be what ring and outer link leave; one that is so but for rounding stays as it is.

    One taken over from another length may close the chain with less than none of its own: that points the other way.
    """
    length, w1, w2 = inner_rest(case, ball, at_rest, a1, a2)
    gap1, gap2 = inner_gap(case, ball, length, w1, w2)
    if gap1 != 0.0 or gap2 != 0.0 or length + ball.inner_approach < 0.0:
        set_inner_by_places(case, ball, length, w1, w2)


@kernel
def lay_midway(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball midway between its grooves, on the line between their centres.

    Where one groove's circle lies within the other's, midway between its centre and its far side.
    """
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    between, n1, n2, _ = direction(li + lo, case.sin_free, case.cos_free, a1, a2)
    distance = li + lo + between
    if distance <= lo - li:
        set_outer(ball, n1, n2, distance + 0.5 * li - lo)
        set_inner(ball, -n1, -n2, -0.5 * li)
    elif distance <= li - lo:
        set_outer(ball, -n1, -n2, -0.5 * lo)
        set_inner(ball, n1, n2, distance + 0.5 * lo - li)
    else:
        set_outer(ball, n1, n2, 0.5 * between)
        set_inner(ball, n1, n2, 0.5 * between)


@kernel
def throw(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball where its inertia throws it: into a corner between its grooves, or to the outer groove's bottom.

    In a corner both contact lines have their free length: two circles meet, outward or inward of the line between the
    grooves' centres, and Qi ni - Qo no + f = 0 gives the loads. The ball lies in the corner where both press. Where
    friction lets neither press, Newton's method starts from the outward one and the centrifugal force alone. Where the
    top of the inner groove's circle lies within the outer one's, the ball does not get to the outer groove: the far
    side of the inner one holds it.
    """
    s, c = case.sin_free, case.cos_free
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    p1, p2 = (li + lo) * s + a1, (li + lo) * c + a2
    if p1 * p1 + (p2 - lo) * (p2 - lo) < li * li:
        size = max(sqrt(p1 * p1 + (p2 - lo) * (p2 - lo)), SHORTEST)
        s_seen, c_seen, _, _, _ = inner_line(p1 / size, (p2 - lo) / size, 0.0, 1.0, 1.0)
        fc, _, _, _, _, _ = inertia(case, ball.control, s_seen, c_seen, 0.0, 1.0)
        set_outer(ball, 0.0, 1.0, (fc / case.outer_stiffness) ** (2.0 / 3.0))
        close_chain(case, ball, False, a1, a2)
        return
    if p1 * p1 + (p2 + li) * (p2 + li) < lo * lo:
        approach, so, co, _ = direction(lo, s, c, p1 - lo * s, p2 + li - lo * c)
        s_seen, c_seen, _, _, _ = inner_line(0.0, -1.0, so, co, 1.0)
        fc, _, _, _, _, _ = inertia(case, ball.control, s_seen, c_seen, so, co)
        set_inner(ball, 0.0, -1.0, (fc / case.inner_stiffness) ** (2.0 / 3.0))
        set_outer(ball, so, co, approach)
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
            s_seen, c_seen, _, _, _ = inner_line(si, ci, so, co, 1.0)
            f1, f2 = 0.0, inertia(case, ball.control, s_seen, c_seen, so, co)[0]
        sine = so * ci - co * si
        sine = max(sine, STRAIGHT) if sine > 0.0 else min(sine, -STRAIGHT)
        qi, qo = (f1 * co - f2 * so) / sine, (f1 * ci - f2 * si) / sine
        if qi > 0.0 and qo > 0.0:
            break
    set_outer(ball, so, co, (abs(qo) / case.outer_stiffness) ** (2.0 / 3.0))
    inner = (abs(qi) / case.inner_stiffness) ** (2.0 / 3.0)
    # Where the circles do not meet, (si, ci) is no unit vector: its direction counts.
    approach, n1, n2, _ = direction(li, s, c, li * (si - s) + inner * si, li * (ci - c) + inner * ci)
    set_inner(ball, n1, n2, approach)


@kernel
def lay_loose(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball that its grooves leave room where it is thrown; where nothing throws it, midway: nothing rolls it."""
    if case.centrifugal and is_moving(case):
        throw(case, ball, a1, a2)
    else:
        lay_midway(case, ball, a1, a2)


@kernel
def carried_friction(share: float, mg: float, load: float, grip: float) -> tuple[float, float, float]:
    """T, the friction at a contact that carries its share of the gyroscopic moment, and dT/dMg, dT/dQ."""
    friction = share * mg
    if grip == UNLIMITED or abs(friction) <= grip * load:
        return friction, share, 0.0
    slope = grip if friction > 0.0 else -grip
    return slope * load, 0.0, slope


@kernel
def moving_ball(
    case: recarray, ball: recarray, a1: float, a2: float, floor: float, grip: float
) -> tuple[float, float, float, float, float]:
    """Evaluate one ball where it is, and eliminate its own unknowns into its record.

    Args:
        a1, a2: displacement of the inner groove centre from touching at the free angle.
        floor: least stiffness of the ball [force/length].
        grip: the most friction that contacts carry, over their load; UNLIMITED as the equations stand.

    Returns:
        (imbalance, larger contact load, lighter one, Fc, |Mg|/D as far as it is carried); the imbalance counts what the
        chain's gap keeps from acting, a contact without load is no lighter one.
    """
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    so, co, delta_o = ball.outer_sine, ball.outer_cosine, ball.outer_approach
    si, ci, delta_i = ball.inner_sine, ball.inner_cosine, ball.inner_approach
    inverse_o, inverse_i = inverse_of(lo + delta_o), inverse_of(li + delta_i)
    u1, u2 = outer_vector(case, ball)
    v1, v2 = link(li, case.sin_free, case.cos_free, si, ci, delta_i)
    gap1, gap2 = gap_in_chain(li + lo, a1, a2, u1 + v1, u2 + v2)
    ki, ki_slope = groove_stiffness(case, INNER_SIDE, si, ci)
    ko, ko_slope = groove_stiffness(case, OUTER_SIDE, so, co)
    qi, qi_slope = contact_load(ki, delta_i)
    qo, qo_slope = contact_load(ko, delta_o)
    s_seen, c_seen, by_inner, by_outer, by_distance = line_to_inner(case, ball)
    fc, fc_s, fc_o, mg, mg_s, mg_o = inertia(case, ball.control, s_seen, c_seen, so, co)
    fc_i, fc_o = fc_s * by_inner, fc_o + fc_s * by_outer
    mg_i, mg_o = mg_s * by_inner, mg_o + mg_s * by_outer
    share_i, share_o = friction_shares(case, ball.control)
    if not is_rolled(ball):
        share_i, share_o = 0.0, 0.0
    ti, ti_m, ti_q = carried_friction(share_i, mg, qi, grip)
    to, to_m, to_q = carried_friction(share_o, mg, qo, grip)
    ti_i, ti_o, to_i, to_o = ti_m * mg_i, ti_m * mg_o, to_m * mg_i, to_m * mg_o

    r1 = qi * si - qo * so - ti * ci + to * co + ball.push[0]
    r2 = qi * ci - qo * co + ti * si - to * so + fc + ball.push[1]
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

    # By A (through ai, and as rolling sees it the inner length), then by X (through -W, and ao).
    fi = case.inner_coefficient
    ra11, ra12 = hi11 + r1_i * ei1, hi12 + r1_i * ei2
    ra21, ra22 = hi21 + r2_i * ei1, hi22 + r2_i * ei2
    ha11, ha12 = hi11 + h1_i * ei1, hi12 + h1_i * ei2
    ha21, ha22 = hi21 + h2_i * ei1, hi22 + h2_i * ei2
    ma1, ma2 = fi * (ti_i * ei1 + ti_q * qi_slope * si), fi * (ti_i * ei2 + ti_q * qi_slope * ci)
    if by_distance != 0.0:
        fc_d, mg_d = fc_s * by_distance / li, mg_s * by_distance / li
        ti_d, to_d = ti_m * mg_d, to_m * mg_d
        h1_d, h2_d = -ti_d * ci, ti_d * si
        r1_d, r2_d = h1_d + to_d * co, h2_d - to_d * so + fc_d
        ra11, ra12, ra21, ra22 = ra11 + r1_d * si, ra12 + r1_d * ci, ra21 + r2_d * si, ra22 + r2_d * ci
        ha11, ha12, ha21, ha22 = ha11 + h1_d * si, ha12 + h1_d * ci, ha21 + h2_d * si, ha22 + h2_d * ci
        ma1, ma2 = ma1 + fi * ti_d * si, ma2 + fi * ti_d * ci
    rx11, rx12 = -ra11 - ho11 + r1_o * eo1 - floor, -ra12 - ho12 + r1_o * eo2
    rx21, rx22 = -ra21 - ho21 + r2_o * eo1, -ra22 - ho22 + r2_o * eo2 - floor
    hx11, hx12 = -ha11 + h1_o * eo1, -ha12 + h1_o * eo2
    hx21, hx22 = -ha21 + h2_o * eo1, -ha22 + h2_o * eo2
    mx1, mx2 = -ma1 + fi * ti_o * eo1, -ma2 + fi * ti_o * eo2

    # Where rounding leaves it no stiffness across its line (an approach below that of a place), the ball stays put.
    determinant = rx11 * rx22 - rx12 * rx21
    inverse = 1.0 / determinant if determinant != 0.0 else 0.0
    ball.own11, ball.own12, ball.own21, ball.own22, ball.inverse = rx11, rx12, rx21, rx22, inverse
    # What the links' gap would change if it were closed at the inner link counts as imbalance.
    p1, p2 = r1 + ra11 * gap1 + ra12 * gap2, r2 + ra21 * gap1 + ra22 * gap2
    y1, y2 = (rx22 * p1 - rx12 * p2) * inverse, (rx11 * p2 - rx21 * p1) * inverse
    y11, y12 = (rx22 * ra11 - rx12 * ra21) * inverse, (rx22 * ra12 - rx12 * ra22) * inverse
    y21, y22 = (rx11 * ra21 - rx21 * ra11) * inverse, (rx11 * ra22 - rx21 * ra12) * inverse

    k11, k12 = ha11 - hx11 * y11 - hx12 * y21, ha12 - hx11 * y12 - hx12 * y22
    lever = case.tilt_lever
    ball.by_own[0, 0], ball.by_own[0, 1] = hx11, hx12
    ball.by_own[1, 0], ball.by_own[1, 1] = hx21, hx22
    ball.by_own[2, 0], ball.by_own[2, 1] = lever * hx11 + mx1, lever * hx12 + mx2
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
    ball.outer_inverse, ball.inner_inverse = inverse_o, inverse_i
    ball.gap1, ball.gap2 = gap1, gap2
    open_force = max(qi_slope, qi * inverse_i) * max(abs(gap1), abs(gap2))
    lighter = min(qi, qo) if qi > 0.0 and qo > 0.0 else max(qi, qo)
    return max(abs(r1), abs(r2)) + open_force, max(qi, qo), lighter, fc, min(abs(mg), max(abs(ti), abs(to)))


@kernel
def resting_ball(case: recarray, ball: recarray, a1: float, a2: float) -> tuple[float, float]:
    """One ball at rest between its grooves, springs in series: one link from groove centre to groove centre.

    Fills its record; returns (what the link's gap keeps from acting, its load).
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    n1, n2, approach = ball.inner_sine, ball.inner_cosine, ball.inner_approach
    inverse = inverse_of(length + approach)
    gap1, gap2 = inner_gap(case, ball, length, a1, a2)
    stiffness, slope = series_stiffness(case, n1, n2)
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
        ball.condensed[row] = ball.force[row] + ball.stiffness[row, 0] * gap1 + ball.stiffness[row, 1] * gap2
    ball.inner_inverse = inverse
    ball.gap1, ball.gap2 = gap1, gap2
    ball.is_idle = load == 0.0
    return max(load_slope, load * inverse) * max(abs(gap1), abs(gap2)), load


@kernel
def evaluate(case: recarray, ball: recarray, a1: float, a2: float, floor: float, grip: float) -> None:
    """Fill the record of a ball that lies between its two contacts, moving or at rest."""
    if is_moving(case):
        moving_ball(case, ball, a1, a2, floor, grip)
        return
    between = ball.inner_approach
    ball.inner_approach += ball.outer_approach
    resting_ball(case, ball, a1, a2)
    ball.inner_approach = between


@kernel
def tell_place(case: recarray, ball: recarray, place: ndarray) -> None:
    """Write where a ball lies: its outer angle less the free one, and its approaches, outer and inner."""
    s, c = case.sin_free, case.cos_free
    so, co = ball.outer_sine, ball.outer_cosine
    place[0] = atan2(so * c - co * s, co * c + so * s)
    place[1], place[2] = ball.outer_approach, ball.inner_approach


@kernel
def take_place(case: recarray, ball: recarray, place: ndarray) -> None:
    """Put a ball where it was told to lie; its inner line follows from closing the chain."""
    s, c = case.sin_free, case.cos_free
    turn_s, turn_c = sin(place[0]), cos(place[0])
    set_outer(ball, s * turn_c + c * turn_s, c * turn_c - s * turn_s, place[1])
    set_inner(ball, 0.0, 0.0, place[2])


@kernel
def close_told(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Give a ball put where it was told to lie its inner line; its approach is what was told, free of rounding."""
    _, w1, w2 = inner_rest(case, ball, False, a1, a2)
    _, n1, n2, _ = direction(case.inner_coefficient - 0.5, case.sin_free, case.cos_free, w1, w2)
    ball.inner_sine, ball.inner_cosine = n1, n2
