"""Mathematics: the equations against fifty digits, and relations that hold for any numbers."""

from __future__ import annotations

from fem_check.report.evidence import Evidence, Kept, missing
from fem_check.report.questions import MEASURES
from fem_check.rows.row_text import number, scientific
from qsbearing.documents.model import Badge, Block, Callout, Cell, Md, Paragraph, Section, Table

MOST = 5


def section(evidence: Evidence) -> Section:
    """The first level of evidence."""
    words = (
        "The references share no code with the package: the whole system of equations at fifty digits, and relations "
        "that hold for any numbers. This is verification and says nothing about real bearings."
    )
    blocks = [Paragraph(words), *_reference(evidence.reference), *_relations(evidence.relations)]
    return Section("Mathematics", blocks, "mathematics")


def _reference(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The comparison with the fifty-digit solutions", "reference")]
    cases = sorted(kept.data["cases"], key=lambda each: (each["verdict"] == "pass", -_error(each)))
    good = sum(each["verdict"] == "pass" for each in cases)
    rows: list[list[Cell]] = [
        [each["case"], each["what"], *(scientific(each[name], 2) for name in MEASURES), Badge(each["verdict"])]
        for each in cases[:MOST]
    ]
    said = (
        f"**{good} of {len(cases)} scenes agree with their fifty-digit solutions; the largest relative error is "
        f"{scientific(_error(cases[0]), 2)}** (limit {number(kept.data['tolerance'])}: {kept.data['why_tolerance']})."
    )
    caption = f"Relative errors: the worst {len(rows)} of {len(cases)} scenes"
    return [
        Callout(Md(said), "pass" if good == len(cases) else "fail"),
        Table(("scene", "difficulty", *MEASURES, "verdict"), rows, "llrrrrl", caption, stack=True),
        kept.trace,
    ]


def _error(case: dict[str, float]) -> float:
    return max(case[name] for name in MEASURES)


def _relations(kept: Kept | None) -> list[Block]:
    if kept is None:
        return [missing("The outcome of the tests of relations", "relations")]
    files = kept.data["files"]
    passed, failed = (sum(each[name] for each in files) for name in ("passed", "failed"))
    bad = ", ".join(each["file"] for each in files if each["failed"])
    said = (
        f"**{passed} of {passed + failed} tests of relations pass**: symmetries, limits, energy, derivatives, motion."
    )
    return [Callout(Md(f"{said} Failing: {bad}." if bad else said), "fail" if failed else "pass"), kept.trace]
