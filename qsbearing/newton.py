"""Newton's method on ring and balls together, with exact derivatives, from lengths that need not yet add up.

A ball is a joint between two nearly rigid links, the contact lines: X from the outer groove's centre to the ball's, V
from the ball's to the inner groove's, and A = X + V closes the chain. Held closed at every step, the chain turns an
error of angle, s, into an error of length s^2/2, which at a turn of a few degrees is more than the whole approach of
the contacts: loads jump by powers of ten. So each link keeps a length and an angle of its own, and the gap A - X - V is
one more residual, which the linear system closes while angles and loads settle (as in mixed methods for cables). In the
last steps it is closed outright, and they are plain Newton on ring and balls. Since loads follow from the links' own
approaches, not from differences of places, they balance to the last digits however light they are.

Each ball's unknowns are eliminated where the ball is evaluated (a 2 x 2 block), which leaves a system of the ring's
free channels; the balls' steps follow from the ring's. Nothing is nested and nothing is differenced.
"""

from __future__ import annotations

from math import inf, sqrt

from numpy import ndarray, recarray

from qsbearing.ball import (
    close_chain,
    inner_gap,
    inner_rest,
    lay_loose,
    moving_ball,
    resting_ball,
    set_inner,
    set_inner_by_places,
)
from qsbearing.compiled import kernel
from qsbearing.contact import direction
from qsbearing.linear import solve_in_place
from qsbearing.ring import add_ball, channel_scale, inner_groove_centre, start_sums

# A step may turn no contact line further (radians): beyond, the tangents say little.
LARGEST_TURN = 0.5
# A step may take at most this part of a contact's approach: geometry loses it, not a tangent.
LARGEST_RELIEF = 0.9
# One with less than this part of another's hardly counts, and comes out of touch at once where a step asks for it.
LEAST_KEPT = 1e-6
# Loads follow the tangent down to this part of the approach lost, where 1.5 times it is still well short of all load.
LINEAR_RELIEF = 0.3
# After so many iterations a gap has had its time: the chain is held closed.
PATIENCE = 20
# A gap in the chain below this part of the approach is closed outright.
SMALL_GAP = 0.1
# Below this relative residual a step is one of the last.
NEAR = 1e-2
# A balance's chains are closed so often; after that it stands as soon as they are.
CLOSINGS = 3
# Where rounding forbids the tolerance, this relative residual still counts as solved.
STALLED = 1e-10
# A ball or channel with little load beside the others' gets one step more where its imbalance is over this part of it.
OWN_TOLERANCE = 1e-12
# No solution worth having lies this many ball diameters (or radians) away.
FARTHEST = 2.0
# Of the stiffness of a contact under the largest force: little more than the rounding of such stiffnesses, it keeps a
# ball out of contact, or an idle channel, solvable, and hardly counts beside what resists the turning of a line, Q/l.
FLOOR = 1e-14
# Of a double.
EPSILON = 2.0**-52
# From a fair start five to ten do; past this another start is cheaper.
MOST = 40


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
def stop(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Let nothing turn: each ball is one link, from groove centre to groove centre."""
    ring.at_rest = True
    close_chains(case, ring, balls)


@kernel
def pass_over_balls(case: recarray, ring: recarray, balls: ndarray) -> tuple[float, float]:
    """Evaluate all balls where they are, and leave the condensed system in the ring.

    Returns:
        (residual, the same of the ball or channel worst off beside its own load). The residual is the largest
        imbalance over the largest force: applied, inertial or frozen, or of a contact where a displacement is
        prescribed, since then contacts make the reaction. It is infinite where something is not a number, and where no
        force at all acts at speed: a root where no ball orbits, no place of a ball.
    """
    start_sums(case, ring)
    ring.largest_approach = 0.0
    # Less than a contact carries that a ball's own rounding presses is no load.
    least = EPSILON * sqrt(EPSILON) * case.series_stiffness
    worst, worst_own, total = 0.0, 0.0, 0.0
    inertial, contact = 0.0, 0.0
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        fc, friction = 0.0, 0.0
        if ring.at_rest:
            imbalance, load = resting_ball(case, ball, a1, a2)
            lighter = load
        else:
            imbalance, load, lighter, fc, friction = moving_ball(case, ball, a1, a2, ring.floor, ring.grip)
        ring.largest_approach = max(ring.largest_approach, ball.inner_approach)
        worst = max(worst, imbalance)
        if imbalance > worst_own * max(lighter, least):
            worst_own = imbalance / max(lighter, least)
        total += imbalance
        inertial = max(inertial, fc, friction)
        contact = max(contact, load)
        add_ball(ring, ball)
    for p in range(ring.channels):
        lever = channel_scale(case, ring.channel[p])
        ring.matrix[p, p] += ring.floor * lever * lever  # a channel that nothing resists keeps a step
        worst = max(worst, abs(ring.imbalance[p]) / lever)
        own = abs(case.prescribed[ring.channel[p]])
        if own > least and abs(ring.imbalance[p]) > worst_own * own:
            worst_own = abs(ring.imbalance[p]) / own
        total += ring.imbalance[p]
    scale = max(applied_load(case), inertial, ring.frozen)
    if scale == 0.0 and case.centrifugal and not ring.at_rest:
        return inf, inf
    if scale <= least:
        scale = least
        if worst <= least:
            worst = 0.0
    if any_held(case):
        scale = max(scale, contact)
    ring.scale = scale
    ring.floor = FLOOR * case.series_stiffness * (scale / case.series_stiffness) ** (1.0 / 3.0)
    if not abs(total) < inf:  # a maximum passes over what is not a number; a sum does not
        return inf, inf
    return worst / scale, worst_own


@kernel
def ring_step(case: recarray, ring: recarray, balls: ndarray) -> float:
    """Solve the condensed system for the ring's step.

    Returns the largest displacement of any inner groove centre by it; negative where the system is singular.
    """
    ring.orientation = solve_in_place(ring.matrix, ring.right, ring.channels)
    if ring.orientation == 0.0:
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
def step_fraction(case: recarray, largest: float, turn: float) -> float:
    """How much of a step to take: no contact line too far round, the ring no further than groove centres lie apart.

    Args:
        largest: displacement of any inner groove centre by the whole step.
        turn: of any contact line by the whole step.
    """
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    return min(1.0, LARGEST_TURN / max(turn, LARGEST_TURN), length / max(largest, length))


@kernel
def has_gone_far(ring: recarray) -> bool:
    """Whether the ring is further away than any balance worth having; so is what is not a number."""
    for i in range(5):
        if not abs(ring.displacement[i]) < FARTHEST:
            return True
    return False


@kernel
def changed_link(
    length: float, n1: float, n2: float, inverse: float, approach: float, d1: float, d2: float, most: float
) -> tuple[float, float, float]:
    """A link after a step d, as (sine, cosine, approach): its load grows as the tangent says, its line turns.

    Q grows with approach^1.5, so the load that a tangent promises is reached by a smaller approach. A link that comes
    into touch starts with the approach `most` at most, one with next to none of `most` may come out of touch; past the
    point where its ends meet a link points the other way.
    """
    longer = n1 * d1 + n2 * d2
    half_turn = 0.5 * inverse * (n2 * d1 - n1 * d2)
    if approach > 0.0:
        x = longer / approach
        if abs(x) <= LINEAR_RELIEF:  # the same to third order, without the power
            longer *= 1.0 - x * (0.25 - x / 6.0)
        elif x > 0.0:
            longer = approach * ((1.0 + 1.5 * x) ** (2.0 / 3.0) - 1.0)
        elif approach > LEAST_KEPT * most:
            longer = max(longer, -LARGEST_RELIEF * approach)
    # n turned by 2 atan(half_turn), without trigonometry: what is added to n along n and along t.
    across = 2.0 * half_turn / (1.0 + half_turn * half_turn)
    along = -half_turn * across
    m1, m2 = n1 + along * n1 + across * n2, n2 + along * n2 - across * n1
    size = 1.5 - 0.5 * (m1 * m1 + m2 * m2)  # 1/|m|, which rounding alone takes off 1
    approach = min(approach + longer, most) if approach <= 0.0 else approach + longer
    if length + approach < 0.0:
        return -m1 * size, -m2 * size, -2.0 * length - approach
    return m1 * size, m2 * size, approach


@kernel
def settle_link(
    case: recarray, ring: recarray, ball: recarray, a1: float, a2: float, most: float, is_near: bool
) -> None:
    """Close the chain where the contact is out of touch, and near the balance, where it is small against the approach.

    Elsewhere a small gap is left to the next step.

    A contact that geometry brings into touch starts with the approach of the ball's other contact at most; at rest,
    of the ball most pressed.
    """
    s, c = case.sin_free, case.cos_free
    length, w1, w2 = inner_rest(case, ball, ring.at_rest, a1, a2)
    gap1, gap2 = inner_gap(case, ball, length, w1, w2)
    is_small = max(abs(gap1), abs(gap2)) < SMALL_GAP * ball.inner_approach
    if is_small and not is_near:
        return  # the next step closes it
    approach, n1, n2, _ = direction(length, s, c, w1, w2)
    if approach <= 0.0 or (is_small and (gap1 != 0.0 or gap2 != 0.0)):
        set_inner_by_places(case, ball, length, w1, w2)
    elif ball.inner_approach <= 0.0:
        set_inner(ball, n1, n2, min(approach, most))


@kernel
def move(case: recarray, ring: recarray, balls: ndarray, fraction: float, is_patient: bool, is_near: bool) -> None:
    """Take the fraction of the step.

    An idle ball that is asked to turn far does not hold up the ring: it is put anew where a loose one lies, or if its
    grooves leave it no room, turned as far as tangents hold.
    """
    s, c, whole = case.sin_free, case.cos_free, case.inner_coefficient + case.outer_coefficient - 1.0
    inner_length = whole if ring.at_rest else case.inner_coefficient - 0.5
    pressed = ring.largest_approach
    if pressed <= 0.0:  # no ball is: as far as the largest force would press one
        pressed = (ring.scale / case.series_stiffness) ** (2.0 / 3.0)
    for i in range(5):
        ring.displacement[i] += fraction * ring.step[i]
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        part = fraction
        if ball.is_idle and ball.turn > LARGEST_TURN:
            room, _, _, _ = direction(whole, s, c, a1, a2)
            if room <= 0.0 and not ring.at_rest:
                lay_loose(case, ball, a1, a2)
                continue
            part = min(fraction, LARGEST_TURN / ball.turn)
        most = pressed
        if not ring.at_rest:
            if ball.outer_approach > 0.0:
                most = ball.outer_approach
            ball.outer_sine, ball.outer_cosine, ball.outer_approach = changed_link(
                case.outer_coefficient - 0.5, ball.outer_sine, ball.outer_cosine, ball.outer_inverse,
                ball.outer_approach, part * ball.du1, part * ball.du2, max(ball.inner_approach, pressed),
            )  # fmt: skip
        ball.inner_sine, ball.inner_cosine, ball.inner_approach = changed_link(
            inner_length, ball.inner_sine, ball.inner_cosine, ball.inner_inverse,
            ball.inner_approach, part * ball.dv1, part * ball.dv2, most,
        )  # fmt: skip
        if is_patient:
            settle_link(case, ring, ball, a1, a2, most, is_near)
    if not is_patient:
        close_chains(case, ring, balls)


@kernel
def close_chains(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Let every ball's inner link be what ring and outer link leave."""
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        close_chain(case, ball, ring.at_rest, a1, a2)


@kernel
def is_open(ring: recarray, balls: ndarray) -> bool:
    """Whether the last pass found some chain open."""
    for n in range(ring.balls):
        if balls[n].gap1 != 0.0 or balls[n].gap2 != 0.0:
            return True
    return False


@kernel
def newton(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Iterate in place from where ring and balls are: (converged, iterations, relative residual).

    No step is refused: from a fair start this converges in five to ten iterations, often through a larger imbalance,
    which a monotone rule would forbid.
    """
    iterations, closings, before, is_last, is_closed = 0, 0, -1.0, False, False
    while True:
        residual, residual_own = pass_over_balls(case, ring, balls)
        if not residual < inf:
            return False, iterations, 1.0
        # The limit of rounding: no step helps any more, and what stands is good.
        is_stalled = 0.0 <= before <= STALLED and 0.5 * before <= residual <= STALLED
        if residual <= tolerance or is_stalled or (is_last and residual <= STALLED):
            if not is_closed and is_open(ring, balls):
                close_chains(case, ring, balls)  # what hardly acted while open may act once closed
                closings += 1
                before, is_last, is_closed = -1.0, closings > CLOSINGS, True
                continue
            if is_last or is_stalled or residual_own <= max(OWN_TOLERANCE, tolerance):
                return True, iterations, residual
            is_last = True
        elif iterations >= MOST:
            return False, iterations, residual
        else:
            is_last = False
        largest = ring_step(case, ring, balls)
        turn = ball_steps(case, ring, balls)
        if not (0.0 <= largest < inf and turn < inf):
            return False, iterations, 1.0
        before, is_closed = residual, False
        move(case, ring, balls, step_fraction(case, largest, turn), iterations < PATIENCE, residual < NEAR)
        iterations += 1
        if has_gone_far(ring):
            return False, iterations, 1.0
