"""Newton's method on ring and balls moved by friction: from a solution under outer control, directly, else by
continuation in slip speed, from friction that hardly saturates."""

from __future__ import annotations

from math import cos, inf, pi, sin, tan

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import INNER_SIDE, OUTER_SIDE
from qsbearing.model.effects.raceway_control import OUTER, rotation_axis
from qsbearing.model.kernel.admissibility import (
    ANGLE_ROUNDING,
    CONVERGED,
    NO_EQUILIBRIUM,
    NOT_CONVERGED,
    OPEN_SIDE,
    OVER_SHOULDER,
)
from qsbearing.model.kernel.case import CASE, RESULT
from qsbearing.model.kernel.contact_line import direction, line_displacement
from qsbearing.model.kernel.kinematics import inner_line, orbital_speed, rolling_terms, rotation_per_axis_length
from qsbearing.model.kernel.raceway_stiffness import raceway_ellipse
from qsbearing.model.kernel.ring import inner_groove_centre
from qsbearing.model.kernel.traction_ball import (
    CONTACT_QUANTITIES,
    COSINE,
    GROOVE,
    LAW,
    LOAD,
    MOVED_BALL,
    ORBIT,
    RING_FORCES,
    SINE,
    WX,
    WY,
    WZ,
    X1,
    X2,
    drag_of,
    moved_ball,
    read_groove,
)
from qsbearing.model.kernel.traction_ring import MOTION, channel_force, evaluate, set_rates, weight_of
from qsbearing.model.kernel.traction_step import allowed_fraction, keep_state, move, step_of_motion

TOLERANCE = 1e-13
"""Largest imbalance over the largest load of a ball that ends Newton's method; energy balances to 1e-9 with it."""
STALLED = 1e-10
"""Where rounding forbids that, this still counts as solved."""
MOST_ITERATIONS, MOST_HALVINGS = 40, 6
FIRST_SLIP = 0.2
"""Slip speed at which continuation begins, over the rings' difference of speed times D."""
SLIP_RATIO = 0.45
"""Of its steps."""

PLACES = ("x1", "x2", "wx", "wy", "wz", "orbit", "weight", "drag")
"""What is written of a ball."""


@kernel
def set_groove(case: recarray, law: recarray, groove: recarray, side: float) -> None:
    """The inner or the outer ring's groove of an ordinary bearing."""
    is_inner = side < 0.0
    coefficient = case.inner_coefficient if is_inner else case.outer_coefficient
    groove.speed = case.inner_speed if is_inner else case.outer_speed
    groove.follows_ring = is_inner
    groove.sine, groove.cosine = side * case.sin_free, side * case.cos_free
    groove.gap1, groove.gap2 = 0.0, 0.0
    groove.length = coefficient - 0.5
    groove.stiffness = case.inner_stiffness if is_inner else case.outer_stiffness
    groove.semi_major, groove.semi_minor, _, _ = raceway_ellipse(case, 1.0, side, case.hertz_cosine)
    groove.curvature = (2.0 * coefficient + 1.0) / (2.0 * coefficient) if law.has_curvature else 0.0


@kernel
def set_grooves(case: recarray, law: recarray, shims: ndarray, grooves: ndarray) -> None:
    """The inner and the outer ring's grooves, and, of four, the arcs for angles of the other sign as well.

    A ring's shim g parts its arcs' centres. Seen from a ball that touches both rings at the free angle, the arc of the
    other sign lies 2 L sin(alpha0) - g further than the same angle the other way, L = r - D/2.

    Args:
        shims: of the inner and the outer ring, in ball diameters; below zero for a ring of one arc.
    """
    for k in range(grooves.size):
        groove: recarray = grooves[k]
        side = INNER_SIDE if k % 2 == 0 else OUTER_SIDE
        set_groove(case, law, groove, side)
        if k >= 2:
            shim = shims[k - 2]
            groove.sine = -groove.sine
            groove.gap1 = side * (2.0 * groove.length * case.sin_free - shim)
            if shim < 0.0:
                groove.stiffness = 0.0


@kernel
def set_ring(case: recarray, motion: recarray, result: recarray, is_carried: bool) -> None:
    """Put the ring where it starts; one ball stands for all where nothing is radial."""
    motion.channel_count, is_thrust = 0, True
    for i in range(5):
        motion.displacement[i] = result.displacement[i]
        is_thrust = is_thrust and (i == 0 or case.prescribed[i] == 0.0)
    for i in range(1 if is_thrust else 3):
        if not case.displacement_given[i]:
            motion.channel[motion.channel_count] = i
            motion.channel_count += 1
    motion.ball_count = 1 if is_thrust else case.ball_count
    motion.is_carried = is_carried and not is_thrust
    motion.speed = abs(case.inner_speed - case.outer_speed)
    motion.iterations = 0


@kernel
def set_derivative(derivative: ndarray, count: int) -> None:
    """The Fourier matrix of d/dpsi at so many equal angles: its first column, of which all others are turns.

    The highest wave of an even number has no derivative there.
    """
    derivative[0] = 0.0
    for k in range(1, count):
        sign = 0.5 if k % 2 == 0 else -0.5
        half = pi * k / count
        derivative[k] = sign / tan(half) if count % 2 == 0 else sign / sin(half)


@kernel
def put_at_azimuth(case: recarray, ball: recarray, j: int) -> None:
    """Make a ball that of this number."""
    azimuth = case.first_azimuth + 2.0 * pi * j / case.ball_count
    ball.cosine, ball.sine = cos(azimuth), sin(azimuth)
    ball.diameter, ball.deflection, ball.lobe = 1.0, 0.0, 0.0
    for k in range(6):
        ball.rate[k] = 0.0


@kernel
def place_balls(case: recarray, motion: recarray, balls: ndarray, position: ndarray) -> None:
    """Put balls where a solution under outer control has them, with its motion."""
    outer_length, inner_length = case.outer_coefficient - 0.5, case.inner_coefficient - 0.5
    g = 1.0 / case.pitch_diameter
    for j in range(motion.ball_count):
        ball: recarray = balls[j]
        put_at_azimuth(case, ball, j)
        turn_s, turn_c = sin(position[j, 0]), cos(position[j, 0])
        so, co = case.sin_free * turn_c + case.cos_free * turn_s, case.cos_free * turn_c - case.sin_free * turn_s
        x1, x2 = line_displacement(outer_length, case.sin_free, case.cos_free, so, co, position[j, 1])
        a1, a2 = inner_groove_centre(case, motion.displacement, ball)
        approach, si, ci, _ = direction(inner_length, case.sin_free, case.cos_free, a1 - x1, a2 - x2)
        si, ci, _, _, _ = inner_line(si, ci, so, co, approach, inner_length)
        axis = rotation_axis(OUTER, g, si, ci, so, co)
        terms = rolling_terms(g, si, ci, so, co, axis)
        rotation, _, _ = rotation_per_axis_length(terms, g, case.inner_speed, case.outer_speed)
        orbit, _, _ = orbital_speed(terms, case.inner_speed, case.outer_speed)
        ball.unknown[X1], ball.unknown[X2] = x1, x2
        ball.unknown[WX], ball.unknown[WY], ball.unknown[WZ] = rotation * axis[1], 0.0, -rotation * axis[0]
        ball.unknown[ORBIT] = orbit


@kernel
def stop(motion: recarray, balls: ndarray) -> None:
    """Let nothing turn, where no ring does: friction has no slip, and balls lie as pressed."""
    motion.is_carried = False
    for j in range(motion.ball_count):
        for k in range(WX, ORBIT + 1):
            balls[j].unknown[k] = 0.0


@kernel
def balance(
    case: recarray, law: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray
) -> bool:
    """Newton's method from where ring and balls are, steps halved until the imbalance falls; whether it converged."""
    residual = evaluate(case, law, grooves, arrays, motion, balls)
    for _ in range(MOST_ITERATIONS):
        if residual <= TOLERANCE or not residual < inf or not step_of_motion(case, arrays, motion, balls):
            break
        keep_state(motion, balls)
        motion.iterations += 1
        fraction, before = allowed_fraction(motion, balls), residual
        for _ in range(MOST_HALVINGS):
            move(motion, balls, fraction)
            residual = evaluate(case, law, grooves, arrays, motion, balls)
            if residual < before or before <= STALLED:
                break
            fraction *= 0.5
        if not residual < before:
            break
    motion.residual = residual
    return bool(residual <= STALLED)


@kernel
def balance_through_slips(
    case: recarray, law: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray
) -> bool:
    """The same, from a slip speed so high that friction hardly saturates, down to the law's own."""
    slip_speed = law.slip_speed
    larger, steps = slip_speed, 0
    while larger < FIRST_SLIP * motion.speed:
        larger, steps = larger / SLIP_RATIO, steps + 1
    is_balanced = True
    for k in range(steps + 1):
        law.slip_speed = larger if k < steps else slip_speed
        is_balanced = balance(case, law, grooves, arrays, motion, balls)
        if not is_balanced:
            break
        larger *= SLIP_RATIO
    law.slip_speed = slip_speed
    return is_balanced


@entry(
    *(array_of(CASE), array_of(LAW), array_of(GROOVE), array_of(MOTION), array_of(MOVED_BALL)),
    (array_of(float, 2), array_of(float, 2), array_of(float), array_of(float)),
    *(bool, array_of(RESULT), array_of(float, 3), array_of(float, 3), array_of(float, 4), array_of(float)),
)
def solve_motions(
    cases: ndarray,
    laws: ndarray,
    grooves: ndarray,
    motions: ndarray,
    balls: ndarray,
    arrays: tuple[ndarray, ...],
    is_carried: bool,
    results: ndarray,
    positions: ndarray,
    places: ndarray,
    contacts: ndarray,
    torques: ndarray,
) -> None:
    """Solve cases from their solutions under outer control, in place.

    Args:
        laws: of friction and drag, by case.
        grooves, motions, balls, arrays: working memory; of the arrays the first holds the points of a contact.
        is_carried: whether balls are carried round under radial load.
        results, positions: of the solution under outer control; displacement, load, residual, iterations and status of
            the balance take their place. One that was refused for contacts outside their grooves is a start too.
        places: (case, ball, `PLACES`).
        contacts: (case, ball, groove, quantity), quantities those of `traction_ball`; inner ring first.
        torques: on the inner ring, by case.
    """
    points, _, _, derivative = arrays
    for k in range(cases.size):
        result = results[k]
        refused = result.notes & (OPEN_SIDE | OVER_SHOULDER) if result.status == NO_EQUILIBRIUM else 0
        if result.status != CONVERGED and refused == 0:
            continue
        case, law, motion = cases[k], laws[k], motions[0]
        set_groove(case, law, grooves[0], INNER_SIDE)
        set_groove(case, law, grooves[1], OUTER_SIDE)
        set_ring(case, motion, result, is_carried)
        set_derivative(derivative, motion.ball_count)
        place_balls(case, motion, balls, positions[k])
        if motion.speed == 0.0:
            stop(motion, balls)
        is_balanced = balance(case, law, grooves, arrays, motion, balls)
        if not is_balanced and motion.speed > 0.0:
            set_ring(case, motion, result, motion.is_carried)
            place_balls(case, motion, balls, positions[k])
            is_balanced = balance_through_slips(case, law, grooves, arrays, motion, balls)
        result.residual, result.iterations = motion.residual, motion.iterations
        torques[k] = deliver(case, law, grooves, points, motion, balls, result, places[k], contacts[k])
        result.notes = outside_grooves(case, contacts[k]) if is_balanced else refused
        result.status = NO_EQUILIBRIUM if result.notes != 0 else CONVERGED if is_balanced else NOT_CONVERGED


@kernel
def outside_grooves(case: recarray, contacts: ndarray) -> int:
    """Inner contacts that carry load where no groove is, as bits of `admissibility`."""
    bits = 0
    for j in range(case.ball_count):
        if contacts[j, 0, LOAD] > 0.0:
            if case.one_sided and contacts[j, 0, SINE] > ANGLE_ROUNDING:  # n points from the ball to the contact
                bits |= OPEN_SIDE
            if contacts[j, 0, COSINE] > ANGLE_ROUNDING:
                bits |= OVER_SHOULDER
    return bits


@kernel
def deliver(
    case: recarray,
    law: recarray,
    grooves: ndarray,
    points: ndarray,
    motion: recarray,
    balls: ndarray,
    result: recarray,
    places: ndarray,
    contacts: ndarray,
) -> float:
    """Write ring, balls and contacts as they are; returns the torque on the inner ring."""
    torque, equal = 0.0, case.ball_count / motion.ball_count
    for i in range(3):
        result.displacement[i] = motion.displacement[i]
        result.load[i] = 0.0
    for j in range(motion.ball_count):
        ball: recarray = balls[j]
        weight = weight_of(case, motion, ball)
        drag, _ = drag_of(case, law, ball)
        for k in range(6):
            places[j, k] = ball.unknown[k]
        places[j, 6], places[j, 7] = weight / equal, drag
        a1, a2 = inner_groove_centre(case, motion.displacement, ball)
        for k in range(grooves.size):
            read_groove(case, law, grooves[k], points, ball, a1, a2, contacts[j, k])
        torque += weight * ball.ring_force[3]
        for i in range(3 if motion.ball_count > 1 else 1):
            result.load[i] -= weight * channel_force(ball, i)
    for j in range(motion.ball_count, case.ball_count):  # which one stands for
        for k in range(8):
            places[j, k] = places[0, k]
        for groove in range(grooves.size):
            for k in range(CONTACT_QUANTITIES):
                contacts[j, groove, k] = contacts[0, groove, k]
    return torque


@entry(
    *(array_of(CASE), array_of(LAW), array_of(GROOVE), array_of(MOTION), array_of(MOVED_BALL)),
    (array_of(float, 2), array_of(float)),
    *(bool, array_of(float, 2), array_of(float, 2), array_of(float, 3), array_of(float, 4), array_of(float, 4)),
)
def read_blocks(
    cases: ndarray,
    laws: ndarray,
    grooves: ndarray,
    motions: ndarray,
    balls: ndarray,
    arrays: tuple[ndarray, ndarray],
    is_carried: bool,
    shims: ndarray,
    displacements: ndarray,
    places: ndarray,
    of_balls: ndarray,
    of_ring: ndarray,
) -> None:
    """Derivatives of every ball's equations and of its force on the ring where it has been found.

    Args:
        laws, grooves, motions, balls: as in `solve_motions`.
        arrays: points of a contact; memory of as many numbers as there are balls.
        shims: of arched rings, for four grooves (case, 2); empty for two.
        displacements: of the ring, (case, 5).
        places: (case, ball, `PLACES`).
        of_balls: (case, ball, 6, 14): by the unknowns, by their rates along the orbit, by A1 and A2.
        of_ring: (case, ball, 4, 9): by the unknowns, by A1 and A2; the force itself.
    """
    points, derivative = arrays
    for k in range(cases.size):
        case, law, motion = cases[k], laws[k], motions[0]
        set_grooves(case, law, shims[k], grooves)
        count = case.ball_count
        for i in range(5):
            motion.displacement[i] = displacements[k, i]
        for j in range(count):
            ball: recarray = balls[j]
            put_at_azimuth(case, ball, j)
            for i in range(6):
                ball.unknown[i] = places[k, j, i]
        if is_carried:
            set_derivative(derivative, count)
            set_rates(derivative, count, balls)
        for j in range(count):
            ball = balls[j]
            a1, a2 = inner_groove_centre(case, motion.displacement, ball)
            moved_ball(case, law, grooves, points, ball, a1, a2)
            for row in range(6):
                for i in range(6):
                    of_balls[k, j, row, i] = ball.matrix[row, i]
                    of_balls[k, j, row, 6 + i] = ball.by_rate[row, i]
                for i in range(2):
                    of_balls[k, j, row, 12 + i] = ball.by_ring[row, i]
            for row in range(RING_FORCES):
                for i in range(6):
                    of_ring[k, j, row, i] = ball.ring_matrix[row, i]
                of_ring[k, j, row, 6], of_ring[k, j, row, 7] = ball.ring_by_ring[row, 0], ball.ring_by_ring[row, 1]
                of_ring[k, j, row, 8] = ball.ring_force[row]
