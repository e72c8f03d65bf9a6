"""Mesh convergence: uncertainty, value for a vanishing element, observed order."""

from __future__ import annotations

import numpy as np
from scipy.special import stdtrit

SAFE_FACTOR = 1.25
"""On the extrapolated error: that of the Grid Convergence Index on three meshes or more (P. J. Roache, J. Fluids Eng.
116, 1994; ASME V&V 20-2009, section 2-4). Meant to cover 95 of 100 cases: the check `convergence_order` counts."""

APART = 1.3
"""Least ratio of two meshes' sizes that an estimate may rest on (I. B. Celik et al., J. Fluids Eng. 130, 078001, 2008).
Nearer ones differ by what is irregular in their errors, which r^p - 1 then enlarges: 2.8 times at 1.2 and order 2."""

APPROACH_ORDERS = (2.0, 2.5)
"""Of approaches, and of what follows from them. The pressure ends like a square root at the contact's edge, which no
mesh line follows: on half-spaces, where the error is known, it falls by about 2.5 (the check `convergence_order`)."""


def largest_change(values: list[float]) -> float:
    """Of the finest mesh's value from any other's: the uncertainty of what shows no order, such as a ratio of two
    results on one mesh, of whose errors only an irregular rest is left."""
    return max(abs(value - values[-1]) for value in values[:-1])


def scatter(groups: list[list[float]]) -> float:
    """How far one value may be from the truth, 95 times of 100, over the truth: where meshes scatter in no order, and
    by the same part of the value in several cases alike.

    Standard deviation pooled over the cases, times Student's t for its degrees of freedom (JCGM 100:2008, "GUM", 4.2.4
    and G.3). Of three such values of one case, chance brings the last nearer to both others than to the truth in about
    15 cases of 100 (normal), which is what `largest_change` would then miss.

    Args:
        groups: of each case its values, two or more.
    """
    # Values that agree have no scatter, also where they are 0, as of what an effect that is not there makes.
    over_mean = [np.asarray(values) / np.mean(values) for values in groups if np.ptp(values) > 0.0]
    freedom = sum(len(values) - 1 for values in groups)
    pooled = np.sqrt(sum(float(np.sum((values - 1.0) ** 2)) for values in over_mean) / freedom)
    return float(stdtrit(freedom, 0.975) * pooled)


def uncertainty_at_order(sizes: list[float], values: list[float], order: float) -> float:
    """Of the finest mesh's value: the Grid Convergence Index 1.25 |f - f_fine|/(r^p - 1), r the ratio of sizes, where
    the order p is known from elsewhere; the larger of what the coarser meshes say, each beside the finest.

    Meshes whose errors are irregular show no order of their own in three values, and chance may bring two together.
    """
    steps = [
        abs(value - values[-1]) / ((size / sizes[-1]) ** order - 1.0)
        for size, value in zip(sizes[:-1], values[:-1], strict=True)
    ]
    return SAFE_FACTOR * max(steps)


def well_apart(sizes: list[float], values: list[float]) -> tuple[list[float], list[float]]:
    """The meshes whose elements are at least `APART` times those of the finest, and the finest, with their values; all
    where fewer than three would be left, for of two chance may bring the values together."""
    kept = [(size, value) for size, value in zip(sizes[:-1], values[:-1], strict=True) if size >= APART * sizes[-1]]
    if len(kept) < 2:
        return sizes, values
    coarser, coarser_values = zip(*kept, strict=True)
    return [*coarser, sizes[-1]], [*coarser_values, values[-1]]


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
