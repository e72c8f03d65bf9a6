"""What of a force or a stiffness is rounding: the one scale of decisions, records, tables and files."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.bearing import BallBearing

NOISE = 1e-10
"""What the solver leaves of loads and stiffnesses that are exactly zero, as a part of the largest of their kind."""
LEAST_STRAIN = 2.0**-52
"""A force that strains a ball by one rounding of a double is none, whatever else acts."""


def least_force(bearing: BallBearing) -> NDArray:
    """What is less is no force on this bearing [N]: some 1e-8 N."""
    return np.asarray(LEAST_STRAIN * np.asarray(bearing.effective_modulus) * np.asarray(bearing.ball_diameter) ** 2)


def rounding_of(largest: Any, least: Any) -> NDArray:
    """Up to which size forces are rounding, beside the largest that acts and the least that is one."""
    return np.asarray(np.maximum(NOISE * np.nan_to_num(largest), least))


def rounding_of_load(load: Any, bearing: BallBearing) -> NDArray:
    """Up to which size forces are rounding, beside a bearing's load (*cases, 5)."""
    return rounding_of(np.abs(load[..., :3]).max(axis=-1), least_force(bearing))


def without_rounding(forces: Any, rounding: Any) -> NDArray:
    """Forces, those that are rounding as zero."""
    return np.asarray(np.where(np.abs(forces) <= rounding, 0.0, forces))


def matrix_without_rounding(matrix: NDArray) -> NDArray:
    """A stiffness matrix; what is rounding beside its diagonal is zero."""
    diagonal = np.sqrt(np.abs(np.nan_to_num(np.diag(matrix))))
    return np.asarray(np.where(np.abs(matrix) <= NOISE * np.outer(diagonal, diagonal), 0.0, matrix))
