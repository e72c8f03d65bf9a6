"""Orbit radius: how far from the bearing axis the balls' centres go round.

Source        geometry; the textbooks (Harris & Kotzalas) and Wang et al. (19.11) take the pitch circle
Equation      R = dm/2 + X2 - Lo cos(a0): the pitch radius and the radial displacement of the ball's centre from where
              it touches at the free contact angle. R takes the place of dm/2 in Fc = m R omega_m^2, and g = D/(2R) that
              of D/dm in the ball's motion and in the attitude of its axis
Assumes       each ball rolls as on a circle of its own radius. Ring speeds count about the outer ring's axis: the
              inner ring's eccentricity, of the same order, is left out of the speed of its surface
When not      the balls' centres move by about (1 - cos(ao)) Lo and the outer approach: 0.1 mm in B218 at speed, 0.2 %
              of its pitch radius. What is read off a solution beside the balls' motion (frequencies) takes dm
Parameters    none
Example       Scene(bearing, operation, effects, RacewayControl.OUTER, orbit_radius=OrbitRadius.DISPLACED)
"""

from __future__ import annotations

from enum import StrEnum

from qsbearing.compiled import kernel


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
