"""One elastic body, condensed onto its contact: its flexibility under each pressure basis function.

20-node serendipity hexahedra with 2x2x2 Gauss points, unless another family is asked for. scikit-fem gives mesh,
degrees of freedom and shape functions; the element matrices are one batched product over each chunk of elements, not
scikit-fem's loop over the 60 x 60 pairs of shape functions (0.25 s, not 1.3 s, at 16 100 degrees of freedom).

Lengths are in the unit of the mesh and Young's modulus is 1: `contact` scales to the real body.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from fem_check.elements import boussinesq
from fem_check.elements.element_family import SERENDIPITY, ElementFamily
from fem_check.elements.linear_solver import factorise
from fem_check.elements.pressure_basis import PressureBasis
from fem_check.independent.contact_problem import Array

if TYPE_CHECKING:
    from skfem import MeshHex, MeshTet

SURFACE_ORDER = 5
CHUNK = 1000
"""Elements assembled at a time: 60 x 60 numbers each, about 30 MB."""
RIGHT_HAND_SIDES = 64
"""Right-hand sides solved at a time."""
AXIS_REACH = 0.35
"""Stresses near the axis are kept within this part of the contact patch,"""
STRESS_DEPTH = 1.5
"""and down to this many widths of it."""

Progress = Callable[[str, float], None]
"""Progress callback: the stage, and the fraction of it that is done."""


def silent(stage: str, part: float) -> None:
    """No progress shown."""


class Support(StrEnum):
    """Boundary condition on the faces away from the contact."""

    HALF_SPACE = "half_space"
    """Its far faces move as those of a half-space under the contact's own pressure (Boussinesq)."""
    CLAMPED = "clamped"
    """Its far faces are fixed: a finite box."""


class DisplacementSpace:
    """Nodal displacements on a mesh: the nodes' numbering and positions."""

    def __init__(self, mesh: MeshHex | MeshTet, family: ElementFamily = SERENDIPITY) -> None:
        from skfem import CellBasis

        self.mesh = mesh
        self.family = family
        # One quadrature point: this basis serves for numbering only.
        cell_basis = CellBasis(mesh, family.element(), intorder=0)
        self.nodes: Array = cell_basis.doflocs
        self.element_nodes = cell_basis.element_dofs
        self.count = int(cell_basis.N)

    def gradients(self, elements: Array) -> tuple[Array, Array, Array]:
        """Gradients (element, shape, 3, point), volumes (element, point), positions (3, element, point)."""
        from skfem import CellBasis

        cell_basis = CellBasis(self.mesh, self.family.element(), intorder=self.family.volume_order, elements=elements)
        gradients = np.stack([np.asarray(cell_basis.basis[i][0].grad) for i in range(cell_basis.Nbfun)])
        return (
            np.ascontiguousarray(gradients.transpose(2, 0, 1, 3)),
            cell_basis.dx,
            np.asarray(cell_basis.global_coordinates()),
        )


def lame(poisson_ratio: float) -> tuple[float, float]:
    """Lame's constants for E = 1."""
    return poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)), 0.5 / (1.0 + poisson_ratio)


def element_matrices(gradients: Array, volumes: Array, poisson_ratio: float) -> Array:
    """Stiffness of each element, shape (element, 3 shapes, 3 shapes), node by node x, y, z."""
    first, second = lame(poisson_ratio)
    count, shapes, _, points = gradients.shape
    stacked = gradients.reshape(count, 3 * shapes, points)
    # product[e, i, c, j, d] = integral of dNi/dc dNj/dd
    product = np.matmul(stacked * volumes[:, None, :], stacked.transpose(0, 2, 1)).reshape(count, shapes, 3, shapes, 3)
    laplace = product[:, :, 0, :, 0] + product[:, :, 1, :, 1] + product[:, :, 2, :, 2]
    matrix = first * product + second * product.transpose(0, 1, 4, 3, 2)
    for axis in range(3):
        matrix[:, :, axis, :, axis] += second * laplace
    return matrix.reshape(count, 3 * shapes, 3 * shapes)


def stiffness(space: DisplacementSpace, poisson_ratio: float, progress: Progress = silent) -> sp.csr_matrix:
    """The body's stiffness matrix, assembled chunk by chunk.

    Entries that vanish are kept: all meshes of one recipe have one pattern, which `linear_solver` then analyses once.
    """
    width, count = len(space.element_nodes), space.count
    nodes = space.element_nodes.T.astype(np.int64)
    pairs, place = np.unique(nodes[:, :, None] * count + nodes[:, None, :], return_inverse=True)
    place = place.reshape(-1, width * width)
    blocks = np.zeros((3, 3, len(pairs)))
    for start in range(0, space.mesh.nelements, CHUNK):
        elements = np.arange(start, min(start + CHUNK, space.mesh.nelements))
        gradients, volumes, _ = space.gradients(elements)
        matrices = element_matrices(gradients, volumes, poisson_ratio)
        at = place[elements].ravel()
        for i, j in np.ndindex(3, 3):
            blocks[i, j] += np.bincount(at, matrices[:, i::3, j::3].ravel(), len(pairs))
        progress("assembling", (start + len(elements)) / space.mesh.nelements)
    starts = np.searchsorted(pairs, np.arange(count + 1) * count)
    return sp.bsr_matrix((blocks.transpose(2, 0, 1), pairs % count, starts), shape=(3 * count, 3 * count)).tocsr()


@dataclass(frozen=True)
class CondensedBody:
    """A body's response to each pressure basis function; its mesh and factor are no longer needed."""

    poisson_ratio: float
    flexibility: Array
    """Integral of basis function i times the normal displacement under basis function j, shape (basis, basis);
    symmetrised."""
    asymmetry: float
    """Largest difference of the flexibility and its transpose over its largest entry."""
    reaction: Array
    """Reaction force along z on the supported faces, for each basis function, shape (basis,)."""
    stress_points: Array
    """Gauss points near the axis and near the plane x = 0, shape (3, point)."""
    stresses: Array
    """There, for each basis function: sigma_x, sigma_y, sigma_z, tau_yz; shape (4, point, basis)."""
    dofs: int
    """Unknowns solved for."""
    solver: str


class HeldBlock:
    """A block under a pressure on its contact, with its planes of symmetry, and its far faces held as a support says.

    Young's modulus is 1. Pressures are even about x = 0, or odd, for contacts that are neither: halves of both add up.
    """

    def __init__(
        self,
        brick: MeshHex,
        basis: PressureBasis,
        poisson_ratio: float,
        support: Support,
        progress: Progress = silent,
        family: ElementFamily = SERENDIPITY,
        *,
        is_odd: bool = False,
    ) -> None:
        space = self.space = DisplacementSpace(family.body(brick), family)
        matrix = stiffness(space, poisson_ratio, progress)

        high = space.nodes.max(axis=1)
        small = 1e-9 * high
        fixed = np.zeros((space.count, 3), dtype=bool)
        fixed[space.nodes[0] < small[0]] = [is_odd != (axis == 0) for axis in range(3)]
        fixed[space.nodes[1] < small[1], 1] = True
        prescribed = np.any(space.nodes > (high - small)[:, None], axis=0)
        fixed[prescribed] = True
        self.free = np.flatnonzero(~fixed.ravel())
        self._prescribed = (3 * np.flatnonzero(prescribed)[:, None] + np.arange(3)).ravel()

        progress("far field", 0.0)
        count = len(basis.forces)
        if support is Support.HALF_SPACE:
            (x, y), _ = basis.samples
            far = boussinesq.pressure_displacement(
                space.nodes[:, prescribed], np.stack([x, y]), basis.loads, poisson_ratio, is_odd=is_odd
            )
            self._prescribed_displacement = far.transpose(1, 0, 2).reshape(-1, count)
        else:
            self._prescribed_displacement = np.zeros((len(self._prescribed), count))

        self.loads = _contact_loads(space, basis)
        self._free_loads = sp.csr_matrix(self.loads[self.free])
        rows = matrix[self.free]
        self._coupling = sp.csr_matrix(rows[:, self._prescribed])
        supported = 3 * np.flatnonzero(prescribed) + 2
        summing = sp.csr_matrix(
            (np.ones(supported.size), (np.zeros(supported.size, dtype=int), supported)), shape=(1, matrix.shape[0])
        )
        self._reaction_row = sp.csr_matrix(summing @ matrix)
        progress("factorising", 0.0)
        square = sp.csc_matrix(rows[:, self.free])
        del matrix, rows
        self._factor = factorise(square)
        self.solver = self._factor.solver

    def moved(self, pressures: Array) -> Array:
        """Displacements, shape (dof, case), under pressures by their coefficients, shape (basis, case)."""
        moved = np.zeros((3 * self.space.count, pressures.shape[1]))
        moved[self._prescribed] = self._prescribed_displacement @ pressures
        moved[self.free] = self._factor.solve(self._free_loads @ pressures - self._coupling @ moved[self._prescribed])
        return moved

    def reaction(self, moved: Array) -> Array:
        """Force along z on the supported faces, of each case."""
        return np.asarray(self._reaction_row @ moved).ravel()


def condense(
    brick: MeshHex,
    basis: PressureBasis,
    poisson_ratio: float,
    support: Support,
    progress: Progress = silent,
    family: ElementFamily = SERENDIPITY,
) -> CondensedBody:
    """Condense the body onto its contact.

    Args:
        brick: the mesh as its recipe gives it (stretched), with its tags.
        basis: the pressure, on the tangent plane.
        poisson_ratio: of the body.
        support: boundary condition on the other faces.
        progress: progress callback.
        family: the elements that the brick is filled with.
    """
    block = HeldBlock(brick, basis, poisson_ratio, support, progress, family)
    count = len(basis.forces)
    flexibility = np.zeros((count, count))
    reaction = np.zeros(count)
    inside = _StressPoints.near_centre(block.space, basis, poisson_ratio)
    stresses = np.zeros((4, inside.points.shape[1], count))
    each = np.identity(count)
    for start in range(0, count, RIGHT_HAND_SIDES):
        some = slice(start, min(start + RIGHT_HAND_SIDES, count))
        moved = block.moved(each[:, some])
        flexibility[:, some] = block.loads.T @ moved
        reaction[some] = block.reaction(moved)
        stresses[:, :, some] = inside.stresses(moved)
        progress("solving", some.stop / count)
    return CondensedBody(
        poisson_ratio=poisson_ratio,
        flexibility=0.5 * (flexibility + flexibility.T),
        asymmetry=float(np.abs(flexibility - flexibility.T).max() / np.abs(flexibility).max()),
        reaction=reaction,
        stress_points=inside.points,
        stresses=stresses,
        dofs=len(block.free),
        solver=block.solver,
    )


@dataclass(frozen=True)
class _StressPoints:
    """Gauss points at which stresses are evaluated."""

    nodes: Array
    """Nodes of the elements evaluated, shape (shape function, element)."""
    gradients: Array
    points: Array
    poisson_ratio: float

    @classmethod
    def near_centre(cls, space: DisplacementSpace, basis: PressureBasis, poisson_ratio: float) -> _StressPoints:
        centres = space.mesh.p[:, space.mesh.t].mean(axis=1)
        # The first two columns of elements beside each symmetry plane at least: the fit on the axis needs four points
        # in each direction, and the map of the plane x = 0 its nearest ones.
        wide = max(AXIS_REACH * basis.lines_x[-1], 1.01 * basis.lines_x[2])
        deep = float(basis.lines_y[-1]) * STRESS_DEPTH
        near_axis = (centres[0] < wide) & (centres[1] < max(AXIS_REACH * basis.lines_y[-1], 1.01 * basis.lines_y[2]))
        near_plane = (centres[0] < basis.lines_x[1]) & (centres[1] < basis.lines_y[-1])
        chosen = np.flatnonzero((near_axis | near_plane) & (centres[2] < deep))
        gradients, _, positions = space.gradients(chosen)
        return cls(space.element_nodes[:, chosen], gradients, positions.reshape(3, -1), poisson_ratio)

    def stresses(self, displacement: Array) -> Array:
        """sigma_x, sigma_y, sigma_z, tau_yz at the points for E = 1, shape (4, point, case)."""
        nodal = displacement.reshape(-1, 3, displacement.shape[1])[self.nodes]
        strain = np.einsum("eicp,iecm->cepm", self.gradients, nodal, optimize=True)
        sheared = np.einsum("eip,iem->epm", self.gradients[:, :, 2], nodal[:, :, 1], optimize=True)
        sheared += np.einsum("eip,iem->epm", self.gradients[:, :, 1], nodal[:, :, 2], optimize=True)
        first, second = lame(self.poisson_ratio)
        normal = first * strain.sum(axis=0) + 2.0 * second * strain
        return np.concatenate([normal, second * sheared[None]]).reshape(4, -1, displacement.shape[1])


def _contact_loads(space: DisplacementSpace, basis: PressureBasis) -> sp.csr_matrix:
    """Nodal forces of each basis function of unit pressure, along z into the body; shape (dof, basis)."""
    from skfem import FacetBasis

    facets = space.mesh.boundaries["contact"]
    facet_basis = FacetBasis(space.mesh, space.family.element(), facets=facets, intorder=SURFACE_ORDER)
    positions = np.asarray(facet_basis.global_coordinates())
    x, y = positions[0].ravel(), positions[1].ravel()
    points = facet_basis.dx.shape[1]
    column = np.arange(x.size)
    rows, columns, values = [], [], []
    for i in range(facet_basis.Nbfun):
        value = (np.asarray(facet_basis.basis[i][0]) * facet_basis.dx).ravel()
        rows.append(np.repeat(facet_basis.element_dofs[i], points))
        columns.append(column)
        values.append(value)
    row, col, val = np.concatenate(rows), np.concatenate(columns), np.concatenate(values)
    relevant = np.abs(val) > 0.0
    shapes = sp.csr_matrix((val[relevant], (row[relevant], col[relevant])), shape=(space.count, x.size))
    part = sp.coo_matrix(shapes @ basis.values(x, y))
    return sp.csr_matrix((part.data, (3 * part.row + 2, part.col)), shape=(3 * space.count, part.shape[1]))


def pressure_basis_of(brick: MeshHex, samples_per_cell: int = 3) -> PressureBasis:
    """The pressure basis on the vertices of a brick's contact face."""
    corners = np.unique(brick.facets[:, brick.boundaries["contact"]])
    lines = []
    for axis in (0, 1):
        values = np.sort(brick.p[axis, corners])
        lines.append(values[np.concatenate([[True], np.diff(values) > 1e-7 * values[-1]])])
    return PressureBasis(lines[0], lines[1], samples_per_cell)
