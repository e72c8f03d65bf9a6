"""Mathematics: the equations against fifty digits, two derivations against each other, relations that must hold."""

from __future__ import annotations

from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.rows import as_read
from fem_check.rows.row_text import number, scientific
from qsbearing.documents.model import Badge, Block, Paragraph, Section, Table


def section(evidence: Evidence) -> Section:
    """The first level of evidence."""
    return Section(
        "Mathematics",
        [
            Paragraph(
                "Are the equations solved correctly? The references share no code with the package: the whole "
                "system of equations at fifty digits, closed forms derived a second time, and relations that hold "
                "for any numbers. This is verification: it says nothing about real bearings."
            ),
            Section("Fifty-digit solutions", _reference(evidence.reference)),
            Section("Relations", _relations(evidence.relations)),
        ],
    )


def _reference(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [
            missing("The comparison with the fifty-digit solutions", "python -m tests.verification.reference.table")
        ]
    rows = [
        [
            each["case"], as_read(each["what"]),
            *(scientific(each[name], 2) for name in ("loads", "angles", "displacements", "stiffness")),
            Badge(each["verdict"]),
        ]
        for each in kept.data["cases"]
    ]  # fmt: skip
    headings = ("scene", "difficulty", "loads", "angles", "displacements", "stiffness", "verdict")
    words = (
        f"{len(rows)} scenes, each solved by mpmath with four unknowns per ball. The table shows the largest relative "
        f"errors of `qsbearing.solve`; the tolerance is {number(kept.data['tolerance'])}: {kept.data['why_tolerance']}."
    )
    return [
        Paragraph(words.replace("`", "")),
        Table(headings, rows, "llrrrrl", "Relative errors", stack=True),
        kept.trace,
    ]


def _relations(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The outcome of the tests of relations", "python -m tests.relations")]
    rows = [
        [each["file"], each["what"], str(each["passed"]), str(each["failed"]), Badge(each["verdict"])]
        for each in kept.data["files"]
    ]
    words = (
        "Symmetries, limits, energy, derivatives, motion: each test checks a relation on random or named "
        "scenes, without numbers that were computed before."
    )
    table = Table(("file", "relation", "passed", "failed", "verdict"), rows, "llrrl", "Tests of relations", stack=True)
    return [Paragraph(words), table, kept.trace]
