"""Remarks about preloads that are lost, reduced or excessive, of a bearing or of a row of a set."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.preload_state import EXCESSIVE, REDUCED, PreloadLoads, PreloadState, states
from qsbearing.model.solution.rounding import rounding_of_load
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.remark import Found, Remark, remark


def preload_remarks(solution: Solution, part: slice, may_solve: bool) -> Iterator[Found]:
    """A preload that is held and has been lost, has fallen or, where this may be solved, has grown."""
    preload = solution.scene.preload
    if preload is None or preload.kind == "spring":
        return
    rounding = rounding_of_load(solution.load, solution.scene.bearing)
    at_rest = not_grown(solution.preload_at_rest, solution.load[..., 0], rounding)
    loads = solution.preload_loads if may_solve else at_rest
    if loads is None:
        return

    def cases(values: Any) -> NDArray:
        return np.broadcast_to(values, solution.shape).reshape(-1)[part]

    def stiffness() -> tuple[NDArray, NDArray]:
        mounted = solution.at_rest(True) or solution
        return cases(mounted.stiffness[..., 0, 0]), cases(solution.stiffness[..., 0, 0])

    def fitted() -> tuple[NDArray, NDArray]:
        return cases(solution.preload_unmounted), cases(solution.preload_mounted)

    yield from of_loads(PreloadLoads(*map(cases, loads)), preload.state, stiffness, fitted)


def not_grown(given: Any, carried: Any, rounding: Any) -> PreloadLoads:
    """Loads of which nobody has solved what is left without external ones: as if it were what is given."""
    return PreloadLoads(given, given, carried, np.broadcast_to(rounding, np.shape(carried)))


def of_loads(
    loads: PreloadLoads,
    state: str,
    stiffness: Callable[[], tuple[NDArray, NDArray]],
    fitted: Callable[[], tuple[NDArray, NDArray]],
) -> Iterator[Found]:
    """Likewise of the loads of some cases.

    Args:
        state: in which the preload is given.
        stiffness: axial, mounted and in operation [N/m].
        fitted: the loads by the preload alone, at rest and cold, before fitting and after [N].
    """
    words = states(loads)
    given, alone, carried = loads.arrays

    def lost(i: int) -> Remark:
        return remark("preload_lost", carried_N=max(carried[i], 0.0), given_N=given[i], state=state)

    def reduced(i: int) -> Remark:
        before, now = (1e-6 * each[i] for each in stiffness())
        return remark(
            "preload_reduced",
            cause="the loads leave" if alone[i] >= REDUCED * given[i] else "speed and heat leave",
            carried_N=carried[i], share_percent=100.0 * carried[i] / given[i], given_N=given[i], state=state,
            stiffness_went="fell" if now < before else "rose", stiffness_mounted_N_per_um=before,
            stiffness_N_per_um=now,
        )  # fmt: skip

    def excessive(i: int) -> Remark:
        unmounted, mounted = (each[i] for each in fitted())
        return remark(
            "preload_excessive",
            unmounted_N=unmounted, mounted_N=mounted, in_operation_N=alone[i], limit=EXCESSIVE,
            given_N=given[i],
        )  # fmt: skip

    yield words == PreloadState.LOST, lost
    yield words == PreloadState.REDUCED, reduced
    yield words == PreloadState.EXCESSIVE, excessive
