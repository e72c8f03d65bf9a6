"""The bearing: independent lengths and materials, and the lengths, masses and inertias that follow from them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum
from math import pi
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.arches import (
    SHIMS,
    arch_errors,
    axial_clearance_given_errors,
    clearance_given_errors,
    resting_sine,
    shims_given_errors,
    wedging,
)
from qsbearing.model.bearing_errors import (
    BALL_COUNT_RANGE,
    FREE_ANGLES,
    LENGTH_RANGES,
    bearing_errors,
    clearance_errors,
)
from qsbearing.model.contact.hertz import effective_modulus
from qsbearing.model.described import A_MATERIAL, Input, given_in, number, one_of
from qsbearing.model.material import STEEL, Material
from qsbearing.model.validation import LENGTH, SceneError, choose, numeric, raise_if_any


class BearingKind(StrEnum):
    """Which way the raceway shoulders carry axial load."""

    ANGULAR_CONTACT = "angular_contact"
    """Axial load in +x only: contact angles below zero would lie on the open side."""
    DEEP_GROOVE = "deep_groove"
    """Shoulders on both sides: contact angles of either sign."""
    FOUR_POINT = "four_point"
    """Shoulders on both sides, and two arcs in the groove of one ring or of both: up to four contacts a ball."""


@dataclass(frozen=True)
class Outline:
    """What a catalogue prints of a bearing's rings [m]; None for what is not known."""

    bore_diameter: Any = None
    outside_diameter: Any = None
    width: Any = None
    outer_shoulder_diameter: Any = None


@dataclass(frozen=True)
class BallBearing:
    """A single-row ball bearing; SI units and radians. Any number may be an array, which spans cases.

    Raises:
        SceneError: some field describes no bearing; every error, at once.
    """

    ball_count: ArrayLike = field(metadata=given_in("balls", BALL_COUNT_RANGE))
    """Z [-]."""
    ball_diameter: ArrayLike = field(metadata=given_in("mm", LENGTH_RANGES["ball_diameter"]))
    """D [m]."""
    pitch_diameter: ArrayLike = field(metadata=given_in("mm", LENGTH_RANGES["pitch_diameter"]))
    """dm, of the circle of ball centres [m]."""
    inner_groove_radius: ArrayLike = field(metadata=given_in("mm", LENGTH_RANGES["inner_groove_radius"]))
    """ri, across the groove [m]; more than half the ball diameter."""
    outer_groove_radius: ArrayLike = field(metadata=given_in("mm", LENGTH_RANGES["outer_groove_radius"]))
    """ro, across the groove [m]; more than half the ball diameter."""
    free_contact_angle: ArrayLike = field(metadata=given_in("deg", FREE_ANGLES))
    """alpha0, of the line of contact when all clearance is just taken up without load [rad]."""
    ball_material: Material = field(default=STEEL, metadata=A_MATERIAL)
    ring_material: Material = field(default=STEEL, metadata=A_MATERIAL)
    kind: BearingKind = field(default=BearingKind.ANGULAR_CONTACT, metadata=one_of(BearingKind))
    name: str = ""
    """Its designation, for headings; no solve looks at it."""
    radial_interference: ArrayLike = 0.0
    """How much less room, radially, the grooves leave than the balls need [m]: a negative clearance, as growing rings
    make it. 0 where there is a free contact angle. The pitch circle is then where balls would just touch the outer
    ring."""
    inner_shim: ArrayLike | None = field(default=None, metadata=given_in("mm", SHIMS))
    """gi, axially between the centres of the inner groove's two arcs [m]; None for one arc. Of four-point bearings."""
    outer_shim: ArrayLike | None = field(default=None, metadata=given_in("mm", SHIMS))
    """go, likewise of the outer groove [m]."""
    outline: Outline | None = field(default=None, compare=False, repr=False)
    """Its rings from outside. No solve looks at it: what elastic or expanding rings would change is told by it."""
    inferred: Any = field(default=None, compare=False, repr=False)
    """Of a bearing given by its data sheet, whose arrays are the sets that it allows: what they were inferred from."""
    also_given: ClassVar[tuple[Input, ...]] = (number("diametral_clearance", "mm"), number("axial_clearance", "mm"))
    """In place of the free contact angle, `from_diametral_clearance`; and of the shims, `from_axial_clearance`."""

    def __post_init__(self) -> None:
        kind, errors = choose("bearing.kind", self.kind, BearingKind)
        object.__setattr__(self, "kind", kind)
        errors += bearing_errors(self)
        if kind is BearingKind.FOUR_POINT or self.inner_shim is not None or self.outer_shim is not None:
            errors += arch_errors(self, not errors)
        raise_if_any(errors)

    @classmethod
    def from_diametral_clearance(cls, *, diametral_clearance: ArrayLike, **fields: Any) -> BallBearing:
        """The bearing whose free contact angle follows from its diametral clearance Pd [m].

        cos(alpha0) = 1 - Pd/(2 B D): Harris & Kotzalas; the other fields as for `BallBearing`. A negative clearance is
        a radial interference, at a free contact angle of zero; one among the fields gives way to it.
        """
        inner, outer, ball = (
            numeric("", fields[name], LENGTH)[0]
            for name in ("inner_groove_radius", "outer_groove_radius", "ball_diameter")
        )
        errors = clearance_given_errors(fields.get("kind"), diametral_clearance)
        angle: ArrayLike = 0.0  # stands in, as no interference does, while the other fields are checked
        interference: ArrayLike = 0.0
        if not errors and inner is not None and outer is not None and ball is not None:
            distance = inner + outer - ball
            errors = clearance_errors(diametral_clearance, distance, ball)
            if not errors and (distance > 0.0).all():
                clearance = np.asarray(diametral_clearance, float)
                angle = free_angle_from_clearance(np.maximum(clearance, 0.0), distance)
                interference = np.maximum(-0.5 * clearance, 0.0)
        fields = {"kind": BearingKind.ANGULAR_CONTACT} | fields
        if errors and fields["kind"] == BearingKind.FOUR_POINT:
            fields = stand_in(fields)
        try:
            bearing = cls(free_contact_angle=angle, **fields | {"radial_interference": interference})
        except SceneError as error:
            raise SceneError([*error.errors, *errors]) from None
        raise_if_any(errors)
        return bearing

    @classmethod
    def from_axial_clearance(cls, *, axial_clearance: ArrayLike, **fields: Any) -> BallBearing:
        """The four-point bearing whose shims follow from its axial clearance Pa [m], with one resting angle in both
        rings: sin(gamma) = sin(alpha0) - Pa/(2 BD), g = 2 (r - D/2) sin(gamma).

        The other fields as for `BallBearing`; Pa below zero presses the balls against all four arcs.
        """
        names = "inner_groove_radius", "outer_groove_radius", "ball_diameter", "free_contact_angle"
        given = [numeric("", fields[name], LENGTH)[0] for name in names]
        shims: dict[str, Any] = {"inner_shim": None, "outer_shim": None}
        errors = shims_given_errors(fields)
        kind = fields.get("kind", BearingKind.FOUR_POINT)
        if kind != BearingKind.FOUR_POINT:
            errors = axial_clearance_given_errors(axial_clearance)
        elif not any(each is None for each in given):
            inner, outer, ball, angle = (np.asarray(each, float) for each in given)
            wrong, sine = resting_sine(axial_clearance, inner + outer - ball, angle, ball)
            errors += wrong
            if not wrong:
                for name, radius in (("inner_shim", inner), ("outer_shim", outer)):
                    shims[name] = np.asarray((2.0 * radius - ball) * sine)[()]
        if errors:
            fields = stand_in(fields) if kind == BearingKind.FOUR_POINT else fields
            try:
                cls(**fields)
            except SceneError as error:
                raise SceneError([*error.errors, *errors]) from None
            raise SceneError(errors)
        return cls(**fields | {"kind": kind} | shims)

    def _array(self, name: str) -> NDArray:
        return np.asarray(getattr(self, name), float)

    @property
    def is_arched(self) -> bool:
        """Whether a groove has two arcs."""
        return self.kind is BearingKind.FOUR_POINT

    def shim(self, side: str) -> NDArray | None:
        """g of a ring, "inner" or "outer" [m]; None for one arc."""
        given = getattr(self, f"{side}_shim")
        return None if given is None else np.asarray(given, float)

    def arc_length(self, side: str) -> NDArray:
        """L = r - D/2 of a ring, from an arc's centre to that of a ball which touches it [m]."""
        return self._array(f"{side}_groove_radius") - 0.5 * self._array("ball_diameter")

    def resting_angle(self, side: str) -> NDArray | None:
        """gamma of a ring, "inner" or "outer", at which a ball rests on both arcs [rad]: sin(gamma) = g/(2 L)."""
        shim = self.shim(side)
        return None if shim is None else np.asarray(np.arcsin(shim / (2.0 * self.arc_length(side))))

    def apex_angle(self, side: str) -> NDArray | None:
        """At which a ring's arcs meet, seen from their centres [rad]: sin = g/(2 r)."""
        shim = self.shim(side)
        return None if shim is None else np.asarray(np.arcsin(shim / (2.0 * self._array(f"{side}_groove_radius"))))

    @property
    def axial_clearance(self) -> NDArray | None:
        """Pa = 2 BD sin(alpha0) - gi - go, by which the rings move until balls touch both on the other side [m]; None
        where no groove has two arcs."""
        if not self.is_arched:
            return None
        shims = [each for each in map(self.shim, ("inner", "outer")) if each is not None]
        return np.asarray(2.0 * self.touching_offset - sum(shims))

    @property
    def groove_centre_distance(self) -> NDArray:
        """BD = (fi + fo - 1) D, between the unloaded groove centres [m].

        (19.7) prints fi + fo - 0.5: with it B218 would have 12.14 mm instead of 1.031 mm.
        """
        return self._array("inner_groove_radius") + self._array("outer_groove_radius") - self._array("ball_diameter")

    @property
    def diametral_clearance(self) -> NDArray:
        """Pd = 2 BD (1 - cos alpha0) [m]; negative where the balls are wedged.

        Between arched rings, whose balls rest on two arcs, 2 (Li cos gamma_i + Lo cos gamma_o - BD cos alpha0).
        """
        if not self.is_arched:
            return self._room_of_one_arc
        return np.asarray(wedging(self))

    @property
    def _room_of_one_arc(self) -> NDArray:
        """2 BD (1 - cos alpha0), less an interference, of a ball between one arc of each ring [m]."""
        room = 4.0 * self.groove_centre_distance * np.sin(0.5 * self._array("free_contact_angle")) ** 2
        return room - 2.0 * self._array("radial_interference")

    @property
    def inner_groove_centre_radius(self) -> NDArray:
        """Ri, of the circle of inner groove centres [m]."""
        pitch, radius, ball = map(self._array, ("pitch_diameter", "inner_groove_radius", "ball_diameter"))
        cosine = np.cos(self._array("free_contact_angle"))
        return np.asarray(groove_centre_radius(pitch, radius, ball, cosine, self._array("radial_interference")))

    @property
    def outer_groove_centre_radius(self) -> NDArray:
        """Ro, of the circle of outer groove centres [m]."""
        span = self.groove_centre_distance * np.cos(self._array("free_contact_angle"))
        return self.inner_groove_centre_radius - span - self._array("radial_interference")

    @property
    def touching_offset(self) -> NDArray:
        """BD sin alpha0, axially between the groove centres where the free contact angle is just reached [m]."""
        return self.groove_centre_distance * np.sin(self._array("free_contact_angle"))

    @property
    def groove_centre_offsets(self) -> tuple[NDArray, NDArray]:
        """(r - D/2) sin alpha0 of the inner and the outer ring, axially from the balls' centres there [m]."""
        ball, sine = 0.5 * self._array("ball_diameter"), np.sin(self._array("free_contact_angle"))
        return (self._array("inner_groove_radius") - ball) * sine, (self._array("outer_groove_radius") - ball) * sine

    def with_changed_lengths(
        self,
        *,
        ball_diameter: ArrayLike = 0.0,
        inner_groove_radius: ArrayLike = 0.0,
        outer_groove_radius: ArrayLike = 0.0,
        inner_groove_centre: ArrayLike = 0.0,
        outer_groove_centre: ArrayLike = 0.0,
    ) -> BallBearing:
        """The bearing after these small changes [m], in whatever order they come about.

        Groove centres move radially, outward positive. The clearance changes by what the changed lengths take of it:
        Pd/2 = ri + ro - D - (Ri - Ro), and the free contact angle and the pitch circle follow from it. A clearance
        that would be negative is a radial interference, at a free contact angle of zero.

        Raises:
            SceneError: what is left is no bearing.
        """
        ball, inner, outer, moved_inner, moved_outer = (
            np.asarray(change, float)
            for change in (
                *(ball_diameter, inner_groove_radius, outer_groove_radius, inner_groove_centre, outer_groove_centre),
            )
        )
        # From the clearance, not from the cosine of the angle, which near zero has no digits to tell a change by.
        clearance = 0.5 * self._room_of_one_arc + inner + outer - ball - (moved_inner - moved_outer)
        distance = self.groove_centre_distance + inner + outer - ball
        angle = free_angle_from_clearance(2.0 * np.maximum(clearance, 0.0), distance)
        interference = np.maximum(-clearance, 0.0)
        ball, inner = self._array("ball_diameter") + ball, self._array("inner_groove_radius") + inner
        radius = self.inner_groove_centre_radius + moved_inner
        lengths = {
            "ball_diameter": ball,
            "inner_groove_radius": inner,
            "outer_groove_radius": self._array("outer_groove_radius") + outer,
            "pitch_diameter": 2.0 * (radius - interference - (inner - 0.5 * ball) * np.cos(angle)),
            "free_contact_angle": angle,
            "radial_interference": interference,
        }
        return replace(self, **{name: length[()] for name, length in lengths.items()})

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


def stand_in(fields: dict[str, Any]) -> dict[str, Any]:
    """Fields of a bearing with one arc in each ring, to check those that have nothing to do with shims."""
    others = {name: value for name, value in fields.items() if name not in ("inner_shim", "outer_shim")}
    return others | {"kind": BearingKind.DEEP_GROOVE}


def ball_mass(density: Any, ball_diameter: Any) -> Any:
    """m = rho pi D^3/6 [kg]."""
    return density * (pi / 6.0) * ball_diameter**3


def groove_centre_radius(
    pitch_diameter: Any, groove_radius: Any, ball_diameter: Any, cos_free: Any, interference: Any
) -> Any:
    """Ri = dm/2 + (ri - D/2) cos alpha0, of the circle of inner groove centres, in the unit of the lengths.

    A radial interference parts the grooves' centres further; the pitch circle keeps its place to the outer one.
    """
    return 0.5 * pitch_diameter + interference + (groove_radius - 0.5 * ball_diameter) * cos_free


def free_angle_from_clearance(diametral_clearance: ArrayLike, groove_centre_distance: ArrayLike) -> NDArray:
    """alpha0 from Pd: sin(alpha0/2) = sqrt(Pd/(4 BD)); NaN where the clearance is negative or too large."""
    ratio = np.asarray(diametral_clearance, float) / (4.0 * np.asarray(groove_centre_distance, float))
    with np.errstate(invalid="ignore"):
        return 2.0 * np.arcsin(np.sqrt(ratio))


def pitch_and_clearance(
    inner_raceway: Any, outer_raceway: Any, ball_diameter: Any, inner_radius: Any, outer_radius: Any
) -> tuple[Any, Any]:
    """dm and Pd by the diameters at the bottoms of both grooves, in the unit of the lengths.

    Pd = do - di - 2 D; dm as `groove_centre_radius` has it, which is (di + do)/2 where both groove radii are equal.
    """
    clearance = outer_raceway - inner_raceway - 2.0 * ball_diameter
    distance = inner_radius + outer_radius - ball_diameter
    room, wedged = np.maximum(clearance, 0.0), np.maximum(-clearance, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        from_cosine = np.where(distance > 0.0, 0.5 * room / np.asarray(distance), 0.0)
    pitch = inner_raceway + ball_diameter - wedged + (2.0 * inner_radius - ball_diameter) * from_cosine
    return pitch[()], clearance
