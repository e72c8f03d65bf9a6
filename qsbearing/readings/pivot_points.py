"""Where nothing slides in a contact that rolls and spins at once: its pivot points, on the major axis of the ellipse.

By `ellipse_sliding`: with t = roll a^2/(2 R), s = spin a and c, which no net traction in the rolling direction gives,

    v(X) = t (c - X^2) + s X = 0,     X = [s -/+ sqrt(s^2 + 4 t^2 c)]/(2 t)

and on the major axis spin drags nothing across. Without spin these are Heathcote's two lines of pure rolling, at
+/-0.347 of the semi-major axis; with it one of them moves inwards, the other outwards and off the ellipse.

Range: as friction; c is good to 1e-4 of the ellipse but where spin is a thousand times what rolling slides.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.ball_motion import NEEDS, BallMotion, RacewayMotion, control_remarks, kinematics
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.ellipse_sliding import PLACES, SLENDEREST, deformed_radius, mean_sliding_speed
from qsbearing.readings.entry import Reading, check_solution
from qsbearing.remarks.remark import Remarked, Remarks

FINE = 18
"""Halvings of the interval of c, for the table."""

LARGEST_SHARE = 1.0 - 1e-3
"""Share of spin s/(s + t) up to which c is computed; beyond, it hardly moves the pivot point, and stays."""


@dataclass(frozen=True)
class RacewayPivots:
    """Pivot points in the contacts of one raceway; arrays of shape (*cases, ball).

    Along the major axis from the ellipse's centre, positive towards larger contact angles [m]. NaN without load, and
    where the ellipse ends before.
    """

    near: NDArray
    """The one nearer to the centre [m]; about it the contact spins."""
    far: NDArray
    """The other one [m]."""


@dataclass(frozen=True)
class PivotPoints(Remarked):
    """Of a solution."""

    inner: RacewayPivots
    outer: RacewayPivots
    remarks: Remarks


def pivot_points(solution: Solution) -> PivotPoints:
    """Where nothing slides, in every contact.

    Returns:
        Of every contact, where nothing slides.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(qs.readings.pivot_points(solution).inner.near[0] * 1e3)
        0.001959152994555767
    """
    check_solution("pivot_points", solution)
    return _of_motion(solution, kinematics(solution))


def _of_motion(solution: Solution, motion: BallMotion) -> PivotPoints:
    inner = _raceway(solution, solution.inner, motion.inner, INNER)
    outer = _raceway(solution, solution.outer, motion.outer, OUTER)
    return PivotPoints(inner, outer, control_remarks(solution))


def _raceway(solution: Solution, contacts: RacewayContacts, moving: RacewayMotion, side: float) -> RacewayPivots:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    R = deformed_radius(numbers.ball_diameter, numbers.groove_radius(side))[..., None]
    a = contacts.semi_major_axis
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = contacts.semi_minor_axis / a
    t, s = moving.rolling_speed * a**2 / (2.0 * R), moving.spin_speed * a
    near, far = zeros(t, s, rolling_place(t, s, ratio))
    # The formula's x grows towards smaller contact angles, inside and outside.
    return RacewayPivots(*(np.where(np.abs(X) <= 1.0, -X * a, np.nan) for X in (near, far)))


def zeros(t: NDArray, s: NDArray, c: NDArray) -> tuple[NDArray, NDArray]:
    """Zeros of t (c - X^2) + s X, the one nearer to zero first; the stable way: their product is -c."""
    with np.errstate(invalid="ignore", divide="ignore"):
        largest = 0.5 * (s + np.where(s >= 0.0, 1.0, -1.0) * np.sqrt(s**2 + 4.0 * t**2 * c))
        return -c * t / largest, largest / t


def rolling_place(t: NDArray, s: NDArray, ratio: NDArray) -> NDArray:
    """c, from a table over the share of spin and the logarithm of b/a."""
    total = np.abs(t) + np.abs(s)
    share = np.abs(s) / np.where(total > 0.0, total, 1.0)
    known = np.isfinite(share) & np.isfinite(ratio)
    places = (
        np.minimum(np.where(known, share, 0.0), LARGEST_SHARE),
        np.log(np.clip(np.where(known, ratio, 1.0), SLENDEREST, 1.0)),
    )
    return np.where(known, _table().ev(*places), np.nan)


@cache
def _table() -> Any:
    from scipy.interpolate import RectBivariateSpline

    share, logarithm = np.linspace(0.0, LARGEST_SHARE, PLACES[0]), np.linspace(np.log(SLENDEREST), 0.0, PLACES[1])
    s, ratio = share[:, None], np.exp(logarithm)
    return RectBivariateSpline(share, logarithm, mean_sliding_speed(1.0 - s, s, ratio, halvings=FINE)[1], s=0)


ENTRY = Reading(
    name="pivot_points",
    gives="where on each ellipse nothing slides",
    by="Heathcote, Jones",
    take=lambda solution, given, taken: _of_motion(solution, taken.get("kinematics") or kinematics(solution)),
    needs=NEEDS,
    of_contact=(
        Result("near_pivot", "mm", "pivot point nearer to the centre", path="near", is_signed=True),
        Result("far_pivot", "mm", "other pivot point", path="far", is_signed=True),
    ),
    scope="Pivot points: where nothing slides, from the centre of the ellipse along its major axis.",
)
