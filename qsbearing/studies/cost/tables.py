"""The measured costs as tables: for people, and as rows for CSV."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from textwrap import wrap
from typing import Any

from rich.console import Group
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io import csv_table
from qsbearing.io.tables import plain_table
from qsbearing.studies.cost.levels import LEVELS
from qsbearing.studies.cost.machine import in_a_line
from qsbearing.studies.cost.results import GROUPS
from qsbearing.studies.cost.speeds import OWN

Row = dict[str, Any]

LISTS = ("measured", "errors")
"""The parts of a record that are lists of rows."""


def report(record: dict[str, Any]) -> Group:
    """Everything in the record, for the terminal."""
    parts = (_levels(record), _speeds(record), _groups(record), _tolerance(record), _scaling(record))
    return Group(_heading(record), *(Padding(part, (1, 0, 0, 0)) for part in parts))


def select(rows: list[Row], **chosen: Any) -> list[Row]:
    """The rows that have these values."""
    return [row for row in rows if all(row[key] == value for key, value in chosen.items())]


def worst(row: Row, groups: Iterable[str] = GROUPS) -> float | None:
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
    for level in LEVELS:
        rows = select(record["measured"], part="levels", name=level.name)
        table.add_row(level.text, *(cell for row in rows for cell in (_micro(row), _ratio(row))))
    return table


def _speeds(record: dict[str, Any]) -> Table:
    named = [row for row in select(record["errors"], level=LEVELS[0].name) if row["speed"] is not None]
    heading = ["", *("\n".join([*wrap(row["speed"], 11), f"{row['dm_n_mm_rpm']:g}"]) for row in named)]
    table = _table("Error of the worst result by speed; below: dm n, mm rpm", heading)
    for level in LEVELS:
        rows = [row for row in select(record["errors"], level=level.name) if row["speed"] is not None]
        table.add_row(level.text, *(short(worst(row)) for row in rows))
    return table


def _groups(record: dict[str, Any]) -> Table:
    table = _table(f"Error against the finest level, {OWN}", ["", *("\n".join(wrap(group, 13)) for group in GROUPS)])
    for level in LEVELS:
        (row,) = select(record["errors"], level=level.name, speed=OWN)
        table.add_row(level.text, *(short(row[group]) for group in GROUPS))
    return table


def _tolerance(record: dict[str, Any]) -> Table:
    heading = ["residual\ntolerance", "error\n", "iterations\n", "one call\nus"]
    table = _table("Tolerance: error against the tightest", [*heading, f"a case of {record['settings']['batch']}\nus"])
    for one in select(record["measured"], part="tolerance", cases=1):
        times = [_micro(row) for row in select(record["measured"], part="tolerance", name=one["name"])]
        table.add_row(one["name"], short(one["error"]), f"{one['iterations']:g}", *times)
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


def csv_text(rows: list[Row]) -> str:
    """A list of the record as CSV; an empty cell for what there is not."""
    flat = [
        {name: value for name, value in row.items() if not isinstance(value, dict)}
        | {f"{name}_{part}": x for name, value in row.items() if isinstance(value, dict) for part, x in value.items()}
        for row in rows
    ]
    return csv_table.csv_text({name: [row[name] for row in flat] for name in flat[0]})
