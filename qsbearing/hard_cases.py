"""Cases that the direct way leaves: by ways round, under the law of friction and the raceway control that they admit.

Friction that must carry the gyroscopic moment whatever the load has no balance for many a ball with little load. Where
that has none at hand, one is sought with friction no more than load; then with what oiled steel carries, a tenth, which
is not far from a bearing without friction, and now by all ways round; then by these with friction no more than load;
last without a limit again, on the way up in speed.

From a balance found so balls that slip are lifted where they can be, or Newton's method goes to looser limits. Where
that gets to no balance without a limit the ball slips, and the limited balance tells it. Such a balance, or one with a
contact where no groove is, refuses the case only if no later law leads to a sound one: there often is one beside it.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.ball import FULL_GRIP, OILED_GRIP, UNLIMITED, is_moving, lay_midway, limit_friction
from qsbearing.compiled import entry, kernel
from qsbearing.contact import direction
from qsbearing.detours import GUESS, LOADS, REST, SEEN, WARM, find_balance, settle_at_rest
from qsbearing.keeping import PATH, REFUSED, SOLVED, STANDING, keep, restore
from qsbearing.newton import close_chains, newton
from qsbearing.raceway_control import PER_BALL
from qsbearing.ring import inner_groove_centre
from qsbearing.solver import deliver, prepare
from qsbearing.start import seat_balls
from qsbearing.verdict import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    MORE_THAN_LOAD,
    NO_CONSISTENT_CONTROL,
    NO_EQUILIBRIUM,
    NO_FORCE,
    NOT_CONVERGED,
    OPEN_SIDE,
    OVER_SHOULDER,
    RUNAWAY,
    UNLOADED_RING,
    asks_for,
    contradicted_controls,
    is_asked_for,
    is_unloaded,
    objections,
    outside_groove,
)

# The laws of friction in the order of trying: the limit; whether ways round are tried where friction acts; which way is
# tried first.
LIMITS = (UNLIMITED, FULL_GRIP, OILED_GRIP, FULL_GRIP, UNLIMITED)
GOES_ROUND = (False, False, True, True, False)
STARTS = (GUESS, GUESS, GUESS, GUESS, REST)
FULL, FULL_AGAIN, UP_IN_SPEED = 1, 3, 4
# So many evaluations each way round is worth, and so many where nothing is known after that.
WORTH, LONG_WORTH = 6000, 25000
# What a search may find: nothing; a balance that refuses the case, unless there is another; a sound one.
NOTHING, REFUSAL, SOUND = 0, 1, 2


@kernel
def slips(case: recarray, ring: recarray, balls: ndarray) -> bool:
    """Whether a balance owes itself to the limit of friction, or without one, to friction that no load presses."""
    if ring.limit == UNLIMITED:
        return objections(case, ring, balls) & FRICTION_WITHOUT_LOAD != 0
    return is_asked_for(case, ring, balls, ring.limit)


@kernel
def lift(case: recarray, ring: recarray, balls: ndarray) -> bool:
    """Take balls out of touch that slip though their grooves leave them room; whether there are any.

    Only where nothing throws them: a centrifugal force would press them again.
    """
    is_any = False
    if case.centrifugal:
        return is_any
    for n in range(ring.balls):
        ball = balls[n]
        if asks_for(case, ring, ball, MORE_THAN_LOAD, NO_FORCE):
            a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
            length, s, c = case.inner_coefficient + case.outer_coefficient - 1.0, case.sin_free, case.cos_free
            if direction(length, s, c, a1, a2)[0] <= 0.0:
                lay_midway(case, ball, a1, a2)
                is_any = True
    return is_any


@kernel
def loosen(case: recarray, ring: recarray, balls: ndarray, tolerance: float, residual: float) -> tuple[int, float]:
    """From a balance in which balls slip to one in which none does, or else fewer may, if Newton's method finds it.

    Without a limit from where slipping balls are lifted; then under looser limits, from where they are. Returns
    (iterations, residual of the balance that it leaves, under the limit that it leaves).
    """
    limit, total = ring.limit, 0
    keep(ring, balls, PATH)
    if lift(case, ring, balls):
        limit_friction(ring, UNLIMITED)
        converged, iterations, found = newton(case, ring, balls, tolerance)
        total += iterations
        if converged and objections(case, ring, balls) == 0:
            return total, found
    for looser in (FULL_GRIP, UNLIMITED):
        if looser == limit or limit == UNLIMITED:
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
    restore(ring, balls, PATH)
    limit_friction(ring, limit)
    return total, residual


@kernel
def settle(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, first: int, worth: int
) -> tuple[int, int, float, int]:
    """A balance under the controls as they are, by the first law of friction with a sound one.

    Else the first found that refuses the case, under its own law. Ways round are worth so many evaluations each.

    Returns:
        (what it is, iterations, relative residual, what forbids a balance: 0 where nothing is known to).
    """
    total, refused, refused_limit, is_slipping = 0, -1.0, UNLIMITED, False
    residual, notes = 1.0, 0
    for law in range(len(LIMITS)):
        if law == FULL_AGAIN and is_slipping:
            continue
        limit_friction(ring, LIMITS[law])
        start = first if law == 0 else STARTS[law]
        may_go_round = GOES_ROUND[law] or not case.gyroscopic
        converged, iterations, residual, notes = find_balance(
            case, ring, balls, tolerance, start, worth if may_go_round else 0
        )
        total += iterations
        if converged:
            if slips(case, ring, balls):
                iterations, residual = loosen(case, ring, balls, tolerance, residual)
                total += iterations
            does_slip = slips(case, ring, balls)
            is_outside = outside_groove(case, ring, balls) != 0
            if not does_slip:
                limit_friction(ring, UNLIMITED)
                if not is_outside:
                    return SOUND, total, residual, 0
            is_refusing = not does_slip or (ring.limit != UNLIMITED and is_asked_for(case, ring, balls, MORE_THAN_LOAD))
            if is_refusing and refused < 0.0:
                keep(ring, balls, REFUSED)
                refused, refused_limit = residual, ring.limit
            is_slipping = is_slipping or (law == FULL and not is_outside)
        if not case.gyroscopic or (notes != 0 and not converged):
            break
    if refused >= 0.0:
        restore(ring, balls, REFUSED)
        limit_friction(ring, refused_limit)
        ring.reached = 1.0
        return REFUSAL, total, refused, 0
    if law == UP_IN_SPEED:  # what ends there ends for friction without limit only
        notes = 0
    return REFUSAL if converged else NOTHING, total, residual, notes


@kernel
def solve_moving(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float, int]:
    """Equilibrium at speed: (converged, iterations, relative residual, notes); `ring.reached` is the speed it is for.

    With per-ball control a balance may change the controls that Jones's criterion contradicts, and the next is sought
    from there. Controls that have no sound solution are no choice: the last sound balance stands, and is not
    consistent; where there is none, the last balance does.
    """
    total, solved, solved_limit, standing = 0, -1.0, UNLIMITED, -1.0
    first = LOADS
    while True:
        found, iterations, residual, notes = settle(case, ring, balls, tolerance, first, WORTH)
        total += iterations
        if found == NOTHING and notes == 0 and solved < 0.0:
            found, iterations, residual, notes = settle(case, ring, balls, tolerance, GUESS, LONG_WORTH)
            total += iterations
        if found == NOTHING and solved >= 0.0:
            restore(ring, balls, SOLVED)
            limit_friction(ring, solved_limit)
            found, residual, notes = REFUSAL, solved, NO_CONSISTENT_CONTROL
            break
        if found == NOTHING or case.control != PER_BALL:
            break
        keep(ring, balls, SOLVED)
        solved, solved_limit = residual, ring.limit
        if found == SOUND:
            keep(ring, balls, STANDING)
            standing = residual
        wrong, changed = contradicted_controls(case, ring, balls)
        if changed == 0:
            if wrong > 0:
                notes = NO_CONSISTENT_CONTROL
            break
        first = WARM
    if standing >= 0.0 and found != SOUND:
        restore(ring, balls, STANDING)
        limit_friction(ring, UNLIMITED)
        found, residual, notes = SOUND, standing, NO_CONSISTENT_CONTROL
    converged = found != NOTHING
    if converged:
        ring.reached = 1.0
        if ring.limit != UNLIMITED:
            converged = is_asked_for(case, ring, balls, MORE_THAN_LOAD)
            notes |= FRICTION_WITHOUT_LOAD if converged else 0
    return converged, total, residual, notes


@kernel
def solve_with_detours(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[int, int, int, float]:
    """Solve one case, ring and balls in place: (status, notes, iterations, relative residual)."""
    notes = 0
    if is_moving(case):
        converged, iterations, residual, notes = solve_moving(case, ring, balls, tolerance)
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
        status[k], notes[k], more, residual[k] = solve_with_detours(case, ring, balls, tolerance)
        iterations[k] += more
        reached[k] = ring.reached
        deliver(case, ring, balls, displacement[k], position[k], control[k], load[k])
