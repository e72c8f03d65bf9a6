"""The rigid shaft: how its displacement moves each row, and how the rows' loads add up in its channels.

A row's displacement in its own frame is u = G q + offset, with q the shaft's five channels and the way that the sprung
outer rings slide. Loads travel back through the transpose: what the rows do to the shaft is the sum of G^T F.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.effects import RingExpansion
from qsbearing.effects.tilt_lever import TiltLever
from qsbearing.sets.bearing_set import BearingSet, Row
from qsbearing.sets.shaft import Shaft

UNKNOWNS = 6
"""Of a case: five channels of the shaft, and the slide of the sprung rings towards their balls."""
SLIDE = 5
SHAFT, HOUSING = 0, 1
"""Bodies that bearings are on and in."""


def lever(of: BearingSet, number: int) -> NDArray:
    """From the reference position to the plane in which a row's own load and displacement are meant [m].

    That is the plane of its inner groove centres, (fi - 1/2) D sin a0 past the balls' centres (19.3 has its origin
    there); with the pitch circle's tilt lever, which leaves the groove centres out, that of the balls' centres.
    """
    row = of.rows[number]
    place = arm_along(of, row.position)
    return np.asarray(place + own_lever(of, row))


def arm_along(of: BearingSet, position: ArrayLike) -> NDArray:
    """From the reference position to a place on the shaft, as warm as it is [m]."""
    return np.asarray(np.asarray(position, float) - of.reference + growth_along(of, position, SHAFT))


def own_lever(of: BearingSet, row: Row) -> Any:
    """From the balls' centres of a row to the plane in which its own load and displacement are meant [m]."""
    if of.tilt_lever is not TiltLever.GROOVE_CENTRE:
        return 0.0
    rings = expansion(of, row)
    moved = 0.0 if rings is None else rings.axial_growth(row.bearing)[0]
    return row.sign * (row.bearing.groove_centre_offsets[0] + moved)


def offset_in_operation(of: BearingSet, number: int, offset: NDArray) -> NDArray:
    """How far a row is pressed together while the shaft is at its zero, and as warm as it is in operation [m].

    What its offset was grows as the shaft. Inner rings move with the shaft, outer ones with the housing, both from the
    reference position.
    """
    row = of.rows[number]
    strain = seat_strains(of, row)[SHAFT]
    apart = growth_along(of, row.position, SHAFT) - growth_along(of, row.position, HOUSING)
    return np.asarray(offset * (1.0 + strain) + row.sign * apart)


def growth_along(of: BearingSet, position: ArrayLike, body: int) -> NDArray:
    """By how much heat moves a place in +x on the shaft or in the housing, counted from the reference position [m].

    Between two rows the body grows by the mean of its strains there, beyond the outermost by that there.
    """
    if body == SHAFT and of.shaft is not None and of.shaft.temperature is not None:
        return _growth_of_sections(of.shaft, of.reference, np.asarray(position, float))
    if all(expansion(of, row) is None for row in of.rows):
        return np.zeros(())
    positions, heats = zip(*((row.position, seat_strains(of, row)[body]) for row in of.rows), strict=True)
    numbers = np.array(np.broadcast_arrays(of.reference, position, *positions, *heats), float)
    (reference, place), places, strains = numbers[:2], numbers[2 : len(of.rows) + 2], numbers[len(of.rows) + 2 :]
    order = np.argsort(places, axis=0)
    places, strains = (np.take_along_axis(each, order, 0) for each in (places, strains))
    between = np.concatenate([strains[:1], 0.5 * (strains[1:] + strains[:-1]), strains[-1:]])
    beyond = np.full_like(places[:1], np.inf)
    low, high = np.concatenate([-beyond, places]), np.concatenate([places, beyond])
    return np.asarray((between * (np.clip(place, low, high) - np.clip(reference, low, high))).sum(axis=0))


def _growth_of_sections(shaft: Shaft, reference: NDArray, position: NDArray) -> NDArray:
    """Between the reference and a position, each section by its own strain."""
    ends = shaft.ends
    low, high = (np.clip(each[..., None], ends[:-1], ends[1:]) for each in (reference, position))
    return np.asarray(((high - low) * shaft.strains()).sum(axis=-1))


def seat_strains(of: BearingSet, row: Row) -> tuple[Any, Any]:
    """alpha dT of shaft and housing at a row."""
    rings = expansion(of, row)
    return (0.0, 0.0) if rings is None else rings.seat_strains(row.bearing)


def expansion(of: BearingSet, row: Row) -> RingExpansion | None:
    """The effect, where the row or the set names it."""
    return next((effect for effect in of.effects_of(row) if isinstance(effect, RingExpansion)), None)


def row_matrix(of: BearingSet, number: int, shape: tuple[int, ...]) -> NDArray:
    """G of a row over the flattened cases; shape (case, 5, 6)."""
    arm = np.broadcast_to(lever(of, number), shape).reshape(-1)
    sign = of.rows[number].sign
    matrix = np.zeros((arm.size, 5, UNKNOWNS))
    for i in (0, 3, 4):
        matrix[:, i, i] = sign
    matrix[:, 1, 1] = matrix[:, 2, 2] = 1.0
    matrix[:, 1, 4] = arm
    matrix[:, 2, 3] = -arm
    if of.rows[number].sprung:
        matrix[:, 0, SLIDE] = 1.0
    return matrix
