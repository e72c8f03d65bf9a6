"""What is done to the bearing: ring speeds, and for each of five channels its load or its displacement."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi
from typing import NamedTuple

from numpy.typing import ArrayLike

from qsbearing.model.described import given_in
from qsbearing.model.validation import (
    ANGLE,
    FORCE,
    LENGTH,
    MOMENT,
    SPEED,
    ErrorDetail,
    Field,
    Sentence,
    numeric,
    raise_if_any,
    within,
)


class Channel(NamedTuple):
    """One degree of freedom of the inner ring: the field of its load and the field of its displacement."""

    load: str
    displacement: str
    is_rotation: bool
    label: str


CHANNELS = (
    Channel("axial_load", "axial_displacement", False, "axial"),
    Channel("radial_load_y", "radial_displacement_y", False, "radial y"),
    Channel("radial_load_z", "radial_displacement_z", False, "radial z"),
    Channel("moment_y", "tilt_y", True, "tilt y"),
    Channel("moment_z", "tilt_z", True, "tilt z"),
)
"""The five channels in the order of every array of displacements and loads: x, y, z, tilt y, tilt z."""

TURNING = ("speed", "outer_speed", "first_ball_azimuth")
"""What of an operation is not a channel's."""
STRAIGHT = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}
"""A shaft that is neither moved sideways nor tilted."""

# A radial load along y tilts the ring about z, and one along z about y.
TILT_OF = {"radial_load_y": 4, "radial_displacement_y": 4, "radial_load_z": 3, "radial_displacement_z": 3}
"""The number of the channel whose load or displacement must be given with it, unless it is 0."""


# Limits far outside any bearing: they catch mistakes of unit and keep the arithmetic finite. In SI.
SPEEDS, AZIMUTHS = (-1e7, 1e7), (-2.0 * pi, 2.0 * pi)
LOADS, DISPLACEMENTS, TILTS = (-1e8, 1e8), (-0.1, 0.1), (-0.2, 0.2)
"""Forces and moments, displacements, tilts of a channel."""


@dataclass(frozen=True)
class Operation:
    """Speeds and the load on the inner ring; the outer ring stays in its place. SI units, radians; arrays span cases.

    x is the bearing axis, y and z are radial, tilts are right-handed about y and z. A channel with neither load nor
    displacement carries no load and is free to move. With a radial load or displacement the tilt that it
    causes must be given too, free (moment 0) or fixed (tilt 0): the results differ widely.

    Of a bearing alone (`Scene`), moments are about the point of the axis in the plane of the inner groove centres, and
    displacements are those of this point. Of a set's shaft (`BearingSet`) it is the set's reference position, counted
    as rows are: by the planes of the ball centres. Of one bearing the two planes are (r_i - D/2) sin(alpha0) apart,
    0.331 mm for B218; with the pitch circle's tilt lever, which leaves the groove centres out, they are one.

    Raises:
        SceneError: every error, at once.
    """

    speed: ArrayLike = field(default=0.0, metadata=given_in("rpm", SPEEDS, words="speed of the inner ring"))
    """Inner ring about +x [rad/s]."""
    outer_speed: ArrayLike | None = field(default=None, metadata=given_in("rpm", SPEEDS))
    """Outer ring about +x [rad/s]; None: it stands still."""
    axial_load: ArrayLike | None = field(default=None, metadata=given_in("N", LOADS))
    """On the inner ring along +x; or `axial_displacement`; broadcasts with the other fields to the case axes [N]."""
    axial_displacement: ArrayLike | None = field(default=None, metadata=given_in("um", DISPLACEMENTS))
    """From where the free contact angle is just reached at rest and cold [m]; ring effects do not move that place. It
    is the displacement in operation: heat does not change it."""
    radial_load_y: ArrayLike | None = field(default=None, metadata=given_in("N", LOADS))
    """On the inner ring along +y; or `radial_displacement_y` [N]."""
    radial_displacement_y: ArrayLike | None = field(default=None, metadata=given_in("um", DISPLACEMENTS))
    """Of the inner ring along +y [m]."""
    radial_load_z: ArrayLike | None = field(default=None, metadata=given_in("N", LOADS))
    """On the inner ring along +z; or `radial_displacement_z` [N]."""
    radial_displacement_z: ArrayLike | None = field(default=None, metadata=given_in("um", DISPLACEMENTS))
    """Of the inner ring along +z [m]."""
    moment_y: ArrayLike | None = field(default=None, metadata=given_in("N m", LOADS))
    """On the inner ring about +y; or `tilt_y` [N m]."""
    tilt_y: ArrayLike | None = field(default=None, metadata=given_in("mrad", TILTS))
    """Of the inner ring about +y [rad]."""
    moment_z: ArrayLike | None = field(default=None, metadata=given_in("N m", LOADS))
    """On the inner ring about +z; or `tilt_z` [N m]."""
    tilt_z: ArrayLike | None = field(default=None, metadata=given_in("mrad", TILTS))
    """Of the inner ring about +z [rad]."""
    first_ball_azimuth: ArrayLike = field(default=0.0, metadata=given_in("deg", AZIMUTHS))
    """Azimuth of ball 0 from +y towards +z [rad]; the others follow evenly."""

    def __post_init__(self) -> None:
        raise_if_any(operation_errors(self))

    @property
    def turning(self) -> dict[str, ArrayLike | None]:
        """The speeds, and where the balls are."""
        return {name: getattr(self, name) for name in TURNING}

    @property
    def unloaded(self) -> Operation:
        """The same speeds without any load, straight and centred."""
        return Operation(**self.turning, **STRAIGHT)  # type: ignore[arg-type]


def operation_errors(operation: Operation) -> list[ErrorDetail]:
    """Every error of an operation."""
    errors = within("operation.speed", operation.speed, SPEED, *SPEEDS)
    if operation.outer_speed is not None:
        errors += within("operation.outer_speed", operation.outer_speed, SPEED, *SPEEDS)
    errors += within("operation.first_ball_azimuth", operation.first_ball_azimuth, ANGLE, *AZIMUTHS)
    for channel in CHANNELS:
        load, displacement = getattr(operation, channel.load), getattr(operation, channel.displacement)
        if load is not None and displacement is not None:
            problem = Sentence("is given together with {other}", other=Field(channel.displacement))
            detail = "a channel has its load or its displacement, never both"
            cause = "Keep the one that is prescribed; the other is a result"
            errors.append(ErrorDetail(f"operation.{channel.load}", problem, cause=cause, detail=detail))
        if load is not None:
            quantity = MOMENT if channel.is_rotation else FORCE
            errors += within(f"operation.{channel.load}", load, quantity, *LOADS)
        if displacement is not None:
            quantity, limits = (ANGLE, TILTS) if channel.is_rotation else (LENGTH, DISPLACEMENTS)
            errors += within(f"operation.{channel.displacement}", displacement, quantity, *limits)
    return errors + _unstated_tilts(operation)


def _unstated_tilts(operation: Operation) -> list[ErrorDetail]:
    errors = []
    for name, number in TILT_OF.items():
        tilt = CHANNELS[number]
        value = getattr(operation, name)
        if (
            value is None
            or getattr(operation, tilt.load) is not None
            or getattr(operation, tilt.displacement) is not None
        ):
            continue
        array, _ = numeric(f"operation.{name}", value, FORCE)  # its own errors are known already
        if array is not None and array.any():
            why = "{given} tilts the ring, so give its moment or its tilt (the results differ widely)"
            cause = Sentence(
                "Free to tilt: {moment} = 0. Fixed by a stiff shaft: {tilt} = 0",
                moment=Field(tilt.load), tilt=Field(tilt.displacement),
            )  # fmt: skip
            detail = Sentence(why, given=Field(name))
            errors.append(ErrorDetail(f"operation.{tilt.load}", "missing", cause=cause, detail=detail))
    return errors
