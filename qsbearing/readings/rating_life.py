"""Rating life from the solved ball loads: ISO/TS 16281's reference life, and ISO 281's next to it.

Sources: ISO/TS 16281:2008, as published implementations have it (github.com/minzhun/ISO16281, equations 19 to 29);
ISO 281:2007; G. Lundberg & A. Palmgren 1947. Lives are counted in revolutions of one ring against the other.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import partial
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.model.described import given_in
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa
from qsbearing.model.validation import FORCE, RATIO, ErrorDetail, Setting, choose, within
from qsbearing.readings.ball_motion import ring_speeds
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.cleanliness import Cleanliness, contamination_factor
from qsbearing.readings.dynamic_rating import (
    INNER_GROOVE_COVERED,
    OUTER_GROOVE_COVERED,
    RATING_FACTOR,
    THRUST_GROOVE_COVERED,
    Capacity,
    Rating,
    contact_load_rating,
    element_load_ratings,
)
from qsbearing.readings.dynamic_rating import dynamic_load_rating as rating_of_geometry
from qsbearing.readings.entry import Reading, ReadingTable, both_or_neither, simply, with_arguments
from qsbearing.readings.equivalent_load import equivalent_load
from qsbearing.readings.life_factors import (
    GREATEST_RATIO,
    LARGEST,
    LEAST_RATIO,
    life_modification_factor,
    reliability_factor,
    viscosity_ratio,
)
from qsbearing.readings.lubricant import OilState
from qsbearing.readings.passes import filled, of_balls, of_cases
from qsbearing.readings.static_rating import FatigueLimit, largest_pressure
from qsbearing.readings.static_rating import fatigue_load_limit as limit_of_geometry
from qsbearing.remarks.kinds import NOTE, SEE_CHOICES, WRONG, Kind
from qsbearing.remarks.remark import Holding, Remark, Remarked, Remarks, remark, remarks

MILLION, HOUR = 1e6, 3600.0
ROTATING, STATIONARY = 3.0, 10.0 / 3.0
"""Exponents of the mean over a raceway's contacts: a ring that turns past the load meets all of them at every point;
one that stands tires where it is loaded most."""


PRACTICE, LONGEST_HOURS = 5.0, 200_000.0
"""aISO and a life in hours above which nobody should count on a life (chosen by practice; no standard states them)."""
NEEDS = ("load", "max_pressure"), ()

_ENDED = ", a limit of practice; wear or the lubricant will"
_GROOVES = "ISO 281's ratings hold for grooves up to f = 0.52 inside and 0.53 outside, of thrust bearings 0.54"
LIFE_OF_CERAMIC = Kind(
    "life_of_ceramic", NOTE, SEE_CHOICES,
    "the dynamic rating and the life modification factor of ceramic balls are those of steel balls",
)  # fmt: skip
LIFE_DENTS = Kind(
    "life_dents", WRONG, "limits",
    "the pressure of a contact is above {limit_MPa:.0f} MPa: permanent dents, and the rating life is not valid",
)  # fmt: skip
LIFE_GROOVES_UNCOVERED = Kind(
    "life_grooves_uncovered", WRONG, SEE_CHOICES,
    f'{_GROOVES}: a wider groove carries less ({{field}} takes the grooves into account)',
    field=Setting("rating", "lundberg_palmgren"),
    setting="readings.life.rating=lundberg_palmgren",
)  # fmt: skip
LIFE_SIZE_UNCOVERED = Kind(
    "life_size_uncovered", WRONG, SEE_CHOICES, "ISO 281's table of fc covers D cos(alpha)/dm from 0.01 to 0.40"
)
LIFE_VISCOSITY_LOW = Kind("life_viscosity_low", WRONG, SEE_CHOICES, "aISO is not defined below kappa = {limit:g}")
LIFE_VISCOSITY_HIGH = Kind(
    "life_viscosity_high", NOTE, SEE_CHOICES, "kappa above {limit:g} counts as {limit:g} in aISO"
)
LIFE_OF_ARCS = Kind(
    "life_of_arcs", NOTE, SEE_CHOICES, "each arc is rated as a raceway, with C as that of one row; ISO 281 has no P"
)
LIFE_THRUST_UNCOVERED = Kind(
    "life_thrust_uncovered", WRONG, SEE_CHOICES,
    "ISO 281 has no P of a thrust bearing with less axial load than 1.25 tan(alpha) of the radial one: no L10",
)  # fmt: skip
LIFE_FACTOR_LARGE = Kind(
    "life_factor_large", NOTE, SEE_CHOICES, f"fatigue will not end this bearing: aISO is beyond {{limit:g}}{_ENDED}"
)
LIFE_FACTOR_CAPPED = Kind(
    "life_factor_capped", NOTE, SEE_CHOICES,
    "aISO is at the upper limit of ISO 281, {limit:g}: the modified life is not a prediction",
)  # fmt: skip
LIFE_LONG = Kind(
    "life_long", NOTE, SEE_CHOICES,
    f"fatigue will not end this bearing: {{life_h:,.0f}} h is beyond {{limit_h:,.0f}} h{_ENDED}",
)  # fmt: skip


@dataclass(frozen=True)
class Life(Remarked):
    """Lives of each case; arrays of shape (*cases), revolutions of one ring against the other. NaN where not solved."""

    dynamic_load_rating: NDArray
    """C [N]; of a thrust bearing (nominal angle above 45 degrees) its axial rating, and the loads below are axial."""
    basic_reference_rating_life: NDArray
    """L10r, from the solved ball loads, 90 % survive [rev]; infinite where no ball is loaded."""
    inner_life: NDArray
    """Of the inner raceway alone [rev]."""
    outer_life: NDArray
    """Of the outer raceway alone [rev]."""
    reference_load: NDArray
    """P_ref = C/(L10r/10^6)^(1/3) [N]."""
    reliability_factor: NDArray
    """a1 [-]."""
    life_modification_factor: NDArray | None
    """aISO at the reference load [-]; None unless a viscosity ratio and a contamination factor are given."""
    fatigue_load_limit: NDArray | None
    """Cu [N]; None where aISO is."""
    modified_reference_rating_life: NDArray | None
    """Lnmr = a1 aISO L10r [rev]; None where aISO is."""
    equivalent_load: NDArray
    """ISO 281's P of the ring's radial and axial load [N]; NaN outside its table."""
    basic_rating_life: NDArray
    """ISO 281's L10 = (C/P)^3 [rev], which knows neither speed nor clearance nor tilt."""
    speed: NDArray
    """Of one ring against the other [rad/s]."""
    remarks: Remarks

    @property
    def reference_rating_life(self) -> NDArray:
        """The reference life with a1 and, where it was asked for, aISO [rev]."""
        modified = self.modified_reference_rating_life
        return self.reliability_factor * self.basic_reference_rating_life if modified is None else modified

    @property
    def duration(self) -> NDArray:
        """`reference_rating_life` as time [s]; infinite at rest."""
        return self._as_time(self.reference_rating_life)

    @property
    def basic_duration(self) -> NDArray:
        """The basic reference life as time [s]; infinite at rest."""
        return self._as_time(self.basic_reference_rating_life)

    @property
    def is_at_limit(self) -> NDArray | None:
        """Whether aISO is at its limit, which then takes the place of a prediction; None where aISO is."""
        factor = self.life_modification_factor
        return None if factor is None else factor >= LARGEST

    def _as_time(self, turns: NDArray) -> NDArray:
        with np.errstate(divide="ignore"):
            return turns * 2.0 * pi / np.abs(self.speed)


RANGES = {
    "reliability": (0.9, 0.9995),
    "rating_factor": (0.5, 2.0),
    **dict.fromkeys(("dynamic_load_rating", "fatigue_load_limit"), (1e-3, 1e9)),
}
"""What the arguments of a life may be, in SI."""


def _reliability_errors(reliability: ArrayLike) -> list[ErrorDetail]:
    errors = within("reliability", reliability, RATIO, *RANGES["reliability"], "is outside the standard's table")
    for error in errors:
        if isinstance(error.value, float | int) and 90.0 <= error.value <= 99.95:
            cause = f"Given in per cent? {error.value:g} % is {error.value / 100.0:g}"
            return [replace(error, cause=cause)]
    return errors


@dataclass(frozen=True, kw_only=True)
class LifeArguments:
    """What `life` takes."""

    dynamic_load_rating: ArrayLike | None = field(
        default=None, metadata=given_in("N", RANGES["dynamic_load_rating"], printed=True)
    )
    rating: Rating = Rating.LUNDBERG_PALMGREN
    rating_factor: float = field(default=RATING_FACTOR, metadata=given_in(range=RANGES["rating_factor"]))
    capacity: Capacity = Capacity.ISO_16281
    reliability: ArrayLike = field(default=0.9, metadata=given_in(range=RANGES["reliability"]))
    viscosity_ratio: ArrayLike | None = field(default=None, metadata=given_in())
    contamination_factor: ArrayLike | None = field(default=None, metadata=given_in())
    fatigue_load_limit: ArrayLike | None = field(default=None, metadata=given_in("N", RANGES["fatigue_load_limit"]))
    fatigue_limit_by: FatigueLimit = FatigueLimit.HERTZ
    cleanliness: Cleanliness | None = None
    oil: OilState | None = None

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything out of range, and what the modified life lacks."""
        errors = [] if self.cleanliness is None else choose("cleanliness", self.cleanliness, Cleanliness)[1]
        if self.cleanliness is not None and self.contamination_factor is not None:
            cause = "Keep one: the class gives the factor"
            errors.append(ErrorDetail("cleanliness", "is given together with contamination_factor", cause=cause))
        for name, choices in (("rating", Rating), ("capacity", Capacity), ("fatigue_limit_by", FatigueLimit)):
            errors += choose(name, getattr(self, name), choices)[1]
        errors += within("rating_factor", self.rating_factor, RATIO, *RANGES["rating_factor"])
        errors += _reliability_errors(self.reliability)
        for name in ("dynamic_load_rating", "fatigue_load_limit"):
            if getattr(self, name) is not None:
                errors += within(name, getattr(self, name), FORCE, *RANGES[name])
        ratio, contamination = self.viscosity_ratio, self.contamination_factor  # 1: stands for what then follows
        if self.is_modified:
            contamination = 1.0 if contamination is None else contamination
            ratio = 1.0 if ratio is None and self._viscosity is not None else ratio
        return errors + both_or_neither(
            {
                "viscosity_ratio": (ratio, RATIO, 0.0, 1e4),
                "contamination_factor": (contamination, RATIO, 0.0, 1.0),
            },
            "The modified life needs both; leave both out for the basic one",
        )

    @property
    def is_modified(self) -> bool:
        """Whether contamination is told, by its factor or class: kappa may then follow from the oil."""
        return self.cleanliness is not None or self.contamination_factor is not None

    @property
    def _viscosity(self) -> ArrayLike | None:
        return None if self.oil is None else self.oil.kinematic_viscosity

    def lubrication(self, solution: Solution) -> tuple[ArrayLike | None, ArrayLike | None]:
        """kappa and eC, given or found; None where they are not."""
        pitch = np.asarray(solution.scene.bearing.pitch_diameter, float)
        kappa, factor = self.viscosity_ratio, self.contamination_factor
        if kappa is None and self.is_modified and self._viscosity is not None:
            inner, outer = ring_speeds(solution)
            kappa = viscosity_ratio(self._viscosity, (inner - outer)[..., 0], pitch)
        if self.cleanliness is not None and kappa is not None:
            factor = contamination_factor(self.cleanliness, kappa, pitch)
        return kappa, factor


@with_arguments(LifeArguments)
def life(solution: Solution, given: LifeArguments) -> Life:
    """Rating lives of every case.

        Qei = (mean over all Z balls of Qi^p)^(1/p), p = 3 for a turning ring, 10/3 for one that stands; Qee likewise
        L10r = [(Qci/Qei)^(-10/3) + (Qce/Qee)^(-10/3)]^(-9/10)  million revolutions

    The load stands still in space. Where neither ring turns, the inner one is meant to. Each arc of a four-point
    bearing is a raceway of its own: a ring's (Qc/Qe)^(-10/3) is the sum of its arcs'.

    Args:
        dynamic_load_rating: C [N] as a catalogue prints it; None: from the geometry.
        rating: what defines C where it follows from the geometry.
        rating_factor: bm; 1.3 for contemporary steel, 1.0 for that of the 1940s.
        capacity: what each contact's endurance is taken from; Lundberg and Palmgren's needs no C.
        reliability: share that survives, 0.9 to 0.9995.
        viscosity_ratio: kappa, and
        contamination_factor: eC, both or neither: then the modified life is computed.
        fatigue_load_limit: Cu [N] as a catalogue prints it; None: from the geometry.
        fatigue_limit_by: how it follows from the geometry.
        cleanliness: of the lubricant, by its class, which gives the contamination factor.
        oil: at its operating temperature; kappa follows from it where it is asked for and not given.

    Returns:
        Life in revolutions and hours, and the factors asked for.

    Raises:
        SceneError: every argument that is out of range, at once.

    Examples:
        >>> print(f"{qs.readings.life(qs.solve(qs.load_scene('b218'))).basic_duration / 3600:.0f} h")
        2839 h
    """
    rating, capacity = Rating(given.rating), Capacity(given.capacity)
    bearing, shape = solution.scene.bearing, solution.shape
    C = given.dynamic_load_rating
    C = rating_of_geometry(bearing, rating, given.rating_factor) if C is None else np.asarray(C, float)
    C = np.broadcast_to(C, shape)
    if capacity is Capacity.ISO_16281:
        inner_rating, outer_rating = (each[..., None] for each in element_load_ratings(bearing, C))
    else:
        inner_rating = contact_load_rating(bearing, solution.inner.angle, INNER, given.rating_factor)
        outer_rating = contact_load_rating(bearing, solution.outer.angle, OUTER, given.rating_factor)
    solution.read_at_once(*NEEDS)
    inner_turns, outer_turns = _turning(solution)
    inner = _damage(solution, solution.inner.load, inner_rating, inner_turns)
    outer = _damage(solution, solution.outer.load, outer_rating, outer_turns)
    if solution.opposite is not None:  # each arc is a raceway that must survive
        others = (INNER, inner_rating, inner_turns), (OUTER, outer_rating, outer_turns)
        more = [_of_arc(solution, given, arc, *of) for arc, of in zip(solution.opposite, others, strict=True)]
        inner, outer = inner + more[0], outer + more[1]
    with np.errstate(divide="ignore"):
        # To the power -0.9, in a third of its time.
        inner_life, outer_life, system = (
            MILLION * np.exp(-0.9 * np.log(each)) for each in (inner, outer, inner + outer)
        )
        reference = C * np.cbrt(MILLION / system)
    a1 = reliability_factor(given.reliability)
    limit, factor, modified = None, None, None
    kappa, eC = given.lubrication(solution)
    if kappa is not None and eC is not None:
        Cu = given.fatigue_load_limit
        Cu = limit_of_geometry(bearing, FatigueLimit(given.fatigue_limit_by)) if Cu is None else np.asarray(Cu, float)
        limit = np.broadcast_to(Cu, shape)
        counts = np.where(BearingNumbers(bearing).is_thrust, 3.0, 1.0) * reference
        factor = life_modification_factor(kappa, eC, limit, counts)
        modified = a1 * factor * system
    load = solution.load
    P = equivalent_load(bearing, np.hypot(load[..., 1], load[..., 2]), load[..., 0])
    if bearing.is_arched:
        P = np.full(shape, np.nan)
    with np.errstate(divide="ignore"):
        basic = MILLION * (C / P) ** 3
    operation = solution.scene.operation
    outer_speed = 0.0 if operation.outer_speed is None else np.asarray(operation.outer_speed, float)
    speed = np.broadcast_to(np.asarray(operation.speed, float) - outer_speed, shape)
    from_geometry = given.dynamic_load_rating is None and capacity is Capacity.ISO_16281
    holding: list[Holding] = [*_found(solution, rating, from_geometry, kappa)]
    said = LIFE_OF_ARCS if bearing.is_arched else LIFE_THRUST_UNCOVERED
    holding.append((np.isnan(P) & np.isfinite(system), remark(said)))
    if factor is not None:
        holding.append(((factor > PRACTICE) & (factor < LARGEST), remark(LIFE_FACTOR_LARGE, limit=PRACTICE)))
        holding.append((factor >= LARGEST, remark(LIFE_FACTOR_CAPPED, limit=LARGEST)))
    found_life = Life(
        C, system, inner_life, outer_life, reference, a1, factor, limit, modified, P, basic, speed,
        (),
    )  # fmt: skip
    hours = found_life.duration / HOUR
    holding.append((np.isfinite(hours) & (hours > LONGEST_HOURS), partial(_long, hours)))
    return replace(found_life, remarks=remarks(holding, shape))


def _long(hours: NDArray, i: int) -> Remark:
    """On the life of a case, counted along the flattened axes."""
    return remark(LIFE_LONG, life_h=float(np.ravel(hours)[i]), limit_h=LONGEST_HOURS)


def _turning(solution: Solution) -> tuple[NDArray, NDArray]:
    """Whether the inner and the outer ring turn past the load; where neither does, the inner one is meant to."""
    operation = solution.scene.operation
    inner = np.asarray(operation.speed, float) != 0.0
    outer = np.asarray(0.0 if operation.outer_speed is None else operation.outer_speed, float) != 0.0
    return inner | ~outer, outer


def _of_arc(
    solution: Solution, given: LifeArguments, arc: RacewayContacts | None, side: float, rating: NDArray, turns: NDArray
) -> NDArray:
    """The same of a ring's other arc, whose contacts endure what those of the first do; 0 where there is none."""
    if arc is None:
        return np.zeros(solution.shape)
    if Capacity(given.capacity) is not Capacity.ISO_16281:
        rating = contact_load_rating(solution.scene.bearing, arc.angle, side, given.rating_factor)
    return _damage(solution, arc.load, rating, turns)


def _damage(solution: Solution, load: NDArray, rating: NDArray, turns: NDArray) -> NDArray:
    """(Qe/Qc)^(10/3) of a raceway: unloaded balls count among the Z; NaN where a case is not solved.

    Args:
        rating: shape (*cases, 1) or (*cases, ball).
    """
    ratings = of_balls(np.broadcast_to(rating, (*solution.shape, rating.shape[-1])))[0]
    turning, count = of_cases(solution, turns, BearingNumbers(solution.scene.bearing).ball_count)
    return np.asarray(filled(solution, 1, _add_damage, turning, count, of_balls(load)[0], ratings, of_cases=True)[0])


@entry(array_of(float), array_of(float), array_of(float, 2), array_of(float, 2), int, int, array_of(float, 2))
def _add_damage(
    turns: NDArray, count: NDArray, load: NDArray, rating: NDArray, begin: int, stop: int, out: NDArray
) -> None:
    """The mean of (Q/Qc)^p over a raceway's contacts, to the power STATIONARY/p."""
    for k in range(begin, stop):
        total, endures = 0.0, 1.0 / rating[k, 0]
        for j in range(int(count[k])):
            Q = load[k, j]
            if Q == 0.0:
                continue
            if rating.shape[1] > 1:
                endures = 1.0 / rating[k, j]
            relative = Q * endures
            total += relative * relative * relative if turns[k] else relative**STATIONARY
        mean = total / count[k]
        out[0, k] = mean ** (STATIONARY / ROTATING) if turns[k] else mean


def _found(
    solution: Solution, rating: Rating, from_geometry: bool, viscosity_ratio: ArrayLike | None
) -> list[tuple[NDArray, Remark]]:
    """Where the lives leave the range of their sources."""
    numbers = BearingNumbers(solution.scene.bearing)
    inner_f, outer_f = numbers.groove_coefficient(INNER), numbers.groove_coefficient(OUTER)
    inner_most, outer_most = (
        np.where(numbers.is_thrust, THRUST_GROOVE_COVERED, most)
        for most in (INNER_GROOVE_COVERED, OUTER_GROOVE_COVERED)
    )
    wide = (inner_f > inner_most + 1e-9) | (outer_f > outer_most + 1e-9)
    holding: list[tuple[NDArray, Remark]] = [
        (numbers.is_hybrid, remark(LIFE_OF_CERAMIC)),
        (largest_pressure(solution) > STATIC_PRESSURE, remark(LIFE_DENTS, limit_MPa=STATIC_PRESSURE / MPa)),
    ]
    if from_geometry and rating is Rating.ISO_281:
        holding.append((wide, remark(LIFE_GROOVES_UNCOVERED)))
        outside = ~numbers.is_thrust & ((numbers.nominal_gamma < 0.01) | (numbers.nominal_gamma > 0.40))
        holding.append((outside, remark(LIFE_SIZE_UNCOVERED)))
    if viscosity_ratio is not None:
        kappa = np.asarray(viscosity_ratio, float)
        holding.append((kappa < LEAST_RATIO, remark(LIFE_VISCOSITY_LOW, limit=LEAST_RATIO)))
        holding.append((kappa > GREATEST_RATIO, remark(LIFE_VISCOSITY_HIGH, limit=GREATEST_RATIO)))
    return holding


ENTRY = Reading(
    name="life",
    gives="reference life of bearing and raceways from the solved ball loads; modified life; ISO 281's L10 beside",
    by="ISO/TS 16281, ISO 281, Lundberg & Palmgren",
    take=simply(life),
    record=LifeArguments,
    table=ReadingTable(
        choices=("rating", "capacity", "cleanliness", "fatigue_limit_by"),
        example="""\
dynamic_load_rating_N = 100000     # C; without it from the geometry
reliability = 0.9
cleanliness = "oil_15_12"          # for the modified life; or viscosity_ratio and contamination_factor
""",
    ),
    needs=NEEDS,
    of_case=(
        Result("dynamic_load_rating", "N"),
        Result("basic_reference_rating_life", "Mrev", symbol="L_{10r}"),
        Result("basic_duration", "h", "basic reference rating life in hours"),
        Result("inner_life", "Mrev", "life", raceway="inner"),
        Result("outer_life", "Mrev", "life", raceway="outer"),
        Result("reference_load", "N", "reference load, C/(basic reference life)^(1/3)"),
        Result("reliability_factor", words="reliability factor a1", symbol="a_1"),
        Result("life_modification_factor", words="life modification factor aISO", symbol="a_{ISO}"),
        Result("fatigue_load_limit", "N"),
        Result("modified_reference_rating_life", "Mrev"),
        Result("duration", "h", "reference life in hours, with a1 and aISO where given"),
        Result("equivalent_load", "N", "equivalent load P of ISO 281", "P"),
        Result("basic_rating_life", "Mrev", "basic rating life of ISO 281", "L_{10}"),
    ),
)
