"""The cases at which a scene is looked at: its own loads from rest to the fastest speeds in use, and batches of it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.operation import CHANNELS
from qsbearing.model.scene.scene import Scene
from qsbearing.model.units import mm, rpm
from qsbearing.systems.sets.bearing_set import BearingSet

NAMED = {"rest": 0.0, "general machinery": 1e5, "spindle": 1e6, "aero engine": 2.5e6}
"""dm n [mm rpm]: customary ranges of use."""
OWN = "the scene's own speed"

BETWEEN = np.logspace(4.0, 6.5, 26)
"""dm n [mm rpm] at which errors are followed besides."""

VARIED = 0.1
"""Batches vary loads, displacements and speeds by this part to either side."""


Requested = Scene | BearingSet


def pitch_diameter(of: Requested) -> NDArray:
    """Of a set the largest of its rows [mm]."""
    bearings = [of.bearing] if isinstance(of, Scene) else [row.bearing for row in of.rows]
    return np.asarray(np.max([np.asarray(each.pitch_diameter, float) for each in bearings], axis=0) / mm)


def dm_n(scene: Requested) -> NDArray:
    """Speed parameter of one ring against the other [mm rpm]."""
    operation = scene.operation
    outer = 0.0 if operation.outer_speed is None else operation.outer_speed
    speed = np.asarray(operation.speed, float) - np.asarray(outer, float)
    return pitch_diameter(scene) * np.abs(speed) / rpm


def along_speeds(scene: Requested) -> tuple[list[str | None], Requested]:
    """(names, the scene along one case axis): its inner ring alone turning at the speeds of `NAMED` and `BETWEEN`, in
    order, and last the scene as it is; None for speeds without a name."""
    names: dict[float, str] = {value: name for name, value in NAMED.items()}
    values = sorted({*NAMED.values(), *map(float, BETWEEN)})
    inner = np.array(values) / float(pitch_diameter(scene)) * rpm
    own = scene.operation
    outer = None if own.outer_speed is None else np.append(0.0 * inner, own.outer_speed)
    operation = replace(own, speed=np.append(inner, own.speed), outer_speed=outer)
    return [*map(names.get, values), OWN], replace(scene, operation=operation)


def batch(scene: Requested, count: int) -> Requested:
    """So many cases around a scene, or for one the scene itself: all that is not zero varied by `VARIED` to either
    side, each in its own rhythm: multiples of the golden ratio's fraction fill the interval, no value twice."""
    varied: dict[str, Any] = {}
    fields = ("speed", "outer_speed", *(name for channel in CHANNELS for name in channel[:2]))
    for position, name in enumerate(fields if count > 1 else (), start=1):
        if value := getattr(scene.operation, name):
            part = (np.arange(1, count + 1) * (0.6180339887498949 * position)) % 1.0
            varied[name] = float(value) * (1.0 + VARIED * (2.0 * part - 1.0))
    return replace(scene, operation=replace(scene.operation, **varied))
