"""What heat friction makes in a bearing: the powers of the model that the scene chooses, by its reading."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.solution import Solution
from qsbearing.readings.asked import LUBRICANT, READINGS
from qsbearing.readings.contact_friction import ENTRY as CONTACT_FRICTION
from qsbearing.readings.lubricant import oil_of
from qsbearing.systems.heat.network import READING_OF

DRAG = "drag"


def sources_of(friction: str, readings: Mapping[str, Any]) -> tuple[str, ...]:
    """The sources of heat that a model tells apart."""
    if READING_OF[friction] != CONTACT_FRICTION.name:
        return ("friction",)
    drags = readings[CONTACT_FRICTION.name].get("drag_coefficient") is not None
    return ("inner contacts", "outer contacts", *([DRAG] if drags else []))


def powers(solution: Solution, friction: str) -> NDArray:
    """Of each of these sources [W]; shape (source, *cases); NaN where the bearing is not solved."""
    readings = solution.scene.readings
    reading = READINGS[READING_OF[friction]]
    oil, _ = oil_of(readings[LUBRICANT]) if LUBRICANT in readings else (None, [])
    taken = reading.take(solution, reading.arguments(readings[reading.name], oil), {})
    if reading is CONTACT_FRICTION:
        parts = [taken.inner.power.sum(axis=-1), taken.outer.power.sum(axis=-1)]
        parts += [] if taken.drag_power is None else [np.nansum(taken.drag_power, axis=-1)]
    else:
        parts = [getattr(taken, friction).power]
    found = np.stack([np.broadcast_to(part, solution.shape) for part in parts])
    return np.where(np.asarray(solution.converged), found, np.nan)
