"""Does `qsbearing.model.contact.hertz`, used by the bearing model, agree with the references from a circle to a/b =
50?"""

from __future__ import annotations

import qsbearing
from fem_check.checks.other_contacts import slender_problem
from fem_check.independent import references
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem
from fem_check.rows.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row, collapsed
from qsbearing.model.contact.hertz import effective_modulus

# Both derivations claim full precision; each loses a few digits of 16 in its root finding.
CLOSED_FORM_TOLERANCE = 1e-8
SHAPES = (1.0, 1.001, 2.0, 5.0, 10.0, 20.0, 50.0)


def of_qsbearing(problem: ContactProblem) -> dict[str, float]:
    """The contact as `qsbearing` computes it."""
    modulus = effective_modulus(
        problem.ball.elastic_modulus,
        problem.ball.poisson_ratio,
        problem.race.elastic_modulus,
        problem.race.poisson_ratio,
    )
    contact = qsbearing.point_contact(problem.load, problem.curvature_x, problem.curvature_y, modulus)
    shear = qsbearing.subsurface_shear(contact.ellipticity, problem.race.poisson_ratio)
    return {
        "approach": contact.approach,
        "semi_major_axis": contact.semi_major_axis,
        "semi_minor_axis": contact.semi_minor_axis,
        "max_pressure": contact.max_pressure,
        "max_shear_stress": shear.stress * contact.max_pressure,
        "max_shear_depth": shear.depth * contact.semi_minor_axis,
    }


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """Closed form against closed form; finite elements judge the model's own contacts (`solution_contacts`)."""
    rows = []
    for shape in SHAPES:
        problem = slender_problem(shape)
        exact, found = references.hertz(problem), of_qsbearing(problem)
        for name, unit in QUANTITIES.items():
            tolerance = CLOSED_FORM_TOLERANCE
            why = "two derivations at full precision, some digits lost in root finding"
            if name == "max_shear_stress":
                tolerance, why = 1e-7, "one of the two integrates numerically"
            if name == "max_shear_depth":
                # A maximum found to 1e-8 of its value is found to the square root of that in its position.
                tolerance, why = 1e-4, "at a maximum the position is known to the square root of the value's precision"
            rows.append(
                Row(
                    f"a/b = {shape:g}",
                    name,
                    unit,
                    getattr(exact, name),
                    references.HERTZ_SOURCE if not name.startswith("max_shear") else references.SHEAR_SOURCE,
                    found[name],
                    None,
                    100.0 * tolerance,
                    why,
                )
            )
    return Findings(collapsed(rows, f"a/b = {SHAPES[0]:g} to {SHAPES[-1]:g}, {len(SHAPES)} shapes"))


CHECK = Check(
    name="hertz_formula",
    question="Does qsbearing.model.contact.hertz agree with an independent closed form, from a circle to a/b = 50?",
    kind=Kind.VERIFICATION,
    reference="Hertz in Carlson's integrals; Boussinesq's stresses integrated",
    tolerance="1e-8 (shear 1e-7, its depth 1e-4)",
    run=run,
    largest_dofs=lambda level: 0,
)
