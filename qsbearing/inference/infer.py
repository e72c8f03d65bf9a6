"""The bearings that a data sheet allows, each of its ball sets with the least, usual and largest groove radius."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.inference.ball_passes import with_ball_set
from qsbearing.inference.ball_sets import BallSets
from qsbearing.inference.data_sheet import DataSheet, RigidityKind, sheet_errors
from qsbearing.inference.narrowing import Range, range_of, shares_removed
from qsbearing.inference.nearest import nearest_set
from qsbearing.inference.practice import (
    ACCEPTED,
    FACTORS,
    ISO,
    OWN_GROOVE,
    Practice,
    RatingPractice,
    how_to_state,
    practice_of,
)
from qsbearing.inference.proportions import likely_sets, proportions_of
from qsbearing.inference.ratings_fit import WORST_ALONE, Fitted, fitted, joined, of_known_balls
from qsbearing.inference.rigidity import grooves_of_rigidity, kind_of, pair_rigidity
from qsbearing.model.bearing import BallBearing, BearingKind, Outline
from qsbearing.model.units import mm
from qsbearing.model.validation import LENGTH, ErrorDetail, Field, SceneError, Setting, raise_if_any
from qsbearing.readings.dynamic_rating import dynamic_load_rating
from qsbearing.remarks.kinds import CHECK, NOTE, Kind
from qsbearing.remarks.remark import Warned, remark

TYPICAL_PRELOAD = 0.01
"""Part of C at which a rigidity is predicted that nobody gave: about a medium preload."""
MOST_LISTED = 30
"""Sets; those with the largest misfit are left out."""
GROOVES = [1, 0, 2]
"""The three cases of a set: its usual groove radius, the least and the largest."""

SHEET_SETS_LEFT_OUT = Kind(
    "sheet_sets_left_out",
    CHECK,
    "data_sheet",
    "of {sets} ball sets the {solved} that fit best are solved",
    setting="bearing.ball_set=1",
)
SHEET_GROOVE_ASSUMED = Kind(
    "sheet_groove_assumed", NOTE, "data_sheet",
    "the ratings do not tell the groove radius: f = {least:.3f} to {most:.3f} is assumed",
)  # fmt: skip
SHEET_GUESSED = Kind(
    "sheet_guessed", CHECK, "data_sheet",
    "the ratings of this bearing are not known here: its balls are guessed by the proportions of its series, for "
    "stiffness and pressure, not for life. Printed ratings replace the guess: {field} and the static one",
    field=Field("bearing.dynamic_load_rating"),
)  # fmt: skip
SHEET_RATINGS_UNSTATED = Kind(
    "sheet_ratings_unstated", CHECK, "data_sheet",
    "nothing states what the ratings mean: they agree with the standards, perhaps by chance, and are read so and "
    "as those of the bearing's own grooves. Add whose they are, such as {field}",
    field=Setting("maker", "SKF"),
    setting="bearing.maker=SKF",
)  # fmt: skip


@dataclass(frozen=True)
class InferredBearing:
    """Every bearing that a data sheet allows, best first; arrays of shape (case,), three cases to a ball set, nine
    where only the class of its clearance is known."""

    bearing: BallBearing
    """All of them: its numbers are arrays, which span the cases of a scene. Of a set's three cases the first has its
    usual groove radius, the others have the least and the largest; of nine the first three have the usual clearance,
    the others the least and the largest."""
    set_number: NDArray
    """Which cases have the same balls; from 0."""
    misfit: NDArray
    """How badly its ratings fit: a sum of squares over usual deviations [-]. Not a probability."""
    practice: NDArray
    """What C and C0 were read as."""
    sheet: DataSheet
    """What it was inferred from."""
    remarks: tuple[Warned, ...] = ()
    """What there is to beware of, in sentences."""
    others: tuple[DataSheet, ...] = ()
    """Those of other makers, whose sets are in the list too."""

    def at(self, case: int) -> BallBearing:
        """The bearing of one case; of case 0 that which fits best, which often is not the true one."""
        own = {each.name: getattr(self.bearing, each.name) for each in fields(self.bearing)}
        return replace(self.bearing, **{name: each[case].item() for name, each in own.items() if np.ndim(each)})

    @staticmethod
    def range_of(values: ArrayLike) -> Range:
        """The least and largest of a result, shape (case,), and the cases that have them; NaN where none is solved."""
        return range_of(np.asarray(values, float))

    def shares_removed(self, values: ArrayLike) -> dict[str, float]:
        """What part of a result's range would go, on average, if one more number were known.

        Args:
            values: of the result, shape (case,).

        Returns:
            By `ball_count`, `ball_diameter`, `diametral_clearance` and `pair_rigidity`, those that are not given; 0:
            nothing, 1: all of it.
        """
        names = [name for name in ("ball_count", "ball_diameter") if getattr(self.sheet, name) is None]
        names += ["diametral_clearance"] * (self.sheet.clearance_class is not None)
        known = {name: np.round(np.asarray(getattr(self.bearing, name)), 12) for name in names}
        is_known = self.sheet.pair_rigidity is not None or self.sheet.clearance_class is not None
        rigidity = None if is_known else self._rigidity  # of rows with clearance it would tell two numbers at once
        return shares_removed(np.asarray(values, float), self.set_number, known, rigidity)

    @cached_property
    def _rigidity(self) -> NDArray:
        rating = self.sheet.dynamic_load_rating
        return pair_rigidity(
            self.bearing, TYPICAL_PRELOAD * (dynamic_load_rating(self.at(0)) if rating is None else rating)
        )


def infer_bearing(*sheets: DataSheet, **numbers: Any) -> InferredBearing:
    """The ball sets and groove radii that a row of a catalogue allows: always a list.

    C and C0 mean different things at different makers, so that the practice comes first: `maker`, or
    `rating_practice`. A known `ball_count`, `ball_diameter`, `pitch_diameter`, `f0`, `groove_radius_coefficient` or a
    `pair_rigidity` at its `pair_preload` shortens the list or its ranges. `outer_ball_pass` and `inner_ball_pass` tell
    the ball set without any rating.

    Args:
        sheets: the data sheet, whose fields may be given by keyword instead; several are of one size at several makers,
            whose sets are listed together.

    Returns:
        Every set within the practice's tolerance, as cases of one bearing.

    Raises:
        SceneError: what is wrong with the numbers; that no set has them; or that nothing tells the practice.

    Sources: ISO 281:2007, ISO 76:2006; what makers do with them was measured on rows of five catalogues (guide page
    data_sheet).

    Examples:
        >>> inferred = qs.infer_bearing(
        ...     bore_diameter=50 * qs.mm, outside_diameter=80 * qs.mm, free_contact_angle=15 * qs.deg,
        ...     dynamic_load_rating=26_900, static_load_rating=23_100, maker="NTN",
        ... )
        >>> print(inferred.bearing.ball_count)
        [20. 20. 20.]
    """
    remarks: list[Warned] = []
    completed = [_checked(replace(sheet, **numbers), remarks) for sheet in sheets or (DataSheet(**numbers),)]
    sheet, *others = completed
    fits = _of_makers([_fits(each, remarks) for each in completed], completed) if others else _fits(sheet, remarks)
    if fits.misfit.size > MOST_LISTED:
        remarks.append(remark(SHEET_SETS_LEFT_OUT, sets=fits.misfit.size, solved=MOST_LISTED).said())
        fits = fits.taken(np.arange(MOST_LISTED))
    known = sheet.groove_radius_coefficient
    if sheet.pair_rigidity is not None and sheet.pair_preload is not None and known is None:
        kind = kind_of(sheet.maker, sheet.pair_rigidity_kind)
        groove, is_met = grooves_of_rigidity(
            lambda f: _bearing(sheet, fits.sets, f), sheet.pair_rigidity, sheet.pair_preload, kind, fits.groove[:, 1]
        )
        fits = fits._replace(groove=groove).taken(is_met)
        if not fits.misfit.size:
            problem = f"no ball set of this data sheet has it at its preload, as {_AS_KIND[kind]}, whatever the groove"
            raise SceneError([ErrorDetail("bearing.pair_rigidity", problem, sheet.pair_rigidity, cause=_OTHER_KIND)])
    elif known is None and (fits.practice != RatingPractice.OWN_GROOVE).any():
        remarks.append(remark(SHEET_GROOVE_ASSUMED, least=fits.groove.min(), most=fits.groove.max()).said())
    grooves, clearances = _cases(sheet)
    f = fits.groove[:, grooves].reshape(-1)
    repeated = [np.repeat(each, len(grooves)) for each in (*fits.sets, fits.misfit, fits.practice)]
    number = np.repeat(np.arange(fits.misfit.size), len(grooves))
    bearing = _bearing(sheet, BallSets(*repeated[:2]), f, np.tile(clearances, fits.misfit.size))
    said = tuple(dict.fromkeys(remarks))
    return InferredBearing(bearing, number, repeated[2], repeated[3], sheet, said, tuple(others))


def _cases(sheet: DataSheet) -> tuple[NDArray, NDArray]:
    """Which groove radius and which clearance [m] the cases of each set have, the usual ones first; NaN where the angle
    is given."""
    clearances = sheet.clearances or (np.nan,)
    return np.tile(GROOVES, len(clearances)), np.repeat(clearances, len(GROOVES))


_AS_KIND = {
    RigidityKind.TANGENT: "twice the stiffness of one bearing",
    RigidityKind.UNLOADING: "the load that unloads one row over its deflection",
}
_OTHER_KIND = 'Axial, of a back-to-back pair; pair_rigidity_kind = "tangent" or "unloading" says how it is meant'


def _checked(sheet: DataSheet, remarks: list[Warned]) -> DataSheet:
    """With the balls that its frequencies tell."""
    raise_if_any(sheet_errors(sheet))
    return with_ball_set(replace(sheet, kind=BearingKind(sheet.kind)), remarks)


def _fits(sheet: DataSheet, remarks: list[Warned]) -> Fitted:
    """The sets of one data sheet, best first, at least one."""
    if sheet.rating_practice == RatingPractice.PROPORTIONS:
        return _guessed(sheet, remarks)
    known = sheet.ball_count, sheet.ball_diameter, sheet.groove_radius_coefficient
    if None not in known or sheet.dynamic_load_rating is None or sheet.static_load_rating is None:
        return of_known_balls(sheet)
    factors = tuple(getattr(sheet, name) for name in FACTORS)
    practice = practice_of(sheet.maker, sheet.rating_practice, factors, sheet.kind, sheet.free_contact_angle)
    if practice is None:
        return _unstated(sheet, remarks)
    fits = fitted(sheet, practice)
    if not fits.misfit.size:
        raise SceneError([_no_set(sheet, practice)])
    is_told = any(each is not None for each in (sheet.ball_count, sheet.ball_diameter, sheet.f0))
    is_alone = not is_told and len(set(zip(*fits.sets, strict=True))) == 1
    if practice.kind == RatingPractice.SERIES_FACTORS and is_alone and fits.misfit[0] > WORST_ALONE:
        raise SceneError([_alone(sheet, fits)])
    return fits


def _of_makers(fits: list[Fitted], sheets: list[DataSheet]) -> Fitted:
    """All of them, each set once, with the makers whose ratings allow it."""
    named = [
        each._replace(practice=np.array([f"{kind}, {sheet.maker}" for kind in each.practice]))
        for each, sheet in zip(fits, sheets, strict=True)
    ]
    every = joined(named)
    first: dict[tuple[float, float], int] = {}
    practices = [str(each) for each in every.practice]
    for number, balls in enumerate(zip(*every.sets, strict=True)):
        kept = first.setdefault(balls, number)
        if kept != number and practices[number] not in practices[kept].split("; "):
            practices[kept] += f"; {practices[number]}"
    return every._replace(practice=np.array(practices)).taken(np.array(list(first.values())))


def _guessed(sheet: DataSheet, remarks: list[Warned]) -> Fitted:
    """By the proportions of its series, which is said."""
    of = proportions_of(sheet)
    fits = None if of is None else likely_sets(sheet, of)
    if fits is None or not fits.misfit.size:
        problem = "tells no balls: none of this dimension series, kind and angle are known here"
        if of is not None:
            known = "" if sheet.ball_count is None else f" of {sheet.ball_count:g} balls"
            problem = f"tells no ball set{known}: none is usual between these rings"
        cause = "Give dynamic_load_rating and static_load_rating, or outer_ball_pass and inner_ball_pass"
        raise SceneError([ErrorDetail("bearing.rating_practice", problem, "proportions", cause=cause)])
    remarks.append(remark(SHEET_GUESSED).said())
    return fits


def _unstated(sheet: DataSheet, remarks: list[Warned]) -> Fitted:
    """Where nobody states the practice: ISO's, if both ratings agree closely, beside own grooves; else it asks."""
    if not fitted(sheet, replace(ISO, within=ACCEPTED)).misfit.size:
        problem = "cannot be read: nothing states what the ratings mean, and they are not ISO's as printed"
        cause = f"{how_to_state(sheet.maker)}. Read by the wrong rule, C and C0 give a wrong ball set"
        raise SceneError([ErrorDetail("bearing.dynamic_load_rating", problem, sheet.dynamic_load_rating, cause=cause)])
    remarks.append(remark(SHEET_RATINGS_UNSTATED).said())
    return joined([fitted(sheet, ISO), fitted(sheet, OWN_GROOVE)])


_HOW = {
    RatingPractice.ISO: "by ISO 281 and ISO 76",
    RatingPractice.OWN_GROOVE: "with grooves of f = 0.508 to 0.535",
    RatingPractice.SERIES_FACTORS: "by ISO 281 and ISO 76 times the factors",
}


def _alone(sheet: DataSheet, fits: Fitted) -> ErrorDetail:
    """Of a single set that fits badly."""
    balls = f"{fits.sets.counts[0]:.0f} x {fits.sets.diameters[0] / mm:.6g} mm"
    problem = f"one ball set alone, {balls}, has these ratings {_HOW[RatingPractice.SERIES_FACTORS]}, and badly"
    detail = f"its misfit is {fits.misfit[0]:.2g}, of a single set {WORST_ALONE:g} are believed"
    cause = "The factors are likely those of other rows: take those of a row near in size, or give ball_count"
    return ErrorDetail("bearing.static_load_rating", problem, sheet.static_load_rating, cause=cause, detail=detail)


def _no_set(sheet: DataSheet, practice: Practice) -> ErrorDetail:
    nearest = nearest_set(sheet, practice)
    if nearest is None:
        problem = "no usual ball fits between rings of this bore and outside diameter"
        cause = "Both in millimetres, of the whole bearing? Else give ball_count and ball_diameter"
        return ErrorDetail("bearing.outside_diameter", problem, sheet.outside_diameter, LENGTH, cause=cause)
    given = [name for name in ("ball_count", "ball_diameter", "f0") if getattr(sheet, name) is not None]
    known = ", ".join(name.replace("_", " ") for name in given)
    problem = f"no ball set between these rings has these ratings {_HOW[practice.kind]}"
    problem += f", with this {known}" * bool(known)
    cause = (
        f"{nearest}. Of one row, in newtons? Series of light balls, such as GMN's KH, follow neither: "
        f'rating_practice = "series_factors" with {" and ".join(FACTORS)}'
    )
    return ErrorDetail("bearing.static_load_rating", problem, sheet.static_load_rating, cause=cause)


def _bearing(sheet: DataSheet, sets: BallSets, f: NDArray, clearance: NDArray | None = None) -> BallBearing:
    given: dict[str, Any] = {
        "ball_count": sets.counts, "ball_diameter": sets.diameters, "pitch_diameter": sheet.pitch,
        "inner_groove_radius": f * sets.diameters, "outer_groove_radius": f * sets.diameters,
        "ball_material": sheet.ball_material, "ring_material": sheet.ring_material,
        "kind": sheet.kind, "name": sheet.name, "outline": Outline(sheet.bore_diameter, sheet.outside_diameter),
    }  # fmt: skip
    if sheet.clearances:
        clearance = np.full(f.shape, sheet.clearances[0]) if clearance is None else clearance
        return BallBearing.from_diametral_clearance(diametral_clearance=clearance, **given)
    return BallBearing(free_contact_angle=np.full(f.shape, sheet.free_contact_angle), **given)
