"""Up to how many times its loads a set keeps its preload."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from qsbearing.scene.operation import CHANNELS
from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.preload_search import Change, changes, firsts, opposed_errors, sentence
from qsbearing.solution.preload_state import PreloadState
from qsbearing.validation import RATIO, ErrorDetail, SceneError, within

LOST = str(PreloadState.LOST)
MOST = 10.0
"""Times the loads of the set: further nobody asks."""


@dataclass(frozen=True)
class PreloadLoad:
    """The least multiple of the loads at which a row's preload is no longer maintained."""

    factor: float
    """Times every load and moment on the shaft; 0: speed alone does it."""
    row: int
    """From 0; -1 where the set has no equilibrium and no row is to blame."""
    state: str
    """lost; no_equilibrium or not_converged where the set is not solved any more."""
    sentence: str


def preload_loads(of: BearingSet, highest: float = MOST, *, threads: int | None = None) -> list[PreloadLoad]:
    """The multiples of the loads on the shaft, up to the highest given, above which some row loses its preload.

    All loads and moments grow together, the preload and all else stay. A preload counts as lost below 1 % of
    what is given. What changes and changes back between two of the 64 multiples tried is not seen, nor what comes after
    the first without an equilibrium.

    Returns:
        At most one of each row and state, the least first; empty where all rows keep their preload.

    Raises:
        SceneError: a highest multiple that is none, arrays in the set, no load, or rows that all carry in one
            direction.
    """
    found = firsts(load_changes(of, highest, threads))
    return [PreloadLoad(each.value, each.row, each.after, load_sentence(of, each)) for each in found]


def load_changes(of: BearingSet, highest: float = MOST, threads: int | None = None) -> list[Change]:
    """Everything that becomes of the preload up to this multiple, what comes back included; else likewise."""
    errors = within("highest", highest, RATIO, 1e-6, 1e6) + opposed_errors(of)
    if not loads_of(of):
        errors.append(ErrorDetail("operation", "has no load or moment that could grow"))
    if errors:
        raise SceneError(errors)
    found = changes(lambda factors: loaded(of, factors), float(highest), threads)
    # A preload is excessive without any load.
    return [each for each in found if PreloadState.EXCESSIVE not in (each.before, each.after) or each.after == LOST]


def loads_of(of: BearingSet) -> dict[str, Any]:
    """The loads and moments on the shaft that are not zero, by their fields."""
    given = {channel.load: getattr(of.operation, channel.load) for channel in CHANNELS}
    return {name: value for name, value in given.items() if value is not None and np.any(np.asarray(value) != 0.0)}


def loaded(of: BearingSet, factors: ArrayLike) -> BearingSet:
    """The set under these multiples of its loads, without its readings."""
    loads = {name: np.asarray(value, float) * factors for name, value in loads_of(of).items()}
    return replace(of, operation=replace(of.operation, **loads), readings={})


def load_sentence(of: BearingSet, change: Change) -> str:
    """What changes at which multiple of the loads."""
    return sentence(of, change, f"at {change.value:.3g} times the loads", "before any load acts")
