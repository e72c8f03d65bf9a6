"""Newton's method on ring and balls together, with exact derivatives.

Each ball's two unknowns are eliminated where the ball is evaluated (a 2 x 2 block), which leaves a system of the ring's
free channels; the balls' steps follow from the ring's. Nothing is nested and nothing is differenced.
"""

from __future__ import annotations

from numpy import ndarray

from qsbearing.ball import moving_ball
from qsbearing.compiled import kernel
from qsbearing.linear import solve_in_place
from qsbearing.ring import Workspace, add_ball, channel_scale, clear, inner_groove_centre

# A step may turn no contact line by much more than this (radians, roughly): beyond, the tangents say little.
LARGEST_TURN = 0.6
# The largest approach may grow by this part unchecked: below, shortening the step costs more than it saves.
GROWTH_UNCHECKED = 0.3
# Where rounding forbids the tolerance, this relative residual still counts as solved.
STALLED = 1e-10


@kernel
def applied_load(case: ndarray) -> float:
    """The largest load prescribed in any channel, moments over the pitch radius."""
    largest = 0.0
    for i in range(5):
        if not case.is_held[i]:
            largest = max(largest, abs(case.prescribed[i]) / channel_scale(case, i))
    return largest


@kernel
def any_held(case: ndarray) -> bool:
    """Whether some channel's displacement is prescribed."""
    for i in range(5):
        if case.is_held[i]:
            return True
    return False


@kernel
def pass_over_balls(
    case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, channels: int, floor: float
) -> tuple[float, float]:
    """Evaluate all balls at (ring, position): (largest imbalance, largest force).

    Leaves the condensed ring system in the workspace. The largest force is over applied and inertial ones, and over
    contact loads where a displacement is prescribed, since then they are the reaction.
    """
    clear(case, w, channels)
    worst = 0.0
    inertial, contact = 0.0, 0.0
    for n in range(balls):
        j = w.ball[n]
        a1, a2 = inner_groove_centre(case, ring, w.cosine[j], w.sine[j])
        h = w.condensed[n]
        r1, r2, load, fc, friction = moving_ball(case, w.control[j], a1, a2, position[j, 0], position[j, 1], floor, h)
        worst = max(worst, abs(r1), abs(r2))
        inertial = max(inertial, fc, friction)
        contact = max(contact, load)
        add_ball(w, n, h, channels)
    for p in range(channels):
        lever = channel_scale(case, w.channel[p])
        w.matrix[p, p] += floor * lever * lever
        worst = max(worst, abs(w.imbalance[p]) / lever)
    scale = max(applied_load(case), inertial)
    if any_held(case):
        scale = max(scale, contact)
    return worst, scale


@kernel
def newton_step(case: ndarray, w: Workspace, balls: int, channels: int) -> float:
    """Solve the condensed system; steps of ring and balls into the workspace.

    Returns the largest displacement of any centre by the step; negative where the system is singular.
    """
    if not solve_in_place(w.matrix, w.right, channels):
        return -1.0
    for i in range(5):
        w.ring_step[i] = 0.0
    for p in range(channels):
        w.ring_step[w.channel[p]] = -w.right[p]
    largest = 0.0
    for n in range(balls):
        j = w.ball[n]
        da1, da2 = inner_groove_centre(case, w.ring_step, w.cosine[j], w.sine[j])
        h = w.condensed[n]
        w.step[n, 0] = -h[12] - h[14] * da1 - h[15] * da2
        w.step[n, 1] = -h[13] - h[16] * da1 - h[17] * da2
        largest = max(largest, abs(w.step[n, 0]), abs(w.step[n, 1]), abs(da1), abs(da2))
    return largest


@kernel
def growth(w: Workspace, balls: int) -> float:
    """By how much the step would raise the largest approach of the outer contacts, relative to it."""
    before, after = 0.0, 0.0
    for n in range(balls):
        h = w.condensed[n]
        before = max(before, h[21])
        after = max(after, h[21] + h[18] * w.step[n, 0] + h[19] * w.step[n, 1])
    return after / before - 1.0 if before > 0.0 else 0.0


@kernel
def move(w: Workspace, ring: ndarray, position: ndarray, balls: int, fraction: float) -> None:
    """Take the fraction of the step.

    A ball moves in polar coordinates about the outer groove's centre: along its contact line by the step's part
    along it, and round the centre by the angle of the rest. A straight step across the line would leave the groove by
    its square, which at a turn of a few degrees is more than the whole approach.
    """
    for i in range(5):
        ring[i] += fraction * w.ring_step[i]
    for n in range(balls):
        j = w.ball[n]
        h = w.condensed[n]
        so, co, inverse = h[18], h[19], h[20]
        d1, d2 = fraction * w.step[n, 0], fraction * w.step[n, 1]
        longer = so * d1 + co * d2
        half_turn = 0.5 * inverse * (co * d1 - so * d2)
        # n turned by 2 atan(half_turn), without trigonometry: what is added to n along n and along t.
        across = 2.0 * half_turn / (1.0 + half_turn * half_turn)
        along = -half_turn * across
        distance = 1.0 / inverse + longer if inverse > 0.0 else 0.0
        position[j, 0] += longer * so + distance * (along * so + across * co)
        position[j, 1] += longer * co + distance * (along * co - across * so)


@kernel
def newton(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    floor: float,
    tolerance: float,
    most: int,
) -> tuple[bool, int, float]:
    """Iterate from (ring, position) in place: (converged, iterations, relative residual).

    No step is refused: from a fair start this converges in five to ten iterations, often through a larger imbalance,
    which a monotone rule would forbid. A step is shortened where it would turn a contact line too far, and where it
    would raise the largest approach, since loads grow with its power 1.5: the load that the tangent promises is
    reached by a smaller approach. Where all this does not converge, the safety net takes over.
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    longest = LARGEST_TURN * length
    worst, scale = pass_over_balls(case, w, ring, position, balls, channels, floor)
    for iteration in range(most):
        if worst <= tolerance * scale:
            return True, iteration, worst / scale if scale > 0.0 else 0.0
        largest = newton_step(case, w, balls, channels)
        if not 0.0 <= largest < 1e6:
            return False, iteration, 1.0
        fraction = 1.0 if largest <= longest else longest / largest
        x = growth(w, balls)
        if x > GROWTH_UNCHECKED:
            fraction = min(fraction, ((1.0 + 1.5 * x) ** (2.0 / 3.0) - 1.0) / x)
        before = worst
        move(w, ring, position, balls, fraction)
        worst, scale = pass_over_balls(case, w, ring, position, balls, channels, floor)
        # The limit of rounding: no step helps any more, and what stands is good.
        if before <= STALLED * scale and worst >= 0.5 * before:
            return worst <= STALLED * scale, iteration + 1, worst / scale
    return worst <= tolerance * scale, most, worst / scale if scale > 0.0 else 0.0
