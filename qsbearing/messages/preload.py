"""Warnings about preloads that are lost, reduced or excessive, of a bearing or of a row of a set."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.messages.balls import Warnings
from qsbearing.model.ranked_warning import RankedWarning, check_data
from qsbearing.model.solution.preload_state import EXCESSIVE, PreloadLoads, PreloadState, is_reduced, share, states
from qsbearing.model.solution.solution import Solution


def preload_warnings(solution: Solution, part: slice) -> Warnings:
    """A preload that is held and has been lost, has fallen or has grown."""
    preload, found = solution.scene.preload, solution.preload_loads
    if preload is None or preload.kind == "spring" or found is None:
        return

    def cases(values: Any) -> NDArray:
        return np.broadcast_to(values, solution.shape).reshape(-1)[part]

    loads = PreloadLoads(*map(cases, found))
    words, who = states(loads), "the bearing"

    def of(i: int) -> PreloadLoads:
        return PreloadLoads(*(float(each[i]) for each in loads))

    def stiffness(each: Solution, i: int) -> float:
        return float(cases(each.stiffness[..., 0, 0])[i])

    yield words == PreloadState.LOST, lambda i: lost(who, of(i), preload.state)
    yield (
        is_reduced(loads),
        lambda i: reduced(
            *(who, of(i), preload.state),
            *(stiffness(solution._at_rest(True) or solution, i), stiffness(solution, i)),
        ),
    )
    yield (
        words == PreloadState.EXCESSIVE,
        lambda i: excessive(
            *(who, of(i)), *(float(cases(each)[i]) for each in (solution.preload_unmounted, solution.preload_mounted))
        ),
    )


def lost(who: str, of: PreloadLoads, state: str) -> RankedWarning:
    """Of one case.

    Args:
        who: what bearing.
        state: in which the preload is given.
    """
    left = max(of.carried, 0.0)
    return check_data(
        f"Preload lost: {who} carries {left:.4g} N in operation; its preload is {of.given:.4g} N {state}.",
        "sets#preload",
    )


def reduced(who: str, of: PreloadLoads, state: str, before: float, now: float) -> RankedWarning:
    """Likewise.

    Args:
        before, now: its axial stiffness, mounted and in operation [N/m].
    """
    went = "fell" if now < before else "rose"
    return check_data(
        f"Preload reduced: {who} carries {of.carried:.4g} N in operation, {100.0 * float(share(of)):.2g} % of its "
        f"preload of {of.given:.4g} N {state}; its axial stiffness {went} from {1e-6 * before:.4g} N/µm mounted to "
        f"{1e-6 * now:.4g} N/µm.",
        "sets#preload",
    )


def excessive(who: str, of: PreloadLoads, unmounted: float, mounted: float) -> RankedWarning:
    """Likewise.

    Args:
        unmounted, mounted: by the preload alone, at rest and cold, before fitting and after [N].
    """
    return check_data(
        f"Preload excessive: {who} is pressed by {unmounted:.4g} N before fitting, {mounted:.4g} N mounted and "
        f"{of.alone:.4g} N in operation without external loads: more than {EXCESSIVE:g} times the given preload of "
        f"{of.given:.4g} N.",
        "sets#preload",
    )
