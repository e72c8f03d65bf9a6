"""The cheapest model level that will do, judged by the contacts of a cheaper solution.

`choose` solves the scene at its coarsest level and judges every level by the contacts found there: the error of what it
leaves out is at most a factor of `advice.json` times its indicator. The first whose error stays below what was asked is
taken. `solve_to` solves it, judges it anew by its own contacts, and goes on to a finer one where these say that it will
not do. The scene itself has no error by definition: accuracy is against the scene's full result, counted as `results`
says.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cache
from importlib import resources
from statistics import median
from typing import Any

import numpy as np

from qsbearing.flatten import case_arrays
from qsbearing.scene.scene import HertzAngle, HertzForm, Scene
from qsbearing.solution import Solution
from qsbearing.solver import solve
from qsbearing.studies.cost import indicators
from qsbearing.studies.cost.levels import Level, simplifications

FINEST, COARSEST = 1e-12, 1.0
"""What may be asked: the solver's own tolerance, and everything."""


@cache
def factors() -> dict[str, Any]:
    """The measured factors; `python -m tests.benchmarks.advice` makes them anew."""
    text = resources.files("qsbearing.studies.cost").joinpath("advice.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


@dataclass(frozen=True)
class Option:
    """One model level at which the scene may be solved."""

    level: Level
    scene: Scene
    left_out: tuple[str, ...]
    """Of `indicators.OMISSIONS`."""
    error: float
    """Largest error to expect; 0 for the scene itself, infinite where nothing is promised."""
    seconds: float
    """Expected time of the solve."""


@dataclass(frozen=True)
class Choice:
    """What was chosen, and what there was to choose from."""

    asked: float
    option: Option
    options: tuple[Option, ...]
    """All, the coarsest first; the last is the scene itself."""


@dataclass(frozen=True)
class Reached:
    """A solution at the level chosen or at a finer one, and what is known of its error afterwards."""

    choice: Choice
    option: Option
    """The one that the solution is of."""
    solution: Solution
    error: float
    """Largest error to expect, by the solution's own contacts; 0 for the scene itself."""
    seconds: float
    """Of the solves at the level chosen and at those after it."""
    solves: int
    """How many these were: more than one where the first turned out not to do."""


def choose(scene: Scene, asked: float) -> Choice:
    """The coarsest level whose error stays below what is asked (`FINEST` to `COARSEST`), by the coarsest solution's
    contacts.

    Raises:
        ValueError: the scene has array fields, or the accuracy is out of range.
    """
    if not FINEST <= asked <= COARSEST:
        raise ValueError(f"accuracy = {asked:g}: must lie between {FINEST:g} and {COARSEST:g}")
    if any(np.ndim(value) for value in case_arrays(scene).values() if value is not None):
        raise ValueError("the scene has array fields: a model level is chosen for one case at a time")
    found = simplifications(scene)
    solution, times = solve(found[0][1]), list[float]()  # loads the machine code
    while len(times) < 9 and sum(times) < 0.05:  # enough to tell how fast this machine is just now
        times.append(solve(found[0][1]).seconds)
    options = []
    for level, simple in found:
        left_out = indicators.omissions(simple, scene)
        error = expected_error(left_out, scene, solution)
        options.append(Option(level, simple, left_out, error, median(times) * relative_time(simple, solution)))
    return Choice(asked, next(one for one in options if one.error <= asked), tuple(options))


def solve_to(choice: Choice) -> Reached:
    """Solve at the level chosen; where its solution says that it will not do, at the next that by it will."""
    full = choice.options[-1].scene
    option, seconds, solves = choice.option, 0.0, 0
    while True:
        solution = solve(option.scene)
        seconds, solves = seconds + solution.seconds, solves + 1
        # These contacts judge the finer levels too, which spares solving any that will not do either.
        for one in choice.options[choice.options.index(option) :]:
            error = expected_error(one.left_out, full, solution)
            if error <= choice.asked:
                break
        if one is option:
            return Reached(choice, option, solution, error, seconds, solves)
        option = one


def expected_error(left_out: tuple[str, ...], full: Scene, solution: Solution) -> float:
    """Largest error of leaving these out, by the contacts of a solution without them or some of them: that of several
    is their sum at most. Infinite where there is no solution to judge by."""
    if not left_out:
        return 0.0
    if not solution.converged:
        return math.inf
    found, is_nearly_unloaded = indicators.indicators(full, solution)
    return sum(bound(name, float(found[name]), bool(is_nearly_unloaded)) for name in left_out)


def bound(name: str, indicator: float, is_nearly_unloaded: bool) -> float:
    """Largest error to expect of one omission; infinite for an indicator that is no number."""
    factor = factors()["error_over_indicator"][name]["nearly_unloaded" if is_nearly_unloaded else "loaded"]
    return math.inf if math.isnan(indicator) else float(factor * indicator)


def relative_time(scene: Scene, coarsest: Solution) -> float:
    """Expected time of the first solve of a scene over that of a repeated one at the coarsest level.

    Only the actual angle makes a difference to one call, by the balls that are iterated: mirror images and equal balls,
    which carry the very same load, are solved once.
    """
    measured, balls = factors()["time"], 0
    if scene.hertz_angle is HertzAngle.ACTUAL and scene.hertz_form is HertzForm.EXACT:
        balls = np.unique(coarsest.inner.load).size
    return float(measured["first_over_repeated"] * (1.0 + measured["actual_angle_of_a_ball"] * balls))
