"""Relaxation: ring and balls give way to what is out of balance, as in a viscous fluid.

Implicit Euler's steps of (d, X)' = -imbalance, ever longer as the imbalance falls (pseudo-transient continuation): only
a balance that is stable attracts. Where a balance has come to its end, this goes where the bearing itself would go.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.compiled import kernel
from qsbearing.newton import FARTHEST, LARGEST_TURN, ball_steps, move, pass_over_balls, ring_step

# A step may go this part of a contact line's free length; so many steps are worth their time.
RELAXED = 0.1
RELAXATIONS = 500
# An imbalance, or a step, from which there is no way.
NO_PLACE = 1e30


@kernel
def relax(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> int:
    """Let ring and balls give way from where they are; returns the iterations taken."""
    least = ring.floor
    reach = RELAXED * (min(case.inner_coefficient, case.outer_coefficient) - 0.5)
    length = case.inner_coefficient + case.outer_coefficient - 1.0
    iterations = 0
    while iterations < RELAXATIONS:
        residual, _ = pass_over_balls(case, ring, balls)
        if residual <= tolerance or not residual < NO_PLACE:
            break
        ring.floor = max(least, residual * ring.scale / reach)
        pass_over_balls(case, ring, balls)
        largest = ring_step(case, ring, balls)
        turn = ball_steps(case, ring, balls)
        if not (0.0 <= largest < NO_PLACE and turn < NO_PLACE):
            break
        move(
            case,
            ring,
            balls,
            min(1.0, LARGEST_TURN / max(turn, LARGEST_TURN), length / max(largest, length)),
            False,
            False,
        )
        iterations += 1
        for i in range(5):
            if not abs(ring.displacement[i]) < FARTHEST:
                ring.ran_away = True
        if ring.ran_away:
            break
    ring.floor = least
    return iterations
