"""Warnings about expanded and elastic rings: fits lost, rings that yield or bend far, wedged balls, seats that part."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.messages.balls import Warnings
from qsbearing.model.effects.elastic_rings import grooves_of
from qsbearing.model.ranked_warning import check_data, wrong_model
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, um

HEAT = "how_to#heat-fits-and-rotation"
GIVE = "elastic_rings"


def expansion_warnings(solution: Solution, part: slice) -> Warnings:
    """For each kind of warning: which cases of a stretch have it, and the sentence for the i-th of them."""

    def cases(values: ArrayLike) -> NDArray:
        return np.broadcast_to(np.asarray(values, float), solution.shape).reshape(-1)[part]

    wedged = cases(solution.scene.operating_bearing.diametral_clearance) / um
    before = cases(solution.scene.bearing.diametral_clearance)

    def wedge(i: int) -> str:
        by = "The expansion is larger than the diametral clearance" if before[i] >= 0.0 else "The clearance is negative"
        return check_data(f"{by} by {-wedged[i]:.4g} µm: the balls are wedged between the rings.", HEAT)

    yield wedged < 0.0, wedge
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
                f"The stress of the {ring} ring is {stress[i] / MPa:.4g} MPa at its bore, above its yield strength of "
                f"{effect.yield_strength / MPa:.5g} MPa.",
                HEAT,
            )

        yield stress > effect.yield_strength, yields
        if state.seat_gap is None or state.seat_pressure is None:
            continue
        gap, interference = cases(state.seat_gap), cases(getattr(effect, f"{seat}_interference"))

        def lost(
            i: int, ring: str = ring, seat: str = seat, gap: NDArray = gap, interference: NDArray = interference
        ) -> str:
            return check_data(
                f"The fit of the {ring} ring is lost in operation: mounted with an interference of "
                f"{interference[i] / um:.4g} µm, it has a diametral clearance of {gap[i] / um:.4g} µm to the {seat}.",
                HEAT,
            )

        closed = cases(state.seat_pressure) < 0.0  # by the balls of elastic rings
        yield (interference > 0.0) & (gap > 0.0) & ~closed, lost


def _cases(values: NDArray, part: slice) -> NDArray:
    return np.asarray(values).reshape(-1)[part]


THIN = 0.5
"""Of a ring's thickness: a deflection beyond it is no small one any more (the usual limit of linear bending)."""


def give_warnings(solution: Solution, part: slice) -> Warnings:
    """Of elastic rings: a seat that parts from its ring somewhere, deflections that are not small."""
    rings = solution.scene.elastic_rings
    if rings is None:
        return
    grooves = grooves_of(solution.scene.operating_bearing)
    for side, seat, bottom, diameter in (
        ("inner", "shaft", grooves.inner_bottom, rings.bore_diameter),
        ("outer", "housing", grooves.outer_bottom, rings.outside_diameter),
    ):
        shape, state = getattr(solution, f"{side}_shape"), getattr(solution, f"{side}_ring")
        if shape is None:
            continue
        if shape.least_seat_pressure is not None:
            flag = getattr(rings, f"{seat}_touches")
            is_open = np.broadcast_to(False if flag is None else np.asarray(flag) == 0.0, solution.shape)
            fitted = 0.0 if state is None or state.seat_pressure is None else state.seat_pressure
            short = -(shape.least_seat_pressure + fitted).reshape(-1)[part]

            def parts(i: int, side: str = side, seat: str = seat, short: NDArray = short) -> str:
                return check_data(
                    f"The {side} ring would lift off the {seat} in places, unless the seat pressure of its fit were "
                    f"{short[i] / MPa:.3g} MPa larger: there it deflects more than computed.",
                    GIVE,
                )

            yield np.asarray(short > 0.0) & ~_cases(is_open, part), parts
            reach = np.maximum(shape.growth + shape.bending, 0.0)
            touching = is_open & (2.0 * reach > (0.0 if state is None or state.seat_gap is None else state.seat_gap))

            def touches(i: int, side: str = side, seat: str = seat) -> str:
                return check_data(
                    f"The {side} ring has clearance to the {seat} on average, but bends so far that it touches the "
                    f"{seat} in places: there it deflects less than computed.",
                    GIVE,
                )

            yield _cases(touching, part), touches
        if diameter is None:
            continue
        thickness = np.abs(0.5 * np.asarray(diameter, float) - np.asarray(bottom))
        large = np.asarray(shape.bending / thickness).reshape(-1)[part]

        def bends(i: int, side: str = side, large: NDArray = large) -> str:
            return wrong_model(
                f"The {side} ring bends by {large[i]:.2g} times its thickness, too far for small-deflection theory.",
                GIVE,
            )

        yield np.asarray(large > THIN), bends
