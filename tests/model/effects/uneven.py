"""What tests of balls and grooves that are not alike compare."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs


def contacts(solution: qs.Solution) -> dict[str, NDArray]:
    """All that is read of the contacts and of the motion, by ball."""
    sides = {"inner": solution.inner, "outer": solution.outer}
    names = ("load", "angle", "approach", "semi_major_axis", "max_pressure", "required_friction")
    found = {f"{side} {name}": getattr(one, name) for side, one in sides.items() for name in names}
    for name in ("centrifugal_force", "gyroscopic_moment", "orbital_speed", "rotation_speed", "attitude_angle"):
        found[name] = getattr(solution, name)
    return {name: array for name, array in found.items() if array is not None}


def turned(vector: NDArray, angle: float) -> NDArray:
    """Loads or displacements of the five channels, turned about x."""
    (y, z), (my, mz) = vector[1:3], vector[3:]
    c, s = np.cos(angle), np.sin(angle)
    return np.array([vector[0], c * y - s * z, s * y + c * z, c * my - s * mz, s * my + c * mz])
