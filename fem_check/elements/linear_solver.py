"""The sparse linear solver: rslab, a wheel of 13 MB, and scipy's SuperLU where rslab has none; the record says which.

Processor seconds to factorise a block of 20 412 unknowns and solve for 64 right-hand sides, in one run on one thread:
rslab 1.9, PARDISO 1.9 (with a gigabyte of MKL, which buys nothing), SuperLU 15.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from fem_check.independent.contact_problem import Array


@dataclass(frozen=True)
class Factor:
    """A factorised matrix."""

    solver: str
    solve: Callable[[Array], Array]
    """Solves for right-hand sides of shape (dof,) or (dof, side)."""


def factorise(matrix: sp.csc_matrix) -> Factor:
    """Factorise a symmetric positive definite matrix."""
    try:
        rslab: Any = importlib.import_module("rslab")
    except (ImportError, OSError):  # OSError: a wheel whose system library is missing
        # No pivoting: the matrix is positive definite, and a symmetric order halves the fill.
        options = {"SymmetricMode": True, "Equil": False}
        lower = splu(sp.csc_matrix(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
        return Factor("scipy SuperLU", lambda sides: np.asarray(lower.solve(np.ascontiguousarray(sides))))
    factor = rslab.ldlt(sp.csc_matrix(matrix))

    def solve(sides: Array) -> Array:
        return np.asarray(factor.solve(sides) if sides.ndim == 1 else factor.solve_many(np.ascontiguousarray(sides)))

    return Factor("rslab", solve)
