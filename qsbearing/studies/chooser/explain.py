"""Why a scene needs each effect and choice or does not: what leaving it out changes, cost in time, verdict."""

from __future__ import annotations

import statistics
from dataclasses import dataclass
from typing import Any

import numpy as np

from qsbearing.documents.numbers import plain
from qsbearing.files.file_keys import IN_FILE, line
from qsbearing.model.compiler.compiled import is_compiled
from qsbearing.model.effects import EFFECTS, QUANTITIES, Entry
from qsbearing.model.kernel.solve_case import solve_cases
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import Change, changes
from qsbearing.model.solution.comparison import by_quantity, moved
from qsbearing.model.solution.judgement import (
    WORTH_A_WARNING,
    changed,
    judge,
    percent,
    settings_to_add,
    shifted,
    unit_of,
)
from qsbearing.model.solution.solution import Solution
from qsbearing.model.solution.solver import solve
from qsbearing.model.units import um
from qsbearing.remarks.wording import Words
from qsbearing.studies.chooser import choose

NEEDED, NOT_NEEDED, NOT_ASSESSED = "needed", "not needed", "not assessed"
DATA_MISSING = "likely needed, data missing"

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
    """What solving with usual parameters finds where its own are not known: `actual` and `displacement_um` under each
    assumption, with words for it; empty else."""
    displacement_um: float | None = None
    """By how much `actual` changes displacements."""

    @property
    def largest(self) -> str:
        """The one of `QUANTITIES` that it changes most; empty where nothing was solved."""
        sizes = {name: self.size(name) for name in QUANTITIES}
        return max(sizes, key=lambda name: sizes[name]) if self._solved else ""

    @property
    def is_large(self) -> bool:
        """Whether it changes some result by so much that a scene without it is warned of."""
        is_told = all(value is not None for each in self._solved for value in each["actual"].values())
        return not is_told or any(self.size(name) > WORTH_A_WARNING for name in QUANTITIES)

    def size(self, quantity: str) -> float:
        """The largest relative change of one of `QUANTITIES` that has a number, under any assumption."""
        return max((each["actual"][quantity] or 0.0 for each in self._solved), default=0.0)

    @property
    def _solved(self) -> list[dict[str, Any]]:
        """What solving with and without it found, under each assumption."""
        known = {"actual": self.actual, "displacement_um": self.displacement_um}
        return [each for each in ([known] if self.actual is not None else self.assumed) if each["actual"] is not None]

    def change(self, quantity: str) -> str:
        """What leaving it out changes of one of `QUANTITIES`, in its unit; after ≈ where its parameters are assumed,
        from the first assumption to the last."""
        is_own = self.actual is not None
        shown = list(dict.fromkeys(_change(each, quantity, is_own) for each in self._solved)) or ["-"]
        return shown[0] if is_own or shown in (["0"], ["-"]) else "≈ " + "\nto ".join(shown)

    def change_in(self, quantity: str) -> str:
        """Likewise with its unit, on one line."""
        return f"{self.change(quantity)} {unit_of(quantity)}".replace("\n", " ")


def _change(found: dict[str, Any], quantity: str, is_own: bool) -> str:
    """Of one of the quantities, as a solve with and one without found it, with the scene's own parameters or not."""
    part = found["actual"][quantity] if unit_of(quantity) == "%" else found["displacement_um"]
    if part is None:
        return "-"
    return shifted(part) if unit_of(quantity) != "%" else percent(part, "") if is_own else changed(part, "")


def two_digits(value: float | None) -> str:
    """A number in so many; a dash where there is none."""
    return "-" if value is None else plain(value, ".2g")


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
    judged, actual, ratio, error, by, assumed = None, None, None, None, None, list[Change]()
    if solution.converged and finer is not coarser:
        judged = judge(entry, solution)
        actual, by, ratio = _solved(finer, coarser)
        error = float(max(actual.values()))
    elif solution.converged:
        assumed = changes(entry, solution)
        error = largest_of(assumed)
    (indicator,) = (as_floats({"": judged.indicator}) or {}).values() if judged else (None,)
    predicted = as_floats(None if judged is None else judged.errors)
    found, why = verdict(entry, "scene", bool(solution.converged), is_in, error, tolerance, assumed, words)
    lines, under = lines_to_add(scene, entry), under_assumptions(assumed)
    shown = as_floats(actual)
    return Row(entry.name, entry.what, is_in, indicator, predicted, shown, ratio, found, why, lines, under, by)


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
        {
            "under": each.under,
            "what": each.what,
            "actual": as_floats(each.errors) if each.is_solved else None,
            "displacement_um": in_um(each.moved) if each.is_solved else None,
        }
        for each in found
    ]


def in_um(length: Any) -> float | None:
    """A plain number; null for what is none."""
    return float(length / um) if length is not None and np.isfinite(length) else None


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


def _solved(finer: Scene, coarser: Scene) -> tuple[dict[str, Any], float | None, float | None]:
    """What a solve with it and one without differ by, by how much of a displacement [µm], and the time of the first
    over that of the other: medians of solves in turn, of the compiled kernel; None where it runs as plain Python."""
    scenes = finer, coarser
    found = [solve(each, threads=1) for each in scenes]
    times = [[each.seconds] for each in found]
    with_it, without = found
    if not is_compiled(solve_cases):
        return by_quantity(without, with_it), in_um(moved(without, with_it)), None
    while len(times[0]) < FEWEST or (len(times[0]) < REPEATS and sum(map(sum, times)) < ENOUGH):
        found = [solve(each, threads=1) for each in scenes]
        for taken, each in zip(times, found, strict=True):
            taken.append(each.seconds)
    ratio = statistics.median(times[0]) / statistics.median(times[1])
    return by_quantity(without, with_it), in_um(moved(without, with_it)), ratio
