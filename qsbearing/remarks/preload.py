"""Remarks about preloads that are lost, reduced or excessive, of a bearing or of a row of a set."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.preload_state import EXCESSIVE, REDUCED, PreloadLoads, PreloadState, states
from qsbearing.model.solution.rounding import rounding_of_load
from qsbearing.remarks.case_range import CaseRange
from qsbearing.remarks.kinds import CHECK, SEE_PRELOAD, Kind
from qsbearing.remarks.remark import Holding, Remark, remark


def preloads(of: CaseRange) -> Iterator[Holding]:
    """A preload that is held and has been lost, has fallen or, where this may be solved, has grown."""
    solution, preload = of.solution, of.solution.scene.preload
    if preload is None or preload.kind == "spring":
        return
    rounding = rounding_of_load(solution.load, solution.scene.bearing)
    at_rest = not_grown(solution.preload_at_rest, solution.load[..., 0], rounding)
    loads = solution.preload_loads if of.may_solve else at_rest
    if loads is None:
        return

    def stiffness() -> tuple[NDArray, NDArray]:
        mounted = solution.at_rest(True) or solution
        return of.cases(mounted.stiffness[..., 0, 0]), of.cases(solution.stiffness[..., 0, 0])

    def fitted() -> tuple[NDArray, NDArray]:
        return of.cases(solution.preload_unmounted), of.cases(solution.preload_mounted)

    yield from of_loads(PreloadLoads(*map(of.cases, loads)), preload.state, stiffness, fitted)


def not_grown(given: Any, carried: Any, rounding: Any) -> PreloadLoads:
    """Loads of which nobody has solved what is left without external ones: as if it were what is given."""
    return PreloadLoads(given, given, carried, np.broadcast_to(rounding, np.shape(carried)))


PRELOAD_LOST = Kind(
    "preload_lost", CHECK, SEE_PRELOAD,
    "Preload lost: {who} carries {carried_N:.4g} N in operation; its preload is {given_N:.4g} N {state}.",
)  # fmt: skip
PRELOAD_REDUCED = Kind(
    "preload_reduced", CHECK, SEE_PRELOAD,
    "Preload reduced: {cause} {who} only {carried_N:.4g} N of its preload of {given_N:.4g} N {state} "
    "({share_percent:.3g} %); its axial stiffness {stiffness_went} from {stiffness_mounted_N_per_um:.4g} N/µm "
    "mounted to {stiffness_N_per_um:.4g} N/µm.",
)  # fmt: skip
PRELOAD_EXCESSIVE = Kind(
    "preload_excessive", CHECK, SEE_PRELOAD,
    "Preload excessive: {who} is pressed by {unmounted_N:.4g} N before fitting, {mounted_N:.4g} N mounted and "
    "{in_operation_N:.4g} N in operation without external loads: more than {limit:g} times the given preload of "
    "{given_N:.4g} N.",
)  # fmt: skip


def of_loads(
    loads: PreloadLoads,
    state: str,
    stiffness: Callable[[], tuple[NDArray, NDArray]],
    fitted: Callable[[], tuple[NDArray, NDArray]],
) -> Iterator[Holding]:
    """Which of some cases have lost their preload, carry little of it or too much.

    Args:
        state: in which the preload is given.
        stiffness: axial, mounted and in operation [N/m].
        fitted: the loads by the preload alone, at rest and cold, before fitting and after [N].
    """
    words = states(loads)
    given, alone, carried = loads.arrays

    def lost(i: int) -> Remark:
        return remark(PRELOAD_LOST, carried_N=max(carried[i], 0.0), given_N=given[i], state=state)

    def reduced(i: int) -> Remark:
        before, now = (1e-6 * each[i] for each in stiffness())
        return remark(
            PRELOAD_REDUCED,
            cause="the loads leave" if alone[i] >= REDUCED * given[i] else "speed and heat leave",
            carried_N=carried[i], share_percent=100.0 * carried[i] / given[i], given_N=given[i], state=state,
            stiffness_went="fell" if now < before else "rose", stiffness_mounted_N_per_um=before,
            stiffness_N_per_um=now,
        )  # fmt: skip

    def excessive(i: int) -> Remark:
        unmounted, mounted = (each[i] for each in fitted())
        return remark(
            PRELOAD_EXCESSIVE,
            unmounted_N=unmounted, mounted_N=mounted, in_operation_N=alone[i], limit=EXCESSIVE,
            given_N=given[i],
        )  # fmt: skip

    yield words == PreloadState.LOST, lost
    yield words == PreloadState.REDUCED, reduced
    yield words == PreloadState.EXCESSIVE, excessive
