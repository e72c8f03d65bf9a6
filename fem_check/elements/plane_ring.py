"""A whole ring in plane stress, alone or inside another that it slides on, by finite elements: half of it, by symmetry.

Quadrilaterals of second order on a polar grid, their edges on the rims curved. Unknowns are radial and tangential
displacements: at a smooth seat both bodies share the radial one alone, and in the plane of symmetry there is no
tangential one. What is left free, a displacement along that plane, one node holds; all loads balance.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp

from fem_check.elements.linear_solver import Factor, factorise
from fem_check.independent.contact_problem import Array, ElasticConstants

NEAR = 1e-9
"""Of nodes on a rim or in a plane, over the outside radius."""


@dataclass(frozen=True)
class RingGrid:
    """An annulus of unit width and its grid: elements round half of it, and through it."""

    bore_radius: float
    outside_radius: float
    material: ElasticConstants
    around: int
    through: int

    @cached_property
    def _mesh(self) -> Any:
        from skfem import MeshQuad, MeshQuad2

        radii = np.linspace(self.bore_radius, self.outside_radius, self.through + 1)
        flat = MeshQuad2.from_mesh(MeshQuad.init_tensor(radii, np.linspace(0.0, np.pi, self.around + 1)))
        r, angle = flat.doflocs
        return replace(flat, doflocs=np.array([r * np.cos(angle), r * np.sin(angle)]))

    @cached_property
    def nodes(self) -> tuple[Array, Array]:
        """Radius and angle of each."""
        from skfem import CellBasis, ElementQuad2

        x, y = CellBasis(self._mesh, ElementQuad2()).doflocs
        return np.hypot(x, y), np.arctan2(np.maximum(y, 0.0), x)

    @cached_property
    def to_cartesian(self) -> sp.csr_matrix:
        """Displacements (x of all nodes, then y) by (radial of all nodes, then tangential)."""
        c, s = (sp.diags(each(self.nodes[1])) for each in (np.cos, np.sin))
        return sp.bmat([[c, -s], [s, c]], format="csr")

    @cached_property
    def stiffness(self) -> sp.csr_matrix:
        """In radial and tangential displacements."""
        from skfem import BilinearForm, CellBasis, ElementQuad2

        basis = CellBasis(self._mesh, ElementQuad2())
        e, nu = self.material.elastic_modulus, self.material.poisson_ratio
        direct, shear = e / (1.0 - nu**2), e / (2.0 * (1.0 + nu))
        xx, yy, xy = (
            BilinearForm(lambda u, v, w, i=i, j=j: u.grad[i] * v.grad[j]).assemble(basis)
            for i, j in ((0, 0), (1, 1), (1, 0))
        )
        across = nu * direct * xy + shear * xy.T
        matrix = sp.bmat([[direct * xx + shear * yy, across], [across.T, direct * yy + shear * xx]])
        return sp.csr_matrix(self.to_cartesian.T @ matrix @ self.to_cartesian)

    def rim(self, radius: float) -> Array:
        """Its nodes, in the order of their angles."""
        r, angle = self.nodes
        on = np.flatnonzero(np.abs(r - radius) < NEAR * self.outside_radius)
        return on[np.argsort(angle[on])]

    def pressed(self, radius: float, pressure: Callable[[Array], Array]) -> Array:
        """Nodal loads of a pressure on a rim, a function of the angle."""
        angles, loads = self._at_bore if radius == self.bore_radius else self._at_outside
        return np.asarray(loads @ pressure(angles))

    @cached_property
    def _at_bore(self) -> tuple[Array, sp.csr_matrix]:
        return self._rim_loads(self.bore_radius)

    @cached_property
    def _at_outside(self) -> tuple[Array, sp.csr_matrix]:
        return self._rim_loads(self.outside_radius)

    def _rim_loads(self, radius: float) -> tuple[Array, sp.csr_matrix]:
        """Angles of a rim's quadrature points, and the nodal loads of unit pressures there, (dof, point)."""
        from skfem import ElementQuad2, FacetBasis

        def on_rim(x: Array) -> Array:
            return np.abs(np.hypot(*x) - radius) < 0.2 * (self.outside_radius - self.bore_radius) / self.through

        facets = self._mesh.facets_satisfying(on_rim, boundaries_only=True)
        basis = FacetBasis(self._mesh, ElementQuad2(), facets=facets)
        x, y = np.asarray(basis.global_coordinates()).reshape(2, -1)
        points = np.arange(x.size).reshape(basis.dx.shape)
        loads = sp.csr_matrix((2 * basis.N, x.size))
        for nodes, shape in zip(basis.element_dofs, basis.basis, strict=True):
            for i in (0, 1):
                each = -np.asarray(shape[0]) * basis.normals[i] * basis.dx
                rows = np.broadcast_to(i * basis.N + nodes[:, None], points.shape)
                loads += sp.csr_matrix((each.ravel(), (rows.ravel(), points.ravel())), shape=loads.shape)
        return np.arctan2(y, x), sp.csr_matrix(self.to_cartesian.T @ loads)


@dataclass(frozen=True)
class Ring:
    """A ring, and what it is in or on, if anything."""

    ring: RingGrid
    seat: RingGrid | None = None

    @cached_property
    def dofs(self) -> int:
        """Unknowns, before those that are held are taken out."""
        return sum(2 * len(body.nodes[0]) for body in (self.ring, self.seat) if body is not None)

    @cached_property
    def _held(self) -> tuple[sp.csr_matrix, Factor]:
        """(all displacements by the free ones, the factorised matrix)."""
        bodies = [body for body in (self.ring, self.seat) if body is not None]
        starts = np.cumsum([0, *(2 * len(body.nodes[0]) for body in bodies)])
        same, kept = np.arange(starts[-1]), np.ones(starts[-1], bool)
        for body, start in zip(bodies, starts, strict=False):
            angle, many = body.nodes[1], len(body.nodes[0])
            kept[start + many + np.flatnonzero(np.minimum(angle, np.pi - angle) < NEAR)] = False
        middle = self.ring.rim(self.ring.bore_radius)
        kept[len(self.ring.nodes[0]) + middle[len(middle) // 2]] = False
        if self.seat is not None:
            inward = self.seat.bore_radius == self.ring.outside_radius
            radius = self.ring.outside_radius if inward else self.ring.bore_radius
            own, other = self.ring.rim(radius), starts[1] + self.seat.rim(radius)
            same[other], kept[other] = own, False
        free = np.flatnonzero(kept)
        place = np.full(starts[-1], -1)
        place[free] = np.arange(len(free))
        column = place[same]
        rows = np.flatnonzero(column >= 0)
        by_free = sp.csr_matrix((np.ones(len(rows)), (rows, column[rows])), shape=(starts[-1], len(free)))
        matrix = sp.block_diag([body.stiffness for body in bodies])
        return by_free, factorise(sp.csc_matrix(by_free.T @ matrix @ by_free))

    @property
    def solver(self) -> str:
        """Its name."""
        return str(self._held[1].solver)

    def moved(self, radius: float, loads: Array) -> Array:
        """Radial displacement round a rim of the ring, at equal angles from 0 to pi, by nodal loads on the ring."""
        by_free, factor = self._held
        displacement = by_free @ factor.solve(by_free[: len(loads)].T @ loads)
        return np.asarray(displacement[self.ring.rim(radius)])


def harmonics(values: Array) -> Array:
    """Coefficients of cos(n t), n = 0, 1, ..., of an even function given at equal angles from 0 to pi."""
    from scipy.fft import dct

    coefficients = dct(values, type=1) / (len(values) - 1)
    coefficients[[0, -1]] *= 0.5
    return np.asarray(coefficients)
