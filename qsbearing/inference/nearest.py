"""The ball set that misses printed ratings by least, and what excludes it: for those whose data sheet is refused."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.numbers import plain
from qsbearing.inference.ball_sets import (
    INCH_SIZES,
    METRIC_SIZES,
    SAME_SIZE,
    BallSets,
    fills_of,
    possible_sets,
    sizes_of,
)
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.inference.practice import Practice, RatingPractice
from qsbearing.inference.ratings_fit import ISO_GROOVES, ISO_STEEL, OWN_F_RANGE, groove_of_static_rating, has_f0, rated
from qsbearing.model.bearing import BallBearing
from qsbearing.model.units import mm
from qsbearing.readings.dynamic_rating import Rating, dynamic_load_rating
from qsbearing.readings.static_rating import static_load_rating
from qsbearing.remarks.wording import listed

WIDEST_FILL = 0.40, 0.98
UNUSUAL = 4.0
"""What a size that is not looked at adds to a misfit, so that a usual one as near goes first."""


class Nearest(NamedTuple):
    """One ball set beside printed ratings."""

    balls: float
    diameter: float
    dynamic: float
    """C printed over computed."""
    static: float
    """C0 printed over computed."""
    fill: float
    excluded: tuple[str, ...]
    """What excludes it, parts of a sentence."""

    def __str__(self) -> str:
        numbers = f"C {self.dynamic:.3f} and C0 {self.static:.3f} of computed, fill {self.fill:.2f}"
        return f"Nearest is {self.balls:.0f} x {self.diameter / mm:.6g} mm, {numbers}: {listed(self.excluded)}"


def nearest_set(sheet: DataSheet, practice: Practice) -> Nearest | None:
    """Of all sizes in inches and millimetres; None where no ball fits between the rings at all."""
    sizes = np.concatenate([INCH_SIZES, METRIC_SIZES])
    sets = possible_sets(sheet, sizes, WIDEST_FILL)
    if not sets.counts.size:
        return None
    dynamic, static, standard = _ratios(sheet, sets, practice)
    over = np.log(dynamic) - np.clip(np.log(dynamic), *np.log(practice.dynamic_factor))
    of_f0 = np.asarray(has_f0(sheet, standard))
    is_usual = np.abs(sets.diameters[:, None] / sizes_of(sheet) - 1.0).min(axis=1) < SAME_SIZE
    misfit = (over / practice.spread) ** 2 + (np.log(static) / (practice.static_share * practice.spread)) ** 2
    misfit = misfit + UNUSUAL * ~is_usual + UNUSUAL * ~of_f0
    if not np.isfinite(misfit).any():
        return None
    best = int(np.nanargmin(misfit))
    fill = float(sets.counts[best] * sets.diameters[best] / (pi * sheet.pitch))
    least, most = fills_of(sheet)
    reasons = {
        "this size in millimetres is not looked at": not is_usual[best],
        f"fills are {least:.2f} to {most:.2f}": not least <= fill <= most,
        "its f0 is another": not of_f0[best],
        _range_of_c(practice): abs(over[best]) > practice.within,
        f"C0 within {plain(100.0 * practice.within * practice.static_share, '.2g')} %": abs(np.log(static[best]))
        > practice.within * practice.static_share,
    }
    excluded = tuple(reason for reason, is_so in reasons.items() if is_so) or ("all in all too far",)
    balls, diameter, of_dynamic, of_static = (float(each[best]) for each in (*sets, dynamic, static))
    return Nearest(balls, diameter, of_dynamic, of_static, fill, excluded)


def _range_of_c(practice: Practice) -> str:
    """Which C over computed is believed."""
    raised = practice.dynamic_factor[1] / practice.dynamic_factor[0]
    return f"C within {plain(100.0 * practice.within, '.2g')} %" + f", raised to {raised:.2f} at most" * (raised > 1.0)


def _ratios(sheet: DataSheet, sets: BallSets, practice: Practice) -> tuple[NDArray, NDArray, BallBearing]:
    """C and C0 printed over computed, the latter with the factor of a series; the sets by the standards."""
    standard = rated(sheet, sets, *ISO_GROOVES, ISO_STEEL)
    if practice.kind == RatingPractice.OWN_GROOVE:
        f = np.clip(groove_of_static_rating(sheet, sets, ISO_STEEL, OWN_F_RANGE[1]), *OWN_F_RANGE)
        own = rated(sheet, sets, f, f, ISO_STEEL)
        computed = dynamic_load_rating(own), static_load_rating(own)
    else:
        computed = dynamic_load_rating(standard, Rating.ISO_281), static_load_rating(standard) * practice.static_factor
    printed = sheet.dynamic_load_rating, sheet.static_load_rating
    dynamic, static = (np.asarray(each / of) for each, of in zip(printed, computed, strict=True))
    return dynamic, static, standard
