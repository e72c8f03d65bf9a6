"""To a balance at speed by freezing: inertia and friction are held as they are, and the bearing settles under them.

Under forces that stay the problem is convex, as at rest: one balance only, and descent cannot fail to reach it. There
inertia and friction are another's, by little, since they change with the contact angles only; half the difference is
made up, and the bearing settles anew (a fixed-point iteration, damped because it may swing). No turning point or
slipping ball is on that way. Where Newton's method does not take over in the end, a path from the frozen balance to the
one sought is a short one, for what must still change is little.

What makes a light bearing hard is that its contacts hardly give way: which of fifty balls carry is all or nothing. So
the frozen forces are made so heavy first that every contact counts, and then ever lighter, a few steps each time.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import set_speed
from qsbearing.compiled import kernel
from qsbearing.dead_forces import freeze, let_act, release
from qsbearing.descent import descend
from qsbearing.keeping import FROZEN, PATH, keep, restore
from qsbearing.newton import applied_load, close_chains, newton

# Each time forces are frozen anew by this part of what they lack; by so much less where that hardly falls.
PART, SMALLER, HARDLY = 0.5, 0.85, 0.9
LEAST_PART = 0.15
# So often at most.
FREEZINGS = 24
# Forces that press balls by this many diameters are heavy; on the way down from them each is so much lighter.
HEAVY_APPROACH, LIGHTER, LEAST_LIGHTER = 1e-3, 10.0, 1.01
# How well balance is known under frozen forces; how badly at least, for they are not the last.
TOLERANCE, SETTLED = 1e-12, 1e-6


@kernel
def descend_from(case: recarray, ring: recarray, balls: ndarray, slot: int) -> tuple[bool, int]:
    """Balance under the forces that act by descent from a place kept: (found, iterations)."""
    restore(ring, balls, slot)
    converged, iterations, residual = descend(case, ring, balls, TOLERANCE)
    return converged or residual <= SETTLED, iterations


@kernel
def settle_frozen(case: recarray, ring: recarray, balls: ndarray, worth: int) -> tuple[bool, int]:
    """The one balance under the dead forces, from the place kept as frozen: (found, iterations)."""
    let_act(case, ring, balls, 1.0)
    close_chains(case, ring, balls)
    found, total, _ = newton(case, ring, balls, TOLERANCE)
    largest = max(applied_load(case), ring.frozen)
    if found or largest == 0.0:
        return found, total
    heavy = max(HEAVY_APPROACH**1.5 * case.series_stiffness / largest, 1.0)
    let_act(case, ring, balls, heavy)
    found, iterations = descend_from(case, ring, balls, FROZEN)
    total += iterations
    lighter = LIGHTER if found else 0.0
    keep(ring, balls, PATH)
    while heavy > 1.0 and lighter > LEAST_LIGHTER and total < worth:
        let_act(case, ring, balls, max(heavy / lighter, 1.0))
        restore(ring, balls, PATH)
        close_chains(case, ring, balls)
        found, iterations, _ = newton(case, ring, balls, TOLERANCE)
        total += iterations
        if not found:
            found, iterations = descend_from(case, ring, balls, PATH)
            total += iterations
        if found:
            heavy, lighter = max(heavy / lighter, 1.0), LIGHTER
            keep(ring, balls, PATH)
        else:
            lighter = sqrt(lighter)
    return found, total


@kernel
def thaw(case: recarray, ring: recarray, balls: ndarray, tolerance: float, worth: int) -> tuple[bool, int, float]:
    """From anywhere to a balance at speed, as far as it is worth so many: (converged, iterations, residual)."""
    inner, outer = case.inner_speed, case.outer_speed
    total, trial, residual = 0, 1, 1.0
    part, before = PART, 0.0
    for n in range(ring.balls):
        balls[n].dead[0], balls[n].dead[1] = 0.0, 0.0
    for i in range(5):
        ring.dead[i] = 0.0
    for freezing in range(FREEZINGS + 1):
        lack = freeze(case, ring, balls, part if freezing > 0 else 1.0)
        if freezing > 1 and lack > HARDLY * before:
            part = max(SMALLER * part, LEAST_PART)
        before = lack
        keep(ring, balls, FROZEN)
        if freezing == trial:
            trial *= 2
            close_chains(case, ring, balls)
            converged, iterations, residual = newton(case, ring, balls, tolerance)
            total += iterations
            if converged:
                return True, total, residual
            restore(ring, balls, FROZEN)
        set_speed(case, 0.0, inner, outer)
        found, iterations = settle_frozen(case, ring, balls, worth - total)
        set_speed(case, 1.0, inner, outer)
        release(case, ring, balls)
        total += iterations
        if not found or total >= worth:
            break
    return False, total, residual
