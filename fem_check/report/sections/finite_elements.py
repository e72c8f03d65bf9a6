"""Finite elements: contacts of half-spaces, true bodies, one ball between elastic rings."""

from __future__ import annotations

from fem_check.checks import ALL, OPTIONAL
from fem_check.report.evidence import Evidence, missing
from fem_check.report.sections import checks, tolerances
from qsbearing.documents.guide import FOLDER
from qsbearing.documents.model import Block, Md, Paragraph, Picture, Section

VERIFICATION = (
    "Half-spaces and a parabolic gap, where Hertz is exact, so that every per cent of deviation is an error. A row "
    "passes if deviation and uncertainty together stay within a tolerance of one to two times that. Contacts of one "
    "shape are similar at every load: one row covers all the loads that it names, and says where it is worst."
)
COMPARISON = (
    "Bodies as they are: true grooves, elastic rings, the ball's own position. Here the deviation is the result, and "
    "has no tolerance; tolerances apply to the agreement of two methods, the uncertainty of the mesh, and limits. "
    "It is a comparison of two models, not a measurement."
)


STRESS = FOLDER / "sector_stress.png"
"""Made by `python -m fem_check.report.cutaway` from the quick record of the sector."""


def _cut_open() -> Picture:
    return Picture(
        STRESS.read_bytes(),
        "A ball between its two rings, cut open: stress below both contacts, and the pressure on the ball inside "
        "Hertz's ellipse.",
        "B218 under 17.8 kN of thrust at 10,000 rpm: von Mises' stress in the plane of symmetry, on a logarithmic "
        "scale, and the pressure at the inner raceway with Hertz's ellipse under the same load. Drawn by "
        "python -m fem_check.report.cutaway",
        "png",
        0.85,
    )


def section(evidence: Evidence) -> Section:
    """The level of the finite elements; a check without a record is said."""
    kinds: dict[str, list[Block]] = {"verification": [], "model comparison": []}
    for name, check in (ALL | OPTIONAL).items():
        if name in OPTIONAL and name not in evidence.checks:
            continue
        kept = evidence.checks.get(name)
        kinds[str(check.kind)].append(
            missing(f"Check {name}", f"fem-check run {name}") if kept is None else checks.section(name, kept)
        )
    return Section(
        "Finite elements",
        [
            Paragraph(
                Md(
                    "`fem_check` solves contacts and a sector of the bearing in three dimensions. Its own formulas "
                    "start from the drawing's dimensions and share no code with what they judge."
                )
            ),
            Section("Verification", [Paragraph(VERIFICATION), *kinds["verification"]], "fe-verification"),
            Section(
                "Limits of Hertz and of rigid rings, by finite elements",
                [Paragraph(COMPARISON), _cut_open(), *kinds["model comparison"]],
                "fe-limits",
            ),
            tolerances.section(evidence),
        ],
    )
