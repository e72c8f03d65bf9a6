"""The fallback for cases that Newton's method from two starts does not solve.

At rest the energy is convex: continuation from heavier loads or, failing that, pseudo-time steps find its minimum, or
show that nothing supports the load.

At speed two strategies are tried, each ending in Newton's method: continuation from heavier loads, and continuation in
speed; pseudo-time steps go on where a continuation ends or Newton's method finds nothing. They are tried for the
equations as they stand, in which friction carries the gyroscopic moment whatever the load, then with friction bounded
by the load and by a tenth of it. A ball that reaches the bound slips. From there the bound is released, and where
Newton's method then finds an equilibrium, it stands. A case with a friction coefficient of its own is tried under that
one in place of none, and under the tighter ones of the two.

The first sound equilibrium is taken. Where there is none, the first inadmissible one refuses the case: a contact where
no groove is, friction above its load, or balls that stand, as the direct stage may have found them. That another exists
somewhere is not excluded.
"""

from __future__ import annotations

import numpy as np
from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.effects.raceway_control import INNER, OUTER, PER_BALL
from qsbearing.model.kernel.admissibility import (
    CONVERGED,
    LOAD_BOUND,
    NO_EQUILIBRIUM,
    NO_FORCE,
    NOT_CONVERGED,
    UNSUPPORTED,
    any_demands_friction,
    contacts_outside_groove,
    inadmissibility,
)
from qsbearing.model.kernel.ball_inertia import is_moving
from qsbearing.model.kernel.continuation import follow, heaviest_factor, pseudo_transient
from qsbearing.model.kernel.initial_guess import guess_from_rest, guess_ring_at_rest, split_contacts
from qsbearing.model.kernel.newton import newton
from qsbearing.model.kernel.newton_step import is_far
from qsbearing.model.kernel.ring_bending import reset_deflections
from qsbearing.model.kernel.snapshots import ADMISSIBLE, BOUNDED, CONTINUATION, INADMISSIBLE, restore, restore_all, save
from qsbearing.model.kernel.solve_case import (
    CONTRADICTED,
    NOTHING,
    REFUSED,
    SOUND,
    deliver,
    prepare,
    remarks,
    set_controls,
    solve_with_controls,
)
from qsbearing.model.kernel.workspace import FOUND, GIVEN

# The strategies at speed, in the order of trying.
LIGHTER_LOADS, UP_IN_SPEED = 0, 1
# The bounds on friction over load, in the order of trying; the last is what oiled steel carries. Chosen by measurement:
# without the last, 44 of 200,000 random scenes lose their equilibrium, 27 of which are then refused.
OILED_BOUND = 0.1


@kernel
def solve_rest(case: recarray, work: recarray, balls: ndarray, tolerance: float) -> int:
    """The equilibrium without inertia: what is found. Where nothing supports the load the ring ends far away."""
    work.at_rest = True
    heaviest = heaviest_factor(case, work)
    converged = False
    if heaviest > 1.0:
        follow(case, work, balls, heaviest)
        work.load_factor = 1.0
        converged = newton(case, work, balls, tolerance)
    if not converged:
        reset_deflections(work, balls)
        guess_ring_at_rest(case, work)
        pseudo_transient(case, work, balls)
        converged = not is_far(work) and newton(case, work, balls, tolerance)
    split_contacts(case, work, balls)
    if not converged:
        return NOTHING
    return SOUND if inadmissibility(case, work, balls) == 0 else REFUSED


@kernel
def try_strategy(case: recarray, work: recarray, balls: ndarray, tolerance: float, strategy: int) -> int:
    """One strategy, then Newton's method under the bound on friction that is set: what is found.

    Where the way up in speed ends and nothing is found beyond, the last equilibrium on it is judged: inadmissible, it
    refuses the case at the speed factor that is left in the workspace.
    """
    heaviest = heaviest_factor(case, work) if strategy == LIGHTER_LOADS else 1.0
    if strategy == LIGHTER_LOADS and heaviest == 1.0:  # its loads are heavy
        guess_from_rest(case, work, balls)
        reached = 1.0
    else:
        reached = follow(case, work, balls, heaviest)
    work.load_factor, work.speed_factor = 1.0, 1.0
    outcome = solve_with_controls(case, work, balls, tolerance) if reached == 1.0 else NOTHING
    if outcome == NOTHING:
        pseudo_transient(case, work, balls)
        outcome = solve_with_controls(case, work, balls, tolerance)
    if outcome == NOTHING and strategy == UP_IN_SPEED and 0.0 < reached < 1.0:
        restore(work, balls, CONTINUATION)
        work.speed_factor = reached
        if newton(case, work, balls, tolerance) and inadmissibility(case, work, balls) != 0:
            outcome = REFUSED
    return outcome


@kernel
def release_bound(case: recarray, work: recarray, balls: ndarray, tolerance: float, outcome: int) -> int:
    """From an equilibrium with bounded friction to one without the bound, or with the case's own: what is found."""
    own = case.friction_coefficient
    if not any_demands_friction(case, work, balls, work.friction_bound, NO_FORCE):
        work.friction_bound = own
        return outcome
    save(work, balls, BOUNDED)
    work.friction_bound = own
    released = solve_with_controls(case, work, balls, tolerance)
    if released >= CONTRADICTED:
        return released
    restore_all(work, balls, BOUNDED)
    return REFUSED if inadmissibility(case, work, balls) != 0 else NOTHING


@kernel
def solve_at_speed_by_fallback(case: recarray, work: recarray, balls: ndarray, tolerance: float) -> int:
    """All strategies, without and with a bound on friction: what is found, with ring and balls left in it."""
    is_contradicted, evidence = False, 0
    own = case.friction_coefficient
    for tried in (NO_BOUND, LOAD_BOUND, OILED_BOUND):
        if tried != NO_BOUND and not case.gyroscopic:
            break
        if own != NO_BOUND and tried != NO_BOUND and tried >= own:
            continue
        bound = own if tried == NO_BOUND else tried
        for control in range(OUTER, INNER + 1 if case.control == PER_BALL else OUTER + 1):
            for strategy in (LIGHTER_LOADS, UP_IN_SPEED):
                set_controls(case, work, balls, control)
                work.load_factor, work.speed_factor, work.friction_bound = 1.0, 1.0, bound
                outcome = try_strategy(case, work, balls, tolerance, strategy)
                if bound != own and outcome != NOTHING and work.speed_factor == 1.0:
                    outcome = release_bound(case, work, balls, tolerance, outcome)
                if outcome == SOUND:
                    return SOUND
                if outcome == CONTRADICTED and not is_contradicted:
                    is_contradicted = True
                    save(work, balls, ADMISSIBLE)
                if outcome == REFUSED:
                    # Friction above load is better shown by the ball that slips under the bound than without one.
                    is_plain = bound != NO_BOUND or contacts_outside_groove(case, work, balls) != 0
                    if evidence < (2 if is_plain else 1):
                        evidence = 2 if is_plain else 1
                        save(work, balls, INADMISSIBLE)
    if is_contradicted:
        restore_all(work, balls, ADMISSIBLE)
        return CONTRADICTED
    if evidence > 0:
        restore_all(work, balls, INADMISSIBLE)
        return REFUSED
    return NOTHING


@kernel
def solve_by_fallback(case: recarray, work: recarray, balls: ndarray, tolerance: float) -> tuple[int, int]:
    """Solve one case, ring and balls in place: (status, what there is to say of it as bits)."""
    if not is_moving(case):
        outcome = solve_rest(case, work, balls, tolerance)
    else:
        outcome = solve_at_speed_by_fallback(case, work, balls, tolerance)
        if outcome == NOTHING:  # unless it has no equilibrium at rest already
            work.load_factor, work.speed_factor, work.friction_bound = 1.0, 0.0, case.friction_coefficient
            residual = work.residual
            if solve_rest(case, work, balls, tolerance) == REFUSED:
                outcome = REFUSED
            elif not is_far(work):
                work.speed_factor, work.residual = 1.0, residual
    notes = remarks(case, work, balls, outcome)
    if outcome >= CONTRADICTED:
        return CONVERGED, notes
    if outcome == REFUSED:
        return NO_EQUILIBRIUM, notes | inadmissibility(case, work, balls)
    if is_far(work):
        return NO_EQUILIBRIUM, notes | UNSUPPORTED
    return NOT_CONVERGED, notes


@entry(array_of(np.int64), *GIVEN, float, int, bool, *FOUND)
def solve_unfinished(
    which: ndarray,
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    own: ndarray,
    tolerance: float,
    budget: int,
    is_warm: bool,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
) -> None:
    """Solve the cases of these numbers; arguments as for `solve_cases`, iterations added to its own."""
    work = workspaces[0]
    work.budget = budget
    for k in which:
        case, result = cases[k], results[k]
        prepare(case, work, balls, own[k], is_warm, result, positions[k], controls[k])
        status, notes = solve_by_fallback(case, work, balls, tolerance)
        result.iterations += work.iterations
        if status == NOT_CONVERGED and result.notes != 0:
            result.status, result.reached = NO_EQUILIBRIUM, 1.0
            continue
        result.status, result.notes = status, notes
        result.residual, result.reached = work.residual, work.speed_factor
        deliver(case, work, balls, result, positions[k], controls[k])
