"""From the axes of a bearing to those of programs of rotor dynamics, and what becomes of the tilts.

    rotor       x         y         z          alpha (about x)   beta (about y)
    bearing     y         z         x (axis)   tilt y            tilt z

Both are right-handed, and the shaft turns about the axis itself in both: the five coordinates change places and no
sign changes. ROSS counts alpha and beta as right-handed rotations, as its beam shows: in a slope beta = dx/dz, in
the other alpha = -dy/dz.

A bearing mounted the other way round on the same shaft is the mirror image in a plane across the shaft. A mirror
reverses what points along the axis and rotations about x and y, but not the shaft's own rotation: z, alpha and beta
change sign. (Half a turn about a radial axis would reverse the shaft's rotation as well, and with it whatever the
gyroscopic moment brings into the stiffness.)
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.ring_stiffness import SOFTEST

NAMES = ("x", "y", "z", "alpha", "beta")
"""The rotor's coordinates; the last two are rotations."""
CHANNEL = np.array([1, 2, 0, 3, 4])
"""Of each of them, its number among the bearing's channels."""
MIRROR = np.array([1.0, 1.0, -1.0, -1.0, -1.0])
MOVED, TILTED = slice(0, 3), slice(3, 5)


class Tilt(StrEnum):
    """What stands for the tilts of a bearing in a rotor's model."""

    INCLUDED = "included"
    """The whole matrix: moments answer tilts, and both are coupled with the translations."""
    HELD = "held"
    """Translations alone, at the node's slope of zero: the matrix's own block. Couplings with tilts are left out."""
    FREE = "free"
    """Translations alone, the tilts free to follow so that no moment is carried: what a bearing in a seat that swivels
    has (static condensation)."""


def in_rotor_axes(stiffness: NDArray, *, mirrored: bool = False) -> NDArray:
    """A stiffness (..., 5, 5) [N/m, N/rad, N m/rad] in the order x, y, z, alpha, beta of a rotor.

    Args:
        stiffness: in the order of a solution: x, y, z, tilt y, tilt z.
        mirrored: the bearing is mounted the other way round: it carries a thrust on the shaft in -z.
    """
    turned = np.asarray(stiffness, float)[..., CHANNEL[:, None], CHANNEL]
    return turned * MIRROR[:, None] * MIRROR if mirrored else turned


def is_tilt_supported(stiffness: NDArray) -> NDArray:
    """Whether the bearing resists both tilts, so that they can be left free; shape (...).

    Args:
        stiffness: in rotor axes.
    """
    sizes = np.linalg.svd(stiffness[..., TILTED, TILTED], compute_uv=False)
    return np.asarray(sizes[..., -1] > SOFTEST * sizes[..., 0])


def translations(stiffness: NDArray, tilt: Tilt) -> NDArray:
    """The stiffness (..., 3, 3) that is left of translations alone, the tilts held or free.

    Args:
        stiffness: in rotor axes.
    """
    moved = stiffness[..., MOVED, MOVED]
    if tilt is Tilt.FREE:
        follow = np.linalg.solve(stiffness[..., TILTED, TILTED], stiffness[..., TILTED, MOVED])
        moved = moved - stiffness[..., MOVED, TILTED] @ follow
    return moved


def load_centres(stiffness: NDArray) -> NDArray:
    """Where on the axis a radial load tilts nothing, from the middle of the bearing; shape (..., 2) [m].

    Of a load along x and of one along y: where the contact lines meet the axis, for a row under thrust at rest. There
    the tilts of a bearing decouple from its radial motion, so that a node there loses least without them. NaN where no
    ball is loaded.

    Args:
        stiffness: in rotor axes.
    """
    coupling = np.stack([stiffness[..., 4, 0], -stiffness[..., 3, 1]], axis=-1)
    radial = np.stack([stiffness[..., 0, 0], stiffness[..., 1, 1]], axis=-1)
    return np.divide(coupling, radial, out=np.full_like(coupling, np.nan), where=radial != 0.0)
