"""Where balls lie between arched rings when friction pushes them nowhere, and how they would turn there: a start.

Each arc is a spring that ends in its own centre, and the balls' centrifugal force does not change. So

    Pi = sum 2/5 K <delta>^(5/2) - sum Fc X2 - F.d

is convex in the ring's displacement and the balls' places together, since each line from an arc's centre to a ball's is
affine in them: there is one least value, whichever arcs carry. Newton's method with halved steps finds it. A ball that
nothing touches has no place of its own; it stays where it is. At rest this is the solution.

The motion at these loads is that of the linear law without gyroscopic moment, the least of

    sum Q (v_y^2 + ws^2 (a^2 + b^2)/5)

over (wx, wz, omega_m): three linear equations.
"""

from __future__ import annotations

from math import inf

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.case import BALL_MASS
from qsbearing.model.kernel.contact_line import contact_load
from qsbearing.model.kernel.linear import solve_in_place
from qsbearing.model.kernel.ring import inner_groove_centre
from qsbearing.model.kernel.traction_ball import FX, FZ, ORBIT, WX, WY, WZ, X1, X2, line_to, orbit_of
from qsbearing.model.kernel.traction_ring import (
    along_of,
    channel_by_ring,
    channel_force,
    channel_slope,
    lever_of,
    weight_of,
)
from qsbearing.model.kernel.traction_step import LARGEST_SHIFT, eliminate_place, keep_state, move

BALANCED = 1e-13
"""Largest imbalance over the largest load that ends Newton's method."""
STALLED = 1e-10
MOST_ITERATIONS, MOST_HALVINGS = 400, 30
SOFTNESS, SOFTEST = 1e-6, 1e-12
"""Stiffness that keeps what nothing touches in its place, over that of a contact under the case's load a ball, about
Q^(1/3); and the least, over E'D."""
OWN_ORBIT = 10.0
"""Weight of its kinematic orbit for a ball that no inner arc drives, over its load."""


@kernel
def set_frozen_orbits(case: recarray, motion: recarray, balls: ndarray) -> None:
    """Let balls go round as if they rolled on the middle of both rings, and not turn."""
    part = case.cos_free / case.pitch_diameter
    orbit = 0.5 * (case.inner_speed * (1.0 - part) + case.outer_speed * (1.0 + part))
    for j in range(motion.ball_count):
        for k in range(WX, ORBIT):
            balls[j].unknown[k] = 0.0
        balls[j].unknown[ORBIT] = orbit


@kernel
def press_ball(case: recarray, grooves: ndarray, ball: recarray, a1: float, a2: float, soft: float) -> float:
    """Fill a ball's forces in its plane, their slopes and its force on the ring, without friction; its energy."""
    matrix, by_ring, orbit = ball.matrix, ball.by_ring, ball.unknown[ORBIT]
    push: float = BALL_MASS * orbit * orbit * 0.5 * case.pitch_diameter
    ball.largest_load = push
    ball.residual[FX], ball.residual[FZ] = 0.0, push
    for row in (FX, FZ):
        for k in range(6):
            matrix[row, k] = 0.0
        by_ring[row, 0], by_ring[row, 1] = 0.0, 0.0
    matrix[FX, X1], matrix[FZ, X2] = -soft, -soft
    for row in range(4):
        ball.ring_force[row] = 0.0
        for k in range(2):
            ball.ring_matrix[row, k], ball.ring_by_ring[row, k] = 0.0, 0.0
    energy = -push * ball.unknown[X2]
    for k in range(grooves.size):
        groove: recarray = grooves[k]
        approach, n1, n2, inverse = line_to(groove, ball.unknown[X1], ball.unknown[X2], a1, a2)
        load, slope = contact_load(groove.stiffness, approach)
        if load <= 0.0:
            continue
        ball.largest_load = max(ball.largest_load, load)
        energy += 0.4 * load * approach
        turn = load * inverse
        h11, h12, h22 = slope * n1 * n1 + turn * n2 * n2, (slope - turn) * n1 * n2, slope * n2 * n2 + turn * n1 * n1
        ball.residual[FX] -= load * n1
        ball.residual[FZ] -= load * n2
        matrix[FX, X1], matrix[FX, X2] = matrix[FX, X1] - h11, matrix[FX, X2] - h12
        matrix[FZ, X1], matrix[FZ, X2] = matrix[FZ, X1] - h12, matrix[FZ, X2] - h22
        if groove.follows_ring:
            ball.ring_force[0] += load * n1
            ball.ring_force[1] += load * n2
            add_block(by_ring, h11, h12, h22)
            add_block(ball.ring_matrix, h11, h12, h22)
            add_block(ball.ring_by_ring, -h11, -h12, -h22)
    return energy


@kernel
def add_block(of: ndarray, h11: float, h12: float, h22: float) -> None:
    """Add a symmetric block to the first two rows and columns."""
    of[0, 0], of[0, 1] = of[0, 0] + h11, of[0, 1] + h12
    of[1, 0], of[1, 1] = of[1, 0] + h12, of[1, 1] + h22


@kernel
def press(case: recarray, grooves: ndarray, motion: recarray, balls: ndarray, soft: float) -> float:
    """Fill all balls and the ring's imbalance and residual; Pi."""
    energy, largest, force = 0.0, 0.0, 0.0
    for j in range(motion.ball_count):
        ball: recarray = balls[j]
        a1, a2 = inner_groove_centre(case, motion.displacement, ball)
        energy += weight_of(case, motion, ball) * press_ball(case, grooves, ball, a1, a2, soft)
        force = max(force, ball.largest_load)
        largest = max(largest, abs(ball.residual[FX]), abs(ball.residual[FZ]))
    for c in range(motion.channel_count):
        channel = motion.channel[c]
        total = case.prescribed[channel]
        energy -= total * motion.displacement[channel]
        force = max(force, abs(total) / case.ball_count)
        for j in range(motion.ball_count):
            total += weight_of(case, motion, balls[j]) * channel_force(balls[j], channel)
        motion.imbalance[c] = total
        largest = max(largest, abs(total) / case.ball_count)
    motion.residual = largest / force if force > 0.0 else 0.0
    return energy


@kernel
def step_of_places(case: recarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray, soft: float) -> bool:
    """Newton's step of ring and places, into their records; whether there is one."""
    _, matrix, right_side, _ = arrays
    count = motion.channel_count
    for j in range(motion.ball_count):
        eliminate_place(motion, balls[j])
    for c in range(count):
        channel = motion.channel[c]
        right_side[c] = -motion.imbalance[c]
        for other in range(count):
            matrix[c, other] = -soft if other == c else 0.0
        for j in range(motion.ball_count):
            ball: recarray = balls[j]
            weight, shift = weight_of(case, motion, ball), ball.shift
            by_x1, by_x2 = weight * channel_slope(ball, channel, X1), weight * channel_slope(ball, channel, X2)
            right_side[c] -= by_x1 * shift[0, 7] + by_x2 * shift[1, 7]
            for other in range(count):
                along, lever = along_of(motion.channel[other]), lever_of(ball, motion.channel[other])
                own = weight * channel_by_ring(ball, channel, along) * lever
                matrix[c, other] += own - by_x1 * shift[0, 4 + other] - by_x2 * shift[1, 4 + other]
    if not solve_in_place(matrix, right_side, count):
        return False
    for c in range(count):
        motion.step[c] = right_side[c]
    for j in range(motion.ball_count):
        ball = balls[j]
        for k in range(WX, ORBIT + 1):
            ball.step[k] = 0.0
        for i in range(2):
            ball.step[i] = ball.shift[i, 7]
            for c in range(count):
                ball.step[i] -= ball.shift[i, 4 + c] * motion.step[c]
    return True


@kernel
def allowed_shift(motion: recarray, balls: ndarray) -> float:
    """What part of a step keeps to the limit on shifts; motion has no step here."""
    largest = LARGEST_SHIFT
    for j in range(motion.ball_count):
        largest = max(largest, abs(balls[j].step[X1]), abs(balls[j].step[X2]))
    for c in range(motion.channel_count):
        largest = max(largest, abs(motion.step[c]))
    return LARGEST_SHIFT / largest


@kernel
def settle(case: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray) -> bool:
    """Find the least of Pi from where ring and balls are; whether it was found."""
    load = BALL_MASS * balls[0].unknown[ORBIT] ** 2 * 0.5 * case.pitch_diameter
    for c in range(motion.channel_count):
        load = max(load, abs(case.prescribed[motion.channel[c]]) / case.ball_count)
    soft = max(SOFTEST, SOFTNESS * load ** (1.0 / 3.0))
    energy = press(case, grooves, motion, balls, soft)
    for _ in range(MOST_ITERATIONS):
        if motion.residual <= BALANCED or not step_of_places(case, arrays, motion, balls, soft):
            break
        keep_state(motion, balls)
        motion.iterations += 1
        fraction, before, least = allowed_shift(motion, balls), motion.residual, energy
        is_lower = False
        for _ in range(MOST_HALVINGS):
            move(motion, balls, fraction)
            energy = press(case, grooves, motion, balls, soft)
            is_lower = energy < least or motion.residual < before
            if is_lower:
                break
            fraction *= 0.5
        if not is_lower:
            break
    return bool(motion.residual <= STALLED)


@kernel
def set_rolling(
    case: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray
) -> bool:
    """Give balls, where they lie, the motion of the linear law; whether each has one."""
    for j in range(motion.ball_count):
        ball: recarray = balls[j]
        a1, a2 = inner_groove_centre(case, motion.displacement, ball)
        if not roll(case, grooves, arrays, ball, a1, a2):
            return False
    return True


@kernel
def roll(case: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], ball: recarray, a1: float, a2: float) -> bool:
    """Fill the motion of one ball; its orbit stays as it is where no inner arc drives it."""
    _, matrix, right_side, _ = arrays
    radius, driven, largest = orbit_of(case, ball), False, 0.0
    for row in range(3):
        right_side[row] = 0.0
        for k in range(3):
            matrix[row, k] = 0.0
    for k in range(grooves.size):
        groove: recarray = grooves[k]
        approach, n1, n2, _ = line_to(groove, ball.unknown[X1], ball.unknown[X2], a1, a2)
        load, _ = contact_load(groove.stiffness, approach)
        if load <= 0.0:
            continue
        driven, largest = driven or groove.follows_ring, max(largest, load)
        root = load ** (1.0 / 3.0)
        a, b = groove.semi_major * root, groove.semi_minor * root
        along = -0.5 * n2, 0.5 * n1, -radius - 0.5 * n2  # v_y by wx, wz and omega_m
        spin = n1, n2, n1  # ws likewise
        add_squares(matrix, right_side, load, along, groove.speed * (radius + 0.5 * n2))
        add_squares(matrix, right_side, 0.2 * load * (a * a + b * b), spin, -groove.speed * n1)
    if not driven:
        kept = 0.0, 0.0, radius
        add_squares(matrix, right_side, OWN_ORBIT * largest, kept, -radius * ball.unknown[ORBIT])
    if not 0.0 < largest < inf or not solve_in_place(matrix, right_side, 3):
        return False
    ball.unknown[WX], ball.unknown[WY], ball.unknown[WZ] = right_side[0], 0.0, right_side[1]
    ball.unknown[ORBIT] = right_side[2]
    return True


@kernel
def add_squares(
    matrix: ndarray, right_side: ndarray, weight: float, slopes: tuple[float, float, float], value: float
) -> None:
    """Add the normal equations of a weighted square of what is affine in three unknowns."""
    for row in range(3):
        right_side[row] -= weight * slopes[row] * value
        for k in range(3):
            matrix[row, k] += weight * slopes[row] * slopes[k]
