"""Do approach and semi-axes grow like the powers 2/3 and 1/3 of the load, over two decades on one mesh?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fem_check import contact, elastic_body, measuring, meshing, references
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row, collapsed
from fem_check.checks import groove_contacts
from fem_check.contact_problem import QUANTITIES
from fem_check.elastic_body import CondensedBody, Support
from fem_check.half_space_contact import soundness_rows, stretched
from fem_check.pressure_basis import PressureBasis
from fem_check.references import axis_ratio, hertz
from fem_check.scenes import groove_contact, operating_loads

STEPS = {Level.QUICK: 4, Level.RELEASE: 7}
"""Loads over two decades in even steps, the heaviest being the bearing's own."""
SPAN = 100.0 ** (1.0 / 3.0)
"""Largest over smallest contact."""
ELEMENTS = {Level.QUICK: 6, Level.RELEASE: 7}
TOLERANCE = 0.2
EXPONENT_TOLERANCE = 0.1
SHOWN_ONLY = ("max_pressure", "max_shear_depth")
"""Read at a point, where the coarse ends of a mesh for two decades tell most; gated in the groove checks."""
WHY = "a tolerance set beforehand, for one mesh over two decades; what is read at a point is shown only"
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
    """The inner groove: one factorisation for all loads, each contact at its own size in the mesh."""
    groove = groove_contact(scene, "inner")
    groove = replace(groove, ball=groove.race)  # one body serves for both
    heaviest = operating_loads(scene, "inner")[-1]
    loads = [float(f"{load:.4g}") for load in np.geomspace(0.01 * heaviest, heaviest, STEPS[level])]
    case = f"{groove.name} inner: {groove_contacts.span(tuple(loads))}, one mesh"
    problem = groove.problem(loads[0])
    ellipticity = round(1.0 / axis_ratio(problem.curvature_x / problem.curvature_y), 3)
    body, basis = _body(level, ellipticity, problem.race.poisson_ratio, progress)
    # Elements grow by this from one to the next, so the mesh's pattern repeats: the edge passes through one element.
    growth = recipe(level).x[1].growth
    smallest = hertz(problem).semi_minor_axis * growth
    each_load, found = [], []
    for load in loads:
        problem = groove.problem(load)
        steps = (np.arange(contact.POSITIONS) + 0.5) / contact.POSITIONS - 0.5
        solution = contact.solve(
            problem, basis, contact.total_flexibility(problem, body, body), smallest * growth ** (-steps)
        )
        measured = measuring.measure(solution, body, body)
        exact = hertz(problem)
        found.append(measured.mean)
        each_load += [
            Row(
                f"Q = {load:g} N",
                name,
                unit,
                getattr(exact, name),
                references.HERTZ_SOURCE,
                getattr(measured.mean, name),
                100.0 * measured.position_uncertainty(name) / getattr(exact, name),
                TOLERANCE if name not in SHOWN_ONLY else None,
                WHY,
            )
            for name, unit in QUANTITIES.items()
        ]
        each_load += soundness_rows(f"Q = {load:g} N", [measured])
    rows = collapsed(each_load, case)
    for name, expected in EXPONENTS.items():
        values = [getattr(each, name) for each in found]
        slope = float(np.polyfit(np.log(loads), np.log(values), 1)[0])
        # Errors of 0.2 % with opposite signs at the two ends change the exponent by 0.004/ln(100) = 0.0009.
        rows.append(
            Row(
                case,
                f"exponent of {name}",
                "1",
                expected,
                "Hertz: contacts of one shape are similar",
                slope,
                None,
                EXPONENT_TOLERANCE if name not in SHOWN_ONLY else None,
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
            "load_N": loads,
            **{name: [getattr(each, name) for each in found] for name in QUANTITIES},
            **{f"hertz_{name}": [getattr(hertz(groove.problem(load)), name) for load in loads] for name in QUANTITIES},
        }
    }
    return Findings(rows, entry, body.solver, series)


CHECK = Check(
    name="load_power_law",
    question="Over two decades of load on one mesh: do approach and semi-axes follow Hertz's powers of the load?",
    kind=Kind.VERIFICATION,
    reference="Hertz: delta ~ Q^(2/3); a, b, p0, tau ~ Q^(1/3)",
    tolerance="0.2 % at every load, 0.1 % on each exponent",
    run=run,
    largest_dofs=lambda level: recipe(level).dofs,
)
