"""One step of Newton's method on ring and balls that friction moves.

Each ball's place, two unknowns, is eliminated where the ball is; its motion, four, is not, for balls that are carried
round hang together by their derivatives along the orbit. What is left is dense: four rows a ball, and the ring's.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.linear import solve_in_place
from qsbearing.model.kernel.traction_ball import FX, FY, FZ, MZ, ORBIT, WX, X1, X2
from qsbearing.model.kernel.traction_ring import (
    along_of,
    channel_by_ring,
    channel_force,
    channel_slope,
    lever_of,
    weight_of,
)

LARGEST_TURN = 0.6
"""Of a step in the balls' speeds, over the rings' difference of speed."""
LARGEST_SHIFT = 4.5e-4
"""Of a step in positions, in ball diameters: 10 um in B218."""


@kernel
def eliminate_place(motion: recarray, ball: recarray) -> None:
    """Solve a ball's forces in its plane for its place, by its motion and the ring."""
    m, shift = ball.matrix, ball.shift
    inverse = 1.0 / (m[FX, X1] * m[FZ, X2] - m[FX, X2] * m[FZ, X1])
    for k in range(8):
        x, z = 0.0, 0.0
        if k < 4:
            x, z = m[FX, WX + k], m[FZ, WX + k]
        elif k == 7:
            x, z = -ball.residual[FX], -ball.residual[FZ]
        elif k - 4 < motion.channel_count:
            channel = motion.channel[k - 4]
            along, lever = along_of(channel), lever_of(ball, channel)
            x, z = ball.by_ring[FX, along] * lever, ball.by_ring[FZ, along] * lever
        shift[0, k] = (m[FZ, X2] * x - m[FX, X2] * z) * inverse
        shift[1, k] = (m[FX, X1] * z - m[FZ, X1] * x) * inverse


@kernel
def put_ball(arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray, j: int) -> None:
    """Write the rows of a ball's motion, its place eliminated."""
    _, matrix, right_side, derivative = arrays
    ball, count, first = balls[j], motion.ball_count, 4 * motion.ball_count
    m, shift = ball.matrix, ball.shift
    for r in range(FY, MZ + 1):
        row, by_x1, by_x2 = 4 * j + r - FY, m[r, X1], m[r, X2]
        right_side[row] = -ball.residual[r] - by_x1 * shift[0, 7] - by_x2 * shift[1, 7]
        for k in range(4):
            matrix[row, 4 * j + k] = m[r, WX + k] - by_x1 * shift[0, k] - by_x2 * shift[1, k]
        for c in range(motion.channel_count):
            channel = motion.channel[c]
            own = ball.by_ring[r, along_of(channel)] * lever_of(ball, channel)
            matrix[row, first + c] = own - by_x1 * shift[0, 4 + c] - by_x2 * shift[1, 4 + c]
        if motion.is_carried:
            for i in range(count):
                for k in range(4):
                    matrix[row, 4 * i + k] += ball.by_rate[r, WX + k] * derivative[(j - i) % count]


@kernel
def put_channel(case: recarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray, c: int) -> None:
    """Write the row of a channel of the ring."""
    _, matrix, right_side, _ = arrays
    count, channel = motion.ball_count, motion.channel[c]
    row, loaded = 4 * count + c, motion.imbalance[c] - case.prescribed[channel]
    right_side[row] = -motion.imbalance[c]
    for j in range(count):
        ball: recarray = balls[j]
        weight, shift = weight_of(case, motion, ball), ball.shift
        by_x1, by_x2 = weight * channel_slope(ball, channel, X1), weight * channel_slope(ball, channel, X2)
        right_side[row] -= by_x1 * shift[0, 7] + by_x2 * shift[1, 7]
        for k in range(4):
            own = weight * channel_slope(ball, channel, WX + k)
            matrix[row, 4 * j + k] = own - by_x1 * shift[0, k] - by_x2 * shift[1, k]
        if motion.is_carried:  # a ball that is slower here stays longer, and all others less
            orbit = ball.unknown[ORBIT]
            share = loaded / (orbit * motion.mean_time * count) - weight * channel_force(ball, channel)
            matrix[row, 4 * j + ORBIT - WX] += share / orbit
        for other in range(motion.channel_count):
            along, lever = along_of(motion.channel[other]), lever_of(ball, motion.channel[other])
            own = weight * channel_by_ring(ball, channel, along) * lever
            matrix[row, 4 * count + other] += own - by_x1 * shift[0, 4 + other] - by_x2 * shift[1, 4 + other]


@kernel
def step_of_motion(case: recarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray) -> bool:
    """Newton's step, into each ball's record and the ring's; whether there is one."""
    _, matrix, right_side, _ = arrays
    size = 4 * motion.ball_count + motion.channel_count
    for row in range(size):
        for column in range(size):
            matrix[row, column] = 0.0
    for j in range(motion.ball_count):
        eliminate_place(motion, balls[j])
        put_ball(arrays, motion, balls, j)
    for c in range(motion.channel_count):
        put_channel(case, arrays, motion, balls, c)
    if not solve_in_place(matrix, right_side, size):
        return False
    for c in range(motion.channel_count):
        motion.step[c] = right_side[4 * motion.ball_count + c]
    for j in range(motion.ball_count):
        ball: recarray = balls[j]
        for k in range(4):
            ball.step[WX + k] = right_side[4 * j + k]
        for i in range(2):
            step = ball.shift[i, 7]
            for k in range(4):
                step -= ball.shift[i, k] * ball.step[WX + k]
            for c in range(motion.channel_count):
                step -= ball.shift[i, 4 + c] * motion.step[c]
            ball.step[i] = step
    return True


@kernel
def keep_state(motion: recarray, balls: ndarray) -> None:
    """Of ring and balls, before a step."""
    for j in range(motion.ball_count):
        for k in range(6):
            balls[j].before[k] = balls[j].unknown[k]
    for c in range(motion.channel_count):
        motion.before[c] = motion.displacement[motion.channel[c]]


@kernel
def move(motion: recarray, balls: ndarray, fraction: float) -> None:
    """From what was kept by a fraction of the step."""
    for j in range(motion.ball_count):
        for k in range(6):
            balls[j].unknown[k] = balls[j].before[k] + fraction * balls[j].step[k]
    for c in range(motion.channel_count):
        motion.displacement[motion.channel[c]] = motion.before[c] + fraction * motion.step[c]


@kernel
def allowed_fraction(motion: recarray, balls: ndarray) -> float:
    """Of a step, within the limits on shifts and turns."""
    fraction = 1.0
    for j in range(motion.ball_count):
        for k in range(6):
            limit = LARGEST_SHIFT if k <= X2 else LARGEST_TURN * motion.speed
            fraction = min(fraction, limit / max(limit, abs(balls[j].step[k])))
    for c in range(motion.channel_count):
        fraction = min(fraction, LARGEST_SHIFT / max(LARGEST_SHIFT, abs(motion.step[c])))
    return fraction
