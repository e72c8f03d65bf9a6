"""Static load rating and safety, and the fatigue load limit: loads at which a contact reaches a given pressure.

Sources: ISO 76:2006, read from GOST 18854-2013, its translation; ISO 281:2007, annex B, from GOST 18855-2013. ISO 76
prints the factor f0 for grooves of f = 0.52 inside and 0.53 outside and E = 207 GPa; exact Hertz contact reproduces all
its values to the printed rounding. Here the bearing's own grooves and materials enter, which shows what a wider groove
or ceramic balls cost. ISO 20056-2 allows hybrid bearings a somewhat higher pressure; its value was not at hand.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from math import inf, nan

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing, BearingKind
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.model.described import given_in
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, deg, mm
from qsbearing.model.validation import FORCE, ErrorDetail, within
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers, load_at_pressure
from qsbearing.readings.entry import Reading, simply, with_arguments
from qsbearing.readings.passes import filled, of_balls
from qsbearing.remarks.kinds import NOTE, SEE_CHOICES, WRONG, Kind
from qsbearing.remarks.remark import Remarked, Remarks, remark, remarks

FATIGUE_PRESSURE = 1500e6
"""Pressure below which bearing steel does not tire under ideal conditions [Pa] (ISO 281, annex B)."""

RATINGS = (1e-3, 1e9)
"""Which a data sheet may print [N]."""
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
MOST_RADIAL = 0.67
"""Fr tan(alpha)/Fa of thrust bearings up to which P0a is still satisfactory; up to 0.44 it is on the safe side."""

_X0_ANGULAR, _X0_DEEP_GROOVE, _Y0_DEEP_GROOVE = 0.5, 0.6, 0.5

STATIC_DENTS = Kind(
    "static_dents", WRONG, "limits",
    "the pressure of a contact is above {limit_MPa:.0f} MPa: permanent dents, and the contact is no longer "
    "elastic",
)  # fmt: skip
STATIC_MOMENT = Kind(
    "static_moment", WRONG, SEE_CHOICES,
    "the ring carries a moment, which P0 of ISO 76 does not include; contact_safety does",
)  # fmt: skip
STATIC_THRUST_UNCOVERED = Kind(
    "static_thrust_uncovered", WRONG, SEE_CHOICES,
    "P0 of a thrust bearing holds for radial loads up to 0.67 cot(alpha) of the axial one",
)  # fmt: skip
STATIC_OF_CERAMIC = Kind(
    "static_of_ceramic", NOTE, "readings#not-included",
    "ceramic balls are judged by {limit_MPa:.0f} MPa like steel ones; ISO 20056-2 allows more",
)  # fmt: skip


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
        load_at_pressure(pressure, *given, numbers.groove_coefficient(side), numbers.effective_modulus, side)
        for side in (INNER, OUTER)
    )
    return np.minimum(inner, outer)


def static_load_rating(bearing: BallBearing) -> NDArray:
    """C0 = Z cos(alpha) Q(4200 MPa)/5, the basic static radial load rating of one row [N].

    Q is the smaller of the two raceways' loads; ISO 76 writes f0 Z D^2 cos(alpha), f0 = Q/(5 D^2). Above a nominal
    contact angle of 45 degrees the axial one, C0a = Z sin(alpha) Q = f0 Z D^2 sin(alpha), f0 = Q/D^2.

    Returns:
        C0, (*cases,) [N].

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print(f"{qs.readings.static_load_rating(bearing) / 1e3:.1f} kN")
        85.0 kN
    """
    numbers = BearingNumbers(bearing)
    largest, angle = numbers.ball_count * _weaker_contact(bearing, STATIC_PRESSURE), numbers.nominal_angle
    return np.asarray(np.where(numbers.is_thrust, np.sin(angle), np.cos(angle) / RADIAL_SHARE) * largest)


def axial_static_load_rating(bearing: BallBearing, static_load_rating: ArrayLike) -> NDArray:
    """0.7 C0/Y0, the axial load that the static rating of an angular-contact bearing stands for under thrust [N].

    ISO 76:2006, A.5: 40 degrees, Y0 = 0.26. For nominal angles up to 45 degrees; NaN above, where the rating is axial.

    Args:
        static_load_rating: C0, its radial rating [N].

    Returns:
        C0a, (*cases,) [N].

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print(f"{qs.readings.axial_static_load_rating(bearing, 60e3) / 1e3:.1f} kN")
        161.5 kN
    """
    numbers = BearingNumbers(bearing)
    axial = 0.7 * np.asarray(static_load_rating, float) / _axial_factor(bearing)
    return np.asarray(np.where(numbers.is_thrust, np.nan, axial))


def fatigue_load_limit(
    bearing: BallBearing, by: FatigueLimit = FatigueLimit.HERTZ, static_rating: ArrayLike | None = None
) -> NDArray:
    """Cu, the load of one row below which its steel does not tire [N]; ISO 281:2007, annex B.

    0.2288 Z Qu cos(alpha), Qu the smaller load at which a contact reaches 1500 MPa; or C0/22. Either is multiplied by
    (100 mm/dm)^0.5 above a pitch diameter of 100 mm. Thrust bearings: Z Qu sin(alpha), an axial load.

    Args:
        static_rating: C0 [N] where it does not follow from the geometry.

    Returns:
        Cu, (*cases,) [N].

    Examples:
        >>> bearing = qs.load_scene("b218").bearing
        >>> print(f"{qs.readings.fatigue_load_limit(bearing):.0f} N")
        3956 N
    """
    numbers = BearingNumbers(bearing)
    if FatigueLimit(by) is FatigueLimit.STATIC_RATING:
        limit = (static_load_rating(bearing) if static_rating is None else np.asarray(static_rating)) / SIMPLE_DIVISOR
    else:
        weakest = _weaker_contact(bearing, FATIGUE_PRESSURE)
        angle = numbers.nominal_angle
        share = np.where(numbers.is_thrust, np.sin(angle), HALF_LOADED * np.cos(angle))
        limit = numbers.ball_count * weakest * share
    return np.asarray(limit * np.minimum(SMALL_PITCH / numbers.pitch_diameter, 1.0) ** 0.5)


def static_equivalent_load(bearing: BallBearing, radial_load: ArrayLike, axial_load: ArrayLike) -> NDArray:
    """P0 = max(X0 Fr + Y0 Fa, Fr) of a single row [N]; ISO 76, table 2, linear between its angles.

    Thrust bearings: P0a = 2.3 Fr tan(alpha) + Fa, an axial load; for Fr/Fa up to 0.44 cot(alpha), NaN above 0.67
    cot(alpha). These three numbers were not compared with a source.
    """
    radial, axial = np.asarray(radial_load, float), np.abs(np.asarray(axial_load, float))
    numbers = BearingNumbers(bearing)
    X0 = _X0_DEEP_GROOVE if bearing.kind is BearingKind.DEEP_GROOVE else _X0_ANGULAR
    P0 = np.maximum(X0 * radial + _axial_factor(bearing) * axial, radial)
    if not numbers.is_thrust.any():
        return np.asarray(P0)
    steepness = np.tan(numbers.nominal_angle)
    thrust = np.where(radial * steepness <= MOST_RADIAL * axial, 2.3 * radial * steepness + axial, np.nan)
    return np.asarray(np.where(numbers.is_thrust, thrust, P0))


def _axial_factor(bearing: BallBearing) -> NDArray:
    """Y0."""
    if bearing.kind is BearingKind.DEEP_GROOVE:
        return np.asarray(_Y0_DEEP_GROOVE)
    return np.asarray(np.interp(BearingNumbers(bearing).nominal_angle, _ANGLE, _Y0))


@dataclass(frozen=True)
class StaticSafety(Remarked):
    """How far each case is from a permanent dent; arrays of shape (*cases)."""

    static_load_rating: NDArray
    """C0 [N]."""
    static_equivalent_load: NDArray
    """P0 of the ring's radial and axial load [N]."""
    static_safety: NDArray
    """S0 = C0/P0 [-], by the standard's load distribution."""
    contact_safety: NDArray
    """(4200 MPa/p0)^3 of the most highly pressed contact: the factor by which its load may grow [-]."""
    remarks: Remarks


@dataclass(frozen=True, kw_only=True)
class StaticSafetyArguments:
    """What `static_safety` takes."""

    static_load_rating: ArrayLike | None = field(default=None, metadata=given_in("N", RATINGS, printed=True))

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """A rating out of range."""
        given = self.static_load_rating
        return [] if given is None else within("static_load_rating", given, FORCE, *RATINGS)


@with_arguments(StaticSafetyArguments)
def static_safety(solution: Solution, given: StaticSafetyArguments) -> StaticSafety:
    """Static safety of each case, by the standard and by the solved contact pressures.

    Args:
        static_load_rating: C0 [N], as a catalogue prints it; None: from the geometry.

    Returns:
        S0 by the standard, and by the solved pressures.

    Raises:
        SceneError: a rating out of range.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(f"{qs.readings.static_safety(solution).static_safety:.1f}")
        18.4
    """
    bearing, rating = solution.scene.bearing, given.static_load_rating
    rating = np.asarray(static_load_rating(bearing) if rating is None else rating, float)
    rating = np.broadcast_to(rating, solution.shape)
    axial, radial = solution.load[..., 0], np.hypot(solution.load[..., 1], solution.load[..., 2])
    equivalent = static_equivalent_load(bearing, radial, axial)
    pressure = largest_pressure(solution)
    with np.errstate(divide="ignore"):
        safety, contact = rating / equivalent, (STATIC_PRESSURE / pressure) ** 3
    moment = np.hypot(solution.load[..., 3], solution.load[..., 4])
    arm = 0.5 * np.asarray(bearing.pitch_diameter, float)
    limit = STATIC_PRESSURE / MPa
    holding = [
        (contact < 1.0, remark(STATIC_DENTS, limit_MPa=limit)),
        (moment > 0.05 * arm * np.maximum(equivalent, np.finfo(float).tiny), remark(STATIC_MOMENT)),
        (np.isnan(equivalent) & np.isfinite(radial), remark(STATIC_THRUST_UNCOVERED)),
        (BearingNumbers(bearing).is_hybrid, remark(STATIC_OF_CERAMIC, limit_MPa=limit)),
    ]
    return StaticSafety(rating, equivalent, safety, contact, remarks(holding, solution.shape))


def largest_pressure(solution: Solution) -> NDArray:
    """The highest contact pressure of each case [Pa]; NaN where a case is not solved."""
    solution.read_at_once(("max_pressure",))
    pressures = of_balls(solution.inner.max_pressure, solution.outer.max_pressure)
    for arc in filter(None, solution.opposite or ()):
        pressures[0] = np.fmax(pressures[0], of_balls(arc.max_pressure)[0])
    return np.asarray(filled(solution, 1, _find_largest, *pressures, of_cases=True)[0])


@entry(array_of(float, 2), array_of(float, 2), int, int, array_of(float, 2))
def _find_largest(inner: NDArray, outer: NDArray, begin: int, stop: int, out: NDArray) -> None:
    for k in range(begin, stop):
        largest = -inf
        for j in range(inner.shape[1]):
            for pressure in (inner[k, j], outer[k, j]):
                if pressure > largest:  # not so where there is no ball
                    largest = pressure
        out[0, k] = nan if largest == -inf else largest


ENTRY = Reading(
    name="static_safety",
    gives="C0/P0, and the factor by which the most loaded contact may still be loaded",
    by="ISO 76",
    take=simply(static_safety),
    record=StaticSafetyArguments,
    needs=(("max_pressure",), ()),
    of_case=(
        Result("static_load_rating", "N"),
        Result("static_equivalent_load", "N", "static equivalent load P0 of ISO 76", "P_0"),
        Result("static_safety", words="static safety C0/P0"),
        Result("contact_safety", words="static limit over load, most pressed contact"),
    ),
)
