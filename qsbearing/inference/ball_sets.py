"""Ball sets that fit between two rings: usual ball sizes, and how full a pitch circle is."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.inference import iso15
from qsbearing.inference.data_sheet import DataSheet, SizeSteps
from qsbearing.model.bearing import BearingKind
from qsbearing.model.units import mm

INCH_SIZES = 25.4 * mm * np.concatenate([np.arange(2, 37) / 64.0, np.arange(19, 96) / 32.0])
"""Steps of 1/64 inch up to 9/16 inch, of 1/32 above: nearly all balls of bearings."""
METRIC_SIZES = 0.5 * mm * np.arange(1, 151)
"""Of deep groove bearings of dimension series 18, beside those in inches."""
SAME_SIZE = 0.001
"""Part of a diameter within which a size in millimetres is one in inches: 29/64 inch stands for 11.5 mm."""
FILLS = {BearingKind.DEEP_GROOVE: (0.45, 0.80), BearingKind.ANGULAR_CONTACT: (0.60, 0.90)}
"""Z D/(pi dm)."""
THIN_FILL = 0.55
"""The least of angular-contact bearings of dimension series 18."""
STEEP, STEEP_FILL = np.radians(35.0), 0.98
"""The free contact angle [rad] above which bearings, of 40 degrees, are filled so far: 7310 BEP 0.91."""
HEIGHTS = {BearingKind.DEEP_GROOVE: (0.42, 0.72), BearingKind.ANGULAR_CONTACT: (0.38, 0.66)}
"""Ball diameter over the height of the section, (D - d)/2; of 231 spindle bearings 0.39 to 0.66."""
ROOM = 1.002
"""The least distance of neighbouring ball centres over the ball diameter: of full fills the arc tells too little."""


class BallSets(NamedTuple):
    """Ball counts with ball diameters [m], arrays of shape (set,)."""

    counts: NDArray
    diameters: NDArray

    def taken(self, which: NDArray) -> BallSets:
        """Those of a mask or of numbers."""
        return BallSets(self.counts[which], self.diameters[which])


def is_thin(sheet: DataSheet) -> bool:
    """Whether bore and outside diameter are of ISO 15's dimension series 18; none but the table tells it from 19."""
    return iso15.series_of(sheet.bore_diameter / mm, sheet.outside_diameter / mm) == "18"


def sizes_of(sheet: DataSheet) -> NDArray:
    """The ball diameters [m] that are looked at, as stated; else in inches, of thin deep groove bearings in both."""
    both = sheet.kind == BearingKind.DEEP_GROOVE and is_thin(sheet)
    if (sheet.size_steps or (SizeSteps.ANY if both else SizeSteps.INCH)) == SizeSteps.INCH:
        return INCH_SIZES
    nearest = np.abs(METRIC_SIZES[:, None] / INCH_SIZES - 1.0).min(axis=1)
    return np.concatenate([INCH_SIZES, METRIC_SIZES[nearest > SAME_SIZE]])


def fills_of(sheet: DataSheet) -> tuple[float, float]:
    """The least and largest fill."""
    least, most = FILLS[sheet.kind]
    if sheet.kind == BearingKind.ANGULAR_CONTACT:
        least = THIN_FILL if is_thin(sheet) else least
        most = STEEP_FILL if (sheet.free_contact_angle or 0.0) > STEEP else most
    return least, most


def possible_sets(sheet: DataSheet, sizes: NDArray, fills: tuple[float, float] | None = None) -> BallSets:
    """Every set of these sizes between the rings; a known count or diameter is kept to, both whatever the room.

    Args:
        fills: the least and largest; None: the usual ones.
    """
    height, around = 0.5 * (sheet.outside_diameter - sheet.bore_diameter), pi * sheet.pitch
    low, high = (share * height for share in HEIGHTS[sheet.kind])
    least, most = (share * around for share in fills or fills_of(sheet))
    known, diameter = sheet.ball_count, sheet.ball_diameter
    if known is not None and diameter is not None:
        return BallSets(np.array([float(known)]), np.array([diameter]))
    sizes = sizes[(sizes >= low) & (sizes <= high)] if diameter is None else np.array([diameter])
    pairs = [(count, size) for size in sizes for count in np.arange(max(np.ceil(least / size), 2.0), most / size)]
    possible = np.array([pair for pair in pairs if known in (None, pair[0])]).reshape(-1, 2)
    sets = BallSets(possible[:, 0], possible[:, 1])
    return sets.taken(sheet.pitch * np.sin(pi / sets.counts) > ROOM * sets.diameters)
