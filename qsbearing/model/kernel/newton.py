"""Newton's method on ring and balls together, with exact derivatives, through states whose loops are not yet closed.

A ball is a joint between two nearly rigid lines, the contact lines: X from the outer groove's centre to the ball's, V
from the ball's to the inner groove's, and A = X + V closes the loop. Held closed at every step, the loop turns an error
of angle, s, into an error of length s^2/2, which at a turn of a few degrees is more than the whole approach of the
contacts: loads jump by powers of ten. So each line keeps a length and an angle of its own, and A - X - V is one more
residual, which the linear system closes while angles and loads settle (as in mixed methods for cables). In the last
steps it is closed outright, and they are plain Newton on ring and balls. Since loads follow from the lines' own
approaches, not from differences of positions, they balance to the last digits however light they are.

Each ball's unknowns are eliminated where the ball is evaluated (a 2 x 2 block), which leaves a system of the ring's
free channels; the balls' steps follow from the ring's. Nothing is nested and nothing is differenced.
"""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.assembly import assemble, close_loops, has_closure_residual, set_at_rest
from qsbearing.model.kernel.newton_step import is_far, propose_step, take_step

# From a fair start five to ten do; past this another start is cheaper (a choice, borne out by campaigns).
MOST_ITERATIONS = 40
# After so many iterations loops are held closed: open ones may cycle (a choice, borne out by campaigns).
OPEN_ITERATIONS = 20
# Below this relative residual a step is one of the last: quadratic convergence leaves 1e-4, 1e-8, 1e-16.
NEAR = 1e-2
# Loops of an equilibrium are closed so often; rounding may open them again each time.
CLOSINGS = 3
# Where rounding forbids the tolerance, this relative residual still counts as solved.
STALLED = 1e-10
# A ball or channel with little load beside the others' gets one step more where its imbalance is over this part of it.
OWN_TOLERANCE = 1e-12

# What a residual says: more steps are needed; one more step; no step.
UNSOLVED, NEARLY, SOLVED = 0, 1, 2


@kernel
def verdict(residual: float, own_residual: float, before: float, is_last: bool, tolerance: float) -> int:
    """What the residuals say, after `before` and, if `is_last`, a verdict of NEARLY."""
    # The limit of rounding: no step helps any more.
    is_stalled = 0.0 <= before <= STALLED and 0.5 * before <= residual <= STALLED
    if residual <= tolerance or is_stalled or (is_last and residual <= STALLED):
        return SOLVED if is_last or is_stalled or own_residual <= max(OWN_TOLERANCE, tolerance) else NEARLY
    return UNSOLVED


@kernel
def newton(case: recarray, work: recarray, balls: ndarray, tolerance: float) -> bool:
    """Iterate in place from where ring and balls are; whether it converged. Leaves `work.residual`.

    No step is refused: from a fair start this converges in five to ten iterations, often through a larger imbalance,
    which a monotone rule would forbid.
    """
    iterations, closings, before, is_last, is_closed = 0, 0, -1.0, False, False
    while True:
        residual, own_residual = assemble(case, work, balls)
        work.residual = residual if residual < inf else 1.0
        if not residual < inf:
            return False
        convergence = verdict(residual, own_residual, before, is_last, tolerance)
        if convergence != UNSOLVED and not is_closed and has_closure_residual(work, balls):
            close_loops(case, work, balls)  # what hardly acted while open may act once closed
            closings += 1
            before, is_last, is_closed = -1.0, closings > CLOSINGS, True
            continue
        if convergence == SOLVED:
            return True
        if convergence == UNSOLVED and (iterations >= MOST_ITERATIONS or work.iterations >= work.budget):
            return False
        is_last = convergence == NEARLY
        fraction = propose_step(case, work, balls)
        if fraction < 0.0:
            work.residual = 1.0
            return False
        before, is_closed = residual, False
        take_step(case, work, balls, fraction, iterations < OPEN_ITERATIONS, residual < NEAR)
        iterations += 1
        work.iterations += 1
        if is_far(work):
            work.residual = 1.0
            return False


@kernel
def newton_at_rest(case: recarray, work: recarray, balls: ndarray, tolerance: float) -> bool:
    """Newton's method without inertia, from where the ring is; the balls are left as one contact line each."""
    set_at_rest(case, work, balls)
    return newton(case, work, balls, tolerance)
