"""Where a bearing stands in a structural model: the directions of its axes, and the point that positions count from.

Displacements, rotations, forces and moments are vectors, all turned by the same matrix R, whose rows are the directions
of the bearing's x, y, z in the model: of a stiffness K that acts on (displacements, rotations)

    K_model = T^T K T,   T = diag(R, R)
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

ROUNDING = 1e-12
"""Parts of a direction that are smaller are none."""


class ModelFrame(NamedTuple):
    """In a program's unit of length."""

    origin: NDArray
    """Of the positions of rows, in the model; shape (3,)."""
    directions: NDArray
    """Of the bearing's x (its axis), y and z in the model, one a row; shape (3, 3)."""

    @property
    def is_own(self) -> bool:
        """Whether the model's axes and origin are those of the bearing."""
        return bool((self.directions == np.eye(3)).all()) and not self.origin.any()

    def place(self, position: float) -> NDArray:
        """The point of a position along the shaft, in the model; shape (3,)."""
        return np.asarray(self.origin + position * self.directions[0])

    def vector(self, own: ArrayLike) -> NDArray:
        """A vector of the bearing in the model's axes; shape (..., 3)."""
        return np.asarray(np.asarray(own, float) @ self.directions)


OWN = ModelFrame(np.zeros(3), np.eye(3))
"""x along the shaft, from where its positions count."""


def directions_of(axis: ArrayLike) -> NDArray:
    """Directions of x, y, z of a bearing whose axis has this direction in the model; shape (3, 3), one a row.

    y is the model's axis that follows, in the order x, y, z, x, the one nearest to the bearing's axis, or what of it is
    across: along z, they are z, x, y of the model, as in programs of rotor dynamics; along x, they are its own.

    Args:
        axis: of any length but 0; shape (3,).
    """
    along = np.asarray(axis, float) / np.linalg.norm(axis)
    next_one = np.eye(3)[(int(np.argmax(np.round(np.abs(along), 12))) + 1) % 3]
    across = next_one - (next_one @ along) * along
    across /= np.linalg.norm(across)
    directions = np.array([along, across, np.cross(along, across)])
    return np.where(np.abs(directions) > ROUNDING, directions, 0.0)


def in_model(stiffness: NDArray, directions: NDArray) -> NDArray:
    """A stiffness (6, 6) of displacements and rotations in the model's axes."""
    turn = np.kron(np.eye(2), directions)
    return np.asarray(turn.T @ stiffness @ turn)
