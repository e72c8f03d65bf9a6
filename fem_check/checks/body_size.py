"""Is the prescribed far field right? Clamped boxes of growing size, which do not use it, must tend to the same
result."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fem_check import meshing
from fem_check.elements import elastic_body
from fem_check.elements.elastic_body import CondensedBody, Support
from fem_check.independent import references
from fem_check.independent.references import axis_ratio, hertz
from fem_check.mechanics import contact
from fem_check.mechanics.half_space_contact import stretched
from fem_check.product.scenes import groove_contact, operating_loads
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress
from fem_check.rows.record import MeshRecord

SIZES = (8.0, 16.0, 32.0)
"""Half-length of the boxes in semi-major axes; half-width and depth are SHAPE times as many semi-minor axes."""
SHAPE = 8.2
"""a/b of B218's inner contact, for which the boxes are cubes; their growth, not their shape, is what counts."""
ELEMENTS = {MeshLevel.QUICK: 3, MeshLevel.RELEASE: 6}
TOLERANCE = 0.23
"""[%]"""


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Clamped boxes of 8, 16 and 32 semi-major axes and their limit, against the exact far field at 2.5 and Hertz."""
    groove = groove_contact(scene, "inner")
    groove = replace(groove, ball=groove.race)  # one body serves for both
    problem = groove.problem(operating_loads(scene, "inner")[-1])
    exact = hertz(problem)
    ellipticity = round(1.0 / axis_ratio(problem.curvature_x / problem.curvature_y), 3)
    elements = ELEMENTS[level]
    approaches, scatter = [], []
    body: CondensedBody | None = None
    for size in (*SIZES, 0.0):
        if size:
            made, support = meshing.clamped_box(elements, size, SHAPE), Support.CLAMPED
        else:
            made, support = meshing.clamped_box(elements, SIZES[0], SHAPE), Support.HALF_SPACE
        mesh = stretched(meshing.load(made), ellipticity, 1.0, 1.0)
        basis = elastic_body.pressure_basis_of(mesh)
        body = elastic_body.condense(mesh, basis, problem.race.poisson_ratio, support, progress=progress)
        unit = contact.edge_positions(exact.semi_minor_axis, made.x[0].length / made.x[0].elements)
        solution = contact.solve(problem, basis, contact.total_flexibility(problem, body, body), unit)
        approaches.append(float(solution.approaches.mean()))
        scatter.append(abs(float(solution.approaches[::2].mean()) - approaches[-1]))
    *clamped, open_far = approaches
    assert body is not None
    # The effect of the fixed walls falls like 1/distance; the patch's size enters with 1/distance^3.
    table = np.column_stack([np.ones(3), 1.0 / np.asarray(SIZES), 1.0 / np.asarray(SIZES) ** 3])
    limit = float(np.linalg.solve(table, np.asarray(clamped))[0])
    # What the next power would add: the difference to the two largest boxes without the cube.
    short = float(np.linalg.solve(table[1:, :2], np.asarray(clamped[1:]))[0])
    case = f"{groove.name} inner, Q = {problem.load:.0f} N"
    rows = [
        AgreementRow(
            f"{case}: clamped at {size:g} semi-major axes",
            "approach",
            "m",
            exact.approach,
            references.HERTZ_SOURCE,
            approach,
            None,
            None,
            "a finding: the error of a finite box",
        )
        for size, approach in zip(SIZES, clamped, strict=True)
    ]
    rows.append(
        AgreementRow(
            f"{case}: clamped boxes extrapolated to infinity",
            "approach",
            "m",
            open_far,
            "the same mesh with Boussinesq's displacement of the contact pressure on its far faces",
            limit,
            100.0 * (abs(limit - short) + sum(scatter)) / open_far,
            TOLERANCE,
            "twice what the extrapolation leaves open, 0.11 %; a far field 1 % too large does 0.3 %",
        )
    )
    largest = meshing.clamped_box(elements, SIZES[-1], SHAPE)
    entry: MeshRecord = {"elements_per_semi_axis": elements, "dofs": body.dofs, "file": largest.file_name}
    series = {
        "body_size": {
            "size": list(SIZES),
            "approach": clamped,
            "limit": limit,
            "far_field": open_far,
            "hertz": exact.approach,
        }
    }
    return Findings(rows, entry, body.solver, series)


CHECK = Check(
    name="body_size",
    question="As clamped boxes grow, does the approach in them tend to that of the exact far field?",
    kind=CheckKind.VERIFICATION,
    reference="the limit of clamped boxes, which do not use the far field",
    tolerance=f"{TOLERANCE:g} %",
    run=run,
    largest_dofs=lambda level: meshing.clamped_box(ELEMENTS[level], SIZES[-1], SHAPE).dofs,
    at_quick=False,
)
