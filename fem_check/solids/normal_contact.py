"""No tension, no penetration: p >= 0, F p + g >= 0, and p (F p + g) = 0, for bodies at a given position.

F is symmetric and positive definite, so the solution is unique and an active set finds it in a few dense solves; with
the position given there is no rigid motion that a wrong active set could set free.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_solve

from fem_check.independent.contact_problem import Array
from fem_check.mechanics.contact import Factor, Trial, settle


@dataclass(frozen=True)
class NormalContact:
    """Pressures of a position."""

    pressures: Array
    """Coefficients of the basis functions [Pa]."""
    active: Array
    """Which basis functions carry pressure."""
    left: Array
    """Weighted gaps that are left."""
    penetration: float
    """Deepest weighted gap below zero, over the largest undeformed overlap."""


def solve(flexibility: Array, gaps: Array, start: Array | None = None) -> NormalContact:
    """Solve for the pressures.

    Args:
        flexibility: F, of all bodies together, (basis, basis).
        gaps: g, the undeformed gap weighted with each basis function, (basis,).
        start: initial active set.

    Raises:
        ContactError: the active set does not settle.
    """
    scale = float(-gaps.min())
    if scale <= 0.0:
        return NormalContact(np.zeros_like(gaps), np.zeros(len(gaps), dtype=bool), gaps, 0.0)
    if start is None or not start.any():
        start = gaps < 0.0

    def given(inside: Array, factor: Factor) -> tuple[Trial, Array]:
        pressure = np.zeros_like(gaps)
        pressure[inside] = -cho_solve(factor, gaps[inside])
        return Trial(pressure, flexibility[:, inside] @ pressure[inside] + gaps, 1e-12 * scale), np.zeros(0)

    active, trial, _ = settle(flexibility, start, given)
    return NormalContact(trial.pressure, active, trial.left, max(0.0, -float(trial.left.min())) / scale)
