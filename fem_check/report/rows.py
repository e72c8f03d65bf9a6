"""Rows of agreement as cells and tables: texts of their numbers, names for readers, verdicts with colours."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from math import inf

from fem_check.rows import row_text
from fem_check.rows.record import RowRecord, computed_value, deviation_percent, reach_percent
from qsbearing.documents.model import Badge, Cell, Table

SHORT = {
    "semi_major_axis": "a", "semi_minor_axis": "b", "max_pressure": "p0", "max_shear_stress": "τmax",
    "max_shear_depth": "depth of τmax", "axial_displacement": "axial displacement",
}  # fmt: skip
STATUS = {"pass": "pass", "fail": "fail", "finding": "finding"}


def quantity(name: str) -> str:
    """A quantity as readers call it."""
    for long, short in SHORT.items():
        name = name.replace(long, short)
    return _WORDS.sub(" ", name)


_WORDS = re.compile(r"(?<=[a-z]{2})_(?=[a-z])")
"""Between words; the index of a symbol, as in F_a, stays one."""


def as_read(text: str) -> str:
    """A text of a record as readers see it: with a comma in large numbers. Records lack it, since cases are compared by
    their names with those of former releases; all else checks write as it is read."""
    return _FIVE_DIGITS.sub(lambda digits: f"{digits[1]},{digits[2]}", text)


_FIVE_DIGITS = re.compile(r"(?<![\d.,\w-])(\d{1,3}(?= )|\d{2,3}) ?(\d{3})(?= (?:N|MPa|rpm|scenes)\b)")
"""Thousands before a unit, with a space or nothing between them; four digits stay as they are."""


def badge(word: str) -> Badge:
    """A verdict; a word that is none of ours has no colour."""
    return Badge(word, STATUS.get(word, "missing"))


def counts(rows: Sequence[RowRecord]) -> dict[str, int]:
    """How many rows have each verdict."""
    return {word: sum(row["verdict"] == word for row in rows) for word in ("pass", "fail", "finding")}


def difference(row: RowRecord) -> str:
    """What was found against the reference, with its uncertainty and unit."""
    said = row_text.difference(row)
    if row["uncertainty_percent"] is None:  # nothing says to which digit it is known
        size = (computed_value(row) - row["reference"]) * row_text.in_unit(row)[0]
        said = short(size) if not row["reference"] or row_text.is_absolute(row) else short(deviation_percent(row))
    unit = row_text.difference_unit(row)
    return row_text.with_unit(said, unit)


def short(value: float) -> str:
    """With its sign, to two digits, or three of a number from ten to a thousand."""
    return row_text.number(value, 3 if 10.0 <= abs(value) < 1000.0 else 2, signed=True)


def largest(rows: Iterable[RowRecord]) -> str:
    """The largest difference of some rows in the unit that readers see, without its uncertainty; empty for no row."""
    row = max(rows, key=_size, default=None)
    return "" if row is None else difference(row | {"uncertainty_percent": None})


def used(row: RowRecord) -> float:
    """Share of its tolerance that deviation and uncertainty take; of a row without one 0, and infinite of one that is
    refused."""
    if row["found"] is None:
        return inf
    reach = reach_percent(row)
    tolerance = row["tolerance_percent"]
    return float(reach / tolerance) if tolerance else (inf if tolerance == 0.0 and reach else 0.0)


COUNTED = ("balls",)
"""Units of whole numbers: one too many is a whole limit, and says nothing of how near it is."""


def is_count(row: RowRecord) -> bool:
    """Whether a row counts things."""
    return row["unit"] in COUNTED


def worst(rows: Sequence[RowRecord], most: int = 5) -> list[tuple[int, RowRecord]]:
    """Of each quantity the worst row and of how many it is; failures first, then at most three findings, the largest,
    then the rows nearest to their tolerances."""
    alike: dict[tuple[str, bool], list[RowRecord]] = {}
    for row in rows:
        alike.setdefault((row["quantity"], row["tolerance_percent"] is None), []).append(row)
    each = [(len(same), max(same, key=_badness)) for same in alike.values()]
    failing = [pair for pair in each if pair[1]["verdict"] in ("fail", "refused")]
    findings = sorted(
        (pair for pair in each if pair[1]["verdict"] == "finding"), key=lambda pair: -abs(deviation_percent(pair[1]))
    )
    judged = sorted((pair for pair in each if pair[1]["verdict"] == "pass"), key=lambda pair: -used(pair[1]))
    room = max(3, most - len(judged))
    return [*failing, *findings[:room], *judged][:most]


def _badness(row: RowRecord) -> tuple[bool, float, float]:
    return row["verdict"] in ("fail", "refused"), used(row), _size(row)


def _size(row: RowRecord) -> float:
    if row["found"] is None:
        return inf
    return float(abs(row["found"] - row["reference"] if row_text.is_absolute(row) else deviation_percent(row)))


HEADINGS = ("quantity", "worst of", "deviation ± 95 %", "limit", "where", "verdict")


def table(rows: Sequence[tuple[int, RowRecord]], caption: str = "", is_whole: bool = False) -> Table:
    """Rows, each the worst of so many; all rows, if it is whole."""
    lines: list[list[Cell]] = []
    for count, row in rows:
        name, unit = quantity(as_read(row["quantity"])), row_text.in_unit(row)[1]
        if row["found"] is None:
            lines.append([name, str(count), "", "", as_read(row["case"]), badge(row["verdict"])])
            continue
        told = row_text.of_row(row)
        what = difference(row) if told.deviation or not row["reference"] else f"{told.found} {unit}"
        place = row.get("worst_at") or ""
        where = place if row["case"] in place else ", ".join(filter(None, (row["case"], place)))
        lines.append([name, str(count), what, told.tolerance, quantity(as_read(where)), badge(row["verdict"])])
    if is_whole:
        lines = [[line[0], *line[2:]] for line in lines]
    headings = [HEADINGS[0], *HEADINGS[2:]] if is_whole else HEADINGS
    return Table(headings, lines, "l" * len(headings), caption, stack=True)


def reasons(rows: Iterable[RowRecord]) -> list[list[Cell]]:
    """A line for each reason: its quantities, their limits, the reason."""
    by_reason: dict[str, dict[str, dict[str, None]]] = {}
    for row in rows:
        why = as_read(row["why_tolerance"] or "").removeprefix("a finding").removeprefix(": ")
        entry = by_reason.setdefault(why, {"quantity": {}, "limit": {}})
        entry["quantity"][quantity(as_read(row["quantity"]))] = None
        entry["limit"][row_text.of_row(row).tolerance or "none"] = None
    return [[", ".join(entry["quantity"]), _several(list(entry["limit"])), why] for why, entry in by_reason.items()]


def _several(limits: Sequence[str]) -> str:
    return ", ".join(limits) if len(limits) <= 4 else f"{limits[0]}, ... ({len(limits)} limits)"
