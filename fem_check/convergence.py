"""Mesh convergence: observed order, value for a vanishing element, uncertainty."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

SAFE_FACTOR = 1.25
"""On the extrapolated error where three meshes converge as a power law (P. J. Roache's grid convergence index)."""
UNSAFE_FACTOR = 3.0
"""On the spread of the meshes where they do not (the same index, its caution for meshes outside that range)."""
PLAUSIBLE_ORDERS = (1.0, 4.5)
"""An edge singularity gives 1.5 to 3, a smooth field at most 4 with these elements; outside, the observed order means
nothing."""

APPROACH_ORDERS = (2.0, 2.5)
"""Of approaches, and of what follows from them. The pressure ends like a square root at the contact's edge, which no
mesh line follows: on half-spaces, where the error is known, it falls by about 2.5 (the check `convergence_order`)."""


@dataclass(frozen=True)
class MeshEstimate:
    """Outcome of a mesh sequence."""

    order: float | None
    """Observed order of convergence; None where the meshes do not converge as one power."""
    extrapolated: float
    """Value for a vanishing element; the finest mesh's where no order is observed."""
    uncertainty: float
    """Of the finest mesh's value, same unit."""


def estimate(sizes: list[float], values: list[float]) -> MeshEstimate:
    """Estimate from the three finest meshes.

    Args:
        sizes: element sizes, coarse to fine, at least three.
        values: the quantity on each mesh.
    """
    if len(sizes) != len(values) or len(sizes) < 3:
        raise ValueError(f"{len(sizes)} sizes and {len(values)} values: needs at least three of each")
    if not all(np.diff(sizes) < 0.0):
        raise ValueError(f"sizes = {sizes}: must fall, coarse to fine")
    h1, h2, h3 = sizes[-3:]
    v1, v2, v3 = values[-3:]
    spread = UNSAFE_FACTOR * max(abs(v1 - v3), abs(v2 - v3)) / ((h1 / h3) ** 2 - 1.0)
    if v2 == v3 or (v1 - v2) * (v2 - v3) <= 0.0:
        return MeshEstimate(None, v3, spread)
    ratio = (v1 - v2) / (v2 - v3)

    def misfit(order: float) -> float:
        return (h1**order - h2**order) / (h2**order - h3**order) - ratio

    low, high = PLAUSIBLE_ORDERS
    if misfit(low) * misfit(high) > 0.0:
        return MeshEstimate(None, v3, spread)
    order = float(brentq(misfit, low, high))
    error = (v2 - v3) * h3**order / (h2**order - h3**order)
    return MeshEstimate(order, v3 - error, SAFE_FACTOR * abs(error))


def uncertainty_at_order(sizes: list[float], values: list[float], order: float) -> float:
    """Of the finest mesh's value, where the order of convergence is known from elsewhere: the larger of what the
    coarser meshes say, each beside the finest.

    Meshes whose errors are irregular show no order of their own in three values, and chance may bring two together.
    """
    steps = [
        abs(value - values[-1]) / ((size / sizes[-1]) ** order - 1.0)
        for size, value in zip(sizes[:-1], values[:-1], strict=True)
    ]
    return SAFE_FACTOR * max(steps)


def extrapolated(sizes: list[float], values: list[float]) -> tuple[float, float]:
    """Value for a vanishing element and its uncertainty, where the error falls by an order within `APPROACH_ORDERS`.

    Least squares over all meshes with the lowest and the highest order; the value is the mean of both, the uncertainty
    the farthest that either comes from it with any one mesh left out.
    """
    if len(sizes) < 3:
        raise ValueError(f"{len(sizes)} meshes: needs at least three, for one is left out in turn")
    h, v = np.asarray(sizes), np.asarray(values)
    limits = []
    for order in APPROACH_ORDERS:
        table = np.column_stack([np.ones(len(h)), h**order])
        kept = [np.arange(len(h)), *(np.delete(np.arange(len(h)), left) for left in range(len(h)))]
        limits.append([float(np.linalg.lstsq(table[some], v[some], rcond=None)[0][0]) for some in kept])
    value = 0.5 * (limits[0][0] + limits[1][0])
    return value, SAFE_FACTOR * max(abs(limit - value) for each in limits for limit in each)


def fitted_order(sizes: list[float], errors: list[float]) -> float:
    """Slope of log error against log size over all meshes (least squares); errors are taken by size."""
    table = np.column_stack([np.log(sizes), np.ones(len(sizes))])
    return float(np.linalg.lstsq(table, np.log(np.abs(errors)), rcond=None)[0][0])
