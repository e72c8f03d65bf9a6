"""What has become of a preload, of a bearing or of a row of a set: maintained, reduced, lost or excessive."""

from __future__ import annotations

from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.rounding import without_rounding

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
    REDUCED = "reduced"
    """In operation, external loads included, the bearing carries less than half of it."""
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
    rounding: Any = 0.0
    """Up to this size they are none: `qsbearing.model.solution.rounding`."""

    @property
    def arrays(self) -> tuple[NDArray, NDArray, NDArray]:
        """Given, alone and carried, of one shape; what is rounding as zero."""
        given, alone, carried, rounding = np.broadcast_arrays(*self)
        return tuple(without_rounding(each, rounding) for each in (given, alone, carried))  # type: ignore[return-value]


def states(of: PreloadLoads) -> NDArray:
    """`PreloadState` by its word; empty where not solved, and where nothing is given."""
    given, alone, carried = of.arrays
    out = np.full(given.shape, str(PreloadState.MAINTAINED), dtype=f"<U{max(map(len, PreloadState))}")
    with np.errstate(invalid="ignore"):
        out[carried < REDUCED * given] = PreloadState.REDUCED
        out[alone > EXCESSIVE * given] = PreloadState.EXCESSIVE
        out[carried < LOST * given] = PreloadState.LOST
        out[np.isnan(carried) | ~(given > 0.0)] = ""
    return out


def share(of: PreloadLoads) -> NDArray:
    """What of the given preload is there in operation without external loads; NaN where (next to) nothing is given."""
    given, alone, _ = of.arrays
    with np.errstate(over="ignore"):
        ratio = np.divide(alone, given, out=np.full(given.shape, np.nan), where=given > 0.0)
    return np.where(np.isinf(ratio), np.nan, ratio)
