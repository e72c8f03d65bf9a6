"""Contacts that the meshes were not tuned on: a slender ellipse (k = 20), and another bearing."""

from __future__ import annotations

from fem_check.checks import groove_contacts
from fem_check.independent import references
from fem_check.independent.contact_problem import ContactProblem, ElasticConstants
from fem_check.product.scenes import groove_contact
from fem_check.rows.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress, Row

STEEL = ElasticConstants(elastic_modulus=208e9, poisson_ratio=0.3)
SLENDER = 20.0
OTHER_BEARING, OTHER_LOAD = "7210c", 250.0


def slender_problem(ellipticity: float, load: float = 1000.0) -> ContactProblem:
    """A steel contact with a/b as given and 10 mm of radius along its short axis."""
    ratio = references.curvature_ratio(1.0 / ellipticity)
    return ContactProblem(f"k = {ellipticity:g}", ratio / 10e-3, 1.0 / 10e-3, STEEL, STEEL, load)


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """An ellipse twenty times as long as wide; at the release level another bearing's outer groove too.

    Its ellipse, k = 7.8, lies between the example's outer and inner one, 6.9 and 8.2, which the quick level has anyway.
    """
    cases = {f"a/b = {SLENDER:g}: Q = 1000 N": slender_problem(SLENDER)}
    if level is Level.RELEASE:
        other = groove_contact(OTHER_BEARING, "outer").problem(OTHER_LOAD)
        cases = {f"{other.name} groove: Q = {OTHER_LOAD:.0f} N": other, **cases}
    rows: list[Row] = []
    for case, problem in cases.items():
        more, found = groove_contacts.single(case, problem, level, progress, references.HERTZ_SOURCE)
        rows += more
    return Findings(rows, groove_contacts.mesh_entry(found), found.bodies.race.solver)


CHECK = Check(
    name="other_contacts",
    question="Does the agreement hold for contacts that the meshes were not tuned on?",
    kind=Kind.VERIFICATION,
    reference="Hertz in closed form",
    tolerance="quick 0.3 %; release 0.02 % approach, 0.05 % semi-axes, pressure and shear",
    run=run,
    largest_dofs=groove_contacts.largest_dofs,
)
