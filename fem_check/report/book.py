"""REPORT.md: the order of its sections; every number in it comes from a record."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from fem_check import records_store
from fem_check.cost import record
from fem_check.report import cost, figures, tables
from fem_check.report.tables import Entry

PICTURES = "pictures"

HEAD = """# Finite elements against Hertz

Built by `fem-check report` from the records in this folder; every number below is theirs.

*Verification* asks whether the finite elements solve the contact problem right: bodies are half-spaces, the gap a
parabola, Hertz is exact, and every per cent of deviation is an error. *Validation* asks how far Hertz is from a true
ball in a true groove: the deviation is the finding, and only what an independent method also gives has a tolerance.
Neither is a measurement.

Each value found is the mean over several positions of the contact's edge within an element; compared with the reference
is the worst of several meshes, one in the contact's proportions and others stretched out of them. The uncertainty is
that of the mesh: a sequence of sizes, positions of the edge, and alignment together. A *finding* has no tolerance.
"""


def write(records: Path, out: Path) -> Path:
    """Write REPORT.md and its pictures; returns its path."""
    entries = list(records_store.read_all(records).values())
    if not entries:
        raise records_store.RecordError(f"no records in {records}: run `fem-check run` first")
    out.mkdir(parents=True, exist_ok=True)
    kinds = {"verification": "Verification", "validation": "Validation"}
    order = {name: index for index, name in enumerate(kinds)}
    entries.sort(key=lambda entry: (order[entry["kind"]], entry["check"]))
    parts = [HEAD, "## Summary\n", tables.summary(entries) + "\n"]
    for kind, heading in kinds.items():
        chosen = [entry for entry in entries if entry["kind"] == kind]
        if chosen:
            parts.append(f"## {heading}\n")
            parts += [_section(entry, out) for entry in chosen]
    measured = record.read(records)
    if measured is not None:
        parts += cost.section(measured, out / PICTURES, PICTURES)
    path = out / "REPORT.md"
    handle, temporary = tempfile.mkstemp(dir=out, suffix=".part")
    with os.fdopen(handle, "w") as file:
        file.write("\n".join(parts))
    Path(temporary).chmod(0o644)
    Path(temporary).replace(path)
    return path


def _section(entry: Entry, out: Path) -> str:
    lines = [f"### {entry['check']}\n", f"{entry['question']} **{entry['verdict']}** ({entry['level']}).\n"]
    lines += [f"{note}\n" for note in entry["notes"]]
    lines += [f"![{caption}]({PICTURES}/{name})\n" for name, caption in figures.draw_all(entry, out / PICTURES)]
    lines += [tables.agreement(entry) + "\n", tables.sources(entry) + "\n"]
    return "\n".join(lines)
