"""Ways round, for the few cases that the direct way leaves: other starts, descent, continuation in load and in speed.

At rest the problem is convex, and descent cannot fail. At speed Newton's method starts once more from a solution under
heavier loads; then from the bearing at rest, and where the full speed is too far from there, by continuation in speed.
On that way a balance is followed until the full speed is reached, or to where it ends: where a contact leaves its
groove, or where it turns back, and the bearing would jump to another balance. There relaxation goes where it would.
Where that finds no rest, a path is followed, through its turning points, to a balance from one that cannot fail to
exist, where dead forces press every ball; then from the last balance on the way, and once more from pressed balls.

Friction that must carry the gyroscopic moment whatever the load has no balance for many a ball with little load. Such
cases are solved with friction no more than load, and from there without that limit; where that fails, the ball slips.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import FULL_GRIP, UNLIMITED, is_moving, set_speed
from qsbearing.compiled import entry, inlined, kernel
from qsbearing.descent import descend
from qsbearing.keeping import ON_THE_WAY, SOLVED, keep, restore
from qsbearing.newton import applied_load, close_chains, newton
from qsbearing.path_following import follow, press
from qsbearing.raceway_control import PER_BALL
from qsbearing.relaxation import relax_to_rest
from qsbearing.solver import deliver, first_guess, prepare, rest
from qsbearing.start import ring_at_rest, seat_balls
from qsbearing.verdict import (
    CONVERGED,
    FRICTION_WITHOUT_LOAD,
    NO_CONSISTENT_CONTROL,
    NO_EQUILIBRIUM,
    NOT_CONVERGED,
    OPEN_SIDE,
    OVER_SHOULDER,
    RUNAWAY,
    UNLOADED_RING,
    contradicted_controls,
    is_unloaded,
    objections,
)

# Where a solve at speed starts, in this order: from the start given, closed forms, heavier loads, rest; and from a
# balance with limited friction, to one without that limit.
WARM, GUESS, LOADS, REST, CONTINUATION, RELEASE = 0, 1, 2, 3, 4, 5
# The part of the speed below which continuation takes no smaller step.
LEAST_STRIDE = 1e-4
# How well the balance at rest must be known for Newton to start from it.
REST_TOLERANCE = 1e-3
# How far descent goes, before Newton's method takes the last steps.
FOOT = 1e-8
# Loads that press balls by this many diameters at rest are heavy; on the way down from them each is so much lighter.
HEAVY_APPROACH = 1e-3
LIGHTER = 10.0
LEAST_LIGHTER = 1.5
# At speed loads may become far lighter than inertia, and must still be balanced on that way, so well.
LIGHT_TOLERANCE = 1e-8
# The one balance at rest, known this well, shows where its contacts lie, though its loads be too light to resolve.
SEEN = 1e-3
# Paths to follow, each from another start; this one from the last balance on the way, the others from pressed balls.
STARTS, FROM_BALANCE = 3, 1
# A ring that has gone this many ball diameters (or, for tilts, radians) has met nothing that would stop it.
RUNAWAY_DISTANCE = 5.0


@kernel
def set_loads(case: recarray, ring: recarray, factor: float) -> None:
    """Load the ring with this many times its loads."""
    for i in range(5):
        if not case.is_held[i]:
            case.prescribed[i] = factor * ring.load[i]


@kernel
def heavy_factor(case: recarray) -> float:
    """How many times the loads would press the balls hard."""
    own = applied_load(case)
    return HEAVY_APPROACH**1.5 * case.ball_count * case.series_stiffness / own if own > 0.0 else 1.0


@kernel
def from_above(case: recarray, ring: recarray, balls: ndarray, is_at_speed: bool) -> int:
    """Bring ring and balls to balance under loads ever lighter, down to nearly their own; returns the iterations taken.

    Loads so heavy that every ball is pressed, and inertia hardly counts, are easy. Light loads leave open which few
    balls carry them: a choice hard to make at once and easy to follow. Where it is lost, the next load is nearer.
    """
    factor, lighter, total = heavy_factor(case), LIGHTER, 0
    if factor <= 1.0:
        return 0
    set_loads(case, ring, factor)
    ring_at_rest(case, ring.displacement)
    if is_at_speed:
        _, total, _ = rest(case, ring, balls, REST_TOLERANCE)
        seat_balls(case, ring, balls)
    keep(ring, balls, ON_THE_WAY)
    while True:
        set_loads(case, ring, factor)
        if is_at_speed:
            converged, iterations, _ = newton(case, ring, balls, LIGHT_TOLERANCE)
        else:
            converged, iterations, _ = rest(case, ring, balls, REST_TOLERANCE)
        total += iterations
        if converged:
            keep(ring, balls, ON_THE_WAY)
            if factor <= LIGHTER:
                break
        else:
            restore(ring, balls, ON_THE_WAY)
            factor *= lighter
            lighter = sqrt(lighter)
            if lighter < LEAST_LIGHTER:
                break
        factor = max(factor / lighter, 1.0)
        if is_at_speed:
            close_chains(case, ring, balls)
    set_loads(case, ring, 1.0)
    restore(ring, balls, ON_THE_WAY)
    return total


@kernel
def settle_at_rest(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Solve the case at rest from scratch: (converged, iterations, residual); the balls still need their seats."""
    ring_at_rest(case, ring.displacement)
    total = from_above(case, ring, balls, False)
    converged, iterations, residual = rest(case, ring, balls, tolerance)
    total += iterations
    if not converged:
        ring_at_rest(case, ring.displacement)
        _, before, _ = descend(case, ring, balls, FOOT)
        converged, iterations, residual = rest(case, ring, balls, tolerance)
        total += before + iterations
    for i in range(5):
        if not case.is_held[i] and not abs(ring.displacement[i]) < RUNAWAY_DISTANCE:
            ring.ran_away = True
    return converged, total, residual


@kernel
def slips(case: recarray, ring: recarray, balls: ndarray) -> bool:
    """Whether some contact is asked for more friction than its load."""
    return objections(case, ring, balls, True) & FRICTION_WITHOUT_LOAD != 0


@inlined
def solve_moving(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[bool, int, float, int]:
    """Equilibrium at speed: (converged, iterations, relative residual, notes); `ring.reached` is the speed it is for.

    One loop, one Newton: each turn first puts ring and balls where the present attempt starts. With per-ball control a
    converged turn may change the controls that Jones's criterion contradicts and go on from where it stands. Controls
    that have no solution are no choice: the last balance found stands, and is not consistent.

    The gyroscopic moment asks for friction whatever the load. Where that has no balance at hand, one is sought in which
    no contact carries more friction than load, and from there one without that limit. If there is none, the limited
    balance tells why: the ball slips.
    """
    inner, outer = case.inner_speed, case.outer_speed
    attempt = WARM if is_warm else LOADS
    total, solved_residual, solved_grip = 0, -1.0, UNLIMITED
    reached, stride = 0.0, 1.0
    while True:
        part = 1.0
        if attempt == WARM or attempt == RELEASE:
            close_chains(case, ring, balls)
        elif attempt == GUESS:
            first_guess(case, ring, balls)
        elif attempt == LOADS:
            total += from_above(case, ring, balls, True)
            close_chains(case, ring, balls)
        else:
            if attempt == REST:
                _, iterations, _ = settle_at_rest(case, ring, balls, REST_TOLERANCE)
                total += iterations
                if ring.ran_away:
                    return False, total, 1.0, RUNAWAY
                seat_balls(case, ring, balls)
                keep(ring, balls, ON_THE_WAY)
                attempt, reached, stride = CONTINUATION, 0.0, 1.0
            part = min(1.0, reached + stride)
            set_speed(case, part, inner, outer)
            restore(ring, balls, ON_THE_WAY)
            close_chains(case, ring, balls)
        converged, iterations, residual = newton(case, ring, balls, tolerance)
        total += iterations
        ring.reached = part
        if attempt == RELEASE and not (converged and objections(case, ring, balls, not converged) == 0):
            restore(ring, balls, SOLVED)
            ring.grip = solved_grip
            return True, total, solved_residual, 0
        if attempt == CONTINUATION:
            against = 0
            if converged:
                against = objections(case, ring, balls, not converged)
                keep(ring, balls, ON_THE_WAY)
                reached, stride = part, 1.5 * stride
            else:
                stride *= 0.4
                if stride < LEAST_STRIDE:
                    set_speed(case, reached, inner, outer)
                    ring.reached = reached
                    if reached > 0.0:
                        restore(ring, balls, ON_THE_WAY)
                    else:
                        _, iterations, _ = settle_at_rest(case, ring, balls, tolerance)
                        total += iterations
                        seat_balls(case, ring, balls)
                    against = objections(case, ring, balls, not converged)
            if ring.grip != UNLIMITED:
                against &= ~FRICTION_WITHOUT_LOAD
            set_speed(case, 1.0, inner, outer)
            if against == 0 and stride < LEAST_STRIDE:
                restore(ring, balls, ON_THE_WAY)
                close_chains(case, ring, balls)
                converged, iterations, residual = relax_to_rest(case, ring, balls, tolerance)
                total += iterations
                for start in range(STARTS):
                    if converged:
                        break
                    if start == FROM_BALANCE:
                        restore(ring, balls, ON_THE_WAY)
                    else:
                        press(case, ring, balls, start)
                    converged, iterations, residual = follow(case, ring, balls, inner, outer, tolerance)
                    total += iterations
                ring.reached = 1.0
                reached = 1.0
            if against != 0 or (stride < LEAST_STRIDE and not converged):
                if solved_residual < 0.0:
                    return False, total, residual, against
                restore(ring, balls, SOLVED)
                ring.grip, ring.reached = solved_grip, 1.0
                return True, total, solved_residual, NO_CONSISTENT_CONTROL
            if not converged or reached < 1.0:
                continue
        elif not converged:
            attempt += 1
            if attempt == REST and case.gyroscopic and ring.grip == UNLIMITED:
                ring.grip, attempt = FULL_GRIP, GUESS
            continue
        notes = 0
        if case.control == PER_BALL:
            keep(ring, balls, SOLVED)
            solved_residual, solved_grip = residual, ring.grip
            wrong, changed = contradicted_controls(case, ring, balls)
            if changed > 0:
                attempt = WARM
                continue
            if wrong > 0:
                notes = NO_CONSISTENT_CONTROL
        if ring.grip != UNLIMITED and slips(case, ring, balls):
            keep(ring, balls, SOLVED)
            solved_residual, solved_grip = residual, ring.grip
            ring.grip, attempt = UNLIMITED, RELEASE
        elif objections(case, ring, balls, not converged) & FRICTION_WITHOUT_LOAD != 0:
            ring.grip, attempt, solved_residual = FULL_GRIP, GUESS, -1.0
        else:
            return True, total, residual, notes


@inlined
def solve_with_detours(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[int, int, int, float]:
    """Solve one case, ring and balls in place: (status, notes, iterations, relative residual)."""
    notes = 0
    if is_moving(case):
        converged, iterations, residual, notes = solve_moving(case, ring, balls, tolerance, is_warm)
        if converged and ring.grip != UNLIMITED and slips(case, ring, balls):
            notes |= FRICTION_WITHOUT_LOAD
    else:
        converged, iterations, residual = settle_at_rest(case, ring, balls, tolerance)
        if ring.ran_away and not converged:
            notes = RUNAWAY
        seat_balls(case, ring, balls)
        if not converged and residual <= SEEN:
            notes |= objections(case, ring, balls, converged)
    if is_unloaded(case):
        notes |= UNLOADED_RING
    if converged:
        notes |= objections(case, ring, balls, not converged)
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
