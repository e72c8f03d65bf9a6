"""The sparse linear solver, chosen at run time from what is installed; the record says which.

Measured on two cores on the stiffness of a contact block with 44 100 degrees of freedom (factor / 128 right-hand
sides, s): rslab 4.7 / 1.4, PARDISO 4.6 / 4.8. At 13 608: rslab 0.7 / 0.6, PARDISO 0.9 / 1.2, scipy's SuperLU
2.1 / 0.9. CHOLMOD (scikit-sparse) needs a compiler and Debian's libsuitesparse-dev; it is taken first where somebody
went to that trouble.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sp

from fem_check.contact_problem import Array

ENVIRONMENT = "FEM_CHECK_SOLVER"


@dataclass(frozen=True)
class Factor:
    """A factorised matrix."""

    solver: str
    solve: Callable[[Array], Array]
    """Solves for right-hand sides of shape (dof,) or (dof, side)."""
    release: Callable[[], None] = lambda: None
    """Gives the memory back; the factor is dead afterwards."""


def _cholmod(matrix: sp.csc_matrix) -> Factor:
    cholmod = importlib.import_module("sksparse.cholmod")
    factor = cholmod.cholesky(matrix)
    return Factor("CHOLMOD", lambda sides: np.asarray(factor(sides)))


def _rslab(matrix: sp.csc_matrix) -> Factor:
    rslab: Any = importlib.import_module("rslab")
    factor = rslab.ldlt(matrix)

    def solve(sides: Array) -> Array:
        return np.asarray(factor.solve(sides) if sides.ndim == 1 else factor.solve_many(np.ascontiguousarray(sides)))

    return Factor("rslab", solve)


def _pardiso(matrix: sp.csc_matrix) -> Factor:
    pypardiso: Any = importlib.import_module("pypardiso")
    upper = sp.csr_matrix(sp.triu(matrix, format="csr"))
    upper.sort_indices()
    solver = pypardiso.PyPardisoSolver(mtype=2)  # symmetric positive definite, upper triangle
    solver.factorize(upper)
    return Factor(
        "PARDISO",
        lambda sides: np.asarray(solver.solve(upper, np.asfortranarray(sides))),
        lambda: solver.free_memory(everything=True),
    )


def _scipy(matrix: sp.csc_matrix) -> Factor:
    from scipy.sparse.linalg import splu

    # No pivoting: the matrix is symmetric positive definite, and its symmetric ordering halves the fill.
    factor = splu(
        matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True, "Equil": False}
    )
    return Factor("scipy SuperLU", lambda sides: np.asarray(factor.solve(np.ascontiguousarray(sides))))


_SOLVERS: dict[str, tuple[str, Callable[[sp.csc_matrix], Factor]]] = {
    "cholmod": ("sksparse.cholmod", _cholmod),
    "rslab": ("rslab", _rslab),
    "pardiso": ("pypardiso", _pardiso),
    "scipy": ("scipy", _scipy),
}


def available() -> list[str]:
    """The solvers that load here, best first."""
    found = []
    for name, (module, _) in _SOLVERS.items():
        try:
            importlib.import_module(module)
        except (ImportError, OSError):  # OSError: a wheel whose system library is missing
            continue
        found.append(name)
    return found


def chosen() -> str:
    """The solver that will be used: the best installed, or the one named in FEM_CHECK_SOLVER."""
    named = os.environ.get(ENVIRONMENT)
    usable = available()
    if named is None:
        return usable[0]
    if named not in usable:
        raise ValueError(f"{ENVIRONMENT} = {named}: not usable here; installed: {', '.join(usable)}")
    return named


def factorise(matrix: sp.csc_matrix) -> Factor:
    """Factorise a symmetric positive definite matrix."""
    return _SOLVERS[chosen()][1](sp.csc_matrix(matrix))
