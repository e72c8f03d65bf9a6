"""Displacement, stress and pressure at the nodes of a meshed body, and their file for ParaView (VTU)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from fem_check.independent.contact_problem import Array, ElasticConstants

if TYPE_CHECKING:
    from fem_check.elements.elastic_body import DisplacementSpace

COMPONENTS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
"""Of a symmetric tensor, in the order of VTK: XX, YY, ZZ, XY, YZ, XZ."""

_HEXAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
_HEXAHEDRON_EDGES = (
    (0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7),
)  # fmt: skip
_TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
_TETRAHEDRON_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
CELLS = {
    20: ("hexahedron20", _HEXAHEDRON, _HEXAHEDRON_EDGES),
    10: ("tetra10", _TETRAHEDRON, _TETRAHEDRON_EDGES),
}
"""By the number of nodes: name in meshio, and VTK's corners on the reference element and edges with a middle node."""


@dataclass(frozen=True)
class NodalFields:
    """A body and what its nodes have; lengths [mm], stresses [MPa]."""

    nodes: Array
    """Positions, (3, node)."""
    elements: Array
    """Nodes of each, in VTK's order, (20 or 10, element)."""
    displacement: Array
    """(3, node)."""
    stress: Array
    """The mean of the elements round each node, components as in `COMPONENTS`, (6, node)."""
    pressure: Array
    """Of the contact, zero elsewhere, (node,)."""

    def scaled(self, length: float, stress: float) -> NodalFields:
        """A similar body: lengths are multiplied by one number, stresses, and so strains, by another."""
        return replace(
            self,
            nodes=length * self.nodes,
            displacement=length * stress * self.displacement,
            stress=stress * self.stress,
            pressure=stress * self.pressure,
        )

    @property
    def von_mises(self) -> Array:
        """Von Mises' stress, (node,)."""
        normal, shear = self.stress[:3], self.stress[3:]
        deviator = normal - normal.mean(axis=0)
        return np.sqrt(1.5 * ((deviator**2).sum(axis=0) + 2.0 * (shear**2).sum(axis=0)))

    def write(self, path: Path) -> None:
        """Write the field as a VTU file.

        Raises:
            OSError: the file cannot be written.
        """
        import meshio

        name, *_ = CELLS[len(self.elements)]
        data = {
            "displacement_mm": self.displacement.T, "stress_MPa": self.stress.T, "von_mises_MPa": self.von_mises,
            "pressure_MPa": self.pressure,
        }  # fmt: skip
        mesh = meshio.Mesh(self.nodes.T, [(name, self.elements.T)], point_data=data)
        mesh.write(path, file_format="vtu")


def of_body(space: DisplacementSpace, moved: Array, pressure: Array, material: ElasticConstants) -> NodalFields:
    """The field of a body.

    Args:
        space: its nodes [m].
        moved: their displacements, (node, 3) [m].
        pressure: on them, (node,) [Pa].
        material: of the body.
    """
    stresses = 1e-6 * stress(space, moved, material)
    return NodalFields(1e3 * space.nodes, in_vtk_order(space), 1e3 * moved.T, stresses, 1e-6 * pressure)


def stress(space: DisplacementSpace, moved: Array, material: ElasticConstants) -> Array:
    """Stress at the nodes, the mean of the elements round each, (6, node) [Pa]."""
    from skfem import CellBasis

    element = space.family.element()
    count = element.doflocs.shape[0]
    basis = CellBasis(space.mesh, element, quadrature=(element.doflocs.T, np.ones(count)))
    gradient = np.stack([np.asarray(basis.interpolate(moved[:, axis]).grad) for axis in range(3)])
    trace = np.einsum("iiep->ep", gradient)
    modulus, ratio = material.elastic_modulus, material.poisson_ratio
    second = 0.5 * modulus / (1.0 + ratio)
    first = 2.0 * second * ratio / (1.0 - 2.0 * ratio)
    nodes = space.element_nodes.ravel()
    times = np.bincount(nodes, minlength=space.count)
    components = []
    for i, j in COMPONENTS:
        values = second * (gradient[i, j] + gradient[j, i]) + (first * trace if i == j else 0.0)
        components.append(np.bincount(nodes, values.T.ravel(), space.count) / times)
    return np.stack(components)


def in_vtk_order(space: DisplacementSpace) -> Array:
    """Nodes of each element as VTK numbers them, so that its volume is positive.

    scikit-fem numbers the nodes of its reference element in another order, and the elements of a mesh file may be left-
    handed in it: such an element takes the reference element seen in a mirror, with x and y exchanged.
    """
    _, corners, edges = CELLS[len(space.element_nodes)]
    reference = np.concatenate([corners, [corners[list(edge)].mean(axis=0) for edge in edges]])
    own = space.family.element().doflocs
    orders = [
        np.array([int(np.argmin(((own - point) ** 2).sum(axis=1))) for point in each])
        for each in (reference, reference[:, [1, 0, 2]])
    ]
    right_handed = _volumes(space, orders[0], corners) > 0.0
    return np.where(right_handed, *(space.element_nodes[order] for order in orders))


def _volumes(space: DisplacementSpace, order: Array, corners: Array) -> Array:
    """Of each element's first corner and the three beside it, signed: six times the tetrahedron."""
    beside = [int(np.argmin(((corners - axis) ** 2).sum(axis=1))) for axis in np.identity(3)]
    origin, *ends = (space.nodes[:, space.element_nodes[order[number]]] for number in (0, *beside))
    return np.einsum("ce,ce->e", np.cross(ends[0] - origin, ends[1] - origin, axis=0), ends[2] - origin)
