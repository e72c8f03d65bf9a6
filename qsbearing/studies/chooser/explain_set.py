"""Which effects and choices a set calls for: found by solving it with and without each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from qsbearing.model.effects import EFFECTS, Entry
from qsbearing.model.solution.comparison import by_quantity, moved
from qsbearing.studies.chooser.explain import Assessment, SolvedChange, against_others, row_of
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.solve import solve_set


def explain_set(of: BearingSet, tolerance: float) -> tuple[SetSolution, list[Assessment]]:
    """The set's solution, and a row for every effect and choice, named by the set or not.

    What counts is the largest change of any row's contacts, and of the shaft's displacement and stiffness; a preload
    stays what it is at rest. Nothing is predicted and nothing timed.

    Args:
        of: a single case, with its effects as it names them.
        tolerance: the relative error below which an effect is not needed.

    Raises:
        ValueError: the set has array fields.
    """
    solution = solve_set(of)
    if solution.shape:
        raise ValueError(f"the set has cases {solution.shape}: effects are explained for one case at a time")
    return solution, [_row(entry, solution, tolerance) for entry in EFFECTS]


def finer(entry: Entry, of: BearingSet) -> BearingSet:
    """The set with an effect or choice, as far as it can be added; the very same object where nothing is."""
    fine: BearingSet = entry.finer(of)
    return fine


def coarser(entry: Entry, of: BearingSet) -> BearingSet:
    """The set without it, rows with effects of their own included; the very same object where it is so already."""
    coarse: BearingSet = entry.coarser(of)
    if entry.switch.slot != "ring_effects":
        return coarse
    rows = tuple(row if row.ring_effects is None else entry.coarser(row) for row in of.rows)
    return coarse if all(one is other for one, other in zip(rows, of.rows, strict=True)) else replace(coarse, rows=rows)


def _row(entry: Entry, solution: SetSolution, tolerance: float) -> Assessment:
    of, change = solution.set, SolvedChange()
    fine, coarse = finer(entry, of), coarser(entry, of)
    if solution.converged:
        if entry.switch.members is None and fine is not coarse:
            without, full = solve_set(coarse), solve_set(fine)
            actual = by_quantity(without, full)
            change = SolvedChange(actual, moved(without, full.displacement), beyond=_beyond(without, full, actual))
        else:
            change = against_others(entry, solution)
    return row_of(entry, solution, fine is of and coarse is not of, change, tolerance)


def _beyond(without: SetSolution, full: SetSolution, actual: dict[str, np.ndarray]) -> str:
    """Why a change has no number."""
    if bool(without.converged) != bool(full.converged):
        return f"{'with' if without.converged else 'without'} it the set has no solution"
    return "" if np.isfinite(list(actual.values())).all() else "without it some contacts carry no load"
