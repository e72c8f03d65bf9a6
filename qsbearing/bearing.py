"""The bearing: independent lengths and materials, and the lengths, masses and inertias that follow from them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.faults import (
    ANGLE,
    COUNT,
    DENSITY,
    LENGTH,
    MODULUS,
    RATIO,
    Fault,
    SceneError,
    choose,
    likely_slip,
    numeric,
    raise_if_any,
    within,
)
from qsbearing.hertz import effective_modulus
from qsbearing.material import STEEL, Material

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

# Wide enough for a watch and a slewing ring; narrow enough to catch a length in the wrong unit.
BALL_DIAMETER_RANGE = (5e-5, 1.0)
BALL_COUNT_RANGE = (1, 1000)
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
        SceneError: some field describes no bearing; all faults at once.
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
        kind, faults = choose("bearing.kind", self.kind, BearingKind)
        object.__setattr__(self, "kind", kind)
        raise_if_any(faults + bearing_faults(self))

    @classmethod
    def from_diametral_clearance(cls, *, diametral_clearance: ArrayLike, **fields: Any) -> BallBearing:
        """The bearing whose free contact angle follows from its diametral clearance Pd [m].

        cos(alpha0) = 1 - Pd/(2 B D): Harris & Kotzalas; the other fields as for `BallBearing`.
        """
        inner, outer, ball = (
            numeric("", fields[name], LENGTH)[0]
            for name in ("inner_groove_radius", "outer_groove_radius", "ball_diameter")
        )
        faults = []
        angle: ArrayLike = 0.0  # stands in while the other fields are judged
        if inner is not None and outer is not None and ball is not None:
            distance = inner + outer - ball
            faults = clearance_faults(diametral_clearance, distance)
            if not faults and (distance > 0.0).all():
                angle = free_angle_from_clearance(diametral_clearance, distance)
        try:
            bearing = cls(free_contact_angle=angle, **fields)
        except SceneError as error:
            raise SceneError([*error.faults, *faults]) from None
        raise_if_any(faults)
        return bearing

    @property
    def inner_groove_radius_coefficient(self) -> NDArray:
        """fi = ri/D [-]."""
        return np.asarray(self.inner_groove_radius, float) / np.asarray(self.ball_diameter, float)

    @property
    def outer_groove_radius_coefficient(self) -> NDArray:
        """fo = ro/D [-]."""
        return np.asarray(self.outer_groove_radius, float) / np.asarray(self.ball_diameter, float)

    @property
    def groove_centre_distance(self) -> NDArray:
        """BD = (fi + fo - 1) D, between the unloaded groove centres [m].

        (19.7) prints fi + fo - 0.5: with it B218 would have 12.14 mm instead of 1.031 mm.
        """
        inner, outer = np.asarray(self.inner_groove_radius, float), np.asarray(self.outer_groove_radius, float)
        return inner + outer - np.asarray(self.ball_diameter, float)

    @property
    def diametral_clearance(self) -> NDArray:
        """Pd = 2 BD (1 - cos alpha0) [m]."""
        half = 0.5 * np.asarray(self.free_contact_angle, float)
        return 4.0 * self.groove_centre_distance * np.sin(half) ** 2

    @property
    def inner_groove_centre_radius(self) -> NDArray:
        """Ri = dm/2 + (fi - 1/2) D cos alpha0: of the circle of inner groove centres [m]."""
        return 0.5 * np.asarray(self.pitch_diameter, float) + (
            np.asarray(self.inner_groove_radius, float) - 0.5 * np.asarray(self.ball_diameter, float)
        ) * np.cos(np.asarray(self.free_contact_angle, float))

    @property
    def ball_mass(self) -> NDArray:
        """m = rho pi D^3/6 [kg]."""
        return np.asarray(self.ball_material.density, float) * pi / 6.0 * np.asarray(self.ball_diameter, float) ** 3

    @property
    def ball_inertia(self) -> NDArray:
        """J = m D^2/10 [kg m^2]; missing in the source."""
        return self.ball_mass * np.asarray(self.ball_diameter, float) ** 2 / 10.0

    @property
    def effective_modulus(self) -> NDArray:
        """E' of ball on ring [Pa]."""
        ball, ring = self.ball_material, self.ring_material
        return np.asarray(
            effective_modulus(
                np.asarray(ball.elastic_modulus, float),  # type: ignore[arg-type]
                np.asarray(ball.poisson_ratio, float),  # type: ignore[arg-type]
                np.asarray(ring.elastic_modulus, float),  # type: ignore[arg-type]
                np.asarray(ring.poisson_ratio, float),  # type: ignore[arg-type]
            )
        )


def free_angle_from_clearance(diametral_clearance: ArrayLike, groove_centre_distance: ArrayLike) -> NDArray:
    """alpha0 from Pd: sin(alpha0/2) = sqrt(Pd/(4 BD)); NaN where the clearance is negative or too large."""
    ratio = np.asarray(diametral_clearance, float) / (4.0 * np.asarray(groove_centre_distance, float))
    with np.errstate(invalid="ignore"):
        return 2.0 * np.arcsin(np.sqrt(ratio))


def clearance_faults(diametral_clearance: ArrayLike, groove_centre_distance: NDArray) -> list[Fault]:
    """Faults of a clearance, which must leave a free contact angle between 0 and its greatest."""
    field = "bearing.diametral_clearance"
    clearance, faults = numeric(field, diametral_clearance, LENGTH)
    if clearance is None:
        return faults
    clearance, distance = np.broadcast_arrays(clearance, groove_centre_distance)
    most = 4.0 * distance * np.sin(0.5 * FREE_ANGLE_MAX) ** 2
    bad = (distance > 0.0) & ((clearance < 0.0) | (clearance > most))
    if not bad.any():
        return []
    found, limit = float(clearance[bad].flat[0]), float(most[bad].flat[0])
    problem = (
        "is negative: balls wedged between the grooves have no free contact angle"
        if found < 0.0
        else "is larger than these grooves allow: the free contact angle would pass "
        f"{np.degrees(FREE_ANGLE_MAX):.0f} degrees"
    )
    return [Fault(field, problem, found, LENGTH, (0.0, limit), likely_slip(found, LENGTH, 0.0, limit))]


def material_faults(field: str, material: Material) -> list[Fault]:
    """Faults of a material's numbers."""
    if not isinstance(material, Material):
        return [Fault(field, "is not a material", value=material, cause="qs.STEEL, qs.SILICON_NITRIDE or qs.Material")]
    return [
        *within(f"{field}.elastic_modulus", material.elastic_modulus, MODULUS, 1e9, 2e12),
        *within(f"{field}.poisson_ratio", material.poisson_ratio, RATIO, 0.0, 0.499),
        *within(f"{field}.density", material.density, DENSITY, 100.0, 25000.0),
    ]


def bearing_faults(bearing: BallBearing) -> list[Fault]:
    """Every fault of a bearing: single fields first, then what the fields say together."""
    faults = within("bearing.ball_count", bearing.ball_count, COUNT, *BALL_COUNT_RANGE)
    count, _ = numeric("", bearing.ball_count, COUNT)
    if count is not None and not faults and (count != np.rint(count)).any():
        broken = float(count[count != np.rint(count)].flat[0])
        faults.append(Fault("bearing.ball_count", "is not a whole number", broken, COUNT, BALL_COUNT_RANGE))
    alone = {
        "ball_diameter": within("bearing.ball_diameter", bearing.ball_diameter, LENGTH, *BALL_DIAMETER_RANGE),
        "pitch_diameter": within("bearing.pitch_diameter", bearing.pitch_diameter, LENGTH, 1e-4, 20.0),
        "inner_groove_radius": within("bearing.inner_groove_radius", bearing.inner_groove_radius, LENGTH, 2.5e-5, 1.0),
        "outer_groove_radius": within("bearing.outer_groove_radius", bearing.outer_groove_radius, LENGTH, 2.5e-5, 1.0),
    }
    for found in alone.values():
        faults += found
    faults += within(
        "bearing.free_contact_angle", bearing.free_contact_angle, ANGLE, 0.0, FREE_ANGLE_MAX, "is outside its range"
    )
    faults += material_faults("bearing.ball_material", bearing.ball_material)
    faults += material_faults("bearing.ring_material", bearing.ring_material)
    if alone["ball_diameter"]:
        return faults
    diameter = np.asarray(bearing.ball_diameter, float)
    for side in ("inner", "outer"):
        field = f"{side}_groove_radius"
        if not alone[field]:
            faults += _groove_faults(f"bearing.{field}", np.asarray(getattr(bearing, field), float), diameter)
    if not alone["pitch_diameter"]:
        faults += _fit_faults(np.asarray(bearing.pitch_diameter, float), diameter, count)
    return faults


def _groove_faults(field: str, radius: NDArray, diameter: NDArray) -> list[Fault]:
    radius, diameter = np.broadcast_arrays(radius, diameter)
    coefficient = radius / diameter
    bad = (coefficient <= 0.5) | (coefficient > GROOVE_COEFFICIENT_MAX)
    if not bad.any():
        return []
    f, r, d = (float(array[bad].flat[0]) for array in (coefficient, radius, diameter))
    if f <= 0.5:
        problem = f"the groove is smaller than the ball: f = r/D = {f:.4g}, and must be above 0.5"
        cause = "A groove tighter than its ball touches at two edges, not at a point; 0.515 to 0.54 is usual"
        if 0.5 < 1e3 * f <= GROOVE_COEFFICIENT_MAX or 0.5 < f / 1e3 <= GROOVE_COEFFICIENT_MAX:
            cause = "Given in another unit than the ball diameter?"
        elif 0.5 < 2.0 * f < 0.6:
            cause = "Was the ball's radius given as its diameter, or the reverse?"
    else:
        problem = f"the groove is far larger than the ball: f = r/D = {f:.4g}, and may be at most 1"
        cause = "Was the groove's diameter given, not its radius? 0.515 to 0.54 is usual for f"
        if not 0.5 < f / 2.0 <= 0.6:
            cause = "Given in another unit than the ball diameter?"
    return [Fault(field, problem, r, LENGTH, (0.5 * d, GROOVE_COEFFICIENT_MAX * d), cause)]


def _fit_faults(pitch: NDArray, diameter: NDArray, count: NDArray | None) -> list[Fault]:
    if count is None or (count < 1).any():
        pitch, diameter = np.broadcast_arrays(pitch, diameter)
        room = diameter
        count_text = ""
    else:
        pitch, diameter, count = np.broadcast_arrays(pitch, diameter, count)
        # Neighbours' centres stand 2 (dm/2) sin(pi/Z) apart; one ball needs only to miss the axis.
        room = np.where(count >= 2, diameter / np.sin(pi / np.maximum(count, 2)), diameter)
        count_text = "the balls do not fit on the pitch circle"
    tight = pitch <= room
    if not tight.any():
        return []
    dm, d, least = (float(array[tight].flat[0]) for array in (pitch, diameter, room))
    problem = count_text or "is no larger than the ball"
    if count_text and count is not None:
        problem += f": {int(count[tight].flat[0])} balls need a circle of more than {least / d:.4g} ball diameters"
    cause = "Fewer or smaller balls, or a larger pitch circle"
    if dm * 1e3 > least and dm * 1e3 < 50.0 * least:
        cause = "Given in another unit than the ball diameter?"
    return [Fault("bearing.pitch_diameter", problem, dm, LENGTH, (least, 20.0), cause)]
