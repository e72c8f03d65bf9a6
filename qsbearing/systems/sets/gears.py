"""Gears on the shaft: the forces of their teeth, from the torque that they transmit.

At the mesh, at azimuth psi (from y towards z) and the pitch radius r, the mate pushes the shaft with

    Ft = T / r          along the circumference, in the direction of growing azimuth,
    Fr                  towards the axis (of an internal gear away from it),
    Fa                  along +x.

    spur, helical       Fr = |Ft| tan(an) / cos(b),     Fa = -Ft tan(b),                b > 0 right-handed
    straight bevel      Fr = |Ft| tan(a) cos(delta),    Fa = |Ft| tan(a) sin(delta),    away from the apex

an: normal pressure angle, b: helix angle at the pitch circle, delta: pitch angle of the cone. All three act at r, so
Fa also bends the shaft by Fa r. Friction of the teeth (1 to 2 % of Ft) is left out, and so is how the load spreads over
the face width.

Source: Budynas & Nisbett, Shigley's Mechanical Engineering Design, chapter 13, force analysis of spur, bevel and
helical gears. The hand's sign follows from the flank, which is square to the tooth trace: a right-handed trace turns
by +tan(b) / r per length.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.described import given_in, one_of
from qsbearing.model.units import deg, mm
from qsbearing.model.validation import ANGLE, LENGTH, RATIO, ErrorDetail, Field, Sentence, choose, within
from qsbearing.systems.sets.torque import torque_errors, torque_on_shaft

STEEPEST_HELIX = 60.0 * deg
"""Beyond it friction decides, as in a worm."""
USUAL_ANGLE = 20.0 * deg
"""Pressure angle of the basic rack of ISO 53."""
ROUNDING = 1e-15
"""Of a sine: a mesh at 90 degrees pushes in no other plane, and shows no arrow there."""
WIDEST = 10.0
"""Metres; it catches mistakes of unit."""


class GearKind(StrEnum):
    """How the teeth lie."""

    SPUR = "spur"
    HELICAL = "helical"
    STRAIGHT_BEVEL = "straight_bevel"


class Hand(StrEnum):
    """Of a helical gear's teeth: those of a right-handed one turn as the thread of a usual screw."""

    RIGHT = "right"
    LEFT = "left"


class Apex(StrEnum):
    """Where the apex of a bevel gear's pitch cone lies, seen from the gear."""

    PLUS = "+x"
    MINUS = "-x"


_NOT_COMPUTED = {
    "worm": "the friction of its teeth decides on its forces",
    "hypoid": "its axes do not meet, and its flanks are curved",
    "spiral": "its forces depend on the spiral angle and on which flank drives",
    "crossed": "its axes do not meet",
}
"""Kinds that are refused by their names, and why."""


@dataclass(frozen=True)
class Gear:
    """A gear on the shaft, which its mate pushes at one place. SI units; numbers but the position may be arrays that
    span cases.

    The kind follows from what is given: a cone angle makes it bevel, a helix angle helical; `kind` only states it.
    Of a gear with two meshes, such as an idler, write one for each mesh.
    """

    position: float = field(metadata=given_in("mm"))
    """Of the middle of its face width along the shaft [m]."""
    azimuth: ArrayLike = field(metadata=given_in("deg"))
    """Of the mesh, from y towards z [rad]: where, seen from the axis, its mate is."""
    pitch_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm"))
    """Of the circle that rolls on its mate's [m]; of a bevel gear at the middle of the face width. None: of the
    teeth and the module."""
    teeth: float | None = field(default=None, metadata=given_in(words="number of teeth"))
    """Of the gear on this shaft [-]."""
    normal_module: float | None = field(default=None, metadata=given_in("mm"))
    """Pitch diameter of a spur gear over its number of teeth; of a helical one times the cosine of the helix angle
    [m]."""
    torque: ArrayLike | None = field(default=None, metadata=given_in("N m"))
    """That it transmits [N m]; its direction follows from `drives` and the shaft's speed. Below zero: reversed."""
    power: ArrayLike | None = field(default=None, metadata=given_in("kW"))
    """In its place: torque times the shaft's speed [W]."""
    normal_pressure_angle: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """In operation, square to the tooth trace [rad]; None: 20 degrees are assumed."""
    helix_angle: ArrayLike = field(default=0.0, metadata=given_in("deg"))
    """At the pitch circle, without sign [rad]; with `hand`."""
    cone_angle: ArrayLike | None = field(default=None, metadata=given_in("deg"))
    """Of a bevel gear's pitch cone, between axis and flank line [rad]; with `apex`."""
    drives: bool | None = field(default=None, metadata=one_of(bool))
    """Whether it drives its mate; else its mate drives it. To be given."""
    kind: GearKind | None = field(default=None, metadata=one_of(GearKind))
    """How its teeth lie; None: as its angles say."""
    hand: Hand | None = field(default=None, metadata=one_of(Hand))
    apex: Apex | None = field(default=None, metadata=one_of(Apex))
    internal: bool = field(default=False, metadata=one_of(bool))
    """Whether its teeth point inwards."""

    @property
    def assumed(self) -> dict[str, float]:
        """What stands for numbers that are not given, by their fields."""
        return {"normal_pressure_angle": USUAL_ANGLE} if self.normal_pressure_angle is None else {}

    @property
    def diameter(self) -> NDArray:
        """At which its mate pushes [m]."""
        if self.pitch_diameter is not None:
            return np.asarray(self.pitch_diameter, float)
        assert self.teeth is not None and self.normal_module is not None
        return np.asarray(self.teeth * self.normal_module / np.cos(self.helix_angle))

    def forces(self, speed: ArrayLike) -> ToothForces:
        """Of its mate on it, under its torque.

        Args:
            speed: of the shaft [rad/s].
        """
        torque = torque_on_shaft(self, speed)
        along = torque / (0.5 * self.diameter)
        angle = self.normal_pressure_angle
        pressure = np.tan(USUAL_ANGLE if angle is None else angle)
        if self.cone_angle is not None:
            inwards = np.abs(along) * pressure * np.cos(self.cone_angle)
            axial = np.abs(along) * pressure * np.sin(self.cone_angle)
            axial = -axial if self.apex == Apex.PLUS else axial
        else:
            inwards = np.abs(along) * pressure / np.cos(self.helix_angle)
            axial = -along * np.tan(self.helix_angle) * (-1.0 if self.hand == Hand.LEFT else 1.0)
        return ToothForces(torque, along, -inwards if self.internal else inwards, axial)

    def load(self, speed: ArrayLike) -> tuple[NDArray, ...]:
        """On the shaft at its position, in the order of the channels: forces [N] and moments [N m]."""
        forces = self.forces(speed)
        return carried_to_axis(forces.tangential, -forces.radial, forces.axial, self.azimuth, 0.5 * self.diameter)


class ToothForces(NamedTuple):
    """Of the mate on a gear; arrays over the cases."""

    torque: NDArray
    """About +x [N m]."""
    tangential: NDArray
    """In the direction of growing azimuth [N]."""
    radial: NDArray
    """Towards the axis [N]."""
    axial: NDArray
    """Along +x [N]."""


def carried_to_axis(along: Any, outwards: Any, axial: Any, azimuth: ArrayLike, radius: Any) -> tuple[NDArray, ...]:
    """A force at a point off the axis as force and moment on it, without its torque; in the order of the channels.

    Args:
        along, outwards, axial: parts of the force along the circumference, away from the axis and along +x [N].
        azimuth, radius: of the point [rad, m].
    """
    y, z = (np.where(np.abs(each) < ROUNDING, 0.0, each) for each in (np.cos(azimuth), np.sin(azimuth)))
    forces = axial, outwards * y - along * z, outwards * z + along * y
    moments = axial * radius * z, -axial * radius * y
    return tuple(np.asarray(each, float) for each in (*forces, *moments))


def gear_errors(path: str, of: Gear) -> list[ErrorDetail]:
    """Of one gear alone; of its power at rest: `speed_errors`."""
    errors = [*_kind_errors(path, of), *_size_errors(path, of), *torque_errors(path, of)]
    errors += within(f"{path}.azimuth", of.azimuth, ANGLE, -4.0 * np.pi, 4.0 * np.pi)
    if of.normal_pressure_angle is not None:
        errors += within(f"{path}.normal_pressure_angle", of.normal_pressure_angle, ANGLE, 5.0 * deg, 45.0 * deg)
    beyond = "is beyond that of a helical gear: forces of worms and crossed gears depend on friction"
    size = np.max(np.abs(of.helix_angle)) if np.size(of.helix_angle) else 0.0
    errors += within(
        f"{path}.helix_angle", of.helix_angle, ANGLE, 0.0, STEEPEST_HELIX, beyond if size > STEEPEST_HELIX else ""
    )
    if not isinstance(of.internal, bool):
        errors.append(ErrorDetail(f"{path}.internal", "is neither true nor false", of.internal))
    return errors


def _kind_errors(path: str, of: Gear) -> Iterator[ErrorDetail]:
    """Of kind, hand and apex, and of angles that do not suit them."""
    names = {name: Field(name) for name in ("helix_angle", "cone_angle", "hand", "apex", "kind")}
    if of.kind is not None:
        known = choose(f"{path}.kind", of.kind, GearKind)[1]
        words = str(of.kind).lower()
        refused = next((f"{word} gears: {why}" for word, why in _NOT_COMPUTED.items() if word in words), "")
        if refused:
            cause = (
                f"Compute its forces by its maker's rules, and write them as a load. Computed: {', '.join(GearKind)}"
            )
            yield ErrorDetail(f"{path}.kind", "is not computed", of.kind, cause=cause, detail=refused)
        else:
            yield from known
    for name, choices in (("hand", Hand), ("apex", Apex)):
        if getattr(of, name) is not None:
            yield from choose(f"{path}.{name}", getattr(of, name), choices)[1]
    is_bevel, is_helical = of.cone_angle is not None, bool(np.any(np.asarray(of.helix_angle) != 0.0))
    if is_bevel:
        yield from within(f"{path}.cone_angle", of.cone_angle, ANGLE, 0.5 * deg, 89.5 * deg)
        if is_helical:
            cause = Sentence("Leave {helix_angle} out: only straight bevel gears are computed", **names)
            yield ErrorDetail(f"{path}.helix_angle", "is given of a bevel gear", cause=cause)
        if of.apex is None:
            cause = Sentence('Write {apex} = "+x" or "-x", the side of the gear on which the axes meet', **names)
            yield ErrorDetail(f"{path}.apex", "missing", cause=cause)
        if of.internal:
            yield ErrorDetail(f"{path}.internal", "is given of a bevel gear")
    elif is_helical and of.hand is None:
        cause = Sentence('Write {hand} = "right" or "left": it decides the direction of the axial force', **names)
        yield ErrorDetail(f"{path}.hand", "missing", cause=cause)
    if of.apex is not None and not is_bevel:
        yield ErrorDetail(f"{path}.cone_angle", "missing", detail="the gear has an apex")
    needed = {GearKind.HELICAL: ("helix_angle", is_helical), GearKind.STRAIGHT_BEVEL: ("cone_angle", is_bevel)}
    for kind, (name, has_it) in needed.items():
        if of.kind == kind and not has_it:
            yield ErrorDetail(f"{path}.{name}", "missing", detail=f"the gear is {kind.replace('_', ' ')}")
        elif has_it and of.kind is not None and of.kind != kind and of.kind in tuple(GearKind):
            cause = Sentence("Leave {kind} out: it follows from the angles", **names)
            yield ErrorDetail(f"{path}.kind", f"does not suit its {name.replace('_', ' ')}", of.kind, cause=cause)


def _size_errors(path: str, of: Gear) -> Iterator[ErrorDetail]:
    """Of its diameter, or of teeth and module."""
    names = {name: Field(name) for name in ("pitch_diameter", "teeth", "normal_module")}
    counted = of.teeth is not None, of.normal_module is not None
    if of.pitch_diameter is None and not all(counted):
        cause = Sentence("Give {pitch_diameter}, or {teeth} and {normal_module}", **names)
        yield ErrorDetail(f"{path}.pitch_diameter", "missing", cause=cause)
    elif of.pitch_diameter is not None and any(counted):
        cause = Sentence("Give {pitch_diameter} alone, or {teeth} and {normal_module}", **names)
        yield ErrorDetail(f"{path}.pitch_diameter", "is given together with teeth or module", cause=cause)
    if of.pitch_diameter is not None:
        yield from within(f"{path}.pitch_diameter", of.pitch_diameter, LENGTH, 1.0 * mm, WIDEST)
    if of.teeth is not None:
        problem = "" if np.shape(of.teeth) or float(of.teeth).is_integer() else "is not a whole number"
        if problem:
            yield ErrorDetail(f"{path}.teeth", problem, of.teeth)
        yield from within(f"{path}.teeth", of.teeth, RATIO, 5.0, 10000.0)
    if of.normal_module is not None:
        yield from within(f"{path}.normal_module", of.normal_module, LENGTH, 0.05 * mm, 100.0 * mm)
    if of.cone_angle is not None and any(counted):
        mean = "The mean diameter: the outer one less the face width times the sine of the cone angle"
        yield ErrorDetail(f"{path}.pitch_diameter", "is needed of a bevel gear, at the middle of its teeth", cause=mean)
