"""A body of curved 10-node tetrahedra: its stiffness, loads on its surface, rigid motions, and how it is held."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from fem_check.elements import elastic_body
from fem_check.elements.element_family import ElementFamily
from fem_check.independent.contact_problem import Array, ElasticConstants
from fem_check.solids.body_mesh import BodyMesh

if TYPE_CHECKING:
    from skfem import MeshTet2

# Curved elements have rational integrands; order 3 moves results by less than 1e-6 against 4.
CURVED_TETRAHEDRA = ElementFamily("tet10_curved", "10-node tetrahedra, curved", "ElementTetP2", 3, is_tetrahedral=True)
SURFACE_ORDER = 9
"""Quadrature on the contact's facets: they do not match the cells of the pressure basis, whose kinks fall inside."""


@dataclass(frozen=True)
class Facets:
    """Quadrature points on boundary facets."""

    points: Array
    """(3, point) [m]"""
    directed_areas: Array
    """Outward normal times weight, (3, point) [m2]."""
    shapes: sp.csr_matrix
    """Value of each node's shape function at each point, shape (node, point)."""


class TetrahedralBody:
    """A mesh with its material; displacement unknowns are numbered node by node, x, y, z."""

    def __init__(self, mesh: BodyMesh, material: ElasticConstants) -> None:
        self.material = material
        self.mesh = _scikit_fem_mesh(mesh)
        self.space = elastic_body.DisplacementSpace(self.mesh, CURVED_TETRAHEDRA)

    @property
    def nodes(self) -> Array:
        """Positions (3, node) [m]."""
        return self.space.nodes

    @property
    def stiffness(self) -> sp.csr_matrix:
        """[N/m], shape (dof, dof)."""
        return self.material.elastic_modulus * elastic_body.stiffness(self.space, self.material.poisson_ratio)

    @property
    def volume(self) -> float:
        """Of the curved elements [m3]."""
        from skfem import CellBasis, ElementTetP0

        return float(CellBasis(self.mesh, ElementTetP0(), intorder=CURVED_TETRAHEDRA.volume_order).dx.sum())

    @cached_property
    def mass(self) -> sp.csr_matrix:
        """Mass matrix of unit density [m3], shape (dof, dof)."""
        from skfem import CellBasis
        from skfem.models.poisson import mass

        scalar = mass.assemble(CellBasis(self.mesh, CURVED_TETRAHEDRA.element(), intorder=4))
        return sp.csr_matrix(sp.kron(scalar, sp.identity(3)))

    def on(self, where: Callable[[Array], Array]) -> Array:
        """Nodes at whose positions (3, node) a condition holds."""
        return np.flatnonzero(where(self.nodes))

    def facets(self, where: Callable[[Array], Array]) -> Facets:
        """Boundary facets, all three vertices of which meet a condition."""
        from skfem.quadrature import get_quadrature
        from skfem.refdom import RefTri

        mesh = self.mesh
        boundary = mesh.boundary_facets()
        chosen = boundary[where(self.nodes)[mesh.facets[:, boundary]].all(axis=0)]
        corners = mesh.facets[:, chosen]
        nodes = np.concatenate(
            [corners, *(_edge_nodes(mesh, corners[i], corners[j])[None] for i, j in ((0, 1), (1, 2), (0, 2)))]
        )
        reference, weights = get_quadrature(RefTri, SURFACE_ORDER)
        values, slopes = _triangle_shapes(reference)
        x = self.nodes[:, nodes]  # (3, shape, facet)
        tangents = np.einsum("csf,dsq->dcfq", x, slopes)
        normals = np.cross(tangents[0], tangents[1], axis=0)
        # The corners are sorted by number, so their sense is either; the body lies on the side of its fourth vertex.
        inside = self.nodes[:, mesh.t[:, mesh.f2t[0, chosen]]].mean(axis=1)
        outward = np.sign(np.einsum("cfq,cf->f", normals, x[:, :3].mean(axis=1) - inside))
        count = len(weights)
        columns = np.arange(len(chosen) * count).reshape(len(chosen), count)
        shapes = sp.csr_matrix(
            (
                np.broadcast_to(values[:, None, :], (6, len(chosen), count)).ravel(),
                (
                    np.broadcast_to(nodes[:, :, None], (6, len(chosen), count)).ravel(),
                    np.broadcast_to(columns[None], (6, len(chosen), count)).ravel(),
                ),
            ),
            shape=(self.space.count, columns.size),
        )
        points = np.einsum("csf,sq->cfq", x, values).reshape(3, -1)
        return Facets(points, (normals * outward[:, None] * weights).reshape(3, -1), shapes)

    def surface_loads(self, facets: Facets, forces: list[sp.csr_matrix]) -> sp.csr_matrix:
        """Nodal forces, shape (dof, load), of forces at the facets' points: for x, y and z each (point, load)."""
        total = sp.csr_matrix((3 * self.space.count, forces[0].shape[1]))
        for axis, force in enumerate(forces):
            part = sp.coo_matrix(facets.shapes @ force)
            total = total + sp.csr_matrix((part.data, (3 * part.row + axis, part.col)), shape=total.shape)
        return sp.csr_matrix(total)


def _scikit_fem_mesh(mesh: BodyMesh) -> MeshTet2:
    """The mesh in scikit-fem's numbering: vertices, then one node on each of its own edges.

    Its reader for 10-node tetrahedra sorts the vertices but not the mid-nodes with them, which folds the elements.
    """
    from skfem import MeshTet, MeshTet2

    straight = MeshTet2.from_mesh(MeshTet(np.ascontiguousarray(mesh.points), np.ascontiguousarray(mesh.tetrahedra)))
    positions = straight.doflocs.copy()
    positions[:, _edge_nodes(straight, *mesh.curved_edges)] = mesh.curved_nodes
    return replace(straight, doflocs=positions)


def _edge_nodes(mesh: MeshTet2, first: Array, second: Array) -> Array:
    """Numbers of the nodes in the middle of the edges between the given vertices."""
    count = mesh.nvertices
    keys = mesh.edges.min(axis=0).astype(np.int64) * count + mesh.edges.max(axis=0)
    order = np.argsort(keys)
    pairs = np.minimum(first, second).astype(np.int64) * count + np.maximum(first, second)
    return count + order[np.searchsorted(keys, pairs, sorter=order)]


def _triangle_shapes(points: Array) -> tuple[Array, Array]:
    """Quadratic shape functions (6, point) and slopes (2, 6, point): corners, then edges 01, 12, 02."""
    barycentric = np.stack([1.0 - points[0] - points[1], points[0], points[1]])
    slope = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])
    edges = ((0, 1), (1, 2), (0, 2))
    values = [v * (2.0 * v - 1.0) for v in barycentric]
    values += [4.0 * barycentric[i] * barycentric[j] for i, j in edges]
    slopes = []
    for s in slope:
        of_corners = [s[i] * (4.0 * barycentric[i] - 1.0) for i in range(3)]
        of_edges = [4.0 * (s[i] * barycentric[j] + s[j] * barycentric[i]) for i, j in edges]
        slopes.append(np.stack(of_corners + of_edges))
    return np.stack(values), np.stack(slopes)
