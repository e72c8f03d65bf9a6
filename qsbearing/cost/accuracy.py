"""The cheapest fidelity that will do: chosen by the measured table, checked by the solution's own contacts.

`choose` judges each simplification of a scene by the indicators of what it does without and the table `advice.json`,
before anything is solved, and takes the one that is expected to be quickest among those whose error stays well below
what was asked. `solve_to` solves it, judges it anew by the loads and angles found, and goes on to a finer one where
these say that it will not do. The scene's own fidelity has no error by definition: accuracy is against the scene's full
answer, and `qsbearing.cost.answers` says how it is counted.
"""

from __future__ import annotations

import json
import math
from bisect import bisect_left
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.case import case_arrays
from qsbearing.cost import indicators, pace
from qsbearing.cost.ladder import LADDER, Rung, ways
from qsbearing.solving import solve

if TYPE_CHECKING:
    from qsbearing.scene import Scene
    from qsbearing.solution import Solution

FINEST, COARSEST = 1e-12, 1.0
"""What may be asked: the solver's own tolerance, and everything."""
PRUDENCE = 0.7
"""The part of the error asked for that formulas may foretell. Nearer to it the contacts found say no in one case of
two, and a second solve costs more than was saved (measured over the trial's scenes)."""


@cache
def table() -> dict[str, Any]:
    """The measured table; `python -m tests.benchmarks.cost` makes it anew."""
    text = resources.files("qsbearing.cost").joinpath("advice.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


def bound(name: str, when: str, indicator: float, touches: bool) -> float:
    """Largest error to expect of one omission; infinite where the measurements promise nothing.

    Args:
        name: of the omission.
        when: "before" solving, from formulas, or "after", from the contacts found.
        indicator: what `qsbearing.cost.indicators` says of it; the error of a smaller one than measured shrinks with
        it. touches: whether some ball is about to lose a raceway.
    """
    entry = table()["omissions"][name]
    if not indicator > 0.0:
        return 0.0 if indicator == 0.0 else math.inf
    place = bisect_left(entry["indicator"], indicator)
    if place == len(entry["indicator"]):
        return math.inf
    factor = entry[when]["touching" if touches else "loaded"][place]
    return math.inf if factor is None else float(factor * indicator)


@dataclass(frozen=True)
class Way:
    """One fidelity at which the scene may be solved, judged before solving."""

    rung: Rung
    scene: Scene
    left_out: tuple[indicators.Omission, ...]
    error: float
    """Largest error to expect; 0 for the scene's own fidelity."""
    seconds: float
    """Expected time of the solve."""


@dataclass(frozen=True)
class Choice:
    """What was chosen, and what there was to choose from."""

    asked: float
    way: Way
    ways: tuple[Way, ...]
    """All that would do, the quickest first."""


@dataclass(frozen=True)
class Reached:
    """A solution at the fidelity chosen, and what is known of its error afterwards."""

    choice: Choice
    way: Way
    """The one that the solution is of: the one chosen, or the next that does."""
    solution: Solution
    error: float
    """Largest error to expect, by the solution's own loads and angles; 0 for the scene's own fidelity."""
    seconds: float
    """Of all solves."""
    solves: int
    """How many fidelities were solved: more than one where the first turned out not to do."""


def choose(scene: Scene, asked: float, here: dict[str, float] | None = None) -> Choice:
    """The quickest fidelity whose error stays below what is asked, by formulas and the measured table.

    Args:
        scene: a single case.
        asked: largest error wanted, from `FINEST` to `COARSEST`.
        here: this machine's `pace.calibration`, measured now if not given.

    Raises:
        ValueError: the scene has array fields, or the accuracy is out of range.
    """
    if not FINEST <= asked <= COARSEST:
        raise ValueError(f"accuracy = {asked:g}: must lie between {FINEST:g} and {COARSEST:g}")
    if any(np.ndim(value) for value in case_arrays(scene).values() if value is not None):
        raise ValueError("the scene has array fields: a fidelity is chosen for one case at a time")
    judge = indicators.Judge(scene)
    contacts = indicators.estimated(judge)
    here = pace.calibration() if here is None else here
    found = []
    for rung, simple in ways(scene):
        left_out = indicators.omissions(simple, scene)
        error = _error(left_out, "before", judge, contacts)
        found.append(Way(rung, simple, left_out, error, pace.seconds(simple, table()["seconds"], here)))
    # Of two that take the same time the finer one: it costs nothing.
    enough = sorted((way for way in found[::-1] if way.error <= PRUDENCE * asked), key=lambda way: way.seconds)
    return Choice(asked, enough[0], tuple(enough))


def solve_to(choice: Choice) -> Reached:
    """Solve at the fidelity chosen; where its solution says that it will not do, at the next that by it will."""
    full = choice.ways[[not way.left_out for way in choice.ways].index(True)].scene
    judge = indicators.Judge(full)
    seconds, solves = 0.0, 0
    way = choice.way
    upwards = sorted(choice.ways, key=lambda way: LADDER.index(way.rung))
    while True:
        solution = solve(way.scene)
        seconds, solves = seconds + solution.seconds, solves + 1
        contacts = indicators.found(judge, solution) if way.left_out and solution.converged else None
        # What these contacts say of finer ways too spares solving any that will not do either.
        for one in upwards[upwards.index(way) :]:
            error = _after(one, judge, contacts)
            if error <= choice.asked:
                break
        if one is way:
            return Reached(choice, way, solution, error, seconds, solves)
        way = one


def _after(way: Way, judge: indicators.Judge, contacts: indicators.Contacts | None) -> float:
    """Largest error of a way by contacts found; without any, nothing is promised but of the scene's own fidelity."""
    if not way.left_out:
        return 0.0
    return math.inf if contacts is None else _error(way.left_out, "after", judge, contacts)


def _error(left_out: Any, when: str, judge: indicators.Judge, contacts: indicators.Contacts) -> float:
    """Sum over all that is left out: errors of several add up at most."""
    touches = bool(contacts.touches)
    return sum(bound(one.name, when, float(one.indicator(judge, contacts)), touches) for one in left_out)
