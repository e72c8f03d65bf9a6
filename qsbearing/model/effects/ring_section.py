"""The height of a rectangle as wide as a ring's section and as stiff in bending, where the groove has shoulders.

Source        Second moment of area of a section whose height t varies along the axis: with its back straight,
              A = int t dx, S = 1/2 int t^2 dx, I = 1/3 int t^3 dx - S^2/A; a rectangle has I = B t^3/12
Assumes       the section bends as a whole, its back a cylinder; the groove's arc ends at each shoulder's diameter, and
              from there to the face the ring has that diameter
When not      a section that rolls about its circumference; finite elements of one pitch of B218's outer ring, its face
              held, deflect 1 to 15 % otherwise (`fem-check run elastic_ring`), without shoulders a quarter as far
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray


@cache
def _gauss() -> list[tuple[float, float]]:
    """Points from 0 to 1, and weights. Not at import: numpy loads its polynomials when they are first looked at."""
    points, weights = np.polynomial.legendre.leggauss(24)
    return list(zip(0.5 * (points + 1.0), 0.5 * weights, strict=True))


def bending_height(thickness: Any, width: Any, groove_radius: Any, shoulders: tuple[Any, Any]) -> NDArray:
    """Radial height [m] of the rectangle.

    Args:
        thickness: from the groove's bottom to the ring's back [m].
        width: of the ring [m].
        groove_radius: of the groove's profile [m].
        shoulders: heights of both above the groove's bottom [m]; 0 where there is none.
    """
    shape = np.broadcast_shapes(*map(np.shape, (thickness, width, groove_radius, *shoulders)))
    moments, thickness = np.zeros((3, *shape)), np.broadcast_to(thickness, shape)
    for shoulder in shoulders:
        height, half = np.asarray(shoulder, float), 0.5 * np.asarray(width, float)
        # By the angle around the groove: against x the arc is vertical at the groove's centre circle.
        face = np.arcsin(np.minimum(half / groove_radius, 1.0))
        edge = np.minimum(np.arccos(1.0 - height / groove_radius), face)
        for point, weight in _gauss():
            along = groove_radius * np.cos(point * edge)
            arc = thickness + groove_radius - along
            moments += weight * edge * along * np.stack(np.broadcast_arrays(*(arc**k for k in (1, 2, 3))))
        flat, high = half - groove_radius * np.sin(edge), thickness + height
        moments += flat * np.stack(np.broadcast_arrays(*(high**k for k in (1, 2, 3))))
    area, first, second = moments[0], 0.5 * moments[1], moments[2] / 3.0
    return np.asarray(np.cbrt(12.0 * (second - first**2 / area) / width))
