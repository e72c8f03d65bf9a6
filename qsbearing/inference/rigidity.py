"""The axial rigidity of a pair at its preload, and the groove radius that a printed one asks for."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.inference.data_sheet import RigidityKind
from qsbearing.inference.ratings_fit import secants
from qsbearing.model.bearing import BallBearing
from qsbearing.model.operation import Operation
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solver import solve

SCATTER = 0.0006
"""By how much the f of one printed rigidity of three digits may be off."""
STEEPNESS, RANGE = -20.0, (0.505, 0.58)
"""d ln K/df, about, and f that are believed."""
MET = 0.01
"""Part of the printed rigidity within which a set must have it at some groove radius."""


UNLOADING_MAKERS = ("snfa", "fag")
"""Who print the unloading rigidity. Of SNFA's series VEB, whose ball sets are printed, 201 of 252 numbers follow from
one groove radius within the printed digit; read as tangents they ask for no single one."""


def kind_of(maker: str, stated: RigidityKind | None) -> RigidityKind:
    """What a printed rigidity is, as stated or as its maker prints it."""
    is_unloading = maker.strip().lower() in UNLOADING_MAKERS
    return RigidityKind(stated or (RigidityKind.UNLOADING if is_unloading else RigidityKind.TANGENT))


def pair_rigidity(bearing: BallBearing, preload: ArrayLike, kind: RigidityKind = RigidityKind.TANGENT) -> NDArray:
    """The axial rigidity of a back-to-back pair at its preload, the contact angle free to change [N/m].

    The tangent is twice one bearing's stiffness under the preload; of the readings tried it follows the printed values
    of 145 rows. The unloading rigidity is the external load at which the relieved row is just free, while the other has
    twice its deflection, over that deflection (SNFA, general catalogue, p. 34).
    """
    solution = solve(Scene(bearing, Operation(axial_load=preload)))
    if kind == RigidityKind.TANGENT:
        return np.asarray(2.0 * solution.stiffness[..., 0, 0])
    deflection = np.asarray(solution.displacement[..., 0])
    unloading = solve(Scene(bearing, Operation(axial_displacement=2.0 * deflection)))
    return np.asarray(unloading.load[..., 0] / deflection)


def grooves_of_rigidity(
    made: Callable[[NDArray], BallBearing], rigidity: float, preload: float, kind: RigidityKind, start: NDArray
) -> tuple[NDArray, NDArray]:
    """f of each set with this rigidity: least, usual and largest, shape (set, 3); and which sets have it at all.

    Args:
        made: the bearings of all sets with these f, shape (set,).
    """

    def excess(f: NDArray) -> NDArray:
        return np.asarray(np.log(pair_rigidity(made(f), preload, kind) / rigidity))

    f = secants(excess, start, STEEPNESS, RANGE)
    return f[:, None] + SCATTER * np.array([-1.0, 0.0, 1.0]), np.abs(excess(f)) < MET
