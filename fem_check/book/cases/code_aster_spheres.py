"""Two spheres pressed together: the contact test of another finite-element program, with this one's elements."""

from __future__ import annotations

import numpy as np

from fem_check.book.case import CaseResult, Curve, Diagram, compared
from fem_check.independent.contact_problem import ContactProblem, ElasticConstants
from fem_check.mechanics import half_space_contact
from fem_check.product.hertz import of_qsbearing
from fem_check.rows.agreement import AgreementRow, MeshLevel

SOURCE = "code_aster V6.04.104 (SSNV104), section 2.1"
RADIUS, CRUSHED = 50e-3, 4e-3
MATERIAL = ElasticConstants(20e9, 0.3)
PRINTED = {"max_pressure": ("largest pressure", "MPa", 1e-6, 2798.3), "semi_major_axis": ("radius", "mm", 1e3, 10.0)}
"""Quantity to its name, unit, factor to that unit, and the printed value."""
HALF_A_UNIT = {"max_pressure": 0.05, "semi_major_axis": 0.5}
COUNTS = (6, 8, 10)
"""Elements per semi-axis: from four, as at the quick level, the pressure would be known to 0.3 % only."""
NEEDS = ("skfem", "meshio")


def run() -> CaseResult:
    """Solved under the load of Hertz, and taken from there to the approach that the test prescribes."""
    modulus = 1.0 / (2.0 * MATERIAL.compliance)
    load = 4.0 / 3.0 * modulus * np.sqrt(0.5 * RADIUS) * CRUSHED**1.5
    problem = ContactProblem("two spheres", 2.0 / RADIUS, 2.0 / RADIUS, MATERIAL, MATERIAL, float(load))
    study = half_space_contact.mesh_study(problem, COUNTS)
    # Contacts of one shape are similar, also on a mesh that grows with them: both quantities go with sqrt(approach).
    approach = study.value("approach")
    to_approach, of_approach = np.sqrt(CRUSHED / approach), study.uncertainty("approach") / approach
    model = of_qsbearing(problem)
    rows, said = [], []
    for name, (label, unit, factor, printed) in PRINTED.items():
        value = factor * study.value(name) * to_approach
        uncertainty = study.uncertainty(name) / study.value(name) + 0.5 * of_approach
        tolerance = half_space_contact.TOLERANCES[MeshLevel.QUICK][name]
        why = half_space_contact.WHY[MeshLevel.QUICK]
        finite = f"{label}, finite elements"
        rows.append(
            AgreementRow("two spheres", finite, unit, printed, SOURCE, value, 100.0 * uncertainty, tolerance, why)
        )
        rows.append(
            compared(
                "two spheres",
                f"{label}, qsbearing",
                unit,
                printed,
                factor * model[name],
                SOURCE,
                HALF_A_UNIT[name],
                "half a unit of the printed last digit",
            )
        )
        said.append(f"{label} {value:.5g} ± {uncertainty * value:.1g} {unit} (printed {printed:g})")
    position = len(study.solution.unit_lengths) // 2
    (x, y), _ = study.solution.basis.samples
    pressure = 1e-6 * (study.solution.basis.values(x, y) @ study.solution.pressures[:, position])
    distance = 1e3 * study.solution.unit_lengths[position] * np.hypot(x, y)
    shown = distance < 12.0
    order = np.argsort(distance[shown])
    radii = 10.0 * np.sin(np.linspace(0.0, 0.5 * np.pi, 60))
    panel = Diagram(
        "distance from the centre, mm",
        "pressure, MPa",
        [
            Curve("finite elements", "dots", distance[shown][order], pressure[shown][order]),
            Curve("as printed: 2798.3 MPa over 10 mm", "line", radii, 2798.3 * np.sqrt(1.0 - (radii / 10.0) ** 2)),
        ],
    )
    return CaseResult(f"Finite elements: {'; '.join(said)}.", rows, [panel])
