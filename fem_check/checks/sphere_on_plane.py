"""Does the circular contact give the textbook's values?"""

from __future__ import annotations

from math import pi

from fem_check.checks import groove_contacts
from fem_check.independent.contact_problem import QUANTITIES, ContactProblem, ElasticConstants
from fem_check.mechanics.half_space_contact import TOLERANCES, WHY
from fem_check.rows.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row

STEEL = ElasticConstants(elastic_modulus=208e9, poisson_ratio=0.3)
RADIUS = 10e-3
LOAD = 100.0


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """A steel ball of 20 mm on a steel plane under 100 N."""
    problem = ContactProblem("sphere on plane", 1.0 / RADIUS, 1.0 / RADIUS, STEEL, STEEL, LOAD)
    source = "Johnson 1985, eqs 4.22 to 4.24: a = (3QR/4E*)^(1/3), delta = a^2/R, p0 = 3Q/(2 pi a^2)"
    rows, found = groove_contacts.single(f"steel ball, R = 10 mm, Q = {LOAD:.0f} N", problem, level, progress, source)
    modulus = 1.0 / (2.0 * STEEL.compliance)
    a = (0.75 * LOAD * RADIUS / modulus) ** (1.0 / 3.0)
    p0 = 1.5 * LOAD / (pi * a * a)
    textbook = {"approach": a * a / RADIUS, "semi_major_axis": a, "semi_minor_axis": a, "max_pressure": p0}
    for row in list(rows):
        if row.quantity in textbook:
            rows.remove(row)
    head = [
        Row(
            f"steel ball, R = 10 mm, Q = {LOAD:.0f} N",
            name,
            QUANTITIES[name],
            value,
            source,
            found.value(name),
            100.0 * found.uncertainty(name) / value,
            TOLERANCES[level][name],
            WHY[level],
        )
        for name, value in textbook.items()
    ]
    # Textbooks print the largest shear as 0.31 p0 at 0.48 a for nu = 0.3, to two digits: half a unit of the last.
    reading = {"max_shear_stress": (0.31, p0, 0.005), "max_shear_depth": (0.48, a, 0.005)}
    for name, (ratio, scale, rounding) in reading.items():
        head.append(
            Row(
                "the same, over p0 and a",
                name,
                "1",
                ratio,
                "Johnson 1985, section 3.4: 0.31 p0 at 0.48 a (nu = 0.3)",
                found.value(name) / scale,
                100.0 * found.uncertainty(name) / (scale * ratio),
                100.0 * rounding / ratio,
                "half a unit of the printed last digit",
            )
        )
    return Findings(head + rows, groove_contacts.mesh_entry(found), found.bodies.race.solver)


CHECK = Check(
    name="sphere_on_plane",
    question="Does the finite-element contact of a sphere on a plane give the textbook's circle?",
    kind=Kind.VERIFICATION,
    reference="Hertz's circular contact in closed form (Johnson 1985)",
    tolerance="quick 0.3 %; release 0.02 % approach, 0.05 % semi-axes, pressure and shear",
    run=run,
    largest_dofs=groove_contacts.largest_dofs,
)
