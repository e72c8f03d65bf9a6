"""Does the element represent constant strain exactly, and rigid motion without stress, on a sheared brick?"""

from __future__ import annotations

import numpy as np

from fem_check import meshing
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.contact_problem import Array
from fem_check.elastic_body import DisplacementSpace, lame, stiffness
from fem_check.linear_solver import factorise

POISSON = 0.3
# Rounding in a solve with 1e3 unknowns; a wrong Jacobian or quadrature weight shows at 1e-2 or more.
TOLERANCE = 1e-9


def _sheared(points: Array) -> Array:
    """An affine distortion, which must not affect straight-sided serendipity elements."""
    return np.array([[1.0, 0.2, -0.1], [0.1, 0.8, 0.15], [-0.05, 0.1, 1.3]]) @ points


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
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
    strain = np.array([[1.0, 0.3, -0.2], [0.3, -0.5, 0.4], [-0.2, 0.4, 0.7]])
    exact = (strain @ space.nodes).T.ravel()
    free = np.flatnonzero(~np.repeat(boundary, 3))
    fixed = np.flatnonzero(np.repeat(boundary, 3))
    factor = factorise(matrix[free][:, free].tocsc())
    found = exact.copy()
    found[free] = factor.solve(-(matrix[free][:, fixed] @ exact[fixed]))
    first, second = lame(POISSON)
    stress = first * np.trace(strain) * np.eye(3) + 2.0 * second * strain
    volume = float(np.prod(high)) * np.linalg.det(_sheared(np.eye(3)))
    energy = volume * float(np.sum(stress * strain))
    rows = [
        Row(
            "constant strain",
            "displacement error",
            "1",
            0.0,
            "exact: the displacement is affine",
            float(np.abs(found - exact).max() / np.abs(exact).max()),
            None,
            100.0 * TOLERANCE,
            "rounding",
        ),
        Row(
            "constant strain",
            "strain energy",
            "1",
            energy,
            "exact: stress times strain times volume",
            float(found @ (matrix @ found)),
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
            Row(
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
    mesh_entry = {"elements_per_semi_axis": 4, "dofs": len(free), "file": recipe.file_name}
    return Findings(rows, mesh_entry, factor.solver)


CHECK = Check(
    name="patch_test",
    question="Does the finite element represent constant strain and rigid motion exactly?",
    kind=Kind.VERIFICATION,
    reference="exact solutions of elasticity: affine displacement, rigid motion",
    tolerance="1e-9 relative: rounding",
    run=run,
    largest_dofs=lambda level: meshing.half_space(4).dofs,
)
