"""The rigid shaft: how its displacement moves each row, and how the rows' loads add up in its channels.

A row's displacement in its own frame is u = G q + offset, with q the shaft's five channels and the way that the sprung
outer rings slide. Loads travel back through the transpose: what the rows do to the shaft is the sum of G^T F.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.effects.tilt_lever import TiltLever
from qsbearing.systems.sets.axial_growth import SHAFT, expansion
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.location import sliding
from qsbearing.systems.sets.row import ONE_WAY, Row

UNKNOWNS = 6
"""Of a case: five channels of the shaft, and the slide of the sprung rings towards their balls."""
SLIDE = 5


def one_way_rings(of: Any) -> dict[int, int]:
    """The number of the row, from 0, of each unknown that is a ring held against one side."""
    first = UNKNOWNS + len(of.floating)
    return {first + i: number for i, number in enumerate(sliding(of)) if of.rows[number].carries in ONE_WAY}


def arms_along(of: BearingSet, positions: Sequence[ArrayLike], shape: tuple[int, ...]) -> NDArray:
    """From the reference position to places on the shaft, as warm as it is; shape (case or 1, position) [m]."""
    places = np.stack(np.broadcast_arrays(*(np.asarray(each, float) for each in positions)))
    places = places.reshape(len(places), *(1,) * (len(shape) + 1 - places.ndim), *places.shape[1:])
    arms = np.asarray(places - of.reference + of.growth[SHAFT](places))
    if arms.size == len(places):
        return arms.reshape(1, -1)
    return np.broadcast_to(arms, (len(places), *shape)).reshape(len(places), -1).T


def own_lever(of: BearingSet, row: Row) -> Any:
    """From the position of a row to the plane in which its own load and displacement are meant [m]: none of a row that
    stands by its middle, where its inner groove centres are."""
    is_two_sided = next(both for each, both in zip(of.rows, of.is_two_sided, strict=True) if each is row)
    if of.tilt_lever is not TiltLever.GROOVE_CENTRE or is_two_sided:
        return 0.0
    rings = expansion(of, row)
    moved = 0.0 if rings is None else rings.axial_growth(row.bearing)[0]
    return row.sign * (row.bearing.groove_centre_offsets[0] + moved)


def row_matrices(of: BearingSet, shape: tuple[int, ...]) -> NDArray:
    """G of the rows over the flattened cases; shape (row, case, 5, unknown): after the first ones, how far in +x each
    sleeve slides.

    A row's own load and displacement are meant in the plane of its inner groove centres, (fi - 1/2) D sin a0 past the
    balls' centres (19.3 has its origin there); with the pitch circle's tilt lever, which leaves the groove centres out,
    in that of the balls' centres.
    """
    count = math.prod(shape)
    arms = np.broadcast_to(arms_along(of, [row.position for row in of.rows], shape), (count, len(of.rows)))
    matrices = np.zeros((len(of.rows), count, 5, UNKNOWNS + len(of.sleeves)))
    matrices[..., 1, 1] = matrices[..., 2, 2] = 1.0
    for number, row in enumerate(of.rows):
        matrix, own = matrices[number], np.asarray(own_lever(of, row))
        arm = arms[:, number] + (own if own.ndim == 0 else np.broadcast_to(own, shape).reshape(-1))
        matrix[:, (0, 3, 4), (0, 3, 4)] = row.sign
        matrix[:, 1, 4], matrix[:, 2, 3] = arm, -arm
        if row.sprung:
            matrix[:, 0, SLIDE] = 1.0
        for column, sleeve in enumerate(of.sleeves, UNKNOWNS):
            if number in sleeve:
                matrix[:, 0, column] = -row.sign
    return matrices
