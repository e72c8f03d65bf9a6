"""Newton's method on ring and balls together, with exact derivatives, from lengths that need not yet add up.

A ball is a joint between two nearly rigid links, the contact lines: X from the outer groove's centre to the ball's, V
from the ball's to the inner groove's, and A = X + V closes the chain. Held closed at every step, the chain turns an
error of angle, s, into an error of length s^2/2, which at a turn of a few degrees is more than the whole approach of
the contacts: loads jump by powers of ten. So each link keeps a length and an angle of its own, and the gap A - X - V is
one more residual, which the linear system closes while angles and loads settle (as in mixed methods for cables). It is
closed outright as soon as it is small against the approach, so that the last steps are plain Newton on ring and balls.

Each ball's unknowns are eliminated where the ball is evaluated (a 2 x 2 block), which leaves a system of the ring's
free channels; the balls' steps follow from the ring's. Nothing is nested and nothing is differenced.
"""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.ball import close_chain, moving_ball, resting_ball, throw
from qsbearing.compiled import kernel
from qsbearing.contact import direction
from qsbearing.linear import solve_in_place
from qsbearing.ring import add_ball, channel_scale, inner_groove_centre, start_sums

# A step may turn no contact line further (radians): beyond, the tangents say little.
LARGEST_TURN = 0.5
# A step may take at most this part of a contact's approach: geometry loses it, not a tangent.
LARGEST_RELIEF = 0.9
# Loads follow the tangent down to this part of the approach lost, where 1.5 times it is still well short of all load.
LINEAR_RELIEF = 0.3
# After so many iterations a gap has had its time: the chain is held closed.
PATIENCE = 20
# A gap in the chain below this part of the approach is closed outright.
SMALL_GAP = 0.1
# Where rounding forbids the tolerance, this relative residual still counts as solved.
STALLED = 1e-10
# Loads so light that the rounding of places makes more than this part of them are not resolved.
COARSEST = 1e-6
# A ball or channel with little load beside the others' gets one step more where its imbalance is over this part of it.
OWN_TOLERANCE = 1e-11
# No solution worth having lies this many ball diameters (or radians) away.
FARTHEST = 2.0
# Of a contact's typical stiffness: far below any, it keeps a ball out of contact, or an idle channel, solvable.
FLOOR = 1e-15
# From a fair start five to ten do; past this another start is cheaper.
MOST = 40


@kernel
def attainable(ring: recarray) -> float:
    """The relative residual at which a balance that no step betters still counts as solved."""
    if ring.scale <= 0.0:
        return STALLED
    return min(max(STALLED, ring.rounding / ring.scale), COARSEST)


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
def pass_over_balls(case: recarray, ring: recarray, balls: ndarray) -> tuple[float, float, float]:
    """Evaluate all balls where they are: (largest imbalance, largest force, largest imbalance over its own load).

    Leaves the condensed system in the ring. The largest force is over applied and inertial ones, and over contact
    loads where a displacement is prescribed, since then they are the reaction.
    """
    start_sums(case, ring)
    ring.largest_approach = 0.0
    worst, worst_own, rounding, total = 0.0, 0.0, 0.0, 0.0
    inertial, contact = 0.0, 0.0
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        fc, friction = 0.0, 0.0
        if ring.at_rest:
            imbalance, load, noise = resting_ball(case, ball, a1, a2)
        else:
            imbalance, load, fc, friction, noise = moving_ball(case, ball, a1, a2, ring.floor)
        ring.largest_approach = max(ring.largest_approach, ball.inner_approach)
        worst = max(worst, imbalance)
        rounding = max(rounding, noise)
        if imbalance > worst_own * load:
            worst_own = imbalance / load if load > 0.0 else 1.0
        total += imbalance
        inertial = max(inertial, fc, friction)
        contact = max(contact, load)
        add_ball(ring, ball)
    for p in range(ring.channels):
        lever = channel_scale(case, ring.channel[p])
        ring.matrix[p, p] += ring.floor * lever * lever
        worst = max(worst, abs(ring.imbalance[p]) / lever)
        own = abs(case.prescribed[ring.channel[p]])
        if own > 0.0 and abs(ring.imbalance[p]) > worst_own * own:
            worst_own = abs(ring.imbalance[p]) / own
        total += ring.imbalance[p]
    if not abs(total) < inf:  # a maximum passes over what is not a number; a sum does not
        worst = inf
    scale = max(applied_load(case), inertial)
    if any_held(case):
        scale = max(scale, contact)
    ring.scale, ring.rounding = scale, rounding
    return worst, scale, worst_own


@kernel
def ring_step(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Solve the condensed system for the ring's step.

    Returns the largest displacement of any inner groove centre by it; negative where the system is singular.
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
        largest = max(largest, abs(da1), abs(da2))
    return largest


@kernel
def ball_steps(case: recarray, ring: recarray, balls: ndarray) -> float:
    """The balls' steps that follow from the ring's.

    Returns the largest turn of a contact line [rad] among the balls that the ring's balance needs.
    """
    largest = 0.0
    for n in range(ring.balls):
        ball = balls[n]
        da1, da2 = inner_groove_centre(case, ring.step, ball.cosine, ball.sine)
        ball.dv1, ball.dv2 = ball.gap1 + da1, ball.gap2 + da2
        outer = 0.0
        if not ring.at_rest:
            ball.du1 = -ball.y1 - ball.y11 * da1 - ball.y12 * da2
            ball.du2 = -ball.y2 - ball.y21 * da1 - ball.y22 * da2
            ball.dv1 -= ball.du1
            ball.dv2 -= ball.du2
            outer = abs(ball.outer_cosine * ball.du1 - ball.outer_sine * ball.du2) * ball.outer_inverse
        inner = abs(ball.inner_cosine * ball.dv1 - ball.inner_sine * ball.dv2) * ball.inner_inverse
        ball.turn = max(outer, inner)
        if not ball.is_idle:
            largest = max(largest, ball.turn)
    return largest


@kernel
def link_change(n1: float, n2: float, inverse: float, approach: float, d1: float, d2: float) -> tuple[float, float]:
    """How a step d changes a link: its load grows as the tangent says, its line turns by the angle the step means.

    Q grows with approach^1.5, so the load that a tangent promises is reached by a smaller approach.
    """
    longer = n1 * d1 + n2 * d2
    half_turn = 0.5 * inverse * (n2 * d1 - n1 * d2)
    if approach > 0.0:
        x = longer / approach
        if abs(x) <= LINEAR_RELIEF:  # the same to third order, without the power
            longer *= 1.0 - x * (0.25 - x / 6.0)
        elif x > 0.0:
            longer = approach * ((1.0 + 1.5 * x) ** (2.0 / 3.0) - 1.0)
        else:
            longer = max(longer, -LARGEST_RELIEF * approach)
    # n turned by 2 atan(half_turn), without trigonometry: what is added to n along n and along t.
    across = 2.0 * half_turn / (1.0 + half_turn * half_turn)
    along = -half_turn * across
    distance = 1.0 / inverse + longer if inverse > 0.0 else 0.0
    return longer * n1 + distance * (along * n1 + across * n2), longer * n2 + distance * (along * n2 - across * n1)


@kernel
def settle_link(case: recarray, ball: recarray, a1: float, a2: float, length: float, most: float) -> None:
    """Close the chain where that is safe: where the gap is small against the approach, or the contact out of touch.

    A contact that geometry brings into touch starts with the approach `most` at most.
    """
    w1, w2 = a1 - ball.u1, a2 - ball.u2
    if max(abs(w1 - ball.v1), abs(w2 - ball.v2)) < SMALL_GAP * ball.inner_approach:
        ball.v1, ball.v2 = w1, w2
        return
    s, c = case.sin_free, case.cos_free
    approach, n1, n2, inverse = direction(length, s, c, w1, w2)
    if approach <= 0.0:
        ball.v1, ball.v2 = w1, w2
    elif ball.inner_approach <= 0.0:
        # n less its free direction, from W less its free length: no difference of near-equal numbers
        first = min(approach, most)
        ball.v1 = length * inverse * (w1 - s * approach) + first * n1
        ball.v2 = length * inverse * (w2 - c * approach) + first * n2


@kernel
def move(case: recarray, ring: recarray, balls: ndarray, fraction: float, is_patient: bool) -> None:
    """Take the fraction of the step.

    An idle ball that is asked to turn far does not hold up the ring: it is put anew where it would be thrown, or if
    its grooves leave it no room for that, turned as far as tangents hold.
    """
    s, c, whole = case.sin_free, case.cos_free, case.inner_coefficient + case.outer_coefficient - 1.0
    for i in range(5):
        ring.displacement[i] += fraction * ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        part = fraction
        if ball.is_idle and ball.turn > LARGEST_TURN:
            room, _, _, _ = direction(whole, s, c, a1, a2)
            if room <= 0.0 and not ring.at_rest:
                throw(case, ball, a1, a2)
                continue
            part = min(fraction, LARGEST_TURN / ball.turn)
        length, most = whole, ring.largest_approach
        if not ring.at_rest:
            length, most = case.inner_coefficient - 0.5, ball.outer_approach
            so, co = ball.outer_sine, ball.outer_cosine
            m1, m2 = link_change(so, co, ball.outer_inverse, ball.outer_approach, part * ball.du1, part * ball.du2)
            ball.u1 += m1
            ball.u2 += m2
        si, ci = ball.inner_sine, ball.inner_cosine
        m1, m2 = link_change(si, ci, ball.inner_inverse, ball.inner_approach, part * ball.dv1, part * ball.dv2)
        ball.v1 += m1
        ball.v2 += m2
        if is_patient:
            settle_link(case, ball, a1, a2, length, most)
        else:
            close_chain(ball, a1, a2)


@kernel
def close_chains(case: recarray, ring: recarray, balls: ndarray) -> bool:
    """Let every ball's inner link be what ring and outer link leave; whether any was not."""
    was_open = False
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        before1, before2 = ball.v1, ball.v2
        close_chain(ball, a1, a2)
        was_open = was_open or ball.v1 != before1 or ball.v2 != before2
    return was_open


@kernel
def newton(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Iterate in place from where ring and balls are: (converged, iterations, relative residual).

    No step is refused: from a fair start this converges in five to ten iterations, often through a larger imbalance,
    which a monotone rule would forbid. A step is shortened where it would turn a contact line too far, or carry the
    ring further than its grooves' centres are apart.
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    iterations, before, is_last = 0, -1.0, False
    while True:
        worst, scale, worst_own = pass_over_balls(case, ring, balls)
        if not scale < inf or (scale == 0.0 and case.centrifugal and not ring.at_rest):
            return False, iterations, 1.0  # without any force: a root where no ball orbits, no place of a ball
        residual = worst / scale if scale > 0.0 else (0.0 if worst == 0.0 else 1.0)
        # The limit of rounding: no step helps any more, and what stands is good.
        limit = attainable(ring)
        is_stalled = 0.0 <= before <= limit and 0.5 * before <= residual <= limit
        if residual <= tolerance or is_stalled or (is_last and residual <= limit):
            if close_chains(case, ring, balls):
                if iterations >= MOST:
                    return False, iterations, residual
                iterations += 1  # what hardly acted while open may act once closed
                before, is_last = -1.0, False
                continue
            if is_last or is_stalled or worst_own <= max(OWN_TOLERANCE, tolerance):
                return True, iterations, residual
            is_last = True
        elif is_last or iterations >= MOST:
            return False, iterations, residual
        largest = ring_step(case, ring, balls)
        turn = ball_steps(case, ring, balls)
        if not (0.0 <= largest < inf and turn < inf):
            return False, iterations, 1.0
        fraction = min(1.0, LARGEST_TURN / max(turn, LARGEST_TURN), length / max(largest, length))
        before = residual
        move(case, ring, balls, fraction, iterations < PATIENCE)
        iterations += 1
        for i in range(5):
            if not abs(ring.displacement[i]) < FARTHEST:
                return False, iterations, 1.0
