"""Remarks about the shape of rings: wedged balls, fits lost, rings that yield or bend far, seats with gaps or lobes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.elastic_rings import grooves_of
from qsbearing.model.material import Material, expansion_holds, is_own_expansion
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, um, zero_celsius
from qsbearing.remarks.case_range import CaseRange, Subject
from qsbearing.remarks.kinds import CHECK, NOTE, SEE_HEAT, SEE_RINGS, SEE_ROUND, WRONG, Kind
from qsbearing.remarks.remark import Holding, Remark, remark
from qsbearing.remarks.wording import listed

EXPANSION = Subject()

BALLS_WEDGED = Kind(
    "balls_wedged", CHECK, SEE_HEAT,
    "The expansion is larger than the diametral clearance by {interference_um:.4g} µm: the balls are wedged "
    "between the rings.",
)  # fmt: skip
CLEARANCE_NEGATIVE = Kind(
    "clearance_negative", CHECK, SEE_HEAT,
    "The clearance is negative by {interference_um:.4g} µm: the balls are wedged between the rings.",
)  # fmt: skip


@EXPANSION.tells
def _wedged(of: CaseRange) -> Iterator[Holding]:
    scene = of.solution.scene
    if not scene.is_reshaped:
        return
    wedged = of.cases(scene.operating_bearing.diametral_clearance) / um
    before = of.cases(scene.bearing.diametral_clearance)
    yield (wedged < 0.0) & (before >= 0.0), lambda i: remark(BALLS_WEDGED, interference_um=-wedged[i])
    yield (wedged < 0.0) & (before < 0.0), lambda i: remark(CLEARANCE_NEGATIVE, interference_um=-wedged[i])


LOBES_WEDGE = Kind(
    "lobes_wedge", CHECK, SEE_ROUND,
    "The lobes of the seats bring the raceways up to {nearer_um:.4g} µm nearer at a ball, more than the radial "
    "clearance of {clearance_um:.4g} µm: balls are wedged between rings that stand centred.",
)  # fmt: skip
LOBES_TURN = Kind(
    "lobes_turn", NOTE, SEE_ROUND,
    "The lobes of {raceways:the} ring turn with it: the results are of the instant at which the phases are as given "
    "and the first ball is at its azimuth.",
)  # fmt: skip


@EXPANSION.tells
def _lobes(of: CaseRange) -> Iterator[Holding]:
    """Of seats out of round: what they leave of the clearance, and which of them turn."""
    solution, seats = of.solution, of.solution.scene.seats_out_of_round
    if seats is None:
        return
    nearer = of.rows(seats.apart(solution.azimuth)).max(axis=-1)
    room = 0.5 * of.cases(solution.scene.operating_bearing.diametral_clearance)

    def wedged(i: int) -> Remark:
        return remark(LOBES_WEDGE, nearer_um=nearer[i] / um, clearance_um=room[i] / um)

    yield (nearer > room) & (room >= 0.0), wedged
    operation = solution.scene.operation
    outer = 0.0 if operation.outer_speed is None else operation.outer_speed
    for side, speed in (("inner", operation.speed), ("outer", outer)):
        turns = of.cases(speed) != 0.0
        yield turns & of.cases(seats.is_out_of_round_at(side), bool), remark(LOBES_TURN, side)


EXPANSION_FAR = Kind(
    "expansion_far", CHECK, SEE_HEAT,
    "Far from room temperature ({parts}: {temperature_C:.4g} °C), this program's coefficients of expansion do not "
    "hold. From {least_C:.4g} to {most_C:.4g} °C they are within 10 % of the mean between 20 °C and there; below "
    "they are too large (of steel 1.4 times at -196 °C, 1.7 times at -253 °C), above too small. Give the material "
    "as a table, with thermal_expansion_per_K = its mean from the reference temperature to there.",
)  # fmt: skip


def far_from_room_temperature(of: CaseRange, bodies: Iterable[tuple[str, Any, Material]]) -> Iterator[Holding]:
    """Where this program's coefficients of expansion do not hold.

    Args:
        bodies: names, temperatures [K] and materials of what grows by heat.
    """
    known = [(name, np.asarray(warm, float), material) for name, warm, material in bodies]
    limits = {name: expansion_holds(material) for name, _, material in known}
    beyond = {
        name: of.cases(
            np.where(is_own_expansion(material), np.maximum(limits[name][0] - warm, warm - limits[name][1]), -1.0)
        )
        for name, warm, material in known
    }
    if not beyond:
        return
    warmth = {name: of.cases(warm) for name, warm, _ in known}

    def far(i: int) -> Remark:
        parts = [name for name, by in beyond.items() if by[i] > 0.0]
        farthest = max(parts, key=lambda name: beyond[name][i])
        least, most = (limit - zero_celsius for limit in limits[farthest])
        warm = warmth[farthest][i] - zero_celsius
        return remark(EXPANSION_FAR, parts=listed(parts), temperature_C=warm, least_C=least, most_C=most)

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


@EXPANSION.tells
def _far(of: CaseRange) -> Iterator[Holding]:
    if of.solution.scene.is_reshaped:
        yield from far_from_room_temperature(of, _bodies(of.solution))


RING_YIELDS = Kind(
    "ring_yields", WRONG, SEE_HEAT,
    "The stress of {raceways:the} ring is {stress_MPa:.4g} MPa at its bore, above its yield strength of "
    "{yield_strength_MPa:.5g} MPa.",
)  # fmt: skip
FIT_LOST = Kind(
    "fit_lost", CHECK, SEE_HEAT,
    "The fit of {raceways:the} ring is lost in operation: mounted with an interference of {interference_um:.4g} "
    "µm, it has a diametral clearance of {clearance_um:.4g} µm to the {seat}.",
)  # fmt: skip


@EXPANSION.tells
def _fits(of: CaseRange) -> Iterator[Holding]:
    """Rings that yield, fits that are lost."""
    solution, effect = of.solution, of.solution.scene.ring_expansion
    if not solution.scene.is_reshaped or effect is None:
        return
    strength = of.cases(effect.yield_strength)
    for ring, seat, state in (
        ("inner", "shaft", solution.inner_ring),
        ("outer", "housing", solution.outer_ring),
    ):
        if state is None:
            continue
        stress = of.cases(state.equivalent_stress)

        def yields(i: int, ring: str = ring, stress: NDArray = stress) -> Remark:
            limit = strength[i] / MPa
            return remark(RING_YIELDS, ring, stress_MPa=stress[i] / MPa, yield_strength_MPa=limit)

        yield stress > strength, yields
        if state.seat_gap is None or state.seat_pressure is None:
            continue
        gap, interference = of.cases(state.seat_gap), of.cases(getattr(effect, f"{seat}_interference"))

        def lost(
            i: int, ring: str = ring, seat: str = seat, gap: NDArray = gap, interference: NDArray = interference
        ) -> Remark:
            lengths = {"interference_um": interference[i] / um, "clearance_um": gap[i] / um}
            return remark(FIT_LOST, ring, seat=seat, **lengths)

        closed = of.cases(state.seat_pressure) < 0.0  # by the balls of elastic rings
        yield (interference > 0.0) & (gap > 0.0) & ~closed, lost


THIN = 0.5
"""Of a ring's thickness: a deflection beyond it is no small one any more (the usual limit of linear bending)."""
SEAT_PARTS = Kind(
    "seat_parts", CHECK, SEE_RINGS,
    "{raceways:The} ring would lift off the {seat} in places, unless the seat pressure of its fit were "
    "{pressure_MPa:.3g} MPa larger: there it deflects more than computed.",
)  # fmt: skip
SEAT_TOUCHES = Kind(
    "seat_touches", CHECK, SEE_RINGS,
    "{raceways:The} ring has clearance to the {seat} on average, but bends so far that it touches the {seat} in "
    "places: there it deflects less than computed.",
)  # fmt: skip
RING_BENDS_FAR = Kind(
    "ring_bends_far", WRONG, SEE_RINGS,
    "The bending of {raceways:the} ring is {deflection_over_thickness:.2g} times its thickness, too much for "
    "small-deflection theory.",
)  # fmt: skip


@EXPANSION.tells
def _bending(of: CaseRange) -> Iterator[Holding]:
    """Of elastic rings: a seat that opens somewhere under its ring, deflections that are not small."""
    solution, rings = of.solution, of.solution.scene.elastic_rings
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
            is_open = np.asarray(False if flag is None else np.asarray(flag) == 0.0)
            fitted = 0.0 if state is None or state.seat_pressure is None else state.seat_pressure
            short = -of.cases(shape.least_seat_pressure + fitted)

            def parts(i: int, side: str = side, seat: str = seat, short: NDArray = short) -> Remark:
                return remark(SEAT_PARTS, side, seat=seat, pressure_MPa=short[i] / MPa)

            yield (short > 0.0) & ~of.cases(is_open, bool), parts
            reach = np.maximum(shape.growth + shape.bending, 0.0)
            touching = is_open & (2.0 * reach > (0.0 if state is None or state.seat_gap is None else state.seat_gap))

            yield of.cases(touching, bool), remark(SEAT_TOUCHES, side, seat=seat)
        if diameter is None:
            continue
        thickness = np.abs(0.5 * np.asarray(diameter, float) - np.asarray(bottom))
        large = of.cases(shape.bending / thickness)

        def bends(i: int, side: str = side, large: NDArray = large) -> Remark:
            return remark(RING_BENDS_FAR, side, deflection_over_thickness=large[i])

        yield large > THIN, bends
