"""Orbit radius: how far from the bearing axis the balls' centres go round.

Source        geometry; the textbooks (Harris & Kotzalas) and Wang et al. (19.11) take the pitch circle
Equation      R = dm/2 + X2 - Lo cos(a0): the pitch radius and the radial displacement of the ball's centre from where
              it touches at the free contact angle. R takes the place of dm/2 in Fc = m R omega_m^2, and g = D/(2R) that
              of D/dm in the ball's motion and in the attitude of its axis
Assumes       each ball rolls as on a circle of its own radius. Ring speeds count about the outer ring's axis: the
              inner ring's eccentricity, of the same order, is left out of the speed of its surface
When not      the balls' centres move by about (1 - cos(ao)) Lo and the outer approach: 0.1 mm in B218 at speed, 0.2 %
              of its pitch radius. What is read off a solution besides the balls' motion (frequencies) takes dm
Parameters    none
Indicator     the relative change of the radius, the largest of the balls that count; the angle between their contacts,
              which is the inertia's work, changes by a part of that size
Example       Scene(bearing, operation, effects, RacewayControl.OUTER, orbit_radius=OrbitRadius.DISPLACED)
"""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.effects.angle_difference import difference_errors
from qsbearing.model.effects.entry import Entry, Errors, choice, for_arrays, largest
from qsbearing.model.effects.operating_point import OperatingPoint


class OrbitRadius(StrEnum):
    """The radius at which balls orbit."""

    PITCH_CIRCLE = "pitch_circle"
    """dm/2, the same for every ball."""
    DISPLACED = "displaced"
    """Each ball's own: the pitch radius and the radial displacement of its centre."""


@kernel
def displaced_radius(
    pitch_diameter: float, outer_length: float, cos_free: float, co: float, outer_approach: float
) -> float:
    """R of a ball, from its outer contact line of this free length; it grows by what X2 grows."""
    return 0.5 * pitch_diameter + outer_length * (co - cos_free) + outer_approach * co


def _relative_change(point: OperatingPoint) -> NDArray:
    """Of each ball's orbit (*cases, ball)."""
    bearing, outer = point.bearing, point.solution.outer
    pitch = np.asarray(bearing.pitch_diameter, float)[..., None]
    length = np.asarray(np.asarray(bearing.outer_groove_radius) - 0.5 * np.asarray(bearing.ball_diameter))[..., None]
    free = np.cos(np.asarray(bearing.free_contact_angle, float))[..., None]
    radius = for_arrays(displaced_radius)(pitch, length, free, np.cos(outer.angle), outer.approach)
    return np.where(point.is_heavy, np.abs(radius / (0.5 * pitch) - 1.0), 0.0)


def _errors(point: OperatingPoint) -> Errors:
    """Zero at rest, where the contacts of a ball lie in one line."""
    angle = np.where(point.is_heavy, np.abs(point.solution.inner.angle - point.solution.outer.angle), 0.0)
    return difference_errors(point, _relative_change(point) * angle, point.scene.orbit_radius == OrbitRadius.DISPLACED)


ENTRY = Entry(
    "orbit_radius",
    "the balls' own orbits (the pitch circle instead)",
    choice("orbit_radius", OrbitRadius.PITCH_CIRCLE, OrbitRadius.DISPLACED, of_balls=True),
    indicator=largest(_relative_change),
    errors=_errors,
)
