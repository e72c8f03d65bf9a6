"""What an effect would change of a solution that lacks it, and the other members of a choice: found by solving the
scene or set with each.

Where an effect's parameters are not known, usual ones are assumed (`Entry.assume`). A solve takes about as long as the
first one did, and is right where an estimate is not: under radial loads bent rings share the load anew.

Balls that friction moves do not know some effects. What these change is found under outer control, by a solve without
and one with them. What friction gives is moved by as much, or in proportion where its sign is no direction
(`beside_friction`): rings that bend are in series with contacts, whose stiffness is another under friction.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import Entry
from qsbearing.model.effects.entry import Assumed, has_size
from qsbearing.model.effects.hypotheses import FRICTION, under_control
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.solution.of_cases import solve_alike
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
    solution: Any = None
    """With it, of few cases; None where nothing was solved."""
    against: Any = None
    """The solution under outer control that `solution` is compared with, where balls that friction moves do not know
    it; displacement and stiffness are then `beside_friction`. None else."""

    @property
    def largest(self) -> NDArray:
        """Of all quantities that can be told; infinite where one has or loses its number."""
        return np.asarray(
            np.max([np.nan_to_num(each, nan=0.0, posinf=np.inf) for each in self.errors.values()], axis=0)
        )


_KNOWN: WeakKeyDictionary[Any, dict[str, list[Change]]] = WeakKeyDictionary()
"""A solution is asked for its remarks more than once, and for each of its cases."""
_UNDER_OUTER: WeakKeyDictionary[Any, Any] = WeakKeyDictionary()
"""Of solutions whose balls friction moves."""


def changes(entry: Entry, solution: Any) -> list[Change]:
    """What an effect changes, for each assumption about its parameters; empty where nothing can be told.

    Args:
        solution: of a scene or set that lacks the effect, and not of a row of a set.
    """
    known = _KNOWN.setdefault(solution, {})
    if entry.name not in known:
        base = _judged_at(entry, solution)
        known[entry.name] = [_beside(_change(each, base), base, solution) for each in _with_it(entry, base)]
    return known[entry.name]


def is_unknown_to_friction(entry: Entry, solution: Any) -> bool:
    """Whether friction moves the balls, and an effect or a member of a choice goes with hypotheses alone."""
    of = requested(solution)
    if of.raceway_control != FRICTION or entry.hypothesis or not entry.applies(of):
        return False
    members = entry.switch.members
    if members is None:
        return not entry.goes_with_friction
    return len(members.others(under_control(of, RacewayControl.OUTER))) > len(members.others(of))


def _judged_at(entry: Entry, solution: Any) -> Any:
    """The solution, or that under outer control."""
    if not is_unknown_to_friction(entry, solution):
        return solution
    if solution not in _UNDER_OUTER:
        under = under_control(requested(solution), RacewayControl.OUTER)
        _UNDER_OUTER[solution] = solve_alike(solution, under)
    return _UNDER_OUTER[solution]


def _beside(change: Change, base: Any, solution: Any) -> Change:
    """A change of another solution, as that of this one, whose cases are those of a law of friction besides."""
    if base is solution or change.displacement is None or change.stiffness is None:
        return change
    own = np.diagonal(solution.stiffness, axis1=-2, axis2=-1)
    is_known = np.asarray(base.converged)
    errors = {name: np.where(is_known, each, 0.0) for name, each in change.errors.items()}
    return replace(
        change,
        errors={name: np.broadcast_to(each, solution.shape) for name, each in errors.items()},
        is_solved=np.broadcast_to(change.is_solved & is_known, solution.shape),
        displacement=beside_friction(solution.displacement, base.displacement, change.displacement, True),
        stiffness=beside_friction(own, np.diagonal(base.stiffness, axis1=-2, axis2=-1), change.stiffness, False),
        against=base,
    )


def beside_friction(own: Any, without: Any, with_it: Any, is_signed: bool) -> NDArray:
    """What friction gives, with the change by an effect that it does not know: from one number under outer control to
    another.

    Args:
        is_signed: the sign is a direction, so that the number may pass through zero: it changes by as much; else in
            proportion, where there is something.
    """
    own, without, with_it = np.asarray(own, float), np.asarray(without, float), np.asarray(with_it, float)
    by_difference = own + (with_it - without)
    if is_signed:
        return by_difference
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(without == 0.0, by_difference, own * (with_it / without))


def alternatives(entry: Entry, solution: Any) -> list[Change]:
    """What the other members of a choice change; empty where it does not apply.

    Of a hypothesis, and of a scene with the finest member, every other one relative to the solution; else the scene's
    own, relative to the finest.

    Args:
        solution: of a scene or set, and not of a row of a set.
    """
    known = _KNOWN.setdefault(solution, {})
    if entry.name not in known:
        base = _judged_at(entry, solution)
        known[entry.name] = [_beside(each, base, solution) for each in _against_others(entry, base)]
    return known[entry.name]


def known_changes(solution: Any) -> dict[str, list[Change]]:
    """What has been found so far, by the names of effects and choices."""
    return _KNOWN.get(solution, {})


MOST_KEPT = 64
"""Cases of a solution that is kept (chosen: more points than a load spectrum has)."""


def _against_others(entry: Entry, solution: Any) -> list[Change]:
    members = entry.switch.members
    others = [] if members is None else members.others(requested(solution))
    finest = None if members is None else members.finest
    by_it = [each for each in others if finest is not None and getattr(each.of, entry.switch.slot) == finest]
    solutions = [(each, solve_alike(solution, each.of)) for each in by_it or others]
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
    full = solution if assumed.of is requested(solution) else solve_alike(solution, assumed.of)
    return _made(assumed, by_quantity(solution, full), full)


def _made(assumed: Assumed, errors: dict[str, NDArray], other: Any) -> Change:
    tangent = np.diagonal(other.stiffness, axis1=-2, axis2=-1)
    kept = other if np.prod(other.shape) <= MOST_KEPT else None
    return Change(assumed.under, assumed.what, errors, np.asarray(other.converged), other.displacement, tangent, kept)


def requested(solution: Any) -> Any:
    """The scene or set of a solution."""
    return getattr(solution, "set", None) or solution.scene


def rows_of(solution: Any) -> Any:
    """The solutions of a set's rows, or the solution of a scene."""
    return getattr(solution, "rows", (solution,))


def has_size_for(entry: Entry, solution: Any) -> bool:
    """Whether bore, outside diameter and width of all that lack the effect are known, so that nobody asks for them."""
    return all(has_size(row.scene) for row in rows_of(solution) if not entry.is_in(row.scene))
