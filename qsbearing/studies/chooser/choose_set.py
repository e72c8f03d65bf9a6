"""`qs.solve_set`: a set as it stands, or with effects and choices left out within a tolerance, found by trying.

The full model has every effect and the finest of every choice that need nothing but to be named. Each that saves time
is left out alone; then, from the one that matters least on, as many together as keep all results within the tolerance
of the full model's. What rows have for themselves stays. With array fields, one choice serves all cases.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.model.effects import EFFECTS
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.comparison import largest
from qsbearing.model.solution.of_cases import Choice, LeftOut
from qsbearing.model.solution.solver import TOLERANCE, check_residual
from qsbearing.model.validation import check_kind
from qsbearing.studies.chooser import choose
from qsbearing.studies.chooser.accuracy import renamed, requested_accuracy
from qsbearing.studies.chooser.choose import check_readings
from qsbearing.systems.sets import solve as systems
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution


def solve_set(
    of: BearingSet,
    *,
    effects: str | None = None,
    accuracy: float | None = None,
    residual_tolerance: float | None = None,
    threads: int | None = None,
    tolerance: float | None = None,
) -> SetSolution:
    """Solve every case of a set.

    Args:
        of: what to solve; its array fields broadcast to the case axes.
        effects: "auto": effects and choices are left out within `accuracy`; None: those that the set names, or auto
            where it asks for that itself (`BearingSet.tolerance`).
        accuracy: only with effects chosen: the largest relative error of the reported results (0.01 if not given).
        residual_tolerance: of the solver, 1e-13 to 1e-6 (1e-12 if not given): largest imbalance over the largest force
            at which a case counts as solved. Where rounding forbids it, 1e-10 is accepted and `SetSolution.residual`
            states it.
        threads: at most this many; None: the environment variable QSBEARING_THREADS, else all cores.
        tolerance: the old name of `residual_tolerance`, up to 0.1.

    Returns:
        SetSolution: raises nothing for a physical outcome; `status` and `message` say what happened and which row
        has no solution. `choice` lists what was chosen and left out.

    Raises:
        ValueError: array fields that do not broadcast, a tolerance, accuracy or thread count out of range.

    Examples:
        >>> bearing = qs.load_scene("7210C").bearing
        >>> rows = qs.Row(bearing, 0.0, "+x"), qs.Row(bearing, 20 * qs.mm, "-x")
        >>> operation = qs.Operation(speed=1047.0, radial_load_y=500.0, moment_z=0.0)
        >>> pair = qs.BearingSet(rows, operation, qs.Preload(rigid=720.0))
        >>> print(f"{qs.solve_set(pair).preload_in_operation[0]:.0f} N")
        720 N
    """
    check_kind("solve_set", of, "BearingSet")
    for readings in (of.readings, *(row.readings or {} for row in of.rows)):
        check_readings(readings)
    if residual_tolerance is not None:
        check_residual(residual_tolerance)
    residual = renamed("tolerance", tolerance, "residual_tolerance", residual_tolerance)
    how: dict[str, Any] = {"threads": threads, "tolerance": TOLERANCE if residual is None else residual}
    requested = requested_accuracy(effects, accuracy, of.tolerance)
    if requested is None:
        return systems.solve_set(of, **how)
    if of.thermal is not None:
        raise ValueError("effects are not chosen for a set with a heat balance: name them")
    return _chosen(replace(of, tolerance=None), requested, how)


def solve_any(of: Scene | BearingSet) -> Any:
    """The solution of a scene or a set, with the effects that it names or leaves to be chosen."""
    return choose.solve(of) if isinstance(of, Scene) else solve_set(of)


def _chosen(of: BearingSet, requested: float, how: dict[str, Any]) -> SetSolution:
    full = of
    for entry in EFFECTS:
        full = full if entry.hypothesis else entry.finer(full)
    solution = reference = systems.solve_set(full, **how)
    trials, errors = [], {}
    for entry in EFFECTS if np.any(reference.converged) else ():
        if entry.saves_time and not entry.hypothesis and entry.is_in(full):
            alone = systems.solve_set(entry.coarser(full), **how)
            trials.append((_error(alone, reference), entry, alone))
    solves, before, chosen = 1 + len(trials), 0.0, full
    for error, entry, alone in sorted(trials, key=lambda each: each[0]):
        if error > requested:
            continue
        trial = alone
        if chosen is not full:
            trial, solves = systems.solve_set(entry.coarser(chosen), **how), solves + 1
            error = _error(trial, reference)
        if error <= requested:
            chosen, solution = trial.set, trial
            errors[entry.name], before = max(error - before, 0.0), error
    there = tuple(entry.name for entry in EFFECTS if entry.is_in(chosen))
    added = tuple(e.name for e in EFFECTS if e.name in there and not e.hypothesis and not e.is_in(of))
    left = tuple(LeftOut(entry.name, np.asarray(errors[entry.name])) for entry in EFFECTS if entry.name in errors)
    solution.choice = Choice(requested, there, added, left, solves)
    return solution


def _error(solution: SetSolution, reference: SetSolution) -> float:
    """The largest of all results and cases; infinite where one alone is solved."""
    error = float(np.max(largest(solution, reference), initial=0.0))
    return np.inf if np.isnan(error) else error
