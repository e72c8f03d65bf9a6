"""What has changed since another folder of records."""

from __future__ import annotations

import math

from fem_check.report.evidence import Evidence
from fem_check.report.rows import badge, quantity
from fem_check.rows.record import RowRecord
from fem_check.rows.row_text import number
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Paragraph, Section, Table

SAME = 1e-9
"""Relative change below which a number found is the same: rounding of sums in another order."""
SHOWN = 60
"""Rows shown, the largest changes first."""

Key = tuple[str, str, str]
Rows = dict[Key, RowRecord]


def summary(now: Evidence, before: Evidence | None) -> str:
    """In a sentence."""
    if before is None:
        return "Not compared: no earlier release's records were given (fem-check report --previous DIR)."
    old, new = _rows(before), _rows(now)
    moved, turned = _moved(old, new)
    of = next(iter(before.checks.values()))
    return (
        f"Against the records in {before.folder.name} ({of.made_with}): {len(old.keys() & new.keys())} rows in "
        f"both, {len(moved)} of them found otherwise by more than {SAME:g}, {len(turned)} with another verdict."
    )


def _moved(old: Rows, new: Rows) -> tuple[list[tuple[Key, float]], set[Key]]:
    """Rows of both that differ with their changes, the largest first; those whose verdict differs."""
    both = old.keys() & new.keys()
    changed = sorted(((key, _change(old[key], new[key])) for key in both), key=lambda each: (-each[1], each[0]))
    turned = {key for key in both if old[key]["verdict"] != new[key]["verdict"]}
    return [(key, change) for key, change in changed if change > SAME or key in turned], turned


def section(now: Evidence, before: Evidence) -> Section:
    """Rows that differ, checks that came or went."""
    old, new = _rows(before), _rows(now)
    moved, _ = _moved(old, new)
    blocks: list[Block] = [Paragraph(summary(now, before))]
    for heading, gone in (("No longer there:", old.keys() - new.keys()), ("New:", new.keys() - old.keys())):
        if gone:
            tally = {name: sum(key[0] == name for key in gone) for name in sorted({key[0] for key in gone})}
            blocks += [Paragraph(heading), Bullets([f"{name}: {count} rows" for name, count in tally.items()])]
    if moved:
        rows = [_line(key, old[key], new[key], change) for key, change in moved[:SHOWN]]
        headings = ("check", "case", "quantity", "before", "now", "change %", "verdict before", "now")
        title = "Rows that differ" + (f": the {SHOWN} largest changes of {len(moved)}" if len(moved) > SHOWN else "")
        blocks.append(Table(headings, rows, "lllrrrll", title, tools=True))
    return Section("Against the previous release", blocks, "previous")


def _rows(evidence: Evidence) -> Rows:
    """By check and level, case, quantity: one level is not compared with another."""
    named = [(f"{name}, {kept.data['level']}", kept) for name, kept in evidence.checks.items()]
    return {
        (name, row["case"], row["quantity"]): row
        for name, kept in (*named, *evidence.book.items())
        for row in kept.data["rows"]
    }


def _change(old: RowRecord, new: RowRecord) -> float:
    """Of the computed number, over the larger of it and the reference; differences from zero as they are."""
    if old["found"] is None or new["found"] is None:  # refused, then or now
        return 0.0 if old["found"] == new["found"] else math.inf
    size = max(abs(old["found"]), abs(old["reference"] or 0.0)) or 1.0
    change = abs(new["found"] - old["found"]) / size
    return change if math.isfinite(change) else math.inf


def _line(key: Key, old: RowRecord, new: RowRecord, change: float) -> list[Cell]:
    now: Badge = badge(new["verdict"])
    numbers = (number(old["found"]), number(new["found"]), f"{100.0 * change:.2g}")
    return [key[0], key[1], quantity(key[2]), *numbers, badge(old["verdict"]), now]
