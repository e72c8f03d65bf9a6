"""A check's own section: question, verdict, notes, pictures, agreement, sources, and how to run it again."""

from __future__ import annotations

from typing import Any

from fem_check import row_text
from fem_check.report.evidence import Kept
from fem_check.report.figures.drawn import draw_all
from fem_check.report.rows import agreement
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
    gated = [row for row in entry["rows"] if row["verdict"] not in ("finding", "refused")]
    findings = [row for row in entry["rows"] if row["verdict"] == "finding"]
    for rows, caption in ((gated, "Against the reference"), (findings, "Findings, without a tolerance")):
        blocks += agreement(rows, caption) if rows else []
    refused = dict.fromkeys(
        f"{row['case']}: {row['why_tolerance']}" for row in entry["rows"] if row["verdict"] == "refused"
    )
    blocks += [Paragraph("Refused:"), Bullets(list(refused))] if refused else []
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
    """Every source of a reference once, and every reason with the tolerances that it stands for."""
    sources = dict.fromkeys(row["reference_source"] for row in rows)
    limits: dict[str, dict[str, None]] = {}
    for row in rows:
        limits.setdefault(row["why_tolerance"], {})[row_text.of_row(row).tolerance] = None
    why = [f"{', '.join(each)}: {reason}" for reason, each in limits.items()]
    return [
        block
        for heading, items in (("References:", list(sources)), ("Why these tolerances:", why))
        if items
        for block in (Paragraph(heading), Bullets(list(items)))
    ]
