"""The safety net: descent on a convex energy, which cannot fail to reach its minimum.

With every ball's inertia force f frozen, equilibrium is the stationarity of

    Pi(d, X) = sum over balls [2/5 Ki <|A(d) - X| - Li>^(5/2) + 2/5 Ko <|X| - Lo>^(5/2) - f.X] - F.d

(<x> = max(x, 0)). A(d) is affine, a norm is convex, <x>^(5/2) is convex and grows: Pi is jointly convex in ring and
balls, and lost contacts are ordinary points of it. Along any line its slope only rises, so a line search by slopes,
free of the cancellation that differences of energies suffer, always finds its step. At rest f = 0, both contacts of
a ball are springs in series and X has a closed form: the ring's channels are all that is left.
"""

from __future__ import annotations

from numpy import ndarray

from qsbearing.ball import inertia, resting_ball
from qsbearing.compiled import kernel
from qsbearing.contact import contact_load, contact_tangent, direction
from qsbearing.effects.gyroscopic_moment import moment_shares
from qsbearing.newton import STALLED, any_held, applied_load, newton_step
from qsbearing.raceway_control import INNER
from qsbearing.ring import Workspace, add_ball, channel_scale, clear, inner_groove_centre

# A ball's force below this part of the load is beneath the solver's own tolerance.
LEAST_BALL_FORCE = 1e-10


@kernel
def freeze(case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, blend: float) -> None:
    """Take each ball's inertia force, and what its friction does to the ring, from its present angles.

    A blend below 1 moves the frozen forces only part of the way to their present values.
    """
    s, c = case.sin_free, case.cos_free
    for n in range(balls):
        j = w.ball[n]
        a1, a2 = inner_groove_centre(case, ring, w.cosine[j], w.sine[j])
        u1, u2 = position[j, 0], position[j, 1]
        _, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
        _, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - u1, a2 - u2)
        fc, _, _, mg, _, _ = inertia(case, w.control[j], si, ci, so, co)
        share_i, share_o = moment_shares(case.shares, w.control[j] == INNER)
        ti, to = share_i * mg, share_o * mg
        frozen = w.inertia[j]
        _blend_into(frozen, 0, -ti * ci + to * co, blend)
        _blend_into(frozen, 1, ti * si - to * so + fc, blend)
        _blend_into(frozen, 2, -ti * ci, blend)
        _blend_into(frozen, 3, ti * si, blend)
        _blend_into(frozen, 4, -case.tilt_lever * ti * ci + case.inner_coefficient * ti, blend)


@kernel
def _blend_into(frozen: ndarray, k: int, value: float, blend: float) -> None:
    if blend == 1.0:  # nothing of an earlier case may shine through
        frozen[k] = value
    else:
        frozen[k] += blend * (value - frozen[k])


@kernel
def frozen_ball(
    case: ndarray, frozen: ndarray, a1: float, a2: float, u1: float, u2: float, floor: float, h: ndarray
) -> tuple[float, float, float]:
    """One ball under its frozen force: fills its condensed system (symmetric); (r1, r2, largest contact load)."""
    s, c = case.sin_free, case.cos_free
    delta_o, so, co, inverse_o = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
    delta_i, si, ci, inverse_i = direction(case.inner_coefficient - 0.5, s, c, a1 - u1, a2 - u2)
    qi, qi_slope = contact_load(case.inner_stiffness, delta_i)
    qo, qo_slope = contact_load(case.outer_stiffness, delta_o)
    r1, r2 = qi * si - qo * so + frozen[0], qi * ci - qo * co + frozen[1]
    i11, i12, i22 = contact_tangent(qi, qi_slope, si, ci, inverse_i)
    o11, o12, o22 = contact_tangent(qo, qo_slope, so, co, inverse_o)
    # dr/dX = -(Hi + Ho): never singular, for the floor; dr/dA = Hi.
    s11, s12, s22 = i11 + o11 + floor, i12 + o12, i22 + o22 + floor
    inverse = -1.0 / (s11 * s22 - s12 * s12)
    y1, y2 = (s22 * r1 - s12 * r2) * inverse, (s11 * r2 - s12 * r1) * inverse
    y11, y12 = (s22 * i11 - s12 * i12) * inverse, (s22 * i12 - s12 * i22) * inverse
    y21, y22 = (s11 * i12 - s12 * i11) * inverse, (s11 * i22 - s12 * i12) * inverse
    lever = case.tilt_lever
    h[0], h[1] = qi * si + frozen[2], qi * ci + frozen[3]
    h[2] = lever * qi * si + frozen[4]
    h[3], h[4] = h[0] + i11 * y1 + i12 * y2, h[1] + i12 * y1 + i22 * y2
    h[5] = h[2] + lever * (i11 * y1 + i12 * y2)
    h[6], h[7] = i11 + i11 * y11 + i12 * y21, i12 + i11 * y12 + i12 * y22
    h[8], h[9] = i12 + i12 * y11 + i22 * y21, i22 + i12 * y12 + i22 * y22
    h[10], h[11] = lever * h[6], lever * h[7]
    h[12], h[13], h[14], h[15], h[16], h[17] = y1, y2, y11, y12, y21, y22
    h[18], h[19], h[20], h[21] = so, co, inverse_o, delta_o
    return r1, r2, max(qi, qo)


@kernel
def convex_pass(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    floor: float,
    at_rest: bool,
) -> float:
    """Evaluate the convex problem, its condensed system left in the workspace: the largest relative imbalance.

    The ring's is relative to the largest force, a ball's to its own: a ball thrown into the corner between its grooves
    by a ten-millionth of the load must find that corner before Newton can take over.
    """
    clear(case, w, channels)
    applied = applied_load(case)
    least = LEAST_BALL_FORCE * applied
    worst, contact, inertial = 0.0, 0.0, 0.0
    for n in range(balls):
        j = w.ball[n]
        a1, a2 = inner_groove_centre(case, ring, w.cosine[j], w.sine[j])
        h = w.condensed[n]
        r1, r2 = 0.0, 0.0
        if at_rest:
            contact = max(contact, resting_ball(case, a1, a2, h))
        else:
            frozen = w.inertia[j]
            r1, r2, load = frozen_ball(case, frozen, a1, a2, position[j, 0], position[j, 1], floor, h)
            own = max(abs(frozen[0]), abs(frozen[1]))
            inertial = max(inertial, own)
            contact = max(contact, load)
            imbalance = max(abs(r1), abs(r2))
            if imbalance > 0.0:
                worst = max(worst, imbalance / max(own, load, least))
        w.ball_imbalance[n, 0], w.ball_imbalance[n, 1] = r1, r2
        add_ball(w, n, h, channels)
    scale = max(applied, inertial, contact if any_held(case) else 0.0)
    for p in range(channels):
        lever = channel_scale(case, w.channel[p])
        imbalance = abs(w.imbalance[p]) / lever
        if imbalance > 0.0:
            worst = max(worst, imbalance / scale if scale > 0.0 else 1.0)
        w.matrix[p, p] += floor * lever * lever  # as for a ball: a channel that nothing resists keeps a step
    return worst


@kernel
def remember(w: Workspace, ring: ndarray, position: ndarray, balls: int) -> None:
    """Keep where ring and balls are, before a step."""
    for i in range(5):
        w.ring_before[i] = ring[i]
    for n in range(balls):
        j = w.ball[n]
        w.before[n, 0], w.before[n, 1] = position[j, 0], position[j, 1]


@kernel
def move_straight(w: Workspace, ring: ndarray, position: ndarray, balls: int, fraction: float) -> None:
    """Put ring and balls at the fraction of the step: along a line, on which Pi is convex."""
    for i in range(5):
        ring[i] = w.ring_before[i] + fraction * w.ring_step[i]
    for n in range(balls):
        j = w.ball[n]
        position[j, 0] = w.before[n, 0] + fraction * w.step[n, 0]
        position[j, 1] = w.before[n, 1] + fraction * w.step[n, 1]


@kernel
def slope_along_step(w: Workspace, balls: int, channels: int) -> float:
    """dPi/dt of the last pass's point along the workspace's step."""
    slope = 0.0
    for n in range(balls):
        slope -= w.weight[n] * (w.ball_imbalance[n, 0] * w.step[n, 0] + w.ball_imbalance[n, 1] * w.step[n, 1])
    for p in range(channels):
        slope += w.imbalance[p] * w.ring_step[w.channel[p]]
    return slope


@kernel
def search_line(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    floor: float,
    tolerance: float,
    at_rest: bool,
    fraction: float,
    first: float,
) -> float:
    """Go along the step until its slope is at most half the first, by secants on the rising slope.

    Returns the relative imbalance where it stops.
    """
    low, slope_low, high, slope_high = 0.0, first, -1.0, 0.0
    worst = 1.0
    for _ in range(60):
        move_straight(w, ring, position, balls, fraction)
        worst = convex_pass(case, w, ring, position, balls, channels, floor, at_rest)
        slope = slope_along_step(w, balls, channels)
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
def descend(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    floor: float,
    tolerance: float,
    most: int,
    at_rest: bool,
) -> tuple[bool, int, float]:
    """Minimise Pi from (ring, position), in place: (converged, iterations, relative residual)."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    worst = convex_pass(case, w, ring, position, balls, channels, floor, at_rest)
    for iteration in range(most):
        if worst <= tolerance:
            return True, iteration, worst
        largest = newton_step(case, w, balls, channels)
        if largest < 0.0:
            return False, iteration, worst
        first = slope_along_step(w, balls, channels)
        remember(w, ring, position, balls)
        before = worst
        fraction = 1.0 if largest <= length else length / largest
        worst = search_line(case, w, ring, position, balls, channels, floor, tolerance, at_rest, fraction, first)
        if worst >= before and before <= STALLED:  # the limit of rounding
            move_straight(w, ring, position, balls, 0.0)
            worst = convex_pass(case, w, ring, position, balls, channels, floor, at_rest)
            return True, iteration, worst
    return worst <= STALLED, most, worst
