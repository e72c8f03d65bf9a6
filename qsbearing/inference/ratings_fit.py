"""Which ball sets have the printed ratings, under one practice; with the groove radii that follow."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.inference.ball_sets import BallSets, is_thin, possible_sets, sizes_of
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.inference.practice import Practice, RatingPractice
from qsbearing.model.bearing import BallBearing
from qsbearing.model.material import STEEL, Material
from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.readings.dynamic_rating import Rating, dynamic_load_rating
from qsbearing.readings.static_rating import static_load_rating

ISO_STEEL = replace(STEEL, elastic_modulus=207e9)
"""Of ISO 76. With it C and C0 of 85 spindle bearings ask for the same f, on average to 0.00005."""
ISO_GROOVES = 0.52, 0.53
"""f of the inner and the outer groove that ISO's tables stand for."""
ISO_F = 0.515, 0.520, 0.525
"""Where the ratings are ISO's, which tell no groove: least, usual, largest. The rigidities of 46 pairs of a maker whose
ratings are ISO's ask for 0.5167 to 0.5214."""
OWN_F_OFFSETS = np.array([0.0, 0.0013, 0.0056])
"""What the f that rigidities ask for has above that of C0: least, usual, largest; beside the rounding of C0."""
OWN_F_RANGE = 0.508, 0.535
"""f of C0 that are believed."""
LARGEST_F = 0.58
"""f of C0 of light balls between wide grooves; their rigidities ask for 0.538 where C0 asks for 0.561 (GMN's KH)."""
OWN_F_PRIOR, OWN_F_SPREAD = 0.5224, 0.0034
"""Usual f of rigidities, by which sets are ordered that the ratings do not tell apart: mean and standard deviation of
GMN's S 619."""
WORST_FIT = 9.0
"""The misfit beyond which no set is believed."""
WORST_ALONE = 4.0
"""Likewise where factors of a series leave one set alone: of GMN's KH the right ones are at 3.1 at most. Beyond, the
factors are more likely those of other rows."""
THIN_C, THIN_C_SPREAD, THIN_F_SPREAD = (-0.035, 0.016), 0.012, 0.006
"""Of own grooves in dimension series 18: C printed over computed, less 1, between these; its usual deviation from their
middle; that of f."""
BALLS_GIVEN = "balls given"
"""In place of a practice, where no rating is read."""
LARGEST_ROUNDING = 0.01
F0_AGREEMENT = 0.01
"""How far makers' f0 are from exact ones, beside their rounding: they are read from a table by steps of gamma."""
LARGEST_F0 = 16.5
"""Of ISO 76. Some rows of thin sections print more, which tells nothing."""
STEEPNESS = -30.0
"""d ln C0/df, about."""


class Fitted(NamedTuple):
    """Ball sets that have the printed ratings; arrays of shape (set,)."""

    sets: BallSets
    groove: NDArray
    """f least, usual and largest, shape (set, 3)."""
    misfit: NDArray
    """Sum of squares over the usual deviations."""
    practice: NDArray
    """In a word."""

    def taken(self, which: NDArray) -> Fitted:
        """Those of a mask or of numbers."""
        return Fitted(self.sets.taken(which), self.groove[which], self.misfit[which], self.practice[which])


def joined(parts: list[Fitted]) -> Fitted:
    """All of them, best first."""
    counts, diameters = (np.concatenate([each.sets[i] for each in parts]) for i in (0, 1))
    groove, misfit, practice = (np.concatenate([each[i] for each in parts]) for i in (1, 2, 3))
    order = np.argsort(misfit, kind="stable")
    return Fitted(BallSets(counts, diameters), groove, misfit, practice).taken(order)


def fitted(sheet: DataSheet, practice: Practice) -> Fitted:
    """Every set that has the printed ratings within what the practice allows, best first.

    C0 of ceramic balls is read as that of steel balls, as some makers print it, and as that of 4200 MPa.
    """
    sets = possible_sets(sheet, sizes_of(sheet))
    return joined([_fitted(sheet, practice, sets, balls) for balls in balls_of(sheet)])


def balls_of(sheet: DataSheet) -> list[Material]:
    """The materials for which C0 may be meant."""
    is_hybrid = np.asarray(sheet.ball_material.elastic_modulus) > 1.2 * np.asarray(sheet.ring_material.elastic_modulus)
    return [ISO_STEEL, sheet.ball_material] if is_hybrid else [ISO_STEEL]


NO_SETS = Fitted(BallSets(np.empty(0), np.empty(0)), np.empty((0, 3)), np.empty(0), np.empty(0, str))


def of_known_balls(sheet: DataSheet) -> Fitted:
    """The set that is given, whose ratings nobody knows."""
    sets = possible_sets(sheet, sizes_of(sheet))
    known = sheet.groove_radius_coefficient
    groove = np.array([ISO_F if known is None else (known,) * 3])
    return Fitted(sets, groove, np.zeros(1), np.array([BALLS_GIVEN]))


def rounding(value: float) -> float:
    """Half of the last printed digit over the value, as far as its trailing zeros tell."""
    digits = f"{value:.0f}"
    return min(0.5 * 10.0 ** (len(digits) - len(digits.rstrip("0"))) / value, LARGEST_ROUNDING)


def _fitted(sheet: DataSheet, practice: Practice, sets: BallSets, balls: Material) -> Fitted:
    if not sets.counts.size:
        return NO_SETS
    is_own = practice.kind == RatingPractice.OWN_GROOVE
    standard, known = rated(sheet, sets, *ISO_GROOVES, balls), sheet.groove_radius_coefficient
    is_thin_own = is_own and is_thin(sheet)
    of_dynamic, of_static = (rounding(each or 1.0) for each in (sheet.dynamic_load_rating, sheet.static_load_rating))
    if is_own:
        f = groove_of_static_rating(sheet, sets, balls, OWN_F_RANGE[1] + 0.005)
        dynamic = np.log(sheet.dynamic_load_rating / dynamic_load_rating(rated(sheet, sets, f, f, balls)))
        static = np.zeros(f.shape)
        groove = f[:, None] + OWN_F_OFFSETS + of_static / STEEPNESS * np.array([1.0, 0.0, -1.0])
        good = (f >= OWN_F_RANGE[0]) & (f <= OWN_F_RANGE[1])
        good &= known is None or np.abs(groove - (known or 0.0)).min(axis=1) < np.ptp(OWN_F_OFFSETS)
    else:
        dynamic = np.log(sheet.dynamic_load_rating / dynamic_load_rating(standard, Rating.ISO_281))
        dynamic = dynamic - np.clip(dynamic, *np.log(practice.dynamic_factor))
        static = np.log(sheet.static_load_rating / static_load_rating(standard) / practice.static_factor)
        good, groove = np.ones(static.shape, bool), np.broadcast_to(ISO_F, (*static.shape, 3))
        if practice.static_factor < 1.0:
            most = groove_of_static_rating(sheet, sets, balls, LARGEST_F) + OWN_F_OFFSETS[2]
            groove = np.stack([groove[:, 0], 0.5 * (groove[:, 0] + most), most], axis=1)
    middle, within = (np.mean(THIN_C), 0.5 * np.ptp(THIN_C)) if is_thin_own else (0.0, practice.within)
    misfit = ((groove[:, 1] - OWN_F_PRIOR) / (THIN_F_SPREAD if is_thin_own else OWN_F_SPREAD)) ** 2 * is_own
    misfit = (
        misfit + ((dynamic - middle) / ((THIN_C_SPREAD if is_thin_own else practice.spread) + 0.5 * of_dynamic)) ** 2
    )
    misfit = misfit + (static / (practice.static_share * practice.spread + 0.5 * of_static)) ** 2
    good &= np.abs(dynamic - middle) <= within + of_dynamic  # NaN where no table reaches
    good &= (np.abs(static) <= practice.static_share * practice.within + of_static) & (misfit <= WORST_FIT)
    groove = groove if known is None else np.full(groove.shape, known)
    practices = np.full(misfit.shape, str(practice.kind))
    return Fitted(sets, groove, misfit, practices).taken(good & has_f0(sheet, standard))


def rated(sheet: DataSheet, sets: BallSets, inner_f: ArrayLike, outer_f: ArrayLike, balls: Material) -> BallBearing:
    """These sets as the rating standards see them, where the clearance of a deep groove bearing does not matter."""
    return BallBearing(
        sets.counts, sets.diameters, sheet.pitch, inner_f * sets.diameters, outer_f * sets.diameters,
        sheet.free_contact_angle or 0.0, ball_material=balls, ring_material=ISO_STEEL, kind=sheet.kind,
    )  # fmt: skip


def has_f0(sheet: DataSheet, standard: BallBearing) -> NDArray:
    """Whether the sets have the printed f0, which tells the ball diameter."""
    if sheet.f0 is None or sheet.f0 > LARGEST_F0:
        return np.ones(np.shape(standard.ball_count), bool)
    numbers = BearingNumbers(standard)
    size = numbers.ball_count * numbers.ball_diameter**2 * np.cos(numbers.nominal_angle)
    last_digit = 0.5 if sheet.f0 == round(sheet.f0) else 0.05
    return np.abs(1e-6 * static_load_rating(standard) / size - sheet.f0) <= F0_AGREEMENT * sheet.f0 + last_digit


def groove_of_static_rating(sheet: DataSheet, sets: BallSets, balls: Material, most: float) -> NDArray:
    """f, equal in both rings and at most this, with which each set has the printed C0."""

    def excess(f: NDArray) -> NDArray:
        rating = static_load_rating(rated(sheet, sets, f, f, balls))
        return np.asarray(np.log(rating / sheet.static_load_rating))

    start = np.full(sets.counts.shape, OWN_F_PRIOR)
    return secants(excess, start, STEEPNESS, (OWN_F_RANGE[0] - 0.003, most))


def secants(excess: Callable[[NDArray], NDArray], f: NDArray, slope: float, limits: tuple[float, float]) -> NDArray:
    """Where each element is zero of what falls with f, nearly straight; at a limit where it is beyond.

    Args:
        slope: about how it falls.
    """
    above, slopes = excess(f), np.full(f.shape, slope)
    for _ in range(4):
        before, f = f, np.clip(f - above / slopes, *limits)
        higher, above = above, excess(f)
        moved = np.where(f == before, 1.0, f - before)
        secant = (above - higher) / moved
        slopes = np.where((f != before) & (secant < 0.1 * slope), secant, slope)
    return f
