"""Catalogue estimates of a bearing's frictional torque, to compare with the integrated one: SKF's and Palmgren's.

Sources: SKF General Catalogue, pp. 88-103; A. Palmgren's formula with Schaeffler's factors (HR 1, pp. 54-60; ISO 15312
uses the same form). Both rest on whole bearings: bore, outside diameter and series, which a scene does not hold.
Formulas in N, mm, rpm, mm^2/s; N mm. What each contains, its range and its use: `friction_models`; the condition on
the speed is of SKF's "The SKF model for calculating the frictional moment".
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing, BearingKind
from qsbearing.model.described import given_in, inputs_of
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.rounding import rounding_of_load, without_rounding
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import Nmm, deg, mm, rpm
from qsbearing.model.validation import (
    FORCE,
    LENGTH,
    RATIO,
    SPEED,
    ErrorDetail,
    Field,
    Quantity,
    choose,
    first,
    raise_if_any,
    within,
)
from qsbearing.readings.ball_motion import ring_speeds
from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.readings.entry import Reading, ReadingTable, check_solution, simply, with_arguments
from qsbearing.readings.film_thickness import inlet_shear_heating
from qsbearing.readings.friction_models import PALMGREN, SKF, FrictionModel
from qsbearing.readings.lubricant import OilState
from qsbearing.readings.static_rating import static_equivalent_load
from qsbearing.remarks.kinds import NOTE, SEE_CHOICES, WRONG, Kind
from qsbearing.remarks.remark import Remark, Remarked, Remarks, remark, remarks

SPEED_RATING_UNKNOWN = Kind(
    "speed_rating_unknown", NOTE, SEE_CHOICES,
    "SKF's friction model is valid below the bearing's speed rating, which is not given ({field})",
    field=Field("speed_rating"),
)  # fmt: skip
SPEED_RATING_EXCEEDED = Kind(
    "speed_rating_exceeded", WRONG, SEE_CHOICES,
    "the speed is above the bearing's speed rating, the limit of SKF's friction model: its torque and heat are "
    "extrapolated",
)  # fmt: skip


class Series(StrEnum):
    """Dimension series of deep-groove bearings in SKF's table; angular-contact ones have one row for all."""

    S60 = "60"
    """60xx."""
    S62 = "62"
    """62xx."""
    S63 = "63"
    """63xx."""
    S618 = "618"
    """618xx."""
    S619 = "619"
    """619xx."""


class _Groove(NamedTuple):
    R1: float
    R2: float
    S1: float
    S2: float


_DEEP_GROOVE = {
    Series.S60: _Groove(4.1e-7, 1.7, 3.73e-3, 14.6),
    Series.S62: _Groove(3.9e-7, 1.7, 3.23e-3, 36.5),
    Series.S63: _Groove(3.7e-7, 1.7, 2.84e-3, 92.8),
    Series.S618: _Groove(4.7e-7, 1.7, 6.50e-3, 0.78),
    Series.S619: _Groove(4.3e-7, 1.7, 4.75e-3, 3.6),
}
_R1, _R2, _R3, _S1, _S2, _S3 = 5.03e-7, 1.97, 1.90e-12, 1.30e-2, 0.68, 1.91e-12
"""Single-row angular-contact bearings."""

RANGES = {"static_load_rating": (1.0, 1e9), "lubrication_factor": (0.1, 20.0), "speed_rating": (1e-3, 1e6)}
"""What the arguments may be, in SI."""
HYBRID = 0.41
"""R3 and S3, of the balls' centrifugal force, with ceramic balls."""


@dataclass(frozen=True)
class FrictionEstimate(Remarked):
    """A catalogue's estimate; arrays of shape (*cases)."""

    torque: NDArray
    """[N m]."""
    power: NDArray
    """torque times the speed of one ring against the other [W]."""
    model: FrictionModel
    """What it contains, its range, and its use."""
    remarks: Remarks = ()


@dataclass(frozen=True)
class FrictionEstimates(Remarked):
    """What catalogues would estimate; None for an estimate whose numbers are not given."""

    skf: FrictionEstimate
    """By SKF's model."""
    palmgren: FrictionEstimate | None
    """By Palmgren's; None where C0 is not given."""
    speed_factor: NDArray
    """n dm: speed of one ring against the other by the mean of bore and outside diameter; shape (*cases) [m rad/s]."""
    speed_over_rating: NDArray | None
    """That speed over the bearing's rating; shape (*cases) [-]; None without it."""

    @property
    def models(self) -> tuple[FrictionModel, ...]:
        """What each estimate contains, its range, and its use."""
        return tuple(each.model for each in (self.skf, self.palmgren) if each is not None)

    @property
    def remarks(self) -> Remarks:  # type: ignore[override]
        """Those of SKF's estimate; Palmgren's has none."""
        return self.skf.remarks


@dataclass(frozen=True)
class EstimateArguments:
    """What `friction_estimates` takes: those of `skf_torque` and `palmgren_torque`."""

    bore_diameter: float = field(metadata=given_in("mm", printed=True))
    outside_diameter: float = field(metadata=given_in("mm", printed=True))
    kinematic_viscosity: ArrayLike
    series: Series | None = None
    static_load_rating: float | None = field(
        default=None, metadata=given_in("N", RANGES["static_load_rating"], printed=True)
    )
    lubrication_factor: float | None = field(default=None, metadata=given_in(range=RANGES["lubrication_factor"]))
    speed_rating: float | None = field(default=None, metadata=given_in("rpm", RANGES["speed_rating"]))

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything out of range; a deep-groove bearing needs its series and C0."""
        is_deep_groove = bearing is not None and bearing.kind is BearingKind.DEEP_GROOVE
        outside, bore = self.outside_diameter, self.bore_diameter
        errors = within("bore_diameter", bore, LENGTH, 1e-4, 10.0)
        errors += within("outside_diameter", outside, LENGTH, 1e-4, 20.0)
        if not errors and (too_small := np.asarray(outside) <= np.asarray(bore)).any():
            (wrong,) = first(too_small, np.asarray(outside))
            problem = "is no larger than the bore"
            errors.append(ErrorDetail("outside_diameter", problem, wrong, LENGTH, where=too_small))
        errors += within("kinematic_viscosity", self.kinematic_viscosity, Quantity("m^2/s"), 1e-7, 1.0)
        if is_deep_groove or self.series is not None:
            errors += choose("series", self.series, Series)[1]
        if is_deep_groove or self.static_load_rating is not None:
            errors += within("static_load_rating", self.static_load_rating, FORCE, *RANGES["static_load_rating"])
        if self.lubrication_factor is not None:
            errors += within("lubrication_factor", self.lubrication_factor, RATIO, *RANGES["lubrication_factor"])
            if self.static_load_rating is None:
                errors.append(ErrorDetail("static_load_rating", "missing", detail="Palmgren's estimate needs it"))
        if self.speed_rating is not None:
            errors += within("speed_rating", self.speed_rating, SPEED, *RANGES["speed_rating"])
        return errors


def _arguments(oil: OilState, bore_diameter: Any, outside_diameter: Any, **given: Any) -> EstimateArguments:
    given |= {"bore_diameter": bore_diameter, "outside_diameter": outside_diameter}
    return EstimateArguments(kinematic_viscosity=oil.kinematic_viscosity, **given)  # type: ignore[arg-type]


@with_arguments(EstimateArguments)
def friction_estimates(solution: Solution, given: EstimateArguments) -> FrictionEstimates:
    """SKF's estimate; Palmgren's too where C0 and f0 are given. Arguments: `skf_torque`, `palmgren_torque`.

    Returns:
        The estimates that the numbers given allow.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> estimates = qs.readings.friction_estimates(solution, 90 * qs.mm, 160 * qs.mm, 20e-6)
        >>> print(f"{estimates.skf.torque:.2f} N m")
        6.52 N m
    """
    whole = {name: getattr(given, name) for name in ("bore_diameter", "outside_diameter", "kinematic_viscosity")}
    rating, palmgren = given.static_load_rating, None
    skf = skf_torque(solution, **whole, series=given.series, static_load_rating=rating, speed_rating=given.speed_rating)
    if rating is not None and given.lubrication_factor is not None:
        factor = given.lubrication_factor
        palmgren = palmgren_torque(solution, **whole, static_load_rating=rating, lubrication_factor=factor)
    speed = _loads(solution)[2] * rpm
    over_rating = None if given.speed_rating is None else speed / given.speed_rating
    return FrictionEstimates(skf, palmgren, speed * 0.5 * (given.bore_diameter + given.outside_diameter), over_rating)


def skf_torque(
    solution: Solution,
    *,
    bore_diameter: float,
    outside_diameter: float,
    kinematic_viscosity: ArrayLike,
    series: Series | None = None,
    static_load_rating: float | None = None,
    sliding_coefficient: float = 0.05,
    replenishment: float = 3e-8,
    speed_rating: float | None = None,
) -> FrictionEstimate:
    """SKF's model: M = phi_ish phi_rs Grr (nu n)^0.6 + mu_sl Gsl, without seals and oil-bath drag.

    Args:
        bore_diameter, outside_diameter: d and D of the bearing [m].
        kinematic_viscosity: nu at the operating temperature [m^2/s].
        series: of a deep-groove bearing.
        static_load_rating: C0 of a deep-groove bearing [N].
        sliding_coefficient: mu_EHL: 0.05 mineral oil, 0.04 synthetic, 0.1 transmission fluid.
        replenishment: Krs: 3e-8 low oil bath or oil jet, 6e-8 grease or oil spot.
        speed_rating: of the bearing, as its catalogue prints it [rad/s]: the model holds below it, and warns above it.

    Returns:
        The torque and its parts [N m].

    Raises:
        SceneError: numbers out of range, or what a deep-groove bearing needs missing; every error, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> found = qs.readings.skf_torque(
        ...     solution, bore_diameter=90 * qs.mm, outside_diameter=160 * qs.mm, kinematic_viscosity=20e-6
        ... )
        >>> print(f"{found.torque:.2f} N m")
        6.52 N m
    """
    check_solution("skf_torque", solution)
    bearing = solution.scene.bearing
    deep = bearing.kind is BearingKind.DEEP_GROOVE
    size = bore_diameter, outside_diameter, kinematic_viscosity
    raise_if_any(EstimateArguments(*size, series, static_load_rating, None, speed_rating).errors(bearing))
    radial, axial, n = _loads(solution)
    dm = 0.5 * (bore_diameter + outside_diameter) / mm
    nu = np.asarray(kinematic_viscosity, float) / mm**2
    if deep:
        assert series is not None
        Grr, Gsl = deep_groove_terms(
            _DEEP_GROOVE[Series(series)], dm, radial, axial, np.asarray(static_load_rating, float)
        )
    else:
        Grr, Gsl = angular_contact_terms(dm, n, radial, axial, BearingNumbers(bearing).is_hybrid)
    starved = replenishment_factor(
        nu, n, bore_diameter / mm, outside_diameter / mm, 3.1 if deep else 4.4, replenishment
    )
    rolling = inlet_shear_heating(n * rpm, dm * mm, nu * mm**2) * starved * Grr * (nu * n) ** 0.6
    boundary = np.exp(-2.6e-8 * (n * nu) ** 1.4 * dm)
    sliding = (boundary * 0.15 + (1.0 - boundary) * sliding_coefficient) * Gsl
    of_speed: tuple[ArrayLike, Remark] = (True, remark(SPEED_RATING_UNKNOWN))
    if speed_rating is not None:
        of_speed = (n * rpm > np.asarray(speed_rating), remark(SPEED_RATING_EXCEEDED))
    return _estimate(solution, rolling + sliding, SKF, remarks([of_speed], solution.shape))


def angular_contact_terms(
    dm: float, n: NDArray, radial: NDArray, axial: NDArray, is_hybrid: NDArray
) -> tuple[NDArray, NDArray]:
    """(Grr, Gsl) of single-row angular-contact bearings."""
    thrown = dm**4 * n**2 * np.where(is_hybrid, HYBRID, 1.0)
    Grr = _R1 * dm**1.97 * (radial + _R3 * thrown + _R2 * axial) ** 0.54
    Gsl = _S1 * dm**0.26 * ((radial + _S3 * thrown) ** (4.0 / 3.0) + _S2 * axial ** (4.0 / 3.0))
    return Grr, Gsl


def deep_groove_terms(
    row: _Groove, dm: float, radial: NDArray, axial: NDArray, static_load_rating: NDArray
) -> tuple[NDArray, NDArray]:
    """(Grr, Gsl) of deep-groove bearings; without thrust the model has exponents of its own."""
    sine = np.sin(24.6 * (np.maximum(axial, 1e-12) / static_load_rating) ** 0.24 * deg)
    Grr = row.R1 * dm**1.96 * (radial + row.R2 * axial / sine) ** 0.54
    Gsl = np.where(
        axial > 0.0,
        row.S1 * dm**-0.145 * (radial**5 + row.S2 * dm**1.5 * axial**4 / sine) ** (1.0 / 3.0),
        row.S1 * dm**-0.26 * radial ** (5.0 / 3.0),
    )
    return Grr, Gsl


def replenishment_factor(nu: NDArray, n: NDArray, bore: float, outside: float, KZ: float, Krs: float) -> NDArray:
    """phi_rs = exp[-Krs nu n (d + D) sqrt(KZ/(2 (D - d)))]: the track is not oiled again in time."""
    return np.asarray(np.exp(-Krs * nu * n * (bore + outside) * np.sqrt(KZ / (2.0 * (outside - bore)))))


def palmgren_torque(
    solution: Solution,
    *,
    bore_diameter: float,
    outside_diameter: float,
    kinematic_viscosity: ArrayLike,
    static_load_rating: float,
    lubrication_factor: float,
) -> FrictionEstimate:
    """Palmgren's M = f0 (nu n)^(2/3) dM^3 1e-7 + f1 P1 dM; below nu n = 2000 mm^2/s rpm f0 160e-7 dM^3 + f1 P1 dM.

    The two meet there to the rounding of 160: 0.8 % of the first part.

    Args:
        bore_diameter, outside_diameter: d and D of the bearing [m]; dM is their mean.
        kinematic_viscosity: nu at the operating temperature [m^2/s].
        static_load_rating: C0 [N].
        lubrication_factor: f0, as the catalogue gives it for the series and the way of lubrication: 1.1 to 4.

    f1 = 0.001 (P0/C0)^0.33 for angular contact and 0.0009 (P0/C0)^0.5 for deep groove; P1 = Fa - 0.1 Fr and 3.3 Fa -
    0.1 Fr, at least Fr. Thrust bearings, of nominal angles above 45 degrees: f1 = 0.0012 (Fa/C0)^0.33 and P1 = Fa.

    Returns:
        The torque and its parts [N m].

    Raises:
        SceneError: numbers out of range; every error, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> found = qs.readings.palmgren_torque(
        ...     solution, bore_diameter=90 * qs.mm, outside_diameter=160 * qs.mm, kinematic_viscosity=20e-6,
        ...     static_load_rating=90e3, lubrication_factor=2.0,
        ... )
        >>> print(f"{found.torque:.2f} N m")
        2.17 N m
    """
    check_solution("palmgren_torque", solution)
    size = bore_diameter, outside_diameter, kinematic_viscosity
    raise_if_any(EstimateArguments(*size, None, static_load_rating, lubrication_factor).errors(None))
    radial, axial, n = _loads(solution)
    dm = 0.5 * (bore_diameter + outside_diameter) / mm
    product = np.asarray(kinematic_viscosity, float) / mm**2 * n
    relative = static_equivalent_load(solution.scene.bearing, radial, axial) / static_load_rating
    deep = solution.scene.bearing.kind is BearingKind.DEEP_GROOVE
    f1 = 0.0009 * relative**0.5 if deep else 0.001 * relative**0.33
    P1 = np.maximum((3.3 if deep else 1.0) * axial - 0.1 * radial, radial)
    is_thrust = BearingNumbers(solution.scene.bearing).is_thrust
    f1 = np.where(is_thrust, 0.0012 * (axial / static_load_rating) ** 0.33, f1)
    P1 = np.where(is_thrust, axial, P1)
    speed_part = lubrication_factor * np.where(product >= 2000.0, product ** (2.0 / 3.0), 160.0) * dm**3 * 1e-7
    return _estimate(solution, speed_part + f1 * P1 * dm, PALMGREN)


def _loads(solution: Solution) -> tuple[NDArray, NDArray, NDArray]:
    """Radial and axial load [N], and the speed of one ring against the other [rpm]; shape (*cases).

    What is rounding is none: SKF's torque of a deep-groove bearing jumps where the thrust ends.
    """
    load = without_rounding(solution.load, rounding_of_load(solution.load, solution.scene.bearing)[..., None])
    inner, outer = ring_speeds(solution)
    speed = np.broadcast_to(np.abs(inner - outer)[..., 0] / rpm, solution.shape)
    return np.hypot(load[..., 1], load[..., 2]), np.abs(load[..., 0]), speed


def _estimate(solution: Solution, torque: NDArray, model: FrictionModel, said: Remarks = ()) -> FrictionEstimate:
    """From N mm."""
    return FrictionEstimate(torque * Nmm, torque * Nmm * _loads(solution)[2] * rpm, model, said)


ENTRY = Reading(
    name="friction_estimate",
    gives="what catalogues would estimate; in Python `skf_torque`, `palmgren_torque`",
    by="SKF; Palmgren, Schaeffler",
    take=simply(friction_estimates),
    record=_arguments,
    table=ReadingTable(
        inputs=inputs_of(EstimateArguments),
        choices=("series",),
        example="""\
bore_diameter_mm = 90
outside_diameter_mm = 160
static_load_rating_N = 85000
lubrication_factor = 2
speed_rating_rpm = 6000            # from the catalogue; SKF's model holds below this speed
""",
        note="SKF's model; Palmgren's with C0 and f0; deep groove: series = \"62\" and C0",
    ),
    of_case=(
        Result("speed_factor", "mm rpm", "speed factor n dm"),
        Result("speed_over_rating"),
        Result("skf_torque", "N mm", "torque by SKF", path="skf.torque"),
        Result("skf_power", "W", "power by SKF", path="skf.power"),
        Result("palmgren_torque", "N mm", "torque by Palmgren", path="palmgren.torque"),
        Result("palmgren_power", "W", "power by Palmgren", path="palmgren.power"),
    ),
)
