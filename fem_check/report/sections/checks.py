"""A check's own section: question, verdict, pictures, agreement with its footnotes, notes, and how to run it again."""

from __future__ import annotations

from typing import Any

from fem_check.report.evidence import Kept
from fem_check.report.figures.drawn import draw_all
from fem_check.report.rows import agreement, as_read
from qsbearing.documents.model import Block, Facts, Paragraph, Remark, Section


def section(name: str, kept: Kept) -> Section:
    """All that a check's record says."""
    entry, title = kept.data, name.replace("_", " ").capitalize()
    status = "fail" if entry["verdict"] == "fail" else "pass"
    blocks: list[Block] = [
        Remark(f"{as_read(entry['question'])} {entry['verdict'].capitalize()} at the {entry['level']} level.", status),
        Facts([*_facts(entry)]),
        *draw_all(name, entry),
    ]
    findings = [row for row in entry["rows"] if row["verdict"] == "finding"]
    judged = [row for row in entry["rows"] if row["verdict"] != "finding"]
    for rows, caption in ((judged, "Against the reference"), (findings, "Findings, without a tolerance")):
        blocks += agreement(rows, f"{title}. {caption}") if rows else []
    blocks += [Paragraph(as_read(note)) for note in entry["notes"]]
    return Section(title, [*blocks, kept.trace], f"check-{name.replace('_', '-')}")


def _facts(entry: dict[str, Any]) -> list[tuple[str, str]]:
    mesh, pairs = entry["mesh"], [("Kind", entry["kind"]), ("Scene", entry["scene"])]
    if mesh.get("dofs"):
        pairs.append(("Unknowns", f"{mesh['dofs']:,}, by {entry['solver']}"))
    if mesh.get("elements_per_semi_axis"):
        pairs.append(("Elements per semi-axis", str(mesh["elements_per_semi_axis"])))
    if mesh.get("file"):
        pairs.append(("Mesh", mesh["file"]))
    seconds = f"{entry['seconds']:,.0f}" if entry["seconds"] >= 100.0 else f"{entry['seconds']:.3g}"
    pairs.append(("Time", f"{seconds} s, {entry['peak_memory_MB']:,} MB"))
    return [*pairs, ("Reference", as_read(entry["reference"])), ("Tolerance", as_read(entry["tolerance"]))]
