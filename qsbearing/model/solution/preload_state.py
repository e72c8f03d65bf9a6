"""What has become of a preload, of a bearing or of a row of a set: maintained, lost or excessive."""

from __future__ import annotations

from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

LOST = 0.01
"""A bearing that carries less than this part of its preload has lost it (chosen: in practice nothing)."""
REDUCED = 0.5
"""Below this part of it, what is left is worth a sentence (chosen: stiffness at rest follows the cube root of the load,
and has lost a fifth)."""
EXCESSIVE = 3.0
"""A preload is excessive when it is this many times the given one (chosen: makers' light, medium and heavy preloads are
1 : 3 : 6, as GMN's are: a light one has become a medium one, unasked)."""


class PreloadState(StrEnum):
    """What has become of a preload."""

    MAINTAINED = "maintained"
    LOST = "lost"
    """In operation, external loads included, the bearing carries next to nothing."""
    EXCESSIVE = "excessive"
    """Without external loads the bearing carries in operation a multiple of what is given."""


class PreloadLoads(NamedTuple):
    """Axial loads of a bearing; numbers or arrays of one shape [N]."""

    given: Any
    """By the preload alone, at rest and cold, in the state in which it is given: before fitting, or mounted."""
    alone: Any
    """In operation, without external loads."""
    carried: Any
    """In operation, with them."""


def states(of: PreloadLoads) -> NDArray:
    """`PreloadState` by its word; empty where not solved."""
    given, alone, carried = np.broadcast_arrays(*of)
    out = np.full(given.shape, str(PreloadState.MAINTAINED), dtype=f"<U{max(map(len, PreloadState))}")
    with np.errstate(invalid="ignore"):
        pressed = given > 0.0
        out[pressed & (alone > EXCESSIVE * given)] = PreloadState.EXCESSIVE
        out[pressed & (carried < LOST * given)] = PreloadState.LOST
    out[np.isnan(carried) | np.isnan(given)] = ""
    return out


def share(of: PreloadLoads) -> NDArray:
    """What is carried over what is given; NaN where nothing is given, or next to nothing."""
    given, _, carried = np.broadcast_arrays(*of)
    with np.errstate(over="ignore"):
        found = np.divide(carried, given, out=np.full(given.shape, np.nan), where=given > 0.0)
    return np.where(np.isinf(found), np.nan, found)


def is_reduced(of: PreloadLoads) -> NDArray:
    """Where a preload is maintained, but for less than half."""
    with np.errstate(invalid="ignore"):
        return np.asarray((states(of) == PreloadState.MAINTAINED) & (share(of) < REDUCED))
