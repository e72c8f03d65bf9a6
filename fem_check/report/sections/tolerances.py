"""How wide each check's tolerances are, over what was found: a row that nothing could fail is no evidence."""

from __future__ import annotations

from statistics import median
from typing import Any

from fem_check.report.evidence import Evidence
from fem_check.rows.row_text import number
from qsbearing.documents.model import Cell, Md, Paragraph, Section, Table

WIDE = 10.0
"""Times the deviation and its uncertainty: as far as a wide tolerance is."""


def section(evidence: Evidence) -> Section:
    """A line for each check."""
    rows = [_line(name, kept.data["rows"]) for name, kept in evidence.checks.items()]
    words = (
        "Of the judged rows of each check: the tolerance over the deviation, and over deviation and uncertainty "
        "together, which both must fit into it. Deviations of exactly nothing are left out of the middle values; the "
        f"last column counts tolerances more than {WIDE:g} times as wide as both together."
    )
    headings = ("check", "judged", "over the deviation, median", "over both, median", "least", "wide")
    table = Table(headings, rows, "lrrrrr", "Tolerance over deviation")
    return Section("Tolerance over deviation", [Paragraph(words), table], "tolerances")


def _line(name: str, rows: list[dict[str, Any]]) -> list[Cell]:
    judged = [row for row in rows if row["tolerance_percent"] and row["deviation_percent"] is not None]
    over = [
        (row["tolerance_percent"], abs(row["deviation_percent"]), row["uncertainty_percent"] or 0.0) for row in judged
    ]
    alone = [tolerance / deviation for tolerance, deviation, _ in over if deviation > 0.0]
    both = [tolerance / (deviation + doubt) for tolerance, deviation, doubt in over if deviation + doubt > 0.0]
    told = (_middle(alone), _middle(both), min(both, default=None))
    shown = ["" if each is None else number(each, 2) for each in told]
    wide = len(judged) - sum(each <= WIDE for each in both)
    return [Md(f"[{name}](#check-{name.replace('_', '-')})"), str(len(judged)), *shown, str(wide)]


def _middle(values: list[float]) -> float | None:
    return median(values) if values else None
