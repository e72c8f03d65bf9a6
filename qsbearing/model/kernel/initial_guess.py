"""Initial guesses: where ring and balls are likely to be, from closed forms or from the bearing at rest.

In the spirit of (19.16)-(19.17), where "ao" means the free angle: the contact angles at speed follow from the
thrust equilibrium of one ball,

    cot ao = cot ai + Fc/q,     (Li + di) cos ai + (Lo + do) cos ao = BD cos a0,     d = (q/(K sin a))^(2/3),

q being the axial load a ball. At rest ao = ai and the two relations are the usual ones of a thrust-loaded bearing.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.contact.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.model.effects.raceway_control import INNER, OUTER
from qsbearing.model.kernel.assembly import applied_load, set_at_rest
from qsbearing.model.kernel.ball_inertia import inertia, is_moving
from qsbearing.model.kernel.contact_line import direction
from qsbearing.model.kernel.loop_closure import set_inner_line, set_outer_line
from qsbearing.model.kernel.newton import newton_at_rest
from qsbearing.model.kernel.raceway_stiffness import groove_stiffness, series_stiffness
from qsbearing.model.kernel.ring import channel_lever, inner_groove_centre
from qsbearing.model.kernel.ring_bending import reset_deflections
from qsbearing.model.kernel.unloaded_ball import place_unloaded

# Side loads this many times the axial load still leave a ball at speed more like one under thrust than one at rest
# (a choice: it orders two starts, each of which is tried).
THRUST_REACH = 5.0
# How well the equilibrium at rest must be known for Newton's method at speed to start from it: Newton is quadratic.
GUESS_TOLERANCE = 1e-3


@kernel
def thrust_at_rest(case: recarray, axial_load: float) -> float:
    """Axial displacement of the ring at rest under pure thrust, to a few per cent."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    q = abs(axial_load) / (case.ball_count * case.series_stiffness)
    if case.interference > 0.0:
        # Wedged balls: the line grows by h beyond the interference e, sin a = sqrt(2 h/l), q = (e + h)^(3/2) sin a.
        by_wedge = 0.5 * length * q * q / (case.interference * case.interference * case.interference)
        size = length * sqrt(2.0 * min(by_wedge, sqrt(q * sqrt(0.5 * length))) / length)
        return size if axial_load >= 0.0 else -size
    # Near a0 = 0 the angle is made by the load: sin a = sqrt(2 d/l), q = d^(3/2) sin a.
    sine = max(case.sin_free, (q * sqrt(2.0 / length)) ** 0.25 * sqrt(sqrt(2.0 / length)))
    approach = 0.0
    for _ in range(4):
        approach = (q / sine) ** (2.0 / 3.0)
        cosine = case.cos_free * length / (length + approach)
        sine = sqrt(max(1.0 - cosine * cosine, 1e-12))
    size = (length + approach) * sine
    return (size if axial_load >= 0.0 else -size) - length * case.sin_free


@kernel
def guess_ring_at_rest(case: recarray, work: recarray) -> None:
    """First displacement of the ring at rest, to be improved by descent."""
    for i in range(5):
        work.displacement[i] = case.prescribed[i] if case.displacement_given[i] else 0.0
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    radial = 0.0
    for i in range(1, 3):
        if not case.displacement_given[i]:
            radial += case.prescribed[i] * case.prescribed[i]
    for i in range(3, 5):
        if not case.displacement_given[i]:
            moment = case.prescribed[i] / (0.5 * case.pitch_diameter)
            radial += moment * moment
    radial = work.load_factor * sqrt(radial)
    thrust = work.load_factor * case.prescribed[0]
    is_pressed_outward = case.centrifugal and is_moving(case)
    if not case.displacement_given[0] and (thrust != 0.0 or radial > 0.0 or is_pressed_outward):
        # Without thrust the balls carry where the axial forces cancel, at angle zero, or leave the ring alone.
        work.displacement[0] = thrust_at_rest(case, thrust) if thrust != 0.0 else -length * case.sin_free
    # How far the ring must go sideways until balls touch, at its axial position.
    axial = length * case.sin_free + work.displacement[0]
    gap = max(sqrt(max(length * length - axial * axial, 0.0)) - length * case.cos_free - case.interference, 0.0)
    if (thrust != 0.0 and not case.displacement_given[0]) or is_pressed_outward:
        gap = 0.0
    if radial > 0.0:
        # Stribeck's largest ball load, 4.37 Fr/Z, if little else holds the ring.
        size = gap + (4.37 * radial / (case.ball_count * case.series_stiffness)) ** (2.0 / 3.0)
        for i in range(1, 3):
            if not case.displacement_given[i]:
                work.displacement[i] = size * work.load_factor * case.prescribed[i] / radial


@kernel
def split_contacts(case: recarray, work: recarray, balls: ndarray) -> None:
    """Split the contact line of each ball at rest into two contacts, springs in series; place unloaded balls."""
    work.at_rest = False
    for n in range(work.ball_count):
        ball = balls[n]
        n1, n2, approach = ball.inner_sine, ball.inner_cosine, ball.inner_approach
        if approach > 0.0:
            ki, _ = groove_stiffness(case, ball, INNER_SIDE, n1, n2)
            ko, _ = groove_stiffness(case, ball, OUTER_SIDE, n1, n2)
            series, _ = series_stiffness(case, ball, n1, n2)
            set_outer_line(ball, n1, n2, approach * (series / ko) ** (2.0 / 3.0))
            ball.inner_approach = approach * (series / ki) ** (2.0 / 3.0)
        else:
            a1, a2 = inner_groove_centre(case, work.displacement, ball)
            place_unloaded(case, work, ball, a1, a2)


@kernel
def thrust_at_speed(case: recarray, work: recarray, control: int, axial_load: float) -> tuple[float, float, float]:
    """Ring and ball under thrust at speed, without the gyroscopic moment: (axial displacement, u1, u2).

    The two relations above, solved for t = cot ai with the elastic approaches and Fc updated in each iteration.
    """
    s, c = case.sin_free, case.cos_free
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    radial = (li + lo) * c + case.interference
    q = max(axial_load, 0.0) / case.ball_count
    ki, ko = case.inner_stiffness, case.outer_stiffness
    si, ci, so, co = s, c, s, c
    t = c / max(s, 0.05)
    s_first = max(s, 0.05)
    si, so = s_first, s_first
    di, do = 0.0, 0.0
    for _ in range(5):
        fc, _, _, _, _, _ = inertia(case, work, control, si, ci, so, co)
        ratio = fc / q
        di, do = (q / (si * ki)) ** (2.0 / 3.0), (q / (so * ko)) ** (2.0 / 3.0)
        ri, ro = sqrt(1.0 + t * t), sqrt(1.0 + (t + ratio) * (t + ratio))
        value = (li + di) * t / ri + (lo + do) * (t + ratio) / ro - radial
        slope = (li + di) / (ri * ri * ri) + (lo + do) / (ro * ro * ro)
        t = max(t - value / slope, 0.02)
        ri, ro = sqrt(1.0 + t * t), sqrt(1.0 + (t + ratio) * (t + ratio))
        si, ci, so, co = 1.0 / ri, t / ri, 1.0 / ro, (t + ratio) / ro
    x1, x2 = (lo + do) * so, (lo + do) * co
    return (li + di) * si + x1 - (li + lo) * s, x1 - lo * s, x2 - lo * c


@kernel
def guess_closed_form(case: recarray, work: recarray, balls: ndarray) -> None:
    """Place ring and balls for Newton's first iteration, by closed forms alone.

    Under thrust every ball starts in the equilibrium of thrust at speed, whatever else moves its inner groove: Newton
    closes the loop. Otherwise balls start as they would lie at rest.
    """
    reset_deflections(work, balls)
    if not is_thrust_like(case):
        guess_ring_at_rest(case, work)
        set_at_rest(case, work, balls)
        split_contacts(case, work, balls)
    else:
        guess_thrust(case, work, balls)


@kernel
def guess_thrust(case: recarray, work: recarray, balls: ndarray) -> None:
    """Place ring and balls as the axial load alone would."""
    x, u1, u2 = thrust_at_speed(case, work, balls[0].control, work.load_factor * case.prescribed[0])
    s, c = case.sin_free, case.cos_free
    outer_approach, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
    inner_approach, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, x - u1, -u2)
    for i in range(5):
        work.displacement[i] = case.prescribed[i] if case.displacement_given[i] else 0.0
    work.displacement[0] = x
    for n in range(work.ball_count):
        set_outer_line(balls[n], so, co, outer_approach)
        set_inner_line(balls[n], si, ci, inner_approach)


@kernel
def is_thrust_like(case: recarray) -> bool:
    """Whether the axial load shapes the balls' equilibrium at speed more than radial loads and moments do."""
    if case.displacement_given[0] or case.prescribed[0] <= 0.0:
        return False
    side = 0.0
    for i in range(1, 5):
        if not case.displacement_given[i]:
            value = case.prescribed[i] / channel_lever(case, i)
            side += value * value
    return sqrt(side) < THRUST_REACH * case.prescribed[0]


@kernel
def is_load_dominant(case: recarray, work: recarray) -> bool:
    """Whether loads shape the balls' equilibrium at speed more than inertia does."""
    s, c = case.sin_free, case.cos_free
    fc, _, _, mg, _, _ = inertia(case, work, INNER if case.control == INNER else OUTER, s, c, s, c)
    return applied_load(case, work) > case.ball_count * max(fc, abs(mg))


@kernel
def guess_from_rest(case: recarray, work: recarray, balls: ndarray) -> None:
    """Put balls at speed where they lie at rest under the loads that act, to GUESS_TOLERANCE."""
    reset_deflections(work, balls)
    guess_ring_at_rest(case, work)
    newton_at_rest(case, work, balls, GUESS_TOLERANCE)
    split_contacts(case, work, balls)
