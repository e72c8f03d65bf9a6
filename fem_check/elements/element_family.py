"""Element families: the 20-node hexahedra of all checks, and those compared with them.

`elastic_body.condense` takes any of them; only the cost record uses others than the first.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np

from fem_check.independent.contact_problem import Array

if TYPE_CHECKING:
    from skfem import Element, MeshHex, MeshTet


@dataclass(frozen=True)
class ElementFamily:
    """An element with the quadrature that it is used with."""

    name: str
    """A key, in files."""
    label: str
    skfem_name: str
    volume_order: int
    """Of the quadrature in the volume."""
    is_tetrahedral: bool = False

    def element(self) -> Element:
        """A new one, of scikit-fem."""
        import skfem

        return getattr(skfem, self.skfem_name)()

    def body(self, brick: MeshHex) -> MeshHex | MeshTet:
        """The brick in this family's elements, with its contact tagged; each hexahedron is six tetrahedra."""
        return _in_tetrahedra(brick) if self.is_tetrahedral else brick


SERENDIPITY = ElementFamily("hex20", "20-node hexahedra, 2×2×2 points", "ElementHexS2", 3)
"""The family of all checks. 2×2×2 points are where its stresses are most accurate."""

FAMILIES: tuple[ElementFamily, ...] = (
    SERENDIPITY,
    ElementFamily("hex27", "27-node hexahedra, 3×3×3 points", "ElementHex2", 5),
    ElementFamily("hex8", "8-node hexahedra, 2×2×2 points", "ElementHex1", 3),
    ElementFamily("tet10", "10-node tetrahedra", "ElementTetP2", 2, is_tetrahedral=True),
    # One point would do for the stiffness; the fit of the stresses near the axis needs more points than that.
    ElementFamily("tet4", "4-node tetrahedra", "ElementTetP1", 2, is_tetrahedral=True),
)
"""Every family measured."""


def _in_tetrahedra(brick: MeshHex) -> MeshTet:
    """Kuhn's six tetrahedra of each hexahedron, all round its long diagonal.

    They fit together from one hexahedron to the next because each one's corners are first put in the order of the
    brick's axes: the mesh file numbers them block by block as it likes.
    """
    from skfem import MeshTet

    corners: Array = brick.p[:, brick.t]
    high = corners > corners.mean(axis=1, keepdims=True)
    corner = (high * np.array([1, 2, 4])[:, None, None]).sum(axis=0)
    ordered = np.empty_like(brick.t)
    np.put_along_axis(ordered, corner, brick.t, axis=0)
    parts = []
    for first, second, _ in permutations((1, 2, 4)):
        parts.append(ordered[[0, first, first + second, 7]])
    body = MeshTet(brick.p, np.hstack(parts))
    contact = np.unique(brick.facets[:, brick.boundaries["contact"]])
    inside = np.zeros(brick.p.shape[1], dtype=bool)
    inside[contact] = True
    # All three corners on the contact: no facet inside the body has that, its contact lies in one plane.
    return MeshTet(
        body.p, body.t, _boundaries={"contact": np.flatnonzero(inside[body.facets].all(axis=0))}, sort_t=False
    )
