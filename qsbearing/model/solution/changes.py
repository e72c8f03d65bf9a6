"""What an effect would change of a solution that lacks it, and the other members of a choice: found by solving the
scene or set with each.

Where an effect's parameters are not known, usual ones are assumed (`Entry.assume`). A solve takes about as long as the
first one did, and is right where an estimate is not: under radial loads bent rings share the load anew.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import Entry
from qsbearing.model.effects.entry import Assumed, has_size
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.validation import SceneError


@dataclass(frozen=True)
class Change:
    """By one solve with the effect; arrays of shape (*cases)."""

    under: str
    """As of `Assumed`; empty where nothing is assumed or one thing alone."""
    what: str
    """What is assumed, as of `Assumed`; empty where nothing is, or one thing alone."""
    errors: dict[str, NDArray]
    """What leaving it out changes, by quantity, relative to the solution with it; of a choice what another member
    changes, relative to the solution that it is judged by."""
    is_solved: NDArray
    """Whether there is a solution with it."""
    displacement: NDArray | None = None
    """With it; shape (*cases, 5), as of a solution. None where nothing was solved."""
    stiffness: NDArray | None = None
    """The diagonal of the stiffness with it; shape (*cases, 5). None where nothing was solved."""

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


def alternatives(entry: Entry, solution: Any) -> list[Change]:
    """What the other members of a choice change; empty where it does not apply.

    Of a hypothesis, and of a scene with the finest member, every other one relative to the solution; else the scene's
    own, relative to the finest.

    Args:
        solution: of a scene or set, and not of a row of a set.
    """
    known = _KNOWN.setdefault(solution, {})
    if entry.name not in known:
        known[entry.name] = _against_others(entry, solution)
    return known[entry.name]


def _against_others(entry: Entry, solution: Any) -> list[Change]:
    members = entry.switch.members
    others = [] if members is None else members.others(requested(solution))
    finest = None if members is None else members.finest
    by_it = [each for each in others if finest is not None and getattr(each.of, entry.switch.slot) == finest]
    solutions = [(each, solution.solve_alike(each.of)) for each in by_it or others]
    if entry.hypothesis:
        solutions = [(each, solution if _is_same(other, solution) else other) for each, other in solutions]
    return [
        _made(each, by_quantity(solution, other) if by_it else by_quantity(other, solution), other)
        for each, other in solutions
    ]


def _is_same(one: Any, other: Any) -> bool:
    """Whether solutions by two hypotheses agree to the last digit, as where Jones's criterion gives all balls to the
    raceway that controls them anyway: nothing is read off twice."""
    return all(
        np.array_equal(getattr(one, name), getattr(other, name), equal_nan=name != "status")
        for name in ("displacement", "load", "status")
    )


def _with_it(entry: Entry, solution: Any) -> list[Assumed]:
    of = requested(solution)
    finer = entry.finer(of)
    if finer is not of:
        return [Assumed("", "", finer)]
    try:
        return entry.assume(of, [row.operating_point for row in rows_of(solution)])
    except SceneError:  # such as a ring larger than any
        return []


def _change(assumed: Assumed, solution: Any) -> Change:
    full = solution if assumed.of is requested(solution) else solution.solve_alike(assumed.of)
    return _made(assumed, by_quantity(solution, full), full)


def _made(assumed: Assumed, errors: dict[str, NDArray], other: Any) -> Change:
    tangent = np.diagonal(other.stiffness, axis1=-2, axis2=-1)
    return Change(assumed.under, assumed.what, errors, np.asarray(other.converged), other.displacement, tangent)


def requested(solution: Any) -> Any:
    """The scene or set of a solution."""
    return getattr(solution, "set", None) or solution.scene


def rows_of(solution: Any) -> Any:
    """The solutions of a set's rows, or the solution of a scene."""
    return getattr(solution, "rows", (solution,))


def has_size_for(entry: Entry, solution: Any) -> bool:
    """Whether bore, outside diameter and width of all that lack the effect are known, so that nobody asks for them."""
    return all(has_size(row.scene) for row in rows_of(solution) if not entry.is_in(row.scene))
