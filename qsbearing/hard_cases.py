"""Cases that the direct way leaves: by ways round, under the law of friction and the raceway control that they admit.

Friction that must carry the gyroscopic moment whatever the load has no balance for many a ball with little load. Where
that has none at hand, one is sought with friction no more than load; then with what oiled steel carries, a tenth, which
is not far from a bearing without friction, and now by all ways round; then by these with friction no more than load;
last without a limit again, on the way up in speed.

From a balance found so Newton's method goes to looser limits. Where it gets to no balance without a limit the ball
slips, and the limited balance tells it. Such a balance, or one with a contact where no groove is, refuses the case only
if no later law leads to a sound one: there often is one beside it.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import FULL_GRIP, OILED_GRIP, UNLIMITED, is_moving, limit_friction
from qsbearing.compiled import entry, kernel
from qsbearing.detours import GUESS, LOADS, REST, SEEN, WARM, find_balance, settle_at_rest
from qsbearing.keeping import PATH, REFUSED, SOLVED, STANDING, keep, restore
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

# Limits of friction in the order of trying: the third and the fourth by all ways, the fifth by the way up in speed.
LAWS = (UNLIMITED, FULL_GRIP, OILED_GRIP, FULL_GRIP, UNLIMITED)
FIRST_LAW, FULL, OILED, FULL_AGAIN, UP_IN_SPEED = 0, 1, 2, 3, 4
# So many evaluations each way round is worth, and so many where nothing is known after that.
WORTH, LONG_WORTH = 6000, 25000


@kernel
def loosen(case: recarray, ring: recarray, balls: ndarray, tolerance: float, residual: float) -> tuple[int, float]:
    """From a balance with limited friction to one with a looser limit, or none, if Newton's method finds it from there.

    Returns (iterations, residual of the balance that it leaves, under the limit that it leaves).
    """
    keep(ring, balls, PATH)
    limit, total = ring.limit, 0
    for looser in (FULL_GRIP, UNLIMITED):
        if looser == limit:
            continue
        restore(ring, balls, PATH)
        limit_friction(ring, looser)
        close_chains(case, ring, balls)
        converged, iterations, found = newton(case, ring, balls, tolerance)
        total += iterations
        against = objections(case, ring, balls) if looser == UNLIMITED else outside_groove(case, ring, balls)
        if converged and against == 0:
            keep(ring, balls, PATH)
            limit, residual = looser, found
            if looser != UNLIMITED and not is_asked_for(case, ring, balls, looser):
                limit = UNLIMITED  # which it keeps to unasked
                break
    restore(ring, balls, PATH)
    limit_friction(ring, limit)
    return total, residual


@kernel
def slips(case: recarray, ring: recarray, balls: ndarray) -> bool:
    """Whether a balance owes itself to the limit of friction, or without one, to friction that no load presses."""
    if ring.limit == UNLIMITED:
        return objections(case, ring, balls) & FRICTION_WITHOUT_LOAD != 0
    return is_asked_for(case, ring, balls, ring.limit)


@kernel
def is_sound(case: recarray, ring: recarray, balls: ndarray) -> bool:
    """Whether a balance has all contacts in their grooves, and friction that they carry."""
    return outside_groove(case, ring, balls) == 0 and not slips(case, ring, balls)


@kernel
def settle(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, first: int, worth: int
) -> tuple[bool, int, float, int]:
    """A balance under the controls as they are, by the first law of friction with a sound one; returns as finding does.

    Ways round are worth so many evaluations each. Else the first found that refuses the case, under its own law.
    """
    total, refused, refused_limit, is_slipping = 0, -1.0, UNLIMITED, False
    converged, residual, notes = False, 1.0, 0
    for law in range(len(LAWS)):
        if law == FULL_AGAIN and is_slipping:
            continue
        limit_friction(ring, LAWS[law])
        start = first if law == FIRST_LAW else REST if law == UP_IN_SPEED else GUESS
        may_go_round = not case.gyroscopic or law == OILED or law == FULL_AGAIN
        converged, iterations, residual, notes = find_balance(
            case, ring, balls, tolerance, start, worth if may_go_round else 0
        )
        total += iterations
        if converged:
            if ring.limit != UNLIMITED and slips(case, ring, balls):
                iterations, residual = loosen(case, ring, balls, tolerance, residual)
                total += iterations
            does_slip = slips(case, ring, balls)
            if not does_slip:
                limit_friction(ring, UNLIMITED)
                if outside_groove(case, ring, balls) == 0:
                    return True, total, residual, 0
            is_refusing = not does_slip or (ring.limit != UNLIMITED and is_asked_for(case, ring, balls, MORE_THAN_LOAD))
            if is_refusing and refused < 0.0:
                keep(ring, balls, REFUSED)
                refused, refused_limit = residual, ring.limit
            is_slipping = is_slipping or (law == FULL and outside_groove(case, ring, balls) == 0)
        if not case.gyroscopic or (notes != 0 and not converged):
            break
    if refused >= 0.0:
        restore(ring, balls, REFUSED)
        limit_friction(ring, refused_limit)
        ring.reached = 1.0
        return True, total, refused, 0
    if law == UP_IN_SPEED:  # what ends there ends for friction without limit only
        notes = 0
    return converged, total, residual, notes


@kernel
def solve_moving(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[bool, int, float, int]:
    """Equilibrium at speed: (converged, iterations, relative residual, notes); `ring.reached` is the speed it is for.

    With per-ball control a balance may change the controls that Jones's criterion contradicts, and the next is sought
    from there. Controls that have no sound solution are no choice: the last sound balance stands, and is not
    consistent; where there is none, the last balance does.
    """
    total, solved, solved_limit, standing = 0, -1.0, UNLIMITED, -1.0
    first = WARM if is_warm else LOADS
    while True:
        converged, iterations, residual, notes = settle(case, ring, balls, tolerance, first, WORTH)
        total += iterations
        if not converged and notes == 0 and solved < 0.0:
            converged, iterations, residual, notes = settle(case, ring, balls, tolerance, GUESS, LONG_WORTH)
            total += iterations
        stands = converged and is_sound(case, ring, balls)
        if not converged and solved >= 0.0:
            restore(ring, balls, SOLVED)
            limit_friction(ring, solved_limit)
            converged, residual, notes = True, solved, NO_CONSISTENT_CONTROL
            break
        if not converged or case.control != PER_BALL:
            break
        keep(ring, balls, SOLVED)
        solved, solved_limit = residual, ring.limit
        if stands:
            keep(ring, balls, STANDING)
            standing = residual
        wrong, changed = contradicted_controls(case, ring, balls)
        if changed == 0:
            if wrong > 0:
                notes = NO_CONSISTENT_CONTROL
            break
        first = WARM
    if standing >= 0.0 and not stands:
        restore(ring, balls, STANDING)
        limit_friction(ring, UNLIMITED)
        converged, residual, notes = True, standing, NO_CONSISTENT_CONTROL
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
