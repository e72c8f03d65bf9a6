"""A rigid rotor on bearings, by the laws of a rigid body in the bearing's own axes: knows nothing of ROSS or its axes.

x is the shaft. Of the centre of mass (y, z) and rotations (gy, gz), a place x on the shaft moves by (0, gz x, -gy x).
Angular momentum: about y Id gy' + Ip W gz, about z Id gz' - Ip W gy (the shaft's unit vector is (1, gz, -gy)).
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

MIRROR = np.diag([-1.0, 1.0, 1.0, -1.0, -1.0])
"""Of the bearing's x, y, z, tilt y, tilt z: across the shaft, rotations as a mirror turns them."""


def eigenvalues(
    mass: float, polar: float, diametral: float, speed: float, bearings: Iterable[tuple[float, NDArray]]
) -> NDArray:
    """The ten eigenvalues of its free vibration [1/s]; bearings as (place from the centre of mass, 5 x 5 stiffness)."""
    stiffness = np.zeros((5, 5))
    for x, own in bearings:
        to_place = np.eye(5)
        to_place[1, 4], to_place[2, 3] = x, -x
        stiffness += to_place.T @ own @ to_place
    masses = np.diag([mass, mass, mass, diametral, diametral])
    gyroscopic = np.zeros((5, 5))
    gyroscopic[3, 4], gyroscopic[4, 3] = polar * speed, -polar * speed
    inverse = np.linalg.inv(masses)
    state = np.block([[np.zeros((5, 5)), np.eye(5)], [-inverse @ stiffness, -inverse @ gyroscopic]])
    return np.linalg.eigvals(state)


def cylinder(density: float, length: float, diameter: float) -> tuple[float, float, float]:
    """Mass, polar and diametral moment of inertia of a solid cylinder."""
    mass = density * length * np.pi * diameter**2 / 4.0
    return mass, mass * diameter**2 / 8.0, mass * (diameter**2 / 16.0 + length**2 / 12.0)
