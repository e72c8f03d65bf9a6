"""Whether records are whole: of this commit, judged by their own rows."""

from __future__ import annotations

from dataclasses import fields

from fem_check.rows.agreement import AgreementRow
from fem_check.rows.record import Record
from qsbearing.documents.numbers import plain

NAMES = [field.name for field in fields(AgreementRow)]


def of_provenance(record: Record, commit: str) -> list[str]:
    """What speaks against a record being this commit's."""
    made = record.get("provenance")
    if not made:
        return ["it does not say which commit it was made from: not recorded"]
    if made["commit"] != commit:
        return [f"it was made from commit {str(made['commit'])[:12]}, not {commit[:12]}: records of several commits"]
    return [f"it was made from commit {commit[:12]} with changes that are not committed"] if made["dirty"] else []


def of_rows(record: Record, digits: int | None = None) -> list[str]:
    """Rows out of tolerance, and rows that contradict themselves: deviation and verdict follow from the rest.

    Args:
        digits: to which the record's numbers are rounded; None where they are whole.
    """
    wrong = [] if record["rows"] else ["it has no rows"]
    for entry in record["rows"]:
        row = AgreementRow(**{name: entry[name] for name in NAMES})
        if row.found is None:  # refused: nothing that could contradict itself
            continue
        name = f"{row.quantity!r} of {row.case!r}"
        size = 1.0 + abs(row.found) / (abs(row.reference) or 1.0)
        rounding = 0.0 if digits is None else 10.0 ** (1 - digits) * size
        difference = abs(row.deviation_percent - entry["deviation_percent"])
        if not difference <= 100.0 * rounding or row.verdict != entry["verdict"]:
            wrong.append(
                f"{name} contradicts itself: {entry['verdict']} with a deviation of {entry['deviation_percent']:.6g} % "
                f"is on record, {row.verdict} with {row.deviation_percent:.6g} % follows from its numbers"
            )
        elif row.verdict == "fail":
            reach = f"{plain(row.deviation_percent, '+.3g')} % ± {row.uncertainty_percent or 0.0:.2g}"
            wrong.append(f"{name} is out of tolerance: {reach}, tolerance {row.tolerance_percent} %")
    if record["verdict"] != ("fail" if any(entry["verdict"] == "fail" for entry in record["rows"]) else "pass"):
        wrong.append(f"its verdict {record['verdict']} does not follow from its rows")
    return wrong
