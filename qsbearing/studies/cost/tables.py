"""The measured costs as tables for people."""

from __future__ import annotations

from collections.abc import Iterable
from textwrap import wrap
from typing import Any

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.model.solution.judgement import WORDS
from qsbearing.studies.cost.measuring import in_a_line
from qsbearing.studies.cost.record import LEVELS, Level

Row = dict[str, Any]


def report(record: dict[str, Any]) -> list[Block]:
    """Everything in the record."""
    return [*_heading(record), _levels(record), _speeds(record), _scaling(record)]


def select(rows: list[Row], **chosen: Any) -> list[Row]:
    """The rows that have these values."""
    return [row for row in rows if all(row[key] == value for key, value in chosen.items())]


def levels_of(record: dict[str, Any]) -> list[Level]:
    """The levels that were measured, of those that there are."""
    names = {row["level"] for row in record["errors"]}
    return [level for level in LEVELS if level.name in names]


def worst(row: Row, groups: Iterable[str] = WORDS) -> float | None:
    """The worst error of some groups of results; None where one has no number."""
    values = [row[group] for group in groups]
    return None if None in values else max(values)


def _heading(record: dict[str, Any]) -> list[Block]:
    rounds, processes = (record["settings"][name] for name in ("rounds", "processes"))
    name = record["bearing"] or "Bearing"
    how = (
        f"Processor time: medians of {rounds} rounds in each of {processes} processes, in brackets their 5 % and 95 %."
    )
    return [Paragraph(f"{name}  {record['scene']}", name), Paragraph(in_a_line(record["machine"])), Paragraph(how)]


def _levels(record: dict[str, Any]) -> Table:
    batch = record["settings"]["batch"]
    heading = ["", "one call\nµs", "of the finest\n", f"a case of {batch}\nµs", "of the finest\n"]
    cells = []
    for level in levels_of(record):
        rows = select(record["measured"], part="levels", name=level.name)
        cells.append((level.text, *(cell for row in rows for cell in (_micro(row), _ratio(row)))))
    return Table(heading, cells, caption="Model levels: time")


def _speeds(record: dict[str, Any]) -> Table:
    named = [row for row in select(record["errors"], level=levels_of(record)[0].name) if row["speed"] is not None]
    heading = ["", *("\n".join([*wrap(row["speed"], 11), f"{row['dm_n_mm_rpm']:,.0f}"]) for row in named)]
    cells = []
    for level in levels_of(record):
        rows = [row for row in select(record["errors"], level=level.name) if row["speed"] is not None]
        cells.append((level.text, *(short(worst(row)) for row in rows)))
    return Table(heading, cells, caption="Error of the worst result by speed; below: dm n, mm rpm")


def _scaling(record: dict[str, Any]) -> Table:
    heading = ["cases", "µs a case", "of the last", "MB"]
    measured = select(record["measured"], part="cases")
    rows = [
        (row["name"], *(text.replace("\n", " ") for text in (_micro(row), _ratio(row))), f"{row['memory_MB']:.0f}")
        for row in measured
    ]
    return Table(heading, rows, caption="Scaling: cases in one call, one thread")


def _micro(row: Row) -> str:
    """Microseconds a case, with their spread."""
    median, low, high = (1e6 * row["case_s"][name] for name in ("median", "low", "high"))
    return f"{median:.3g}\n({low:.3g}-{high:.3g})"


def _ratio(row: Row) -> str:
    median, low, high = (row["over_last"][name] for name in ("median", "low", "high"))
    return f"{median:.2g}\n({low:.2g}-{high:.2g})"


def short(error: float | None) -> str:
    """An error in as few characters as it takes."""
    return "-" if error is None else f"{error:.2g}".replace("e-0", "e-")
