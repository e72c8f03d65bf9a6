"""One case from start to verdict: which solve it needs, and what happens where that does not converge.

At rest the convex problem is the whole problem. At speed Newton's method runs from a closed-form start; where that does
not converge, from the bearing at rest, and where the full speed is too far from there, by continuation in speed. On
that way a balance is followed until the full speed is reached, or to where it ends: where a contact leaves its groove,
or friction would have to exceed the load that makes it.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray, recarray

from qsbearing.ball import close_chain, groove_stiffness, inertia, is_moving, moving_ball, raceway_ellipse, resting_ball
from qsbearing.compiled import entry, inlined, kernel
from qsbearing.contact import contact_load, direction
from qsbearing.descent import descend
from qsbearing.effects.gyroscopic_moment import moment_shares
from qsbearing.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.newton import STALLED, any_held, close_chains, newton
from qsbearing.raceway_control import INNER, OUTER, PER_BALL, outer_controls
from qsbearing.ring import add_force, channel_scale, find_equals, inner_groove_centre, place_balls
from qsbearing.start import moving_thrust, ring_at_rest, seat_balls

CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED = 0, 1, 2

# What a verdict may be about; bits.
OPEN_SIDE, NO_CONSISTENT_CONTROL, UNLOADED_RING, FRICTION_WITHOUT_LOAD, RUNAWAY, OVER_SHOULDER = 1, 2, 4, 8, 16, 32

# Where a solve at speed starts, in this order: from the start given, from closed forms, from rest.
WARM, GUESS, REST, CONTINUATION = 0, 1, 2, 3
# The part of the speed below which continuation takes no smaller step.
LEAST_STRIDE = 1e-4
# A ball's control may change so often: there and back. What is contradicted then is contradicted both ways.
CONTROL_CHANGES = 2
# Side loads this many times the axial load still leave a ball at speed more like one under thrust than one at rest.
THRUST_REACH = 5.0
# How well the balance at rest must be known for Newton to start from it.
REST_TOLERANCE = 1e-3
# A ring that has gone this many ball diameters (or, for tilts, radians) has met nothing that would stop it.
RUNAWAY_DISTANCE = 5.0
# Angles this far outside are rounding, not contact on the open side or over the shoulder.
ANGLE_ROUNDING = 1e-9
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
def is_thrust_like(case: recarray) -> bool:
    """Whether the axial load shapes the balls' balance at speed more than radial loads and moments do."""
    if case.is_held[0] or case.prescribed[0] <= 0.0:
        return False
    side = 0.0
    for i in range(1, 5):
        if not case.is_held[i]:
            value = case.prescribed[i] / channel_scale(case, i)
            side += value * value
    return sqrt(side) < THRUST_REACH * case.prescribed[0]


@kernel
def settle_at_rest(case: recarray, ring: recarray, balls: ndarray, tolerance: float) -> tuple[bool, int, float]:
    """Solve the case at rest from scratch: (converged, iterations, residual); the balls still need their seats."""
    ring_at_rest(case, ring.displacement)
    converged, iterations, residual = descend(case, ring, balls, tolerance)
    for i in range(5):
        if not case.is_held[i] and not abs(ring.displacement[i]) < RUNAWAY_DISTANCE:
            ring.ran_away = True
    return converged, iterations, residual


@inlined
def first_guess(case: recarray, ring: recarray, balls: ndarray) -> None:
    """Place ring and balls for Newton's first iteration, by closed forms alone.

    Under thrust every ball starts in the balance of thrust at speed, whatever else moves its inner groove: Newton
    closes the chain. Otherwise balls start as they would sit at rest.
    """
    if not is_thrust_like(case):
        ring_at_rest(case, ring.displacement)
        seat_balls(case, ring, balls)
        return
    x, u1, u2 = moving_thrust(case, balls[0].control, case.prescribed[0])
    for i in range(5):
        ring.displacement[i] = case.prescribed[i] if case.is_held[i] else 0.0
    ring.displacement[0] = x
    for n in range(ring.balls):
        ball = balls[n]
        ball.u1, ball.u2 = u1, u2
        ball.v1, ball.v2 = x - u1, -u2


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
    attempt = WARM if is_warm else GUESS
    total, solved_residual = 0, -1.0
    reached, stride = 0.0, 1.0
    while True:
        part = 1.0
        if attempt == WARM:
            close_chains(case, ring, balls)
        elif attempt == GUESS:
            first_guess(case, ring, balls)
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
                against = objections(case, ring, balls, False)
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
                    against = objections(case, ring, balls, True)
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


@kernel
def spin_constant(case: recarray, side: float, cosine: float) -> float:
    """a E/Q^(1/3) of a raceway's contact, for Jones's criterion."""
    a, _, _, E = raceway_ellipse(case, side, cosine)
    return a * E


@kernel
def contradicted_controls(case: recarray, ring: recarray, balls: ndarray) -> tuple[int, int]:
    """How many balls' controls contradict Jones's criterion, and how many of them could still be changed, and were."""
    s, c = case.sin_free, case.cos_free
    inner_constant = spin_constant(case, INNER_SIDE, case.hertz_cosine)
    outer_constant = spin_constant(case, OUTER_SIDE, case.hertz_cosine)
    wrong, changed = 0, 0
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
            wrong += 1
            if ball.changes < CONTROL_CHANGES:
                ball.control = control
                ball.changes += 1
                changed += 1
    return wrong, changed


@kernel
def objections(case: recarray, ring: recarray, balls: ndarray, is_lost: bool) -> int:
    """What forbids the balance where ring and balls stand, as bits; 0 where nothing does.

    A loaded inner contact at an angle below zero lies on the open side of an angular-contact bearing; beyond a right
    angle it lies over the shoulder of any groove. Friction at a contact without load does not exist, and no contact
    carries more friction than load: where the balance was lost on the way up in speed (`is_lost`) at such a place, the
    hypothesis that puts friction there has come to its end. Friction below the solver's accuracy is none.
    """
    found = 0
    s, c = case.sin_free, case.cos_free
    for n in range(ring.balls):
        ball = balls[n]
        a1, a2 = inner_groove_centre(case, ring.displacement, ball.cosine, ball.sine)
        delta_i, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - ball.u1, a2 - ball.u2)
        delta_o, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, ball.u1, ball.u2)
        inner, _ = contact_load(groove_stiffness(case, INNER_SIDE, si, ci)[0], delta_i)
        outer, _ = contact_load(groove_stiffness(case, OUTER_SIDE, so, co)[0], delta_o)
        if inner > 0.0:
            if case.one_sided and si < -ANGLE_ROUNDING:
                found |= OPEN_SIDE
            if ci < -ANGLE_ROUNDING:
                found |= OVER_SHOULDER
        if case.gyroscopic and is_moving(case):
            share_i, share_o = moment_shares(case.shares, ball.control == INNER)
            moment = abs(inertia(case, ball.control, si, ci, so, co)[3])
            for friction, load in ((share_i * moment, inner), (share_o * moment, outer)):
                is_felt = load == 0.0 and friction > STALLED * ring.scale
                if is_felt or (is_lost and friction > load):
                    found |= FRICTION_WITHOUT_LOAD
    return found


@inlined
def solve_case(
    case: recarray, ring: recarray, balls: ndarray, tolerance: float, is_warm: bool
) -> tuple[int, int, int, float]:
    """Solve one case, ring and balls in place: (status, notes, iterations, relative residual)."""
    ring.floor = FLOOR * case.series_stiffness
    ring.ran_away = False
    ring.reached = 1.0
    for i in range(5):
        if case.is_held[i]:
            ring.displacement[i] = case.prescribed[i]
    notes = 0
    if is_moving(case):
        for n in range(ring.balls):
            balls[n].changes = 0
            if case.control != PER_BALL:
                balls[n].control = case.control
            elif not is_warm:
                balls[n].control = OUTER
        converged, iterations, residual, notes = solve_moving(case, ring, balls, tolerance, is_warm)
    else:
        for n in range(ring.balls):
            balls[n].control = INNER if case.control == INNER else OUTER
        converged, iterations, residual = False, 0, 1.0
        if is_warm:
            converged, iterations, residual = descend(case, ring, balls, tolerance)
        if not converged:
            converged, more, residual = settle_at_rest(case, ring, balls, tolerance)
            iterations += more
            if ring.ran_away and not converged:
                notes = RUNAWAY
        seat_balls(case, ring, balls)
    if is_unloaded(case):
        notes |= UNLOADED_RING
    if converged:
        notes |= objections(case, ring, balls, False)
    if notes & (OPEN_SIDE | OVER_SHOULDER | FRICTION_WITHOUT_LOAD | RUNAWAY):
        return NO_EQUILIBRIUM, notes, iterations, residual
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
                close_chain(ball, a1, a2)
                moving_ball(case, ball, a1, a2, ring.floor)
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
    reached: ndarray,
) -> None:
    """Solve cases one by one, each on its own: no case sees another's state, so any split over threads agrees.

    displacement (case, 5) and position (case, ball, 2) hold the start if is_warm, and the result in the case's units;
    load (case, 5) the ring's loads, reactions of held channels included; reached the part of the speed that all this is
    for: below 1 where the balance ends on the way up. rings (1) and balls are working memory.
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
        reached[k] = ring.reached
        for i in range(5):
            displacement[k, i] = ring.displacement[i]
        for j in range(position.shape[1]):
            ball = balls[balls[j].place]
            is_there = j < case.ball_count
            position[k, j, 0] = ball.u1 if is_there else 0.0
            position[k, j, 1] = ball.u2 if is_there else 0.0
            control[k, j] = ball.control if is_there else 0
        ring_load(case, ring, balls, load[k])
