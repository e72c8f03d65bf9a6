"""`qs.solve`: a scene as it stands, or with effects and choices left out within a tolerance.

The full model of an operating point has every effect and the finest of every choice that need nothing but to be named,
and besides whatever the scene names with parameters. What is found to matter less than the tolerance is left out, which
need not be all that could be:

1. The scene is solved without anything that may be left out. What its indicator predicts to err by more than `MARGIN`
   times the tolerance is put in, and the rest judged again, until nothing is left to put in.
2. If all that is out errs by less than the tolerance over `MARGIN`, it stays out; else what errs by a small share of
   that does. But only where no ball is so light that indicators cannot be trusted (`OperatingPoint.has_light_ball`).
3. The rest is in doubt: it is solved with it and without it, and what changes too much is put in.

Raceway control and other hypotheses are never changed, formulas and conventions that save no time neither. With array
fields, one choice serves all cases: what any of them needs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import EFFECTS, Entry
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution import solver
from qsbearing.model.solution.comparison import largest
from qsbearing.model.solution.judgement import judge
from qsbearing.model.solution.of_cases import Choice, LeftOut
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import check_kind, raise_if_any
from qsbearing.studies.chooser.accuracy import renamed, requested_accuracy

MARGIN = 5.0
"""What a prediction may be wrong by without harm: of 6,500 random scenes without a light ball none erred by more."""
SHARE = 0.25
"""Part of the tolerance that predictions, with their margin, may use up where others have to be tried."""


def check_readings(requested: Mapping[str, Any]) -> None:
    """See that what is to be read off are readings, before anything is solved.

    Raises:
        SceneError: names that no reading has.
    """
    if requested:
        from qsbearing.readings.asked import name_errors  # a scene without readings does not load them

        raise_if_any(name_errors(requested))


def solve(
    scene: Scene,
    *,
    effects: str | None = None,
    accuracy: float | None = None,
    residual_tolerance: float = solver.TOLERANCE,
    start: Solution | None = None,
    threads: int | None = None,
    tolerance: float | None = None,
) -> Solution:
    """Solve every case of a scene.

    Args:
        scene: what to solve; its array fields broadcast to the case axes.
        effects: "auto": effects and choices are left out within `accuracy`; None: those that the scene names, or auto
            where it asks for that itself (`Scene.tolerance`).
        accuracy: only with effects chosen: the largest relative error of the reported results (0.01 if not given).
        residual_tolerance: of the solver, 1e-13 to 1e-6: largest imbalance over the largest force at which a case
            counts as solved (where rounding forbids it, 1e-10 is accepted and `Solution.residual` states it).
        start: a solution near this one (same case axes and ball axis, or a single case) to continue from.
        threads: at most this many; None: the environment variable QSBEARING_THREADS, else all cores.
        tolerance: the old name of `accuracy`.

    Returns:
        Solution: raises nothing for a physical outcome; `status` and `qs.message` say what happened, case by case.
        `choice` lists what was chosen and left out.

    Raises:
        ValueError: array fields that do not broadcast, a start of other axes, a tolerance, accuracy or thread count out
            of range, an accuracy without effects to choose.
        TypeError: not a scene.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(f"{solution.inner.angle[0] / qs.deg:.2f} {solution.outer.angle[0] / qs.deg:.2f}")
        49.94 31.34
    """
    check_kind("solve", scene, "Scene")
    check_readings(scene.readings)
    solver.check_residual(residual_tolerance)
    requested = requested_accuracy(effects, renamed("tolerance", tolerance, "accuracy", accuracy), scene.tolerance)
    if requested is None and scene.thermal is None:
        return solver.solve(scene, start=start, threads=threads, tolerance=residual_tolerance)
    if requested is None:
        from qsbearing.systems.heat import solve as hot

        return hot.solve(scene, threads=threads, tolerance=residual_tolerance)
    if scene.thermal is not None:
        raise ValueError("effects are not chosen for a scene with a heat balance: name them")
    return _Chooser(replace(scene, tolerance=None), requested, start, threads, residual_tolerance).choose()


def completed(scene: Scene) -> Scene:
    """The full model: everything that can be added, at its finest; what is a hypothesis stays as it is stated."""
    for entry in EFFECTS:
        scene = scene if entry.hypothesis else entry.finer(scene)
    return scene


def without(scene: Scene, entries: Iterable[Entry]) -> Scene:
    """The scene without these."""
    for entry in entries:
        scene = entry.coarser(scene)
    return scene


class _Chooser:
    """One choice: what is in the full model, and the solutions made on the way."""

    def __init__(
        self, scene: Scene, requested: float, start: Solution | None, threads: int | None, residual: float
    ) -> None:
        self.scene, self.requested, self.start, self.threads, self.residual = scene, requested, start, threads, residual
        self.full = completed(scene)
        self.open = [entry for entry in EFFECTS if entry.saves_time and not entry.hypothesis and entry.is_in(self.full)]
        self.solves = 0

    def choose(self) -> Solution:
        solution, out, predicted = self._with_all_needed()
        sure = self._surely_out(solution, out, predicted)
        errors = {entry.name: predicted[entry.name] for entry in sure}
        if len(sure) < len(out):
            solution, errors = self._tried(sure, [entry for entry in out if entry not in sure], predicted)
        left_out = tuple(LeftOut(name, errors[name]) for name in (entry.name for entry in EFFECTS) if name in errors)
        there = tuple(entry.name for entry in EFFECTS if entry.is_in(solution.scene))
        added = tuple(
            entry.name
            for entry in EFFECTS
            if entry.name in there and not entry.hypothesis and not entry.is_in(self.scene)
        )
        solution.choice = Choice(self.requested, there, added, left_out, self.solves)
        return solution

    def _solve(self, out: list[Entry]) -> Solution:
        self.solves += 1
        scene = without(self.full, out)
        return solver.solve(scene, start=self.start, threads=self.threads, tolerance=self.residual)

    def _with_all_needed(self) -> tuple[Solution, list[Entry], dict[str, NDArray]]:
        """A solution with all that is needed beyond doubt, what it lacks, and the errors predicted of that."""
        out = list(self.open)
        while True:
            solution = self._solve(out)
            predicted = {entry.name: judge(entry, solution, self.full).largest for entry in out}
            rest = [entry for entry in out if _most(predicted[entry.name]) <= MARGIN * self.requested]
            if len(rest) == len(out):
                return solution, out, predicted
            out = rest

    def _surely_out(self, solution: Solution, out: list[Entry], predicted: dict[str, NDArray]) -> list[Entry]:
        """What stays out without being tried: all of it, or what takes a small share of the tolerance."""
        if np.any(solution.operating_point.has_light_ball):
            return []
        if MARGIN * _most(sum(predicted.values())) <= self.requested:
            return list(out)
        sure: list[Entry] = []
        for entry in sorted(out, key=lambda each: _most(predicted[each.name])):
            if MARGIN * _most(sum(predicted[one.name] for one in (*sure, entry))) <= SHARE * self.requested:
                sure.append(entry)
        return sure

    def _tried(
        self, sure: list[Entry], doubtful: list[Entry], predicted: dict[str, NDArray]
    ) -> tuple[Solution, dict[str, Any]]:
        """The solution without all that may be left out, found by trying, and the error of each."""
        reference = self._solve(sure)
        again = {entry.name: judge(entry, reference, self.full).largest for entry in sure}
        if sure and len(self._surely_out(reference, sure, again)) < len(sure):  # finer contacts call them in doubt too
            sure, doubtful, again = [], [*sure, *doubtful], {}
            reference = self._solve(sure)
        spent = MARGIN * _most(sum(again.values()))
        solution, out, errors, before = reference, list(sure), dict[str, Any](again), np.zeros(reference.shape)
        for entry in sorted(doubtful, key=lambda each: _most(predicted[each.name])):
            trial = self._solve([*out, entry])
            error = largest(trial, reference)
            if _most(error) + spent <= self.requested:
                out.append(entry)
                solution, errors[entry.name], before = trial, np.maximum(error - before, 0.0), error
        return solution, errors


def _most(error: Any) -> float:
    """The largest error of all cases."""
    return float(np.max(error, initial=0.0))
