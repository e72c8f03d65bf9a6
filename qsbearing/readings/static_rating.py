"""Static load rating and safety, and the fatigue load limit: loads at which a contact reaches a given pressure.

Sources: ISO 76:2006, read from GOST 18854-2013, its translation; ISO 281:2007, annex B, from GOST 18855-2013. ISO 76
prints the factor f0 for grooves of f = 0.52 inside and 0.53 outside and E = 207 GPa; exact Hertz contact reproduces all
its values to the printed rounding. Here the bearing's own grooves and materials enter, which shows what a wider groove
or ceramic balls cost. ISO 20056-2 allows hybrid bearings a somewhat higher pressure; its value was not at hand.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import inf, nan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.compiled import entry
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers, load_at_pressure
from qsbearing.readings.passes import filled_cases, of_balls
from qsbearing.readings.remarks import Remarks, remarks
from qsbearing.scene.bearing import BallBearing, BearingKind
from qsbearing.solution import Solution
from qsbearing.units import MPa, deg, mm
from qsbearing.validation import FORCE, ErrorDetail, raise_if_any, within

STATIC_PRESSURE = 4200e6
"""Permissible contact pressure of ball bearings at rest [Pa]: a permanent dent of about 1e-4 D (ISO 76)."""

FATIGUE_PRESSURE = 1500e6
"""Pressure below which bearing steel does not tire under ideal conditions [Pa] (ISO 281, annex B)."""

RADIAL_SHARE = 5.0
"""The heaviest ball of a radial load carries 5 Fr/(Z cos alpha) (ISO 76; no clearance would make it 4.37)."""

HALF_LOADED = 0.2288
"""Fr/(Z Qmax cos alpha) where half the raceway is loaded (ISO 281, annex B)."""

SMALL_PITCH = 100.0 * mm
"""Above this pitch diameter the fatigue load limit falls as dm^-0.5."""

SIMPLE_DIVISOR = 22.0
"""Cu = C0/22, the standard's simple estimate."""

# fmt: off
_ANGLE = np.array([5.0, 10.0, 15.0, 20.0, 25.0, 26.0, 30.0, 35.0, 36.0, 40.0, 45.0]) * deg
_Y0 = np.array([0.52, 0.50, 0.46, 0.42, 0.38, 0.37, 0.33, 0.29, 0.29, 0.26, 0.22])
# fmt: on
_X0_ANGULAR, _X0_DEEP_GROOVE, _Y0_DEEP_GROOVE = 0.5, 0.6, 0.5


class FatigueLimit(StrEnum):
    """How the fatigue load limit is found; for one and the same bearing the two differ by some 14 %."""

    HERTZ = "hertz"
    """From the load at which a contact reaches 1500 MPa."""
    STATIC_RATING = "static_rating"
    """C0/22."""


def _weaker_contact(bearing: BallBearing, pressure: float) -> NDArray:
    """The smaller of the ball loads at which the raceways' contacts reach a pressure, at the nominal angle [N]."""
    numbers = BearingNumbers(bearing)
    given = numbers.ball_diameter, numbers.nominal_gamma
    inner, outer = (
        load_at_pressure(pressure, *given, numbers.groove_coefficient(side), numbers.modulus(), side)
        for side in (INNER, OUTER)
    )
    return np.minimum(inner, outer)


def static_load_rating(bearing: BallBearing) -> NDArray:
    """C0 = Z cos(alpha) Q(4200 MPa)/5, the basic static radial load rating of one row [N].

    Q is the smaller of the two raceways' loads; ISO 76 writes f0 Z D^2 cos(alpha), f0 = Q/(5 D^2).
    """
    numbers = BearingNumbers(bearing)
    largest = _weaker_contact(bearing, STATIC_PRESSURE)
    return np.asarray(numbers.ball_count * np.cos(numbers.nominal_angle) * largest / RADIAL_SHARE)


def fatigue_load_limit(
    bearing: BallBearing, by: FatigueLimit = FatigueLimit.HERTZ, static_rating: ArrayLike | None = None
) -> NDArray:
    """Cu, the load of one row below which its steel does not tire [N]; ISO 281:2007, annex B.

    0.2288 Z Qu cos(alpha), Qu the smaller load at which a contact reaches 1500 MPa; or C0/22. Either is multiplied by
    (100 mm/dm)^0.5 above a pitch diameter of 100 mm.

    Args:
        static_rating: C0 [N] where it does not follow from the geometry.
    """
    numbers = BearingNumbers(bearing)
    if FatigueLimit(by) is FatigueLimit.STATIC_RATING:
        limit = (static_load_rating(bearing) if static_rating is None else np.asarray(static_rating)) / SIMPLE_DIVISOR
    else:
        weakest = _weaker_contact(bearing, FATIGUE_PRESSURE)
        limit = HALF_LOADED * numbers.ball_count * weakest * np.cos(numbers.nominal_angle)
    return np.asarray(limit * np.minimum(SMALL_PITCH / numbers.pitch_diameter, 1.0) ** 0.5)


def static_equivalent_load(bearing: BallBearing, radial_load: ArrayLike, axial_load: ArrayLike) -> NDArray:
    """P0 = max(X0 Fr + Y0 Fa, Fr) of a single row [N]; ISO 76, table 2, linear between its angles."""
    radial, axial = np.asarray(radial_load, float), np.abs(np.asarray(axial_load, float))
    if bearing.kind is BearingKind.DEEP_GROOVE:
        both = _X0_DEEP_GROOVE * radial + _Y0_DEEP_GROOVE * axial
    else:
        both = _X0_ANGULAR * radial + np.interp(BearingNumbers(bearing).nominal_angle, _ANGLE, _Y0) * axial
    return np.asarray(np.maximum(both, radial))


@dataclass(frozen=True)
class StaticSafety:
    """How far each case is from a permanent dent; arrays of shape (*cases)."""

    static_load_rating: NDArray
    """C0 [N]."""
    static_equivalent_load: NDArray
    """P0 of the ring's radial and axial load [N]."""
    static_safety: NDArray
    """S0 = C0/P0 [-], by the standard's load distribution."""
    contact_safety: NDArray
    """(4200 MPa/p0)^3 of the most highly pressed contact: the factor by which its load may grow [-]."""
    warnings: Remarks


def static_safety(solution: Solution, *, static_load_rating: ArrayLike | None = None) -> StaticSafety:
    """Static safety of each case, by the standard and by the solved contact pressures.

    Args:
        static_load_rating: C0 [N], as a catalogue prints it; None: from the geometry.

    Raises:
        SceneError: a rating out of range.
    """
    raise_if_any(static_safety_errors(static_load_rating=static_load_rating))
    bearing = solution.scene.bearing
    rating = _rating(bearing) if static_load_rating is None else np.asarray(static_load_rating, float)
    rating = np.broadcast_to(rating, solution.shape)
    axial, radial = solution.load[..., 0], np.hypot(solution.load[..., 1], solution.load[..., 2])
    equivalent = static_equivalent_load(bearing, radial, axial)
    pressure = largest_pressure(solution)
    with np.errstate(divide="ignore"):
        safety, contact = rating / equivalent, (STATIC_PRESSURE / pressure) ** 3
    moment = np.hypot(solution.load[..., 3], solution.load[..., 4])
    arm = 0.5 * np.asarray(bearing.pitch_diameter, float)
    found = [
        (
            contact < 1.0,
            f"a contact is pressed beyond {STATIC_PRESSURE / MPa:.0f} MPa: it yields, and the elastic results are no "
            "longer true",
        ),
        (
            moment > 0.05 * arm * np.maximum(equivalent, np.finfo(float).tiny),
            "the ring carries a moment, which P0 of ISO 76 does not know; contact_safety does",
        ),
        (
            BearingNumbers(bearing).is_hybrid,
            f"ceramic balls are judged by {STATIC_PRESSURE / MPa:.0f} MPa like steel ones; ISO 20056-2 allows somewhat "
            "more and asks for larger safety factors",
        ),
    ]
    return StaticSafety(rating, equivalent, safety, contact, remarks(found, solution.shape))


def static_safety_errors(*, static_load_rating: ArrayLike | None = None) -> list[ErrorDetail]:
    """Every error of the arguments of `static_safety`."""
    return [] if static_load_rating is None else within("static_load_rating", static_load_rating, FORCE, 1e-3, 1e9)


_rating = static_load_rating  # where an argument has the function's name


def largest_pressure(solution: Solution) -> NDArray:
    """The highest contact pressure of each case [Pa]; NaN where a case is not solved."""
    solution.read_at_once(("max_pressure",))
    pressures = of_balls(solution.inner.max_pressure, solution.outer.max_pressure)
    return np.asarray(filled_cases(solution, 1, _find_largest, *pressures)[0])


@entry
def _find_largest(inner: NDArray, outer: NDArray, begin: int, stop: int, out: NDArray) -> None:
    for k in range(begin, stop):
        largest = -inf
        for j in range(inner.shape[1]):
            for pressure in (inner[k, j], outer[k, j]):
                if pressure > largest:  # not so where there is no ball
                    largest = pressure
        out[0, k] = nan if largest == -inf else largest
