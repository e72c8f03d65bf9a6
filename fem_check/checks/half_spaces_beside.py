"""The same contacts as half-spaces: beside what true bodies differ from Hertz, that his equations are solved right."""

from __future__ import annotations

from collections.abc import Sequence

from fem_check.independent.contact_problem import QUANTITIES
from fem_check.independent.references import HERTZ_SOURCE, hertz
from fem_check.mechanics import half_space_contact
from fem_check.rows.agreement import AgreementRow, MeshLevel, Progress
from fem_check.solids.true_contact import READ
from fem_check.solids.true_study import TrueContactStudy

ELEMENTS = (6, 8, 12)
"""Per semi-axis: the meshes on which deviation and uncertainty together are within 0.04 % (the record of the cost)."""
TOLERANCES = half_space_contact.TOLERANCES[MeshLevel.QUICK]
WHY = half_space_contact.WHY[MeshLevel.QUICK]
NAME = "half-spaces"


def rows(solved: Sequence[TrueContactStudy], progress: Progress) -> list[AgreementRow]:
    """Every contact against Hertz; those of a raceway, whose angles differ by degrees, share their meshes."""
    table = []
    for each in solved:
        problem = each.groove.problem(each.load)
        first = next(one for one in solved if one.groove.race_name == each.groove.race_name)
        progress(f"{each.groove.race_name}, half-spaces", solved.index(each) / len(solved))
        study = half_space_contact.mesh_study(problem, ELEMENTS, progress, first.groove.problem(first.load))
        exact = hertz(problem)
        for name in READ:
            reference = getattr(exact, name)
            table.append(
                AgreementRow(
                    f"{each.case}: {NAME}",
                    name,
                    QUANTITIES[name],
                    reference,
                    HERTZ_SOURCE,
                    study.value(name),
                    100.0 * study.uncertainty(name) / reference,
                    TOLERANCES[name],
                    WHY,
                )
            )
    return table
