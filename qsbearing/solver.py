"""One case from start to verdict: which solve it needs, and what happens where that does not converge.

At rest the convex problem is the whole problem. At speed Newton's method runs from a closed-form start; where it does
not converge, two nets follow: descent with the inertia forces frozen and brought up to date in turn, Newton tried
after each; and continuation in speed from rest.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import groove_stiffness, inertia, is_moving, moving_ball, raceway_ellipse, resting_ball
from qsbearing.compiled import entry, inlined, kernel
from qsbearing.contact import contact_load, direction
from qsbearing.descent import descend, freeze
from qsbearing.effects.gyroscopic_moment import moment_shares
from qsbearing.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.newton import any_held, newton
from qsbearing.raceway_control import INNER, OUTER, PER_BALL, outer_controls
from qsbearing.ring import add_force, find_equals, inner_groove_centre, place_balls
from qsbearing.start import moving_thrust, ring_at_rest, seat_balls

CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED = 0, 1, 2

# What a verdict may be about; bits.
OPEN_SIDE, NO_CONSISTENT_CONTROL, UNLOADED_RING, FRICTION_WITHOUT_LOAD, RUNAWAY = 1, 2, 4, 8, 16

# How a solve at speed is tried, in this order: from the start given, from the closed form, in so many rounds of frozen
# inertia forces, by continuation from rest.
WARM, GUESS, FROZEN, CONTINUATION = 0, 1, 2, 27
# Controls change at once in the first half of so many rounds, then one by one.
CONTROL_CHANGES_MOST = 30
# A ring that has gone this many ball diameters (or, for tilts, radians) has met nothing that would stop it.
RUNAWAY_DISTANCE = 5.0
# Angles this far below zero are rounding, not contact on the open side.
OPEN_SIDE_SINE = -1e-9
# Of a contact's typical stiffness: far below any, it keeps a ball out of contact, or an idle channel, solvable.
FLOOR = 1e-15


@kernel
def is_unloaded(case: recarray) -> bool:
    """No load and no displacement anywhere."""
    for i in range(5):
        if case.prescribed[i] != 0.0 or case.is_held[i]:
            return False
    return True


@kernel
def radial_to_axial(case: recarray) -> float:
    """How strongly radial loads and moments stand against the axial load; large where there is none."""
    side = 0.0
    for i in range(1, 5):
        if not case.is_held[i]:
            value = case.prescribed[i] / (0.5 * case.pitch_diameter if i >= 3 else 1.0)
            side += value * value
        elif case.prescribed[i] != 0.0:
            return 1e9
    if case.is_held[0] or case.prescribed[0] <= 0.0:
        return 1e9
    return sqrt(side) / case.prescribed[0]


@kernel
def settle_at_rest(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Solve the case at rest from scratch: (converged, iterations, residual); the balls still need their seats."""
    ring_at_rest(case, ring.displacement)
    ring.at_rest = True
    converged, iterations, residual = descend(case, ring, balls, tolerance)
    for i in range(5):
        if not case.is_held[i] and not abs(ring.displacement[i]) < RUNAWAY_DISTANCE:
            ring.ran_away = True
    return converged, iterations, residual


@inlined
def first_guess(case: recarray, ring: recarray, balls: ndarray) -> int:
    """Place ring and balls for Newton's first iteration; returns the iterations it took to find the place."""
    if radial_to_axial(case) < 1.0:
        x, u1, u2 = moving_thrust(case, balls[0].control, case.prescribed[0])
        for i in range(5):
            ring.displacement[i] = case.prescribed[i] if case.is_held[i] else 0.0
        ring.displacement[0] = x
        for n in range(ring.balls):
            balls[n].u1, balls[n].u2 = u1, u2
        return 0
    _, iterations, _ = settle_at_rest(case, ring, balls, 1e-3)
    seat_balls(case, ring, balls)
    return iterations


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


@inlined
def solve_moving(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[bool, int, float, bool]:
    """Equilibrium at speed: (converged, iterations, relative residual, raceway controls consistent).

    One loop, one Newton: each turn first puts ring and balls where the present attempt starts. With per-ball control a
    converged turn may change the controls that Jones's criterion contradicts and go on from where it stands; all at
    once at first, and if that goes round in circles, one at a time. Controls that have no solution are no choice: the
    last balance found stands, and is not consistent.
    """
    inner, outer = case.inner_speed, case.outer_speed
    attempt = WARM if is_warm else GUESS
    total, changes, residual, solved_residual = 0, 0, 1.0, 1.0
    reached, stride, target = 0.0, 0.25, 1.0
    while True:
        # Controls may change so many times, all at once below zero, then only the first that is contradicted.
        may_change = changes + 1 < CONTROL_CHANGES_MOST
        only = min(0, changes + 1 - CONTROL_CHANGES_MOST // 2)
        if attempt == GUESS:
            total += first_guess(case, ring, balls)
        elif attempt == FROZEN or (attempt == CONTINUATION and reached == 0.0 and stride == 0.25):
            _, iterations, _ = settle_at_rest(case, ring, balls, 1e-8)
            total += iterations
            if ring.ran_away:
                return False, total, residual, False
            seat_balls(case, ring, balls)
            keep(ring, balls)
        if FROZEN <= attempt < CONTINUATION:
            restore(ring, balls)
            turn = attempt - FROZEN
            if case.control == PER_BALL and turn >= 12:  # first with the controls as they are
                contradicted_controls(case, ring, balls, may_change, only)
            freeze(case, ring, balls, 1.0 if turn < 3 else 0.5 if turn < 10 else 0.2)
            ring.at_rest = False
            _, iterations, _ = descend(case, ring, balls, 1e-8)
            total += iterations
            keep(ring, balls)
        if attempt == CONTINUATION:
            target = min(1.0, reached + stride)
            case.inner_speed, case.outer_speed = target * inner, target * outer
        converged, iterations, residual = newton(case, ring, balls, tolerance)
        total += iterations
        if attempt == CONTINUATION:
            case.inner_speed, case.outer_speed = inner, outer
            if converged:
                reached, stride = target, 1.5 * stride
                keep(ring, balls)
                if reached < 1.0:
                    continue
            else:
                restore(ring, balls)
                stride *= 0.4
                if stride >= 1e-4:
                    continue
                if changes == 0:
                    return False, total, residual, False
                restore_solved(ring, balls)
                return True, total, solved_residual, False
        if not converged:
            attempt += 1
            continue
        if case.control != PER_BALL:
            return True, total, residual, True
        changes += 1
        keep_solved(ring, balls)
        solved_residual = residual
        wrong = contradicted_controls(case, ring, balls, may_change, only)
        if wrong == 0 or not may_change:
            return True, total, residual, wrong == 0
        attempt = WARM
        reached, stride = 0.0, 0.25


@kernel
def spin_constant(case: recarray, side: float, cosine: float) -> float:
    """a E/Q^(1/3) of a raceway's contact, for Jones's criterion."""
    a, _, _, E = raceway_ellipse(case, side, cosine)
    return a * E


@kernel
def contradicted_controls(case: recarray, ring: recarray, balls: ndarray, change: bool, only: int) -> int:
    """How many balls' controls contradict Jones's criterion; changes them (all, or the one counted `only`) if asked."""
    s, c = case.sin_free, case.cos_free
    inner_constant, outer_constant = spin_constant(case, INNER_SIDE, c), spin_constant(case, OUTER_SIDE, c)
    wrong = 0
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        do, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, ball.u1, ball.u2)
        di, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - ball.u1, a2 - ball.u2)
        if case.actual_angle:
            inner_constant, outer_constant = spin_constant(case, INNER_SIDE, ci), spin_constant(case, OUTER_SIDE, co)
        qi, _ = contact_load(groove_stiffness(case, INNER_SIDE, si, ci)[0], di)
        qo, _ = contact_load(groove_stiffness(case, OUTER_SIDE, so, co)[0], do)
        control = OUTER if outer_controls(qi, qo, inner_constant, outer_constant, ci * co + si * so) else INNER
        if control != ball.control:
            if change and (only < 0 or only == wrong):
                ball.control = control
            wrong += 1
    return wrong


@kernel
def inner_contact(case: recarray, ring: recarray, ball: recarray) -> tuple[float, float, float]:
    """A ball's inner contact: (sine of its angle, its load, the friction force that the hypothesis puts there)."""
    s, c = case.sin_free, case.cos_free
    a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
    delta, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - ball.u1, a2 - ball.u2)
    load, _ = contact_load(groove_stiffness(case, INNER_SIDE, si, ci)[0], delta)
    if not case.gyroscopic or not is_moving(case):
        return si, load, 0.0
    _, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, ball.u1, ball.u2)
    share, _ = moment_shares(case.shares, ball.control == INNER)
    return si, load, abs(share * inertia(case, ball.control, si, ci, so, co)[3])


@kernel
def objections(case: recarray, ring: recarray, balls: ndarray, converged: bool) -> int:
    """What forbids an equilibrium, as bits; 0 where nothing does.

    A loaded inner contact at an angle below zero lies on the open side of an angular-contact bearing. Friction at an
    inner contact without load does not exist, and no contact carries more friction than load: where Newton has lost a
    solution on the way up in speed at such a place, the hypothesis that puts friction there (inner control, shares on
    the inner raceway) has come to its end.
    """
    found = 0
    if not converged and ring.ran_away:
        return RUNAWAY
    for n in range(ring.balls):
        sine, load, friction = inner_contact(case, ring, balls[n])
        if converged and case.one_sided and load > 0.0 and sine < OPEN_SIDE_SINE:
            found |= OPEN_SIDE
        if case.control == INNER and friction > 0.0 and (load == 0.0 or (friction > load and not converged)):
            found |= FRICTION_WITHOUT_LOAD
    return found


@inlined
def solve_case(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[int, int, int, float]:
    """Solve one case, ring and balls in place: (status, notes, iterations, relative residual)."""
    ring.floor = FLOOR * case.series_stiffness
    ring.ran_away = False
    for i in range(5):
        if case.is_held[i]:
            ring.displacement[i] = case.prescribed[i]
    notes = 0
    if is_moving(case):
        for n in range(ring.balls):
            if case.control != PER_BALL:
                balls[n].control = case.control
            elif not is_warm:
                balls[n].control = OUTER
        converged, iterations, residual, consistent = solve_moving(case, ring, balls, tolerance, is_warm)
        if converged and not consistent:
            notes |= NO_CONSISTENT_CONTROL
    else:
        for n in range(ring.balls):
            balls[n].control = INNER if case.control == INNER else OUTER
        converged, iterations, residual = False, 0, 1.0
        if is_warm:
            ring.at_rest = True
            converged, iterations, residual = descend(case, ring, balls, tolerance)
        if not converged:
            converged, more, residual = settle_at_rest(case, ring, balls, tolerance)
            iterations += more
        seat_balls(case, ring, balls)
    if is_unloaded(case):
        notes |= UNLOADED_RING
    against = objections(case, ring, balls, converged)
    if against != 0:
        return NO_EQUILIBRIUM, notes | against, iterations, residual
    return CONVERGED if converged else NOT_CONVERGED, notes, iterations, residual


@kernel
def ring_load(case: recarray, ring: recarray, balls: ndarray, load: ndarray) -> None:
    """The ring's load in all channels: what was prescribed, and of held channels the reaction, the balls' sum."""
    reaction = ring.before
    for i in range(5):
        reaction[i] = 0.0
    if any_held(case):
        for j in range(case.ball_count):
            ball = balls[balls[j].place]
            cosine, sine = balls[j].azimuth_cosine, balls[j].azimuth_sine
            a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
            if is_moving(case):
                moving_ball(case, ball, a1, a2, 0.0)
            else:
                resting_ball(case, ball, a1, a2)
            add_force(ball, cosine, sine, reaction)
    for i in range(5):
        # what equal balls cancel is zero, not the rounding of their sum
        load[i] = reaction[i] * ring.in_plane[i] if case.is_held[i] else case.prescribed[i]


@entry
def solve_cases(
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
) -> None:
    """Solve cases one by one, each on its own: no case sees another's state, so any split over threads agrees.

    displacement (case, 5) and position (case, ball, 2) hold the start if is_warm, and the result in the case's units;
    load (case, 5) the ring's loads, reactions of held channels included. rings (1) and balls are working memory.
    """
    ring = rings[0]
    for k in range(cases.size):
        case = cases[k]
        place_balls(case, ring, balls)
        find_equals(case, ring, balls)
        for i in range(5):
            ring.displacement[i] = displacement[k, i] * ring.in_plane[i] if is_warm else 0.0
        for n in range(ring.balls):
            ball = balls[n]
            if is_warm:
                ball.u1, ball.u2 = position[k, ball.number, 0], position[k, ball.number, 1]
                ball.control = control[k, ball.number]
            else:
                ball.u1, ball.u2 = 0.0, 0.0
        status[k], notes[k], iterations[k], residual[k] = solve_case(case, ring, balls, tolerance, is_warm)
        for i in range(5):
            displacement[k, i] = ring.displacement[i]
        for j in range(position.shape[1]):
            ball = balls[balls[j].place]
            is_there = j < case.ball_count
            position[k, j, 0] = ball.u1 if is_there else 0.0
            position[k, j, 1] = ball.u2 if is_there else 0.0
            control[k, j] = ball.control if is_there else 0
        ring_load(case, ring, balls, load[k])
