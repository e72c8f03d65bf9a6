"""One case from start to verdict: which solve it needs, and what happens where that does not converge.

At rest the convex problem is the whole problem. At speed Newton's method runs from a closed-form start; where it does
not converge, three nets follow: descent with the inertia forces frozen and brought up to date in turn, with Newton
tried after each; and continuation in speed from rest.
"""

from __future__ import annotations

from math import sqrt

from numpy import ndarray

from qsbearing.ball import groove_stiffness, inertia, moving_ball, resting_ball
from qsbearing.compiled import entry, kernel
from qsbearing.contact import contact_load, direction
from qsbearing.descent import descend, freeze
from qsbearing.effects.gyroscopic_moment import moment_shares
from qsbearing.hertz import ellipse_constants, rolling_curvature, transverse_curvature
from qsbearing.newton import any_held, newton
from qsbearing.raceway_control import INNER, OUTER, PER_BALL, outer_controls
from qsbearing.ring import Workspace, add_force, find_equals, inner_groove_centre, make_workspace, place_balls
from qsbearing.start import moving_thrust, ring_at_rest, seat_balls

CONVERGED, NO_EQUILIBRIUM, NOT_CONVERGED = 0, 1, 2

# What a verdict may be about; bits.
OPEN_SIDE, NO_CONSISTENT_CONTROL, UNLOADED_RING, FRICTION_WITHOUT_LOAD, RUNAWAY = 1, 2, 4, 8, 16

NEWTON_MOST = 30
DESCENT_MOST = 200
FREEZES_MOST = 25
CONTROL_CHANGES_MOST = 30
# A ring that has gone this many ball diameters (or, for tilts, radians) has met nothing that would stop it.
RUNAWAY_DISTANCE = 5.0
# Angles this far below zero are rounding, not contact on the open side.
OPEN_SIDE_SINE = -1e-9
FLOOR = 1e-13


@kernel
def stiffness_floor(case: ndarray) -> float:
    """A stiffness far below any contact's, which keeps a ball out of all contact, or an idle channel, solvable."""
    return FLOOR * case.series_stiffness * 1e-2


@kernel
def is_moving(case: ndarray) -> bool:
    """Whether a named effect has some speed to act at."""
    return (case.centrifugal or case.gyroscopic) and (case.inner_speed != 0.0 or case.outer_speed != 0.0)


@kernel
def is_unloaded(case: ndarray) -> bool:
    """No load and no displacement anywhere."""
    for i in range(5):
        if case.prescribed[i] != 0.0 or case.is_held[i]:
            return False
    return True


@kernel
def radial_to_axial(case: ndarray) -> float:
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
def first_guess(case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, channels: int) -> int:
    """Place ring and balls for Newton's first iteration; returns the iterations it took to find the place."""
    if radial_to_axial(case) < 1.0:
        x, u1, u2 = moving_thrust(case, w.control[w.ball[0]], case.prescribed[0])
        for i in range(5):
            ring[i] = 0.0
        ring[0] = x
        for n in range(balls):
            j = w.ball[n]
            position[j, 0], position[j, 1] = u1, u2
        return 0
    ring_at_rest(case, ring)
    _, iterations, _ = descend(
        case, w, ring, position, balls, channels, stiffness_floor(case), 1e-3, DESCENT_MOST, True
    )
    seat_balls(case, w, ring, position, balls, True)
    return iterations


@kernel
def keep(w: Workspace, ring: ndarray, position: ndarray, balls: int) -> None:
    """Save ring and balls."""
    for i in range(5):
        w.ring_saved[i] = ring[i]
    for n in range(balls):
        j = w.ball[n]
        w.saved[j, 0], w.saved[j, 1] = position[j, 0], position[j, 1]


@kernel
def restore(w: Workspace, ring: ndarray, position: ndarray, balls: int) -> None:
    """Bring ring and balls back to where they were saved."""
    for i in range(5):
        ring[i] = w.ring_saved[i]
    for n in range(balls):
        j = w.ball[n]
        position[j, 0], position[j, 1] = w.saved[j, 0], w.saved[j, 1]


@kernel
def frozen_rounds(
    case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, channels: int, tolerance: float
) -> tuple[bool, int, float]:
    """Freeze the inertia forces, descend, bring them up to date, try Newton; again, more and more gently."""
    floor = stiffness_floor(case)
    ring_at_rest(case, ring)
    _, total, _ = descend(case, w, ring, position, balls, channels, floor, 1e-6, DESCENT_MOST, True)
    seat_balls(case, w, ring, position, balls, True)
    residual = 1.0
    for r in range(FREEZES_MOST):
        freeze(case, w, ring, position, balls, 1.0 if r < 3 else 0.5 if r < 10 else 0.2)
        _, iterations, _ = descend(case, w, ring, position, balls, channels, floor, 1e-8, DESCENT_MOST, False)
        total += iterations
        keep(w, ring, position, balls)
        converged, iterations, residual = newton(
            case, w, ring, position, balls, channels, floor, tolerance, NEWTON_MOST
        )
        total += iterations
        if converged:
            return True, total, residual
        restore(w, ring, position, balls)
    return False, total, residual


@kernel
def speed_continuation(
    case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, channels: int, tolerance: float
) -> tuple[bool, int, float]:
    """From rest to speed in steps that shorten where Newton fails."""
    floor = stiffness_floor(case)
    inner, outer = case.inner_speed, case.outer_speed
    reached, stride, total, residual = 0.0, 0.25, 0, 1.0
    ring_at_rest(case, ring)
    descend(case, w, ring, position, balls, channels, floor, 1e-10, DESCENT_MOST, True)
    case.inner_speed, case.outer_speed = 0.05 * inner, 0.05 * outer
    seat_balls(case, w, ring, position, balls, True)
    converged = False
    while stride > 1e-4 and reached < 1.0:
        target = min(1.0, reached + stride)
        case.inner_speed, case.outer_speed = target * inner, target * outer
        keep(w, ring, position, balls)
        converged, iterations, residual = newton(
            case, w, ring, position, balls, channels, floor, tolerance, NEWTON_MOST
        )
        total += iterations
        if converged:
            reached = target
            stride *= 1.5
        else:
            restore(w, ring, position, balls)
            stride *= 0.4
    case.inner_speed, case.outer_speed = inner, outer
    return reached >= 1.0, total, residual


@kernel
def solve_moving(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    tolerance: float,
    is_warm: bool,
) -> tuple[bool, int, float]:
    """Equilibrium at speed with the controls as they stand: (converged, iterations, relative residual)."""
    floor = stiffness_floor(case)
    total = 0
    if is_warm:
        converged, total, residual = newton(case, w, ring, position, balls, channels, floor, tolerance, NEWTON_MOST)
        if converged:
            return True, total, residual
    total += first_guess(case, w, ring, position, balls, channels)
    converged, iterations, residual = newton(case, w, ring, position, balls, channels, floor, tolerance, NEWTON_MOST)
    total += iterations
    if converged:
        return True, total, residual
    converged, iterations, residual = frozen_rounds(case, w, ring, position, balls, channels, tolerance)
    total += iterations
    if converged:
        return True, total, residual
    converged, iterations, residual = speed_continuation(case, w, ring, position, balls, channels, tolerance)
    return converged, total + iterations, residual


@kernel
def spin_constant(case: ndarray, side: int, cosine: float) -> float:
    """a E/Q^(1/3) of a raceway's contact, for Jones's criterion."""
    coefficient = case.inner_coefficient if side < 0 else case.outer_coefficient
    a, _, _, E = ellipse_constants(
        case.form,
        rolling_curvature(1.0, case.pitch_diameter, cosine, side),
        transverse_curvature(1.0, coefficient),
        1.0,
    )
    return a * E


@kernel
def controls_of_outcome(
    case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, change: bool, only: int
) -> int:
    """How many balls' controls contradict Jones's criterion; changes them (all, or the one counted `only`) if asked."""
    s, c = case.sin_free, case.cos_free
    inner_constant, outer_constant = spin_constant(case, -1, c), spin_constant(case, 1, c)
    wrong = 0
    for n in range(balls):
        j = w.ball[n]
        a1, a2 = inner_groove_centre(case, ring, w.cosine[j], w.sine[j])
        u1, u2 = position[j, 0], position[j, 1]
        do, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
        di, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - u1, a2 - u2)
        if case.actual_angle:
            inner_constant, outer_constant = spin_constant(case, -1, ci), spin_constant(case, 1, co)
        qi = case.inner_stiffness * max(di, 0.0) ** 1.5
        qo = case.outer_stiffness * max(do, 0.0) ** 1.5
        control = OUTER if outer_controls(qi, qo, inner_constant, outer_constant, ci * co + si * so) else INNER
        if control != w.control[j]:
            if change and (only < 0 or only == wrong):
                w.control[j] = control
            wrong += 1
    return wrong


@kernel
def solve_per_ball(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    tolerance: float,
    is_warm: bool,
) -> tuple[bool, int, float, bool]:
    """Equilibrium with controls that agree with Jones's criterion: (converged, iterations, residual, consistent).

    First all contradicting balls change at once; if that goes round in circles, one at a time.
    """
    total = 0
    converged, residual = False, 1.0
    for change in range(CONTROL_CHANGES_MOST):
        converged, iterations, residual = solve_moving(
            case, w, ring, position, balls, channels, tolerance, is_warm or change > 0
        )
        total += iterations
        if not converged:
            return False, total, residual, False
        only = -1 if change < CONTROL_CHANGES_MOST // 2 else 0
        if change == CONTROL_CHANGES_MOST - 1:
            break
        if controls_of_outcome(case, w, ring, position, balls, True, only) == 0:
            return True, total, residual, True
    consistent = controls_of_outcome(case, w, ring, position, balls, False, -1) == 0
    return converged, total, residual, consistent


@kernel
def inner_contact(case: ndarray, w: Workspace, ring: ndarray, position: ndarray, j: int) -> tuple[float, float, float]:
    """A ball's inner contact: (sine of its angle, its load, the friction force that the hypothesis puts there)."""
    s, c = case.sin_free, case.cos_free
    a1, a2 = inner_groove_centre(case, ring, w.cosine[j], w.sine[j])
    u1, u2 = position[j, 0], position[j, 1]
    delta, si, ci, _ = direction(case.inner_coefficient - 0.5, s, c, a1 - u1, a2 - u2)
    load, _ = contact_load(groove_stiffness(case, -1, si, ci)[0], delta)
    if not case.gyroscopic or not is_moving(case):
        return si, load, 0.0
    _, so, co, _ = direction(case.outer_coefficient - 0.5, s, c, u1, u2)
    share, _ = moment_shares(case.shares, w.control[j] == INNER)
    return si, load, abs(share * inertia(case, w.control[j], si, ci, so, co)[3])


@kernel
def objections(case: ndarray, w: Workspace, ring: ndarray, position: ndarray, balls: int, converged: bool) -> int:
    """What forbids an equilibrium, as bits; 0 where nothing does.

    A loaded inner contact at an angle below zero lies on the open side of an angular-contact bearing. Friction at an
    inner contact without load does not exist, and no contact carries more friction than load: where Newton has lost a
    solution on the way up in speed at such a place, the hypothesis that puts friction there (inner control, shares on
    the inner raceway) has come to its end.
    """
    found = 0
    for n in range(balls):
        sine, load, friction = inner_contact(case, w, ring, position, w.ball[n])
        if converged and case.one_sided and load > 0.0 and sine < OPEN_SIDE_SINE:
            found |= OPEN_SIDE
        if friction > 0.0 and (load == 0.0 or (friction > load and not converged)):
            found |= FRICTION_WITHOUT_LOAD
    return found


@kernel
def solve_case(
    case: ndarray, w: Workspace, ring: ndarray, position: ndarray, tolerance: float, is_warm: bool
) -> tuple[int, int, int, float]:
    """Solve one case in place: (status, notes, iterations, relative residual).

    Positions of all balls are filled, those of equals too; ring channels that a symmetry settles are zero.
    """
    place_balls(case, w)
    balls, channels = find_equals(case, w)
    for i in range(5):
        if case.is_held[i]:
            ring[i] = case.prescribed[i]
    notes = 0
    if is_moving(case):
        if case.control == PER_BALL:
            for n in range(balls):
                if not is_warm:
                    w.control[w.ball[n]] = OUTER
            converged, iterations, residual, consistent = solve_per_ball(
                case, w, ring, position, balls, channels, tolerance, is_warm
            )
            if not consistent:
                notes |= NO_CONSISTENT_CONTROL
        else:
            for n in range(balls):
                w.control[w.ball[n]] = case.control
            converged, iterations, residual = solve_moving(case, w, ring, position, balls, channels, tolerance, is_warm)
    else:
        for n in range(balls):
            w.control[w.ball[n]] = INNER if case.control == INNER else OUTER
        converged, iterations, residual = solve_resting(case, w, ring, position, balls, channels, tolerance, is_warm)
    if is_unloaded(case):
        notes |= UNLOADED_RING
    status = CONVERGED if converged else NOT_CONVERGED
    for i in range(5):
        if not case.is_held[i] and not abs(ring[i]) < RUNAWAY_DISTANCE:
            status = NO_EQUILIBRIUM
            notes |= RUNAWAY
    if notes & RUNAWAY == 0:
        against = objections(case, w, ring, position, balls, converged)
        if against != 0:
            status = NO_EQUILIBRIUM
            notes |= against
    for j in range(case.ball_count):
        k = w.twin[j]
        if k != j:
            position[j, 0], position[j, 1] = position[k, 0], position[k, 1]
            w.control[j] = w.control[k]
    return status, notes, iterations, residual


@kernel
def solve_resting(
    case: ndarray,
    w: Workspace,
    ring: ndarray,
    position: ndarray,
    balls: int,
    channels: int,
    tolerance: float,
    is_warm: bool,
) -> tuple[bool, int, float]:
    """Equilibrium at rest: the convex problem of the ring alone."""
    floor = stiffness_floor(case)
    total = 0
    converged, residual = False, 1.0
    if is_warm:
        converged, total, residual = descend(
            case, w, ring, position, balls, channels, floor, tolerance, NEWTON_MOST, True
        )
    if not converged:
        ring_at_rest(case, ring)
        converged, iterations, residual = descend(
            case, w, ring, position, balls, channels, floor, tolerance, DESCENT_MOST, True
        )
        total += iterations
    seat_balls(case, w, ring, position, balls, False)
    return converged, total, residual


@kernel
def ring_load(case: ndarray, w: Workspace, ring: ndarray, position: ndarray, load: ndarray) -> None:
    """The ring's load in all channels: what was prescribed, and of held channels the reaction, the balls' sum."""
    reaction = w.ring_before
    for i in range(5):
        reaction[i] = 0.0
    if any_held(case):
        h = w.condensed[0]
        for j in range(case.ball_count):
            a1, a2 = inner_groove_centre(case, ring, w.cosine[j], w.sine[j])
            if is_moving(case):
                moving_ball(case, w.control[j], a1, a2, position[j, 0], position[j, 1], 0.0, h)
            else:
                resting_ball(case, a1, a2, h)
            add_force(h, w.cosine[j], w.sine[j], 1.0, reaction)
    for i in range(5):
        # what equal balls cancel is zero, not the rounding of their sum
        load[i] = reaction[i] * w.in_plane[i] if case.is_held[i] else case.prescribed[i]


@entry
def solve_cases(
    cases: ndarray,
    tolerance: float,
    is_warm: bool,
    ring: ndarray,
    position: ndarray,
    control: ndarray,
    load: ndarray,
    status: ndarray,
    notes: ndarray,
    iterations: ndarray,
    residual: ndarray,
) -> None:
    """Solve cases one by one, each on its own: no case sees another's state, so any split over threads agrees.

    ring (case, 5) and position (case, ball, 2) hold the start if is_warm, and the result in the case's units; load
    (case, 5) the ring's loads, reactions of held channels included.
    """
    balls = position.shape[1]
    w = make_workspace(balls)
    for k in range(cases.size):
        case = cases[k]
        if is_warm:
            for j in range(case.ball_count):
                w.control[j] = control[k, j]
        else:
            ring[k] = 0.0
            position[k] = 0.0
        status[k], notes[k], iterations[k], residual[k] = solve_case(case, w, ring[k], position[k], tolerance, is_warm)
        ring_load(case, w, ring[k], position[k], load[k])
        for j in range(case.ball_count):
            control[k, j] = w.control[j]
