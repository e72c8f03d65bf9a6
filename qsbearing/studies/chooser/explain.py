"""Why a scene needs each effect and choice or does not: what leaving it out changes, cost in time, verdict."""

from __future__ import annotations

import statistics
from dataclasses import dataclass
from typing import Any

import numpy as np

from qsbearing.files.file_keys import IN_FILE, line
from qsbearing.model.compiler.compiled import is_compiled
from qsbearing.model.effects import EFFECTS, QUANTITIES, Entry
from qsbearing.model.kernel.solve_case import solve_cases
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import Change, changes
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.solution.judgement import ANOTHER_RESULT, judge, settings_to_add
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.remarks.wording import Words
from qsbearing.studies.chooser import choose

NEEDED, NOT_NEEDED, NOT_ASSESSED = "needed", "not needed", "not assessed"
DATA_MISSING = "likely needed, data missing"

NOTHING = 1e-6
"""Changes below it are not worth showing."""
FEWEST, REPEATS = 3, 5
"""Solves, at least and at most, of which the median is the time."""
ENOUGH = 0.1
"""Seconds, after which a scene that takes long is not solved more often than it must be."""


@dataclass(frozen=True)
class Row:
    """What there is to say about one effect or choice at one case; null for what there is not."""

    effect: str
    what: str
    in_scene: bool
    indicator: float | None
    predicted: dict[str, float | None] | None
    """Relative change of the reported results if it is left out, or was, as its indicator estimates it; null where its
    parameters are not known."""
    actual: dict[str, float | None] | None
    """The same, found by solving with and without it; likewise."""
    time_with_over_without: float | None
    """Where the kernel runs compiled."""
    verdict: str
    why: str
    add: list[str]
    """Lines for a scene file that lacks it, under [effects]."""
    assumed: list[dict[str, Any]]
    """What solving with usual parameters finds where its own are not known: `actual` under each assumption, with words
    for it; empty else."""

    @property
    def largest(self) -> str:
        """The one of `QUANTITIES` that it changes most; empty where nothing was solved."""
        solved = [each for each in (self.actual, *(each["actual"] for each in self.assumed)) if each]
        sizes = {name: max((each[name] or 0.0 for each in solved), default=0.0) for name in QUANTITIES}
        return max(sizes, key=lambda name: sizes[name]) if solved else ""

    def change(self, quantity: str) -> str:
        """What leaving it out changes of one of `QUANTITIES`, in per cent; after ≈ where its parameters are assumed,
        from the first assumption to the last."""
        if self.actual is not None or not self.assumed:
            return two_digits(None if self.actual is None else self.actual[quantity], 100.0)
        found = [each["actual"][quantity] for each in self.assumed if each["actual"] is not None]
        shown = [ANOTHER_RESULT if value is not None and value > 1.0 else two_digits(value, 100.0) for value in found]
        if not any(found):
            return "0" if found else "-"
        return "≈ " + "\nto ".join(dict.fromkeys(shown))


def two_digits(value: float | None, size: float = 1.0) -> str:
    """A number in so many, times a size; a dash where there is none."""
    if value is None:
        return "-"
    return "0" if value < NOTHING else f"{value * size:.2g}" if value * size < 100.0 else f"{value * size:.0f}"


def explain(scene: Scene, tolerance: float, words: Words = IN_FILE) -> tuple[Solution, list[Row]]:
    """The scene's solution, and a row for every effect and choice, named by the scene or not.

    Each is solved with and without; with usual parameters where it takes some that the scene does not give.

    Args:
        scene: a single case, with its effects as it names them.
        tolerance: the relative error below which an effect is not needed.
        words: of whoever reads it.

    Raises:
        ValueError: the scene has array fields.
    """
    solution = choose.solve(scene)
    if solution.shape:
        raise ValueError(f"the scene has cases {solution.shape}: effects are explained for one case at a time")
    return solution, [_row(entry, solution, tolerance, words) for entry in EFFECTS]


def _row(entry: Entry, solution: Solution, tolerance: float, words: Words) -> Row:
    scene = solution.scene
    is_in = entry.is_in(scene)
    finer, coarser = entry.finer(scene), entry.coarser(scene)
    judged, actual, ratio, error, assumed = None, None, None, None, list[Change]()
    if solution.converged and finer is not coarser:
        judged = judge(entry, solution)
        actual, ratio = _solved(finer, coarser)
        error = float(max(actual.values()))
    elif solution.converged:
        assumed = changes(entry, solution)
        error = largest_of(assumed)
    (indicator,) = (as_floats({"": judged.indicator}) or {}).values() if judged else (None,)
    predicted = as_floats(None if judged is None else judged.errors)
    found, why = verdict(entry, "scene", bool(solution.converged), is_in, error, tolerance, assumed, words)
    lines, under = lines_to_add(scene, entry), under_assumptions(assumed)
    return Row(entry.name, entry.what, is_in, indicator, predicted, as_floats(actual), ratio, found, why, lines, under)


def lines_to_add(of: Any, entry: Entry) -> list[str]:
    """What the file of a scene or set says under [effects] to ask for it besides."""
    return [line(each) for each in settings_to_add(of, [entry])]


def largest_of(found: list[Change]) -> float | None:
    """The largest change under any assumption that has a solution; None where none has."""
    solved = [float(each.largest) for each in found if each.is_solved]
    return max(solved) if solved else None


def under_assumptions(found: list[Change]) -> list[dict[str, Any]]:
    """As a row has them."""
    return [
        {"under": each.under, "what": each.what, "actual": as_floats(each.errors) if each.is_solved else None}
        for each in found
    ]


def as_floats(errors: dict[str, Any] | None) -> dict[str, float | None] | None:
    """Plain numbers; null for what is none."""
    return None if errors is None else {name: float(x) if np.isfinite(x) else None for name, x in errors.items()}


def verdict(
    entry: Entry,
    of: str,
    is_solved: bool,
    is_in: bool,
    error: float | None,
    tolerance: float,
    assumed: list[Change],
    words: Words = IN_FILE,
) -> tuple[str, str]:
    """Whether it is needed, and why not so where that cannot be judged.

    Args:
        of: what has it or not, in a word.
        error: the largest change of all reported results; None where there is none.
        assumed: from which it is, where the parameters are not known.
    """
    if not is_solved:
        return NOT_ASSESSED, f"the {of} has no solution to judge by"
    if entry.needs and not is_in:
        whats, needs = " and ".join(dict.fromkeys(each.what for each in assumed)), words.of(entry.needs)
        if error is None:
            unsolved = f"; solved with {whats}, the {of} has no solution" if assumed else ""
            return NOT_ASSESSED, f"needs {needs}{unsolved}"
        why = f"needs {needs}; the numbers are those of {whats}"
        return (DATA_MISSING if error > tolerance else NOT_ASSESSED), why
    if error is None:
        return NOT_ASSESSED, "does not apply here"
    if error > tolerance and entry.hypothesis:
        return NOT_ASSESSED, entry.hypothesis
    return (NEEDED if error > tolerance else NOT_NEEDED), ""


def _solved(finer: Scene, coarser: Scene) -> tuple[dict[str, Any], float | None]:
    """What a solve with it and one without differ by, and the time of the first over that of the other: medians of
    solves in turn, of the compiled kernel; None where it runs as plain Python."""
    scenes = finer, coarser
    found = [solve(each, threads=1) for each in scenes]
    times = [[each.seconds] for each in found]
    with_it, without = found
    if not is_compiled(solve_cases):
        return by_quantity(without, with_it), None
    while len(times[0]) < FEWEST or (len(times[0]) < REPEATS and sum(map(sum, times)) < ENOUGH):
        found = [solve(each, threads=1) for each in scenes]
        for taken, each in zip(times, found, strict=True):
            taken.append(each.seconds)
    return by_quantity(without, with_it), statistics.median(times[0]) / statistics.median(times[1])
