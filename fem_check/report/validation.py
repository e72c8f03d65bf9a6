"""The validation report: verdict, what it rests on, and the sections in their order; everything in it is on record."""

from __future__ import annotations

from dataclasses import replace

from fem_check.checks import ALL
from fem_check.report.evidence import Evidence
from fem_check.report.rows import counts
from fem_check.report.sections import (
    book,
    claims,
    costs,
    errata,
    every_row,
    finite_elements,
    limits,
    mathematics,
    previous,
    release,
    reproducing,
    robustness,
)
from fem_check.report.sections.reproducing import NOT_RECORDED, listed
from qsbearing.documents.model import Badge, Cell, Document, Facts, Md, Remark


def document(evidence: Evidence, before: Evidence | None = None) -> Document:
    """The whole report.

    Args:
        evidence: all that is on record.
        before: of an earlier release, to be compared with.
    """
    return Document(
        "qsbearing and fem_check",
        "Validation report",
        [
            reproducing.section(evidence),
            claims.section(evidence),
            mathematics.section(evidence),
            book.computed(evidence),
            finite_elements.section(evidence),
            book.measured(evidence),
            robustness.section(evidence),
            costs.section(evidence),
            errata.section(evidence),
            limits.section(evidence),
            *([release.section(evidence.gate)] if evidence.gate else []),
            *([previous.section(evidence, before)] if before else []),
            every_row.section(evidence),
        ],
        Md(
            "How far the quasi-static model of angular-contact ball bearings can be trusted, and the evidence for it. "
            "Every number comes from a record; each section names its record, the command that makes it, and "
            "the version that made it."
        ),
        [verdict(evidence), Facts(_facts(evidence))],
        is_numbered=True,
    )


def for_paper(whole: Document) -> Document:
    """The report without its table of every row, which is too long for paper; pictures are not drawn again."""
    return replace(whole, sections=whole.sections[:-1])


def verdict(evidence: Evidence) -> Remark:
    """In a sentence: failures, missing records, or that all passed."""
    rows = [row for kept in (*evidence.checks.values(), *evidence.book.values()) for row in kept.data["rows"]]
    tally = counts(rows)
    failed = [
        name for name, kept in (*evidence.checks.items(), *evidence.book.items()) if kept.data["verdict"] == "fail"
    ]
    absent = [name for name in ALL if name not in evidence.checks] + ([] if evidence.book else ["the validation book"])
    said = (
        f"Of {len(rows)} rows of agreement, each one quantity compared with its reference, {tally['pass']} pass, "
        f"{tally['fail']} fail, and {tally['finding']} are findings, which have no tolerance."
    )
    unmet = claims.unmet(evidence)
    if unmet:
        said = f"{' '.join(f'Not met: {each}' for each in unmet)} {said}"
    if failed:
        return Remark(f"Fail: {', '.join(failed)}. {said}", "fail")
    if unmet:
        return Remark(said, "fail")
    if absent:
        return Remark(f"Passed as far as it is on record; not on record: {', '.join(absent)}. {said}", "warning")
    return Remark(f"Pass: {len(evidence.checks)} checks and {len(evidence.book)} published cases. {said}", "pass")


def _facts(evidence: Evidence) -> list[tuple[str, Cell]]:
    records = list(evidence.all())
    dates = sorted(kept.provenance["date"] for kept in records if kept.provenance)
    return [
        ("Version", listed(kept.version for kept in records)),
        ("Dates", f"{dates[0][:10]} to {dates[-1][:10]}" if dates else NOT_RECORDED),
        ("Level of the checks", listed(kept.data["level"] for kept in evidence.checks.values())),
        ("Scene", listed(kept.data["scene"] for kept in evidence.checks.values())),
        ("Records", f"{len(records)} files"),
        ("Checks that fail", _failing(evidence)),
    ]


def _failing(evidence: Evidence) -> Cell:
    failed = sum(kept.data["verdict"] == "fail" for kept in evidence.checks.values())
    return Badge(f"{failed} of {len(evidence.checks)}", "fail" if failed else "pass")
