"""One elastic body, condensed onto its contact: how it gives way under each hat of pressure.

20-node serendipity hexahedra with 2x2x2 Gauss points, unless another family is asked for. scikit-fem gives mesh,
degrees of freedom and shape functions; the element matrices are one batched product over each chunk of elements, not
scikit-fem's loop over the 60 x 60 pairs of shape functions (0.25 s, not 1.3 s, at 16 100 degrees of freedom).

Lengths are in the unit of the mesh and Young's modulus is 1: `contact` scales to the real body.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import scipy.sparse as sp
from skfem import CellBasis, FacetBasis, MeshHex, MeshTet

from fem_check import boussinesq, dissection
from fem_check.contact_problem import Array
from fem_check.element_family import SERENDIPITY, ElementFamily
from fem_check.linear_solver import factorise
from fem_check.pressure_hats import PressureHats

SURFACE_ORDER = 5
CHUNK = 1000
"""Elements assembled at a time: 60 x 60 numbers each, about 30 MB."""
SIDES = 64
"""Right-hand sides solved at a time."""
AXIS_REACH = 0.35
"""Stresses near the axis are kept within this part of the contact patch,"""
STRESS_DEPTH = 1.5
"""and down to this many widths of it."""

Progress = Callable[[str, float], None]
"""Told the stage and the part of it that is done."""


def silent(stage: str, part: float) -> None:
    """No progress shown."""


class Support(StrEnum):
    """What holds the body."""

    HALF_SPACE = "half_space"
    """Its far faces move as those of a half-space under the contact's own pressure (Boussinesq)."""
    CLAMPED = "clamped"
    """Its far faces are held still: a finite box."""
    EQUATOR = "equator"
    """Its deepest face slides on a plane, the sides are free: half a ball between two opposite contacts."""


class Field:
    """Displacement field on a mesh: numbering and positions of its nodes."""

    def __init__(self, mesh: MeshHex | MeshTet, family: ElementFamily = SERENDIPITY) -> None:
        self.mesh = mesh
        self.family = family
        # One quadrature point: this basis serves for numbering only.
        basis = CellBasis(mesh, family.element(), intorder=0)
        self.nodes: Array = basis.doflocs
        self.element_nodes = basis.element_dofs
        self.count = int(basis.N)

    def gradients(self, elements: Array) -> tuple[Array, Array, Array]:
        """Gradients (element, shape, 3, point), volumes (element, point), positions (3, element, point)."""
        basis = CellBasis(self.mesh, self.family.element(), intorder=self.family.volume_order, elements=elements)
        gradients = np.stack([np.asarray(basis.basis[i][0].grad) for i in range(basis.Nbfun)])
        return np.ascontiguousarray(gradients.transpose(2, 0, 1, 3)), basis.dx, np.asarray(basis.global_coordinates())


def lame(poisson_ratio: float) -> tuple[float, float]:
    """Lame's constants for E = 1."""
    return poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio)), 0.5 / (1.0 + poisson_ratio)


def element_matrices(gradients: Array, volumes: Array, poisson_ratio: float) -> Array:
    """Stiffness of each element, shape (element, 3 shapes, 3 shapes), node by node x, y, z."""
    first, second = lame(poisson_ratio)
    count, shapes, _, points = gradients.shape
    flat = gradients.reshape(count, 3 * shapes, points)
    # product[e, i, c, j, d] = integral of dNi/dc dNj/dd
    product = np.matmul(flat * volumes[:, None, :], flat.transpose(0, 2, 1)).reshape(count, shapes, 3, shapes, 3)
    laplace = product[:, :, 0, :, 0] + product[:, :, 1, :, 1] + product[:, :, 2, :, 2]
    matrix = first * product + second * product.transpose(0, 1, 4, 3, 2)
    for axis in range(3):
        matrix[:, :, axis, :, axis] += second * laplace
    return matrix.reshape(count, 3 * shapes, 3 * shapes)


def stiffness(field: Field, poisson_ratio: float, progress: Progress = silent) -> sp.csr_matrix:
    """The body's stiffness matrix, assembled chunk by chunk."""
    size = 3 * field.count
    total = sp.csr_matrix((size, size))
    for start in range(0, field.mesh.nelements, CHUNK):
        elements = np.arange(start, min(start + CHUNK, field.mesh.nelements))
        gradients, volumes, _ = field.gradients(elements)
        matrices = element_matrices(gradients, volumes, poisson_ratio)
        dofs = (3 * field.element_nodes[:, elements].T[:, :, None] + np.arange(3)).reshape(len(elements), -1)
        width = dofs.shape[1]
        rows = np.repeat(dofs, width, axis=1).ravel()
        columns = np.tile(dofs, (1, width)).ravel()
        total = total + sp.coo_matrix((matrices.ravel(), (rows, columns)), shape=(size, size)).tocsr()
        progress("assembling", (start + len(elements)) / field.mesh.nelements)
    return total


Slope = Callable[[Array, Array], tuple[Array, Array]]


@dataclass(frozen=True)
class CondensedBody:
    """A body's answer to each pressure hat; the mesh and its factor are gone by then."""

    poisson_ratio: float
    flexibility: Array
    """Integral of hat i times the normal displacement under hat j, shape (hat, hat); symmetrised."""
    asymmetry: float
    """Largest difference of the flexibility and its transpose over its largest entry."""
    reaction: Array
    """Force along z with which the surroundings hold the body, for each hat, shape (hat,)."""
    stress_points: Array
    """Gauss points near the axis and near the plane x = 0, shape (3, point)."""
    stresses: Array
    """There, for each hat: sigma_x, sigma_y, sigma_z, tau_yz; shape (4, point, hat)."""
    dofs: int
    """Unknowns solved for."""
    solver: str


def condense(
    brick: MeshHex,
    hats: PressureHats,
    poisson_ratio: float,
    support: Support,
    shape: Callable[[Array], Array] | None = None,
    slope: Slope | None = None,
    progress: Progress = silent,
    surface_order: int = SURFACE_ORDER,
    family: ElementFamily = SERENDIPITY,
) -> CondensedBody:
    """Condense the body onto its contact.

    Args:
        brick: the mesh as its recipe gives it (stretched), with its tags.
        hats: the pressure, on the tangent plane.
        poisson_ratio: of the body.
        support: what holds it.
        shape: bends the brick's points (3, point) into the body; None leaves it a brick.
        slope: the contact surface's slopes dz/dx, dz/dy at (x, y), z into the body; None: flat.
        progress: told how far it is.
        surface_order: quadrature order of the contact's facets.
        family: the elements that the brick is filled with.
    """
    straight = family.body(brick)
    reference = Field(straight, family).nodes
    body = straight
    if shape is not None:
        body = type(straight)(shape(straight.p), straight.t, _boundaries=straight.boundaries, sort_t=False)
    field = Field(body, family)
    matrix = stiffness(field, poisson_ratio, progress)

    high = reference.max(axis=1)
    small = 1e-9 * high
    held = np.zeros((field.count, 3), dtype=bool)
    driven = np.zeros(field.count, dtype=bool)
    held[reference[0] < small[0], 0] = True
    held[reference[1] < small[1], 1] = True
    if support is Support.EQUATOR:
        held[reference[2] > high[2] - small[2], 2] = True
    else:
        driven = np.any(reference > (high - small)[:, None], axis=0)
        held[driven] = True
    free = np.flatnonzero(~held.ravel())
    driven_dofs = (3 * np.flatnonzero(driven)[:, None] + np.arange(3)).ravel()

    progress("far field", 0.0)
    count = len(hats.forces)
    if support is Support.HALF_SPACE:
        (x, y), _ = hats.samples
        far = boussinesq.hat_displacement(field.nodes[:, driven], np.stack([x, y]), hats.loads, poisson_ratio)
        driven_displacement = far.transpose(1, 0, 2).reshape(-1, count)
    else:
        driven_displacement = np.zeros((len(driven_dofs), count))

    loads = _contact_loads(field, hats, slope, surface_order)
    rows = matrix[free]
    coupling = sp.csr_matrix(rows[:, driven_dofs])
    supported = held[:, 2] if support is Support.EQUATOR else driven
    summing = sp.csr_matrix(
        (np.ones(int(supported.sum())), (np.zeros(int(supported.sum()), dtype=int), 3 * np.flatnonzero(supported) + 2)),
        shape=(1, matrix.shape[0]),
    )
    reaction_row = sp.csr_matrix(summing @ matrix)
    progress("factorising", 0.0)
    square = sp.csc_matrix(rows[:, free])
    del matrix, rows
    factor = factorise(square, dissection.order(dissection.grid_ranks(reference)[:, free // 3]))
    del square

    flexibility = np.zeros((count, count))
    reaction = np.zeros(count)
    inside = _Inside.near_centre(field, hats, poisson_ratio)
    stresses = np.zeros((4, inside.points.shape[1], count))
    free_loads = sp.csr_matrix(loads[free])
    for start in range(0, count, SIDES):
        some = slice(start, min(start + SIDES, count))
        moved = np.zeros((3 * field.count, some.stop - some.start))
        moved[driven_dofs] = driven_displacement[:, some]
        moved[free] = factor.solve(free_loads[:, some].toarray() - coupling @ moved[driven_dofs])
        flexibility[:, some] = loads.T @ moved
        reaction[some] = np.asarray(reaction_row @ moved).ravel()
        stresses[:, :, some] = inside.stresses(moved)
        progress("solving", some.stop / count)
    factor.release()
    return CondensedBody(
        poisson_ratio=poisson_ratio,
        flexibility=0.5 * (flexibility + flexibility.T),
        asymmetry=float(np.abs(flexibility - flexibility.T).max() / np.abs(flexibility).max()),
        reaction=reaction,
        stress_points=inside.points,
        stresses=stresses,
        dofs=len(free),
        solver=factor.solver,
    )


@dataclass(frozen=True)
class _Inside:
    """Where the stresses are read."""

    nodes: Array
    """Nodes of the elements looked into, shape (shape function, element)."""
    gradients: Array
    points: Array
    poisson_ratio: float

    @classmethod
    def near_centre(cls, field: Field, hats: PressureHats, poisson_ratio: float) -> _Inside:
        centres = field.mesh.p[:, field.mesh.t].mean(axis=1)
        # The first two columns of elements beside each symmetry plane at least: the fit on the axis needs four points
        # each way, and the map of the plane x = 0 its nearest ones.
        wide = max(AXIS_REACH * hats.lines_x[-1], 1.01 * hats.lines_x[2])
        deep = float(hats.lines_y[-1]) * STRESS_DEPTH
        near_axis = (centres[0] < wide) & (centres[1] < max(AXIS_REACH * hats.lines_y[-1], 1.01 * hats.lines_y[2]))
        near_plane = (centres[0] < hats.lines_x[1]) & (centres[1] < hats.lines_y[-1])
        chosen = np.flatnonzero((near_axis | near_plane) & (centres[2] < deep))
        gradients, _, positions = field.gradients(chosen)
        return cls(field.element_nodes[:, chosen], gradients, positions.reshape(3, -1), poisson_ratio)

    def stresses(self, displacement: Array) -> Array:
        """sigma_x, sigma_y, sigma_z, tau_yz at the points for E = 1, shape (4, point, case)."""
        nodal = displacement.reshape(-1, 3, displacement.shape[1])[self.nodes]
        strain = np.einsum("eicp,iecm->cepm", self.gradients, nodal, optimize=True)
        sheared = np.einsum("eip,iem->epm", self.gradients[:, :, 2], nodal[:, :, 1], optimize=True)
        sheared += np.einsum("eip,iem->epm", self.gradients[:, :, 1], nodal[:, :, 2], optimize=True)
        first, second = lame(self.poisson_ratio)
        normal = first * strain.sum(axis=0) + 2.0 * second * strain
        return np.concatenate([normal, second * sheared[None]]).reshape(4, -1, displacement.shape[1])


def _contact_loads(field: Field, hats: PressureHats, slope: Slope | None, surface_order: int) -> sp.csr_matrix:
    """Nodal forces of each hat of unit pressure, shape (dof, hat).

    Pressure acts along the inward normal: on the piece of surface over dx dy that is p (-dz/dx, -dz/dy, 1) dx dy.
    """
    facets = field.mesh.boundaries["contact"]
    basis = FacetBasis(field.mesh, field.family.element(), facets=facets, intorder=surface_order)
    positions = np.asarray(basis.global_coordinates())
    # scikit-fem's facet measure is of the facet itself; its shadow on the tangent plane carries the pressure.
    shadow = np.abs(np.asarray(basis.normals)[2]) * basis.dx
    x, y = positions[0].ravel(), positions[1].ravel()
    hat_values = hats.values(x, y)
    directions: list[Array | float] = [0.0, 0.0, 1.0]
    if slope is not None:
        slope_x, slope_y = slope(x, y)
        directions = [-slope_x, -slope_y, 1.0]
    points = basis.dx.shape[1]
    column = np.arange(x.size)
    rows, columns, values = [], [], []
    for i in range(basis.Nbfun):
        value = (np.asarray(basis.basis[i][0]) * shadow).ravel()
        rows.append(np.repeat(basis.element_dofs[i], points))
        columns.append(column)
        values.append(value)
    row, col, val = np.concatenate(rows), np.concatenate(columns), np.concatenate(values)
    relevant = np.abs(val) > 0.0
    shapes = sp.csr_matrix((val[relevant], (row[relevant], col[relevant])), shape=(field.count, x.size))
    total = sp.csr_matrix((3 * field.count, hat_values.shape[1]))
    for axis, direction in enumerate(directions):
        if isinstance(direction, float):
            if direction == 0.0:
                continue
            part = shapes @ hat_values
        else:
            part = shapes @ sp.diags(direction) @ hat_values
        part = sp.coo_matrix(part)
        total = total + sp.csr_matrix((part.data, (3 * part.row + axis, part.col)), shape=total.shape)
    return sp.csr_matrix(total)


def hats_of(brick: MeshHex, samples_per_cell: int = 3) -> PressureHats:
    """The hats that stand on the vertices of a brick's contact face."""
    corners = np.unique(brick.facets[:, brick.boundaries["contact"]])
    lines = []
    for axis in (0, 1):
        values = np.sort(brick.p[axis, corners])
        lines.append(values[np.concatenate([[True], np.diff(values) > 1e-7 * values[-1]])])
    return PressureHats(lines[0], lines[1], samples_per_cell)
