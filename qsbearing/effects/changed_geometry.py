"""What follows when grooves move or balls grow: errors of leaving out what changes the bearing before it is loaded.

At an unchanged axial load contact angles follow the free one, by the turn dalpha: loads change by dalpha cot(alpha),
axial stiffness by twice that, and the ring moves as the position does in which it just touches. At an unchanged axial
position the contacts approach by that move times sin(alpha), and loads follow the power 3/2 of the approach.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.effects.entry import Errors
from qsbearing.effects.operating_point import OperatingPoint

SMALLEST_TANGENT = 0.05
"""Near alpha = 0 nothing carries the axial load that the cotangents rest on."""


def geometry_errors(point: OperatingPoint, turn: Any, offset: Any) -> Errors:
    """Errors of leaving out a change of the bearing.

    Args:
        point: where.
        turn: change of the free contact angle (*cases) [rad].
        offset: of the axial position in which the ring just touches [m].
    """
    solution = point.solution
    angle = np.maximum(np.abs(point.angle), np.radians(1.0))
    cotangent = 1.0 / np.maximum(np.tan(angle), SMALLEST_TANGENT)
    approach = point.at_largest_load(solution.inner.approach + solution.outer.approach)
    size = np.maximum(approach, np.abs(solution.displacement[..., :3]).max(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        closer = 1.5 * np.abs(offset) * np.sin(angle) / approach
        moved = np.abs(offset) / size
    held = point.axial_is_held
    load = closer if held else np.abs(turn) * cotangent
    found = {
        "contact_angle": np.abs(turn) / angle,
        "load": load,
        "pressure": load / 3.0,
        "displacement": 0.0 * moved if held else moved,
        "stiffness": load / 3.0 if held else 2.0 * np.abs(turn) * cotangent,
    }
    return {name: np.broadcast_to(error, solution.shape) for name, error in found.items()}


def change_of(point: OperatingPoint, coarser: Any) -> tuple[NDArray, NDArray]:
    """(turn, offset) of the point's scene against one that lacks an effect."""
    one, other = (np.asarray(each.free_contact_angle, float) for each in (point.bearing, coarser.operating_bearing))
    shift = np.asarray(point.scene.axial_datum_shift) - np.asarray(coarser.axial_datum_shift)
    return np.asarray(one - other), np.asarray(shift)
