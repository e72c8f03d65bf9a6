"""Newton's step: what it is, how much of it is taken, and how contact lines take it."""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.kernel.assembly import close_loops
from qsbearing.model.kernel.contact_line import direction
from qsbearing.model.kernel.linear import solve_in_place
from qsbearing.model.kernel.loop_closure import (
    inner_span,
    line_closure,
    line_from_positions,
    outer_length,
    set_inner_line,
    set_outer_line,
    whole_length,
)
from qsbearing.model.kernel.ring import inner_groove_centre, inner_groove_step
from qsbearing.model.kernel.ring_bending import propose_deflections
from qsbearing.model.kernel.unloaded_ball import place_unloaded

# The step limits: choices, borne out by campaigns of random scenes. They shape the way to an equilibrium, not the
# equilibrium.
# A step turns no contact line further (radians): a tangent errs by half the square of the turn, an eighth here.
LARGEST_TURN = 0.5
# A step takes at most this part of a contact's approach; a contact opens by geometry, not by its tangent.
LARGEST_RELIEF = 0.9
# But a contact with less than this part of another's approach opens at once where a step asks for it.
LEAST_KEPT = 1e-6
# Up to this relative change of the approach the power 2/3 is taken by its series, which errs there by 0.4 % of it.
LINEAR_RELIEF = 0.3
# A closure residual below this part of the approach is closed outright near equilibrium.
SMALL_RESIDUAL = 0.1
# No solution worth having lies this many ball diameters (or radians) away: small rotations end far below.
FARTHEST = 2.0


@kernel
def propose_step(case: recarray, work: recarray, balls: ndarray) -> float:
    """Solve the assembled system for the steps of ring and balls.

    Returns:
        The fraction of the step to take: no contact line may turn further than LARGEST_TURN, the ring move no further
        than groove centres lie apart. Negative where the system is singular or the step is not a number.
    """
    if not solve_in_place(work.matrix, work.right_side, work.channel_count):
        return -1.0
    for i in range(5):
        work.step[i] = 0.0
    for p in range(work.channel_count):
        work.step[work.channel[p]] = -work.right_side[p]
    return propose_lines(case, work, balls)


@kernel
def propose_lines(case: recarray, work: recarray, balls: ndarray) -> float:
    """The steps of all contact lines with the ring's; returns as `propose_step` does."""
    farthest, turn = 0.0, 0.0
    if case.elastic_rings:
        propose_deflections(work, balls)
    for n in range(work.ball_count):
        ball = balls[n]
        da1, da2 = inner_groove_step(case, work.step, ball.cosine, ball.sine)
        if case.elastic_rings:
            da2 -= ball.deflection_step
        farthest = max(farthest, max(abs(da1), abs(da2)))
        ball.outer_step1, ball.outer_step2, ball.inner_step1, ball.inner_step2, ball.turn = line_steps(
            work.at_rest, ball, da1, da2
        )
        if not ball.follows_inertia:
            turn = max(turn, ball.turn)
    if not (farthest < inf and turn < inf):
        return -1.0
    return step_fraction(case, farthest, turn)


@inlined
def line_steps(at_rest: bool, ball: recarray, da1: float, da2: float) -> tuple[float, float, float, float, float]:
    """The steps of a ball's outer and inner lines as its inner groove centre moves by dA, and their larger turn."""
    outer1, outer2, outer = 0.0, 0.0, 0.0
    inner1, inner2 = ball.closure1 + da1, ball.closure2 + da2
    if not at_rest:
        outer1 = -ball.y1 - ball.y11 * da1 - ball.y12 * da2
        outer2 = -ball.y2 - ball.y21 * da1 - ball.y22 * da2
        inner1 -= outer1
        inner2 -= outer2
        outer = abs(ball.outer_cosine * outer1 - ball.outer_sine * outer2) * ball.outer_inverse
    inner = abs(ball.inner_cosine * inner1 - ball.inner_sine * inner2) * ball.inner_inverse
    return outer1, outer2, inner1, inner2, max(outer, inner)


@inlined
def step_fraction(case: recarray, farthest: float, turn: float) -> float:
    """The fraction of a step that moves a groove centre, and turns a contact line, by so much."""
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    return min(1.0, LARGEST_TURN / max(turn, LARGEST_TURN), length / max(farthest, length))


@kernel
def is_far(work: recarray) -> bool:
    """Whether the ring is further away than any equilibrium worth having, or its displacement not a number."""
    for i in range(5):
        if not abs(work.displacement[i]) < FARTHEST:
            return True
    return False


@inlined
def small_growth(approach: float, longer: float) -> tuple[float, bool]:
    """How much longer a contact line becomes that its tangent lets grow by `longer`; whether this holds.

    Q grows with approach^1.5, so the load that a tangent promises is reached by a smaller approach. Here the power 2/3
    is taken to third order, for small changes of the approach.
    """
    if approach <= 0.0:
        return longer, True
    x = longer / approach
    return longer * (1.0 - x * (0.25 - x / 6.0)), abs(x) <= LINEAR_RELIEF


@inlined
def growth(approach: float, longer: float, most: float) -> float:
    """The same for any change; a contact with next to none of the approach `most` may open."""
    grown, holds = small_growth(approach, longer)
    if holds:
        return grown
    x = longer / approach
    if x > 0.0:
        return approach * ((1.0 + 1.5 * x) ** (2.0 / 3.0) - 1.0)
    return max(longer, -LARGEST_RELIEF * approach) if approach > LEAST_KEPT * most else longer


@inlined
def turned_line(
    length: float, n1: float, n2: float, inverse: float, approach: float, longer: float, d1: float, d2: float,
    most: float,
) -> tuple[float, float, float]:  # fmt: skip
    """A contact line after a step d, as (sine, cosine, approach): it grows by `longer` and turns.

    A contact that closes starts with the approach `most` at most; past the point where its ends meet, a line points the
    other way.
    """
    half_turn = 0.5 * inverse * (n2 * d1 - n1 * d2)
    # n turned by 2 atan(half_turn), without trigonometry: what is added to n along n and along t.
    across = 2.0 * half_turn / (1.0 + half_turn * half_turn)
    along = -half_turn * across
    m1, m2 = n1 + along * n1 + across * n2, n2 + along * n2 - across * n1
    size = 1.5 - 0.5 * (m1 * m1 + m2 * m2)  # 1/|m|, which rounding alone takes off 1
    approach = min(approach + longer, most) if approach <= 0.0 else approach + longer
    if length + approach < 0.0:
        return -m1 * size, -m2 * size, -2.0 * length - approach
    return m1 * size, m2 * size, approach


@inlined
def stepped_line(
    length: float, n1: float, n2: float, inverse: float, approach: float, d1: float, d2: float, most: float
) -> tuple[float, float, float]:
    """A contact line after a step d, as (sine, cosine, approach): its load grows as the tangent says."""
    longer = growth(approach, n1 * d1 + n2 * d2, most)
    return turned_line(length, n1, n2, inverse, approach, longer, d1, d2, most)


@inlined
def settled_line(
    case: recarray, length: float, n1: float, n2: float, approach: float, w1: float, w2: float, most: float,
    is_near: bool,
) -> tuple[float, float, float]:  # fmt: skip
    """The inner line of a loop closed where its contact is open, and near equilibrium where the residual is small
    beside the approach.

    Elsewhere a small closure residual is left to the next step. A contact that closes starts with `most` at most: the
    approach of the ball's other contact, or at rest of the most pressed ball.
    """
    closure1, closure2 = line_closure(case, length, n1, n2, approach, w1, w2)
    is_small = max(abs(closure1), abs(closure2)) < SMALL_RESIDUAL * approach
    if is_small and not is_near:
        return n1, n2, approach  # the next step closes it
    closed, m1, m2, _ = direction(length, case.sin_free, case.cos_free, w1, w2)
    if closed <= 0.0 or (is_small and (closure1 != 0.0 or closure2 != 0.0)):
        return line_from_positions(case, length, approach, w1, w2)
    if approach <= 0.0:
        return m1, m2, min(closed, most)
    return n1, n2, approach


@inlined
def has_room(case: recarray, ball: recarray, a1: float, a2: float) -> bool:
    """Whether its grooves leave a ball room."""
    approach, _, _, _ = direction(whole_length(case, ball), case.sin_free, case.cos_free, a1, a2)
    return bool(approach <= 0.0)


@kernel
def take_step(case: recarray, work: recarray, balls: ndarray, fraction: float, may_open: bool, is_near: bool) -> None:
    """Take the fraction of the step; keep loops open if `may_open`, but for small residuals near equilibrium.

    A ball that follows its inertia and would turn far does not shorten the ring's step: it is put anew where an
    unloaded ball lies or, if its grooves leave it no room, turned by LARGEST_TURN.
    """
    pressed = work.largest_approach
    if pressed <= 0.0:  # no ball is: as far as the largest force would press one
        pressed = (work.largest_force / case.series_stiffness) ** (2.0 / 3.0)
    for i in range(5):
        work.displacement[i] += fraction * work.step[i]
    for n in range(work.ball_count):
        ball = balls[n]
        if case.elastic_rings:
            ball.deflection += fraction * ball.deflection_step
        a1, a2 = inner_groove_centre(case, work.displacement, ball)
        own = fraction
        if ball.follows_inertia and ball.turn > LARGEST_TURN:
            if not work.at_rest and has_room(case, ball, a1, a2):
                place_unloaded(case, work, ball, a1, a2)
                continue
            own = min(fraction, LARGEST_TURN / ball.turn)
        most = pressed
        if not work.at_rest:
            if ball.outer_approach > 0.0:
                most = ball.outer_approach
            so, co, outer_approach = stepped_line(
                outer_length(case, ball), ball.outer_sine, ball.outer_cosine, ball.outer_inverse,
                ball.outer_approach, own * ball.outer_step1, own * ball.outer_step2, max(ball.inner_approach, pressed),
            )  # fmt: skip
            set_outer_line(ball, so, co, outer_approach)
        length, w1, w2 = inner_span(case, ball, work.at_rest, a1, a2)
        si, ci, inner_approach = stepped_line(
            length, ball.inner_sine, ball.inner_cosine, ball.inner_inverse,
            ball.inner_approach, own * ball.inner_step1, own * ball.inner_step2, most,
        )  # fmt: skip
        if may_open:
            si, ci, inner_approach = settled_line(case, length, si, ci, inner_approach, w1, w2, most, is_near)
        set_inner_line(ball, si, ci, inner_approach)
    if not may_open:
        close_loops(case, work, balls)
