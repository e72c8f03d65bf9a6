"""Tables of digits against other prints of the same numbers, typed from these: seats, tolerances and clearances of
bearings."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.fits import deviations, fit
from qsbearing.inference.clearance import ClearanceClass, clearance_limits

LONGXI = [6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500]
"""Ranges up to [mm], from 3 mm: Fujian Longxi, Fits of radial spherical plain bearings, both tables."""
LONGXI_SHAFTS = {  # upper, then lower
    "g6": ([-4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20],
           [-12, -14, -17, -20, -25, -29, -34, -39, -44, -49, -54, -60]),
    "h6": ([0] * 12, [-8, -9, -11, -13, -16, -19, -22, -25, -29, -32, -36, -40]),
    "k6": ([9, 10, 12, 15, 18, 21, 25, 28, 33, 36, 40, 45], [1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5]),
    "m6": ([12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63], [4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23]),
}  # fmt: skip
LONGXI_HOLES = {  # lower, then upper, from 10 mm on
    "H7": ([0] * 10, [18, 21, 25, 30, 35, 40, 46, 52, 57, 63]),
    "K7": ([-12, -15, -18, -21, -25, -28, -33, -36, -40, -45], [6, 6, 7, 9, 10, 12, 13, 16, 17, 18]),
    "M7": ([-18, -21, -25, -30, -35, -40, -46, -52, -57, -63], [0] * 10),
    "N7": ([-23, -28, -33, -39, -45, -52, -60, -66, -73, -80], [-5, -7, -8, -9, -10, -12, -14, -14, -16, -17]),
}
SUMITOMO = [3, 6, 10, 18, 30, 50, 80]
"""Sumitomo, References, "Dimensional tolerances for regularly used fits", from JIS B 0401 (1999); up to 80 mm."""
SUMITOMO_SHAFTS = {  # upper, then lower
    "g5": ([-2, -4, -5, -6, -7, -9, -10], [-6, -9, -11, -14, -16, -20, -23]),
    "h5": ([0] * 7, [-4, -5, -6, -8, -9, -11, -13]),
    "h7": ([0] * 7, [-10, -12, -15, -18, -21, -25, -30]),
    "js5": ([2, 2.5, 3, 4, 4.5, 5.5, 6.5], [-2, -2.5, -3, -4, -4.5, -5.5, -6.5]),
    "k5": ([4, 6, 7, 9, 11, 13, 15], [0, 1, 1, 1, 2, 2, 2]),
    "m5": ([6, 9, 12, 15, 17, 20, 24], [2, 4, 6, 7, 8, 9, 11]),
    "n6": ([10, 16, 19, 23, 28, 33, 39], [4, 8, 10, 12, 15, 17, 20]),
    "p6": ([12, 20, 24, 29, 35, 42, 51], [6, 12, 15, 18, 22, 26, 32]),
}
SKF_SHAFTS = {  # SKF, "Shaft tolerances and resultant fits", table 12; up to 80 mm
    "j5": ([2, 3, 4, 5, 5, 6, 6], [-2, -2, -2, -3, -4, -5, -7]),
    "j6": ([4, 6, 7, 8, 9, 11, 12], [-2, -2, -2, -3, -4, -5, -7]),
}
BIG = [3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500]
"""BIG Daishowa, Shaft tolerances, p. 139; h4."""
BIG_H4 = [-3, -4, -4, -5, -6, -7, -8, -10, -12, -14, -16, -18, -20]

UP_TO = [10, 18, 30, 50, 80, 120, 180, 250]
BORE = {
    "normal": [8, 8, 10, 12, 15, 20, 25, 30],  # SKF, table 1 of its shaft tolerances
    "P5": [5, 5, 6, 8, 9, 10, 13, 15],  # SKF, P5 class tolerances for radial bearings, table 4, p. 42
    "P2": [2.5, 2.5, 2.5, 2.5, 4, 5, 7],  # SKF, class P2 (ABEC 9) tolerances; to 180 mm
}
OUTSIDE_UP_TO = [18, 30, 50, 80, 120, 150, 180, 250, 315, 400]
OUTSIDE = {
    "P5": (0, [5, 6, 7, 9, 10, 11, 13, 15, 18, 20]),
    "P2": (1, [4, 4, 4, 5, 5, 7, 8]),  # from 18 to 250 mm
}
"""Of makers' tables after ISO 492: the first range, and deviations below the nominal diameter [um]."""

CLEARANCES = {
    10: [0, 7, 2, 13, 8, 23, 14, 29, 20, 37],
    18: [0, 9, 3, 18, 11, 25, 18, 33, 25, 45],
    24: [0, 10, 5, 20, 13, 28, 20, 36, 28, 48],
    30: [1, 11, 5, 20, 13, 28, 23, 41, 30, 53],
    40: [1, 11, 6, 20, 15, 33, 28, 46, 40, 64],
    50: [1, 11, 6, 23, 18, 36, 30, 51, 45, 73],
    65: [1, 15, 8, 28, 23, 43, 38, 61, 55, 90],
    80: [1, 15, 10, 30, 25, 51, 46, 71, 65, 105],
    100: [1, 18, 12, 36, 30, 58, 53, 84, 75, 120],
    120: [2, 20, 15, 41, 36, 66, 61, 97, 90, 140],
    140: [2, 23, 18, 48, 41, 81, 71, 114, 105, 160],
}
"""PTI, Bearing inserts: internal clearance, C2 to C5, bores up to [mm]; its text ends at 140 mm."""


@pytest.mark.parametrize("name", [*LONGXI_SHAFTS, *SUMITOMO_SHAFTS, *SKF_SHAFTS])
def test_shafts_are_as_printed(name: str) -> None:
    tables = ((LONGXI, LONGXI_SHAFTS), (SUMITOMO, SUMITOMO_SHAFTS), (SUMITOMO, SKF_SHAFTS))
    ranges, (upper, lower) = next((ranges, printed[name]) for ranges, printed in tables if name in printed)
    np.testing.assert_allclose(deviations(name, np.array(ranges)), [lower, upper], atol=1e-9)


@pytest.mark.parametrize("name", LONGXI_HOLES)
def test_holes_are_as_printed(name: str) -> None:
    np.testing.assert_allclose(deviations(name, np.array(LONGXI[2:])), LONGXI_HOLES[name], atol=1e-9)


def test_the_finest_shaft_is_as_printed() -> None:
    np.testing.assert_allclose(deviations("h4", np.array(BIG)), [BIG_H4, [0] * len(BIG)], atol=1e-9)


def test_large_seats_with_interference_follow_the_rules_of_iso_286() -> None:
    """Its annex: p lies 0 to 5 um above IT7, n is 5 D^0.34 of the geometric mean of the range, rounded."""
    for low, high in pairwise(LONGXI[4:]):
        (p, _), (n, _), (_, whole) = (deviations(name, high) for name in ("p6", "n6", "H7"))
        assert 0.0 <= p - whole <= 5.0, high
        assert n == pytest.approx(5.0 * np.sqrt(low * high) ** 0.34, abs=1.0), high


@pytest.mark.parametrize("tolerance_class", BORE)
def test_bores_are_as_printed(tolerance_class: str) -> None:
    """A seat js4 as large as the nominal bore has the class's width added on one side."""
    for diameter, width in zip(UP_TO, BORE[tolerance_class], strict=False):
        low, high = deviations("js4", diameter)
        found = fit("shaft", "js4", tolerance_class, diameter * qs.mm)
        assert np.array([found.least, found.most]) / qs.um == pytest.approx([low, high + width]), diameter


@pytest.mark.parametrize("tolerance_class", OUTSIDE)
def test_outside_diameters_are_as_printed(tolerance_class: str) -> None:
    first, widths = OUTSIDE[tolerance_class]
    for diameter, width in zip(OUTSIDE_UP_TO[first:], widths, strict=False):
        low, high = deviations("JS4", diameter)
        found = fit("housing", "JS4", tolerance_class, diameter * qs.mm)
        assert np.array([found.least, found.most]) / qs.um == pytest.approx([-high - width, -low]), diameter


@pytest.mark.parametrize("bore", CLEARANCES)
def test_clearances_are_as_printed(bore: int) -> None:
    limits = [clearance_limits(bore * qs.mm, each) for each in ClearanceClass]
    np.testing.assert_allclose(limits, np.reshape(CLEARANCES[bore], (5, 2)) * qs.um, atol=1e-9)
