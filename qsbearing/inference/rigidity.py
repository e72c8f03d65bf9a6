"""The axial rigidity of a pair at its preload, and the groove radius that a printed one asks for."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.inference.ratings_fit import secants
from qsbearing.model.bearing import BallBearing
from qsbearing.model.operation import Operation
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solver import solve

SCATTER = 0.0006
"""By how much the f of one printed rigidity of three digits may be off."""
STEEPNESS, RANGE = -20.0, (0.505, 0.56)
"""d ln K/df, about, and f that are believed."""
MET = 0.01
"""Part of the printed rigidity within which a set must have it at some groove radius."""


def pair_rigidity(bearing: BallBearing, preload: ArrayLike) -> NDArray:
    """Twice one bearing's axial stiffness at its preload, the contact angle free to change [N/m].

    What catalogues call axial rigidity: of the readings tried this one follows the printed values of 145 rows.
    """
    solution = solve(Scene(bearing, Operation(axial_load=preload)))
    return np.asarray(2.0 * solution.stiffness[..., 0, 0])


def grooves_of_rigidity(
    made: Callable[[NDArray], BallBearing], rigidity: float, preload: float, start: NDArray
) -> tuple[NDArray, NDArray]:
    """f of each set with this rigidity: least, usual and largest, shape (set, 3); and which sets have it at all.

    Args:
        made: the bearings of all sets with these f, shape (set,).
    """

    def excess(f: NDArray) -> NDArray:
        return np.asarray(np.log(pair_rigidity(made(f), preload) / rigidity))

    f = secants(excess, start, STEEPNESS, RANGE)
    return f[:, None] + SCATTER * np.array([-1.0, 0.0, 1.0]), np.abs(excess(f)) < MET
