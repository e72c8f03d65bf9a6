"""The sparse linear solver: rslab, a wheel of 13 MB, and scipy's SuperLU where rslab has none; the record says which.

Processor seconds to factorise a block of 20 412 unknowns and solve for 64 right-hand sides, in one run on one thread:
rslab 1.9, PARDISO 1.9 (with a gigabyte of MKL, which buys nothing), SuperLU 15. rslab has one author, so its version is
bounded above, and what it does is tested with SuperLU too.
"""

from __future__ import annotations

import hashlib
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
    lower = sp.csc_matrix(sp.tril(matrix))
    lower.sort_indices()
    factor = _analysis(rslab, lower).factor(lower.data)

    def solve(sides: Array) -> Array:
        return np.asarray(factor.solve(sides) if sides.ndim == 1 else factor.solve_many(np.ascontiguousarray(sides)))

    return Factor("rslab", solve)


_KEPT = 4
"""Analyses kept: a contact is solved on three meshes, over and over."""
_analyses: dict[bytes, Any] = {}


def _analysis(rslab: Any, lower: sp.csc_matrix) -> Any:
    """Order of elimination and pattern of the factor, a third of the work: they depend on the pattern alone, which
    meshes of one recipe share whatever they are stretched to."""
    pattern = hashlib.sha256(lower.indptr.tobytes() + lower.indices.tobytes()).digest()
    if pattern not in _analyses:
        while len(_analyses) >= _KEPT:
            del _analyses[next(iter(_analyses))]
        _analyses[pattern] = rslab.analyze(lower, path="ldlt")
    return _analyses[pattern]
