"""Ranges over the bearings that a data sheet allows, and what part of them one more known number would remove."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Range(NamedTuple):
    """Of a result over all cases."""

    least: float
    most: float
    least_case: int
    most_case: int

    @property
    def width(self) -> float:
        """From the least to the largest."""
        return self.most - self.least


def range_of(values: NDArray) -> Range:
    """The least and largest, and the cases that have them; NaN in no case that is solved."""
    if not np.isfinite(values).any():
        return Range(np.nan, np.nan, 0, 0)
    low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
    return Range(float(values[low]), float(values[high]), low, high)


def shares_removed(
    values: NDArray, set_number: NDArray, groups: Mapping[str, NDArray], rigidity: NDArray | None
) -> dict[str, float]:
    """What part of the range each of these would remove, on average over the ball sets.

    Args:
        groups: numbers that would be known exactly, by name; those of cases, shape (case,).
        rigidity: that each case would have, in place of which one is known; None: it is known already.
    """
    width = range_of(values).width
    shares = {}
    for name, known in groups.items():
        left = [range_of(values[known == known[set_number == each][0]]).width for each in np.unique(set_number)]
        shares[name] = _share(left, width)
    if rigidity is not None:
        left = [_width_at(each, values, set_number, rigidity) for each in rigidity]
        shares["pair_rigidity"] = _share(left, width)
    return shares


def _width_at(known: float, values: NDArray, set_number: NDArray, rigidity: NDArray) -> float:
    """The range over those sets that have this rigidity, each at the groove radius that gives it."""
    there = []
    for each in np.unique(set_number):
        cases = np.flatnonzero(set_number == each)
        cases = cases[np.argsort(rigidity[cases])]
        low, high = rigidity[cases[[0, -1]]]
        if low * (1.0 - 1e-9) <= known <= high * (1.0 + 1e-9):
            there.append(np.interp(known, rigidity[cases], values[cases]))
    return range_of(np.array(there)).width if there else 0.0


def _share(left: list[float], width: float) -> float:
    """Of a range that is wide enough to speak of."""
    mean = float(np.nanmean(left)) if np.isfinite(left).any() else np.nan
    return min(max(1.0 - mean / width, 0.0), 1.0) if width > 0.0 and np.isfinite(mean) else 0.0
