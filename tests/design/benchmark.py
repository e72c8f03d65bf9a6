"""The "rolling element bearing design" benchmark of constrained optimisation: D 160, d 90, Bw 30 mm, ten variables.

Gupta, Tiwari and Nair, Mech. Mach. Theory 42 (2007) 1418; problem 2.3.14 of Kumar et al., Swarm Evol. Comput. 56 (2020)
100693. A design that is printed there and later: Dm 125.7191, Db 21.42559 mm, Z 11, fi = fo = 0.515, with 81,859.7.
Elsewhere 81,843.3 and 85,549.2 are printed, which are no values of this function at its optimum.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.design.wanted import Condition, Variable, Wanted

D, d, BW = 160.0, 90.0, 30.0
BOUNDS = {
    "Dm": (0.5 * (D + d), 0.6 * (D + d)), "Db": (0.15 * (D - d), 0.45 * (D - d)), "fi": (0.515, 0.6),
    "fo": (0.515, 0.6), "KDmin": (0.4, 0.5), "KDmax": (0.6, 0.7), "eps": (0.3, 0.4), "e": (0.02, 0.1),
    "zeta": (0.6, 0.85),
}  # fmt: skip
LIMITS = ("assembly", "least ball", "largest ball", "width", "pitch", "eccentricity", "wall")
PRINTED = {
    "Dm": 125.7191, "Db": 21.42559, "fi": 0.515, "fo": 0.515, "KDmin": 0.424266, "KDmax": 0.633948, "eps": 0.3,
    "e": 0.068858, "zeta": 0.799498, "Z": 11.0,
}  # fmt: skip
PRINTED_CAPACITY = 81859.7
"""[N] of a design printed to seven digits, so known to about 1 N."""

PROBLEM = Wanted(
    (*(Variable(key, *ends) for key, ends in BOUNDS.items()), Variable("Z", 4, 50, values=tuple(range(4, 51)))),
    tuple(Condition(name, ">=", 0.0) for name in LIMITS),
    "capacity",
    True,
)


def capacity(x: NDArray) -> NDArray:
    """Limits (>= 0), then the dynamic capacity [N]; x in the order of PROBLEM's variables, shape (point, 10)."""
    Dm, Db, fi, fo, k_min, k_max, eps, e, zeta, Z = x.T
    gamma = Db / Dm
    ratio = 1.04 * ((1 - gamma) / (1 + gamma)) ** 1.72 * (fi * (2 * fo - 1) / (fo * (2 * fi - 1))) ** 0.41
    fc = (
        37.91 * (1 + ratio ** (10 / 3)) ** -0.3
        * gamma**0.3 * (1 - gamma) ** 1.39 / (1 + gamma) ** (1 / 3) * (2 * fi / (2 * fi - 1)) ** 0.41
    )  # fmt: skip
    found = np.where(Db <= 25.4, fc * Z ** (2 / 3) * Db**1.8, 3.647 * fc * Z ** (2 / 3) * Db**1.4)
    T = D - d - 2 * Db
    inside, outside = (D - d) / 2 - 3 * T / 4, D / 2 - T / 4 - Db
    cosine = (inside**2 + outside**2 - (d / 2 + T / 4) ** 2) / (2 * inside * outside)
    filled = 2 * np.pi - 2 * np.arccos(np.clip(cosine, -1, 1))
    limits = (
        filled / (2 * np.arcsin(np.clip(gamma, 0, 1))) + 1 - Z, 2 * Db - k_min * (D - d), k_max * (D - d) - 2 * Db,
        zeta * BW - Db, Dm - 0.5 * (D + d), (0.5 + e) * (D + d) - Dm, 0.5 * (D - Dm - Db) - eps * Db,
    )  # fmt: skip
    return np.column_stack([*limits, found])
