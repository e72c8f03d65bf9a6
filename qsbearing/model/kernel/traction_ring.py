"""The ring on balls that friction moves: what its loads lack, and how each ball and each channel act on each other.

Under thrust one ball stands for all. Under radial load balls either have all the time they need at their azimuths,
each balanced for itself, or they are carried round: the balance is periodic, with derivatives along the orbit by the
Fourier matrix of the balls' azimuths, and the ring feels each azimuth for as long as balls stay there,

    F + sum_j g_j (force of ball j on the ring) = 0,     g_j = (1/omega_m,j)/mean(1/omega_m).

So the outer ring carries what loads the inner one, and the torque's work is heat and drag: balls that friction moves do
not accelerate on average.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.case import record
from qsbearing.model.kernel.ring import inner_groove_centre
from qsbearing.model.kernel.traction_ball import ORBIT, WX, moved_ball

MOTION = record(
    ("displacement", np.float64, (5,)),
    ("channel_count", np.int64),  # of x, y and z solved
    ("channel", np.int64, (3,)),
    ("imbalance", np.float64, (3,)),
    ("before", np.float64, (3,)),
    ("step", np.float64, (3,)),
    ("kept", np.float64, (3,)),  # of its displacement, of a solution on the way to another
    ("ball_count", np.int64),  # of balls solved
    ("is_carried", np.bool_),  # round, with rates and time weights
    ("mean_time", np.float64),  # mean of 1/omega_m
    ("speed", np.float64),  # of the rings, their difference
    ("residual", np.float64),
    ("iterations", np.int64),
)
"""The ring, and how the solve goes."""


@kernel
def evaluate(
    case: recarray, law: recarray, grooves: ndarray, arrays: tuple[ndarray, ...], motion: recarray, balls: ndarray
) -> float:
    """Fill all balls' equations and the ring's imbalance; the largest imbalance over the largest load."""
    points, _, _, derivative = arrays
    count = motion.ball_count
    force, mean_time, largest = 0.0, 0.0, 0.0
    if motion.is_carried:
        set_rates(derivative, count, balls)
    for j in range(count):
        ball: recarray = balls[j]
        a1, a2 = inner_groove_centre(case, motion.displacement, ball)
        moved_ball(case, law, grooves, points, ball, a1, a2)
        force = max(force, ball.largest_load)
        if motion.is_carried:
            mean_time += 1.0 / (ball.unknown[ORBIT] * count)
        for k in range(6):
            largest = max(largest, abs(ball.residual[k]))
    motion.mean_time = mean_time
    largest = max(largest, ring_imbalance(case, motion, balls) / case.ball_count)
    return largest / force if force > 0.0 else inf


@kernel
def set_rates(derivative: ndarray, count: int, balls: ndarray) -> None:
    """Of the balls' motion along the orbit."""
    for j in range(count):
        for k in range(WX, ORBIT + 1):
            rate = 0.0
            for i in range(count):
                rate += derivative[(j - i) % count] * balls[i].unknown[k]
            balls[j].rate[k] = rate


@kernel
def ring_imbalance(case: recarray, motion: recarray, balls: ndarray) -> float:
    """Fill the ring's imbalance in its loaded channels; the largest."""
    largest = 0.0
    for c in range(motion.channel_count):
        channel = motion.channel[c]
        total = case.prescribed[channel]
        for j in range(motion.ball_count):
            total += weight_of(case, motion, balls[j]) * channel_force(balls[j], channel)
        motion.imbalance[c] = total
        largest = max(largest, abs(total))
    return largest


@kernel
def weight_of(case: recarray, motion: recarray, ball: recarray) -> float:
    """How many balls one stands for."""
    equal = case.ball_count / motion.ball_count
    return equal / (ball.unknown[ORBIT] * motion.mean_time) if motion.is_carried else equal


@kernel
def channel_force(ball: recarray, channel: int) -> float:
    """A ball's force on the ring in x, y or z."""
    if channel == 0:
        return ball.ring_force[0]
    if channel == 1:
        return ball.ring_force[1] * ball.cosine + ball.ring_force[2] * ball.sine
    return ball.ring_force[1] * ball.sine - ball.ring_force[2] * ball.cosine


@kernel
def channel_slope(ball: recarray, channel: int, k: int) -> float:
    """The same by an unknown of the ball."""
    if channel == 0:
        return ball.ring_matrix[0, k]
    if channel == 1:
        return ball.ring_matrix[1, k] * ball.cosine + ball.ring_matrix[2, k] * ball.sine
    return ball.ring_matrix[1, k] * ball.sine - ball.ring_matrix[2, k] * ball.cosine


@kernel
def channel_by_ring(ball: recarray, channel: int, along: int) -> float:
    """The same by the inner groove centre's displacement."""
    if channel == 0:
        return ball.ring_by_ring[0, along]
    if channel == 1:
        return ball.ring_by_ring[1, along] * ball.cosine + ball.ring_by_ring[2, along] * ball.sine
    return ball.ring_by_ring[1, along] * ball.sine - ball.ring_by_ring[2, along] * ball.cosine


@kernel
def along_of(channel: int) -> int:
    """Which of A1 and A2 a channel moves."""
    return 0 if channel == 0 else 1


@kernel
def lever_of(ball: recarray, channel: int) -> float:
    """By how much x, y or z moves a ball's inner groove centre, along A1 or A2."""
    return 1.0 if channel == 0 else ball.cosine if channel == 1 else ball.sine
