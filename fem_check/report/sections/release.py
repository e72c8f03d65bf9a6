"""The release run that made the records, step by step."""

from __future__ import annotations

from fem_check.report.evidence import Kept
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Paragraph, Section, Table


def section(kept: Kept) -> Section:
    """Its steps, with the time of each."""
    steps = kept.data["steps"].items()
    rows: list[list[Cell]] = [
        [name, f"{done['seconds']:.1f}", Badge("error", "fail") if done["error"] else Badge("pass")]
        for name, done in steps
    ]
    errors = [f"{name}: {done['error']}" for name, done in steps if done["error"]]
    told = f"One run at commit {kept.data['commit']}, {kept.data['level']} level; pass: the step made its records."
    blocks: list[Block] = [
        Paragraph(told),
        Table(("step", "time, s", "verdict"), rows, "lrl", "Steps", stack=True),
        *([Bullets(errors)] if errors else []),
        kept.trace,
    ]
    return Section("Release run", blocks, "release-run")
