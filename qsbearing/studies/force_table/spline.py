"""Between the points of a rectilinear grid: linear in each coordinate, or by cubic splines."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray


class Interpolation(StrEnum):
    """How a table is read between its points."""

    LINEAR = "linear"
    """Along each axis in turn: scipy's RegularGridInterpolator, MATLAB's griddedInterpolant of the same name."""
    CUBIC = "cubic"
    """Cubic splines without a knot at the last but one points: method "cubic" there, "spline" in MATLAB."""

    @property
    def degree(self) -> int:
        return 1 if self is Interpolation.LINEAR else 3


def interpolated(axes: Sequence[NDArray], values: NDArray, at: NDArray, degree: int) -> NDArray:
    """Values at these places; shape (place, value).

    Args:
        axes: the places of the grid along each.
        values: on the grid; shape (*grid, value). NaN makes what is linear between it and others NaN, and all of what
            is cubic.
        at: shape (place, axis).
    """
    from scipy.interpolate import NdBSpline, make_interp_spline

    knots, coefficients = [], values
    for number, axis in enumerate(axes):
        if degree == 1:
            knots.append(np.r_[axis[0], axis, axis[-1]])
            continue
        along = make_interp_spline(axis, np.moveaxis(coefficients, number, 0), k=degree)
        knots.append(along.t)
        coefficients = np.moveaxis(along.c, 0, number)
    return np.asarray(NdBSpline(tuple(knots), coefficients, degree)(at))
