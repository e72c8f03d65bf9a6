"""Do the elements represent constant strain exactly, and rigid motion without stress?

Hexahedra on a sheared brick; curved tetrahedra on a ball and a ring as they are meshed for their contact: a structured
block below it, free tetrahedra around.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from fem_check import meshing
from fem_check.checks import true_geometry
from fem_check.elements.elastic_body import DisplacementSpace, lame, stiffness
from fem_check.elements.linear_solver import factorise
from fem_check.independent.contact_problem import Array, ElasticConstants
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress
from fem_check.rows.record import MeshRecord
from fem_check.solids.body_mesh import BodyMesh
from fem_check.solids.tetrahedral_body import TetrahedralBody
from fem_check.solids.true_study import contacts

POISSON = 0.3
# Rounding in a solve with 1e3 unknowns; a wrong Jacobian or quadrature weight shows at 1e-2 or more.
TOLERANCE = 1e-11
STRAIN = np.array([[1.0, 0.3, -0.2], [0.3, -0.5, 0.4], [-0.2, 0.4, 0.7]])


def _sheared(points: Array) -> Array:
    """An affine distortion, which must not affect straight-sided serendipity elements."""
    return np.array([[1.0, 0.2, -0.1], [0.1, 0.8, 0.15], [-0.05, 0.1, 1.3]]) @ points


def _stress() -> Array:
    first, second = lame(POISSON)
    return first * np.trace(STRAIN) * np.eye(3) + 2.0 * second * STRAIN


def unbalanced(mesh: BodyMesh) -> float:
    """Largest nodal force left where a body of constant strain carries its tractions all round, over the largest of
    those; the integrands are polynomials on curved facets and elements too, so nothing but rounding may be left."""
    body = TetrahedralBody(mesh, ElasticConstants(1.0, POISSON))
    outside = np.zeros(body.space.count, dtype=bool)
    outside[body.mesh.facets[:, body.mesh.boundary_facets()]] = True
    facets = body.facets(lambda _: outside)
    traction = _stress() @ facets.directed_areas
    loads = body.surface_loads(facets, [sp.csr_matrix(each[:, None]) for each in traction]).toarray().ravel()
    left = body.stiffness @ (STRAIN @ body.nodes).T.ravel() - loads
    return float(np.abs(left).max() / np.abs(loads).max())


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Prescribe an affine displacement on the boundary, solve for the inside; then move the body rigidly."""
    from skfem import MeshHex

    recipe = meshing.half_space(4)
    brick = meshing.load(recipe)
    mesh = MeshHex(_sheared(brick.p), brick.t, _boundaries=brick.boundaries, sort_t=False)
    space = DisplacementSpace(mesh)
    matrix = stiffness(space, POISSON, progress)
    reference = DisplacementSpace(brick).nodes
    high = reference.max(axis=1, keepdims=True)
    boundary = np.any((reference < 1e-9) | (reference > high - 1e-9), axis=0)
    exact = (STRAIN @ space.nodes).T.ravel()
    free = np.flatnonzero(~np.repeat(boundary, 3))
    fixed = np.flatnonzero(np.repeat(boundary, 3))
    factor = factorise(matrix[free][:, free].tocsc())
    solution = exact.copy()
    solution[free] = factor.solve(-(matrix[free][:, fixed] @ exact[fixed]))
    volume = float(np.prod(high)) * np.linalg.det(_sheared(np.eye(3)))
    energy = volume * float(np.sum(_stress() * STRAIN))
    rows = [
        AgreementRow(
            "constant strain",
            "displacement error",
            "1",
            0.0,
            "exact: the displacement is affine",
            float(np.abs(solution - exact).max() / np.abs(exact).max()),
            None,
            100.0 * TOLERANCE,
            "rounding",
        ),
        AgreementRow(
            "constant strain",
            "strain energy",
            "1",
            energy,
            "exact: stress times strain times volume",
            float(solution @ (matrix @ solution)),
            None,
            100.0 * TOLERANCE,
            "rounding",
        ),
    ]
    size = float(np.abs(space.nodes).max())
    turned = np.cross(np.array([0.3, -0.2, 0.5]), space.nodes.T).ravel() / size
    scale = float(abs(matrix).max())
    for name, motion in (("translation", np.tile([1.0, 2.0, 3.0], space.count)), ("small rotation", turned)):
        rows.append(
            AgreementRow(
                f"rigid {name}",
                "nodal force",
                "1",
                0.0,
                "exact: no strain, no force",
                float(np.abs(matrix @ motion).max() / scale),
                None,
                100.0 * TOLERANCE,
                "rounding",
            )
        )
    contact = contacts(EXAMPLE, *true_geometry.LOADS[MeshLevel.QUICK][0][:2], (3,))[0]
    for name in ("ball", "ring"):
        rows.append(
            AgreementRow(
                f"constant strain, {name} of curved tetrahedra",
                "nodal force",
                "1",
                0.0,
                "exact: the tractions of constant stress balance it",
                unbalanced(contact.mesh(name)),
                None,
                100.0 * TOLERANCE,
                "rounding",
            )
        )
    mesh_entry: MeshRecord = {"elements_per_semi_axis": 4, "dofs": len(free), "file": recipe.file_name}
    return Findings(rows, mesh_entry, factor.solver)


CHECK = Check(
    name="patch_test",
    question="Do hexahedra and curved tetrahedra represent constant strain and rigid motion exactly?",
    kind=CheckKind.VERIFICATION,
    reference="exact solutions of elasticity: affine displacement, rigid motion",
    tolerance="1e-11 relative: rounding",
    run=run,
    largest_dofs=lambda level: meshing.half_space(4).dofs,
)
