"""The contact pressure: piecewise bilinear basis functions (hat functions) on a rectangular grid of the tangent
plane."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from fem_check.independent.contact_problem import Array, GapFunction


@dataclass(frozen=True)
class PressureBasis:
    """Hat functions on grid lines over the quarter x, y >= 0; those farther out than an ellipse are left away.

    Lengths are in the unit of the mesh.
    """

    lines_x: Array
    lines_y: Array
    samples_per_cell: int = 3
    """Gauss points along each side of a cell."""

    @cached_property
    def kept(self) -> Array:
        """Flat indices of the functions within the ellipse that the grid encloses; its longer side counts."""
        x, y = np.meshgrid(self.lines_x / np.abs(self.lines_x).max(), self.lines_y / self.lines_y[-1], indexing="ij")
        return np.flatnonzero((x**2 + y**2).ravel() <= 1.0 + 1e-9)

    @cached_property
    def points(self) -> Array:
        """Nodes of the basis functions, shape (2, basis)."""
        x, y = np.meshgrid(self.lines_x, self.lines_y, indexing="ij")
        return np.stack([x.ravel(), y.ravel()])[:, self.kept]

    def values(self, x: Array, y: Array) -> sp.csr_matrix:
        """Every basis function at the given points, shape (point, basis)."""
        cells, parts = [], []
        for lines, where in ((self.lines_x, x), (self.lines_y, y)):
            cell = np.clip(np.searchsorted(lines, where, side="right") - 1, 0, len(lines) - 2)
            part = (where - lines[cell]) / (lines[cell + 1] - lines[cell])
            inside = (part >= -1e-9) & (part <= 1.0 + 1e-9)
            cells.append(cell)
            parts.append((np.where(inside, 1.0 - part, 0.0), np.where(inside, part, 0.0)))
        count = len(x)
        rows = np.arange(count)
        total = sp.csr_matrix((count, len(self.lines_x) * len(self.lines_y)))
        for i in (0, 1):
            for j in (0, 1):
                column = (cells[0] + i) * len(self.lines_y) + cells[1] + j
                total = total + sp.csr_matrix((parts[0][i] * parts[1][j], (rows, column)), shape=total.shape)
        return sp.csr_matrix(total[:, self.kept])

    @cached_property
    def samples(self) -> tuple[Array, Array]:
        """Gauss points of all cells (2, sample) and their areas (sample,)."""
        nodes, weights = np.polynomial.legendre.leggauss(self.samples_per_cell)
        along = []
        for lines in (self.lines_x, self.lines_y):
            width = np.diff(lines)[:, None]
            along.append(((lines[:-1, None] + 0.5 * width * (nodes + 1.0)).ravel(), (0.5 * width * weights).ravel()))
        x, y = np.meshgrid(along[0][0], along[1][0], indexing="ij")
        area = np.outer(along[0][1], along[1][1])
        return np.stack([x.ravel(), y.ravel()]), area.ravel()

    @cached_property
    def loads(self) -> sp.csr_matrix:
        """Force of each basis function of unit pressure at each sample, shape (sample, basis)."""
        (x, y), area = self.samples
        return sp.csr_matrix(sp.diags(area) @ self.values(x, y))

    @cached_property
    def forces(self) -> Array:
        """Total force of each basis function, shape (basis,)."""
        return np.asarray(self.loads.sum(axis=0)).ravel()

    def weighted(self, function: GapFunction) -> Array:
        """Integral of each basis function times a function of (x, y), shape (basis,)."""
        (x, y), _ = self.samples
        return np.asarray(self._weights @ function(x, y))

    @cached_property
    def _weights(self) -> sp.csr_matrix:
        return sp.csr_matrix(self.loads.T)
