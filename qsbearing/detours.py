"""Ways round, for the few cases that the direct way leaves: other starts, descent, continuation in load and in speed.

At rest the problem is convex, and descent cannot fail. At speed Newton's method starts once more from a solution under
heavier loads; then from the bearing at rest, and where the full speed is too far from there, by continuation in speed.
On that way a balance is followed until the full speed is reached, or to where it ends: where a contact leaves its
groove, or friction would have to exceed the load that makes it.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import is_moving
from qsbearing.compiled import entry, inlined, kernel
from qsbearing.descent import descend
from qsbearing.newton import applied_load, close_chains, newton
from qsbearing.raceway_control import PER_BALL
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

# Where a solve at speed starts, in this order: from the start given, closed forms, heavier loads, rest.
WARM, GUESS, LOADS, REST, CONTINUATION = 0, 1, 2, 3, 4
# The part of the speed below which continuation takes no smaller step.
LEAST_STRIDE = 1e-4
# How well the balance at rest must be known for Newton to start from it.
REST_TOLERANCE = 1e-3
# Loads that press balls by this many diameters at rest are heavy; on the way down from them each is so much lighter.
HEAVY_APPROACH = 1e-3
LIGHTER = 10.0
LEAST_LIGHTER = 1.5
# The one balance at rest, known this well, shows where its contacts lie, though its loads be too light to resolve.
SEEN = 1e-3
# A ring that has gone this many ball diameters (or, for tilts, radians) has met nothing that would stop it.
RUNAWAY_DISTANCE = 5.0


@kernel
def keep(ring: recarray, balls: ndarray) -> None:
    """Note where ring and balls are."""
    for i in range(5):
        ring.kept[i] = ring.displacement[i]
    for n in range(ring.balls):
        balls[n].kept1, balls[n].kept2 = balls[n].u1, balls[n].u2


@kernel
def restore(ring: recarray, balls: ndarray) -> None:
    """Bring ring and balls back to where they were kept."""
    for i in range(5):
        ring.displacement[i] = ring.kept[i]
    for n in range(ring.balls):
        balls[n].u1, balls[n].u2 = balls[n].kept1, balls[n].kept2


@kernel
def keep_solved(ring: recarray, balls: ndarray) -> None:
    """Note a balance found, before controls change."""
    for i in range(5):
        ring.solved[i] = ring.displacement[i]
    for n in range(ring.balls):
        ball = balls[n]
        ball.solved1, ball.solved2, ball.solved_control = ball.u1, ball.u2, ball.control


@kernel
def restore_solved(ring: recarray, balls: ndarray) -> None:
    """Bring back the last balance found."""
    for i in range(5):
        ring.displacement[i] = ring.solved[i]
    for n in range(ring.balls):
        ball = balls[n]
        ball.u1, ball.u2, ball.control = ball.solved1, ball.solved2, ball.solved_control


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
def rest_from_above(case: recarray, ring: recarray, balls: ndarray, factor: float) -> int:
    """Bring the ring to rest under loads ever lighter, down to nearly its own; returns the iterations taken.

    Light loads leave open which few balls carry them: a choice hard to make at once and easy to follow from heavier
    loads, which press more balls.
    """
    total = 0
    while factor > 1.0:
        set_loads(case, ring, factor)
        if total == 0:
            ring_at_rest(case, ring.displacement)
        converged, iterations, _ = rest(case, ring, balls, REST_TOLERANCE)
        total += iterations
        if not converged:
            break
        factor /= LIGHTER
    set_loads(case, ring, 1.0)
    return total


@kernel
def moving_from_above(case: recarray, ring: recarray, balls: ndarray) -> int:
    """The same at speed, from loads so heavy that inertia hardly counts; returns the iterations taken."""
    factor, lighter, total = heavy_factor(case), LIGHTER, 0
    if factor <= 1.0:
        return 0
    set_loads(case, ring, factor)
    ring_at_rest(case, ring.displacement)
    _, total, _ = rest(case, ring, balls, REST_TOLERANCE)
    seat_balls(case, ring, balls)
    keep(ring, balls)
    while True:
        set_loads(case, ring, factor)
        converged, iterations, _ = newton(case, ring, balls, REST_TOLERANCE)
        total += iterations
        if converged:
            keep(ring, balls)
            if factor <= LIGHTER:
                break
        else:
            restore(ring, balls)
            factor *= lighter
            lighter = sqrt(lighter)
            if lighter < LEAST_LIGHTER:
                break
        factor = max(factor / lighter, 1.0)
        close_chains(case, ring, balls)
    set_loads(case, ring, 1.0)
    restore(ring, balls)
    return total


@kernel
def settle_at_rest(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Solve the case at rest from scratch: (converged, iterations, residual); the balls still need their seats."""
    total = 0
    for attempt in range(2):
        ring_at_rest(case, ring.displacement)
        if attempt == 0:
            total += rest_from_above(case, ring, balls, heavy_factor(case))
            converged, iterations, residual = rest(case, ring, balls, tolerance)
        else:
            converged, iterations, residual = descend(case, ring, balls, tolerance)
        total += iterations
        if converged:
            break
    for i in range(5):
        if not case.is_held[i] and not abs(ring.displacement[i]) < RUNAWAY_DISTANCE:
            ring.ran_away = True
    return converged, total, residual


@kernel
def set_speed(case: recarray, part: float, inner: float, outer: float) -> None:
    """Turn the rings at this part of their speeds."""
    case.inner_speed, case.outer_speed = part * inner, part * outer


@inlined
def solve_moving(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[bool, int, float, int]:
    """Equilibrium at speed: (converged, iterations, relative residual, notes); `ring.reached` is the speed it is for.

    One loop, one Newton: each turn first puts ring and balls where the present attempt starts. With per-ball control a
    converged turn may change the controls that Jones's criterion contradicts and go on from where it stands. Controls
    that have no solution are no choice: the last balance found stands, and is not consistent.
    """
    inner, outer = case.inner_speed, case.outer_speed
    attempt = WARM if is_warm else LOADS
    total, solved_residual = 0, -1.0
    reached, stride = 0.0, 1.0
    while True:
        part = 1.0
        if attempt == WARM:
            close_chains(case, ring, balls)
        elif attempt == GUESS:
            first_guess(case, ring, balls)
        elif attempt == LOADS:
            total += moving_from_above(case, ring, balls)
            close_chains(case, ring, balls)
        else:
            if attempt == REST:
                _, iterations, _ = settle_at_rest(case, ring, balls, REST_TOLERANCE)
                total += iterations
                if ring.ran_away:
                    return False, total, 1.0, RUNAWAY
                keep(ring, balls)
                attempt, reached, stride = CONTINUATION, 0.0, 1.0
            part = min(1.0, reached + stride)
            set_speed(case, part, inner, outer)
            restore(ring, balls)
            if reached == 0.0:
                seat_balls(case, ring, balls)
            close_chains(case, ring, balls)
        converged, iterations, residual = newton(case, ring, balls, tolerance)
        total += iterations
        ring.reached = part
        if attempt == CONTINUATION:
            against = 0
            if converged:
                against = objections(case, ring, balls, not converged)
                keep(ring, balls)
                reached, stride = part, 1.5 * stride
            else:
                stride *= 0.4
                if stride < LEAST_STRIDE:
                    restore(ring, balls)
                    if reached > 0.0:
                        set_speed(case, reached, inner, outer)
                        ring.reached = reached
                    else:
                        seat_balls(case, ring, balls)
                    against = objections(case, ring, balls, not converged)
            set_speed(case, 1.0, inner, outer)
            is_over = against != 0 or stride < LEAST_STRIDE
            if is_over and solved_residual >= 0.0:
                restore_solved(ring, balls)
                ring.reached = 1.0
                return True, total, solved_residual, NO_CONSISTENT_CONTROL
            if is_over:
                return False, total, residual, against
            if not converged or reached < 1.0:
                continue
        elif not converged:
            attempt += 1
            continue
        if case.control != PER_BALL:
            return True, total, residual, 0
        keep_solved(ring, balls)
        solved_residual = residual
        wrong, changed = contradicted_controls(case, ring, balls)
        if changed == 0:
            return True, total, residual, 0 if wrong == 0 else NO_CONSISTENT_CONTROL
        attempt = WARM


@inlined
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
