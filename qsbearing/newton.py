"""Newton's method on ring and balls together, with exact derivatives.

Each ball's two unknowns are eliminated where the ball is evaluated (a 2 x 2 block), which leaves a system of the ring's
free channels; the balls' steps follow from the ring's. Nothing is nested and nothing is differenced.
"""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.ball import moving_ball
from qsbearing.compiled import kernel
from qsbearing.linear import solve_in_place
from qsbearing.ring import add_ball, channel_scale, inner_groove_centre, start_sums

# A step may turn no contact line by much more than this (radians, roughly): beyond, the tangents say little.
LARGEST_TURN = 0.6
# The largest approach may grow by this part unchecked: below, shortening the step costs more than it saves.
GROWTH_UNCHECKED = 0.3
# Where rounding forbids the tolerance, this relative residual still counts as solved.
STALLED = 1e-10
# No solution worth having lies this many ball diameters (or radians) away.
FARTHEST = 2.0
# From a fair start five to ten do; past this the safety net is cheaper.
MOST = 30


@kernel
def applied_load(case: recarray) -> float:
    """The largest load prescribed in any channel, moments over the pitch radius."""
    largest = 0.0
    for i in range(5):
        if not case.is_held[i]:
            largest = max(largest, abs(case.prescribed[i]) / channel_scale(case, i))
    return largest


@kernel
def any_held(case: recarray) -> bool:
    """Whether some channel's displacement is prescribed."""
    for i in range(5):
        if case.is_held[i]:
            return True
    return False


@kernel
def pass_over_balls(case: recarray, ring: recarray, balls: ndarray) -> tuple[float, float]:
    """Evaluate all balls where they are: (largest imbalance, largest force).

    Leaves the condensed system in the ring. The largest force is over applied and inertial ones, and over contact
    loads where a displacement is prescribed, since then they are the reaction.
    """
    start_sums(case, ring)
    worst, total = 0.0, 0.0
    inertial, contact = 0.0, 0.0
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        r1, r2, load, fc, friction = moving_ball(case, ball, a1, a2, ring.floor)
        worst = max(worst, abs(r1), abs(r2))
        total += r1 + r2
        inertial = max(inertial, fc, friction)
        contact = max(contact, load)
        add_ball(ring, ball)
    for p in range(ring.channels):
        lever = channel_scale(case, ring.channel[p])
        ring.matrix[p, p] += ring.floor * lever * lever
        worst = max(worst, abs(ring.imbalance[p]) / lever)
        total += ring.imbalance[p]
    if not abs(total) < inf:  # a maximum passes over what is not a number; a sum does not
        worst = inf
    scale = max(applied_load(case), inertial)
    if any_held(case):
        scale = max(scale, contact)
    return worst, scale


@kernel
def newton_step(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Solve the condensed system for the steps of ring and balls.

    Returns the largest displacement of any centre by the step; negative where the system is singular.
    """
    if not solve_in_place(ring.matrix, ring.right, ring.channels):
        return -1.0
    for i in range(5):
        ring.step[i] = 0.0
    for p in range(ring.channels):
        ring.step[ring.channel[p]] = -ring.right[p]
    largest = 0.0
    for n in range(ring.balls):
        ball = balls[n]
        da1, da2 = inner_groove_centre(case, ring.step, ball.cosine, ball.sine)
        ball.du1 = -ball.y1 - ball.y11 * da1 - ball.y12 * da2
        ball.du2 = -ball.y2 - ball.y21 * da1 - ball.y22 * da2
        largest = max(largest, abs(ball.du1), abs(ball.du2), abs(da1), abs(da2))
    return largest


@kernel
def growth(ring: recarray, balls: ndarray) -> float:
    """By how much the step would raise the largest approach of the outer contacts, relative to it."""
    before, after = 0.0, 0.0
    for n in range(ring.balls):
        ball = balls[n]
        before = max(before, ball.outer_approach)
        after = max(after, ball.outer_approach + ball.outer_sine * ball.du1 + ball.outer_cosine * ball.du2)
    return after / before - 1.0 if before > 0.0 else 0.0


@kernel
def move(ring: recarray, balls: ndarray, fraction: float) -> None:
    """Take the fraction of the step.

    A ball moves in polar coordinates about the outer groove's centre: along its contact line by the step's part
    along it, and round the centre by the angle of the rest. A straight step across the line would leave the groove by
    its square, which at a turn of a few degrees is more than the whole approach.
    """
    for i in range(5):
        ring.displacement[i] += fraction * ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        so, co, inverse = ball.outer_sine, ball.outer_cosine, ball.outer_inverse
        d1, d2 = fraction * ball.du1, fraction * ball.du2
        longer = so * d1 + co * d2
        half_turn = 0.5 * inverse * (co * d1 - so * d2)
        # n turned by 2 atan(half_turn), without trigonometry: what is added to n along n and along t.
        across = 2.0 * half_turn / (1.0 + half_turn * half_turn)
        along = -half_turn * across
        distance = 1.0 / inverse + longer if inverse > 0.0 else 0.0
        ball.u1 += longer * so + distance * (along * so + across * co)
        ball.u2 += longer * co + distance * (along * co - across * so)


@kernel
def newton(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Iterate in place from where ring and balls are: (converged, iterations, relative residual).

    No step is refused: from a fair start this converges in five to ten iterations, often through a larger imbalance,
    which a monotone rule would forbid. A step is shortened where it would turn a contact line too far, and where it
    would raise the largest approach, since loads grow with its power 1.5: the load that the tangent promises is
    reached by a smaller approach. Where all this does not converge, the safety net takes over.
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    iterations = 0
    before = -1.0
    while True:
        worst, scale = pass_over_balls(case, ring, balls)
        if worst <= tolerance * scale:
            return True, iterations, worst / scale if scale > 0.0 else 0.0
        # The limit of rounding: no step helps any more, and what stands is good.
        if 0.0 <= before <= STALLED * scale and worst >= 0.5 * before:
            return worst <= STALLED * scale, iterations, worst / scale
        if iterations == MOST:
            return False, iterations, worst / scale if scale > 0.0 else 1.0
        largest = newton_step(case, ring, balls)
        if not 0.0 <= largest < FARTHEST:  # nothing resists, or not a number
            return False, iterations, 1.0
        fraction = 1.0 if largest <= LARGEST_TURN * length else LARGEST_TURN * length / largest
        x = growth(ring, balls)
        if x > GROWTH_UNCHECKED:
            fraction = min(fraction, ((1.0 + 1.5 * x) ** (2.0 / 3.0) - 1.0) / x)
        before = worst
        move(ring, balls, fraction)
        iterations += 1
        for i in range(5):
            if not abs(ring.displacement[i]) < FARTHEST:
                return False, iterations, 1.0
