"""Continuation: an equilibrium followed from an easier case, in loads or in speed, and in pseudo-time.

Loads so heavy that every ball is pressed, and inertia hardly counts, are easy. Light loads leave open which few balls
carry them: a choice hard to make at once and easy to follow. In speed the easy case is the bearing at rest.

Pseudo-transient continuation takes implicit Euler steps of (d, X)' = -imbalance, ever longer as the imbalance falls:
only an equilibrium that is stable attracts (Kelley & Keyes, SIAM J. Numerical Analysis 35, 1998).

At rest there is one equilibrium at most: the energy

    Pi(d) = sum over balls 2/5 K <|A(d)| - L>^(5/2) - F.d,      <x> = max(x, 0),

is convex, since A(d) is affine, a norm is convex, and <x>^(5/2) is convex and grows. It has one minimum, or the ring
moves without end.
"""

from __future__ import annotations

from math import log

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.admissibility import contacts_outside_groove
from qsbearing.model.kernel.assembly import applied_load, assemble, close_loops, set_at_rest
from qsbearing.model.kernel.initial_guess import GUESS_TOLERANCE, guess_from_rest, guess_ring_at_rest
from qsbearing.model.kernel.newton import newton
from qsbearing.model.kernel.newton_step import is_far, propose_step, take_step
from qsbearing.model.kernel.ring_bending import reset_deflections
from qsbearing.model.kernel.snapshots import CONTINUATION, restore, save

# Loads that press balls by this many diameters are heavy: 4 kN a ball for B218, half of its static rating.
HEAVY_APPROACH = 1e-3
# The first step in loads, as a factor. Steps grow and shrink by these factors; what is shorter than the least, a
# thousandth of the way, leads no further. Choices, borne out by random scenes that Newton's method alone misses.
LIGHTER = 10.0
LONGER, SHORTER = 1.5, 0.4
LEAST_STEP = 1e-3
# Equilibria on the way are known this well: the next step starts from them.
WAY_TOLERANCE = 1e-8
# A pseudo-time step moves nothing further than this part of a contact line's free length, and there are so many.
PSEUDO_STEP, MOST_PSEUDO_STEPS = 0.1, 500
# Newton's method takes over at this residual. Chosen by measurement: heavy loads elsewhere hide the imbalance of a
# loose ball, and from 1e-3 Newton's method fails in more than twice as many random scenes.
NEAR_EQUILIBRIUM = 1e-9
# An imbalance that leads nowhere.
LOST = 1e30


@kernel
def heaviest_factor(case: recarray, work: recarray) -> float:
    """How many times its loads would press the balls hard; 1 where they do or there are none."""
    heavy = HEAVY_APPROACH**1.5 * case.ball_count * case.series_stiffness
    own = applied_load(case, work)
    return max(heavy / own, 1.0) if own > 0.0 else 1.0


@kernel
def follow(case: recarray, work: recarray, balls: ndarray, heaviest: float) -> float:
    """Follow the equilibrium from an easier case: under `heaviest` times the loads, or for 1 from rest.

    A workspace at rest stays so: then inertia is left out all the way.
    Leaves ring and balls in the last equilibrium found, and the factor that it is for in the workspace. Returns the
    part of the way gone; 1 is the case itself. The way up in speed ends where a contact leaves its groove.
    """
    in_loads = heaviest > 1.0
    reached, step = 0.0, 1.0
    if in_loads:
        step = min(log(LIGHTER) / log(heaviest), 1.0)
        work.load_factor = heaviest
    at_rest = work.at_rest
    if at_rest:
        reset_deflections(work, balls)
        guess_ring_at_rest(case, work)
        set_at_rest(case, work, balls)
    else:
        guess_from_rest(case, work, balls)
    save(work, balls, CONTINUATION)
    is_inside = True
    while reached < 1.0 and step >= LEAST_STEP and is_inside:
        part = min(1.0, reached + step)
        set_factors(work, heaviest, part)
        restore(work, balls, CONTINUATION)
        close_loops(case, work, balls)
        if newton(case, work, balls, GUESS_TOLERANCE if at_rest else WAY_TOLERANCE):
            save(work, balls, CONTINUATION)
            reached, step = part, LONGER * step
            is_inside = in_loads or contacts_outside_groove(case, work, balls) == 0
        else:
            step *= SHORTER
    set_factors(work, heaviest, reached)
    restore(work, balls, CONTINUATION)
    return reached


@kernel
def set_factors(work: recarray, heaviest: float, part: float) -> None:
    """The factors on loads and speeds at this part of the way; loads fall geometrically."""
    if heaviest > 1.0:
        work.load_factor = heaviest ** (1.0 - part)
    else:
        work.speed_factor = part


@kernel
def pseudo_transient(case: recarray, work: recarray, balls: ndarray) -> None:
    """Let ring and balls yield to their imbalance until Newton's method can take over."""
    close_loops(case, work, balls)
    longest = PSEUDO_STEP * (min(case.inner_coefficient, case.outer_coefficient) - 0.5)
    for _ in range(MOST_PSEUDO_STEPS):
        residual, _ = assemble(case, work, balls)
        if residual <= NEAR_EQUILIBRIUM or not residual < LOST or work.iterations >= work.budget:
            return
        work.regularisation = max(work.regularisation, residual * work.largest_force / longest)
        assemble(case, work, balls)
        fraction = propose_step(case, work, balls)
        if fraction < 0.0:
            return
        take_step(case, work, balls, fraction, False, False)
        work.iterations += 1
        if is_far(work):
            return
