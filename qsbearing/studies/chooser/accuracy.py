"""The error that choosing effects may leave, as `qs.solve` and `qs.solve_set` are asked for it; and arguments of theirs
that had another name."""

from __future__ import annotations

import warnings

from qsbearing.model.accuracy import COARSEST, DEFAULT_ACCURACY, FINEST


def requested_accuracy(effects: str | None, given: float | None, own: float | None) -> float | None:
    """The error that choosing effects may leave; None where they are those that are named.

    Args:
        effects: as `qs.solve` has it.
        given: as an argument.
        own: of the scene or set.

    Raises:
        ValueError: effects are neither chosen nor named, or the accuracy is out of range or without effects to choose.
    """
    if effects not in (None, "auto"):
        raise ValueError(f'effects = {effects!r}: "auto", or None for those that are named')
    if effects is None and own is None:
        if given is None:
            return None
        raise ValueError(
            f"accuracy = {given:g} is the error that choosing effects may leave: give effects='auto' too; the solver's "
            "own is residual_tolerance"
        )
    requested = next(each for each in (given, own, DEFAULT_ACCURACY) if each is not None)
    if not FINEST <= requested <= COARSEST:
        raise ValueError(f"accuracy = {requested:g}: must lie between {FINEST:g} and {COARSEST:g}")
    return requested


def renamed(old: str, by_old: float | None, new: str, by_new: float | None) -> float | None:
    """An argument of a public function that had another name, by whichever is given.

    Raises:
        ValueError: both are.
    """
    if by_old is None:
        return by_new
    if by_new is not None:
        raise ValueError(f"{old} and {new} are one argument: give {new} alone")
    warnings.warn(f"{old} is called {new} from 0.3.0 on", DeprecationWarning, stacklevel=3)
    return by_old
