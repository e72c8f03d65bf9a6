"""What a catalogue prints of a bearing, as far as its inner geometry can be inferred from it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from qsbearing.inference.practice import RatingPractice, practice_errors
from qsbearing.model.bearing import BearingKind
from qsbearing.model.bearing_errors import FREE_ANGLE_MAX, LARGEST_USUAL_F
from qsbearing.model.described import given_in
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
    "ball_count": (COUNT, 2.0, 1000.0),
    "ball_diameter": (LENGTH, 5e-5, 1.0),
    "pitch_diameter": (LENGTH, 1e-4, 20.0),
    "groove_radius_coefficient": (RATIO, 0.5001, LARGEST_USUAL_F),
}


@dataclass(frozen=True, kw_only=True)
class DataSheet:
    """A row of a catalogue; SI units and radians. What is None is not known.

    Raises:
        SceneError: by `infer_bearing`, with everything that is wrong with it.
    """

    bore_diameter: float = field(metadata=given_in("mm"))
    outside_diameter: float = field(metadata=given_in("mm"))
    dynamic_load_rating: float = field(metadata=given_in("N"))
    """C of one row [N]."""
    static_load_rating: float = field(metadata=given_in("N"))
    """C0 of one row [N]."""
    free_contact_angle: float | None = field(default=None, metadata=given_in("deg"))
    diametral_clearance: float | None = field(default=None, metadata=given_in("mm"))
    """In place of the free contact angle; of a deep groove bearing."""
    kind: BearingKind = BearingKind.ANGULAR_CONTACT
    maker: str = ""
    rating_practice: RatingPractice | None = None
    """What C and C0 mean; None: as the maker is known to use them, or unknown."""
    dynamic_rating_factor: float | None = field(default=None, metadata=given_in())
    """C printed over that of ISO 281, of a series."""
    static_rating_factor: float | None = field(default=None, metadata=given_in())
    """C0 printed over that of ISO 76, of a series."""
    f0: float | None = field(default=None, metadata=given_in())
    """Of ISO 76, as printed [-]."""
    pair_rigidity: float | None = field(default=None, metadata=given_in("N/um"))
    """Axial rigidity of a back-to-back pair at its preload [N/m]."""
    pair_preload: float | None = field(default=None, metadata=given_in("N"))
    """[N]."""
    ball_count: int | None = field(default=None, metadata=given_in("balls"))
    ball_diameter: float | None = field(default=None, metadata=given_in("mm"))
    pitch_diameter: float | None = field(default=None, metadata=given_in("mm"))
    """Of the circle of ball centres; None: halfway between bore and outside diameter."""
    groove_radius_coefficient: float | None = field(default=None, metadata=given_in())
    """f = r/D of both grooves."""
    ball_material: Material = STEEL
    ring_material: Material = STEEL
    name: str = ""

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
    for name, (quantity, low, high) in _RANGES.items():
        if np.ndim(given[name]):
            errors.append(ErrorDetail(f"bearing.{name}", "is an array; a data sheet is one row"))
        elif given[name] is not None:
            errors += within(f"bearing.{name}", given[name], quantity, low, high)
    for side in ("ball_material", "ring_material"):
        errors += material_errors(f"bearing.{side}", given[side])
    errors += practice_errors(sheet.maker, sheet.rating_practice, given)
    if sheet.free_contact_angle is None and sheet.diametral_clearance is None:
        field, cause = "free_contact_angle", "As the data sheet prints it"
        if sheet.kind == BearingKind.DEEP_GROOVE:
            field, cause = "diametral_clearance", "The ratings do not tell it: as mounted, of its class"
        errors.append(ErrorDetail(f"bearing.{field}", "missing", cause=cause))
    elif None not in (sheet.free_contact_angle, sheet.diametral_clearance):
        cause = "One follows from the other and the grooves, which are inferred: keep one"
        both = Sentence("is given together with {angle}", angle=Field("free_contact_angle"))
        errors.append(ErrorDetail("bearing.diametral_clearance", both, cause=cause))
    for one, other in (("pair_preload", "pair_rigidity"), ("pair_rigidity", "pair_preload")):
        if given[one] is None and given[other] is not None:
            errors.append(ErrorDetail(f"bearing.{one}", "missing", cause="A rigidity belongs to its preload"))
    if not errors and sheet.outside_diameter <= 1.02 * sheet.bore_diameter:
        problem = f"leaves no room for rings around a bore of {sheet.bore_diameter / mm:.6g} mm"
        errors.append(ErrorDetail("bearing.outside_diameter", problem, sheet.outside_diameter, LENGTH))
    if not errors and sheet.ball_count is not None and sheet.ball_count != int(sheet.ball_count):
        errors.append(ErrorDetail("bearing.ball_count", "is not a whole number", float(sheet.ball_count), COUNT))
    return errors
