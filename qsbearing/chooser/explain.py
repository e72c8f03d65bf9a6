"""Why a scene needs each effect and choice or does not: indicator, predicted error, cost in time, verdict."""

from __future__ import annotations

import statistics
from dataclasses import dataclass
from typing import Any

import numpy as np

from qsbearing.chooser.comparison import by_quantity
from qsbearing.effects import EFFECTS, Entry
from qsbearing.judgement import Judgement, judge, lines_to_add
from qsbearing.scene.scene import Scene
from qsbearing.solution import Solution
from qsbearing.solver import solve

NEEDED, NOT_NEEDED, NOT_ASSESSED = "needed", "not needed", "not assessed"
DATA_MISSING = "likely needed, data missing"

LIGHT_BALL = (
    "some ball carries little or nothing, where small causes have large effects: --verify solves with and without"
)

REPEATS = 9
"""Solves of which the median is the time."""


@dataclass(frozen=True)
class Row:
    """What there is to say about one effect or choice at one case; null for what there is not."""

    effect: str
    what: str
    in_scene: bool
    indicator: float | None
    predicted: dict[str, float | None] | None
    """Relative change of the reported results if it is left out, or was."""
    actual: dict[str, float | None] | None
    """The same, found by solving with and without it."""
    time_with_over_without: float | None
    verdict: str
    why: str
    add: list[str]
    """Lines for a scene file that lacks it, under [effects]."""


def explain(scene: Scene, tolerance: float, verify: bool = False) -> tuple[Solution, list[Row]]:
    """The scene's solution, and a row for every effect and choice, named by the scene or not.

    Args:
        scene: a single case, with its effects as it names them.
        tolerance: the relative error below which an effect is not needed.
        verify: whether to solve with and without each.

    Raises:
        ValueError: the scene has array fields.
    """
    solution = solve(scene)
    if solution.shape:
        raise ValueError(f"the scene has cases {solution.shape}: effects are explained for one case at a time")
    return solution, [_row(entry, solution, tolerance, verify) for entry in EFFECTS]


def _row(entry: Entry, solution: Solution, tolerance: float, verify: bool) -> Row:
    scene = solution.scene
    is_in = entry.is_in(scene)
    finer, coarser = entry.finer(scene), entry.coarser(scene)
    judged, actual, ratio = None, None, None
    if solution.converged and (finer is not coarser or entry.without_parameters):
        judged = judge(entry, solution)
    if judged is not None and finer is not coarser:
        ratio = _time_ratio(finer, coarser)
        actual = by_quantity(solve(coarser), solve(finer)) if verify else None
    (indicator,) = (as_floats({"": judged.indicator}) or {}).values() if judged else (None,)
    predicted = as_floats(None if judged is None else judged.errors)
    found, why = _verdict(entry, solution, judged, actual, tolerance)
    lines = lines_to_add(scene, [entry])
    return Row(entry.name, entry.what, is_in, indicator, predicted, as_floats(actual), ratio, found, why, lines)


def as_floats(errors: dict[str, Any] | None) -> dict[str, float | None] | None:
    """Plain numbers; null for what is none."""
    return None if errors is None else {name: float(x) if np.isfinite(x) else None for name, x in errors.items()}


def _verdict(
    entry: Entry, solution: Solution, judged: Judgement | None, actual: dict[str, Any] | None, tolerance: float
) -> tuple[str, str]:
    error = None
    if judged is not None:
        error = float(judged.largest) if actual is None else float(max(actual.values()))
    is_solved, is_in = bool(solution.converged), entry.is_in(solution.scene)
    found = verdict(entry, "scene", is_solved, is_in, error, tolerance)
    point = solution.operating_point
    if found[0] == NOT_NEEDED and judged is not None and actual is None and bool(point.has_light_ball):
        is_nothing = judged.indicator == 0.0 and point.largest_load > 0.0
        return found if is_nothing else (NOT_ASSESSED, LIGHT_BALL)
    return found


def verdict(
    entry: Entry, of: str, is_solved: bool, is_in: bool, error: float | None, tolerance: float
) -> tuple[str, str]:
    """Whether it is needed, and why not so where that cannot be judged.

    Args:
        of: what has it or not, in a word.
        error: the largest change of all reported results; None where there is none.
    """
    if not is_solved:
        return NOT_ASSESSED, f"the {of} has no solution to judge by"
    if entry.needs and not is_in:
        if error is None:
            return NOT_ASSESSED, f"needs {entry.needs}"
        is_likely = np.isfinite(error) and error > tolerance
        why = f"needs {entry.needs}; the numbers are estimated {entry.without_parameters}"
        return (DATA_MISSING if is_likely else NOT_ASSESSED), why
    if error is None:
        return NOT_ASSESSED, f"the {of} states another choice, or has nothing that it acts on"
    if error > tolerance and entry.hypothesis:
        return NOT_ASSESSED, entry.hypothesis
    return (NEEDED if error > tolerance else NOT_NEEDED), ""


def _time_ratio(finer: Scene, coarser: Scene) -> float:
    """Time of a solve with it over that of one without, in turn; medians."""
    times: dict[str, list[float]] = {"finer": [], "coarser": []}
    for _ in range(REPEATS):
        for name, scene in (("finer", finer), ("coarser", coarser)):
            times[name].append(solve(scene, threads=1).seconds)
    return statistics.median(times["finer"]) / statistics.median(times["coarser"])
