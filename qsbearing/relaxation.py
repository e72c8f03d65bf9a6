"""Relaxation: ring and balls give way to what is out of balance, as in a viscous fluid.

Implicit Euler's steps of (d, X)' = -imbalance, ever longer as the imbalance falls (pseudo-transient continuation): only
a balance that is stable attracts. Where a balance has come to its end, this goes where the bearing itself would go.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.compiled import kernel
from qsbearing.newton import ball_steps, has_gone_far, move, newton, pass_over_balls, ring_step, step_fraction

# A step may go this part of a contact line's free length; so many steps are worth their time.
RELAXED = 0.1
RELAXATIONS = 500
# How well relaxation must balance for Newton's method to take over.
AT_EASE = 1e-3
# An imbalance, or a step, from which there is no way.
NO_PLACE = 1e30


@kernel
def relax(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> int:
    """Let ring and balls give way from where they are; returns the iterations taken."""
    reach = RELAXED * (min(case.inner_coefficient, case.outer_coefficient) - 0.5)
    iterations = 0
    while iterations < RELAXATIONS:
        residual, _ = pass_over_balls(case, ring, balls)
        if residual <= tolerance or not residual < NO_PLACE:
            break
        ring.floor = max(ring.floor, residual * ring.scale / reach)
        pass_over_balls(case, ring, balls)
        largest = ring_step(case, ring, balls)
        turn = ball_steps(case, ring, balls)
        if not (0.0 <= largest < NO_PLACE and turn < NO_PLACE):
            break
        move(case, ring, balls, step_fraction(case, largest, turn), False, False)
        iterations += 1
        if has_gone_far(ring):
            break
    return iterations


@kernel
def relax_to_rest(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Relaxation, then Newton's method: (converged, iterations, relative residual)."""
    relaxations = relax(case, ring, balls, AT_EASE)
    converged, iterations, residual = newton(case, ring, balls, tolerance)
    return converged, relaxations + iterations, residual
