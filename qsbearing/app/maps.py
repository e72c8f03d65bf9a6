"""A result over two inputs: which there are to choose from, and its values at points of a grid, as a sweep solves them.

The page asks for a few points at a time: it shows how far it is, and stops by asking no further.

Raises, all of them:
    SceneError: everything that is wrong with the tables or the question.
"""

from __future__ import annotations

from functools import reduce
from operator import getitem
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.app.inputs import FieldOfPage, fields
from qsbearing.app.scenes import named, solution_of
from qsbearing.files.file_errors import SceneFileError, refused
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.solution.result_keys import Place, in_name, printed_unit
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.status import Reason
from qsbearing.studies import keys
from qsbearing.studies.chunk import IMPOSSIBLE, STATUSES, Chunk, plan_of, solve_points
from qsbearing.studies.points import Points
from qsbearing.studies.results import known_results
from qsbearing.studies.scenes import check
from qsbearing.studies.study import Read, Study
from qsbearing.systems.sets.set_solution import SetSolution

Tables = dict[str, Any]
Path = list[str | int]
USUAL, FEWEST, MOST = 21, 3, 41
"""Points along each input."""
AT_ONCE = 2000
"""Points of one question."""
FIRST, FORCE = "effective_stiffness", "N"
"""What a map shows until something else is chosen: of the first point of a shaft, such as its tool, or of the whole;
over the first input and the first that is a force, and acts."""
COUNT = "ball_count"
"""Which varies in whole numbers, and so over no map."""


def choices(document: Tables, label: str) -> dict[str, Any]:
    """The inputs that may vary, by their keys; the results of this case, one number each; and what to begin with."""
    numbers = [field for field in fields(document) if "low" in field and field["path"][-1] != COUNT]
    inputs = [field for field in numbers if not _problem(document, field["path"])]
    solution = solution_of(document, label)
    places = [each for place in known_results(solution).values() if place.is_usual for each in _single(place)]
    return {
        "inputs": [field["key"] for field in inputs],
        "results": [
            {
                "name": place.name,
                "words": place.name.replace("_", " "),
                "unit": printed_unit(place.unit),
                "group": f"row {place.row}" if place.row else place.group.reading.replace("_", " "),
            }
            for place in places
        ],
        "first": {**_axes(document, inputs), "result": _first(solution, [place.name for place in places])},
        "points": {"usual": USUAL, "fewest": FEWEST, "most": MOST},
    }


def _single(place: Place) -> tuple[Place, ...]:
    if place.result.is_azimuth:
        return ()
    return place.overs if place.is_per_ball else (place,)


def _axes(document: Tables, inputs: list[FieldOfPage]) -> dict[str, str]:
    keyed = [field["key"] for field in inputs[1:]]
    acting = [each["key"] for each in inputs[1:] if each["unit"] == FORCE and reduce(getitem, each["path"], document)]
    return {"x": inputs[0]["key"], "y": (*acting, *keyed)[0]} if keyed else {}


def _first(solution: Solution | SetSolution, names: list[str]) -> str:
    points = solution.points if isinstance(solution, SetSolution) else {}
    wanted = [f"{in_name(point)}_{FIRST}_radial_y" for point in points]
    wanted += [name for name in names if FIRST in name]
    return next((name for name in wanted if name in names), names[0] if names else "")


def values(
    document: Tables, label: str, x: Path, y: Path, result: str, xs: list[float], ys: list[float]
) -> dict[str, Any]:
    """A result where two inputs take these values, and of what has none why: a list for each of the ys.

    Args:
        x, y: paths of the inputs in the tables.
        xs, ys: each in ascending order, in the unit of its key.
    """
    problems = [problem for path in (x, y) for problem in _problem(document, path)]
    problems += ["a map needs two different inputs"] if x == y else []
    if problems or not (xs and ys) or len(xs) * len(ys) > AT_ONCE:
        raise refused("map", ". ".join(problems) or f"takes 1 to {AT_ONCE} points")
    tables = input_tables(named(document, label))
    study = Study.of(Read(tables, "map", label), {_name(x): xs, _name(y): ys}, quantities=[result])
    grid = [each.ravel() for each in np.meshgrid(xs, ys)]
    given = {each.key: numbers for each, numbers in zip(study.variables, grid, strict=True)}
    values, why = _solved(study, given, len(xs) * len(ys))
    shape = len(ys), len(xs)
    return {"values": np.reshape(values, shape).tolist(), "why": np.reshape(why, shape).tolist()}


def _solved(study: Study, given: dict[str, NDArray], count: int) -> tuple[NDArray, NDArray]:
    """Point by point its number, None where there is none, and why that is so."""
    try:
        possible = check(study)
    except SceneFileError as error:  # the tables are right, so these points are what is wrong
        (first, *_) = error.errors
        why = f"{STATUSES[IMPOSSIBLE]}: {getattr(first, 'key', '')}: {first.problem}"
        return np.full(count, None), np.full(count, why, object)
    plan = plan_of(study, possible, Points(study))
    chunk = solve_points(plan, given)
    numbers = next(iter(chunk.results.values()), np.full(count, np.nan))
    values = [float(each) if np.isfinite(each) else None for each in numbers]
    return np.array(values, object), np.array([_why(chunk, number) for number in range(count)], object)


def _why(chunk: Chunk, number: int) -> str:
    """Why there is nothing at a point; empty where it is solved."""
    if not chunk.status[number]:
        return ""
    reason = chunk.reasons[chunk.reason[number]]
    said = reason.replace("_", " ") if reason in list(Reason) else reason  # else a key, and what is wrong with it
    return ": ".join(filter(None, (STATUSES[chunk.status[number]].replace("_", " "), said)))


def _name(path: Path) -> str:
    """As a study has it: tables of a list count from 1."""
    return ".".join(str(step + 1) if isinstance(step, int) else str(step) for step in path)


def _problem(document: Tables, path: Path) -> tuple[str, ...]:
    return keys.problem(_name(path), document)
