"""Basic dynamic load rating of a bearing, and of each of its contacts.

Sources: G. Lundberg & A. Palmgren 1947; ISO/TR 1281-1 (the formula behind the factor fc); ISO 281:2007, 5.1 and table
2, read from GOST 18855-2013, its translation; ISO/TS 16281:2008, 4.2 and 4.3. Lengths in the formulas are millimetres.

Two definitions of "C from geometry", which differ where grooves differ:

- the formula of Lundberg and Palmgren with the bearing's own groove radii. A wider groove lowers C, a tighter one
  raises it;
- ISO 281's table of fc. It stands for f = 0.52 at both raceways, where it exceeds the formula by 0.8 % at every gamma.
  It covers inner grooves of f <= 0.52 and outer ones of f <= 0.53: tighter ones earn nothing, wider ones are not
  covered.

Nominal contact angles above 45 degrees make a thrust bearing, whose rating Ca is an axial load. Its formula is the same
without the load distribution of a radial load (0.407 and 1.04), with lambda = 0.90 and a factor 1 - sin(alpha)/3 for
loads that are uneven. The standard's table for them was not at hand; at f = 0.535 the formula has what its worked
examples print: 85.1 (45 degrees, gamma 0.16) and 61.12 (60 degrees, read at gamma 0.046 between 0.04 and 0.05).
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.units import mm
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers

RATING_FACTOR = 1.3
"""bm of ISO 281, table 1: radial and angular contact ball bearings of contemporary steel; 1.0 for steel of the 1940s,
to which Lundberg and Palmgren fitted their constant."""

REDUCTION = 0.95
"""lambda of ISO/TR 1281-1, single-row radial and angular contact bearings: inexact grooves and uneven loads."""

THRUST_REDUCTION = 0.90
"""lambda of thrust ball bearings; as the two printed values ask for."""

THRUST_GROOVE = 0.535
"""f of both raceways that ISO 281's fc of thrust bearings stands for, as the two printed values ask for."""

RADIAL_MEAN = 0.407
"""Of the inner raceway's rating, what a radial load that presses half the ring leaves; a centred axial load all."""

STRENGTH = 39.9
"""Lundberg and Palmgren's constant in fc, for steel of their time [N, mm]."""

LARGE_BALL = 25.4
"""Above this diameter [mm] the rating grows as 3.647 D^1.4, below as D^1.8."""

INNER_GROOVE_COVERED, OUTER_GROOVE_COVERED, THRUST_GROOVE_COVERED = 0.52, 0.53, 0.54
"""Groove radii over D up to which ISO 281's tables hold."""

# fmt: off
FACTOR_GAMMA = np.arange(1, 41) / 100.0
FACTOR = np.array([
    29.1, 35.8, 40.3, 43.8, 46.7, 49.1, 51.1, 52.8, 54.3, 55.5,
    56.6, 57.5, 58.2, 58.8, 59.3, 59.6, 59.8, 59.9, 60.0, 59.9,
    59.8, 59.6, 59.3, 59.0, 58.6, 58.2, 57.7, 57.1, 56.6, 56.0,
    55.3, 54.6, 53.9, 53.2, 52.4, 51.7, 50.9, 50.0, 49.2, 48.4,
])
"""fc of single-row radial bearings by gamma = D cos(alpha)/dm from 0.01 to 0.40 (ISO 281:2007, table 2)."""
# fmt: on


class Rating(StrEnum):
    """What defines the dynamic load rating that follows from the geometry."""

    LUNDBERG_PALMGREN = "lundberg_palmgren"
    """The formula, with the bearing's own groove radii."""
    ISO_281 = "iso_281"
    """The table of fc, which knows no groove radii; NaN outside its range of gamma, 0.01 to 0.40."""


class Capacity(StrEnum):
    """What each contact's endurance is taken from."""

    ISO_16281 = "iso_16281"
    """C spread over the contacts at the nominal angle, as ISO/TS 16281 does."""
    LUNDBERG_PALMGREN = "lundberg_palmgren"
    """Lundberg and Palmgren's formula at each contact's own angle."""


def groove_factor(f: ArrayLike) -> NDArray:
    """(2 f/(2 f - 1))^0.41, the part of a contact's rating that its groove radius makes."""
    f = np.asarray(f, float)
    return np.asarray((2.0 * f / (2.0 * f - 1.0)) ** 0.41)


def rating_ratio(gamma: ArrayLike, inner_f: ArrayLike, outer_f: ArrayLike, factor: float) -> NDArray:
    """Inner rating over outer: factor ((1 - g)/(1 + g))^1.72 (fi (2 fo - 1)/(fo (2 fi - 1)))^0.41."""
    gamma = np.asarray(gamma, float)
    return np.asarray(
        factor * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * groove_factor(inner_f) / groove_factor(outer_f)
    )


def lundberg_palmgren_factor(gamma: ArrayLike, inner_f: ArrayLike, outer_f: ArrayLike) -> NDArray:
    """fc by Lundberg and Palmgren's formula (ISO/TR 1281-1), lambda included."""
    g = np.asarray(gamma, float)
    both = (1.0 + rating_ratio(g, inner_f, outer_f, 1.04) ** (10.0 / 3.0)) ** -0.3
    return np.asarray(
        STRENGTH * REDUCTION * both * g**0.3 * (1.0 - g) ** 1.39 / (1.0 + g) ** (1.0 / 3.0) * groove_factor(inner_f)
    )


def thrust_factor(bearing: BallBearing, inner_f: ArrayLike, outer_f: ArrayLike) -> NDArray:
    """fc cos(alpha)^0.7 tan(alpha) of a thrust bearing by the same formula, lambda and 1 - sin(alpha)/3 included.

    Written with sin(alpha) (D/dm)^0.3, which it comes to and which has a value up to 90 degrees.
    """
    numbers = BearingNumbers(bearing)
    g, sine = numbers.nominal_gamma, np.sin(numbers.nominal_angle)
    both = (1.0 + rating_ratio(g, inner_f, outer_f, 1.0) ** (10.0 / 3.0)) ** -0.3
    shape = (1.0 - g) ** 1.39 / (1.0 + g) ** (1.0 / 3.0) * (numbers.ball_diameter / numbers.pitch_diameter) ** 0.3
    return np.asarray(STRENGTH / RADIAL_MEAN * _thrust_reduction(sine) * both * shape * sine * groove_factor(inner_f))


def _thrust_reduction(sine: NDArray) -> NDArray:
    return np.asarray(THRUST_REDUCTION * (1.0 - sine / 3.0))


def tabulated_factor(gamma: ArrayLike) -> NDArray:
    """fc of ISO 281's table, linear between its values; NaN outside it."""
    return np.asarray(np.interp(np.asarray(gamma, float), FACTOR_GAMMA, FACTOR, left=np.nan, right=np.nan))


def size_factor(ball_diameter: ArrayLike) -> NDArray:
    """D^1.8, or 3.647 D^1.4 above 25.4 mm, with D in mm; the argument in m."""
    D = np.asarray(ball_diameter, float) / mm
    return np.asarray(np.where(D <= LARGE_BALL, D**1.8, 3.647 * D**1.4))


def dynamic_load_rating(
    bearing: BallBearing, rating: Rating = Rating.LUNDBERG_PALMGREN, rating_factor: float = RATING_FACTOR
) -> NDArray:
    """C = bm fc cos(alpha)^0.7 Z^(2/3) D^1.8, the basic dynamic radial load rating of one row [N].

    Above a nominal contact angle of 45 degrees the axial one, Ca = bm fc cos(alpha)^0.7 tan(alpha) Z^(2/3) D^1.8.

    Args:
        bearing: its arrays span cases.
        rating: what defines fc.
        rating_factor: bm.

    Range: rings and balls of bearing steel. Ceramic balls keep the rating of steel ones (DIN ISO 281 Beiblatt 5,
    since replaced by ISO 20056-1): smaller ellipses lower it, smaller shear at the surface makes up for that.

    Returns:
        C, (*cases,) [N].

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print(f"{qs.readings.dynamic_load_rating(bearing) / 1e3:.1f} kN")
        99.8 kN
    """
    numbers = BearingNumbers(bearing)
    gamma = numbers.nominal_gamma
    if Rating(rating) is Rating.ISO_281:
        factor, thrust = tabulated_factor(gamma), thrust_factor(bearing, THRUST_GROOVE, THRUST_GROOVE)
    else:
        grooves = numbers.groove_coefficient(INNER), numbers.groove_coefficient(OUTER)
        factor, thrust = lundberg_palmgren_factor(gamma, *grooves), thrust_factor(bearing, *grooves)
    size = numbers.ball_count ** (2.0 / 3.0) * size_factor(numbers.ball_diameter)
    factor = np.where(numbers.is_thrust, thrust, factor * np.cos(numbers.nominal_angle) ** 0.7)
    return np.asarray(rating_factor * factor * size)


def axial_load_rating(bearing: BallBearing, dynamic_load_rating: ArrayLike) -> NDArray:
    """Caa = 1.91 tan(alpha) (1 - 0.333 sin(alpha)) C, the axial rating of an angular-contact bearing under thrust [N].

    ISO 281:2007, C.5. For nominal angles up to 45 degrees; NaN above, where the rating is axial itself, and zero at
    zero, where the standard has no use for it.

    Args:
        dynamic_load_rating: C, its radial rating [N].

    Returns:
        Ca, (*cases,) [N].

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print(f"{qs.readings.axial_load_rating(bearing, 50e3) / 1e3:.1f} kN")
        63.0 kN
    """
    numbers = BearingNumbers(bearing)
    angle = numbers.nominal_angle
    axial = 1.91 * np.tan(angle) * (1.0 - 0.333 * np.sin(angle)) * np.asarray(dynamic_load_rating, float)
    return np.asarray(np.where(numbers.is_thrust, np.nan, axial))


def element_load_ratings(bearing: BallBearing, dynamic_load_rating: ArrayLike) -> tuple[NDArray, NDArray]:
    """(Qci, Qce): ball loads that each raceway endures for a million revolutions [N]; ISO/TS 16281, 4.2 and 4.3.

        Qci = C/(0.407 Z cos(alpha)^0.7) [1 + B^(10/3)]^0.3       B = 1.044 ((1 - g)/(1 + g))^1.72 (groove factors)
        Qce = C/(0.389 Z cos(alpha)^0.7) [1 + B^(-10/3)]^0.3
        thrust bearings: C/(Z sin(alpha)) [1 + B^(10/3)]^0.3 and [1 + B^(-10/3)]^0.3, B without 1.044

    with the nominal angle in g and cos(alpha), and the bearing's own groove radii. The exponent 0.7 stands so in
    published implementations of the standard, whose text was not at hand. Lundberg and Palmgren's C is proportional to
    Qc cos(alpha): by them it would be 1, and the ratings 8 % higher at 40 degrees (`contact_load_rating`).

    Returns:
        Qci and Qce, each (*cases,) [N].

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print([f"{each / 1e3:.2f} kN" for each in qs.readings.element_load_ratings(bearing, 100e3)])
        ['19.74 kN', '31.67 kN']
    """
    numbers = BearingNumbers(bearing)
    factor = np.where(numbers.is_thrust, 1.0, 1.044)
    grooves = numbers.groove_coefficient(INNER), numbers.groove_coefficient(OUTER)
    ratio = factor * rating_ratio(numbers.nominal_gamma, *grooves, 1.0)
    inner, outer = (1.0 + ratio ** (10.0 / 3.0)) ** 0.3, (1.0 + ratio ** (-10.0 / 3.0)) ** 0.3
    share, angle = np.asarray(dynamic_load_rating, float) / numbers.ball_count, numbers.nominal_angle
    radial, thrust = share / np.cos(angle) ** 0.7, share / np.where(numbers.is_thrust, np.sin(angle), 1.0)
    return (
        np.asarray(np.where(numbers.is_thrust, thrust, radial / RADIAL_MEAN) * inner),
        np.asarray(np.where(numbers.is_thrust, thrust, radial / 0.389) * outer),
    )


def contact_load_rating(bearing: BallBearing, angle: NDArray, side: float, rating_factor: float) -> NDArray:
    """The ball load that a raceway endures for a million revolutions, at each ball's own contact angle [N].

    Qc = 39.9 lambda bm/0.407 (2f/(2f - 1))^0.41 (1 -/+ g)^1.39/(1 +/- g)^(1/3) (D/dm)^0.3 D^1.8 Z^(-1/3), upper signs
    inside: Lundberg & Palmgren 1947; Harris & Kotzalas print 98.1 for 39.9/0.407. lambda and bm, which C has, are
    included, and a thrust bearing's 1 - sin(alpha)/3 at the nominal angle.

    Args:
        angle: contact angles, shape (*cases, ball).
        side: INNER or OUTER.
    """
    numbers = BearingNumbers(bearing)
    D, dm, Z = (array[..., None] for array in (numbers.ball_diameter, numbers.pitch_diameter, numbers.ball_count))
    f = numbers.groove_coefficient(side)[..., None]
    g = side * D / dm * np.cos(angle)
    reduction = np.where(numbers.is_thrust, _thrust_reduction(np.sin(numbers.nominal_angle)), REDUCTION)
    constant = STRENGTH / RADIAL_MEAN * rating_factor * reduction[..., None]
    shape = groove_factor(f) * (1.0 + g) ** 1.39 / (1.0 - g) ** (1.0 / 3.0) * (D / dm) ** 0.3
    return np.asarray(constant * shape * size_factor(D) * Z ** (-1.0 / 3.0))
