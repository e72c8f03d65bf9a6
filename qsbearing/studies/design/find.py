"""`find`: the scene's numbers that meet goals and limits, with the least or most of a result."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.numbers import plain
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.result_names import AZIMUTH, find_all, why_unknown
from qsbearing.files.result_names import find as find_result
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.compiler.threads import thread_count
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.limit import MET, ending
from qsbearing.model.solution.result_keys import MAX, MIN, SIZE, Place
from qsbearing.studies import keys
from qsbearing.studies.chunk import Plan, plan_of, solve_points
from qsbearing.studies.design.optimum import Best, NoResultError, search, violations
from qsbearing.studies.design.problem import Condition, SearchProblem, problem_of
from qsbearing.studies.points import CHUNK, Points
from qsbearing.studies.scenes import base_scene, check, scenes_of_points
from qsbearing.studies.study import Read, Study
from qsbearing.studies.study import read as read_source
from qsbearing.studies.variables import Axis
from qsbearing.systems.sets.bearing_set import BearingSet

LOOK = {1: 101, 2: 21, 3: 9, 4: 6, 5: 5, 6: 4}
"""Values of each of so many variables among which a possible point is looked for."""
SOME = 3
"""Values of each variable at which the results are listed, and effects chosen where the scene leaves them."""
ALL_POINTS = 4096
"""Of the sample over one variable; doubled with each further one, seconds of work at most."""
FLAT = 0.01
"""The optimum's range: where the objective stays within this part of its value."""


@dataclass(frozen=True)
class Found:
    """The result of a search; numbers in the units of files."""

    problem: SearchProblem
    is_feasible: bool
    """Whether every goal and limit is met."""
    values: dict[str, float]
    """Of the variables: the optimum, or the point of least violation."""
    results: dict[str, float]
    """There, of every goal, limit and objective."""
    places: tuple[Place, ...]
    """Of the results."""
    units: dict[str, str]
    """Of variables and results."""
    binding: tuple[str, ...]
    """Limits that are just met, and variables at an end of their range."""
    failed: tuple[str, ...]
    """Goals and limits that are not met."""
    ranges: dict[str, tuple[float, float]]
    """How sharp the optimum is: how far each variable may move, the others held, while every limit holds and the
    objective (without one: each goal) stays within 1 %. Empty where no point is feasible."""
    feasible_share: float
    """Of the sample over the whole box, goals within 1 %."""
    sampled: int
    """Points of the sample."""
    evaluations: int
    """All points that were solved: those of the sample and those near the best of them."""
    seconds: float
    scene: Scene | BearingSet
    """With the values found."""
    evaluate: Callable[[dict[str, NDArray]], dict[str, NDArray]]
    """Values of the variables to the results, for pictures: arrays of one length, NaN where there is no solution."""


def find(
    source: str | os.PathLike[str] | dict[str, Any] | Scene | BearingSet,
    vary: Mapping[str, Any],
    *,
    goals: Iterable[str] = (),
    limits: Iterable[str] = (),
    minimise: str | None = None,
    maximise: str | None = None,
    points: int | None = None,
    seed: int = 0,
    progress: Callable[[int, int], object] | None = None,
) -> Found:
    """Find values of a scene's keys that meet goals and limits.

    A sample over all ranges finds the regions of good points, and SLSQP of scipy refines the best of them. Of a result
    of each ball the worst ball counts: for `<=`, a goal and `minimise` the maximum, for `>=` and `maximise` the
    minimum; limits of a result whose sign is a direction are those of its size, but for negative ones. A name that
    leaves out row or raceway holds for each. What the scene's [require] says counts as limits. Without a result to
    minimise or maximise, the point with the largest margin to its limits is found.

    Args:
        source: a scene or set: its file, catalogue name, tables, or the object.
        vary: up to six keys of the scene file, each with "LOW:HIGH", "LOW:HIGH:log", (LOW, HIGH), or the values to
            choose from as "A,B,C" or a list; `ball_count` takes whole numbers.
        goals: "NAME=VALUE", such as "effective_stiffness_radial_y=200", in the unit of the result.
        limits: "NAME<=VALUE" or "NAME>=VALUE", such as "inner.max_pressure_MPa<=1700".
        minimise, maximise: a result's name.
        points: of the sample; 4,096 for one variable, doubled with each further one. Some thousand more are then
            solved near the best ones.
        seed: of the sample.
        progress: called with the points done and all that are expected.

    Returns:
        Found: the optimum; where no point is feasible the one whose largest violation, as a part of the condition's
        value, is least.

    Raises:
        SceneError: everything that is wrong with what is asked for, at once.

    Examples:
        >>> found = qs.find(
        ...     "b218", {"axial_load_N": (1e3, 40e3)}, limits=["outer.max_pressure_MPa<=1500"],
        ...     maximise="ring_load_axial_N", points=64,
        ... )
        >>> print(found.is_feasible)
        True
    """
    return searched(prepared(source, vary, goals, limits, minimise, maximise), points, seed, progress)


class Prepared(NamedTuple):
    """A search that can begin: nothing is wrong with what is asked for."""

    problem: SearchProblem
    study: Study
    plan: Plan
    kept: tuple[Place, ...]
    """A result for each name of `problem`."""
    began: float


def prepared(
    source: str | os.PathLike[str] | dict[str, Any] | Read | Scene | BearingSet,
    vary: Mapping[str, Any],
    goals: Iterable[str] = (),
    limits: Iterable[str] = (),
    minimise: str | None = None,
    maximise: str | None = None,
) -> Prepared:
    """What is asked of `find`, checked, before anything is searched; arguments and errors are its own."""
    began = time.perf_counter()
    if isinstance(source, Scene | BearingSet):
        source = input_tables(source)
    read = read_source(source)
    problem = problem_of(vary, goals, limits, minimise, maximise, "find", read.document)
    study = _study(read, problem)
    count = len(problem.variables)
    _check(study.replaced(variables=_axes(problem, LOOK[count])), problem)
    looked_at = base_scene(study.replaced(variables=_axes(problem, LOOK[count])))
    plan = plan_of(study, looked_at, Points(study), every=True)
    return Prepared(*_named(problem, plan, study), began)


def searched(
    of: Prepared, points: int | None = None, seed: int = 0, progress: Callable[[int, int], object] | None = None
) -> Found:
    """The search itself.

    Raises:
        SceneError: no point of the sample has all results.
    """
    problem, study, plan, kept, began = of
    evaluate = partial(_evaluated, plan, kept, tuple(each.key for each in problem.variables))
    size = points or ALL_POINTS << (len(problem.variables) - 1)
    try:
        best = search(problem, evaluate, size, seed, progress)
    except NoResultError as error:
        raise SceneFileError(study.file, _without_result(problem, error.missing)) from None
    values = dict(zip((each.key for each in problem.variables), map(float, best.values), strict=True))
    there = tuple(Axis(key, (value,)) for key, value in values.items())
    scene = base_scene(study.replaced(variables=there))
    assert scene is not None  # it was solved
    units = {each.key: keys.known(each.key).unit for each in problem.variables}
    units |= {name: result.unit for name, result in zip(problem.names, kept, strict=True)}
    results = dict(zip(problem.names, map(float, best.results), strict=True))
    ranges = _ranges(problem, evaluate, best) if best.is_feasible else {}

    def for_pictures(given: dict[str, NDArray]) -> dict[str, NDArray]:
        columns = np.broadcast_arrays(*(given[each.key] for each in problem.variables))
        at_points = evaluate(np.stack([column.ravel() for column in columns], axis=1))
        return {name: at_points[:, i].reshape(columns[0].shape) for i, name in enumerate(problem.names)}

    return Found(
        problem, best.is_feasible, values, results, kept, units, _binding(problem, best), _failed(problem, best),
        ranges,         best.feasible_share, size, best.evaluations, time.perf_counter() - began, scene, for_pictures,
    )  # fmt: skip


def _axes(problem: SearchProblem, count: int) -> tuple[Axis, ...]:
    return tuple(Axis(each.key, each.some(count)) for each in problem.variables)


def _study(source: Read, problem: SearchProblem) -> Study:
    """A study over some values of each variable, which asks for the readings that are named."""
    vary = {axis.key: list(axis.values) for axis in _axes(problem, SOME)}
    study = Study.of(source, vary, quantities=problem.names)
    if any(each.key not in vary for each in study.variables):
        error = FileErrorDetail("[vary]", "varies further keys", cause="A search takes its variables from vary alone")
        raise SceneFileError(study.file, [error])
    return study.replaced(quantities=())


def _check(study: Study, problem: SearchProblem) -> None:
    if check(study) is not None:
        return
    first = {axis.key: np.asarray(axis.values) for axis in _axes(problem, 2)[:1]}
    first |= {axis.key: np.asarray(axis.values[0]) for axis in _axes(problem, 2)[1:]}
    reasons = scenes_of_points(study, first, 2).reasons
    why = f"no point describes a bearing: {reasons[0] if reasons else ''}"
    raise SceneFileError(study.file, [FileErrorDetail("vary", why, cause="Move or widen the ranges")])


def _without_result(problem: SearchProblem, missing: NDArray) -> list[FileErrorDetail]:
    if missing.all() or not missing.any():
        cause = (
            "Move or narrow the ranges: `qsbearing sweep` over them says why points have no solution. A stiffness "
            "along a channel that is held has no value"
        )
        return [FileErrorDetail("vary", "no point of the sample has a solution with all results", cause=cause)]
    cause = "Such as a stiffness along a channel that is held: name the channel's load, or another result"
    names = dict.fromkeys(name for name, lacks in zip(problem.names, missing, strict=True) if lacks)
    return [FileErrorDetail(name, "has no value at any point of the ranges", cause=cause) for name in names]


def _named(problem: SearchProblem, plan: Plan, study: Study) -> tuple[SearchProblem, Study, Plan, tuple[Place, ...]]:
    """The conditions by the results' full names, those of all balls with an ending of `OVER`, those of several rows or
    raceways one by one; a plan that keeps these alone.

    Raises:
        SceneFileError: names that no result has, or that cannot be limited.
    """
    known = {result.name: result for result in plan.results}
    errors: list[FileErrorDetail] = []
    conditions: list[Condition] = []
    kept: list[Place] = []
    left: tuple[str, ...] = ()
    negative = {each.name for each in (*problem.conditions, *problem.required) if each.value < 0.0}
    for each in (*problem.conditions, *problem.required):
        places = _places(each, each.name in negative, known)
        if not places and each in problem.required:
            left += (str(each),)
            continue
        errors += _limit_errors(each, places, known)
        conditions += [each._replace(name=place.name) for place in places]
        kept += places
    if problem.objective and (objective := find_result(problem.objective, known)) is not None:
        end = MIN if problem.is_maximised else SIZE if objective.result.is_signed else MAX
        kept.append(objective._replace(over=end) if objective.is_per_ball else objective)
    elif problem.objective:
        why, cause = why_unknown(problem.objective, known)
        errors.append(FileErrorDetail(problem.objective, why, cause=cause))
    if errors:
        raise SceneFileError(plan.study.file, errors)
    named = replace(
        problem, conditions=tuple(conditions), objective=kept[-1].name if problem.objective else "", open=left
    )
    if not named.names:
        raise SceneFileError(plan.study.file, [FileErrorDetail("[require]", "nothing in it can be searched for")])
    return named, study, plan._replace(results=tuple(dict.fromkeys(kept))), tuple(kept)


def _places(of: Condition, is_algebraic: bool, known: Mapping[str, Place]) -> list[Place]:
    """The results that a goal or limit looks at: a goal at all balls as an upper limit does, at others as they are."""
    places = find_all(of.name, known)
    if of.sense != "=":
        return [ending(place, of.sense, is_algebraic) for place in places]
    return [ending(place, "<=") if place.is_per_ball else place for place in places]


def _limit_errors(of: Condition, places: list[Place], known: Mapping[str, Place]) -> list[FileErrorDetail]:
    if not places:
        why, cause = why_unknown(of.name, known)
        return [FileErrorDetail(of.name, why, cause=cause)]
    if of.sense != "=" and any(place.result.is_azimuth for place in places):
        return [FileErrorDetail(of.name, AZIMUTH, cause="Limit a load or an angle there")]
    return []


def _evaluated(plan: Plan, kept: tuple[Place, ...], names: tuple[str, ...], values: NDArray) -> NDArray:
    """Results of many points, shape (point, result); NaN where there is no solution."""

    def part(start: int, threads: int) -> NDArray:
        some = values[start : start + CHUNK]
        chunk = solve_points(plan, {name: some[:, i] for i, name in enumerate(names)}, threads)
        results = np.stack([chunk.results[each.name] for each in kept], axis=1)
        results[chunk.status != 0] = np.nan
        return results

    starts = range(0, len(values), CHUNK)
    workers = min(thread_count(), len(starts))
    if workers <= 1:
        return np.concatenate([part(start, thread_count()) for start in starts])
    with ThreadPoolExecutor(workers) as pool:
        return np.concatenate(list(pool.map(lambda start: part(start, 1), starts)))


BINDS = 1e-4
"""A limit that is met with less than this part of its value to spare binds."""


def _binding(problem: SearchProblem, best: Best) -> tuple[str, ...]:
    binding = []
    for each, off in zip(problem.conditions, best.violation, strict=True):
        if each.sense != "=" and abs(off) <= BINDS:
            binding.append(str(each))
    for variable, u in zip(problem.variables, best.unit, strict=True):
        values = variable.values or (variable.low, variable.high)
        at = float(variable.at(np.asarray(u)))
        if u <= BINDS or u >= 1.0 - BINDS or (variable.values and at in (values[0], values[-1])):
            end = "lower" if at - values[0] < values[-1] - at else "upper"
            binding.append(f"{variable.key} at its {end} end, {at:g}")
    return tuple(binding)


def _failed(problem: SearchProblem, best: Best) -> tuple[str, ...]:
    return tuple(
        f"{each}: found {value:.6g}, off by {plain(100.0 * off, '.3g')} %"
        for each, value, off in zip(problem.conditions, best.results, best.violation, strict=False)
        if off > MET
    )


def _ranges(
    problem: SearchProblem, evaluate: Callable[[NDArray], NDArray], best: Best
) -> dict[str, tuple[float, float]]:
    offsets = np.concatenate([-np.geomspace(1.0, 1e-5, 60), [0.0], np.geomspace(1e-5, 1.0, 60)])
    ranges = {}
    for i, variable in enumerate(problem.variables):
        places = np.unique(np.clip(best.unit[i] + offsets, 0.0, 1.0))
        values = np.asarray(variable.values) if variable.values else variable.at(places)
        points = np.repeat(best.values[None], values.size, axis=0)
        points[:, i] = values
        ranges[variable.key] = _range(problem, evaluate(points), values, best, i)
    return ranges


def _range(problem: SearchProblem, results: NDArray, values: NDArray, best: Best, i: int) -> tuple[float, float]:
    """Ends of the stretch around the optimum where what is asked for holds; between points by a straight line."""
    over = []
    for k, each in enumerate(problem.conditions):
        off = violations(problem, results, best.scale)[:, k]
        if each.sense == "=":
            over += [] if problem.objective else [off - FLAT]
        else:
            over.append(off - MET)
    if problem.objective:
        here = best.results[-1]
        over.append(np.abs(results[:, -1] - here) / (abs(here) or 1.0) - FLAT)
    above = np.max(over, axis=0) if over else np.zeros(values.size)
    above = np.where(np.isfinite(results).all(axis=1), above, np.inf)
    middle = int(np.argmin(np.abs(values - best.values[i])))
    ends = []
    for step in (-1, 1):
        at = middle
        while 0 <= at + step < values.size and above[at + step] <= 0.0:
            at += step
        end = float(values[at])
        beyond = at + step
        if 0 <= beyond < values.size and not problem.variables[i].values and np.isfinite(above[beyond]):
            inside = min(float(above[at]), 0.0)
            end += float(values[beyond] - values[at]) * -inside / (float(above[beyond]) - inside)
        ends.append(end)
    return ends[0], ends[1]
