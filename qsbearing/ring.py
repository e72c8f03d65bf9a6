"""The ring: which balls and channels need solving, and how the balls' forces add up in its five channels.

Ring displacement d = (x, y, z, tilt y, tilt z) moves a ball's inner groove centre by (19.3, 19.4)

    dA1 = x + L (gy sin psi - gz cos psi),      dA2 = y cos psi + z sin psi

and the ball answers with h1 to x, h2 to y and z, h3 to the tilts, through the same coefficients (19.13-19.15; L is
the tilt lever, the radius of the inner groove centres).
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import NamedTuple

import numpy as np
from numpy import ndarray

from qsbearing.compiled import kernel


class Workspace(NamedTuple):
    """Arrays that one thread reuses from case to case."""

    cosine: ndarray
    sine: ndarray
    placed: ndarray  # (ball_count, first_azimuth) the cosines stand for
    ball: ndarray  # the balls solved: one of each set of equals
    weight: ndarray  # how many it stands for
    twin: ndarray  # for every ball, the one solved for it
    in_plane: ndarray  # 1 for the channels that the symmetry leaves, 0 where it makes all vanish
    channel: ndarray  # the channels solved: free and in plane
    control: ndarray  # raceway control of each ball
    condensed: ndarray  # what each ball leaves for the ring (see ball.CONDENSED)
    matrix: ndarray  # the ring's system
    right: ndarray
    force: ndarray  # sum of the balls' forces in the five channels
    step: ndarray  # of the balls
    ring_step: ndarray
    before: ndarray  # balls' positions and outer contact lines before the step
    ring_before: ndarray
    inertia: ndarray  # frozen f and ring forces of each ball
    imbalance: ndarray  # of each ball, under frozen f
    saved: ndarray  # balls' positions to come back to
    ring_saved: ndarray


@kernel
def make_workspace(balls: int) -> Workspace:
    """A workspace for bearings of up to this many balls."""
    return Workspace(
        np.empty(balls),
        np.empty(balls),
        np.full(2, -1.0),
        np.empty(balls, np.int64),
        np.empty(balls),
        np.empty(balls, np.int64),
        np.empty(5),
        np.empty(5, np.int64),
        np.zeros(balls, np.int64),
        np.empty((balls, 21)),
        np.empty((5, 5)),
        np.empty(5),
        np.empty(5),
        np.zeros((balls, 2)),
        np.zeros(5),
        np.empty((balls, 5)),
        np.empty(5),
        np.zeros((balls, 5)),
        np.zeros((balls, 2)),
        np.empty((balls, 2)),
        np.empty(5),
    )


@kernel
def place_balls(case: ndarray, w: Workspace) -> None:
    """Cosines and sines of the azimuths; kept while neighbouring cases share them."""
    count = case.ball_count
    if w.placed[0] == count and w.placed[1] == case.first_azimuth:
        return
    for j in range(count):
        azimuth = case.first_azimuth + 2.0 * pi * j / count
        w.cosine[j] = cos(azimuth)
        w.sine[j] = sin(azimuth)
    w.placed[0] = count
    w.placed[1] = case.first_azimuth


@kernel
def _is_idle(case: ndarray, first: int, second: int) -> bool:
    """Neither load nor displacement in either channel."""
    return case.prescribed[first] == 0.0 and case.prescribed[second] == 0.0


@kernel
def _mirror_sum(case: ndarray, plane_azimuth: float) -> int:
    """s such that mirroring at the plane turns ball j into ball s - j; -1 where the set of balls has no such mirror."""
    turns = (plane_azimuth - case.first_azimuth) * case.ball_count / pi
    nearest = round(turns)
    if abs(turns - nearest) > 1e-9:
        return -1
    return int(nearest) % case.ball_count


@kernel
def find_equals(case: ndarray, w: Workspace) -> tuple[int, int]:
    """Choose the balls and channels to solve: (number of balls, number of channels).

    Pure thrust: all balls are equal and one stands for them. Loads in the x-y or the x-z plane: mirror images are
    equal, and what points out of the plane vanishes. A channel without load that is held at zero changes nothing.
    """
    count = case.ball_count
    in_xy = _is_idle(case, 2, 3)
    in_xz = _is_idle(case, 1, 4)
    is_thrust = in_xy and in_xz and count >= 2  # two equal balls balance in every channel; one does not
    mirror = -1
    if in_xy and not is_thrust:
        mirror = _mirror_sum(case, 0.0)
    elif in_xz and not is_thrust:
        mirror = _mirror_sum(case, 0.5 * pi)
    for i in range(5):
        w.in_plane[i] = 1.0
    if is_thrust or (mirror >= 0 and in_xy):
        w.in_plane[2], w.in_plane[3] = 0.0, 0.0
    if is_thrust or (mirror >= 0 and not in_xy):
        w.in_plane[1], w.in_plane[4] = 0.0, 0.0
    balls = 0
    for j in range(count):
        image = j
        if is_thrust:
            image = 0
        elif mirror >= 0:
            image = (mirror - j) % count
        if image < j:
            w.twin[j] = image
            w.weight[_place_of(w, balls, image)] += 1.0
        else:
            w.twin[j] = j
            w.ball[balls] = j
            w.weight[balls] = 1.0
            balls += 1
    channels = 0
    for i in range(5):
        if not case.is_held[i] and w.in_plane[i] != 0.0:
            w.channel[channels] = i
            channels += 1
    return balls, channels


@kernel
def _place_of(w: Workspace, balls: int, ball: int) -> int:
    """Where a ball stands among those solved."""
    place = balls - 1
    while place > 0 and w.ball[place] != ball:
        place -= 1
    return place


@kernel
def inner_groove_centre(case: ndarray, ring: ndarray, cosine: float, sine: float) -> tuple[float, float]:
    """Displacement of a ball's inner groove centre (19.3, 19.4)."""
    return (
        ring[0] + case.tilt_lever * (ring[3] * sine - ring[4] * cosine),
        ring[1] * cosine + ring[2] * sine,
    )


@kernel
def add_ball(case: ndarray, w: Workspace, h: ndarray, cosine: float, sine: float, weight: float, channels: int) -> None:
    """Add a ball's force to the ring's sum, and its condensed force and stiffness to the ring's system."""
    force = w.force
    force[0] += weight * h[0]
    force[1] += weight * h[1] * cosine
    force[2] += weight * h[1] * sine
    force[3] += weight * h[2] * sine
    force[4] -= weight * h[2] * cosine
    lever = case.tilt_lever
    for p in range(channels):
        i = w.channel[p]
        row, turn = _row(i, cosine, sine)
        factor = weight * turn
        w.right[p] += factor * h[3 + row]
        k1, k2 = factor * h[6 + 2 * row], factor * h[7 + 2 * row]
        for q in range(channels):
            j = w.channel[q]
            if j == 0:
                w.matrix[p, q] += k1
            elif j == 1:
                w.matrix[p, q] += k2 * cosine
            elif j == 2:
                w.matrix[p, q] += k2 * sine
            elif j == 3:
                w.matrix[p, q] += k1 * lever * sine
            else:
                w.matrix[p, q] -= k1 * lever * cosine


@kernel
def _row(channel: int, cosine: float, sine: float) -> tuple[int, float]:
    """Which of h1, h2, h3 a channel feels, and through which factor."""
    if channel == 0:
        return 0, 1.0
    if channel == 1:
        return 1, cosine
    if channel == 2:
        return 1, sine
    if channel == 3:
        return 2, sine
    return 2, -cosine


@kernel
def clear(w: Workspace, channels: int) -> None:
    """Empty sums before a pass over the balls."""
    for i in range(5):
        w.force[i] = 0.0
    for p in range(channels):
        w.right[p] = 0.0
        for q in range(channels):
            w.matrix[p, q] = 0.0


@kernel
def channel_scale(case: ndarray, channel: int) -> float:
    """A length that makes a force of the channel's entry: 1 for forces, the pitch radius for moments."""
    return 0.5 * case.pitch_diameter if channel >= 3 else 1.0
