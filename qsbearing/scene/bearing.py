"""The bearing: independent lengths and materials, and the lengths, masses and inertias that follow from them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.contact.hertz import effective_modulus
from qsbearing.scene.material import STEEL, Material
from qsbearing.validation import (
    ANGLE,
    COUNT,
    DENSITY,
    LENGTH,
    MODULUS,
    RATIO,
    ErrorDetail,
    SceneError,
    choose,
    first,
    numeric,
    raise_if_any,
    unit_mistake,
    within,
)

# Wide enough for a watch and a slewing ring; narrow enough to catch a length in the wrong unit.
BALL_COUNT_RANGE = (1, 1000)
_LENGTH_RANGES = {
    "ball_diameter": (5e-5, 1.0),
    "pitch_diameter": (1e-4, 20.0),
    "inner_groove_radius": (2.5e-5, 1.0),
    "outer_groove_radius": (2.5e-5, 1.0),
}
GROOVE_COEFFICIENT_MAX = 1.0
FREE_ANGLE_MAX = 85.0 * pi / 180.0


class BearingKind(StrEnum):
    """Which way the raceway shoulders carry axial load."""

    ANGULAR_CONTACT = "angular_contact"
    """Axial load in +x only: contact angles below zero would lie on the open side."""
    DEEP_GROOVE = "deep_groove"
    """Shoulders on both sides: contact angles of either sign."""


@dataclass(frozen=True)
class BallBearing:
    """A single-row ball bearing; SI units and radians. Any number may be an array, which spans cases.

    Raises:
        SceneError: some field describes no bearing; every error, at once.
    """

    ball_count: ArrayLike
    """Z [-]."""
    ball_diameter: ArrayLike
    """D [m]."""
    pitch_diameter: ArrayLike
    """dm, of the circle of ball centres [m]."""
    inner_groove_radius: ArrayLike
    """ri, across the groove [m]; more than half the ball diameter."""
    outer_groove_radius: ArrayLike
    """ro, across the groove [m]; more than half the ball diameter."""
    free_contact_angle: ArrayLike
    """alpha0, of the line of contact when all clearance is just taken up without load [rad]."""
    ball_material: Material = STEEL
    ring_material: Material = STEEL
    kind: BearingKind = BearingKind.ANGULAR_CONTACT
    name: str = ""

    def __post_init__(self) -> None:
        kind, errors = choose("bearing.kind", self.kind, BearingKind)
        object.__setattr__(self, "kind", kind)
        raise_if_any(errors + bearing_errors(self))

    @classmethod
    def from_diametral_clearance(cls, *, diametral_clearance: ArrayLike, **fields: Any) -> BallBearing:
        """The bearing whose free contact angle follows from its diametral clearance Pd [m].

        cos(alpha0) = 1 - Pd/(2 B D): Harris & Kotzalas; the other fields as for `BallBearing`.
        """
        inner, outer, ball = (
            numeric("", fields[name], LENGTH)[0]
            for name in ("inner_groove_radius", "outer_groove_radius", "ball_diameter")
        )
        errors = []
        angle: ArrayLike = 0.0  # stands in while the other fields are checked
        if inner is not None and outer is not None and ball is not None:
            distance = inner + outer - ball
            errors = _clearance_errors(diametral_clearance, distance)
            if not errors and (distance > 0.0).all():
                angle = free_angle_from_clearance(diametral_clearance, distance)
        try:
            bearing = cls(free_contact_angle=angle, **fields)
        except SceneError as error:
            raise SceneError([*error.errors, *errors]) from None
        raise_if_any(errors)
        return bearing

    def _array(self, name: str) -> NDArray:
        return np.asarray(getattr(self, name), float)

    @property
    def groove_centre_distance(self) -> NDArray:
        """BD = (fi + fo - 1) D, between the unloaded groove centres [m].

        (19.7) prints fi + fo - 0.5: with it B218 would have 12.14 mm instead of 1.031 mm.
        """
        return self._array("inner_groove_radius") + self._array("outer_groove_radius") - self._array("ball_diameter")

    @property
    def diametral_clearance(self) -> NDArray:
        """Pd = 2 BD (1 - cos alpha0) [m]."""
        return 4.0 * self.groove_centre_distance * np.sin(0.5 * self._array("free_contact_angle")) ** 2

    @property
    def inner_groove_centre_radius(self) -> NDArray:
        """Ri, of the circle of inner groove centres [m]."""
        pitch, radius, ball = map(self._array, ("pitch_diameter", "inner_groove_radius", "ball_diameter"))
        return np.asarray(groove_centre_radius(pitch, radius, ball, np.cos(self._array("free_contact_angle"))))

    @property
    def ball_mass(self) -> NDArray:
        """m = rho pi D^3/6 [kg]."""
        return np.asarray(ball_mass(np.asarray(self.ball_material.density, float), self._array("ball_diameter")))

    @property
    def ball_inertia(self) -> NDArray:
        """J = m D^2/10 [kg m^2]; missing in the source."""
        return self.ball_mass * self._array("ball_diameter") ** 2 / 10.0

    @property
    def effective_modulus(self) -> NDArray:
        """E' of ball on ring [Pa]."""
        numbers = [
            np.asarray(number, float)
            for material in (self.ball_material, self.ring_material)
            for number in (material.elastic_modulus, material.poisson_ratio)
        ]
        return np.asarray(effective_modulus(*numbers))  # type: ignore[arg-type]


def ball_mass(density: Any, ball_diameter: Any) -> Any:
    """m = rho pi D^3/6 [kg]."""
    return density * (pi / 6.0) * ball_diameter**3


def groove_centre_radius(pitch_diameter: Any, groove_radius: Any, ball_diameter: Any, cos_free: Any) -> Any:
    """Ri = dm/2 + (ri - D/2) cos alpha0, of the circle of inner groove centres, in the unit of the lengths."""
    return 0.5 * pitch_diameter + (groove_radius - 0.5 * ball_diameter) * cos_free


def free_angle_from_clearance(diametral_clearance: ArrayLike, groove_centre_distance: ArrayLike) -> NDArray:
    """alpha0 from Pd: sin(alpha0/2) = sqrt(Pd/(4 BD)); NaN where the clearance is negative or too large."""
    ratio = np.asarray(diametral_clearance, float) / (4.0 * np.asarray(groove_centre_distance, float))
    with np.errstate(invalid="ignore"):
        return 2.0 * np.arcsin(np.sqrt(ratio))


def _clearance_errors(diametral_clearance: ArrayLike, groove_centre_distance: NDArray) -> list[ErrorDetail]:
    """Errors of a clearance, which must leave a free contact angle between 0 and its greatest."""
    field = "bearing.diametral_clearance"
    clearance, errors = numeric(field, diametral_clearance, LENGTH)
    if clearance is None:
        return errors
    most = 4.0 * groove_centre_distance * np.sin(0.5 * FREE_ANGLE_MAX) ** 2
    bad = (groove_centre_distance > 0.0) & ((clearance < 0.0) | (clearance > most))
    if not bad.any():
        return []
    found, limit = first(bad, clearance, most)
    problem = (
        "is negative: balls wedged between the grooves have no free contact angle"
        if found < 0.0
        else "is larger than these grooves allow: the free contact angle would pass "
        f"{np.degrees(FREE_ANGLE_MAX):.0f} degrees"
    )
    return [ErrorDetail(field, problem, found, LENGTH, (0.0, limit), unit_mistake(found, LENGTH, 0.0, limit))]


def _material_errors(field: str, material: Material) -> list[ErrorDetail]:
    if not isinstance(material, Material):
        cause = "qs.STEEL, qs.SILICON_NITRIDE or qs.Material"
        return [ErrorDetail(field, "is not a material", material, cause=cause)]
    return [
        *within(f"{field}.elastic_modulus", material.elastic_modulus, MODULUS, 1e9, 2e12),
        *within(f"{field}.poisson_ratio", material.poisson_ratio, RATIO, 0.0, 0.499),
        *within(f"{field}.density", material.density, DENSITY, 100.0, 25000.0),
    ]


def bearing_errors(bearing: BallBearing) -> list[ErrorDetail]:
    """Every error of a bearing: single fields first, then what the fields say together."""
    errors = within("bearing.ball_count", bearing.ball_count, COUNT, *BALL_COUNT_RANGE)
    count = np.ones(()) if errors else np.asarray(bearing.ball_count, float)
    if (count != np.rint(count)).any():
        (broken,) = first(count != np.rint(count), count)
        errors.append(ErrorDetail("bearing.ball_count", "is not a whole number", broken, COUNT, BALL_COUNT_RANGE))
    lengths: dict[str, NDArray] = {}  # those that are good by themselves
    for name, (low, high) in _LENGTH_RANGES.items():
        wrong = within(f"bearing.{name}", getattr(bearing, name), LENGTH, low, high)
        errors += wrong
        if not wrong:
            lengths[name] = np.asarray(getattr(bearing, name), float)
    angle = bearing.free_contact_angle
    errors += within("bearing.free_contact_angle", angle, ANGLE, 0.0, FREE_ANGLE_MAX, "is outside its range")
    errors += _material_errors("bearing.ball_material", bearing.ball_material)
    errors += _material_errors("bearing.ring_material", bearing.ring_material)
    diameter = lengths.pop("ball_diameter", None)
    if diameter is not None:
        for name, length in lengths.items():
            if name == "pitch_diameter":
                errors += _pitch_errors(length, diameter, count)
            else:
                errors += _groove_errors(f"bearing.{name}", length, diameter)
    return errors


def _groove_errors(field: str, radius: NDArray, diameter: NDArray) -> list[ErrorDetail]:
    coefficient = radius / diameter
    bad = (coefficient <= 0.5) | (coefficient > GROOVE_COEFFICIENT_MAX)
    if not bad.any():
        return []
    f, r, d = first(bad, coefficient, radius, diameter)
    if f <= 0.5:
        problem = f"the groove is smaller than the ball: f = r/D = {f:.4g}, and must be above 0.5"
        cause = "A groove tighter than its ball touches at two edges, not at a point; 0.515 to 0.54 is usual"
        if 0.5 < 1e3 * f <= GROOVE_COEFFICIENT_MAX:
            cause = "Given in another unit than the ball diameter?"
        elif 0.5 < 2.0 * f < 0.6:
            cause = "Was the ball's radius given as its diameter, or the reverse?"
    else:
        problem = f"the groove is far larger than the ball: f = r/D = {f:.4g}, and may be at most 1"
        cause = "Was the groove's diameter given, not its radius? 0.515 to 0.54 is usual for f"
        if not 0.5 < f / 2.0 <= 0.6:
            cause = "Given in another unit than the ball diameter?"
    return [ErrorDetail(field, problem, r, LENGTH, (0.5 * d, GROOVE_COEFFICIENT_MAX * d), cause)]


def _pitch_errors(pitch: NDArray, diameter: NDArray, count: NDArray) -> list[ErrorDetail]:
    # Neighbours' centres stand 2 (dm/2) sin(pi/Z) apart; one ball needs only to miss the axis.
    room = np.where(count >= 2, diameter / np.sin(pi / np.maximum(count, 2)), diameter)
    tight = pitch <= room
    if not tight.any():
        return []
    dm, d, least, balls = first(tight, pitch, diameter, room, count)
    problem, cause = "is no larger than the ball", "Fewer or smaller balls, or a larger pitch circle"
    if balls >= 2:
        problem = (
            f"the balls do not fit on the pitch circle: {balls:.0f} balls need a circle of more than {least / d:.4g} "
            "ball diameters"
        )
    if least < 1e3 * dm < 50.0 * least:
        cause = "Given in another unit than the ball diameter?"
    return [ErrorDetail("bearing.pitch_diameter", problem, dm, LENGTH, (least, 20.0), cause)]
