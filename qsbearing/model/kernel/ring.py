"""The ring: which balls and channels need solving, and how the balls' forces add up in its five channels.

Ring displacement d = (x, y, z, tilt y, tilt z) moves a ball's inner groove centre by (19.3, 19.4)

    dA1 = x + L (gy sin psi - gz cos psi),      dA2 = y cos psi + z sin psi

and the ball answers with h1 to x, h2 to y and z, h3 to the tilts, through the same coefficients (19.13-19.15; L is
the tilt lever, the radius of the inner groove centres).
"""

from __future__ import annotations

from math import cos, pi, sin

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.effects.unequal_balls import from_own_touching
from qsbearing.model.kernel.ball_size import are_uneven

Vector = ndarray | tuple[float, ...]
"""Of the ring, in its five channels."""


@kernel
def set_azimuths(case: recarray, work: recarray, balls: ndarray) -> None:
    """Cosines and sines of the azimuths; reused while neighbouring cases share them."""
    count = case.ball_count
    if work.azimuth_count == count and work.azimuth_first == case.first_azimuth:
        return
    for j in range(count):
        azimuth = case.first_azimuth + 2.0 * pi * j / count
        balls[j].azimuth_cosine = cos(azimuth)
        balls[j].azimuth_sine = sin(azimuth)
    work.azimuth_count = count
    work.azimuth_first = case.first_azimuth


@kernel
def _mirror_sum(case: recarray, plane_azimuth: float) -> int:
    """s such that mirroring at the plane turns ball j into ball s - j; -1 where the set of balls has no such mirror."""
    turns = (plane_azimuth - case.first_azimuth) * case.ball_count / pi
    nearest = round(turns)
    if abs(turns - nearest) > 1e-9:
        return -1
    return int(nearest) % case.ball_count


@kernel
def find_distinct_balls(case: recarray, work: recarray, balls: ndarray) -> None:
    """Choose the balls and channels to solve.

    Pure thrust: all balls are equal and one stands for them. Loads in the x-y or the x-z plane: mirror images are
    equal, and what points out of the plane vanishes. A zero load and a zero displacement are equally symmetric. Balls
    of unequal diameters, or between grooves out of round, are all solved.
    """
    count = case.ball_count
    differ = are_uneven(case)
    prescribed = case.prescribed
    in_xy = prescribed[2] == 0.0 and prescribed[3] == 0.0
    in_xz = prescribed[1] == 0.0 and prescribed[4] == 0.0
    is_thrust = in_xy and in_xz and count >= 2 and not differ  # two equal balls balance in every channel; one does not
    mirror = -1
    if not (differ or is_thrust):
        if in_xy:
            mirror = _mirror_sum(case, 0.0)
        elif in_xz:
            mirror = _mirror_sum(case, 0.5 * pi)
    for i in range(5):
        work.in_plane[i] = 1.0
    if is_thrust or (mirror >= 0 and in_xy):
        work.in_plane[2], work.in_plane[3] = 0.0, 0.0
    if is_thrust or (mirror >= 0 and not in_xy):
        work.in_plane[1], work.in_plane[4] = 0.0, 0.0
    solved = 0
    for j in range(count):
        image = j
        if is_thrust:
            image = 0
        elif mirror >= 0:
            image = (mirror - j) % count
        if image < j:
            index = balls[image].index
            balls[j].index = index
            balls[index].weight += 1.0
        else:
            balls[j].index = solved
            ball = balls[solved]
            ball.number, ball.weight = j, 1.0
            ball.cosine, ball.sine = balls[j].azimuth_cosine, balls[j].azimuth_sine
            solved += 1
    work.ball_count = solved
    channel_count = 0
    for i in range(5):
        if not case.displacement_given[i] and work.in_plane[i] != 0.0:
            work.channel[channel_count] = i
            channel_count += 1
    work.channel_count = channel_count
    couple_channels(case, work, balls)


@kernel
def couple_channels(case: recarray, work: recarray, balls: ndarray) -> None:
    """How each ball and each channel solved act on each other.

    A channel of the ring moves the inner groove centre along A1 or A2 (19.3, 19.4), and feels the ball's force through
    the same cosine or sine (19.13-19.15).
    """
    for p in range(work.channel_count):
        i = work.channel[p]
        work.row[p] = 0 if i == 0 else 1 if i < 3 else 2
        for n in range(work.ball_count):
            ball = balls[n]
            turn = 1.0
            if i == 1:
                turn = ball.cosine
            elif i == 2 or i == 3:
                turn = ball.sine
            elif i == 4:
                turn = -ball.cosine
            ball.factor[p] = ball.weight * turn
            ball.lever[p] = case.tilt_lever * turn if i >= 3 else turn


@inlined
def inner_groove_centre(case: recarray, displacement: Vector, ball: recarray) -> tuple[float, float]:
    """A ball's inner groove centre at this displacement of the ring, from where the ball touches at the free angle.

    Where the rings wedge the balls they cannot touch without load: there the interference adds to (19.4), and so does
    the lobe of grooves out of round (`effects.seats_out_of_round`). Elastic rings deflect.
    """
    a1, a2 = inner_groove_step(case, displacement, ball.cosine, ball.sine)
    a2 += case.interference
    if case.elastic_rings:
        a2 -= ball.deflection
    if case.out_of_round:
        a2 += ball.lobe
    if case.unequal_balls:
        return from_own_touching(a1, a2, ball.diameter - 1.0, case.sin_free, case.cos_free)
    return a1, a2


@inlined
def inner_groove_step(case: recarray, displacement: Vector, cosine: float, sine: float) -> tuple[float, float]:
    """Displacement of a ball's inner groove centre with the ring (19.3, 19.4)."""
    return (
        displacement[0] + case.tilt_lever * (displacement[3] * sine - displacement[4] * cosine),
        displacement[1] * cosine + displacement[2] * sine,
    )


@kernel
def start_sums(case: recarray, work: recarray) -> None:
    """Start the sums of a pass over the balls."""
    for p in range(work.channel_count):
        load = work.load_factor * case.prescribed[work.channel[p]]
        work.imbalance[p] = -load
        work.right_side[p] = -load
        for q in range(work.channel_count):
            work.matrix[p, q] = 0.0


@inlined
def add_ball(work: recarray, ball: recarray) -> None:
    """Add a ball's force to the ring's imbalance, and its condensed force and stiffness to the ring's system."""
    for p in range(work.channel_count):
        row, factor = work.row[p], ball.factor[p]
        work.imbalance[p] += factor * ball.force[row]
        work.right_side[p] += factor * ball.condensed[row]
        by_a1, by_a2 = factor * ball.stiffness[row, 0], factor * ball.stiffness[row, 1]
        for q in range(work.channel_count):
            work.matrix[p, q] += ball.lever[q] * (by_a2 if work.row[q] == 1 else by_a1)


@kernel
def add_force(ball: recarray, cosine: float, sine: float, total: ndarray) -> None:
    """Add a ball's force on the ring to the sum in the five channels (19.13-19.15)."""
    total[0] += ball.force[0]
    total[1] += ball.force[1] * cosine
    total[2] += ball.force[1] * sine
    total[3] += ball.force[2] * sine
    total[4] -= ball.force[2] * cosine


@kernel
def channel_lever(case: recarray, channel: int) -> float:
    """A length that makes a force of the channel's entry: 1 for forces, the pitch radius for moments."""
    return 0.5 * case.pitch_diameter if channel >= 3 else 1.0
