"""The release run that made the records, step by step."""

from __future__ import annotations

from fem_check.report.evidence import Kept
from qsbearing.documents.model import Badge, Block, Cell, Paragraph, Section, Table


def section(kept: Kept) -> Section:
    """Its steps, with the time of each."""
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
    blocks: list[Block] = [
        Paragraph(told),
        Table(("step", "time, s", "error", "verdict"), rows, "lrll", "Steps", stack=True),
        kept.trace,
    ]
    return Section("Release run", blocks, "release-run")
