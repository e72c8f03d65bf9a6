"""A stiffness as springs of finite-element programs, each on a combination of displacements.

    (K + K^T)/2 = sum over k of lambda_k v_k v_k^T

with the eigenvalues lambda_k and eigenvectors of the matrix in which tilts are multiplied by a length. Springs on each
displacement by itself, the diagonal of K, would leave out what couples them: they are 71 to 125 % off for the
deflection of a cantilever on a B218. What is not symmetric, as at speed with gyroscopic moments, no spring can have.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.tilt_lever import TiltLever
from qsbearing.model.solution.rounding import NOISE
from qsbearing.model.solution.solution import Solution


def from_shaft(solution: Solution, sign: float, arm: float = 0.0, *, by_middle: bool = False) -> NDArray:
    """G, which takes a displacement of the shaft to that of a bearing on it, as the solution counts it; shape (5, 5).

    Stiffness and loads about the place on the shaft are G^T K G and G^T F.

    Args:
        sign: -1 where the bearing carries in -x of the shaft.
        arm: of its balls' centres, from the place on the shaft [m].
        by_middle: the place is that of the plane of both grooves.
    """
    scene = solution.scene
    is_beyond = scene.tilt_lever is TiltLever.GROOVE_CENTRE and not by_middle
    own = scene.operating_bearing.groove_centre_offsets[0] if is_beyond else 0.0
    transform = np.diag([sign, 1.0, 1.0, sign, sign])
    transform[1, 4] = arm + sign * float(own)
    transform[2, 3] = -transform[1, 4]
    return transform


def combined_springs(stiffness: NDArray, length: float) -> tuple[NDArray, NDArray]:
    """Constants (n,) and combinations (n, 5) of the springs that are the symmetric part of a stiffness (5, 5).

    Args:
        length: makes tilts lengths, in the stiffness' unit.
    """
    scale = np.array([1.0, 1.0, 1.0, 1.0 / length, 1.0 / length])
    constants, vectors = np.linalg.eigh(0.5 * (stiffness + stiffness.T) * scale[:, None] * scale)
    vectors = np.where(np.abs(vectors) > NOISE, vectors, 0.0)
    some = np.abs(constants) > NOISE * np.abs(constants).max()
    return constants[some], (vectors / scale[:, None]).T[some]


def asymmetry(stiffness: NDArray, length: float) -> float:
    """The largest difference of two terms that a symmetric stiffness has alike, over the largest term."""
    scale = np.array([1.0, 1.0, 1.0, 1.0 / length, 1.0 / length])
    scaled = stiffness * scale[:, None] * scale
    return float(np.abs(scaled - scaled.T).max() / np.abs(scaled).max())
