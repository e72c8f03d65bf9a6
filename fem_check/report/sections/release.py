"""The release run that made the records, step by step."""

from __future__ import annotations

from fem_check.report.evidence import Evidence
from qsbearing.documents.model import Badge, Block, Cell, Md, Paragraph, Section, Table


def section(evidence: Evidence) -> Section:
    """Its steps, with the time of each."""
    kept = evidence.gate
    if kept is None:
        words = Md("These records were not made by one release run, `python -m fem_check release`.")
        return Section("Release run", [Paragraph(words)], "release-run")
    rows: list[list[Cell]] = [
        [
            name,
            f"{done['seconds']:.1f}",
            done["error"] or "",
            Badge("error", "fail") if done["error"] else Badge("pass"),
        ]
        for name, done in kept.data["steps"].items()
    ]
    told = f"One run at commit {kept.data['commit']}, {kept.data['level']} level; pass: the step made its records."
    blocks: list[Block] = [Paragraph(told), Table(("step", "s", "why not", ""), rows, "lrll"), kept.trace]
    return Section("Release run", blocks, "release-run")
