"""Where along a range a set's preload is lost, excessive or comes back: solved at many values, and again where it
changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.preload_state import EXCESSIVE, PreloadState
from qsbearing.model.solution.status import Status
from qsbearing.model.validation import ErrorDetail, SceneError
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import Span, capital, numbered
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.solve import solve_set

VALUES = 65
"""Of a range: two rounds find a value to 1/4096 of it."""
STRIDES = 8, 1
"""In which the end of a set is looked for, value by value: that it has no equilibrium takes a hundred times as long to
find as one, so that nothing is tried beyond."""


@dataclass(frozen=True)
class StateChange:
    """The least value at which a row is in another state than before."""

    value: float
    row: int
    """From 0; -1 where the set ends and no row is to blame."""
    before: str
    """Empty at the beginning of the range, and where there is no solution."""
    after: str
    """maintained, lost or excessive; no_equilibrium or not_converged where the set is not solved any more."""

    @property
    def is_return(self) -> bool:
        """Whether the preload is back."""
        return self.after == PreloadState.MAINTAINED


def opposed_errors(of: BearingSet) -> list[ErrorDetail]:
    """What is wrong with a set whose preload is asked for."""
    if of.is_opposed:
        return []
    cause = "Rows that carry in opposite directions press each other"
    ways = "none is pressed to one side" if all(of.is_two_sided) else "all carry in one direction"
    return [ErrorDetail("rows", f"have no preload: {ways}", cause=cause)]


def changes(at: Callable[[NDArray], BearingSet], high: float, threads: int | None) -> list[StateChange]:
    """What changes between 0 and the highest value, the least value first; at 0 what is not maintained there.

    What changes and changes back between two of the values tried is not seen, and nothing is sought beyond the first
    value without an equilibrium.

    Args:
        at: the set at these values, one case each.

    Raises:
        SceneError: the set has arrays of its own.
    """
    values = np.linspace(0.0, high, VALUES)
    labels = _labels(at, values, threads)
    maintained = str(PreloadState.MAINTAINED)
    every = [
        StateChange(0.0, _row(n, labels), "", word) for n, word in enumerate(labels[0]) if word not in ("", maintained)
    ]
    for k in _changing(labels):
        between = np.linspace(values[k - 1], values[k], VALUES)
        finer = _labels(at, between, threads)
        for j in _changing(finer):
            for n in np.flatnonzero(finer[j] != finer[j - 1]):
                before, after = str(finer[j - 1, n]), str(finer[j, n])
                if after not in ("", maintained) or (after == maintained and before):
                    every.append(StateChange(float(between[j]), _row(n, labels), before, after))
    return sorted(every, key=lambda each: each.value)


def _changing(labels: NDArray[Any]) -> NDArray:
    """At which values something differs from the value before."""
    return np.flatnonzero((labels[1:] != labels[:-1]).any(axis=1)) + 1


def firsts(every: list[StateChange]) -> list[StateChange]:
    """The first loss, excess or end of each row."""
    known: dict[tuple[int, str], StateChange] = {}
    for each in every:
        if not each.is_return:
            known.setdefault((each.row, each.after), each)
    return list(known.values())


def together(every: Sequence[StateChange]) -> list[list[StateChange]]:
    """Those that are said at once: the same of several rows, unless the sentence is about one row's own preload."""
    alike: dict[tuple[Any, ...], list[StateChange]] = {}
    for number, each in enumerate(every):
        own = number if each.row < 0 or each.after in (PreloadState.LOST, PreloadState.MAINTAINED) else -1
        alike.setdefault((own, each.after, each.value == 0.0), []).append(each)
    return list(alike.values())


def sentence(of: BearingSet, same: Sequence[StateChange], at: Callable[[Any], str], already: str) -> str:
    """What changes, of one row, of the set, or of several rows at once.

    Args:
        at: where: of a value, or of a `Span` of several.
        already: when, of a preload that is lost or excessive at the beginning of the range.
    """
    change, rows = same[0], sorted(each.row + 1 for each in same)
    name = "The set" if change.row < 0 else capital(row_name(of.rows[change.row], change.row))
    name = name if len(rows) == 1 else capital(numbered("row", rows))
    times = f"{EXCESSIVE:g} times its given value"
    if change.after == PreloadState.LOST and change.value == 0.0:
        return f"{name} has lost its preload {already}."
    if change.after == PreloadState.EXCESSIVE and change.value == 0.0:
        return f"{name}: the preload exceeds {times} {already}."
    where = at(Span(each.value for each in same))
    said = {
        str(PreloadState.MAINTAINED): f"{name} regains its preload {where}.",
        str(PreloadState.LOST): f"{name} loses its preload {where}.",
        str(PreloadState.EXCESSIVE): f"{name}: the preload exceeds {times} {where}.",
        "no_equilibrium": f"{name}: no equilibrium {where}.",
    }
    return said.get(change.after, f"{name}: no solution {where}.")


def _labels(at: Callable[[NDArray], BearingSet], values: NDArray, threads: int | None) -> NDArray[Any]:
    """What has become of each row, and last of the set as a whole, up to a value without an equilibrium.

    Returns:
        Words of shape (value, row + 1).
    """
    low, end, last = 0, values.size, []
    for stride in STRIDES:
        for k in range(low + stride, end, stride):
            solution = _solved(at(values[k : k + 1]), threads)
            if solution.status[0] == Status.NO_EQUILIBRIUM:
                end, last = k, [_words(solution)]
                break
            low = k
    return np.concatenate([_words(_solved(at(values[:end]), threads)), *last])


def _solved(of: BearingSet, threads: int | None) -> SetSolution:
    solution = solve_set(of, threads=threads)
    if len(solution.shape) != 1:
        raise SceneError([ErrorDetail("rows", "or what acts on them has arrays: give one number each")])
    return solution


def _words(solution: SetSolution) -> NDArray[Any]:
    words = solution.preload_state
    assert words is not None  # the set is opposed
    words = np.where(words == PreloadState.REDUCED, str(PreloadState.MAINTAINED), words)  # a share, not a limit
    labels = np.concatenate([words, np.full((len(words), 1), "")], axis=1).astype(object)
    unsolved = np.flatnonzero(~solution.converged)
    labels[unsolved] = ""
    labels[unsolved, np.asarray(solution.row_that_gives_way)[unsolved]] = solution.status[unsolved]  # -1: the last
    return labels


def _row(column: Any, labels: NDArray[Any]) -> int:
    """The row of a column; the last is the set's."""
    return -1 if column == labels.shape[1] - 1 else int(column)
