"""The clearance of deep groove ball bearings before they are mounted, by class and bore (ISO 5753-1).

Up to 140 mm the limits are those of printed copies, which a test compares; beyond, none was at hand.
"""

from __future__ import annotations

from bisect import bisect_left
from enum import StrEnum

from qsbearing.model.units import mm, um


class ClearanceClass(StrEnum):
    """From the tightest to the loosest."""

    C2 = "C2"
    CN = "CN"
    """Normal: no designation tells it."""
    C3 = "C3"
    C4 = "C4"
    C5 = "C5"


_CLASSES = tuple(ClearanceClass)
_LIMITS = {
    10: ((0, 7), (2, 13), (8, 23), (14, 29), (20, 37)),
    18: ((0, 9), (3, 18), (11, 25), (18, 33), (25, 45)),
    24: ((0, 10), (5, 20), (13, 28), (20, 36), (28, 48)),
    30: ((1, 11), (5, 20), (13, 28), (23, 41), (30, 53)),
    40: ((1, 11), (6, 20), (15, 33), (28, 46), (40, 64)),
    50: ((1, 11), (6, 23), (18, 36), (30, 51), (45, 73)),
    65: ((1, 15), (8, 28), (23, 43), (38, 61), (55, 90)),
    80: ((1, 15), (10, 30), (25, 51), (46, 71), (65, 105)),
    100: ((1, 18), (12, 36), (30, 58), (53, 84), (75, 120)),
    120: ((2, 20), (15, 41), (36, 66), (61, 97), (90, 140)),
    140: ((2, 23), (18, 48), (41, 81), (71, 114), (105, 160)),
    160: ((2, 23), (18, 53), (46, 91), (81, 130), (120, 180)),
    180: ((2, 25), (20, 61), (53, 102), (91, 147), (135, 200)),
    200: ((2, 30), (25, 71), (63, 117), (107, 163), (150, 230)),
}
"""Least and largest clearance [um] of C2, CN, C3, C4 and C5 by the largest bore [mm] for which they hold."""
SMALLEST = 6.0 * mm
"""The bore above which the first line of the table has all five."""


def clearance_limits(bore: float, of: ClearanceClass) -> tuple[float, float] | None:
    """Least and largest diametral clearance [m] of a bore diameter [m]; None where the table does not reach."""
    steps = sorted(_LIMITS)
    step = bisect_left(steps, bore / mm - 1e-9)
    if not bore >= SMALLEST - 1e-9 or step == len(steps):
        return None
    least, most = _LIMITS[steps[step]][_CLASSES.index(of)]
    return least * um, most * um
