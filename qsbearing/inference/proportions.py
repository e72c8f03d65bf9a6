"""Ball sets by the proportions of a dimension series, where nobody knows the ratings: for stiffness and pressure, with
a range, and for nothing that needs a load rating."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np

from qsbearing.inference import iso15
from qsbearing.inference.ball_sets import STEEP, possible_sets, sizes_of
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.inference.practice import RatingPractice
from qsbearing.inference.ratings_fit import ISO_F, Fitted
from qsbearing.model.bearing import BearingKind
from qsbearing.model.units import mm


class Proportions(NamedTuple):
    """Least and largest of a series."""

    height: tuple[float, float]
    """Ball diameter over the height of the section, D/((D_o - d)/2)."""
    fill: tuple[float, float]
    """Z D/(pi dm)."""


WIDENED = 0.015
"""Part by which the 2 and 98 % quantiles of known ball sets are widened."""
_ANGULAR, _DEEP = BearingKind.ANGULAR_CONTACT, BearingKind.DEEP_GROOVE
PROPORTIONS = {
    (_ANGULAR, "19"): Proportions((0.521, 0.645), (0.673, 0.862)),
    (_ANGULAR, "10"): Proportions((0.555, 0.622), (0.742, 0.897)),
    (_ANGULAR, "02"): Proportions((0.521, 0.645), (0.653, 0.872)),
    (_DEEP, "18"): Proportions((0.509, 0.625), (0.519, 0.665)),
    (_DEEP, "19"): Proportions((0.521, 0.632), (0.526, 0.599)),
    (_DEEP, "10"): Proportions((0.538, 0.656), (0.538, 0.613)),
    (_DEEP, "02"): Proportions((0.519, 0.645), (0.522, 0.614)),
    (_DEEP, "03"): Proportions((0.553, 0.645), (0.572, 0.626)),
    (_DEEP, "04"): Proportions((0.505, 0.645), (0.592, 0.676)),
}
"""By kind and dimension series, of usual balls: GMN's S 619 and NTN's 79; NTN's 70; SNFA's E 2; deep groove bearings of
NSK and SKF whose ratings allow one set."""
OF_40_DEGREES = Proportions((0.547, 0.665), (0.821, 0.994))
"""Of angular-contact bearings of 40 degrees, series 02 and 03: the sets that the ratings of SKF's 7208 BEP, 7210 BEP,
7211 BEP, 7308 BEGAPH and 7310 BEP allow."""


def proportions_of(sheet: DataSheet) -> Proportions | None:
    """Those of its dimension series; None where no ball sets of the series are known here."""
    series = iso15.series_of(sheet.bore_diameter / mm, sheet.outside_diameter / mm)
    known = PROPORTIONS.get((sheet.kind, series))
    if sheet.kind == _ANGULAR and series in ("02", "03") and (angle := sheet.free_contact_angle or 0.0) > 0.5:
        # Of 30 degrees none is known: as those of 15 to 25, as those of 40 or between.
        return OF_40_DEGREES if angle > STEEP or known is None else _both(known, OF_40_DEGREES)
    return known


def _both(one: Proportions, other: Proportions) -> Proportions:
    """From the lesser of both to the larger."""
    return Proportions(*((min(a[0], b[0]), max(a[1], b[1])) for a, b in zip(one, other, strict=True)))


def likely_sets(sheet: DataSheet, of: Proportions) -> Fitted:
    """Every usual set within the proportions, the most usual first; a known count or diameter is kept to."""
    sets = possible_sets(sheet, sizes_of(sheet), of.fill)
    height = sets.diameters / (0.5 * (sheet.outside_diameter - sheet.bore_diameter))
    fill = sets.counts * sets.diameters / (pi * sheet.pitch)
    misfit = np.zeros(height.shape)
    for share, (least, most) in zip((height, fill), of, strict=True):
        misfit = misfit + ((share - 0.5 * (least + most)) / (0.5 * (most - least))) ** 2
    is_within = np.full(height.shape, sheet.ball_diameter is not None) | (
        (height >= of.height[0]) & (height <= of.height[1])
    )
    known = sheet.groove_radius_coefficient
    groove = np.broadcast_to(ISO_F if known is None else (known,) * 3, (*height.shape, 3))
    fits = Fitted(sets, groove, misfit, np.full(misfit.shape, str(RatingPractice.PROPORTIONS))).taken(is_within)
    return fits.taken(np.argsort(fits.misfit, kind="stable"))
