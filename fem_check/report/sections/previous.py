"""What has changed since another folder of records."""

from __future__ import annotations

import math
from typing import Any

from fem_check.report.evidence import Evidence
from fem_check.report.rows import badge, quantity
from fem_check.rows.row_text import number
from qsbearing.documents.model import Badge, Block, Bullets, Cell, Paragraph, Section, Table

SAME = 1e-9
"""Relative change below which a number found is the same: rounding of sums in another order."""
SHOWN = 60
"""Rows shown, the largest changes first."""

Row = dict[str, Any]


def section(now: Evidence, before: Evidence) -> Section:
    """Rows that differ, checks that came or went."""
    old, new = _rows(before), _rows(now)
    changed = sorted(
        ((key, _change(old[key], new[key])) for key in old.keys() & new.keys()), key=lambda each: (-each[1], each[0])
    )
    turned = {key for key in old.keys() & new.keys() if old[key]["verdict"] != new[key]["verdict"]}
    moved = [(key, change) for key, change in changed if change > SAME or key in turned]
    of = next(iter(before.checks.values()))
    blocks: list[Block] = [
        Paragraph(
            f"Against the records in {before.folder.name} ({of.made_with}): {len(old.keys() & new.keys())} rows in "
            f"both, {len(moved)} of them found otherwise by more than {SAME:g}, {len(turned)} with another verdict."
        )
    ]
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


def _rows(evidence: Evidence) -> dict[tuple[str, str, str], Row]:
    """By check and level, case, quantity: one level is not compared with another."""
    named = [(f"{name}, {kept.data['level']}", kept) for name, kept in evidence.checks.items()]
    return {
        (name, row["case"], row["quantity"]): row
        for name, kept in (*named, *evidence.book.items())
        for row in kept.data["rows"]
    }


def _change(old: Row, new: Row) -> float:
    """Of what was found, over the larger of reference and found; differences from zero as they are."""
    size = max(abs(old["found"]), abs(old["reference"] or 0.0)) or 1.0
    change = abs(new["found"] - old["found"]) / size
    return change if math.isfinite(change) else math.inf


def _line(key: tuple[str, str, str], old: Row, new: Row, change: float) -> list[Cell]:
    now: Badge = badge(new["verdict"])
    found = (number(old["found"]), number(new["found"]), f"{100.0 * change:.2g}")
    return [key[0], key[1], quantity(key[2]), *found, badge(old["verdict"]), now]
