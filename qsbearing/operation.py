"""What is done to the bearing: ring speeds, and for each of five channels its load or its displacement."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, NamedTuple

from qsbearing.faults import ANGLE, FORCE, LENGTH, MOMENT, SPEED, Fault, Quantity, numeric, raise_if_any, within

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Channel(NamedTuple):
    """One degree of freedom of the inner ring: the field of its load and the field of its displacement."""

    load: str
    displacement: str
    is_rotation: bool
    words: str


CHANNELS = (
    Channel("axial_load", "axial_displacement", False, "axial"),
    Channel("radial_load_y", "radial_displacement_y", False, "radial y"),
    Channel("radial_load_z", "radial_displacement_z", False, "radial z"),
    Channel("moment_y", "tilt_y", True, "tilt y"),
    Channel("moment_z", "tilt_z", True, "tilt z"),
)
"""The five channels in the order of every array of displacements and loads: x, y, z, tilt y, tilt z."""

# A radial load along y bends the ring about z, and the other way round.
_TILT_THAT_ANSWERS = {"radial_load_y": 4, "radial_displacement_y": 4, "radial_load_z": 3, "radial_displacement_z": 3}


@dataclass(frozen=True)
class Operation:
    """Speeds and loads on the inner ring; the outer ring is held in place. SI units, radians; arrays span cases.

    x is the bearing axis, y and z are radial, tilts are right-handed about y and z. A channel with neither load nor
    displacement carries no load and is free to move. With a radial load or displacement the tilt that answers it
    must be stated, free (moment 0) or held (tilt 0): the two give very different bearings.

    Raises:
        SceneError: all faults at once.
    """

    speed: ArrayLike = 0.0
    """Inner ring about +x [rad/s]."""
    outer_speed: ArrayLike | None = None
    """Outer ring about +x [rad/s]; None: it stands still."""
    axial_load: ArrayLike | None = None
    axial_displacement: ArrayLike | None = None
    """From the position where the free contact angle is just reached [m]."""
    radial_load_y: ArrayLike | None = None
    radial_displacement_y: ArrayLike | None = None
    radial_load_z: ArrayLike | None = None
    radial_displacement_z: ArrayLike | None = None
    moment_y: ArrayLike | None = None
    tilt_y: ArrayLike | None = None
    moment_z: ArrayLike | None = None
    tilt_z: ArrayLike | None = None
    first_ball_azimuth: ArrayLike = 0.0
    """Azimuth of ball 0 from +y towards +z [rad]; the others follow evenly."""

    def __post_init__(self) -> None:
        raise_if_any(operation_faults(self))


def operation_faults(operation: Operation) -> list[Fault]:
    """Every fault of an operation."""
    faults = within("operation.speed", operation.speed, SPEED, -1e7, 1e7)
    if operation.outer_speed is not None:
        faults += within("operation.outer_speed", operation.outer_speed, SPEED, -1e7, 1e7)
    faults += within("operation.first_ball_azimuth", operation.first_ball_azimuth, ANGLE, -2.0 * pi, 2.0 * pi)
    for channel in CHANNELS:
        load, displacement = getattr(operation, channel.load), getattr(operation, channel.displacement)
        if load is not None and displacement is not None:
            faults.append(
                Fault(
                    f"operation.{channel.load}",
                    f"is given beside {channel.displacement}: a channel has its load or its displacement, never both",
                    cause="Keep the one that is imposed; the other is part of the result",
                )
            )
        # Limits far outside any bearing: they catch slips of unit and keep the arithmetic finite.
        if load is not None:
            quantity, limit = (MOMENT, 1e8) if channel.is_rotation else (FORCE, 1e8)
            faults += within(f"operation.{channel.load}", load, quantity, -limit, limit)
        if displacement is not None:
            angle_or_length: tuple[Quantity, float] = (ANGLE, 0.2) if channel.is_rotation else (LENGTH, 0.1)
            quantity, limit = angle_or_length
            faults += within(f"operation.{channel.displacement}", displacement, quantity, -limit, limit)
    return faults + _unstated_tilts(operation)


def _unstated_tilts(operation: Operation) -> list[Fault]:
    faults = []
    for field, answering in _TILT_THAT_ANSWERS.items():
        value = getattr(operation, field)
        channel = CHANNELS[answering]
        stated = getattr(operation, channel.load) is not None or getattr(operation, channel.displacement) is not None
        if value is None or stated:
            continue
        array, _ = numeric(f"operation.{field}", value, FORCE)  # its own faults are reported already
        if array is not None and array.any():
            faults.append(
                Fault(
                    f"operation.{channel.load}",
                    f"missing: with {field} the tilt that answers it must be stated, for the two give very different "
                    "bearings",
                    cause=f"Free to tilt: {channel.load} = 0. Held by a stiff shaft: {channel.displacement} = 0",
                )
            )
    return faults
