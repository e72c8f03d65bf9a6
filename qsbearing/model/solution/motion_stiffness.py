"""Stiffness of a bearing whose balls friction moves: of a static load, and about thrust of one that turns or pulsates.

Source        linear response of the balance in `kernel/traction_ball.py`: each ball's equations r(u, u', A) = 0 and its
              force f(u, A) on the ring, derived here
Equation      static: K = -df/dd with all balls following, which are carried round (periodic, with time weights) or not.
              Under thrust, of a displacement that turns at nu, balls meet it at s = omega_m - nu:
                  (r_u + i s r_u'/omega_m) u = -r_A2,    K = -Z/2 (Re fr - Im fy),    whirl = -Z/2 (Im fr + Re fy)
              where the ball is ahead on its way by p = omega_m^/(i s), so that fr gains fy0 p and fy loses fr0 p; of
              one along x at nu, s = nu, K = -Z fx
Limits        nu = 0 is a static load, nu = omega_m one that goes round with the cage
Assumes       small displacements, tilts held; no inertia of X, whose frequency is that of contacts
When not      near nu = omega_m, where a ball's place on its way has no bound; no damping is given, since its sign from
              balls that lag alone is not understood
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.kernel.traction_balance import read_blocks, set_derivative
from qsbearing.model.kernel.traction_ball import GROOVE, MOVED_BALL, ORBIT
from qsbearing.model.kernel.traction_ring import MOTION
from qsbearing.model.solution.friction_balance import FrictionMotion

NEAREST = 0.1
"""Of |nu - omega_m| over the orbit: nearer, nothing is given."""


class Blocks(NamedTuple):
    """Of one case, in its units; each (ball, ...)."""

    by_unknown: NDArray
    by_rate: NDArray
    by_ring: NDArray
    force_by_unknown: NDArray
    force_by_ring: NDArray
    force: NDArray
    """On the ring: axial, radial, along y."""


class TurningStiffness(NamedTuple):
    """Of a bearing under thrust, (*cases, frequency) [N/m]."""

    radial: NDArray
    """Against a displacement that turns."""
    whirl: NDArray
    """The force across it on the ring, towards its turning."""
    axial: NDArray
    """Against one along x that pulsates."""


def motion_stiffness(motion: FrictionMotion) -> NDArray:
    """K of x, y and z (*cases, 3, 3) [N/m], with tilts held; no number where a case has no equilibrium.

    Of all three, whatever is held; under thrust every ball is taken for itself, and carried round if the scene was
    solved so.
    """
    cases = motion.inside.cases
    stiffness = [
        _static(motion, k, blocks) * (cases["force"][k] / cases["length"][k])
        for k, blocks in enumerate(_blocks(motion))
    ]
    return np.reshape(stiffness, (*motion.status.shape, 3, 3))


def turning_stiffness(motion: FrictionMotion, frequency: ArrayLike) -> TurningStiffness:
    """Stiffness of a bearing under thrust against displacements that turn with the shaft or pulsate.

    Args:
        motion: under thrust.
        frequency: nu, angular, of one axis [rad/s]; positive as the shaft turns about +x.

    Raises:
        ValueError: radial displacement, which makes balls unlike.
    """
    if np.any(np.nan_to_num(motion.displacement[..., 1:3]) != 0.0):
        raise ValueError("turning_stiffness knows thrust alone: balls under radial load are unlike")
    inside = motion.inside
    nu = np.atleast_1d(np.asarray(frequency, float))
    values = np.full((3, inside.cases.size, nu.size), np.nan)
    for k, blocks in enumerate(_blocks(motion)):
        case = inside.cases[k]
        orbit = inside.places[k, 0, ORBIT]
        for n, each in enumerate(nu / case["speed"]):
            if abs(each - orbit) > NEAREST * abs(orbit):
                values[:2, k, n] = _turning(blocks, orbit, orbit - each)
            values[2, k, n] = -_response(blocks, orbit, each, 0)[0].real
        values[:, k] *= case["ball_count"] * case["force"] / case["length"]
    return TurningStiffness(*values.reshape(3, *motion.status.shape, nu.size))


def motion_rates(motion: FrictionMotion) -> NDArray:
    """How fast each ball's motion returns to balance: eigenvalues (*cases, ball, 4) of (wx, wy, wz, omega_m) [1/s],
    the slowest first; complex, negative where stable.

    Its place and the ring held where they are found: r_u u + r_u' u'/omega_m = 0, the place following at once. A ball
    whose slowest rate is far below its orbit's does not follow what its azimuth asks for.
    """
    rates = np.full((*motion.inside.places.shape[:2], 4), np.nan, complex)
    for k, blocks in enumerate(_blocks(motion)):
        for j in range(len(blocks.force)):
            a, c = blocks.by_unknown[j], blocks.by_rate[j] / motion.inside.places[k, j, ORBIT]
            if np.isfinite(a).all():
                condensed = a[2:, 2:] - a[2:, :2] @ np.linalg.solve(a[:2, :2], a[:2, 2:])
                values = np.linalg.eigvals(-np.linalg.solve(c[2:, 2:], condensed))
                rates[k, j] = values[np.argsort(np.abs(values))] * motion.inside.cases["speed"][k]
    return rates.reshape(*motion.status.shape, *rates.shape[1:])


def _response(blocks: Blocks, orbit: float, s: float, along: int) -> NDArray:
    """(axial, radial, along y, orbit) of the first ball to a displacement of the groove centre at this frequency."""
    matrix = blocks.by_unknown[0] + 1j * (s / orbit) * blocks.by_rate[0]
    unknown = -np.linalg.solve(matrix, blocks.by_ring[0, :, along])
    force = blocks.force_by_unknown[0] @ unknown + blocks.force_by_ring[0, :, along]
    return np.append(force, unknown[ORBIT])


def _turning(blocks: Blocks, orbit: float, s: float) -> tuple[float, float]:
    """(K, whirl) of one ball."""
    _, radial, across, orbit_change = _response(blocks, orbit, s, 1)
    ahead = orbit_change / (1j * s)
    radial, across = radial + blocks.force[0, 2] * ahead, across - blocks.force[0, 1] * ahead
    return -0.5 * (radial.real - across.imag), -0.5 * (radial.imag + across.real)


def _static(motion: FrictionMotion, k: int, blocks: Blocks) -> NDArray:
    """K of a case, in its units."""
    count = len(blocks.force)
    if not np.isfinite(blocks.force).all():
        return np.full((3, 3), np.nan)
    case = motion.inside.cases[k]
    psi = case["first_azimuth"] + 2.0 * np.pi * np.arange(count) / count
    zero, one, c, s = np.zeros(count), np.ones(count), np.cos(psi), np.sin(psi)
    levers = np.array([[one, zero, zero], [zero, c, s]]).transpose(2, 0, 1)  # (ball, A, channel)
    turns = np.array([[one, zero, zero], [zero, c, s], [zero, s, -c]]).transpose(2, 0, 1)  # (ball, channel, force)
    weight = motion.inside.places[k, :count, 6]
    turns = turns * weight[:, None, None]
    if motion.inside.shims.size and case["inner_speed"] == case["outer_speed"]:
        return _at_rest(blocks, turns, levers)
    by_unknown = np.zeros((count, 6, count, 6))
    each = np.arange(count)
    by_unknown[each, :, each] = blocks.by_unknown
    force_by_unknown = turns @ blocks.force_by_unknown
    if motion.inside.is_carried and case["inner_speed"] != case["outer_speed"]:
        derivative = np.zeros(count)
        set_derivative(derivative, count)
        by_unknown += derivative[(each[:, None] - each) % count][:, None, :, None] * blocks.by_rate[:, :, None]
        orbit = motion.inside.places[k, :count, ORBIT]
        forces = np.einsum("jcf,jf->jc", turns, blocks.force)
        mean_time = (1.0 / orbit).mean()
        shares = forces.sum(axis=0) / (orbit[:, None] * mean_time * count) - forces
        force_by_unknown[:, :, ORBIT] += shares / orbit[:, None]
    by_ring = (blocks.by_ring @ levers).reshape(6 * count, 3)
    follow = -np.linalg.solve(by_unknown.reshape(6 * count, -1), by_ring).reshape(count, 6, 3)
    return -(force_by_unknown @ follow + turns @ blocks.force_by_ring @ levers).sum(axis=0)


def _at_rest(blocks: Blocks, turns: NDArray, levers: NDArray) -> NDArray:
    """K where friction has nothing to do: by the balls' places alone, of which a ball that nothing touches has none."""
    total = np.zeros((3, 3))
    for own, by_ring, force, of_ring, turn, lever in zip(
        blocks.by_unknown, blocks.by_ring, blocks.force_by_unknown, blocks.force_by_ring, turns, levers, strict=True
    ):
        follow = -np.linalg.pinv(own[:2, :2]) @ by_ring[:2]
        total -= turn @ (force[:, :2] @ follow + of_ring) @ lever
    return total


def _blocks(motion: FrictionMotion) -> list[Blocks]:
    """Of each case."""
    inside = motion.inside
    cases, places = inside.cases, inside.places
    count, balls = places.shape[:2]
    of_balls, of_ring = np.full((count, balls, 6, 14), np.nan), np.full((count, balls, 4, 9), np.nan)
    memory = np.zeros(4 if inside.shims.size else 2, GROOVE), np.zeros(1, MOTION), np.zeros(balls, MOVED_BALL)
    solved = np.flatnonzero(inside.results["status"] == CONVERGED)
    parts = of_balls[solved], of_ring[solved]
    displacements = np.ascontiguousarray(inside.results["displacement"][solved])
    arrays = inside.points, np.empty(balls)
    where = displacements, places[solved]
    shims = np.ascontiguousarray(inside.shims[solved])
    read_blocks(cases[solved], inside.laws[solved], *memory, arrays, inside.is_carried, shims, *where, *parts)
    of_balls[solved], of_ring[solved] = parts
    made = []
    for k in range(count):
        a, f = of_balls[k, : cases["ball_count"][k]], of_ring[k, : cases["ball_count"][k], :3]
        made.append(Blocks(a[..., :6], a[..., 6:12], a[..., 12:], f[..., :6], f[..., 6:8], f[..., 8]))
    return made
