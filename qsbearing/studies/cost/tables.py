"""The measured costs as tables for people."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from textwrap import wrap
from typing import Any

from rich.console import Group
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io.tables import plain_table
from qsbearing.judgement import WORDS
from qsbearing.studies.cost.levels import LEVELS, Level
from qsbearing.studies.cost.measuring import in_a_line

Row = dict[str, Any]


def report(record: dict[str, Any]) -> Group:
    """Everything in the record, for the terminal."""
    parts = (_levels(record), _speeds(record), _scaling(record))
    return Group(_heading(record), *(Padding(part, (1, 0, 0, 0)) for part in parts))


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


def _heading(record: dict[str, Any]) -> Text:
    rounds, processes = (record["settings"][name] for name in ("rounds", "processes"))
    return Text.assemble(
        (record["bearing"] or "Bearing", "bold"),
        f"  {record['scene']}\n{in_a_line(record['machine'])}\n",
        f"Processor time: medians of {rounds} rounds in each of {processes} processes, in brackets their 5 % and 95 %.",
    )


def _levels(record: dict[str, Any]) -> Table:
    batch = record["settings"]["batch"]
    heading = ["", "one call\nus", "of the finest\n", f"a case of {batch}\nus", "of the finest\n"]
    table = _table("Model levels: time", heading)
    for level in levels_of(record):
        rows = select(record["measured"], part="levels", name=level.name)
        table.add_row(level.text, *(cell for row in rows for cell in (_micro(row), _ratio(row))))
    return table


def _speeds(record: dict[str, Any]) -> Table:
    named = [row for row in select(record["errors"], level=levels_of(record)[0].name) if row["speed"] is not None]
    heading = ["", *("\n".join([*wrap(row["speed"], 11), f"{row['dm_n_mm_rpm']:g}"]) for row in named)]
    table = _table("Error of the worst result by speed; below: dm n, mm rpm", heading)
    for level in levels_of(record):
        rows = [row for row in select(record["errors"], level=level.name) if row["speed"] is not None]
        table.add_row(level.text, *(short(worst(row)) for row in rows))
    return table


def _scaling(record: dict[str, Any]) -> Table:
    table = _table("Scaling: cases in one call, one thread", ["cases", "us a case", "of the last", "MB"])
    for row in select(record["measured"], part="cases"):
        table.add_row(row["name"], _micro(row), _ratio(row), f"{row['memory_MB']:.0f}")
    return table


def _table(title: str, heading: Sequence[str]) -> Table:
    table = plain_table(title, heading)
    for column in table.columns:
        column.no_wrap, column.overflow = False, "fold"  # cut off, a number would be another number
    return table


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
