"""Life of a set from the lives of its rows.

Rows fail independently and each life is Weibull's with Lundberg and Palmgren's slope e = 10/9 for point contact, as the
raceways of one row combine (ISO/TS 16281):

    L = (sum over rows of Lr^-e)^(-1/e)
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

SLOPE = 10.0 / 9.0
"""Of the Weibull distribution of ball bearings' lives (Lundberg & Palmgren 1947)."""


def system_life(lives: Iterable[ArrayLike]) -> NDArray:
    """Life that all rows survive together with the reliability that each has alone; shape of the lives broadcast.

    In the lives' unit: times, or revolutions where all rows turn alike. Never above the weakest row's.

    Returns:
        Life of all together, in the unit of the lives.

    Examples:
        >>> print(f"{qs.system_life([10_000.0, 10_000.0]):.0f}")
        5359
    """
    each = np.stack(np.broadcast_arrays(*(np.asarray(life, float) for life in lives)))
    weakest = each.min(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        total = weakest * (np.where(each == weakest, 1.0, (each / weakest) ** -SLOPE)).sum(axis=0) ** (-1.0 / SLOPE)
    return np.asarray(np.where(np.isinf(weakest), np.inf, total))
