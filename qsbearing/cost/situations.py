"""Where a scene's bearing is looked at: its own loads, at speeds from rest to the fastest in use."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.operation import CHANNELS
from qsbearing.scene import Scene
from qsbearing.units import mm, rpm

if TYPE_CHECKING:
    from numpy.typing import NDArray

SPEEDS = (
    ("rest", 0.0),
    ("general machinery", 1e5),
    ("spindle", 1e6),
    ("aero engine", 2.5e6),
)
"""Names and dm n [mm rpm]."""

OWN = "the scene's own speed"

VARIED = 0.1
"""Batches vary loads, displacements and speeds by this part to either side."""


@dataclass(frozen=True)
class Situation:
    """The scene at one speed."""

    name: str
    scene: Scene


def situations(scene: Scene) -> list[Situation]:
    """The scene at rest and at each of `SPEEDS`, and as it is where it is none of these."""
    pitch = float(np.asarray(scene.bearing.pitch_diameter))
    own = float(np.asarray(scene.operation.speed))
    found = [Situation(name, at_speed(scene, parameter / (pitch / mm) * rpm)) for name, parameter in SPEEDS]
    is_usual = not np.any(scene.operation.outer_speed or 0.0) and any(
        abs(own - float(np.asarray(one.scene.operation.speed))) <= 0.01 * abs(own) for one in found
    )
    return found if is_usual else [*found, Situation(OWN, scene)]


SWEEP = (1e4, 3e6, 26)
"""First and last dm n [mm rpm] of the speeds at which errors are followed, and how many, evenly in their logarithm."""


def swept_dm_n() -> NDArray:
    """The speeds of `SWEEP` [mm rpm]."""
    first, last, count = SWEEP
    return np.logspace(np.log10(first), np.log10(last), count)


def sweep(scene: Scene) -> Scene:
    """The scene at the speeds of `SWEEP`, along one case axis."""
    speeds = swept_dm_n() / (float(np.asarray(scene.bearing.pitch_diameter)) / mm) * rpm
    return replace(scene, operation=replace(scene.operation, speed=speeds, outer_speed=None))


def at_speed(scene: Scene, speed: float) -> Scene:
    """The scene with its inner ring alone turning, at this speed [rad/s]."""
    return replace(scene, operation=replace(scene.operation, speed=speed, outer_speed=None))


def dm_n(scene: Scene) -> float:
    """Speed parameter of the ring that turns faster against the other [mm rpm]."""
    operation = scene.operation
    outer = 0.0 if operation.outer_speed is None else float(np.asarray(operation.outer_speed))
    speed = abs(float(np.asarray(operation.speed)) - outer)
    return float(np.asarray(scene.bearing.pitch_diameter)) / mm * speed / rpm


def many(scene: Scene, count: int) -> Scene:
    """So many cases around a scene: all that is not zero varied by `VARIED` to either side, each in its own rhythm."""
    varied: dict[str, Any] = {}
    fields = ["speed", "outer_speed"]
    for channel in CHANNELS:
        fields += [channel.load, channel.displacement]
    # Multiples of the golden ratio's fraction fill the interval evenly, for any count, and repeat nothing.
    steps = np.arange(1, count + 1)
    for place, name in enumerate(fields, start=1):
        value = getattr(scene.operation, name)
        if value is not None and float(np.asarray(value)) != 0.0:
            part = (steps * (0.6180339887498949 * place)) % 1.0
            varied[name] = float(np.asarray(value)) * (1.0 + VARIED * (2.0 * part - 1.0))
    return replace(scene, operation=replace(scene.operation, **varied))
