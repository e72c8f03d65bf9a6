"""Why each limit of a check is what it is, how wide it is over what was found, and what else its record says."""

from __future__ import annotations

from fem_check.report.evidence import Evidence
from fem_check.report.rows import as_read, reasons
from fem_check.report.sections import tolerances
from qsbearing.documents.model import Bullets, Cell, Md, Paragraph, RowGroup, Section, Table

WORDS = Md(
    "The reason of each limit, as it is kept with each row. Reasons and references of single rows, and those of "
    "published cases, are in `validation_report.csv` and `validation_report.json` beside this report; `fem-check book` "
    "writes a page with each case whole. The HTML form of this report has the assumptions and notes of the checks too."
)


def section(evidence: Evidence) -> Section:
    """Reasons and widths."""
    lines: list[list[Cell] | RowGroup] = []
    for name, kept in evidence.checks.items():
        entry = kept.data
        lines.append(RowGroup(f"{name}: {as_read(entry['reference'])}. Limits: {as_read(entry['tolerance'])}"))
        lines += reasons([row for row in entry["rows"] if row["verdict"] != "finding"])
    limits = Table(("quantity", "limit", "reason"), lines, "lll", "Limits of the checks", stack=True)
    return Section("Annex: limits and their reasons", [Paragraph(WORDS), limits, tolerances.section(evidence)], "annex")


def notes(evidence: Evidence) -> Section:
    """Assumptions and remarks of the checks, as their records have them."""
    said = [f"{name}: {as_read(note)}" for name, kept in evidence.checks.items() for note in kept.data["notes"]]
    return Section("Annex: assumptions and notes of the checks", [Bullets(said or ["None."])], "notes")
