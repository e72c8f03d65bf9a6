"""The radius at which a tilt moves the inner groove centres axially, and axial contact forces make moments.

Source        rigid rotation, (19.3) of Wang et al.; ISO/TS 16281 for the pitch circle
Equation      Ri = dm/2 + (fi - 1/2) D cos(alpha0), or dm/2
Assumes       small tilts
When not      the pitch circle is for comparison with ISO/TS 16281 only
Parameters    none
Indicator     Ri/(dm/2) - 1: moments at a given tilt change by twice it
Example       Scene(bearing, operation, tilt_lever=TiltLever.PITCH_CIRCLE)
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import Entry, Errors, choice
from qsbearing.model.effects.operating_point import OperatingPoint


class TiltLever(StrEnum):
    """The radius at which a tilt moves the inner groove centres axially, and axial contact forces make moments."""

    GROOVE_CENTRE = "groove_centre"
    """Ri, the circle of inner groove centres: exact for a rigid rotation (19.3)."""
    PITCH_CIRCLE = "pitch_circle"
    """dm/2, as ISO/TS 16281 takes it."""


def _indicator(point: OperatingPoint) -> NDArray:
    bearing = point.bearing
    ratio = bearing.inner_groove_centre_radius / (0.5 * np.asarray(bearing.pitch_diameter, float))
    return np.broadcast_to(np.asarray(ratio - 1.0), point.solution.shape)


def _errors(point: OperatingPoint) -> Errors:
    x = _indicator(point)
    tilted = np.abs(point.solution.displacement[..., 3:]).max(axis=-1) > 0.0
    return {"displacement": np.where(tilted, 2.0 * x, 0.0), "stiffness": 2.0 * x}


ENTRY = Entry(
    "tilt_lever",
    "the circle of groove centres as the lever of a tilt (the pitch circle instead)",
    choice("tilt_lever", TiltLever.PITCH_CIRCLE, TiltLever.GROOVE_CENTRE),
    indicator=_indicator,
    errors=_errors,
    saves_time=False,
)
