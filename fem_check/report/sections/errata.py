"""Errors found in the source paper, and what each does to an answer."""

from __future__ import annotations

from fem_check.report.evidence import Evidence, missing
from qsbearing.documents.model import Cell, Paragraph, Section, Table


def section(evidence: Evidence) -> Section:
    """A row for each error: printed, correct, effect."""
    kept = evidence.errata
    if kept is None:
        return Section("Errors of the source", [missing("What they do", "errata")], "errata")
    record = kept.data
    rows: list[list[Cell]] = [
        [each[name] for name in ("place", "printed", "correct", "shows", "effect")] for each in record["errors"]
    ]
    words = (
        f"{record['source']}. Each error was put back alone into equations written out plainly for this purpose, and "
        f"solved: {record['scene']}. As corrected: {record['corrected']}."
    )
    table = Table(
        ("place", "printed", "correct", "evidence", "effect on the results"), rows, "lllll", "Errors", stack=True
    )
    return Section("Errors of the source", [Paragraph(words), table, kept.trace], "errata")
