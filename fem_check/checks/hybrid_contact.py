"""Does a contact of two unlike materials (ceramic ball, steel ring) give Hertz's?"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import qsbearing
from fem_check.checks import groove_contacts
from fem_check.independent import references
from fem_check.independent.contact_problem import ElasticConstants
from fem_check.product.scenes import groove_contact, operating_loads
from fem_check.rows.agreement import EXAMPLE, Check, Findings, Kind, Level, Progress


def run(level: Level, progress: Progress, scene: str = EXAMPLE) -> Findings:
    """The inner groove with a ball of silicon nitride: two bodies, each with its own Poisson's ratio."""
    ceramic = qsbearing.SILICON_NITRIDE
    ball = ElasticConstants(float(np.asarray(ceramic.elastic_modulus)), float(np.asarray(ceramic.poisson_ratio)))
    groove = replace(groove_contact(scene, "inner"), ball=ball)
    problem = groove.problem(operating_loads(scene, "inner")[-1])
    case = f"{groove.name} inner, silicon nitride ball: Q = {problem.load:.0f} N"
    rows, found = groove_contacts.single(case, problem, level, progress, references.HERTZ_SOURCE)
    return Findings(rows, groove_contacts.mesh_entry(found), found.bodies.race.solver)


CHECK = Check(
    name="hybrid_contact",
    question="Ceramic ball in a steel groove: are two different materials combined correctly?",
    kind=Kind.VERIFICATION,
    reference="Hertz in closed form with 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2",
    tolerance="quick 0.3 %; release 0.02 % approach, 0.05 % semi-axes, pressure and shear",
    run=run,
    largest_dofs=groove_contacts.largest_dofs,
)
