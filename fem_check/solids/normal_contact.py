"""No tension, no penetration: p >= 0, F p + g >= 0, and p (F p + g) = 0, for bodies at a given position.

F is symmetric and positive definite, so the solution is unique and an active set finds it in a few dense solves; with
the position given there is no rigid motion that a wrong active set could set free.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from fem_check.contact import ContactError
from fem_check.contact_problem import Array

MAX_CHANGES = 200
"""Iterations of the active set; ten are usual."""


@dataclass(frozen=True)
class NormalContact:
    """Pressures of a position."""

    pressures: Array
    """Coefficients of the basis functions [Pa]."""
    active: Array
    """Which basis functions carry pressure."""
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
    active = gaps < 0.0 if start is None else start.copy()
    scale = float(-gaps.min())
    if scale <= 0.0:
        return NormalContact(np.zeros_like(gaps), np.zeros(len(gaps), dtype=bool), 0.0)
    if not active.any():
        active = gaps < 0.0
    seen: set[bytes] = set()
    single = False
    for _ in range(MAX_CHANGES):
        inside = np.flatnonzero(active)
        factor = cho_factor(flexibility[np.ix_(inside, inside)], check_finite=False)
        pressure = np.zeros_like(gaps)
        pressure[inside] = -cho_solve(factor, gaps[inside])
        left = flexibility[:, inside] @ pressure[inside] + gaps
        drop = active & (pressure < 0.0)
        add = ~active & (left < -1e-12 * scale)
        if not drop.any() and not add.any():
            return NormalContact(pressure, active, max(0.0, -float(left.min())) / scale)
        if single:
            # One basis function at a time cannot cycle: each change lowers the energy.
            worst = np.where(drop, pressure / np.abs(pressure).max(), np.where(add, left / np.abs(left).max(), 0.0))
            change = int(np.argmin(worst))
            active[change] = ~active[change]
            continue
        active = (active & ~drop) | add
        key = active.tobytes()
        single = key in seen
        seen.add(key)
    raise ContactError(f"the active set did not converge in {MAX_CHANGES} iterations")
