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

*Verification* asks whether equations are solved right: the reference is exact, or another method's result for the same
problem, and every per cent of deviation is an error. A row passes if deviation and uncertainty together stay within the
tolerance. *Validation* of Hertz asks how far he is from a true ball in a true groove: the deviation is the finding, and
has no tolerance. Neither is a measurement.

Each value found is the mean over several positions of the contact's edge within an element. The uncertainty is that of
the mesh: a sequence of sizes, positions of the edge, and alignment together. Contacts of one shape are similar at every
load: one row stands for all loads that it names, and where they differ it shows the worst and says which.
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
        parts.append(f"## {heading}\n")
        parts += [section for entry in entries if (section := _section(entry, kind, out))]
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


def _section(entry: Entry, kind: str, out: Path) -> str:
    """What a check says of one kind; of a validation, two methods compared with each other are verification."""
    if kind == entry["kind"]:
        rows = entry["rows"] if kind == "verification" else [r for r in entry["rows"] if r["verdict"] == "finding"]
        lines = [f"### {entry['check']}\n", f"{entry['question']} **{entry['verdict']}** ({entry['level']}).\n"]
        lines += [f"{note}\n" for note in entry["notes"]]
        lines += [f"![{caption}]({PICTURES}/{name})\n" for name, caption in figures.draw_all(entry, out / PICTURES)]
    else:
        rows = [row for row in entry["rows"] if row["verdict"] != "finding"] if kind == "verification" else []
        lines = [f"### {entry['check']}: method against method\n"] if rows else []
    if rows:
        lines += [tables.agreement(rows) + "\n", tables.sources(rows) + "\n"]
    return "\n".join(lines)
