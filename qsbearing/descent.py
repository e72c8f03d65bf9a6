"""The safety net: descent on a convex energy, which cannot fail to reach its minimum.

With every ball's inertia force f frozen, equilibrium is the stationarity of

    Pi(d, X) = sum over balls [2/5 Ki <|A(d) - X| - Li>^(5/2) + 2/5 Ko <|X| - Lo>^(5/2) - f.X] - F.d

(<x> = max(x, 0)). A(d) is affine, a norm is convex, <x>^(5/2) is convex and grows: Pi is jointly convex in ring and
balls, and lost contacts are ordinary points of it. Along any line its slope only rises, so a line search by slopes,
free of the cancellation that differences of energies suffer, always finds its step. At rest f = 0, both contacts of
a ball are springs in series and X has a closed form: the ring's channels are all that is left.
"""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.ball import inertia, resting_ball
from qsbearing.compiled import kernel
from qsbearing.contact import contact_load, contact_tangent, direction
from qsbearing.effects.gyroscopic_moment import moment_shares
from qsbearing.newton import STALLED, any_held, applied_load, newton_step
from qsbearing.raceway_control import INNER
from qsbearing.ring import add_ball, channel_scale, inner_groove_centre, start_sums

# A ball's force below this part of the load is beneath the solver's own tolerance.
LEAST_BALL_FORCE = 1e-10
MOST = 200


@kernel
def freeze(case: recarray, ring: recarray, balls: ndarray, blend: float) -> None:
    """Take each ball's inertia force, and what its friction does to the ring, from its present angles.

    A blend below 1 moves the frozen forces only part of the way to their present values.
    """
    s, c = case.sin_free, case.cos_free
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        _, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, ball.u1, ball.u2)
        _, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - ball.u1, a2 - ball.u2)
        fc, _, _, mg, _, _ = inertia(case, ball.control, si, ci, so, co)
        share_i, share_o = 0.0, 0.0
        if case.gyroscopic:
            share_i, share_o = moment_shares(case.shares, ball.control == INNER)
        ti, to = share_i * mg, share_o * mg
        present = (
            -ti * ci + to * co,
            ti * si - to * so + fc,
            -ti * ci,
            ti * si,
            -case.tilt_lever * ti * ci + case.inner_coefficient * ti,
        )
        for k in range(5):
            if blend == 1.0:  # nothing of an earlier case may shine through
                ball.frozen[k] = present[k]
            else:
                ball.frozen[k] += blend * (present[k] - ball.frozen[k])


@kernel
def frozen_ball(case: recarray, ball: recarray, a1: float, a2: float, floor: float) -> float:
    """One ball under its frozen force: fills its record (a symmetric system), returns its largest contact load."""
    s, c = case.sin_free, case.cos_free
    delta_o, so, co, inverse_o = direction(case.outer_coefficient - 0.5, s, c, ball.u1, ball.u2)
    delta_i, si, ci, inverse_i = direction(case.inner_coefficient - 0.5, s, c, a1 - ball.u1, a2 - ball.u2)
    qi, qi_slope = contact_load(case.inner_stiffness, delta_i)
    qo, qo_slope = contact_load(case.outer_stiffness, delta_o)
    r1, r2 = qi * si - qo * so + ball.frozen[0], qi * ci - qo * co + ball.frozen[1]
    i11, i12, i22 = contact_tangent(qi, qi_slope, si, ci, inverse_i)
    o11, o12, o22 = contact_tangent(qo, qo_slope, so, co, inverse_o)
    # dr/dX = -(Hi + Ho): never singular, for the floor; dr/dA = Hi.
    s11, s12, s22 = i11 + o11 + floor, i12 + o12, i22 + o22 + floor
    inverse = -1.0 / (s11 * s22 - s12 * s12)
    y1, y2 = (s22 * r1 - s12 * r2) * inverse, (s11 * r2 - s12 * r1) * inverse
    y11, y12 = (s22 * i11 - s12 * i12) * inverse, (s22 * i12 - s12 * i22) * inverse
    y21, y22 = (s11 * i12 - s12 * i11) * inverse, (s11 * i22 - s12 * i12) * inverse
    lever = case.tilt_lever
    ball.force[0], ball.force[1] = qi * si + ball.frozen[2], qi * ci + ball.frozen[3]
    ball.force[2] = lever * qi * si + ball.frozen[4]
    ball.condensed[0] = ball.force[0] + i11 * y1 + i12 * y2
    ball.condensed[1] = ball.force[1] + i12 * y1 + i22 * y2
    ball.condensed[2] = ball.force[2] + lever * (i11 * y1 + i12 * y2)
    k11, k12 = i11 + i11 * y11 + i12 * y21, i12 + i11 * y12 + i12 * y22
    ball.stiffness[0, 0], ball.stiffness[0, 1] = k11, k12
    ball.stiffness[1, 0], ball.stiffness[1, 1] = i12 + i12 * y11 + i22 * y21, i22 + i12 * y12 + i22 * y22
    ball.stiffness[2, 0], ball.stiffness[2, 1] = lever * k11, lever * k12
    ball.y1, ball.y2, ball.y11, ball.y12, ball.y21, ball.y22 = y1, y2, y11, y12, y21, y22
    ball.r1, ball.r2 = r1, r2
    return max(qi, qo)


@kernel
def convex_pass(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Evaluate the convex problem, its condensed system left in the ring: the largest relative imbalance.

    The ring's is relative to the largest force, a ball's to its own: a ball thrown into the corner between its grooves
    by a ten-millionth of the load must find that corner before Newton can take over.
    """
    start_sums(case, ring)
    applied = applied_load(case)
    worst, contact, inertial, total = 0.0, 0.0, 0.0, 0.0
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        if ring.at_rest:
            ball.r1, ball.r2 = 0.0, 0.0
            contact = max(contact, resting_ball(case, ball, a1, a2))
        else:
            load = frozen_ball(case, ball, a1, a2, ring.floor)
            own = max(abs(ball.frozen[0]), abs(ball.frozen[1]))
            inertial = max(inertial, own)
            contact = max(contact, load)
            imbalance = max(abs(ball.r1), abs(ball.r2))
            if imbalance > 0.0:
                worst = max(worst, imbalance / max(own, load, LEAST_BALL_FORCE * applied))
        add_ball(ring, ball)
        total += ball.r1 + ball.r2
    scale = max(applied, inertial, contact if any_held(case) else 0.0)
    for p in range(ring.channels):
        lever = channel_scale(case, ring.channel[p])
        imbalance = abs(ring.imbalance[p]) / lever
        total += imbalance
        if imbalance > 0.0:
            worst = max(worst, imbalance / scale if scale > 0.0 else 1.0)
        ring.matrix[p, p] += ring.floor * lever * lever  # as for a ball: a channel that nothing resists keeps a step
    # A maximum passes over what is not a number; a sum does not.
    return worst if abs(total) < inf else inf


@kernel
def remember(ring: recarray, balls: ndarray) -> None:
    """Keep where ring and balls are, before a step."""
    for i in range(5):
        ring.before[i] = ring.displacement[i]
    for n in range(ring.balls):
        balls[n].from1, balls[n].from2 = balls[n].u1, balls[n].u2


@kernel
def move_straight(ring: recarray, balls: ndarray, fraction: float) -> None:
    """Put ring and balls at the fraction of the step: along a line, on which Pi is convex."""
    for i in range(5):
        ring.displacement[i] = ring.before[i] + fraction * ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        ball.u1 = ball.from1 + fraction * ball.du1
        ball.u2 = ball.from2 + fraction * ball.du2


@kernel
def slope_along_step(ring: recarray, balls: ndarray) -> float:
    """dPi/dt of the last pass's point along the step."""
    slope = 0.0
    for n in range(ring.balls):
        ball = balls[n]
        slope -= ball.weight * (ball.r1 * ball.du1 + ball.r2 * ball.du2)
    for p in range(ring.channels):
        slope += ring.imbalance[p] * ring.step[ring.channel[p]]
    return slope


@kernel
def search_line(case: recarray, ring: recarray, balls: ndarray, tolerance: float, fraction: float) -> float:
    """Go along the step until its slope is at most half the first, by secants on the rising slope.

    Returns the relative imbalance where it stops.
    """
    first = slope_along_step(ring, balls)
    remember(ring, balls)
    low, slope_low, high, slope_high = 0.0, first, -1.0, 0.0
    worst = 1.0
    for _ in range(60):
        move_straight(ring, balls, fraction)
        worst = convex_pass(case, ring, balls)
        slope = slope_along_step(ring, balls)
        if abs(slope) <= 0.5 * abs(first) or worst <= tolerance:
            break
        if slope < 0.0:
            low, slope_low = fraction, slope
            if high < 0.0:
                fraction *= 3.0
                continue
        else:
            high, slope_high = fraction, slope
        guess = low + (high - low) * slope_low / (slope_low - slope_high)
        margin = 0.1 * (high - low)
        fraction = min(max(guess, low + margin), high - margin)
    return worst


@kernel
def descend(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Minimise Pi in place from where ring and balls are: (converged, iterations, relative residual).

    Which Pi, `ring.at_rest` says.
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    worst = convex_pass(case, ring, balls)
    for iteration in range(MOST):
        if worst <= tolerance:
            return True, iteration, worst
        largest = newton_step(case, ring, balls)
        if largest < 0.0:
            return False, iteration, worst
        before = worst
        worst = search_line(case, ring, balls, tolerance, 1.0 if largest <= length else length / largest)
        if worst >= before and before <= STALLED:  # the limit of rounding: the step is taken back
            move_straight(ring, balls, 0.0)
            return True, iteration, before
    return worst <= STALLED, MOST, worst
