"""Do the errors fall with the element as they should, on aligned and misaligned meshes, and do the uncertainties that
follow from three meshes cover them?"""

from __future__ import annotations

import numpy as np

from fem_check.independent import references
from fem_check.independent.contact_problem import QUANTITIES, ContactQuantities
from fem_check.independent.references import hertz
from fem_check.mechanics import half_space_contact
from fem_check.mechanics.half_space_contact import ORDERS, STRETCHES
from fem_check.mechanics.measuring import Measured
from fem_check.product.scenes import groove_contact, operating_loads
from fem_check.rows import convergence
from fem_check.rows.agreement import EXAMPLE, AgreementRow, Check, CheckKind, Findings, MeshLevel, Progress

PARTS = 4
COUNTS = {MeshLevel.QUICK: (3, 4, 6), MeshLevel.RELEASE: (4, 6, 8, 12)}


MESHES = 3
"""As many give an uncertainty wherever one is stated."""
ALLOWED = 0.05
"""Share of cases that an expanded uncertainty need not cover (ASME V&V 20-2009)."""


def _coverage(name: str, cases: dict[object, list[tuple[float, Measured, ContactQuantities]]]) -> AgreementRow:
    """How often the uncertainty of three meshes covers the error, which is known here.

    Each run of three successive meshes, each proportion of the mesh and each quantity is a case, and each quarter of
    the positions of the contact's edge: they meet other parts of an element, with other errors.
    """
    covers: dict[str, bool] = {}
    for stretch, meshes in cases.items():
        for first in range(len(meshes) - MESHES + 1):
            some = meshes[first : first + MESHES]
            sizes, exact = [size for size, _, _ in some], some[-1][2]
            for quantity in QUANTITIES:
                reference = getattr(exact, quantity)
                each = [measured.each[quantity] / reference - 1.0 for _, measured, _ in some]
                for part in range(PARTS):
                    values = [float(positions[part::PARTS].mean()) for positions in each]
                    uncertainty = convergence.uncertainty_at_order(sizes, values, ORDERS[quantity])
                    uncertainty += float(abs(values[-1] - each[-1].mean()))
                    covers[f"{quantity}, {stretch}, from mesh {first}, part {part}"] = abs(values[-1]) <= uncertainty
    missed = [case for case, covered in covers.items() if not covered]
    return AgreementRow(
        f"{name} inner on half-spaces, {len(covers)} exact cases of three meshes each",
        "share whose error exceeds its uncertainty",
        "1",
        0.0,
        f"Grid Convergence Index, and positions of the contact's edge; {references.HERTZ_SOURCE}",
        len(missed) / len(covers),
        None,
        100.0 * ALLOWED,
        "an expanded uncertainty covers 95 of 100 cases (ASME V&V 20-2009)",
        missed[0] if missed else None,
    )


def run(level: MeshLevel, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Each mesh aligned and twice misaligned; the error is the root mean square over the three."""
    groove = groove_contact(scene, "inner")
    problem = groove.problem(operating_loads(scene, "inner")[-1])
    exact = hertz(problem)
    sizes: list[float] = []
    cases: dict[object, list[tuple[float, Measured, ContactQuantities]]] = {}
    errors: dict[str, list[float]] = {name: [] for name in QUANTITIES}
    single: dict[str, list[float]] = {name: [] for name in QUANTITIES}
    for count in COUNTS[level]:
        results = []
        for stretch in STRETCHES:
            bodies = half_space_contact.condensed_bodies(problem, count, stretch, progress=progress)
            results.append(half_space_contact.solve_on(problem, bodies)[1])
            cases.setdefault(stretch, []).append((bodies.edge_element, results[-1], exact))
        sizes.append(bodies.edge_element)
        for name in QUANTITIES:
            reference = getattr(exact, name)
            means = np.array([getattr(each.mean, name) for each in results]) / reference - 1.0
            errors[name].append(float(np.sqrt(np.mean(means**2))))
            all_positions = np.concatenate([each.each[name] for each in results]) / reference - 1.0
            single[name].append(float(np.abs(all_positions).max()))
    rows = [_coverage(groove.name, cases)]
    for name in ("approach", "semi_major_axis", "semi_minor_axis", "max_pressure"):
        order = convergence.fitted_order(sizes, errors[name])
        rows.append(
            AgreementRow(
                f"{groove.name} inner, {COUNTS[level][0]} to {COUNTS[level][-1]} elements per semi-axis",
                f"shortfall of the order of {name}",
                "1",
                0.0,
                f"the order {ORDERS[name]} that the uncertainties of every contact assume; found {order:.2f}",
                max(0.0, ORDERS[name] - order),
                None,
                0.0,
                "the order must not fall below it",
            )
        )
    rows.append(
        AgreementRow(
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
    entry = half_space_contact.mesh_entry(bodies)
    return Findings(rows, entry, bodies.race.solver, series)


CHECK = Check(
    name="convergence_order",
    question="Do the errors fall with the element size at the order that the uncertainties assume?",
    kind=CheckKind.VERIFICATION,
    reference="the orders that the uncertainties assume: 1.5 in the approach, 2.5 in ellipse and pressure",
    tolerance="no shortfall of the order",
    run=run,
    largest_dofs=half_space_contact.largest_dofs,
)
