"""A bearing's contacts as tables of 80 columns: Hertz, half-spaces and true bodies side by side, a verdict for each."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from rich.console import Group
from rich.table import Table
from rich.text import Text

from fem_check.rows import row_text
from fem_check.rows.record import CheckRecord, RowRecord, deviation_percent, reach_percent
from qsbearing.documents.terminal import STYLES

SHOWN = {
    "approach": ("approach µm", 1e6), "semi_major_axis": ("a mm", 1e3), "semi_minor_axis": ("b mm", 1e3),
    "max_pressure": ("p0 MPa", 1e-6), "load": ("load N", 1.0), "angle": ("angle °", 1.0),
}  # fmt: skip
"""Of each quantity: name with unit, and one of its SI unit in that."""
WORDS = {"pass": "verified", "fail": "FAILED", "finding": "finding", "refused": "refused"}
MEANING = {
    "pass": "half-spaces agree with Hertz: {worst}, tolerance {tolerance}",
    "fail": "half-spaces DISAGREE with Hertz, or their uncertainty is too large: {worst}, tolerance {tolerance}",
    "finding": "the true bodies' difference from Hertz, with its uncertainty: {worst}",
}


def contact_tables(entry: CheckRecord) -> Group:
    """A table for each contact and what it says, then what the numbers rest on."""
    parts: list[Any] = [
        Text(f"{entry['scene']} ({entry['level']}): {entry['seconds']:.0f} s, {entry['peak_memory_MB']} MB", "bold"),
        counted(entry["rows"]),
    ]
    contacts: dict[str, list[RowRecord]] = {}
    for row in entry["rows"]:
        contacts.setdefault(row["case"].rpartition("; ")[0], []).append(row)
    for name, rows in contacts.items():
        parts += [Text(), Text(name, "bold"), _table(rows), *_summary(rows)]
    parts += [Text(), *(Text(note) for note in entry["notes"])]
    return Group(*parts)


def counted(rows: list[RowRecord]) -> Text:
    """How many numbers are verified, findings, refused; what failed first."""
    counts = {verdict: sum(row["verdict"] == verdict for row in rows) for verdict in ("fail", *WORDS)}
    told = [
        (f"{count} {WORDS[verdict]}{'s' if verdict == 'finding' and count > 1 else ''}", STYLES[verdict])
        for verdict, count in counts.items()
        if count
    ]
    return Text(", ").join([Text(*each) for each in told])


def _table(rows: list[RowRecord]) -> Table:
    by_method = {(row["case"].rpartition("; ")[2], row["quantity"]): row for row in rows}
    table = Table(box=None, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("", no_wrap=True)
    headings = ("\nHertz", "half-\nspace FE", "\n±", "", "true\nbodies FE", "\ndifference", "")
    for heading in headings:
        table.add_column(heading, justify="right" if heading else "left", no_wrap=True)
    for quantity, (label, size) in SHOWN.items():
        ideal, true = (by_method.get((method, quantity)) for method in ("half-spaces", "true bodies"))
        if ideal is None or true is None:
            continue
        table.add_row(
            label,
            _number(ideal["reference"], size),
            _number(ideal["found"], size),
            _difference(ideal)[1],
            _verdict(ideal),
            _number(true["found"], size),
            " ± ".join(_difference(true)) if true["found"] is not None else "",
            _verdict(true),
        )
    return table


def _number(value: float | None, size: float) -> str:
    return "–" if value is None else f"{value * size:#.5g}".rstrip(".")


def _difference(row: RowRecord) -> tuple[str, str]:
    """Difference and its uncertainty: per cent, of an angle degrees."""
    if row["found"] is None:
        return "", ""
    if row["quantity"] == "angle":
        scale = (abs(row["reference"]) or 1.0) / 100.0
        difference, uncertainty = deviation_percent(row) * scale, (row["uncertainty_percent"] or 0.0) * scale
        return f"{difference:+.2f}", f"{uncertainty:.2f}°"
    return f"{row['deviation_percent']:+.2f}", f"{row['uncertainty_percent']:.2f}%"


def _verdict(row: RowRecord) -> Text:
    return Text(WORDS[row["verdict"]], STYLES[row["verdict"]])


def _summary(rows: Iterable[RowRecord]) -> Iterable[Any]:
    """One line for each verdict that the contact has."""
    by_verdict: dict[str, list[RowRecord]] = {}
    for row in rows:
        by_verdict.setdefault(row["verdict"], []).append(row)
    for verdict, meaning in MEANING.items():
        judged = [row for row in by_verdict.get(verdict, []) if row["quantity"] != "angle"] or by_verdict.get(verdict)
        if not judged:
            continue
        worst = max(judged, key=reach_percent)
        said = f"{SHOWN[worst['quantity']][0].partition(' ')[0]} {' ± '.join(_difference(worst))}"
        limit = worst["tolerance_percent"]
        told = meaning.format(worst=said, tolerance=f"{row_text.number(limit, 2)}%" if limit else "none")
        yield _line(verdict, told)
    for reason, refused in _by_reason(by_verdict.get("refused", [])).items():
        yield _line("refused", f"{', '.join(refused)}: {reason}")


def _by_reason(rows: list[RowRecord]) -> dict[str, list[str]]:
    reasons: dict[str, list[str]] = {}
    for row in rows:
        method = row["case"].rpartition("; ")[2]
        reasons.setdefault(row["why_tolerance"], []).append(f"{SHOWN[row['quantity']][0].partition(' ')[0]} ({method})")
    return {
        reason: (names if len(names) < 3 else [f"{names[0]} and {len(names) - 1} more"])
        for reason, names in reasons.items()
    }


def _line(verdict: str, said: str) -> Table:
    table = Table(box=None, padding=(0, 1, 0, 0), pad_edge=False, show_header=False)
    table.add_column(width=9, no_wrap=True)
    table.add_column(overflow="fold")
    table.add_row(Text(WORDS[verdict], STYLES[verdict]), Text(said))
    return table
