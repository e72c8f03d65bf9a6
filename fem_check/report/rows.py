"""Rows of agreement as cells and tables: texts of their numbers, names for readers, verdicts with colours."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

from fem_check.rows import row_text
from qsbearing.documents.model import Badge, Cell, Group, Table

Row = dict[str, Any]

SHORT = {
    "semi_major_axis": "a", "semi_minor_axis": "b", "max_pressure": "p0", "max_shear_stress": "τmax",
    "max_shear_depth": "depth of τmax", "axial_displacement": "axial displacement",
}  # fmt: skip
STATUS = {"pass": "pass", "fail": "fail", "finding": "finding"}
ORDER = ("fail", "pass", "finding", "refused")
"""The verdict of several rows is the first of these that one of them has."""


def quantity(name: str) -> str:
    """A quantity as readers call it."""
    for long, short in SHORT.items():
        name = name.replace(long, short)
    return _WORDS.sub(" ", name)


_WORDS = re.compile(r"(?<=[a-z]{2})_(?=[a-z])")
"""Between words; the index of a symbol, as in F_a, stays one."""


def as_read(text: str) -> str:
    """A text of a record as readers see it: without marks of code, units and powers by their signs."""
    text = re.sub(r"(?<=\d )um\b", "µm", text.replace("`", ""))
    text = re.sub(r"(?<=\d) deg\b", "°", text)
    text = _FIVE_DIGITS.sub(lambda found: f"{found[1]},{found[2]}", text)
    text = re.sub(r"(?<=[a-z])[ _]material\.(?=[a-z])", "'s ", text)
    text = re.sub(r"\^([23])(?![\d.])", lambda found: "²³"[int(found[1]) - 2], text)
    return row_text.short_exponents(text)


_FIVE_DIGITS = re.compile(r"(?<![\d.,\w-])(\d{1,3}(?= )|\d{2,3}) ?(\d{3})(?= (?:N|MPa|rpm|scenes)\b)")
"""Thousands before a unit, with a space or nothing between them; four digits stay as they are."""


def badge(word: str) -> Badge:
    """A verdict; a word that is none of ours has no colour."""
    return Badge(word, STATUS.get(word, "missing"))


def verdict(rows: Iterable[Row]) -> str:
    """Of several rows."""
    found = {row["verdict"] for row in rows}
    return next((word for word in ORDER if word in found), "finding")


def counts(rows: Sequence[Row]) -> dict[str, int]:
    """How many rows have each verdict."""
    return {word: sum(row["verdict"] == word for row in rows) for word in ("pass", "fail", "finding")}


HEADINGS = ("quantity", "reference", "found", "deviation, %", "tolerance", "verdict")
ALIGN = "lrrrrl"
MOST_ROWS = 100
"""Of one table's rows that are shown one by one."""
LONGEST_NAME = 80
"""Of a case in a column beside its quantities."""
NOTES = "notes"


def cells(row: Row) -> list[Cell]:
    """The cells of a row below `HEADINGS`."""
    told = row_text.of_row(row)
    return [
        _headed(row["quantity"], row_text.in_unit(row)[1]) + _worst_at(row),
        told.reference,
        told.found,
        row_text.deviation(row),
        told.tolerance,
        badge(row["verdict"]),
    ]


def _worst_at(row: Row) -> str:
    """Where the quantity is worst, without the name of the case, which stands beside it."""
    case = re.sub(r"^nearest of \d+: ", "", row["case"])
    place = re.sub(r":\s*(?=[,:]|$)", "", quantity(as_read(row.get("worst_at") or "").replace(as_read(case), "")))
    return f" (worst at {place.strip()})" if place.strip() else ""


def _headed(name: str, unit: str) -> str:
    return quantity(as_read(name)) + (f", {unit}" if unit else "")


def _difference_headed(row: Row) -> str:
    """Head of a column of `row_text.difference`."""
    return _headed(row["quantity"], row_text.difference_unit(row))


def agreement(rows: Sequence[Row], caption: str = "") -> list[Table]:
    """The rows as tables, the source and the reason of each as its footnotes.

    Cases that have the same quantities side by side share one table, with deviations in its cells. Where cases have
    several rows, or long names, the name is a row above them. More than `MOST_ROWS` rows are condensed, and the
    caption says so.
    """
    if len(rows) > MOST_ROWS:
        caption = f"{caption} (of {len(rows)} rows; all are in the CSV file)"
        rows = _condensed(rows)
    cases: dict[str, list[Row]] = {}
    for row in rows:
        cases.setdefault(row["case"], []).append(row)
    shapes: dict[tuple[str, ...], list[str]] = {}
    for case, own in cases.items():
        shapes.setdefault(tuple(map(_difference_headed, own)), []).append(case)
    found: list[Table] = []
    alone: list[str] = []
    for heads, names in shapes.items():
        if len(names) >= 3 and len(heads) >= 2:
            beside = [(name, cases[name]) for name in names]
            found += [_side_by_side(heads, beside, caption), *_parts_of(beside, caption)]
        else:
            alone += names
    return ([_row_by_row([(name, cases[name]) for name in alone], caption)] if alone else []) + found


def _row_by_row(cases: Sequence[tuple[str, list[Row]]], caption: str) -> Table:
    notes = _Notes()
    lines: list[list[Cell] | Group] = []
    are_many = sum(len(rows) for _, rows in cases) >= 2 * len(cases)
    if are_many or any(len(name) > LONGEST_NAME for name, _ in cases):
        for name, rows in cases:
            lines += [Group(as_read(name)), *([*cells(row), notes.of([row])] for row in rows)]
        return Table((*HEADINGS, NOTES), lines, f"{ALIGN}l", caption, stack=True, notes=notes.listed)
    lines += [[as_read(name), *cells(row), notes.of([row])] for name, rows in cases for row in rows]
    return Table(("case", *HEADINGS, NOTES), lines, f"l{ALIGN}l", caption, stack=True, notes=notes.listed)


def _condensed(rows: Sequence[Row]) -> list[Row]:
    """Of three rows or more that are judged alike those that do not pass, or else the one that uses most of its
    tolerance; of as many findings none."""

    def used(row: Row) -> float:
        return float((abs(row["deviation_percent"]) + (row["uncertainty_percent"] or 0.0)) / row["tolerance_percent"])

    alike: dict[tuple[Any, ...], list[Row]] = {}
    for row in rows:
        alike.setdefault((row["quantity"], row["unit"], row["why_tolerance"]), []).append(row)
    found = []
    for same in alike.values():
        failing = [row for row in same if row["verdict"] in ("fail", "refused")]
        if len(same) < 3:
            found += same
        elif failing:
            found += failing
        elif same[0]["tolerance_percent"] is not None:
            nearest = max(same, key=used)
            found.append(nearest | {"case": f"nearest of {len(same)}: {nearest['case']}"})
    return found


def _side_by_side(heads: Sequence[str], cases: Sequence[tuple[str, list[Row]]], caption: str) -> Table:
    title = f"{caption}: deviation ± its uncertainty" if caption else "Deviation ± uncertainty"
    lines: list[list[Cell]] = []
    notes = _Notes()
    for name, rows in cases:
        lines.append([as_read(name), *map(row_text.difference, rows), badge(verdict(rows)), notes.of(rows)])
    headings = ("case", *heads, "verdict", NOTES)
    return Table(headings, lines, "l" + "r" * len(heads) + "ll", title, stack=True, notes=notes.listed)


_PART = re.compile(r"([^,:\d]+) ([+-]\d\S* ± \S+) ([^\s,]+)(?:, |$)")


def _parts(row: Row) -> list[tuple[str, str]]:
    """Name with unit and value of each part that the reason of a finding lists; empty if it says anything else."""
    why = as_read(row["why_tolerance"] or "").removeprefix("a finding: ")
    found = _PART.findall(why) if row["verdict"] == "finding" else []
    return [(f"{name}, {unit}", value) for name, value, unit in found] if not _PART.sub("", why) else []


def _parts_of(cases: Sequence[tuple[str, list[Row]]], caption: str) -> list[Table]:
    """The parts of deviations side by side: a row of each quantity, or of each case if these have others."""
    every = [_parts(row) for _, rows in cases for row in rows]
    names = [[name for name, _ in parts] for parts in every]
    if not all(every):
        return []
    lines: list[list[Cell] | Group] = []
    if all(each == names[0] for each in names):
        headings = ["quantity", *names[0]]
        for case, rows in cases:
            lines.append(Group(as_read(case)))
            lines += [[_headed(row["quantity"], ""), *(value for _, value in _parts(row))] for row in rows]
    else:
        headings = ["case", *(name for row in cases[0][1] for name, _ in _parts(row))]
        lines += [[as_read(case), *(value for row in rows for _, value in _parts(row))] for case, rows in cases]
    title = f"{caption}: parts of the deviation" if caption else "Parts of the deviation"
    return [Table(headings, lines, caption=title, stack=True)]


class _Notes:
    """Footnotes of a table, in the order in which its rows need them."""

    def __init__(self) -> None:
        self.marks: dict[str, str] = {}

    def of(self, rows: Sequence[Row]) -> str:
        """The marks of what the rows rest on: where each reference is from, and why its tolerance."""
        texts = [f"Reference: {as_read(row['reference_source'])}" for row in rows]
        for row in rows:
            why = re.sub("^a finding(: |$)", "", as_read(row["why_tolerance"] or ""))
            if why and not _parts(row):
                texts.append(f"{_LABELS.get(row['verdict'], 'Tolerance')}: {why}")
        return " ".join(self.marks.setdefault(text, _mark(len(self.marks))) for text in dict.fromkeys(texts))

    @property
    def listed(self) -> list[tuple[str, str]]:
        return [(mark, text) for text, mark in self.marks.items()]


_LABELS = {"finding": "Finding", "refused": "Refused"}


def _mark(number: int) -> str:
    """a, b, ..., z, aa, ab, ..."""
    return (chr(ord("a") + number // 26 - 1) if number >= 26 else "") + chr(ord("a") + number % 26)
