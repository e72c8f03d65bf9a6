"""Ways round to a balance, where the direct way finds none: other starts, descent, continuation in load and in speed.

At rest the problem is convex, and descent cannot fail. At speed Newton's method starts once more from a solution under
heavier loads; then from the bearing at rest, and where the full speed is too far from there, by continuation in speed.
On that way a balance is followed until the full speed is reached, or to where it ends: where a contact leaves its
groove, or where it turns back, and the bearing would jump to another balance. There relaxation goes where it would.
Where that finds no rest, inertia and friction are frozen, and thawed by and by, which is lost in one case of a hundred
thousand. For these, paths are followed, through their turning points, to a balance from one that cannot fail to exist:
under heavy thrust, and from balls that dead forces press. Each is lost in other cases than the others.

Where none of these arrives, and balls slip in the last balance on the way up, they slip from that speed on.

A balance with a contact where no groove is, on the open side or over the shoulder, stands only where no other way finds
one that lies in its grooves: without that, one refusal in two hundred is known to be wrong.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import UNLIMITED, set_speed
from qsbearing.compiled import kernel
from qsbearing.dead_forces import set_loads
from qsbearing.descent import descend
from qsbearing.freezing import HEAVY_APPROACH, LIGHTER, thaw
from qsbearing.keeping import OBJECTED, ON_THE_WAY, PATH, keep, restore
from qsbearing.newton import applied_load, close_chains, newton, stop
from qsbearing.path_following import follow, press
from qsbearing.relaxation import relax_to_rest
from qsbearing.solver import REST_TOLERANCE, first_guess, rest, seat_at_rest
from qsbearing.start import ring_at_rest, seat_balls
from qsbearing.verdict import FRICTION_WITHOUT_LOAD, MORE_THAN_LOAD, RUNAWAY, is_asked_for, outside_groove

# Where a solve at speed starts, in this order: from the start given, closed forms, heavier loads, rest.
WARM, GUESS, LOADS, REST = 0, 1, 2, 3
# The part of the speed below which continuation takes no smaller step, and how much longer or shorter the next one is.
LEAST_STRIDE = 1e-4
# So without a limit to friction, where smaller steps lead hardly further.
LEAST_STRIDE_UNLIMITED = 0.02
LONGER, SHORTER = 1.5, 0.4
# How far descent goes, before Newton's method takes the last steps.
FOOT = 1e-8
# On the way down from heavy loads each is at least so much lighter (1.005: 3 of 1190 more, 7 % more iterations).
LEAST_LIGHTER = 1.05
# Heavy thrust is this many times the heavy loads beside it.
THRUST = 3.0
# At speed loads may become far lighter than inertia, and must still be balanced on that way, so well.
LIGHT_TOLERANCE = 1e-8
# The one balance at rest, known this well, shows where its contacts lie, though its loads be too light to resolve.
SEEN = 1e-3
# Ways round, in the order of trying, and how many there are.
FROM_FROZEN, UNDER_THRUST, FROM_PRESSED = 0, 1, 2
WAYS_ROUND = 3
# So many evaluations freezing is worth, where the way up in speed ends outside a groove, and there is hardly another.
LITTLE_WORTH = 1000
# A ring that has gone this many ball diameters (or, for tilts, radians) has met nothing that would stop it.
RUNAWAY_DISTANCE = 5.0


@kernel
def is_unlimited(case: recarray, ring: recarray) -> bool:
    """Whether friction must carry the gyroscopic moment whatever the load."""
    return case.gyroscopic and ring.limit == UNLIMITED


@kernel
def heavy_load(case: recarray) -> float:
    """A load that would press the balls hard."""
    return HEAVY_APPROACH**1.5 * case.ball_count * case.series_stiffness


@kernel
def heavy_factor(case: recarray) -> float:
    """How many times the loads would press the balls hard."""
    own = applied_load(case)
    return heavy_load(case) / own if own > 0.0 else 1.0


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
    if is_at_speed:
        total = seat_at_rest(case, ring, balls)
    else:
        ring_at_rest(case, ring.displacement)
    keep(ring, balls, PATH)
    while True:
        set_loads(case, ring, factor)
        if is_at_speed:
            converged, iterations, _ = newton(case, ring, balls, LIGHT_TOLERANCE)
        else:
            converged, iterations, _ = rest(case, ring, balls, REST_TOLERANCE)
        total += iterations
        if converged:
            keep(ring, balls, PATH)
            if factor <= 1.0:
                break
            lighter = min(lighter**1.5, LIGHTER)
        elif lighter < LEAST_LIGHTER:
            break
        else:
            restore(ring, balls, PATH)
            factor *= lighter
            lighter = sqrt(lighter)
        factor = max(factor / lighter, 1.0)
        if is_at_speed:
            close_chains(case, ring, balls)
    set_loads(case, ring, 1.0)
    restore(ring, balls, PATH)
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
        stop(case, ring, balls)
        _, before, _ = descend(case, ring, balls, FOOT)
        converged, iterations, residual = rest(case, ring, balls, tolerance)
        total += before + iterations
    for i in range(5):
        if not case.is_held[i] and not abs(ring.displacement[i]) < RUNAWAY_DISTANCE:
            ring.ran_away = True
    return converged, total, residual


@kernel
def speed_up(
    case: recarray, ring: recarray, balls: ndarray, inner: float, outer: float, tolerance: float
) -> tuple[float, int, int]:
    """Follow the balance from rest up in speed: (the part of the speed reached, what forbids to go on, iterations).

    The last balance is kept; where it is one that has come to an end, ring and balls are left in it.
    """
    reached, stride, total, against = 0.0, 1.0, 0, 0
    least = LEAST_STRIDE_UNLIMITED if is_unlimited(case, ring) else LEAST_STRIDE
    while reached < 1.0 and stride >= least and against == 0:
        part = min(1.0, reached + stride)
        set_speed(case, part, inner, outer)
        restore(ring, balls, ON_THE_WAY)
        close_chains(case, ring, balls)
        converged, iterations, _ = newton(case, ring, balls, tolerance)
        total += iterations
        if converged:
            keep(ring, balls, ON_THE_WAY)
            reached, stride = part, LONGER * stride
            against = outside_groove(case, ring, balls)
        else:
            stride *= SHORTER
    if reached < 1.0 and against == 0:
        set_speed(case, reached, inner, outer)
        if reached > 0.0:
            restore(ring, balls, ON_THE_WAY)
        else:
            _, iterations, _ = settle_at_rest(case, ring, balls, tolerance)
            total += iterations
            seat_balls(case, ring, balls)
        against = outside_groove(case, ring, balls)
    return reached, against, total


@kernel
def seat_under_heavy_loads(case: recarray, ring: recarray, balls: ndarray, thrust: float) -> int:
    """Put balls where the case's own loads made heavy, and so many times as much thrust, press them at rest.

    Leaves these loads; returns the iterations taken.
    """
    set_loads(case, ring, max(heavy_factor(case), 1.0))
    if thrust > 0.0:
        case.prescribed[0] = thrust * max(heavy_load(case), applied_load(case))
    iterations = seat_at_rest(case, ring, balls)
    close_chains(case, ring, balls)
    return iterations


@kernel
def from_frozen(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, worth: int
) -> tuple[bool, int, float]:
    """From where the case's own loads made heavy press balls at rest, by freezing; returns as thawing does."""
    before = seat_under_heavy_loads(case, ring, balls, 0.0)
    set_loads(case, ring, 1.0)
    converged, iterations, residual = thaw(case, ring, balls, tolerance, worth)
    return converged, before + iterations, residual


@kernel
def go_round(
    case: recarray, ring: recarray, balls: ndarray, way: int, inner: float, outer: float, tolerance: float, worth: int
) -> tuple[bool, int, float]:
    """To a balance by one of the ways round, worth so many evaluations: (converged, iterations, residual)."""
    total = 0
    if way == FROM_FROZEN:
        converged, total, residual = from_frozen(case, ring, balls, tolerance, worth)
        if converged:
            return True, total, residual
    elif way == UNDER_THRUST:
        if case.is_held[0]:
            return False, 0, 1.0
        total = seat_under_heavy_loads(case, ring, balls, THRUST)
        found, iterations, _ = newton(case, ring, balls, LIGHT_TOLERANCE)
        total += iterations
        if not found:
            set_loads(case, ring, 1.0)
            return False, total, 1.0
    else:
        press(case, ring, balls)
    converged, iterations, residual = follow(case, ring, balls, inner, outer, tolerance, way != UNDER_THRUST, worth)
    return converged, total + iterations, residual


@kernel
def from_rest(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, worth: int, objected: float
) -> tuple[bool, int, float, int]:
    """From rest by continuation in speed, then relaxation, then ways round; returns as for finding a balance.

    Args:
        objected: residual of a balance kept that has a contact where no groove is: it stands only if no better one is
            found; below zero for none.
    """
    inner, outer = case.inner_speed, case.outer_speed
    _, total, _ = settle_at_rest(case, ring, balls, REST_TOLERANCE)
    reached, against = 0.0, RUNAWAY
    if not ring.ran_away:
        seat_balls(case, ring, balls)
        keep(ring, balls, ON_THE_WAY)
        reached, against, iterations = speed_up(case, ring, balls, inner, outer, tolerance)
        total += iterations
        set_speed(case, 1.0, inner, outer)
        ring.reached = reached
    converged, residual, is_sound = False, 1.0, False
    ways = WAYS_ROUND if worth > 0 else 0
    if against == 0:
        restore(ring, balls, ON_THE_WAY)
        close_chains(case, ring, balls)
        converged, iterations, residual = relax_to_rest(case, ring, balls, tolerance)
        total += iterations
        for way in range(ways + 1):
            if converged:
                is_sound = outside_groove(case, ring, balls) == 0
                if not is_sound and objected < 0.0:
                    keep(ring, balls, OBJECTED)
                    objected = residual
            if is_sound or way == ways:
                break
            converged, iterations, residual = go_round(case, ring, balls, way, inner, outer, tolerance, worth)
            total += iterations
    elif worth > 0 and not ring.ran_away:
        keep(ring, balls, ON_THE_WAY)
        converged, iterations, residual = from_frozen(case, ring, balls, tolerance, LITTLE_WORTH)
        total += iterations
        is_sound = converged and outside_groove(case, ring, balls) == 0
        if is_sound:
            against = 0
        else:
            restore(ring, balls, ON_THE_WAY)
            converged, residual = False, 1.0
    if not is_sound and objected >= 0.0:
        restore(ring, balls, OBJECTED)
        converged, residual, against = True, objected, 0
    if converged:
        ring.reached = 1.0
    elif against == 0 and case.gyroscopic and reached > 0.0 and worth > 0:
        restore(ring, balls, ON_THE_WAY)
        set_speed(case, reached, inner, outer)
        if is_asked_for(case, ring, balls, MORE_THAN_LOAD):
            against = FRICTION_WITHOUT_LOAD
        set_speed(case, 1.0, inner, outer)
    return converged, total, residual, against


@kernel
def find_balance(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, first: int, worth: int
) -> tuple[bool, int, float, int]:
    """A balance at speed with controls and limit of friction as they are, by the way numbered first, then the others.

    At last ways round are tried, each as far as it is worth so many evaluations: not at all for 0. A balance with a
    contact where no groove is stands only if none finds a better. Friction without limit is sought on the way from rest
    only where that is the first: it seldom leads to it.

    Returns:
        (converged, iterations, relative residual, what forbids a balance: 0 where nothing is known to);
        `ring.reached` is the part of the speed that ring and balls stand for.
    """
    ring.reached = 1.0
    total, residual, objected = 0, 1.0, -1.0
    for way in range(first, REST):
        if way == WARM:
            close_chains(case, ring, balls)
        elif way == GUESS:
            first_guess(case, ring, balls)
        else:
            total += from_above(case, ring, balls, True)
            close_chains(case, ring, balls)
        converged, iterations, residual = newton(case, ring, balls, tolerance)
        total += iterations
        if converged and outside_groove(case, ring, balls) == 0:
            return True, total, residual, 0
        if converged and objected < 0.0:
            keep(ring, balls, OBJECTED)
            objected = residual
    if is_unlimited(case, ring) and first != REST:
        if objected < 0.0:
            return False, total, residual, 0
        restore(ring, balls, OBJECTED)
        return True, total, objected, 0
    converged, iterations, residual, against = from_rest(case, ring, balls, tolerance, worth, objected)
    return converged, total + iterations, residual, against
