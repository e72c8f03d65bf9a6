"""Displacement of an elastic half-space under normal loads on its surface (Boussinesq 1885)."""

from __future__ import annotations

from math import pi

import numpy as np
import scipy.sparse as sp

from fem_check.independent.contact_problem import Array

SOURCE = "Johnson, Contact Mechanics, 1985, eqs 3.18"


def point_load_displacement(dx: Array, dy: Array, z: Array, poisson_ratio: float) -> tuple[Array, Array, Array]:
    """Displacement (x, y, z) at (dx, dy, z) from a unit load along +z into a half-space z >= 0 with E = 1.

    Only for points away from the load: the formula is singular there.
    """
    nu = poisson_ratio
    rho = np.sqrt(dx * dx + dy * dy + z * z)
    factor = (1.0 + nu) / (2.0 * pi)
    inverse = 1.0 / rho
    cubed = z * inverse * inverse * inverse  # no power, which takes as long as all the rest
    radial = factor * (cubed - (1.0 - 2.0 * nu) * inverse / (rho + z))
    return radial * dx, radial * dy, factor * (2.0 * (1.0 - nu) * inverse + z * cubed)


def pressure_displacement(
    points: Array, load_points: Array, loads: sp.csr_matrix, poisson_ratio: float, *, is_odd: bool = False
) -> Array:
    """Displacement of the half-space at `points` under each pressure basis function; these fill the quarter x, y >= 0
    and are mirrored in both planes, where odd in the plane x = 0 with the other sign.

    Args:
        points: where, shape (3, point), lengths in any unit, E = 1.
        load_points: where the pressure is sampled, shape (2, sample), on z = 0.
        loads: force of each basis function at each sample, shape (sample, basis).

    Returns:
        shape (3, point, basis).
    """
    displacement = np.zeros((3, points.shape[1], loads.shape[1]))
    transposed = loads.T.tocsr()
    # Blocks of about 10 MB: the full table of points times samples would be the memory peak of a fine mesh.
    block = max(1, int(4e5 / load_points.shape[1]))
    for start in range(0, points.shape[1], block):
        some = points[:, start : start + block]
        total = [np.zeros((some.shape[1], load_points.shape[1])) for _ in range(3)]
        for sign_x, sign_y in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            dx = some[0][:, None] - sign_x * load_points[0]
            dy = some[1][:, None] - sign_y * load_points[1]
            for axis, part in enumerate(point_load_displacement(dx, dy, some[2][:, None], poisson_ratio)):
                total[axis] += sign_x * part if is_odd else part
        for axis in range(3):
            displacement[axis, start : start + block] = (transposed @ total[axis].T).T
    return displacement
