"""Balls that all move alike: the mean motion that balls under a common motion ask for, by solving until it is the same.

Each solve takes the common orbit and axis as given; from the contact angles that it finds, raceway control asks a
motion for each ball, whose mean is the next one: two unknowns a case, by Broyden's method.

The tangent of a solve has the motion held. As the ring moves, so does the mean M(d, m): with F(d, m) the ring's load at
held displacements,

    dF/dd = F_d + F_m (1 - M_m)^-1 M_d,

of which F_d is the kernel's, and the others are differences of solves with the ring held.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel import results
from qsbearing.model.kernel.admissibility import CONVERGED, NOT_CONVERGED
from qsbearing.model.operation import CHANNELS, Operation
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.flatten import COMMON_MOTION
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solved_cases import SolvedCases, solved_of

AGREED = 1e-10
"""Of the rings' speeds: a motion is common within this."""
MOST_ROUNDS = 30
STEP, SPEED_STEP = 1e-6, 1e-5
"""Of the stiffness's differences: of the ball's diameter, and of the rings' speeds."""

ACTING = slice(None, None, 2)
"""What of a motion acts on the balls: the orbit, and the rotation across the bearing's axis."""

SolveWith = Callable[[Scene, Solution | None, dict[str, NDArray]], Solution]
"""A scene from a start with the common motion given; with none, each ball has its own."""


def solve_common(scene: Scene, start: Solution | None, solve_with: SolveWith) -> Solution:
    """The scene with all balls moving alike."""
    solution = solve_with(scene, start, {})
    if not fastest(solution).any():
        return solution
    motion = _first_motion(solution)
    iterations, seconds = solved_of(solution).results["iterations"].copy(), solution.seconds
    size, step = fastest(solution)[:, None], np.zeros_like(motion[:, :2])
    apart, inverse = step, np.broadcast_to(-np.eye(2), (motion.shape[0], 2, 2)).copy()
    for k in range(MOST_ROUNDS):
        solution = solve_with(scene, solution, _by_name(motion, solution.shape))
        iterations, seconds = iterations + solved_of(solution).results["iterations"], seconds + solution.seconds
        change = np.nan_to_num(mean_motion(solution) - motion)
        differs = (np.abs(change) > AGREED * size).any(axis=-1)
        if not differs.any():
            break
        if k:
            inverse += _update(inverse, step, change[:, ACTING] - apart)
        apart = change[:, ACTING].copy()
        step = -np.einsum("cij,cj->ci", inverse, apart)
        change[:, ACTING] = step
        motion = motion + change
    solution.seconds = seconds
    solution.mark_unsolved(differs & (solution.codes == CONVERGED), NOT_CONVERGED)
    solved = solved_of(solution)
    solved.results["iterations"] = iterations
    solved.following = cache(lambda: following(solution, solve_with))
    return solution


def _update(inverse: NDArray, step: NDArray, change: NDArray) -> NDArray:
    """Broyden's, of the inverse of the derivatives, by (case, 2)."""
    there = np.einsum("cij,cj->ci", inverse, change)
    along = np.einsum("ci,cij->cj", step, inverse)
    size = np.einsum("ci,ci->c", step, there)
    gain = (step - there)[:, :, None] * along[:, None, :]
    return np.where(size[:, None, None] == 0.0, 0.0, gain / np.where(size == 0.0, 1.0, size)[:, None, None])


def fastest(of: Solution) -> NDArray:
    """Of the rings' speeds, (case,)."""
    outer = of.scene.operation.outer_speed
    speeds = np.asarray(of.scene.operation.speed, float), np.asarray(0.0 if outer is None else outer, float)
    return np.broadcast_to(np.maximum(*map(np.abs, speeds)), of.shape).reshape(-1)


def mean_motion(of: Solution) -> NDArray:
    """Mean of what raceway control asks of each ball: (case, `COMMON_MOTION`), in rad/s; NaN where not solved."""
    solved = solved_of(of)
    own = SolvedCases(
        solved.maker.with_own_motion, None, solved.results, solved.positions, solved.controls, solved.threads
    )
    requested = results.ORBITAL_SPEED, results.AXIAL_ROTATION, results.RADIAL_ROTATION
    own.read_all([(results.OF_BALL, what) for what in requested])
    balls = solved.maker.ball_axis
    of_balls = np.stack([own.read(results.OF_BALL, what).reshape(-1, balls) for what in requested], axis=-1)
    is_there = np.isfinite(of.azimuth).reshape(-1, balls, 1)
    return np.asarray(np.where(is_there, of_balls, 0.0).sum(axis=1) / is_there.sum(axis=1))


def _first_motion(of: Solution) -> NDArray:
    """The mean of each ball's own motion; where there is none, as at rest at the free contact angle."""
    bearing, operation = of.scene.operating_bearing, of.scene.operation
    speeds = operation.speed, operation.outer_speed
    inner, outer = (np.asarray(0.0 if each is None else each, float) for each in speeds)
    angle = np.asarray(bearing.free_contact_angle, float)
    g = np.asarray(bearing.ball_diameter, float) / np.asarray(bearing.pitch_diameter, float)
    along = g * np.cos(angle)
    orbit = 0.5 * (inner * (1.0 - along) + outer * (1.0 + along))
    axial = 0.5 * (outer - inner) * (1.0 - along**2) / g * np.cos(angle)
    at_rest = np.stack(np.broadcast_arrays(orbit, axial, axial * np.tan(angle)), axis=-1)
    motion = mean_motion(of)
    return np.where(np.isfinite(motion), motion, np.broadcast_to(at_rest, (*of.shape, 3)).reshape(-1, 3))


def _by_name(motion: NDArray, shape: tuple[int, ...]) -> dict[str, NDArray]:
    return {name: each.reshape(shape)[()] for name, each in zip(COMMON_MOTION, motion.T, strict=True)}


def following(of: Solution, solve_with: SolveWith) -> NDArray:
    """What of the stiffness comes from the common motion that follows the ring, (case, 5, 5), SI."""
    scene, bearing = of.scene, of.scene.operating_bearing
    diameter = np.asarray(bearing.ball_diameter, float)
    tilt = 2.0 * STEP * diameter / np.asarray(bearing.pitch_diameter, float)
    steps = [np.broadcast_to(each, of.shape) for each in (STEP * diameter,) * 3 + (tilt,) * 2]
    steps += [SPEED_STEP * fastest(of).reshape(of.shape)] * 2
    motion = np.stack([np.broadcast_to(solved_of(of).maker.motion[name], of.shape) for name in COMMON_MOTION], axis=-1)
    where = np.zeros((2, 7, *of.shape, 8))
    where[...] = np.concatenate([np.nan_to_num(of.displacement), motion], axis=-1)
    for k, column in enumerate((0, 1, 2, 3, 4, 5, 7)):
        where[0, k, ..., column] += steps[k]
        where[1, k, ..., column] -= steps[k]
    held: dict[str, Any] = {channel.displacement: where[..., i] for i, channel in enumerate(CHANNELS)}
    operation = Operation(**(scene.operation.turning | held))
    still = replace(scene, operation=operation, preload=None, readings={}, thermal=None)
    moved = solve_with(still, None, _by_name(where[..., 5:].reshape(-1, 3), (2, 7, *of.shape)))
    size = 2.0 * np.stack([each.reshape(-1) for each in steps])[..., None]
    load, requested = (
        (each[0] - each[1]) / size
        for each in (moved.load.reshape(2, 7, -1, 5), mean_motion(moved)[:, ACTING].reshape(2, 7, -1, 2))
    )
    load, requested = np.moveaxis(load, 0, -1), np.moveaxis(requested, 0, -1)  # (case, load or motion, by what)
    solved = of.codes == CONVERGED
    out = np.full((solved.size, 5, 5), np.nan)
    turned = np.linalg.solve(np.eye(2) - requested[solved][..., 5:], requested[solved][..., :5])
    out[solved] = load[solved][..., 5:] @ turned
    return out
