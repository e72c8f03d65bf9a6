"""Loop closure: ball and groove centres joined by two contact lines, which must add up to the ring's displacement.

X from the outer groove's centre to the ball's, V from the ball's to the inner groove's, A = X + V. Each line keeps an
angle and an approach of its own, so that Newton's method may pass through states in which they do not yet add up.
"""

from __future__ import annotations

from math import atan2, cos, sin

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.kernel.contact_line import direction, line_displacement

# Of lengths, in units of their sum: the sum of the roundings of all steps, 2e-16 or so for each line and step.
ROUNDING = 4e-15


@inlined
def inner_length(case: recarray, ball: recarray) -> float:
    """Free length of the inner contact line, ri - D/2."""
    return case.inner_coefficient - 0.5 * ball.diameter


@inlined
def outer_length(case: recarray, ball: recarray) -> float:
    """Free length of the outer contact line, ro - D/2."""
    return case.outer_coefficient - 0.5 * ball.diameter


@inlined
def whole_length(case: recarray, ball: recarray) -> float:
    """Free length of both together, from groove centre to groove centre, ri + ro - D."""
    return case.inner_coefficient + case.outer_coefficient - ball.diameter


@inlined
def set_outer_line(ball: recarray, sine: float, cosine: float, approach: float) -> None:
    """Give the outer contact line this direction and approach."""
    ball.outer_sine, ball.outer_cosine, ball.outer_approach = sine, cosine, approach


@inlined
def set_inner_line(ball: recarray, sine: float, cosine: float, approach: float) -> None:
    """Give the inner contact line this direction and approach."""
    ball.inner_sine, ball.inner_cosine, ball.inner_approach = sine, cosine, approach


@inlined
def ball_displacement(case: recarray, ball: recarray) -> tuple[float, float]:
    """The ball's centre from the outer groove's, less touching at the free angle."""
    n1, n2, approach = ball.outer_sine, ball.outer_cosine, ball.outer_approach
    return line_displacement(outer_length(case, ball), case.sin_free, case.cos_free, n1, n2, approach)


@inlined
def closure_residual(length: float, a1: float, a2: float, w1: float, w2: float) -> tuple[float, float]:
    """What contact lines that add up to w lack of the groove centres' displacement A; 0 where rounding could make it.

    Loads follow from the lines' own approaches, so that rounding of positions is no imbalance: it is a change of the
    bearing's dimensions by their own rounding.
    """
    closure1, closure2 = a1 - w1, a2 - w2
    if max(abs(closure1), abs(closure2)) <= ROUNDING * (length + abs(a1) + abs(a2)):
        return 0.0, 0.0
    return closure1, closure2


@inlined
def inner_span(case: recarray, ball: recarray, at_rest: bool, a1: float, a2: float) -> tuple[float, float, float]:
    """(free length, w1, w2) of the inner line if the loop is closed; at rest it is the only line."""
    if at_rest:
        return whole_length(case, ball), a1, a2
    u1, u2 = ball_displacement(case, ball)
    return inner_length(case, ball), a1 - u1, a2 - u2


@inlined
def longer_line(case: recarray, length: float) -> float:
    """The longer of the outer line and the inner one, of this length: its rounding is in what is left to the other."""
    return max(length, case.outer_coefficient - 0.5)


@inlined
def line_closure(
    case: recarray, length: float, n1: float, n2: float, approach: float, w1: float, w2: float
) -> tuple[float, float]:
    """The residual of loop closure: what the inner line, of this free length, lacks of w."""
    v1, v2 = line_displacement(length, case.sin_free, case.cos_free, n1, n2, approach)
    return closure_residual(longer_line(case, length), w1, w2, v1, v2)


@inlined
def inner_closure(case: recarray, ball: recarray, length: float, w1: float, w2: float) -> tuple[float, float]:
    """The same of a ball's line."""
    return line_closure(case, length, ball.inner_sine, ball.inner_cosine, ball.inner_approach, w1, w2)


@inlined
def line_from_positions(
    case: recarray, length: float, approach: float, w1: float, w2: float
) -> tuple[float, float, float]:
    """The inner line that closes the loop, but an approach kept that differs by the rounding of positions only.

    Steps give the approach more digits than positions have: computed from positions, light loads would never converge.
    """
    closed, sine, cosine, _ = direction(length, case.sin_free, case.cos_free, w1, w2)
    if abs(closed - approach) <= ROUNDING * (longer_line(case, length) + abs(w1) + abs(w2)):
        closed = approach
    return sine, cosine, closed


@kernel
def close_loop(case: recarray, ball: recarray, at_rest: bool, a1: float, a2: float) -> None:
    """Close the loop by the inner line; one that closes it but for rounding stays as it is.

    A line of negative length, as a start of another length may leave it, is turned to the other side.
    """
    length, w1, w2 = inner_span(case, ball, at_rest, a1, a2)
    closure1, closure2 = inner_closure(case, ball, length, w1, w2)
    if closure1 != 0.0 or closure2 != 0.0 or length + ball.inner_approach < 0.0:
        n1, n2, approach = line_from_positions(case, length, ball.inner_approach, w1, w2)
        set_inner_line(ball, n1, n2, approach)


@kernel
def store_position(case: recarray, ball: recarray, position: ndarray) -> None:
    """Write a ball's position: its outer angle less the free one, its approaches, outer and inner; with elastic rings
    their deflection."""
    s, c = case.sin_free, case.cos_free
    so, co = ball.outer_sine, ball.outer_cosine
    position[0] = atan2(so * c - co * s, co * c + so * s)
    position[1], position[2] = ball.outer_approach, ball.inner_approach
    if case.elastic_rings:
        position[3] = ball.deflection


@kernel
def load_position(case: recarray, ball: recarray, position: ndarray) -> None:
    """Put a ball at a stored position; its inner line follows from closing the loop."""
    s, c = case.sin_free, case.cos_free
    turn_s, turn_c = sin(position[0]), cos(position[0])
    set_outer_line(ball, s * turn_c + c * turn_s, c * turn_c - s * turn_s, position[1])
    set_inner_line(ball, 0.0, 0.0, position[2])
    if case.elastic_rings:
        ball.deflection = position[3]


@kernel
def close_loaded(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """The inner line of a ball put at a stored position; its approach is the stored one, free of rounding."""
    _, w1, w2 = inner_span(case, ball, False, a1, a2)
    _, n1, n2, _ = direction(inner_length(case, ball), case.sin_free, case.cos_free, w1, w2)
    ball.inner_sine, ball.inner_cosine = n1, n2
