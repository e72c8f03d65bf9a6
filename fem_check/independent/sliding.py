"""Mean sliding speed in an elliptical contact that rolls and spins, by a plain sum over its area.

At x along the major axis the surface that ball and groove share lies x^2/(2 R) below the contact's middle. A relative
rotation of the bodies, its part `roll` in the tangent plane and its part `spin` about the normal, makes them slide by
roll (h - x^2/(2 R)) + spin x along the rolling direction, and by -spin y across it. h is where the friction of Coulomb
has no resultant along the rolling direction (Heathcote 1921; Jones 1959).
"""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

COUNT = 400
"""Points along each axis, at the middles of equal parts of an angle: the pressure's weight has no singular end then."""


def mean_speed(roll: float, spin: float, semi_axes: tuple[float, float], radius: float) -> float:
    """Weighted with Hertz's pressure [m/s].

    Args:
        roll, spin: [rad/s].
        semi_axes: major and minor [m].
        radius: R, of the surface that the bodies share, across the groove [m].
    """
    a, b = semi_axes
    angle = np.pi * (np.arange(COUNT) + 0.5) / COUNT - 0.5 * np.pi
    along = np.sin(angle)[:, None]
    half_width = np.cos(angle)[:, None]
    across = half_width * np.sin(angle)
    # sqrt(1 - X^2 - Y^2) dX dY, X = sin t, Y = cos t sin s.
    weight = half_width**3 * np.cos(angle) ** 2
    weight /= weight.sum()

    def speeds(h: float) -> tuple[np.ndarray, np.ndarray]:
        rolling = roll * (h - (a * along) ** 2 / (2.0 * radius)) + spin * a * along + 0.0 * across
        return rolling, np.hypot(rolling, spin * b * across)

    def traction(h: float) -> float:
        rolling, size = speeds(h)
        return float((weight * rolling / np.maximum(size, 1e-300)).sum())

    deepest = a**2 / (2.0 * radius)
    return float((weight * speeds(brentq(traction, 0.0, deepest, xtol=1e-6 * deepest))[1]).sum())
