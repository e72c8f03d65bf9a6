"""Motion of a ball between its raceways: orbit and rotation, from the contact angles and the attitude of its axis.

Either ring may turn, at omega_i and omega_o about +x. In the frame that goes round with the ball's centre at
omega_m, the ball turns at omega_R about an axis in its own plane, inclined at beta; (p, q) is any vector along that
axis, tan(beta) = p/q, which raceway control supplies. No slip at the centre of both contacts (Jones 1960; the source
omits the derivation), g = D/dm, Delta = omega_i - omega_o:

    outer   (omega_o - omega_m) a =  omega_R g (q cos ao + p sin ao)/|(p, q)|        a = 1 + g cos ao
    inner   (omega_i - omega_m) b = -omega_R g (q cos ai + p sin ai)/|(p, q)|        b = 1 - g cos ai

hence, with u = q cos ao + p sin ao, v = q cos ai + p sin ai and S = a v + b u,

    omega_m = (omega_i b u + omega_o a v)/S          omega_R = -Delta |(p, q)| a b/(g S)

so a ball under a turning inner ring rolls backwards: omega_R < 0. Only p and q themselves enter, never their
quotient: the attitude may pass through 90 degrees.
"""

from __future__ import annotations

from math import atan2, cos, sin

from qsbearing.model.compiler.compiled import inlined

# A ball that has lost the inner raceway goes over to the orbit of equal contact angles within a gap of this part of the
# inner line's free length. A choice: a jump would leave some balls without an equilibrium on either side of it; over
# one to five hundredths as many random scenes are solved as without any such orbit.
LOSING = 0.02


@inlined
def is_seen_itself(si: float, ci: float, so: float, co: float, approach: float) -> bool:
    """Whether rolling sees the inner contact line as it is: pressed, and no more than a right angle off the outer."""
    return bool(approach >= 0.0 and si * so + ci * co >= 0.0)


@inlined
def inner_line(
    si: float, ci: float, so: float, co: float, approach: float, length: float
) -> tuple[float, float, float, float, float]:
    """The inner contact line as rolling sees it: (sine, cosine, derivatives of its angle by ai, ao and approach).

    A pressed contact's is its own, at ai. A ball that has lost the inner raceway has no contact line there: it goes
    with the others at the orbit of equal contact angles, as if its inner line were the outer one. Between the two, with
    t = gap/(LOSING length), the line seen lies at ao + w (ai - ao), w = 1 - 3 t^2 + 2 t^3.

    Lines are never seen more than a right angle apart: at two right angles the speeds would have no bound. Beyond one,
    180 degrees less ai - ao takes its place, which iterations may pass through; an equilibrium there is refused.
    """
    if is_seen_itself(si, ci, so, co, approach):
        return si, ci, 1.0, 0.0, 0.0
    along = si * so + ci * co
    if approach >= 0.0:
        return si - 2.0 * along * so, ci - 2.0 * along * co, -1.0, 2.0, 0.0
    lost = -approach / (LOSING * length)
    if lost >= 1.0:
        return so, co, 0.0, 1.0, 0.0
    weight = 1.0 - lost * lost * (3.0 - 2.0 * lost)
    between = atan2(si * co - ci * so, abs(along))
    turn_s, turn_c = sin(weight * between), cos(weight * between)
    slope = 6.0 * lost * (1.0 - lost) / (LOSING * length) * between
    by_inner = weight if along >= 0.0 else -weight
    return so * turn_c + co * turn_s, co * turn_c - so * turn_s, by_inner, 1.0 - by_inner, slope


@inlined
def rolling_terms(
    g: float, si: float, ci: float, so: float, co: float, axis: tuple[float, ...]
) -> tuple[float, float, float, float, float, float, float, float, float, float]:
    """(a v, b u, then their derivatives by ai and by ao, then a b and its two derivatives, and S)."""
    p, q, p_i, q_i, p_o, q_o = axis
    a, a_o = 1.0 + g * co, -g * so
    b, b_i = 1.0 - g * ci, g * si
    u, u_i, u_o = q * co + p * so, q_i * co + p_i * so, q_o * co + p_o * so - q * so + p * co
    v, v_i, v_o = q * ci + p * si, q_i * ci + p_i * si - q * si + p * ci, q_o * ci + p_o * si
    av, av_i, av_o = a * v, a * v_i, a_o * v + a * v_o
    bu, bu_i, bu_o = b * u, b_i * u + b * u_i, b * u_o
    return av, av_i, av_o, bu, bu_i, bu_o, a * b, a * b_i, a_o * b, av + bu


@inlined
def orbital_speed(terms: tuple[float, ...], inner_speed: float, outer_speed: float) -> tuple[float, float, float]:
    """omega_m, the speed of the ball's centre about the bearing axis, and its derivatives by ai and ao."""
    av, av_i, av_o, bu, bu_i, bu_o, _, _, _, S = terms
    inverse = 1.0 / S
    speed = (inner_speed * bu + outer_speed * av) * inverse
    by_inner = (inner_speed * bu_i + outer_speed * av_i - speed * (av_i + bu_i)) * inverse
    by_outer = (inner_speed * bu_o + outer_speed * av_o - speed * (av_o + bu_o)) * inverse
    return speed, by_inner, by_outer


@inlined
def rotation_per_axis_length(
    terms: tuple[float, ...], g: float, inner_speed: float, outer_speed: float
) -> tuple[float, float, float]:
    """omega_R/|(p, q)| and its derivatives by ai and ao; times p it is omega_R sin(beta)."""
    _, av_i, av_o, _, bu_i, bu_o, ab, ab_i, ab_o, S = terms
    inverse = 1.0 / S
    factor = (outer_speed - inner_speed) * inverse / g
    value = factor * ab
    relative = value * inverse
    return value, factor * ab_i - relative * (av_i + bu_i), factor * ab_o - relative * (av_o + bu_o)
