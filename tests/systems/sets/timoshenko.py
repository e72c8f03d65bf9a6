"""A Timoshenko beam of finite elements in a plane, dense: a reference of the tests' own.

Element of two nodes with deflection v and slope t each, from its exact homogeneous solution (Przemieniecki, Theory of
Matrix Structural Analysis): P = 12 E I/(k G A l^2).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def element(length: float, bending: float, shear: float) -> NDArray:
    """Over v1, t1, v2, t2; bending is E I, shear k G A."""
    p = 12.0 * bending / (shear * length**2)
    k = np.array(
        [
            [12.0, 6.0 * length, -12.0, 6.0 * length],
            [6.0 * length, (4.0 + p) * length**2, -6.0 * length, (2.0 - p) * length**2],
            [-12.0, -6.0 * length, 12.0, -6.0 * length],
            [6.0 * length, (2.0 - p) * length**2, -6.0 * length, (4.0 + p) * length**2],
        ]
    )
    return bending / (length**3 * (1.0 + p)) * k


def section(outer: float, inner: float, modulus: float, ratio: float) -> tuple[float, float]:
    """(E I, k G A) of a hollow circular section, k by Cowper."""
    m = inner / outer
    k = 6 * (1 + ratio) * (1 + m * m) ** 2 / ((7 + 6 * ratio) * (1 + m * m) ** 2 + (20 + 12 * ratio) * m * m)
    area = np.pi * (outer**2 - inner**2) / 4
    return modulus * np.pi * (outer**4 - inner**4) / 64, k * modulus / (2 * (1 + ratio)) * area


def matrix(nodes: NDArray, sections: list[tuple[float, float]]) -> NDArray:
    """Of elements between these nodes, one section each."""
    total = np.zeros((2 * nodes.size, 2 * nodes.size))
    for i, (bending, shear) in enumerate(sections):
        total[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += element(nodes[i + 1] - nodes[i], bending, shear)
    return total
