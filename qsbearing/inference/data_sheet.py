"""What a catalogue prints of a bearing, as far as its inner geometry can be inferred from it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

import numpy as np

from qsbearing.inference.clearance import ClearanceClass, clearance_limits
from qsbearing.inference.practice import RatingPractice, practice_errors
from qsbearing.model.bearing import BearingKind
from qsbearing.model.bearing_errors import FREE_ANGLE_MAX, LARGEST_USUAL_F
from qsbearing.model.described import given_in, one_of
from qsbearing.model.material import STEEL, Material, material_errors
from qsbearing.model.units import N, mm, um
from qsbearing.model.validation import (
    ANGLE,
    COUNT,
    FORCE,
    LENGTH,
    RATIO,
    ErrorDetail,
    Field,
    Quantity,
    Sentence,
    choose,
    within,
)

STIFFNESS = Quantity("N/m", (("N_per_um", "newtons per micrometre", N / um),))
_RANGES: dict[str, tuple[Quantity, float, float]] = {
    "bore_diameter": (LENGTH, 1e-4, 20.0),
    "outside_diameter": (LENGTH, 2e-4, 20.0),
    "dynamic_load_rating": (FORCE, 1.0, 1e9),
    "static_load_rating": (FORCE, 1.0, 1e9),
    "free_contact_angle": (ANGLE, 0.0, FREE_ANGLE_MAX),
    "diametral_clearance": (LENGTH, 0.0, 0.01),
    "dynamic_rating_factor": (RATIO, 0.2, 2.0),
    "static_rating_factor": (RATIO, 0.2, 5.0),
    "f0": (RATIO, 2.0, 20.0),
    "pair_rigidity": (STIFFNESS, 1e5, 1e11),
    "pair_preload": (FORCE, 0.1, 1e8),
    "outer_ball_pass": (RATIO, 0.5, 500.0),
    "inner_ball_pass": (RATIO, 0.5, 500.0),
    "ball_spin": (RATIO, 0.2, 500.0),
    "ball_count": (COUNT, 2.0, 1000.0),
    "ball_diameter": (LENGTH, 5e-5, 1.0),
    "pitch_diameter": (LENGTH, 1e-4, 20.0),
    "groove_radius_coefficient": (RATIO, 0.5001, LARGEST_USUAL_F),
}


class SizeSteps(StrEnum):
    """Which diameters are looked at."""

    INCH = "inch"
    """Steps of inches."""
    ANY = "any"
    """Beside them whole and half millimetres."""


class RigidityKind(StrEnum):
    """What a printed axial rigidity of a pair is."""

    TANGENT = "tangent"
    """The slope of load over displacement at the preload."""
    UNLOADING = "unloading"
    """The axial load that unloads one row, over the displacement at which it does."""


@dataclass(frozen=True, kw_only=True)
class DataSheet:
    """A row of a catalogue; SI units and radians. What is None is not known.

    Raises:
        SceneError: by `infer_bearing`, with everything that is wrong with it.
    """

    bore_diameter: float = field(metadata=given_in("mm"))
    """Of the bearing [m]."""
    outside_diameter: float = field(metadata=given_in("mm"))
    """Of the bearing [m]."""
    dynamic_load_rating: float | None = field(default=None, metadata=given_in("N"))
    """C of one row [N]; None where the balls are known without it, or guessed by proportions."""
    static_load_rating: float | None = field(default=None, metadata=given_in("N"))
    """C0 of one row [N]; likewise."""
    free_contact_angle: float | None = field(default=None, metadata=given_in("deg"))
    """As printed [rad]."""
    diametral_clearance: float | None = field(default=None, metadata=given_in("mm"))
    """In place of the free contact angle [m]; of a deep groove bearing."""
    clearance_class: ClearanceClass | None = field(default=None, metadata=one_of(ClearanceClass))
    """In place of both, of a deep groove bearing: the clearance of ISO 5753-1 by its bore, usual, least and largest."""
    kind: BearingKind = field(default=BearingKind.ANGULAR_CONTACT, metadata=one_of(BearingKind))
    """Angular-contact or deep-groove."""
    maker: str = ""
    """Whose catalogue it is, such as SKF: by it follow the rules by which C and C0 are printed."""
    rating_practice: RatingPractice | None = field(default=None, metadata=one_of(RatingPractice))
    """What C and C0 mean; None: as the maker is known to use them, or unknown."""
    dynamic_rating_factor: float | None = field(default=None, metadata=given_in())
    """C printed over that of ISO 281, of a series [-]."""
    static_rating_factor: float | None = field(default=None, metadata=given_in())
    """C0 printed over that of ISO 76, of a series [-]."""
    f0: float | None = field(default=None, metadata=given_in())
    """Of ISO 76, as printed [-]."""
    pair_rigidity: float | None = field(default=None, metadata=given_in("N/um"))
    """Axial rigidity of a back-to-back pair at its preload [N/m]."""
    pair_preload: float | None = field(default=None, metadata=given_in("N"))
    """[N]."""
    pair_rigidity_kind: RigidityKind | None = field(default=None, metadata=one_of(RigidityKind))
    """None: as the maker is known to print it, else the tangent."""
    outer_ball_pass: float | None = field(default=None, metadata=given_in())
    """How often a ball passes a point of the outer ring in one revolution of the inner one [-]; with `inner_ball_pass`
    it tells the ball set."""
    inner_ball_pass: float | None = field(default=None, metadata=given_in())
    """Likewise a point of the inner ring [-]."""
    ball_spin: float | None = field(default=None, metadata=given_in())
    """How often a ball turns about itself, or twice that, as makers print it [-]; a check."""
    ball_count: int | None = field(default=None, metadata=given_in("balls"))
    """If it is known."""
    ball_diameter: float | None = field(default=None, metadata=given_in("mm"))
    """Where it is known [m]."""
    pitch_diameter: float | None = field(default=None, metadata=given_in("mm"))
    """Of the circle of ball centres [m]; None: halfway between bore and outside diameter."""
    groove_radius_coefficient: float | None = field(default=None, metadata=given_in())
    """f = r/D of both grooves [-]."""
    size_steps: SizeSteps | None = field(default=None, metadata=one_of(SizeSteps))
    """None: in inches, as nearly all are; of deep groove bearings of dimension series 18 in millimetres too."""
    ball_material: Material = STEEL
    ring_material: Material = STEEL
    name: str = ""
    """The designation, for headings and errors."""

    @property
    def clearances(self) -> tuple[float, ...]:
        """The usual diametral clearance [m], and where only its class is given the least and the largest; empty where
        the free contact angle is given."""
        if self.clearance_class is None:
            return () if self.diametral_clearance is None else (self.diametral_clearance,)
        least, most = clearance_limits(self.bore_diameter, ClearanceClass(self.clearance_class)) or (0.0, 0.0)
        return 0.5 * (least + most), least, most

    @property
    def pitch(self) -> float:
        """The pitch diameter [m]."""
        return (
            0.5 * (self.bore_diameter + self.outside_diameter) if self.pitch_diameter is None else self.pitch_diameter
        )


def sheet_errors(sheet: DataSheet) -> list[ErrorDetail]:
    """Everything that is wrong with a data sheet."""
    given: dict[str, Any] = vars(sheet)
    errors = choose("bearing.kind", sheet.kind, BearingKind)[1]
    if sheet.kind == BearingKind.FOUR_POINT:
        cause = "Give its balls, grooves, free contact angle and shims"
        errors.append(ErrorDetail("bearing.kind", "cannot be inferred from a data sheet", str(sheet.kind), cause=cause))
    for name, choices in _CHOICES.items():
        if given[name] is not None:
            errors += choose(f"bearing.{name}", given[name], choices)[1]
    for name, (quantity, low, high) in _RANGES.items():
        if np.ndim(given[name]):
            errors.append(ErrorDetail(f"bearing.{name}", "is an array; a data sheet is one row"))
        elif given[name] is not None:
            errors += within(f"bearing.{name}", given[name], quantity, low, high)
    for side in ("ball_material", "ring_material"):
        errors += material_errors(f"bearing.{side}", given[side])
    errors += practice_errors(sheet.maker, sheet.rating_practice, given)
    errors += [
        ErrorDetail(f"bearing.{one}", "missing", cause=cause)
        for pair, cause in _PAIRS
        for one, other in (pair, pair[::-1])
        if given[one] is None and given[other] is not None
    ]
    if needs_ratings(given):
        lacking = [name for name in _RATINGS if given[name] is None]
        errors += [ErrorDetail(f"bearing.{name}", "missing", cause="As the data sheet prints it") for name in lacking]
    errors += _angle_errors(sheet)
    if not errors and sheet.outside_diameter <= 1.02 * sheet.bore_diameter:
        problem = f"leaves no room for rings around a bore of {sheet.bore_diameter / mm:.6g} mm"
        errors.append(ErrorDetail("bearing.outside_diameter", problem, sheet.outside_diameter, LENGTH))
    if not errors and sheet.ball_count is not None and sheet.ball_count != int(sheet.ball_count):
        errors.append(ErrorDetail("bearing.ball_count", "is not a whole number", float(sheet.ball_count), COUNT))
    return errors


def _angle_errors(sheet: DataSheet) -> list[ErrorDetail]:
    """Of the free contact angle and what stands in place of it."""
    names = ("free_contact_angle", "diametral_clearance", "clearance_class")
    given = [name for name in names if getattr(sheet, name) is not None]
    if not given:
        field, cause = "free_contact_angle", "As the data sheet prints it"
        if sheet.kind == BearingKind.DEEP_GROOVE:
            field, cause = "diametral_clearance", "The ratings do not tell it: as mounted, or clearance_class"
        return [ErrorDetail(f"bearing.{field}", "missing", cause=cause)]
    if len(given) > 1:
        cause = "One follows from the other and the grooves, which are inferred: keep one"
        both = Sentence("is given together with {angle}", angle=Field(given[0]))
        return [ErrorDetail(f"bearing.{given[-1]}", both, cause=cause)]
    return [] if sheet.clearance_class is None else _class_errors(sheet)


def _class_errors(sheet: DataSheet) -> list[ErrorDetail]:
    wrong = choose("bearing.clearance_class", sheet.clearance_class, ClearanceClass)[1]
    if wrong or np.ndim(sheet.bore_diameter):
        return wrong
    if sheet.kind != BearingKind.DEEP_GROOVE:
        problem, cause = "is of deep groove bearings", "Give free_contact_angle"
        return [ErrorDetail("bearing.clearance_class", problem, str(sheet.clearance_class), cause=cause)]
    if clearance_limits(sheet.bore_diameter, ClearanceClass(sheet.clearance_class or "CN")) is None:
        problem = f"is not known of a bore of {sheet.bore_diameter / mm:.6g} mm"
        cause = "Give diametral_clearance"
        return [ErrorDetail("bearing.clearance_class", problem, str(sheet.clearance_class), cause=cause)]
    return []


def needs_ratings(given: Mapping[str, Any], ending: str = "") -> bool:
    """Whether only ratings tell the balls: neither given themselves nor by how often they pass, nor to be guessed.

    Args:
        given: numbers and words by name; what is None or lacks is not given.
        ending: of the name of a length, its unit.
    """
    known = {name for name, each in given.items() if each is not None}
    is_guessed = given.get("rating_practice") == RatingPractice.PROPORTIONS
    return not (is_guessed or {"ball_count", f"ball_diameter{ending}"} <= known or set(_PASSES) <= known)


_RATINGS = ("dynamic_load_rating", "static_load_rating")
_PASSES = ("outer_ball_pass", "inner_ball_pass")
_PAIRS = (
    (("pair_preload", "pair_rigidity"), "A rigidity belongs to its preload"),
    (_PASSES, "Both add up to the ball count"),
    (_RATINGS, "As the data sheet prints it"),
)
"""Numbers of which one is given only with the other."""
_CHOICES: dict[str, type[StrEnum]] = {"size_steps": SizeSteps, "pair_rigidity_kind": RigidityKind}
