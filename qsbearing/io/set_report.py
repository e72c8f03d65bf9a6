"""The report on a solved set as tables for people: shaft, rows, stiffness, each row's contacts and readings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io.readings_record import Readings
from qsbearing.io.report import (
    RING_NOISE,
    asked_for,
    channels_table,
    contacts_table,
    digits,
    distinct,
    ending,
    heat_tables,
    stiffness_matrix_table,
    stiffness_table,
    temperature_tables,
    warnings_below,
)
from qsbearing.io.set_record import set_record
from qsbearing.io.shaft_report import shaft_tables
from qsbearing.io.tables import plain_table
from qsbearing.judgement import percent
from qsbearing.messages.bearing_set import capital, row_name
from qsbearing.sets.set_solution import SetSolution
from qsbearing.units import rpm


def set_result(solution: SetSolution, readings: Sequence[Readings]) -> Group:
    """The report on a single case of a set; with what each row was asked to be read off."""
    found = set_record(solution, readings)
    parts: list[RenderableType] = [heading(solution, found)]
    if found["status"] == "converged":
        parts += [Padding(table, (1, 0, 0, 0)) for table in [*_tables(solution, found), *_temperatures(found)]]
        for number, row in enumerate(found["rows"]):
            table = contacts_table(distinct(row["balls"]), len(row["balls"]))
            table.title = f"{capital(row_name(solution.set.rows[number], number))}: contacts"
            parts.append(Padding(table, (1, 0, 0, 0)))
            if readings[number]:
                from qsbearing.io.readings_report import readings_tables  # a set without readings does not load them

                parts.append(readings_tables(readings[number]))
        parts += heat_tables(found)
        parts += [Padding(life, (1, 0, 0, 0)) for life in _system_life(found)]
    return Group(*parts, *warnings_below(found["warnings"]))


def tables(solution: SetSolution, readings: Sequence[Readings]) -> Group:
    """What there is to say of a single solved case as a whole: shaft, rows, stiffness, and life where each row has one
    in hours."""
    found = set_record(solution, readings)
    return Group(*_tables(solution, found), *_system_life(found))


def _tables(solution: SetSolution, found: dict[str, Any]) -> list[Table]:
    noise = RING_NOISE * max(1e-300, *(abs(row["axial_load_N"]) for row in found["rows"]), *map(abs, solution.load))
    tables = [
        channels_table("Shaft", solution, found, noise, noise),
        *rows_tables(found),
        *shaft_tables(found["shaft"]),
        stiffness_table(solution, found),
    ]
    return tables if found["stiffness_SI"][0][0] is None else [*tables, stiffness_matrix_table(found)]


def _temperatures(found: dict[str, Any]) -> list[Table]:
    """Of each row; once where all are alike."""
    rows = found["rows"]
    if all(row["temperatures"] == rows[0]["temperatures"] for row in rows):
        return temperature_tables(rows[0])
    tables = []
    for number, row in enumerate(rows, 1):
        for table in temperature_tables(row):
            table.title = f"Row {number}. {table.title}"
            tables.append(table)
    return tables


def _system_life(found: dict[str, Any]) -> list[Text]:
    basic, modified = found["system_basic_life_h"], found["system_life_h"]
    if modified is None:
        return []
    together = f"{basic:.5g} h" if modified == basic else f"basic {basic:.5g} h, modified {modified:.5g} h"
    return [Text(f"Life of all rows together: {together}")]


def heading(solution: SetSolution, found: dict[str, Any]) -> Text:
    """What a set is, and how its case ended."""
    of = solution.set
    lines = Text.assemble((of.name or "Set", "bold"))
    count = "1 row" if len(of.rows) == 1 else f"{len(of.rows)} rows"
    lines.append(
        f"  {count}, {of.arrangement}; shaft {float(np.asarray(of.operation.speed)) / rpm:.6g} rpm, its "
        f"channels at x = {found['reference_position_mm']:.6g} mm. {asked_for(found)}\n"
    )
    if of.preload is not None:
        lines.append(f"Preload ({of.preload.kind.replace('_', ' ')})\n")
    return lines.append(ending(found))


def rows_tables(found: dict[str, Any]) -> list[Table]:
    """What each row of a record carries; and where rows press each other, what has become of the preload."""
    heading = ("row", "bearing", "at\nmm", "carries", "axial\nN", "radial y\nN", "radial z\nN", "largest ball\nN")
    table = plain_table("Rows: what each carries", heading, left=(0, 1, 3))
    table.columns[1].no_wrap, table.columns[1].overflow = False, "fold"  # a long name gives way, no number does
    noise = RING_NOISE * max(abs(load) for row in found["rows"] for load in list(row["share"].values())[:3])
    for number, row in enumerate(found["rows"], 1):
        loads = [row["axial_load_N"], row["share"]["radial_y_N"], row["share"]["radial_z_N"]]
        loads.append(max(ball[side]["load_N"] for ball in row["balls"] for side in ("inner", "outer")))
        place = (str(number), row["bearing"], f"{row['position_mm']:.6g}", row["carries"])
        table.add_row(*place, *(digits(load, noise) for load in loads))
    if all(row["preload_state"] is None for row in found["rows"]):
        return [table]
    heads = ("before\nfitting N", "mounted\nN", "in opera-\ntion N", "with the\nloads N", "share of what\nis given")
    preload = plain_table(
        "Preload: axial load of each row, without external loads and with them", ("row", *heads, ""), left=(0, 6)
    )
    for number, row in enumerate(found["rows"], 1):
        loads = [row[f"preload_{which}_N"] for which in ("unmounted", "mounted", "in_operation")]
        share = "-" if row["preload_share"] is None else percent(row["preload_share"])
        state = row["preload_state"] or ""
        preload.add_row(str(number), *(digits(load, noise) for load in (*loads, row["axial_load_N"])), share, state)
    return [table, preload]
