"""Ball motion: whether each ball has the axis and the orbit of its azimuth, or all have the same.

A hypothesis. Jones's balance gives each ball the axis and the orbital speed that its azimuth asks for, as if it had all
the time it needs to take them on. At speed it has not: the outer ring then carries another load than the inner one
(`momentum_gap` of the reading `ball_advance`). Balls that a cage of small clearance carries round all have one orbital
speed, and the mean of all axes is what their inertia leaves them.

Source        derived here: of balls that go round under a load that stands still, what accelerates them has no mean
Equation      omega_m = mean of omega_m,j and (wx, wr) = mean of (wx, wr),j over the balls, each as raceway control has
              it at its contact angles; Fc = m R omega_m^2 and Mg = J wr omega_m are then alike for all balls, so that
              sum of Fc e = 0 and both rings carry the same
Assumes       a cage without clearance, and axes that do not follow the azimuth at all. Contacts need not roll: the
              cage's forces and the friction of the slip are not worked out
When not      slow bearings, whose balls do follow: where the momentum gap is small, both answers are the same. The
              friction balance, which knows how far balls follow, has .2 to .9 of this change
Parameters    none
Indicator     range of the centrifugal forces over the largest load
Example       Scene(bearing, operation, effects, RacewayControl.OUTER, ball_motion=MotionOfBalls.COMMON)
"""

from __future__ import annotations

from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.angle_difference import by_friction
from qsbearing.model.effects.entry import Entry, choice, largest
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.validation import ErrorDetail


class MotionOfBalls(StrEnum):
    """What of the balls' motion is their own."""

    OWN = "own"
    """Axis and orbit are each ball's, as its azimuth asks for."""
    COMMON = "common"
    """Axis and orbit are the mean of all balls', as a cage without clearance imposes."""


CONTROLS = ("outer", "inner", "minimum_dissipation")
"""Of raceway control, with which balls may have a common motion."""


def motion_errors(of: Any) -> list[ErrorDetail]:
    """Errors of a common motion that a scene cannot have."""
    if of.ball_motion != MotionOfBalls.COMMON:
        return []
    problem, shown = "is not known with", str(of.ball_motion)
    errors = []
    if not of.ball_effects:
        cause = "Leave it out, or ask for centrifugal_force or gyroscopic_moment"
        errors.append(ErrorDetail("ball_motion", "is given, but no ball effect depends on it", shown, cause=cause))
    elif of.raceway_control is not None and of.raceway_control not in CONTROLS:
        cause = "Choose one raceway that controls all balls, or leave ball_motion out"
        detail = f"{problem} raceway_control = {str(of.raceway_control)!r}"
        errors.append(ErrorDetail("ball_motion", detail, shown, cause=cause))
    if of.orbit_radius != "pitch_circle":
        cause = "Leave one of them out: balls on orbits of their own do not all go round alike"
        errors.append(
            ErrorDetail("ball_motion", f"{problem} orbit_radius = {str(of.orbit_radius)!r}", shown, cause=cause)
        )
    if any(getattr(each, "name", "") == "unequal_balls" for each in of.ring_effects):
        cause = "Leave one of them out: unequal balls do not all go round alike"
        errors.append(ErrorDetail("ball_motion", f"{problem} balls of unequal diameters", shown, cause=cause))
    return errors


def _apart(point: OperatingPoint) -> NDArray:
    """By how much each ball's centrifugal force differs from the mean, over its load (*cases, ball)."""
    force = point.solution.centrifugal_force
    if force is None:
        return np.zeros_like(point.load)
    apart = np.abs(force - np.nanmean(np.where(np.isfinite(force), force, np.nan), axis=-1, keepdims=True))
    largest_load = np.maximum(point.largest_load, np.finfo(float).tiny)[..., None]
    return np.where(point.is_heavy, apart / largest_load, 0.0)


_SWITCH = choice("ball_motion", MotionOfBalls.OWN, MotionOfBalls.COMMON, of_balls=True)
assert _SWITCH.members is not None

ENTRY = Entry(
    "ball_motion",
    "the hypothesis of the balls' motion round the bearing (the other instead)",
    _SWITCH._replace(members=_SWITCH.members._replace(finest=None)),  # a hypothesis has none
    indicator=largest(_apart),
    errors=by_friction(_apart),
    hypothesis="how far balls follow their azimuths is a hypothesis, which the model cannot test",
    saves_time=False,
)
