"""Centrifugal force of the balls.

Source        Jones 1960; Harris & Kotzalas; Wang et al. (19.11)
Equation      Fc = m dm omega_m^2/2, radially outward at the ball's centre; m = rho pi D^3/6
Assumes       steady orbit, the ball's centre at the pitch radius, no cage force, no drag of the oil
When not      below about 1e5 mm*rpm for steel balls it changes contact loads by well under a per cent
Parameters    none of its own; it needs raceway control, which sets the orbital speed
Example       Scene(bearing, operation, ball_effects=(CentrifugalForce(),), raceway_control=RacewayControl.OUTER)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from qsbearing.compiled import kernel


@dataclass(frozen=True)
class CentrifugalForce:
    """Ask for the centrifugal force of the balls."""

    name: ClassVar[str] = "centrifugal_force"


@kernel
def centrifugal_force(
    mass: float, pitch_diameter: float, orbit: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Fc and its derivatives by ai and ao, from the orbital speed and its derivatives."""
    speed, by_inner, by_outer = orbit
    half = 0.5 * mass * pitch_diameter
    return half * speed * speed, 2.0 * half * speed * by_inner, 2.0 * half * speed * by_outer
