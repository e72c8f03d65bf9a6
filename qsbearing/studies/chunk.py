"""One chunk of a study: its points made, solved and read off; what travels between processes and rests on the disk."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing import quantities
from qsbearing.chooser.choose import completed, solve
from qsbearing.io.file_errors import FileErrorDetail, SceneFileError
from qsbearing.scene.bearing_errors import BALL_COUNT_RANGE
from qsbearing.scene.scene import Scene
from qsbearing.solution import Solution
from qsbearing.status import Reason
from qsbearing.studies.points import Points
from qsbearing.studies.scenes import scene_of_points
from qsbearing.studies.study import Study

IMPOSSIBLE = 3
"""Status of a point that describes no bearing or no operation; the solver's own codes are 0 to 2."""
STATUSES = ("converged", "no_equilibrium", "not_converged", "impossible")

ALL_UP_TO = 300_000
"""Numbers per quantity (points times balls) up to which every result is kept; a few megabytes each."""

MAIN = (
    *("inner_load_max", "outer_load_max", "inner_angle_max", "outer_angle_min"),
    *("inner_max_pressure_max", "outer_max_pressure_max"),
    *(
        "ring_displacement_axial",
        "ring_displacement_radial_y",
        "ring_effective_stiffness_axial",
        "ring_effective_stiffness_radial_y",
    ),
)
"""What is kept of many points, unless quantities are named."""


class Plan(NamedTuple):
    """What every chunk is done by; small, and the same wherever it is done."""

    study: Study
    quantities: tuple[str, ...]
    """Names of the results to keep, all of which the scene calls for."""
    ball_axis: int
    """Length of the ball axis: the largest ball count."""


class Chunk(NamedTuple):
    """The results of one chunk; every array has one value, or one row of balls, per point."""

    status: NDArray
    reason: NDArray
    """Index of `reasons`."""
    reasons: tuple[str, ...]
    """The empty one first: there is an equilibrium, or none is known."""
    iterations: NDArray
    residual: NDArray
    results: dict[str, NDArray]


def solve_chunk(plan: Plan, number: int, threads: int = 1) -> Chunk:
    """Make, solve and read off the points of one chunk."""
    points = Points(plan.study)
    return solve_points(plan, points.values(points.chunk(number)), threads)


def solve_points(plan: Plan, values: dict[str, NDArray], threads: int = 1) -> Chunk:
    """Likewise of points given by the values of their keys."""
    count = max((array.size for array in values.values() if array.ndim), default=1)
    scene, possible, impossible, why = scene_of_points(plan.study, values, count)
    chunk = empty_chunk(plan, count, ("", *map(str, Reason), *why))
    chunk.reason[:] = np.where(possible, 0, impossible + len(Reason))
    if scene is not None:
        put(plan, chunk, np.flatnonzero(possible), solve(scene, threads=threads))
    return chunk


def empty_chunk(plan: Plan, count: int, reasons: tuple[str, ...]) -> Chunk:
    """So many points, all impossible so far."""
    results = {}
    for name in plan.quantities:
        quantity = quantities.find(name)
        assert quantity is not None
        results[name] = np.full((count, plan.ball_axis) if quantity.is_per_ball else count, np.nan)
    status = np.full(count, IMPOSSIBLE, np.int8)
    residual = np.full(count, np.nan)
    return Chunk(status, np.zeros(count, np.int16), reasons, np.zeros(count, np.int32), residual, results)


def put(plan: Plan, chunk: Chunk, numbers: NDArray, solution: Solution) -> None:
    """Put the cases of a solution to these points of a chunk."""
    chunk.status[numbers] = _codes(solution.status, STATUSES)
    chunk.reason[numbers] = _codes(solution.reason, chunk.reasons)
    chunk.iterations[numbers] = np.ravel(solution.iterations)
    chunk.residual[numbers] = np.ravel(solution.residual)
    for name, out in chunk.results.items():
        quantity = quantities.find(name)
        assert quantity is not None
        read = quantity.read(solution)
        if read is None:  # of an effect that this chunk does not need, where effects are chosen
            continue
        found = np.asarray(read)
        if quantity.is_per_ball:
            found = found.reshape(numbers.size, -1)
            out[numbers, : found.shape[1]] = found
        else:
            out[numbers] = found.reshape(numbers.size)


def _codes(words: Any, known: tuple[str, ...]) -> NDArray:
    """Index of each word."""
    flat = np.atleast_1d(np.asarray(words, str)).ravel()
    out = np.zeros(flat.size, int)
    for number, word in enumerate(known):
        out[flat == word] = number
    return out


def plan_of(study: Study, scene: Scene, points: Points) -> Plan:
    """What to keep of every point, by a look at what one of them gives.

    Raises:
        SceneFileError: a name that no result has, or that this scene does not call for.
    """
    counts = next((each.values for each in study.axes if each.key == "ball_count"), (float(scene.bearing.ball_count),))  # type: ignore[arg-type]
    ball_axis = int(min(max(counts), BALL_COUNT_RANGE[1]))
    solution = solve(scene if scene.tolerance is None else completed(replace(scene, tolerance=None)))
    names = study.quantities
    if names:
        _check_names(study, solution)
    else:
        names = tuple(quantities.ALL) if points.count * ball_axis <= ALL_UP_TO else MAIN
        names = tuple(name for name in names if _is_there(name, solution))
    return Plan(study, names, ball_axis)


def _is_there(name: str, solution: Solution) -> bool:
    quantity = quantities.find(name)
    return quantity is not None and quantity.read(solution) is not None


def _check_names(study: Study, solution: Solution) -> None:
    errors = []
    for name in study.quantities:
        if quantities.find(name) is None:
            problem, cause = "is no result", quantities.suggestion(name)
        elif not _is_there(name, solution):
            problem, cause = "is not called for by this scene", "Name in [effects] the effect that it belongs to"
        else:
            continue
        errors.append(FileErrorDetail("study.quantities", problem, name, cause=cause))
    if errors:
        raise SceneFileError(study.file, errors)
