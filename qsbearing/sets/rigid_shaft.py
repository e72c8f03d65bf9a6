"""The rigid shaft: how its displacement moves each row, and how the rows' loads add up in its channels.

A row's displacement in its own frame is u = G q + offset, with q the shaft's five channels and the way that the sprung
outer rings slide. Loads travel back through the transpose: what the rows do to the shaft is the sum of G^T F.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.effects.tilt_lever import TiltLever
from qsbearing.sets.axial_growth import SHAFT, expansion, growth_along
from qsbearing.sets.bearing_set import BearingSet, Row

UNKNOWNS = 6
"""Of a case: five channels of the shaft, and the slide of the sprung rings towards their balls."""
SLIDE = 5


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


def row_matrix(of: BearingSet, number: int, shape: tuple[int, ...]) -> NDArray:
    """G of a row over the flattened cases; shape (case, 5, unknown): after the first ones, how far in +x each floating
    group's sleeve slides."""
    arm = np.broadcast_to(lever(of, number), shape).reshape(-1)
    sign = of.rows[number].sign
    matrix = np.zeros((arm.size, 5, UNKNOWNS + len(of.floating)))
    for i in (0, 3, 4):
        matrix[:, i, i] = sign
    matrix[:, 1, 1] = matrix[:, 2, 2] = 1.0
    matrix[:, 1, 4] = arm
    matrix[:, 2, 3] = -arm
    if of.rows[number].sprung:
        matrix[:, 0, SLIDE] = 1.0
    for column, group in enumerate(of.floating, UNKNOWNS):
        if number + 1 in group.rows:
            matrix[:, 0, column] = -sign
    return matrix
