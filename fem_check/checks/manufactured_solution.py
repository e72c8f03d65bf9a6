"""Do the elements solve an elastic problem with a known smooth solution, at the order that theory gives them?

A displacement of a few waves is prescribed; the body force that it needs, and on a curved face its traction, load the
body; the solution must come back. Quadratic elements are due the order 3 in the displacement and 2 in its gradient
(P. G. Ciarlet, The Finite Element Method for Elliptic Problems, 1978, sections 3.2 and 4.3).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from fem_check.elements import elastic_body
from fem_check.elements.elastic_body import DisplacementSpace, lame
from fem_check.elements.linear_solver import Factor, factorise
from fem_check.independent.contact_problem import Array, ElasticConstants
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.tetrahedral_body import TetrahedralBody

POISSON = 0.3
COUNTS = {MeshLevel.QUICK: (4, 8), MeshLevel.RELEASE: (6, 12)}
"""Elements along each edge, coarse and fine."""
ORDERS = {"displacement": 3.0, "displacement gradient": 2.0}
TOLERANCE = 2.5
WHY = "a wrong term costs a whole order, or all convergence; meshes as coarse as these miss it by 1.6 %"
WAVES = np.array([[1.1, -0.7, 0.9], [-0.6, 1.3, 0.8], [0.9, 0.8, -1.2]])
"""Wave vectors, one a row; lengths in the edge of the body."""
AMPLITUDES = np.array([[1.0, 0.4, -0.5], [0.3, -0.8, 0.6], [-0.5, 0.7, 0.9]])
PHASES = np.array([0.3, 1.1, 2.0])
INNER, OUTER = 1.0, 1.8
"""Radii of the shell that the tetrahedra fill."""


def displacement(points: Array) -> Array:
    """The solution at points (3, ...)."""
    return np.einsum("mi,m...->i...", AMPLITUDES, np.sin(_arguments(points)))


def gradient(points: Array) -> Array:
    """du_i/dx_j, shape (3, 3, ...)."""
    return np.einsum("mi,mj,m...->ij...", AMPLITUDES, WAVES, np.cos(_arguments(points)))


def body_force(points: Array) -> Array:
    """Minus the divergence of the stress, for E = 1."""
    first, second = lame(POISSON)
    along = (AMPLITUDES * WAVES).sum(axis=1)[:, None] * WAVES
    needed = (first + second) * along + second * (WAVES**2).sum(axis=1)[:, None] * AMPLITUDES
    return np.einsum("mi,m...->i...", needed, np.sin(_arguments(points)))


def stress(points: Array) -> Array:
    """For E = 1, shape (3, 3, ...)."""
    first, second = lame(POISSON)
    slope = gradient(points)
    pressure = np.multiply.outer(np.eye(3), np.trace(slope))
    return first * pressure + second * (slope + slope.swapaxes(0, 1))


def _arguments(points: Array) -> Array:
    return np.einsum("mj,j...->m...", WAVES, points) + PHASES.reshape(-1, *(1,) * (points.ndim - 1))


def hexahedra(count: int) -> DisplacementSpace:
    """A brick, its elements growing sideways and in depth as those below a contact do."""
    from skfem import MeshHex

    lines = np.linspace(0.0, 1.0, count + 1)
    return DisplacementSpace(MeshHex.init_tensor(lines, lines + 0.4 * lines**2, lines + 0.8 * lines**2))


def tetrahedra(count: int) -> TetrahedralBody:
    """A piece of a spherical shell, every edge curved."""
    from skfem import MeshTet

    lines = np.linspace(0.0, 1.0, count + 1)
    cube = MeshTet.init_tensor(lines, lines, lines)

    def shell(points: Array) -> Array:
        direction = np.stack([points[0] - 0.4, points[1] - 0.3, np.ones_like(points[0])])
        return (INNER + (OUTER - INNER) * points[2]) * direction / np.linalg.norm(direction, axis=0)

    middles = shell(cube.p[:, cube.edges].mean(axis=1))
    return TetrahedralBody(BodyMesh(shell(cube.p), cube.t, cube.edges, middles), ElasticConstants(1.0, POISSON))


def errors(space: DisplacementSpace, loads: Array, pulled: Array) -> tuple[dict[str, float], Factor]:
    """Root mean squares of the errors.

    Args:
        space: the mesh.
        loads: on its surface, (dof,).
        pulled: nodes of the surface on which those act; the rest of it is held at the solution.
    """
    from skfem import CellBasis, LinearForm

    basis = CellBasis(space.mesh, space.family.element(), intorder=6)
    points = np.asarray(basis.global_coordinates())
    force = [LinearForm(lambda v, w: w.f * v).assemble(basis, f=each) for each in body_force(points)]
    held = np.ones(space.count, dtype=bool)
    surface = space.mesh.boundary_facets()
    held[np.setdiff1d(np.arange(space.count), basis.get_dofs(surface).flatten())] = False
    held[pulled] = False
    held = np.repeat(held, 3)
    matrix = elastic_body.stiffness(space, POISSON)
    solution = displacement(space.nodes).T.ravel()
    right = np.stack(force, axis=1).ravel() + loads - matrix[:, held] @ solution[held]
    factor = factorise(sp.csc_matrix(matrix[~held][:, ~held]))
    solution[~held] = factor.solve(right[~held])
    fields = [basis.interpolate(solution[axis::3]) for axis in range(3)]
    values, slopes = np.stack([np.asarray(each) for each in fields]), np.stack([each.grad for each in fields])
    differences = values - displacement(points), slopes - gradient(points)
    sums = [float(np.sqrt((each**2 * basis.dx).sum() / basis.dx.sum())) for each in differences]
    return dict(zip(ORDERS, sums, strict=True)), factor


def of_hexahedra(count: int) -> tuple[dict[str, float], Factor]:
    """Held all round."""
    space = hexahedra(count)
    return errors(space, np.zeros(3 * space.count), np.array([], dtype=int))


def of_tetrahedra(count: int) -> tuple[dict[str, float], Factor]:
    """Pulled on the outer sphere, whose exact normal the traction takes; held on the other faces."""
    from skfem import CellBasis

    body = tetrahedra(count)

    def outside(points: Array) -> Array:
        return np.abs(np.linalg.norm(points, axis=0) - OUTER) < 1e-9

    facets = body.facets(outside)
    normals = facets.points / np.linalg.norm(facets.points, axis=0)
    traction = np.einsum("ijp,jp->ip", stress(facets.points), normals) * np.linalg.norm(facets.directed_areas, axis=0)
    loads = body.surface_loads(facets, [sp.csr_matrix(each[:, None]) for each in traction])
    surface = body.mesh.boundary_facets()
    pulled = outside(body.nodes)[body.mesh.facets[:, surface]].all(axis=0)
    basis = CellBasis(body.mesh, body.space.family.element(), intorder=0)
    free, held = (basis.get_dofs(surface[some]).flatten() for some in (pulled, ~pulled))
    return errors(body.space, loads.toarray().ravel(), np.setdiff1d(free, held))


BODIES = {
    "20-node hexahedra, graded": of_hexahedra,
    "10-node tetrahedra, curved": of_tetrahedra,
}


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Both kinds of element, each on two meshes."""
    rows = []
    for name, solved in BODIES.items():
        (coarse, _), (fine, factor) = (solved(count) for count in COUNTS[level])
        for quantity, order in ORDERS.items():
            observed = float(np.log2(coarse[quantity] / fine[quantity]))
            case = f"{name}, {' to '.join(map(str, COUNTS[level]))} along an edge"
            source = "Ciarlet 1978: quadratic elements, also isoparametric"
            rows.append(
                AgreementRow(case, f"order of the {quantity}", "1", order, source, observed, None, TOLERANCE, WHY)
            )
    return Findings(rows, solver=factor.solver)


CHECK = Check(
    name="manufactured_solution",
    question="Do hexahedra and curved tetrahedra solve elasticity at the order that theory gives them?",
    kind=CheckKind.VERIFICATION,
    reference="a manufactured solution; orders 3 in the displacement and 2 in its gradient",
    tolerance="2.5 % of the order",
    run=run,
    largest_dofs=lambda level: 3 * (2 * COUNTS[level][-1] + 1) ** 3,
)
