"""Drag of the balls on their way round, through oil and air."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.solution import Solution
from qsbearing.readings.ball_motion import orbital_speed
from qsbearing.readings.bearing_numbers import BearingNumbers

DRAG_COEFFICIENTS = 0.0, 10.0
"""What cd may be."""


def _speed(solution: Solution) -> NDArray:
    """Of the balls' centres on the pitch circle [m/s]."""
    return np.asarray(orbital_speed(solution) * 0.5 * _numbers(solution).pitch_diameter[..., None])


def _numbers(solution: Solution) -> BearingNumbers:
    return BearingNumbers(solution.scene.operating_bearing)


def drag_force(solution: Solution, coefficient: NDArray, density: NDArray) -> NDArray:
    """cd rho (pi D^2/8) (omega_m dm/2)^2 of each ball, as wide as its disc, at its orbital speed [N].

    Args:
        coefficient: cd of a ball between its neighbours; shape (*cases).
        density: rho of what it goes through; shape (*cases) [kg/m^3].
    """
    speed = _speed(solution)
    disc = 0.25 * pi * _numbers(solution).ball_diameter[..., None] ** 2
    return np.asarray(0.5 * coefficient[..., None] * density[..., None] * disc * speed * speed)


def drag_power(solution: Solution, coefficient: NDArray, density: NDArray) -> NDArray:
    """Of that force [W]."""
    return np.asarray(drag_force(solution, coefficient, density) * np.abs(_speed(solution)))
