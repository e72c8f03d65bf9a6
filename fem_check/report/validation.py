"""The validation report: verdict, what it rests on, and the sections in their order; everything in it is on record."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from fem_check.checks import ALL
from fem_check.report.evidence import Evidence, Kept
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
    robustness,
)
from qsbearing.documents.model import Badge, Block, Cell, Document, Facts, Md, Remark

NOT_RECORDED = "not recorded"


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
            claims.section(evidence),
            mathematics.section(evidence),
            book.computed(evidence),
            finite_elements.section(evidence),
            book.measured(evidence),
            robustness.section(evidence),
            costs.section(evidence),
            errata.section(evidence),
            limits.section(evidence),
            release.section(evidence),
            previous.section(evidence, before),
            every_row.section(evidence),
            every_row.commands(evidence),
        ],
        Md(
            "How far the quasi-static model of angular-contact ball bearings can be trusted, and how that was found "
            "out. Every number is from a record; each section names its record, the command that makes it anew, and "
            "what it was made with."
        ),
        [_verdict(evidence), *_mixed(evidence), Facts(_facts(evidence))],
    )


def _verdict(evidence: Evidence) -> Remark:
    """In a sentence: what failed, what is missing, or that all passed."""
    rows = [row for kept in (*evidence.checks.values(), *evidence.book.values()) for row in kept.data["rows"]]
    tally = counts(rows)
    failed = [
        name for name, kept in (*evidence.checks.items(), *evidence.book.items()) if kept.data["verdict"] == "fail"
    ]
    absent = [name for name in ALL if name not in evidence.checks] + ([] if evidence.book else ["the validation book"])
    said = f"{tally['pass']} rows of agreement pass, {tally['fail']} fail, {tally['finding']} are findings."
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


def _mixed(evidence: Evidence) -> list[Block]:
    """Said where records are not of one state of the source."""
    records = list(evidence.all())
    commits = {kept.provenance["commit"] for kept in records if kept.provenance.get("commit")}
    unknown = [kept for kept in records if not kept.provenance.get("commit")]
    said = []
    if len(commits) + bool(unknown) > 1:
        said.append(f"The records come from {len(commits)} commit{'s' if len(commits) > 1 else ''}.")
    if unknown:
        names = ", ".join(kept.name for kept in unknown)
        said.append(
            f"{len(unknown)} of {len(records)} records do not state their commit, so that their numbers cannot be "
            f"traced to a version: {names}."
        )
    if any(kept.provenance.get("dirty") for kept in records):
        said.append("Some were made with changes that were not committed.")
    return [Remark(" ".join(said), "warning")] if said else []


def _facts(evidence: Evidence) -> list[tuple[str, Cell]]:
    records = list(evidence.all())
    found: Sequence[dict[str, Any]] = [kept.provenance for kept in records if kept.provenance]
    dates = sorted(each["date"] for each in found)
    machines = dict.fromkeys(
        f"{each['machine']['processor']}, {each['machine']['cores']} cores, {each['machine']['memory_GB']:g} GB, "
        f"{each['machine']['system']}, Python {each['machine']['python']}"
        for each in found
    )
    return [
        ("Version", _listed(kept.version for kept in records)),
        ("Commit", _listed((each["commit"] or "")[:12] for each in found)),
        ("Dates", f"{dates[0]} to {dates[-1]}" if dates else NOT_RECORDED),
        ("Machine", "; ".join(machines) or NOT_RECORDED),
        ("Packages", _packages(records)),
        ("Level of the checks", _listed(kept.data["level"] for kept in evidence.checks.values())),
        ("Scene", _listed(kept.data["scene"] for kept in evidence.checks.values())),
        ("Records", f"{len(records)} files"),
        ("Checks that fail", _failing(evidence)),
    ]


def _listed(values: Any) -> str:
    return ", ".join(dict.fromkeys(str(value) for value in values if value)) or NOT_RECORDED


def _packages(records: Sequence[Kept]) -> str:
    """Name and versions of all packages that records name."""
    found: dict[str, dict[str, None]] = {}
    for kept in records:
        for name, version in (kept.provenance.get("packages") or kept.data.get("versions") or {}).items():
            if name not in ("qsbearing", "source", "python"):
                found.setdefault(name, {})[version] = None
    return ", ".join(f"{name} {' and '.join(versions)}" for name, versions in found.items()) or NOT_RECORDED


def _failing(evidence: Evidence) -> Cell:
    failed = sum(kept.data["verdict"] == "fail" for kept in evidence.checks.values())
    return Badge(f"{failed} of {len(evidence.checks)}", "fail" if failed else "pass")
