"""Remarks about expanded and elastic rings: fits lost, rings that yield or bend far, wedged balls, seats that part."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.effects.elastic_rings import grooves_of
from qsbearing.model.material import Material, expansion_holds, is_own_expansion
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, um, zero_celsius
from qsbearing.remarks.remark import Found, Remark, remark
from qsbearing.remarks.wording import listed


def far_from_room_temperature(
    bodies: Iterable[tuple[str, Any, Material]], shape: tuple[int, ...], part: slice
) -> Iterator[Found]:
    """Where this program's coefficients of expansion do not hold.

    Args:
        bodies: names, temperatures [K] and materials of what grows by heat.
    """
    known = [(name, np.asarray(warm, float), of) for name, warm, of in bodies]
    limits = {name: expansion_holds(of) for name, _, of in known}
    beyond = {
        name: np.broadcast_to(
            np.where(is_own_expansion(of), np.maximum(limits[name][0] - warm, warm - limits[name][1]), -1.0), shape
        ).reshape(-1)[part]
        for name, warm, of in known
    }
    if not beyond:
        return
    warmth = {name: np.broadcast_to(warm, shape).reshape(-1)[part] for name, warm, _ in known}

    def far(i: int) -> Remark:
        parts = [name for name, by in beyond.items() if by[i] > 0.0]
        farthest = max(parts, key=lambda name: beyond[name][i])
        least, most = (limit - zero_celsius for limit in limits[farthest])
        warm = warmth[farthest][i] - zero_celsius
        return remark("expansion_far", parts=listed(parts), temperature_C=warm, least_C=least, most_C=most)

    yield np.max([*beyond.values()], axis=0) > 0.0, far


def _bodies(solution: Solution) -> Iterator[tuple[str, Any, Material]]:
    """What grows in a bearing: shaft and housing with their rings, as their lengths hold a preload."""
    scene, rings = solution.scene, solution.scene.ring_expansion
    for body, each in scene.temperatures.items():
        if body == "balls":
            yield body, each.value, scene.bearing.ball_material
        elif rings is not None:
            own = getattr(rings, f"{body}_material", None)
            yield body.replace("_", " "), each.value, own or scene.bearing.ring_material


def expansion_remarks(solution: Solution, part: slice) -> Iterator[Found]:
    """Balls that are wedged, rings that yield, fits that are lost."""

    def cases(values: ArrayLike) -> NDArray:
        return np.broadcast_to(np.asarray(values, float), solution.shape).reshape(-1)[part]

    wedged = cases(solution.scene.operating_bearing.diametral_clearance) / um
    before = cases(solution.scene.bearing.diametral_clearance)
    yield (wedged < 0.0) & (before >= 0.0), lambda i: remark("balls_wedged", interference_um=-wedged[i])
    yield (wedged < 0.0) & (before < 0.0), lambda i: remark("clearance_negative", interference_um=-wedged[i])
    yield from far_from_room_temperature(_bodies(solution), solution.shape, part)
    effect = solution.scene.ring_expansion
    if effect is None:
        return
    strength = cases(effect.yield_strength)
    for ring, seat, state in (
        ("inner", "shaft", solution.inner_ring),
        ("outer", "housing", solution.outer_ring),
    ):
        if state is None:
            continue
        stress = cases(state.equivalent_stress)

        def yields(i: int, ring: str = ring, stress: NDArray = stress) -> Remark:
            limit = strength[i] / MPa
            return remark("ring_yields", ring, stress_MPa=stress[i] / MPa, yield_strength_MPa=limit)

        yield stress > strength, yields
        if state.seat_gap is None or state.seat_pressure is None:
            continue
        gap, interference = cases(state.seat_gap), cases(getattr(effect, f"{seat}_interference"))

        def lost(
            i: int, ring: str = ring, seat: str = seat, gap: NDArray = gap, interference: NDArray = interference
        ) -> Remark:
            lengths = {"interference_um": interference[i] / um, "clearance_um": gap[i] / um}
            return remark("fit_lost", ring, seat=seat, **lengths)

        closed = cases(state.seat_pressure) < 0.0  # by the balls of elastic rings
        yield (interference > 0.0) & (gap > 0.0) & ~closed, lost


def _cases(values: NDArray, part: slice) -> NDArray:
    return np.asarray(values).reshape(-1)[part]


THIN = 0.5
"""Of a ring's thickness: a deflection beyond it is no small one any more (the usual limit of linear bending)."""


def bending_remarks(solution: Solution, part: slice) -> Iterator[Found]:
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

            def parts(i: int, side: str = side, seat: str = seat, short: NDArray = short) -> Remark:
                return remark("seat_parts", side, seat=seat, pressure_MPa=short[i] / MPa)

            yield np.asarray(short > 0.0) & ~_cases(is_open, part), parts
            reach = np.maximum(shape.growth + shape.bending, 0.0)
            touching = is_open & (2.0 * reach > (0.0 if state is None or state.seat_gap is None else state.seat_gap))

            yield _cases(touching, part), remark("seat_touches", side, seat=seat)
        if diameter is None:
            continue
        thickness = np.abs(0.5 * np.asarray(diameter, float) - np.asarray(bottom))
        large = np.asarray(shape.bending / thickness).reshape(-1)[part]

        def bends(i: int, side: str = side, large: NDArray = large) -> Remark:
            return remark("ring_bends_far", side, deflection_over_thickness=large[i])

        yield np.asarray(large > THIN), bends
