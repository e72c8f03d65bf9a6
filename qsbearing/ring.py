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
    row: ndarray  # for each, which of h1, h2, h3 it feels
    factor: ndarray  # and through which factor, weight included, for each ball solved
    lever: ndarray  # and how it moves that ball's groove centre
    control: ndarray  # raceway control of each ball
    condensed: ndarray  # what each ball leaves for the ring (see ball.CONDENSED)
    matrix: ndarray  # the ring's system
    right: ndarray
    imbalance: ndarray  # of the channels solved: the balls' forces less the load
    step: ndarray  # of the balls
    ring_step: ndarray
    before: ndarray  # balls' positions before the step
    ring_before: ndarray
    inertia: ndarray  # frozen f and ring forces of each ball
    ball_imbalance: ndarray  # of each ball, under frozen f
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
        np.empty(5, np.int64),
        np.empty((balls, 5)),
        np.empty((balls, 5)),
        np.zeros(balls, np.int64),
        np.empty((balls, 22)),
        np.empty((5, 5)),
        np.empty(5),
        np.empty(5),
        np.zeros((balls, 2)),
        np.zeros(5),
        np.empty((balls, 2)),
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
    couple(case, w, balls, channels)
    return balls, channels


@kernel
def couple(case: ndarray, w: Workspace, balls: int, channels: int) -> None:
    """How each ball solved and each channel solved act on each other: a channel of the ring moves the inner groove
    centre along A1 or A2 (19.3, 19.4), and feels the ball's force through the same cosine or sine (19.13-19.15)."""
    for p in range(channels):
        i = w.channel[p]
        w.row[p] = 0 if i == 0 else 1 if i < 3 else 2
        for n in range(balls):
            j = w.ball[n]
            turn = 1.0
            if i == 1:
                turn = w.cosine[j]
            elif i == 2 or i == 3:
                turn = w.sine[j]
            elif i == 4:
                turn = -w.cosine[j]
            w.factor[n, p] = w.weight[n] * turn
            w.lever[n, p] = case.tilt_lever * turn if i >= 3 else turn


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
def add_ball(w: Workspace, n: int, h: ndarray, channels: int) -> None:
    """Add a ball's force to the ring's imbalance, and its condensed force and stiffness to the ring's system."""
    for p in range(channels):
        row, factor = w.row[p], w.factor[n, p]
        w.imbalance[p] += factor * h[row]
        w.right[p] += factor * h[3 + row]
        by_a1, by_a2 = factor * h[6 + 2 * row], factor * h[7 + 2 * row]
        for q in range(channels):
            w.matrix[p, q] += w.lever[n, q] * (by_a2 if w.row[q] == 1 else by_a1)


@kernel
def clear(case: ndarray, w: Workspace, channels: int) -> None:
    """Start the sums of a pass over the balls."""
    for p in range(channels):
        load = case.prescribed[w.channel[p]]
        w.imbalance[p] = -load
        w.right[p] = -load
        for q in range(channels):
            w.matrix[p, q] = 0.0


@kernel
def add_force(h: ndarray, cosine: float, sine: float, weight: float, force: ndarray) -> None:
    """Add a ball's force on the ring to the sum in the five channels (19.13-19.15)."""
    force[0] += weight * h[0]
    force[1] += weight * h[1] * cosine
    force[2] += weight * h[1] * sine
    force[3] += weight * h[2] * sine
    force[4] -= weight * h[2] * cosine


@kernel
def channel_scale(case: ndarray, channel: int) -> float:
    """A length that makes a force of the channel's entry: 1 for forces, the pitch radius for moments."""
    return 0.5 * case.pitch_diameter if channel >= 3 else 1.0
