"""Warnings about expanded rings: fits that are lost, rings that yield, balls that are wedged."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.messages.balls import Warnings
from qsbearing.ranked_warning import check_data, wrong_model
from qsbearing.solution.solution import Solution
from qsbearing.units import MPa, um

HEAT = "how_to#heat-fits-and-rotation"


def expansion_warnings(solution: Solution, part: slice) -> Warnings:
    """For each kind of warning: which cases of a stretch have it, and the sentence for the i-th of them."""

    def cases(values: ArrayLike) -> NDArray:
        return np.broadcast_to(np.asarray(values, float), solution.shape).reshape(-1)[part]

    wedged = cases(solution.scene.operating_bearing.diametral_clearance) / um
    yield (
        wedged < 0.0,
        lambda i: check_data(
            f"The expansion has taken up all clearance and {-wedged[i]:.4g} um more (diametral): the balls are wedged.",
            HEAT,
        ),
    )
    effect = solution.scene.ring_expansion
    if effect is None:
        return
    for ring, seat, state in (
        ("inner", "shaft", solution.inner_ring),
        ("outer", "housing", solution.outer_ring),
    ):
        if state is None:
            continue
        stress = cases(state.equivalent_stress)

        def yields(i: int, ring: str = ring, stress: NDArray = stress) -> str:
            return wrong_model(
                f"The {ring} ring is stressed by {stress[i] / MPa:.4g} MPa at its bore, beyond its yield strength of "
                f"{effect.yield_strength / MPa:.5g} MPa.",
                HEAT,
            )

        yield stress > effect.yield_strength, yields
        if state.seat_gap is None:
            continue
        gap, interference = cases(state.seat_gap), cases(getattr(effect, f"{seat}_interference"))

        def lost(
            i: int, ring: str = ring, seat: str = seat, gap: NDArray = gap, interference: NDArray = interference
        ) -> str:
            return check_data(
                f"The fit of the {ring} ring is lost in operation: mounted with {interference[i] / um:.4g} um, it "
                f"stands {gap[i] / um:.4g} um (diametral) off the {seat}.",
                HEAT,
            )

        yield (interference > 0.0) & (gap > 0.0), lost
