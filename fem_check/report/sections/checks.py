"""A check's own section: question, verdict, notes, pictures, agreement, sources, and how to run it again."""

from __future__ import annotations

from typing import Any

from fem_check.report.evidence import Kept
from fem_check.report.figures.drawn import draw_all
from fem_check.report.rows import agreement, number
from qsbearing.documents.model import Block, Bullets, Facts, Paragraph, Remark, Section

Row = dict[str, Any]


def section(name: str, kept: Kept) -> Section:
    """All that a check's record says."""
    entry = kept.data
    status = "fail" if entry["verdict"] == "fail" else "pass"
    blocks: list[Block] = [
        Remark(f"{entry['question']} {entry['verdict'].capitalize()} at the {entry['level']} level.", status),
        Facts([*_facts(entry)]),
    ]
    gated = [row for row in entry["rows"] if row["verdict"] != "finding"]
    findings = [row for row in entry["rows"] if row["verdict"] == "finding"]
    for rows, caption in ((gated, "Against the reference"), (findings, "Findings, without a tolerance")):
        blocks += agreement(rows, caption) if rows else []
    blocks += [Paragraph(note) for note in entry["notes"]]
    blocks += draw_all(entry)
    blocks += _reasons(gated)
    return Section(name.replace("_", " ").capitalize(), [*blocks, kept.trace], f"check-{name.replace('_', '-')}")


def _facts(entry: dict[str, Any]) -> list[tuple[str, str]]:
    mesh, pairs = entry["mesh"], [("Kind", entry["kind"]), ("Scene", entry["scene"])]
    if mesh.get("dofs"):
        pairs.append(("Unknowns", f"{mesh['dofs']:,}, by {entry['solver']}"))
    if mesh.get("elements_per_semi_axis"):
        pairs.append(("Elements per semi-axis", str(mesh["elements_per_semi_axis"])))
    if mesh.get("file"):
        pairs.append(("Mesh", mesh["file"]))
    pairs.append(("Time", f"{entry['seconds']:.3g} s, {entry['peak_memory_MB']} MB"))
    return [*pairs, ("Reference", entry["reference"]), ("Tolerance", entry["tolerance"])]


def _reasons(rows: list[Row]) -> list[Block]:
    """Every source of a reference and every reason for a tolerance, once."""
    sources = dict.fromkeys(row["reference_source"] for row in rows)
    why = dict.fromkeys(f"{number(row['tolerance_percent'], 2)} %: {row['why_tolerance']}" for row in rows)
    return [
        block
        for heading, items in (("References:", sources), ("Why these tolerances:", why))
        if items
        for block in (Paragraph(heading), Bullets(list(items)))
    ]
