"""Ball sets that fit between two rings: usual ball sizes, and how full a pitch circle is."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.inference.data_sheet import DataSheet
from qsbearing.model.bearing import BearingKind
from qsbearing.model.units import mm

INCH_SIZES = 25.4 * mm * np.concatenate([np.arange(2, 37) / 64.0, np.arange(19, 96) / 32.0])
"""Steps of 1/64 inch up to 9/16 inch, of 1/32 above: nearly all balls of bearings."""
METRIC_SIZES = 0.5 * mm * np.arange(1, 151)
"""Of thin sections mostly."""
FILLS = {BearingKind.DEEP_GROOVE: (0.45, 0.80), BearingKind.ANGULAR_CONTACT: (0.60, 0.90)}
"""Z D/(pi dm)."""
HEIGHTS = {BearingKind.DEEP_GROOVE: (0.42, 0.72), BearingKind.ANGULAR_CONTACT: (0.38, 0.66)}
"""Ball diameter over the height of the section, (D - d)/2; of 231 spindle bearings 0.39 to 0.66."""


class BallSets(NamedTuple):
    """Ball counts with ball diameters [m], arrays of shape (set,)."""

    counts: NDArray
    diameters: NDArray

    def taken(self, which: NDArray) -> BallSets:
        """Those of a mask or of numbers."""
        return BallSets(self.counts[which], self.diameters[which])


def possible_sets(sheet: DataSheet, sizes: NDArray) -> BallSets:
    """Every set of these sizes between the rings; a known count or diameter is kept to, both whatever the room."""
    height, around = 0.5 * (sheet.outside_diameter - sheet.bore_diameter), pi * sheet.pitch
    low, high = (share * height for share in HEIGHTS[sheet.kind])
    least, most = (share * around for share in FILLS[sheet.kind])
    known, diameter = sheet.ball_count, sheet.ball_diameter
    if known is not None and diameter is not None:
        return BallSets(np.array([float(known)]), np.array([diameter]))
    sizes = sizes[(sizes >= low) & (sizes <= high)] if diameter is None else np.array([diameter])
    pairs = [(count, size) for size in sizes for count in np.arange(np.ceil(least / size), most / size)]
    possible = np.array([pair for pair in pairs if known in (None, pair[0])]).reshape(-1, 2)
    return BallSets(possible[:, 0], possible[:, 1])
