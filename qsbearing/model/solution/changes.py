"""What an effect would change of a solution that lacks it: found by solving the scene or set with it.

Where its parameters are not known, usual ones are assumed (`Entry.assume`). A solve takes about as long as the first
one did, and is right where an estimate is not: under radial loads bent rings share the load anew.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import Entry
from qsbearing.model.effects.entry import Assumed
from qsbearing.model.solution.comparison import by_quantity, moved
from qsbearing.model.validation import SceneError


@dataclass(frozen=True)
class Change:
    """By one solve with the effect; arrays of shape (*cases)."""

    under: str
    """As of `Assumed`; empty where nothing is assumed or one thing alone."""
    what: str
    """Likewise."""
    errors: dict[str, NDArray]
    """What leaving it out changes, by quantity, relative to the solution with it."""
    is_solved: NDArray
    """Whether there is a solution with it."""
    moved: NDArray | None = None
    """By how much displacements change [m]; None where nothing is solved."""

    @property
    def largest(self) -> NDArray:
        """Of all quantities that can be told; infinite where one has or loses its number."""
        return np.asarray(
            np.max([np.nan_to_num(each, nan=0.0, posinf=np.inf) for each in self.errors.values()], axis=0)
        )


_KNOWN: WeakKeyDictionary[Any, dict[str, list[Change]]] = WeakKeyDictionary()
"""A solution is asked for its remarks more than once, and for each of its cases."""


def changes(entry: Entry, solution: Any) -> list[Change]:
    """What an effect changes, for each assumption about its parameters; empty where nothing can be told.

    Args:
        solution: of a scene or set that lacks the effect, and not of a row of a set.
    """
    known = _KNOWN.setdefault(solution, {})
    if entry.name not in known:
        known[entry.name] = [_change(each, solution) for each in _with_it(entry, solution)]
    return known[entry.name]


def _with_it(entry: Entry, solution: Any) -> list[Assumed]:
    of = asked(solution)
    finer = entry.finer(of)
    if finer is not of:
        return [Assumed("", "", finer)]
    try:
        return entry.assume(of, [row.operating_point for row in rows_of(solution)])
    except SceneError:  # such as a ring larger than any
        return []


def _change(assumed: Assumed, solution: Any) -> Change:
    full = solution if assumed.of is asked(solution) else solution.solve_alike(assumed.of)
    errors, is_solved = by_quantity(solution, full), np.asarray(full.converged)
    return Change(assumed.under, assumed.what, errors, is_solved, moved(solution, full))


def asked(solution: Any) -> Any:
    """The scene or set of a solution."""
    return getattr(solution, "set", None) or solution.scene


def rows_of(solution: Any) -> Any:
    """The solutions of a set's rows, or the solution of a scene."""
    return getattr(solution, "rows", (solution,))
