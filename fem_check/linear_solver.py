"""The sparse linear solver, chosen at run time from what is installed; the record says which.

Measured on two cores, one contact on one mesh of 12 474 and of 42 180 unknowns, all of it, s and peak MB: rslab 1.4,
570 and 4.8, 1250; PARDISO 1.2, 360 and 7.2, 930; scipy's SuperLU in the order of `dissection` 2.0, 380 and 13.6, 1030.
CHOLMOD (scikit-sparse 0.4) needs a compiler and Debian's libsuitesparse-dev; it is taken first where somebody went to
that trouble, and was not at hand for these measurements.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable, Iterator
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


def _scipy(matrix: sp.csc_matrix, order: Array | None = None) -> Factor:
    from scipy.sparse.linalg import splu

    # No pivoting: the matrix is symmetric positive definite, and a symmetric order halves the fill.
    options = {"SymmetricMode": True, "Equil": False}
    if order is None:
        factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
        return Factor("scipy SuperLU", lambda sides: np.asarray(factor.solve(np.ascontiguousarray(sides))))
    ordered = splu(matrix[order][:, order].tocsc(), permc_spec="NATURAL", diag_pivot_thresh=0.0, options=options)

    def solve(sides: Array) -> Array:
        found = np.empty_like(sides)
        found[order] = ordered.solve(np.ascontiguousarray(sides[order]))
        return found

    return Factor("scipy SuperLU", solve)


_SOLVERS: dict[str, tuple[str, Callable[[sp.csc_matrix], Factor]]] = {
    "cholmod": ("sksparse.cholmod", _cholmod),
    "rslab": ("rslab", _rslab),
    "pardiso": ("pypardiso", _pardiso),
    "scipy": ("scipy", _scipy),
}


def _usable() -> Iterator[str]:
    for name, (module, _) in _SOLVERS.items():
        try:
            loaded = importlib.import_module(module)
        except (ImportError, OSError):  # OSError: a wheel whose system library is missing
            continue
        if name != "cholmod" or hasattr(loaded, "cholesky"):  # scikit-sparse 0.4's interface, the one used here
            yield name


def known() -> list[str]:
    """All solvers that can be used where they are installed."""
    return list(_SOLVERS)


def available() -> list[str]:
    """The solvers that load here, best first."""
    return list(_usable())


def chosen() -> str:
    """The solver that will be used: the best installed, or the one named in FEM_CHECK_SOLVER."""
    named = os.environ.get(ENVIRONMENT)
    if named is None:
        return next(_usable())  # no further: loading PARDISO's library takes a second
    usable = available()
    if named not in usable:
        raise ValueError(f"{ENVIRONMENT} = {named}: not usable here; installed: {', '.join(usable)}")
    return named


def factorise(matrix: sp.csc_matrix, order: Array | None = None) -> Factor:
    """Factorise a symmetric positive definite matrix.

    Args:
        matrix: the matrix.
        order: a good elimination order; scipy's SuperLU, which finds a poor one, takes it, the others find their own.
    """
    name = chosen()
    return _scipy(sp.csc_matrix(matrix), order) if name == "scipy" else _SOLVERS[name][1](sp.csc_matrix(matrix))
