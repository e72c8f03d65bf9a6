"""Cases that the direct way leaves: by ways round, under the law of friction and the raceway control that they admit.

Friction that must carry the gyroscopic moment whatever the load has no balance for many a ball with little load. Where
that has none at hand, one is sought with friction no more than load; then with what oiled steel carries, a tenth, which
is not far from a bearing without friction, and now by all ways round; last by these with friction no more than load. A
balance with a contact where no groove is stands only if no later law has a better.
From a balance found so Newton's method goes to looser limits. Where it gets to no balance without a limit the ball
slips, and the limited balance tells it.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import FULL_GRIP, OILED_GRIP, UNLIMITED, is_moving, limit_friction
from qsbearing.compiled import entry, kernel
from qsbearing.detours import GUESS, LOADS, SEEN, WARM, WAYS_ROUND, find_balance, settle_at_rest
from qsbearing.keeping import REFUSED, SOLVED, STANDING, keep, restore
from qsbearing.newton import close_chains, newton
from qsbearing.raceway_control import PER_BALL
from qsbearing.solver import deliver, prepare
from qsbearing.start import seat_balls
from qsbearing.verdict import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    MORE_THAN_LOAD,
    NO_CONSISTENT_CONTROL,
    NO_EQUILIBRIUM,
    NOT_CONVERGED,
    OPEN_SIDE,
    OVER_SHOULDER,
    RUNAWAY,
    UNLOADED_RING,
    contradicted_controls,
    is_asked_for,
    is_unloaded,
    objections,
    outside_groove,
)

# Limits of friction in the order of trying, and the first with which paths are worth following.
LAWS = (UNLIMITED, FULL_GRIP, OILED_GRIP, FULL_GRIP)
PATHS_FROM, LAST_LAW = 2, 3
# In the place of a way to start: ring and balls are in balance already.
SETTLED = -1


@kernel
def loosen(case: recarray, ring: recarray, balls: ndarray, tolerance: float, residual: float) -> tuple[int, float]:
    """From a balance with limited friction to one with a looser limit, or none, if Newton's method finds it from there.

    Returns (iterations, residual of the balance that it leaves, under the limit that it leaves).
    """
    keep(ring, balls, SOLVED)
    limit, total = ring.limit, 0
    for looser in (FULL_GRIP, UNLIMITED):
        if looser == limit:
            continue
        restore(ring, balls, SOLVED)
        limit_friction(ring, looser)
        close_chains(case, ring, balls)
        converged, iterations, found = newton(case, ring, balls, tolerance)
        total += iterations
        against = objections(case, ring, balls) if looser == UNLIMITED else outside_groove(case, ring, balls)
        if converged and against == 0:
            keep(ring, balls, SOLVED)
            limit, residual = looser, found
            if looser != UNLIMITED and not is_asked_for(case, ring, balls, looser):
                limit = UNLIMITED  # which it keeps to unasked
                break
    restore(ring, balls, SOLVED)
    limit_friction(ring, limit)
    return total, residual


@kernel
def solve_moving(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[bool, int, float, int]:
    """Equilibrium at speed: (converged, iterations, relative residual, notes); `ring.reached` is the speed it is for.

    With per-ball control a balance may change the controls that Jones's criterion contradicts, and the next is sought
    from there. Controls that have no solution, or one in which balls slip, are no choice: the last balance found
    stands, and is not consistent.
    """
    law, total, residual, notes, converged, is_free = 0, 0, 1.0, 0, False, False
    solved_residual, solved_limit, standing_residual, refused_residual, refused_law = -1.0, UNLIMITED, -1.0, -1.0, 0
    first = WARM if is_warm else LOADS
    while True:
        notes = 0
        if first != SETTLED:
            ways = WAYS_ROUND if law >= PATHS_FROM or not case.gyroscopic else 0
            converged, iterations, residual, notes = find_balance(case, ring, balls, tolerance, first, ways)
            total += iterations
            is_sound = converged and outside_groove(case, ring, balls) == 0
            if is_sound:
                refused_residual = -1.0
            elif converged and refused_residual < 0.0:
                keep(ring, balls, REFUSED)
                refused_residual, refused_law = residual, law
            if not is_sound and notes == 0 and case.gyroscopic and law < LAST_LAW:
                law += 1
                limit_friction(ring, LAWS[law])
                first = GUESS
                continue
            if refused_residual >= 0.0:
                restore(ring, balls, REFUSED)
                limit_friction(ring, LAWS[refused_law])
                converged, residual, notes, law = True, refused_residual, 0, refused_law
                refused_residual = -1.0
            if not converged:
                is_free = False
                if solved_residual >= 0.0:
                    restore(ring, balls, SOLVED)
                    limit_friction(ring, solved_limit)
                    converged, residual, notes = True, solved_residual, NO_CONSISTENT_CONTROL
                break
        if ring.limit == UNLIMITED:
            is_free = objections(case, ring, balls) & FRICTION_WITHOUT_LOAD == 0
        else:
            is_free = not is_asked_for(case, ring, balls, ring.limit)
        if case.control == PER_BALL:
            keep(ring, balls, SOLVED)
            solved_residual, solved_limit = residual, ring.limit
            if is_free:
                keep(ring, balls, STANDING)
                standing_residual = residual
            wrong, changed = contradicted_controls(case, ring, balls)
            if changed > 0:
                first = WARM
                continue
            if wrong > 0:
                notes = NO_CONSISTENT_CONTROL
        if is_free:
            limit_friction(ring, UNLIMITED)
            break
        if ring.limit == UNLIMITED:
            law = max(law, 1)
        else:
            iterations, residual = loosen(case, ring, balls, tolerance, residual)
            total += iterations
            if ring.limit == UNLIMITED:
                first = SETTLED
                continue
            if law == LAST_LAW or is_asked_for(case, ring, balls, MORE_THAN_LOAD):
                break
            law = LAST_LAW
        limit_friction(ring, LAWS[law])
        first, solved_residual = GUESS, -1.0
    if standing_residual >= 0.0 and not is_free:
        restore(ring, balls, STANDING)
        limit_friction(ring, UNLIMITED)
        converged, residual, notes = True, standing_residual, NO_CONSISTENT_CONTROL
    if converged:
        ring.reached = 1.0
        if ring.limit != UNLIMITED:
            converged = is_asked_for(case, ring, balls, MORE_THAN_LOAD)
            notes |= FRICTION_WITHOUT_LOAD if converged else 0
    return converged, total, residual, notes


@kernel
def solve_with_detours(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[int, int, int, float]:
    """Solve one case, ring and balls in place: (status, notes, iterations, relative residual)."""
    notes = 0
    if is_moving(case):
        converged, iterations, residual, notes = solve_moving(case, ring, balls, tolerance, is_warm)
    else:
        converged, iterations, residual = settle_at_rest(case, ring, balls, tolerance)
        if ring.ran_away and not converged:
            notes = RUNAWAY
        seat_balls(case, ring, balls)
        if not converged and residual <= SEEN:
            notes |= objections(case, ring, balls)
    if is_unloaded(case):
        notes |= UNLOADED_RING
    if converged:
        notes |= objections(case, ring, balls)
    if notes & (OPEN_SIDE | OVER_SHOULDER | FRICTION_WITHOUT_LOAD | RUNAWAY):
        return NO_EQUILIBRIUM, notes, iterations, residual
    return CONVERGED if converged else NOT_CONVERGED, notes, iterations, residual


@entry
def solve_hard_cases(
    which: ndarray,
    cases: ndarray,
    rings: ndarray,
    balls: ndarray,
    tolerance: float,
    is_warm: bool,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    load: ndarray,
    status: ndarray,
    notes: ndarray,
    iterations: ndarray,
    residual: ndarray,
    reached: ndarray,
) -> None:
    """Solve the cases of these numbers by detours; arguments as for the direct way, iterations added to its own."""
    ring = rings[0]
    for k in which:
        case = cases[k]
        prepare(case, ring, balls, is_warm, displacement[k], position[k], control[k])
        status[k], notes[k], more, residual[k] = solve_with_detours(case, ring, balls, tolerance, is_warm)
        iterations[k] += more
        reached[k] = ring.reached
        deliver(case, ring, balls, displacement[k], position[k], control[k], load[k])
