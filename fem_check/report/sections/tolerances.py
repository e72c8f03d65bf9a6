"""How wide each check's tolerances are, over what was found: a row that nothing could fail is no evidence."""

from __future__ import annotations

from statistics import median

from fem_check.report.evidence import Evidence
from fem_check.report.rows import quantity
from fem_check.rows.record import RowRecord, deviation_percent, reach_percent, tolerance_percent
from fem_check.rows.row_text import number
from qsbearing.documents.model import Cell, Md, Paragraph, Section, Table

WIDE = 10.0
"""Times the deviation and its uncertainty: as far as a wide tolerance is."""
ROUNDING = 1e-4
"""Per cent: rows with a tolerance up to this compare two evaluations at full precision, or counts. Their deviations are
rounding, of any size below, and a tolerance over rounding says nothing."""


def section(evidence: Evidence) -> Section:
    """A line for each check, and the rows with wide tolerances."""
    kept = {name: _judged(each.data["rows"]) for name, each in evidence.checks.items()}
    words = (
        "Of the judged rows of each check: those that compare two evaluations at full precision, or counts (tolerance "
        f"up to {number(ROUNDING)} %, whose deviations are rounding); of the others the tolerance over the deviation, "
        "and over deviation and uncertainty together, which both must fit into it. Deviations of exactly nothing are "
        f"left out of the middle values; the last column counts tolerances more than {WIDE:g} times as wide as both "
        "together."
    )
    headings = ("check", "judged", "rounding", "others", "over the deviation, median", "over both, median", "least",
                "wide")  # fmt: skip
    table = Table(headings, [_line(name, rows) for name, rows in kept.items()], "lrrrrrrr", "Tolerance over deviation")
    wide = [line for name, rows in kept.items() for line in _wide_lines(name, rows)]
    of_wide = ("check", "rows", "widest", "over both", "tolerance")
    caption = (
        f"Rows with tolerances more than {WIDE:g} times deviation and uncertainty, and why these are what they are"
    )
    some = [Table(of_wide, wide, "lrlrl", caption, stack=True)] if wide else []
    return Section("Tolerance over deviation", [Paragraph(words), table, *some], "tolerances")


def _wide_lines(name: str, rows: list[RowRecord]) -> list[list[Cell]]:
    """A line for each reason of a tolerance."""
    reasons: dict[str, list[RowRecord]] = {}
    for row in rows:
        if not _is_rounding(row) and _over_both(row) > WIDE:
            reasons.setdefault(row["why_tolerance"], []).append(row)
    lines: list[list[Cell]] = []
    for why, some in reasons.items():
        widest = max(some, key=_over_both)
        place = f"{widest['case']}: {quantity(widest['quantity'])}"
        lines.append([_link(name), str(len(some)), place, number(_over_both(widest), 2), why])
    return lines


def _judged(rows: list[RowRecord]) -> list[RowRecord]:
    return [row for row in rows if row["tolerance_percent"] is not None and row["deviation_percent"] is not None]


def _is_rounding(row: RowRecord) -> bool:
    return tolerance_percent(row) <= ROUNDING


def _over_both(row: RowRecord) -> float:
    both = reach_percent(row)
    return tolerance_percent(row) / both if both else float("inf")


def _link(name: str) -> Md:
    return Md(f"[{name}](#check-{name.replace('_', '-')})")


def _line(name: str, rows: list[RowRecord]) -> list[Cell]:
    others = [row for row in rows if not _is_rounding(row)]
    alone = [tolerance_percent(row) / abs(deviation_percent(row)) for row in others if row["deviation_percent"]]
    both = [_over_both(row) for row in others if row["deviation_percent"] or row["uncertainty_percent"]]
    told = (_middle(alone), _middle(both), min(both, default=None))
    shown = ["" if each is None else number(each, 2) for each in told]
    counts = [str(len(each)) for each in (rows, [row for row in rows if _is_rounding(row)], others)]
    return [_link(name), *counts, *shown, str(sum(_over_both(row) > WIDE for row in others))]


def _middle(values: list[float]) -> float | None:
    return median(values) if values else None
