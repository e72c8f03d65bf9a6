"""Remarks on effects that a scene or set lacks, though its results would change with them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import EFFECTS, QUANTITIES, Entry
from qsbearing.model.solution.changes import (
    Change,
    changes,
    has_size_for,
    is_unknown_to_friction,
    requested,
    rows_of,
)
from qsbearing.model.solution.comparison import moved
from qsbearing.model.solution.judgement import WORTH_A_WARNING, judge, settings_to_add
from qsbearing.model.units import um
from qsbearing.remarks.remark import Found, Of, Remark

DISPLACEMENT = "displacement"
MOST_CASES = 64
"""More cases than these (chosen: more points than a load spectrum has) are not solved again: what indicators predict of
them is said with ≈, and nothing of effects of which they predict nothing."""
WORTH_A_SOLVE = 0.4 * WORTH_A_WARNING
"""A predicted error above which an effect that needs nothing is tried (chosen: most predictions are within a factor
of two)."""


def missing_effects(solution: Any, part: slice, may_solve: bool = True) -> Iterator[Found]:
    """Of a scene or set; a row of a set has nothing to say of itself.

    Args:
        may_solve: whether few cases may be solved again.
    """
    if solution.solve_alike is None:
        return
    are_few = may_solve and int(np.prod(solution.shape)) <= MOST_CASES
    yield from _of_known(solution, part, are_few)
    yield from _of_assumed(solution, part, are_few)
    yield from _of_unknown_to_friction(solution, part, are_few)


def _of_known(solution: Any, part: slice, are_few: bool) -> Iterator[Found]:
    """Effects and choices that could be named as it is."""
    if getattr(solution, "choice", None) is not None:  # what was left out there is said with its error
        return
    of = requested(solution)
    candidates = []
    for entry in EFFECTS:
        if entry.hypothesis or not entry.can_be_added(of):
            continue
        predicted = _predicted(entry, solution)
        if not are_few:
            candidates.append((entry, predicted))
        elif np.any(predicted.largest > WORTH_A_SOLVE):
            candidates += [(entry, each) for each in changes(entry, solution)]
    if not candidates:
        return
    matters = np.stack([_matters(change, part) for _, change in candidates])
    by = np.max([change.largest.reshape(-1)[part] for _, change in candidates], axis=0)

    def missing(i: int) -> Remark:
        here = [each for each, matters_there in zip(candidates, matters[:, i], strict=True) if matters_there]
        k = part.start + i
        most = [_most([change], k) for _, change in here]
        about = list(zip(here, most, strict=True))
        return Remark(
            "effects_missing",
            values={
                "effects": tuple(entry.name for entry, _ in here),
                "quantities": tuple(quantity for quantity, _ in most),
                "changes": tuple(change for _, change in most),
                "is_estimated": not are_few,
                **_moved(solution, [each for (_, each), (name, _) in about if name == DISPLACEMENT], k),
                "add": settings_to_add(of, [entry for entry, _ in here]),
            },
        )

    yield np.where(matters.any(axis=0), by, 0.0), missing


def _of_assumed(solution: Any, part: slice, are_few: bool) -> Iterator[Found]:
    """Effects that need numbers of the scene, which no choice of effects can add either."""
    rows = rows_of(solution)
    for entry in EFFECTS:
        lacking = [n for n, row in enumerate(rows, 1) if not entry.is_in(row.scene)]
        if not entry.needs or not lacking or is_unknown_to_friction(entry, solution):
            continue
        predicted = [_predicted(entry, solution)] if entry.tells_without else []
        assumed = changes(entry, solution) if are_few else predicted
        if assumed:
            of = Of(rows=() if len(lacking) == len(rows) else tuple(lacking))
            matters = np.any([_matters(each, part) for each in assumed], axis=0)
            by = np.max([each.largest.reshape(-1)[part] for each in assumed], axis=0)
            yield np.where(matters, by, 0.0), partial(_lacks, solution, entry, of, assumed, part.start)


def _of_unknown_to_friction(solution: Any, part: slice, are_few: bool) -> Iterator[Found]:
    """What cannot be asked for beside friction, by what it changes under outer control."""
    for entry in EFFECTS:
        if not is_unknown_to_friction(entry, solution) or entry.is_in(requested(solution)):
            continue
        predicted = [_predicted(entry, solution)] if entry.tells_without or not entry.needs else []
        is_worth_it = entry.needs or np.any(predicted[0].largest > WORTH_A_SOLVE)
        compared = changes(entry, solution) if are_few and is_worth_it else [] if are_few else predicted
        if compared:
            matters = np.any([_matters(each, part) for each in compared], axis=0)
            by = np.max([each.largest.reshape(-1)[part] for each in compared], axis=0)
            yield np.where(matters, by, 0.0), partial(_unknown, solution, entry, compared, part.start)


def _unknown(solution: Any, entry: Entry, compared: list[Change], start: int, i: int) -> Remark:
    k = start + i
    there = [each for each in compared if np.ravel(each.is_solved)[k]]
    quantity, by = _most(compared, k)
    under, is_solved = tuple(each.under for each in there), all(each.displacement is not None for each in compared)
    values: dict[str, Any] = {"effect": entry.name, "quantity": quantity, "changes": by, "under": under}
    values |= {"is_estimated": not is_solved, **_moved(solution, there if quantity == DISPLACEMENT else [], k)}
    return Remark("effect_unknown_to_friction", values=values)


def _lacks(solution: Any, entry: Entry, of: Of, assumed: list[Change], start: int, i: int) -> Remark:
    """That an effect is missing, in some rows or in all, what it would change under each assumption, if solved."""
    k = start + i
    quantity, by = _most(assumed, k)
    there = [each for each in assumed if np.ravel(each.is_solved)[k]]
    under, is_solved = tuple(each.under for each in there), all(each.displacement is not None for each in assumed)
    values: dict[str, Any] = {"effect": entry.name, "quantity": quantity, "changes": by, "under": under}
    values |= {"is_estimated": not is_solved, "has_size": has_size_for(entry, solution)}
    return Remark("effect_data_missing", of, values | _moved(solution, there if quantity == DISPLACEMENT else [], k))


def _moved(solution: Any, compared: list[Change], k: int) -> dict[str, tuple[float, ...]]:
    """Of a remark that speaks of displacements: by how much they change with each effect, or under each assumption."""
    by = [moved(solution, each.displacement) for each in compared if each.displacement is not None]
    return {"displacements_um": tuple(float(np.ravel(each)[k] / um) for each in by)} if by else {}


def _most(compared: list[Change], k: int) -> tuple[str, tuple[float, ...]]:
    """Which quantity changes most in a case, counted along the flattened axes, and by how much with each change that is
    solved; nothing where none is."""
    with_solution = [each for each in compared if np.ravel(each.is_solved)[k]]
    if not with_solution:
        return "", ()
    errors = {name: np.ravel(error)[k] for name, error in with_solution[-1].errors.items()}
    name = max(errors, key=lambda each: np.nan_to_num(errors[each], nan=0.0))
    return name, tuple(float(np.ravel(each.errors[name])[k]) for each in with_solution)


def _predicted(entry: Entry, solution: Any) -> Change:
    """By the indicator, of a set in the row where it is most."""
    row_errors = [judge(entry, row).errors for row in rows_of(solution)]
    nothing = np.zeros(solution.shape)
    errors = {name: np.max([each.get(name, nothing) for each in row_errors], axis=0) for name in QUANTITIES}
    return Change("", "", errors, np.ones(solution.shape, bool))


def _matters(change: Change, part: slice) -> NDArray:
    """Where some answer changes noticeably, in which cases of a stretch."""
    return np.asarray(change.largest.reshape(-1)[part] > WORTH_A_WARNING)
