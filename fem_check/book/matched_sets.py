"""Pairs and sets of rows as makers' catalogues have them: rigidity at a preload, and what unloads a row."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

import qsbearing as qs

GROOVES = (0.503, 0.58)
"""Between these f of a groove is sought."""
UPRIGHT = {"radial_displacement_y": 0.0, "radial_displacement_z": 0.0, "tilt_y": 0.0, "tilt_z": 0.0}


def under_thrust(bearing: qs.BallBearing, load: ArrayLike) -> qs.Solution:
    """One row at rest under an axial load [N]."""
    return qs.solve(qs.Scene(bearing, qs.Operation(axial_load=load)))


def pair_rigidities(bearing: qs.BallBearing, preload: ArrayLike) -> tuple[NDArray, NDArray]:
    """Axial and radial rigidity of a back-to-back pair at its preload [N/µm]: twice one row's tangent, held upright."""
    stiffness = 2e-6 * under_thrust(bearing, preload).stiffness
    return stiffness[..., 0, 0], stiffness[..., 1, 1]


def grooves_that_meet(bearing: Callable[[NDArray], qs.BallBearing], preload: ArrayLike, rigidity: NDArray) -> NDArray:
    """f = r/D, equal in both rings, at which each pair has this axial rigidity [N/µm] at its preload [N]."""
    low, high = (np.full(np.shape(rigidity), end) for end in GROOVES)
    for _ in range(40):  # a wider groove is softer; 0.077/2^40
        f = 0.5 * (low + high)
        stiffer = pair_rigidities(bearing(f), preload)[0] > rigidity
        low, high = np.where(stiffer, f, low), np.where(stiffer, high, f)
    return np.asarray(0.5 * (low + high))


def matched_set(
    plus: Sequence[qs.BallBearing],
    minus: Sequence[qs.BallBearing],
    operation: qs.Operation,
    preload: qs.Preload | None = None,
    offset: float = 0.0,
) -> qs.SetSolution:
    """A set of rows that carry in +x and in -x, each pressed by the offset of its faces [m] or all by one preload."""
    rows = [(row, "+x") for row in plus] + [(row, "-x") for row in minus]
    places = (qs.Row(row, 0.02 * i, carries, offset=offset) for i, (row, carries) in enumerate(rows))  # type: ignore[arg-type]
    return qs.solve_set(qs.BearingSet(tuple(places), operation, preload))


def unloading_load(plus: Sequence[qs.BallBearing], minus: Sequence[qs.BallBearing], preload: float) -> float:
    """The load in +x [N] under which the rows that carry in -x just lose contact; they are equal among themselves."""
    way = float(np.asarray(under_thrust(minus[0], preload / len(minus)).displacement)[0])
    operation = qs.Operation(axial_displacement=way, **UPRIGHT)
    return float(matched_set(plus, minus, operation, qs.Preload(rigid=preload)).load[0])


def unloading_stiffness(plus: int, row: qs.BallBearing, preload: ArrayLike) -> NDArray:
    """Load at which one row against so many just loses contact, over its deflection from its preload [N/µm].

    Args:
        row: all rows; one ball count, its other numbers may span cases.
        preload: of the single row [N], which the others share.
    """
    way = np.asarray(under_thrust(row, preload).displacement)[..., 0]
    operation = qs.Operation(axial_displacement=way, **UPRIGHT)
    solution = matched_set([row] * plus, [row], operation, qs.Preload(rigid=preload))
    return np.asarray(1e-6 * solution.load[..., 0] / way)


def ground_set(plus: int, minus: int, row: qs.BallBearing, preload: float) -> tuple[float, float, float]:
    """(preload of the set [N], axial rigidity, radial one [N/µm]) of equal rows, ground for this preload of a pair."""
    offset = float(np.asarray(under_thrust(row, preload).displacement)[0])
    solution = matched_set([row] * plus, [row] * minus, qs.Operation(**UPRIGHT), offset=offset)
    carried = sum(float(each.load[0]) for each in solution.rows[:plus])
    stiffness = 1e-6 * np.asarray(solution.stiffness)
    return carried, float(stiffness[0, 0]), float(stiffness[1, 1])
