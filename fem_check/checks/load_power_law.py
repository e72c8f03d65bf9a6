"""Do approach and semi-axes grow like the powers 2/3 and 1/3 of the load, over two decades on one mesh?"""

from __future__ import annotations

import numpy as np

from fem_check import contact, elastic_body, measuring, meshing, references
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.contact_problem import QUANTITIES
from fem_check.elastic_body import CondensedBody, Support
from fem_check.half_space_contact import soundness_rows, stretched
from fem_check.pressure_basis import PressureBasis
from fem_check.references import axis_ratio, hertz
from fem_check.scenes import groove_contact

LOADS = (50.0, 107.7, 232.1, 500.0, 1077.2, 2320.8, 5000.0)
"""Two decades in even steps [N]."""
SPAN = (LOADS[-1] / LOADS[0]) ** (1.0 / 3.0)
"""Largest over smallest contact."""
ELEMENTS = {Level.QUICK: 6, Level.RELEASE: 7}
TOLERANCE = 0.2
EXPONENT_TOLERANCE = 0.1
EXPONENTS = {
    "approach": 2.0 / 3.0,
    "semi_major_axis": 1.0 / 3.0,
    "semi_minor_axis": 1.0 / 3.0,
    "max_pressure": 1.0 / 3.0,
    "max_shear_stress": 1.0 / 3.0,
    "max_shear_depth": 1.0 / 3.0,
}


def recipe(level: Level) -> meshing.Recipe:
    """The one mesh."""
    return meshing.load_series(ELEMENTS[level], round(SPAN, 6))


def _body(
    level: Level, ellipticity: float, poisson_ratio: float, progress: Progress
) -> tuple[CondensedBody, PressureBasis]:
    mesh = stretched(meshing.load(recipe(level)), ellipticity, 1.0, 1.0)
    basis = elastic_body.pressure_basis_of(mesh)
    return elastic_body.condense(mesh, basis, poisson_ratio, Support.HALF_SPACE, progress=progress), basis


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """B218's inner groove: one factorisation for all loads, each contact at its own size in the mesh."""
    groove = groove_contact(scene, "inner")
    problem = groove.problem(LOADS[0])
    ellipticity = round(1.0 / axis_ratio(problem.curvature_x / problem.curvature_y), 3)
    body, basis = _body(level, ellipticity, problem.race.poisson_ratio, progress)
    # Elements grow by this from one to the next, so the mesh's pattern repeats: the edge passes through one element.
    growth = recipe(level).x[1].growth
    smallest = hertz(problem).semi_minor_axis * growth
    rows, found = [], []
    for load in LOADS:
        problem = groove.problem(load)
        steps = (np.arange(contact.POSITIONS) + 0.5) / contact.POSITIONS - 0.5
        solution = contact.solve(
            problem, basis, contact.total_flexibility(problem, body, body), smallest * growth ** (-steps)
        )
        measured = measuring.measure(solution, body, body)
        exact = hertz(problem)
        found.append(measured.mean)
        rows += [
            Row(
                f"Q = {load:g} N",
                name,
                unit,
                getattr(exact, name),
                references.HERTZ_SOURCE,
                getattr(measured.mean, name),
                100.0 * measured.position_uncertainty(name) / getattr(exact, name),
                TOLERANCE if name != "max_shear_depth" else None,
                "a tolerance set beforehand, for one mesh over two decades; the depth, flat at the maximum, is shown "
                "only",
            )
            for name, unit in QUANTITIES.items()
        ]
        rows += soundness_rows(f"Q = {load:g} N", [measured])
    for name, expected in EXPONENTS.items():
        values = [getattr(each, name) for each in found]
        slope = float(np.polyfit(np.log(LOADS), np.log(values), 1)[0])
        # Errors of 0.2 % with opposite signs at the two ends change the exponent by 0.004/ln(100) = 0.0009.
        rows.append(
            Row(
                "50 to 5000 N",
                f"exponent of {name}",
                "1",
                expected,
                "Hertz: contacts of one shape are similar",
                slope,
                None,
                EXPONENT_TOLERANCE if name != "max_shear_depth" else None,
                "errors of 0.2 % of opposite sign at the two ends change the exponents by 0.13 and 0.26 %; "
                "the tolerance is below both",
            )
        )
    entry = {
        "elements_per_semi_axis": recipe(level).elements_per_semi_axis,
        "dofs": body.dofs,
        "file": recipe(level).file_name,
    }
    series = {
        "load_series": {
            "load_N": list(LOADS),
            **{name: [getattr(each, name) for each in found] for name in QUANTITIES},
            **{f"hertz_{name}": [getattr(hertz(groove.problem(load)), name) for load in LOADS] for name in QUANTITIES},
        }
    }
    return Findings(rows, entry, body.solver, series)


CHECK = Check(
    name="load_power_law",
    question="From 50 to 5000 N on one mesh: do approach and semi-axes follow Hertz's powers of the load?",
    kind=Kind.VERIFICATION,
    reference="Hertz: delta ~ Q^(2/3); a, b, p0, tau ~ Q^(1/3)",
    tolerance="0.2 % at every load, 0.1 % on each exponent",
    run=run,
    largest_dofs=lambda level: recipe(level).dofs,
)
