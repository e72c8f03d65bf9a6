"""Do the errors fall with the element as they should, on aligned and misaligned meshes?"""

from __future__ import annotations

import numpy as np

from fem_check import convergence, half_space_contact, references
from fem_check.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row
from fem_check.checks import groove_contacts
from fem_check.contact_problem import QUANTITIES
from fem_check.half_space_contact import STRETCHES
from fem_check.references import hertz
from fem_check.scenes import groove_contact

COUNTS = {Level.QUICK: (3, 4, 5, 6), Level.RELEASE: (4, 6, 8, 12)}
LEAST_ORDER = 1.5
LOAD = 1000.0


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Each mesh aligned and twice misaligned; the error is the root mean square over the three."""
    problem = groove_contact(scene, "inner").problem(LOAD)
    exact = hertz(problem)
    sizes: list[float] = []
    errors: dict[str, list[float]] = {name: [] for name in QUANTITIES}
    single: dict[str, list[float]] = {name: [] for name in QUANTITIES}
    for count in COUNTS[level]:
        results = []
        for stretch in STRETCHES:
            bodies = half_space_contact.condensed_bodies(problem, count, stretch, progress=progress)
            results.append(half_space_contact.solve_on(problem, bodies)[1])
        sizes.append(bodies.edge_element)
        for name in QUANTITIES:
            reference = getattr(exact, name)
            means = np.array([getattr(each.mean, name) for each in results]) / reference - 1.0
            errors[name].append(float(np.sqrt(np.mean(means**2))))
            all_positions = np.concatenate([each.each[name] for each in results]) / reference - 1.0
            single[name].append(float(np.abs(all_positions).max()))
    rows = []
    for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure"):
        order = convergence.fitted_order(sizes, errors[name])
        rows.append(
            Row(
                f"inner groove, {COUNTS[level][0]} to {COUNTS[level][-1]} elements per semi-axis",
                f"shortfall of the order of {name}",
                "1",
                0.0,
                f"theory: the pressure's root at the edge allows {LEAST_ORDER} or better; found {order:.2f}",
                max(0.0, LEAST_ORDER - order),
                None,
                0.0,
                "the order must not fall below what the edge allows; averaging over the positions can raise it",
            )
        )
    rows.append(
        Row(
            "finest mesh",
            "largest error of any single position",
            "1",
            0.0,
            references.HERTZ_SOURCE,
            max(values[-1] for name, values in single.items() if name != "max_shear_depth"),
            None,
            None,
            "a finding: what the mean over the positions averages out",
        )
    )
    series = {"convergence": {"size": sizes, "rms_error": errors, "worst_single_position": single}}
    entry = {"elements_per_semi_axis": COUNTS[level][-1], "dofs": bodies.race.dofs, "file": bodies.recipe.file_name}
    return Findings(rows, entry, bodies.race.solver, series)


CHECK = Check(
    name="convergence_order",
    question="Do the errors fall with the element size at the order that theory allows?",
    kind=Kind.VERIFICATION,
    reference="theory: 3/2 or better for a pressure that ends like a square root",
    tolerance="no shortfall of the order",
    run=run,
    largest_dofs=groove_contacts.largest_dofs,
)
