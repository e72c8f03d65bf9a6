"""How to make the records and the report again, and where and with what they were made."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from fem_check.report.evidence import Evidence, Kept
from qsbearing.documents.model import Block, Cell, Code, Facts, Md, Paragraph, Remark, Section

NOT_RECORDED = "not recorded"


def section(evidence: Evidence) -> Section:
    """Commands, machines, packages, and records whose commit is not known."""
    levels = dict.fromkeys(kept.data["level"] for kept in evidence.checks.values())
    lines = [*(f"fem-check run --level {level} --out X" for level in levels), "fem-check report --records X --out DIR"]
    return Section(
        "Reproducing this report",
        [
            Paragraph(
                Md(
                    "The report formats records and computes nothing. Beside it, `validation_report.csv` and "
                    "`validation_report.json` have every row for other programs, with references, tolerances and "
                    "reasons. The finite elements, and the report from the records that they leave, are made by:"
                )
            ),
            Code("\n".join(lines), "sh"),
            *_others(evidence),
            Facts(_facts(evidence)),
            *_mixed(evidence),
        ],
        "reproducing",
    )


def _facts(evidence: Evidence) -> list[tuple[str, Cell]]:
    records = list(evidence.all())
    found: Sequence[dict[str, Any]] = [kept.provenance for kept in records if kept.provenance]
    machines = dict.fromkeys(
        f"{each['machine']['processor']}, {each['machine']['cores']} cores, {each['machine']['memory_GB']:g} GB, "
        f"{each['machine']['system']}, Python {each['machine']['python']}"
        for each in found
    )
    return [
        ("Machines", "; ".join(machines) or NOT_RECORDED),
        ("Packages", _packages(records)),
        ("Commits", listed((each["commit"] or "")[:12] for each in found)),
    ]


def listed(values: Any) -> str:
    """Each value once."""
    return ", ".join(dict.fromkeys(str(value) for value in values if value)) or NOT_RECORDED


def _packages(records: Sequence[Kept]) -> str:
    """Name and versions of all packages that records name."""
    found: dict[str, dict[str, None]] = {}
    for kept in records:
        for name, version in (kept.provenance.get("packages") or kept.data.get("versions") or {}).items():
            if name not in ("qsbearing", "source", "python"):
                found.setdefault(name, {})[version] = None
    return ", ".join(f"{name} {' and '.join(versions)}" for name, versions in found.items()) or NOT_RECORDED


def _mixed(evidence: Evidence) -> list[Block]:
    """A warning where records are not of one commit."""
    records = list(evidence.all())
    commits = {kept.provenance["commit"] for kept in records if kept.provenance.get("commit")}
    unknown = [kept for kept in records if not kept.provenance.get("commit")]
    said = []
    if len(commits) + bool(unknown) > 1:
        said.append(f"The records come from {len(commits)} commit{'s' if len(commits) > 1 else ''}.")
    if unknown:
        names = ", ".join(kept.name for kept in unknown)
        said.append(
            f"{len(unknown)} of {len(records)} records do not name their commit, so that their numbers cannot be "
            f"traced to a version: {names}."
        )
    if any(kept.provenance.get("dirty") for kept in records):
        said.append("Some were made with changes that were not committed.")
    return [Remark(" ".join(said), "warning")] if said else []


def _others(evidence: Evidence) -> list[Block]:
    """The commands of the other records, by where they run; one makes all published cases."""
    seen = {
        re.sub("^(fem-check book) .*", r"\1", kept.command): kept
        for kept in evidence.all()
        if not kept.command.startswith("fem-check run ")
    }
    found: list[Block] = []
    for words, inside in (
        ("The other records:", False),
        ("In a checkout of the repository, because these need files that an installed package does not have:", True),
    ):
        lines = [command for command, kept in seen.items() if kept.needs_checkout == inside]
        if lines:
            found += [Paragraph(words), Code("\n".join(lines), "sh")]
    return found
