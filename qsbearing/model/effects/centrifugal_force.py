"""Centrifugal force of the balls.

Source        Jones 1960; Harris & Kotzalas; Wang et al. (19.11)
Equation      Fc = m dm omega_m^2/2, radially outward at the ball's centre; m = rho pi D^3/6
Assumes       steady orbit, the ball's centre at the pitch radius, no cage force, no drag of the oil
When not      below about 1e5 mm*rpm for steel balls it changes contact loads by well under a per cent
Parameters    none of its own; it needs raceway control, which sets the orbital speed
Indicator     x = Fc/Q at the least load that counts: its contact angles part by about x sin(alpha)
Example       Scene(bearing, operation, ball_effects=(CentrifugalForce(),), raceway_control=RacewayControl.OUTER)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import inlined
from qsbearing.model.effects.angle_difference import difference_errors
from qsbearing.model.effects.entry import Entry, Errors, effect, for_arrays, largest
from qsbearing.model.effects.operating_point import OperatingPoint


@dataclass(frozen=True)
class CentrifugalForce:
    """Ask for the centrifugal force of the balls."""

    name: ClassVar[str] = "centrifugal_force"


@inlined
def centrifugal_force(
    mass: float, pitch_diameter: float, orbit: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Fc and its derivatives by ai and ao, from the orbital speed and its derivatives."""
    speed, by_inner, by_outer = orbit
    half = 0.5 * mass * pitch_diameter
    return half * speed * speed, 2.0 * half * speed * by_inner, 2.0 * half * speed * by_outer


def _over_load(point: OperatingPoint) -> NDArray:
    bearing = point.bearing
    orbit = (point.orbital_speed, 0.0, 0.0)
    force, _, _ = for_arrays(centrifugal_force)(bearing.ball_mass, bearing.pitch_diameter, orbit)
    return point.over_load(force)


def _errors(point: OperatingPoint) -> Errors:
    """The contact angles differ, as Qi, Qo and Fc close their triangle; the outer contact carries the force besides."""
    x, angle = _over_load(point), np.where(point.is_heavy, np.abs(point.solution.inner.angle), 0.0)
    is_in = any(isinstance(one, CentrifugalForce) for one in point.scene.ball_effects)
    own = _angle_difference(angle, x)
    for _ in range(0 if is_in else 2):  # the inner angle rises by half of it, and with it the load falls
        risen = np.minimum(angle + 0.5 * own, 0.5 * np.pi)
        with np.errstate(divide="ignore", invalid="ignore"):
            own = np.where(angle > 0.0, _angle_difference(risen, x * np.sin(risen) / np.sin(angle)), 0.0)
    errors = difference_errors(point, own, is_in)
    half = 0.5 * np.cos(angle)  # the root of 1 + x cos + x^2, with no square of a large x
    outer = np.hypot(x + half, np.sqrt(1.0 - half * half)).max(axis=-1)  # of Qo/Qi, by half in Qo and by half in Qi
    errors["load"] = np.maximum(errors["load"], 1.0 - 1.0 / outer)
    errors["pressure"] = np.maximum(errors["pressure"], 1.0 - 1.0 / np.cbrt(outer))
    return errors


def _angle_difference(angle: NDArray, x: NDArray) -> NDArray:
    """The angle between the two contacts of a ball with Fc = x Qi."""
    return np.asarray(angle - np.arctan2(np.sin(angle), np.cos(angle) + x))


ENTRY = Entry(
    "centrifugal_force",
    "the centrifugal force of the balls",
    effect("ball_effects", CentrifugalForce, CentrifugalForce),
    indicator=largest(_over_load),
    errors=_errors,
)
