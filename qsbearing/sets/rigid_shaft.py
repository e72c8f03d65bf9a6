"""The rigid shaft: how its displacement moves each row, and how the rows' loads add up in its channels.

A row's displacement in its own frame is u = G q + offset, with q the shaft's five channels and the way that the sprung
outer rings slide. Loads travel back through the transpose: what the rows do to the shaft is the sum of G^T F.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.effects.tilt_lever import TiltLever
from qsbearing.sets.bearing_set import BearingSet

UNKNOWNS = 6
"""Of a case: five channels of the shaft, and the slide of the sprung rings towards their balls."""
SLIDE = 5


def lever(of: BearingSet, number: int) -> NDArray:
    """From the reference position to the plane in which a row's own load and displacement are meant [m].

    That is the plane of its inner groove centres, (fi - 1/2) D sin a0 past the balls' centres (19.3 has its origin
    there); with the pitch circle's tilt lever, which leaves the groove centres out, that of the balls' centres.
    """
    row = of.rows[number]
    place = np.asarray(row.position, float) - of.reference
    if of.tilt_lever is not TiltLever.GROOVE_CENTRE:
        return place
    bearing = row.bearing
    radius, diameter = np.asarray(bearing.inner_groove_radius, float), np.asarray(bearing.ball_diameter, float)
    return place + row.sign * (radius - 0.5 * diameter) * np.sin(np.asarray(bearing.free_contact_angle, float))


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
