"""One chunk of a study: its points made, solved and read off; what travels between processes and rests on the disk."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.model.bearing_errors import BALL_COUNT_RANGE
from qsbearing.model.scene.scene import CHOICES, Scene
from qsbearing.model.solution.result_keys import Place
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.solution.status import Reason
from qsbearing.results.readings_record import all_taken
from qsbearing.studies.chooser.choose_set import solve_set
from qsbearing.studies.points import Points
from qsbearing.studies.remarked import Look, look, looked_at, may_solve, together
from qsbearing.studies.results import find, known_results, read, why_unknown
from qsbearing.studies.scenes import scenes_of_points
from qsbearing.studies.study import Study
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

IMPOSSIBLE = 3
"""Status of a point that describes no bearing or no operation; the solver's own codes are 0 to 2."""
STATUSES = ("converged", "no_equilibrium", "not_converged", "impossible")

LOOKED_AT = 200
"""Points at which effects are chosen, where the scene leaves that to its tolerance (chosen: some hundredths of a
second, and the corners of most studies among them)."""
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
    results: tuple[Place, ...]
    """What to keep, all of which the scene calls for."""
    ball_axis: int
    """Length of the ball axis: the largest ball count."""
    chosen: dict[str, Any] | None = None
    """Fields of the scene that `effects = "auto"` has chosen, once for all points; None where the scene names them."""


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
    remarks: Look


def solve_chunk(plan: Plan, number: int, threads: int = 1) -> Chunk:
    """Make, solve and read off the points of one chunk."""
    points = Points(plan.study)
    return solve_points(plan, points.values(points.chunk(number)), threads, may_solve(points.count))


def solve_points(plan: Plan, values: dict[str, NDArray], threads: int = 1, solves: bool | None = None) -> Chunk:
    """Solve points that the values of their keys give.

    Args:
        solves: whether remarks may solve points again; None: no remarks.
    """
    count = max((array.size for array in values.values() if array.ndim), default=1)
    looked = None if solves is None else looked_at(count)
    parts, possible, impossible, why = scenes_of_points(plan.study, values, count, looked)
    chunk = empty_chunk(plan, count, ("", *map(str, Reason), *why))
    chunk.reason[:] = np.where(possible, 0, impossible + len(Reason))
    looks = []
    for scene, numbers, is_looked_at in parts:
        solution = _solved(scene, plan.chosen, threads)
        readings = None if solves is None or not is_looked_at else _taken(plan, solution)
        put(plan, chunk, numbers, solution, readings)
        if readings is not None:
            looks.append(look(solution, readings, values, numbers, bool(solves)))
    return chunk._replace(remarks=together(looks))


def _taken(plan: Plan, solution: Solution | SetSolution) -> Any:
    """The readings, if something of them is kept."""
    if isinstance(solution, Solution) and not any(each.group.reading for each in plan.results):
        return {}
    return all_taken(solution)


def _solved(
    scene: Scene | BearingSet, chosen: dict[str, Any] | None, threads: int | None = None
) -> Solution | SetSolution:
    if isinstance(scene, BearingSet):
        return solve_set(replace(scene, **chosen or {}), threads=threads)
    if scene.thermal is not None:
        from qsbearing.systems.heat import solve as hot

        return hot.solve(scene, threads=threads)
    return solve(replace(scene, **chosen or {}), threads=threads)


def empty_chunk(plan: Plan, count: int, reasons: tuple[str, ...]) -> Chunk:
    """So many points, all impossible so far."""
    results = {
        result.name: np.full((count, plan.ball_axis) if result.is_per_ball else count, np.nan)
        for result in plan.results
    }
    status = np.full(count, IMPOSSIBLE, np.int8)
    residual = np.full(count, np.nan)
    return Chunk(status, np.zeros(count, np.int16), reasons, np.zeros(count, np.int32), residual, results, together(()))


def put(plan: Plan, chunk: Chunk, numbers: NDArray, solution: Solution | SetSolution, readings: Any) -> None:
    """Put the cases of a solution to these points of a chunk.

    Args:
        readings: where they are taken already; of a set those of each row.
    """
    chunk.status[numbers] = _codes(solution.status, STATUSES)
    chunk.reason[numbers] = _codes(solution.reason, chunk.reasons)
    chunk.iterations[numbers] = np.ravel(solution.iterations)
    chunk.residual[numbers] = np.ravel(solution.residual)
    for name, values in read(solution, plan.results, readings).items():
        out = chunk.results[name]
        if out.ndim == 1:
            out[numbers] = np.reshape(values, numbers.size)
        else:
            out[numbers, : values.shape[-1]] = np.reshape(values, (numbers.size, -1))


def _codes(words: Any, known: tuple[str, ...]) -> NDArray:
    """Index of each word."""
    flat = np.atleast_1d(np.asarray(words, str)).ravel()
    out = np.zeros(flat.size, int)
    for number, word in enumerate(known):
        out[flat == word] = number
    return out


def plan_of(study: Study, scene: Scene | BearingSet | None, points: Points, every: bool = False) -> Plan:
    """What to keep of every point, by a look at what one of them gives; of points none of which is possible, nothing.

    Args:
        every: all there is, for a choice among it, not only what a study keeps unasked.

    Raises:
        SceneFileError: a name that no result has, or that this scene does not call for.
    """
    if scene is None:
        return Plan(study, (), 1)
    own = [row.bearing for row in scene.rows] if isinstance(scene, BearingSet) else [scene.bearing]
    of_scene = tuple(float(np.max(bearing.ball_count)) for bearing in own)
    counts = next((each.values for each in study.axes if each.key == "ball_count"), of_scene)
    ball_axis = int(min(max(counts), BALL_COUNT_RANGE[1]))
    chosen = None if scene.tolerance is None else _chosen_effects(study, points, scene)
    known = known_results(_solved(scene, chosen))
    kept: list[Place | FileErrorDetail | None]
    if study.quantities:
        kept = [_requested(name, known) for name in study.quantities]
        errors = [each for each in kept if isinstance(each, FileErrorDetail)]
        if errors:
            raise SceneFileError(study.file, errors)
    elif every or points.count * ball_axis <= ALL_UP_TO or isinstance(scene, BearingSet):
        kept = [each for each in known.values() if every or each.is_usual]
    else:
        kept = [find(name, known) for name in MAIN]
    return Plan(study, tuple(each for each in kept if isinstance(each, Place)), ball_axis, chosen)


def _requested(name: str, known: dict[str, Place]) -> Place | FileErrorDetail:
    result = find(name, known)
    if result is not None:
        return result
    problem, cause = why_unknown(name, known)
    return FileErrorDetail("study.quantities", problem, name, cause=cause)


def _chosen_effects(study: Study, points: Points, possible: Scene | BearingSet) -> dict[str, Any]:
    """The effects and choices that the tolerance needs at any of some hundred points spread over the study; where none
    of these is possible, at one that is."""
    from qsbearing.studies.chooser.choose import solve as choose

    numbers = np.unique(np.linspace(0, points.chunk_count - 1, LOOKED_AT).round().astype(int))
    parts = []
    for number in numbers:
        values = points.values(points.chunk(int(number)))
        count = max((array.size for array in values.values() if array.ndim), default=1)
        some = np.unique(np.linspace(0, count - 1, max(2, LOOKED_AT // numbers.size)).round().astype(int))
        parts.append({key: np.broadcast_to(array, count)[some] for key, array in values.items()})
    together = {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}
    made = scenes_of_points(study, together, next(iter(together.values())).size).parts
    scene = made[0].scene if made else possible
    chosen = solve_set(scene).set if isinstance(scene, BearingSet) else choose(scene).scene
    return {name: getattr(chosen, name) for name in (*CHOICES, "ball_effects", "ring_effects", "tolerance")}
