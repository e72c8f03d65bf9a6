"""Initial position of a ball that its grooves leave room: pressed outward by its inertia, or free between them."""

from __future__ import annotations

from math import sqrt

from numpy import recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.effects.raceway_control import OUTER
from qsbearing.model.kernel.ball_inertia import friction_shares, inertia, is_moving
from qsbearing.model.kernel.contact_line import direction
from qsbearing.model.kernel.kinematics import inner_line
from qsbearing.model.kernel.loop_closure import close_loop, inner_length, outer_length, set_inner_line, set_outer_line

# Contact lines closer to one line than this sine say little about the loads of a corner. A choice: it bounds an
# initial guess.
STRAIGHT = 0.2
# Lengths below this many ball diameters have no direction: far below any clearance, far above rounding.
SHORTEST = 1e-12


@kernel
def corner_inertia(
    case: recarray, work: recarray, control: int, si: float, ci: float, so: float, co: float
) -> tuple[float, float]:
    """(Fc, Mg) of a ball that both grooves hold."""
    s_seen, c_seen, _, _, _ = inner_line(si, ci, so, co, 0.0, 1.0)
    fc, _, _, mg, _, _ = inertia(case, work, control, s_seen, c_seen, so, co)
    return fc, mg


@kernel
def inertia_force(
    case: recarray, work: recarray, control: int, si: float, ci: float, so: float, co: float
) -> tuple[float, float]:
    """f: the inertia force on the ball and the friction that carries its gyroscopic moment."""
    fc, mg = corner_inertia(case, work, control, si, ci, so, co)
    share_i, share_o = friction_shares(case, control, 0.0)
    return mg * (share_o * co - share_i * ci), mg * (share_i * si - share_o * so) + fc


@kernel
def place_midway(case: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball midway between its grooves, on the line between their centres.

    Where one groove's circle lies within the other's, midway between its centre and its far side.
    """
    li, lo = inner_length(case, ball), outer_length(case, ball)
    between, n1, n2, _ = direction(li + lo, case.sin_free, case.cos_free, a1, a2)
    distance = li + lo + between
    if distance <= lo - li:
        set_outer_line(ball, n1, n2, distance + 0.5 * li - lo)
        set_inner_line(ball, -n1, -n2, -0.5 * li)
    elif distance <= li - lo:
        set_outer_line(ball, -n1, -n2, -0.5 * lo)
        set_inner_line(ball, n1, n2, distance + 0.5 * lo - li)
    else:
        set_outer_line(ball, n1, n2, 0.5 * between)
        set_inner_line(ball, n1, n2, 0.5 * between)


@kernel
def place_by_inertia(case: recarray, work: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball where its inertia presses it: in a corner between its grooves, or at the outer groove's bottom.

    In a corner both contact lines have their free length: two circles intersect, outward or inward of the line between
    the groove centres, and Qi ni - Qo no + f = 0 gives the loads. The ball lies in the corner where both are positive.
    Where friction makes neither so, Newton's method starts from the outward one and the centrifugal force alone. Where
    the top of the inner groove's circle lies within the outer one's, the far side of the inner groove holds the ball.
    """
    s, c = case.sin_free, case.cos_free
    li, lo = inner_length(case, ball), outer_length(case, ball)
    p1, p2 = (li + lo) * s + a1, (li + lo) * c + a2
    if p1 * p1 + (p2 - lo) * (p2 - lo) < li * li:
        size = max(sqrt(p1 * p1 + (p2 - lo) * (p2 - lo)), SHORTEST)
        s_seen, c_seen, _, _, _ = inner_line(p1 / size, (p2 - lo) / size, 0.0, 1.0, size - li, li)
        fc, _, _, _, _, _ = inertia(case, work, OUTER, s_seen, c_seen, 0.0, 1.0)
        set_outer_line(ball, 0.0, 1.0, (fc / case.outer_stiffness) ** (2.0 / 3.0))
        close_loop(case, ball, False, a1, a2)
        return
    if p1 * p1 + (p2 + li) * (p2 + li) < lo * lo:
        approach, so, co, _ = direction(lo, s, c, p1 - lo * s, p2 + li - lo * c)
        fc, _ = corner_inertia(case, work, ball.control, 0.0, -1.0, so, co)
        set_inner_line(ball, 0.0, -1.0, (fc / case.inner_stiffness) ** (2.0 / 3.0))
        set_outer_line(ball, so, co, approach)
        return
    square = p1 * p1 + p2 * p2
    distance = sqrt(square)
    along = min(0.5 * (square + lo * lo - li * li) / distance, lo)
    across = sqrt(lo * lo - along * along)
    d1, d2 = p1 / distance, p2 / distance
    outward = 1.0 if d1 >= 0.0 else -1.0
    so, co, si, ci, qi, qo = 0.0, 1.0, 0.0, 1.0, 0.0, 0.0
    for attempt in range(3):
        side = -outward if attempt == 1 else outward
        so, co = (along * d1 - side * across * d2) / lo, (along * d2 + side * across * d1) / lo
        si, ci = (p1 - lo * so) / li, (p2 - lo * co) / li
        f1, f2 = inertia_force(case, work, ball.control, si, ci, so, co)
        if attempt == 2:
            f2, _ = corner_inertia(case, work, ball.control, si, ci, so, co)
            f1 = 0.0
        sine = so * ci - co * si
        sine = max(sine, STRAIGHT) if sine > 0.0 else min(sine, -STRAIGHT)
        qi, qo = (f1 * co - f2 * so) / sine, (f1 * ci - f2 * si) / sine
        if qi > 0.0 and qo > 0.0:
            break
    set_outer_line(ball, so, co, (abs(qo) / case.outer_stiffness) ** (2.0 / 3.0))
    inner = (abs(qi) / case.inner_stiffness) ** (2.0 / 3.0)
    # Where the circles do not meet, (si, ci) is no unit vector: its direction counts.
    approach, n1, n2, _ = direction(li, s, c, li * (si - s) + inner * si, li * (ci - c) + inner * ci)
    set_inner_line(ball, n1, n2, approach)


@kernel
def place_unloaded(case: recarray, work: recarray, ball: recarray, a1: float, a2: float) -> None:
    """Put a ball that its grooves leave room where inertia presses it; midway where no centrifugal force does.

    At a speed factor of zero none does: in a corner, rounding would press it to both grooves.
    """
    if case.centrifugal and is_moving(case) and work.speed_factor > 0.0:
        place_by_inertia(case, work, ball, a1, a2)
    else:
        place_midway(case, ball, a1, a2)
