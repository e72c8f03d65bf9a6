"""The contact angle at which Hertz's curvature in the rolling direction is taken.

Source        Harris & Kotzalas; ISO/TS 16281 for angle zero
Equation      R = D/2 (1 -+ g cos(alpha)), minus at the inner raceway, g = D/dm; only alpha differs
Assumes       nothing: the actual angle is exact within Hertz; free and zero are constants of the bearing, and faster
When not      where contact angles stay near the free one the actual angle changes nothing that could be measured
Parameters    none
Indicator     g sin(alpha)/(1 - g cos(alpha0)) for each radian by which contact angles leave the free one: the change of
              the curvature
Example       Scene(bearing, operation, hertz_angle=HertzAngle.ACTUAL)
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import Entry, Errors, choice
from qsbearing.model.effects.operating_point import OperatingPoint


class HertzAngle(StrEnum):
    """The contact angle at which a raceway's curvature in the rolling direction is taken."""

    FREE = "free"
    """The free contact angle: the contact stiffnesses are constants of the bearing."""
    ACTUAL = "actual"
    """Each contact's own angle: finer and slower; it moves B218's angles by about 0.004 degrees."""
    ZERO = "zero"
    """Angle zero, as ISO/TS 16281 takes it."""


def _indicator(point: OperatingPoint) -> NDArray:
    free, g = np.asarray(point.bearing.free_contact_angle, float), point.diameter_ratio
    sides = (point.solution.inner, point.solution.outer)
    turns = [np.where(point.is_heavy, np.abs(side.angle - free[..., None]), 0.0).max(axis=-1) for side in sides]
    return np.asarray(g * np.sin(point.angle) / (1.0 - g * np.cos(free)) * np.maximum(*turns))


def _errors(point: OperatingPoint) -> Errors:
    """Half of the curvature's change shows in pressures and semi-axes, hardly any in the rest: by random scenes."""
    x = _indicator(point)
    rest = dict.fromkeys(("contact_angle", "load", "displacement", "stiffness"), 0.01 * x)
    return {"pressure": 0.5 * x, **rest}


ENTRY = Entry(
    "hertz_angle",
    "the actual contact angle in Hertz's formulas (the free one instead)",
    choice("hertz_angle", HertzAngle.FREE, HertzAngle.ACTUAL, kept=(HertzAngle.ZERO,)),
    indicator=_indicator,
    errors=_errors,
)
