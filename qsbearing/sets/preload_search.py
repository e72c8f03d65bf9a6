"""Where along a range a set no longer keeps its preload: solved at many values, and again where something changes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.set_messages import PreloadState, states
from qsbearing.sets.solve import solve_set
from qsbearing.validation import ErrorDetail, SceneError

VALUES = 65
"""Solved at a time: two rounds find a value to 1/4096 of the range."""
ROUNDS = 2

Changes = dict[tuple[int, str], float]
"""The first value of each row, from 0, and its new state; row -1 where the set ends and no row is to blame."""


def opposed_errors(of: BearingSet) -> list[ErrorDetail]:
    """What is wrong with a set whose preload is asked for."""
    if of.is_opposed:
        return []
    cause = "Rows that carry in opposite directions press each other"
    return [ErrorDetail("rows", "have no preload: all carry in one direction", cause=cause)]


def first_changes(
    at: Callable[[NDArray], BearingSet], low: float, high: float, threads: int | None, rounds: int = ROUNDS
) -> Changes:
    """The lowest value in [low, high] of each state that a row or the set gets into.

    What changes and changes back between two of the values tried is not seen.

    Args:
        at: the set at these values, one case each.

    Raises:
        SceneError: the set has arrays of its own.
    """
    values = np.linspace(low, high, VALUES)
    solution = solve_set(at(values), threads=threads)
    if solution.shape != values.shape:
        raise SceneError([ErrorDetail("rows", "or what acts on them has arrays: give one number each")])
    words = states(solution)
    assert words is not None  # the set is opposed
    status, faults = np.asarray(solution.status), np.asarray(solution.row_that_gives_way)
    first: dict[tuple[int, str], int] = {}
    for k in range(values.size):
        if status[k] != "converged":
            first.setdefault((int(faults[k]), str(status[k])), k)
        for number, word in enumerate(words[k]):
            if word in (PreloadState.LOST, PreloadState.RUN_AWAY):
                first.setdefault((number, str(word)), k)
    found: Changes = {}
    for what, k in first.items():
        found[what] = float(values[k])
        if rounds > 1 and k > 0:
            between = first_changes(at, float(values[k - 1]), float(values[k]), threads, rounds - 1)
            found[what] = between.get(what, found[what])
    return found
