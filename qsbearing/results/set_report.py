"""The report on a solved set as tables for people: shaft, rows, stiffness, each row's contacts and readings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.files.file_keys import IN_FILE
from qsbearing.model.solution.judgement import percent
from qsbearing.model.solution.rounding import NOISE
from qsbearing.model.units import rpm
from qsbearing.remarks.remark import row_name
from qsbearing.remarks.wording import Words, capital
from qsbearing.results.readings_record import Readings
from qsbearing.results.record_type import Record
from qsbearing.results.remarks import blocks, every_remark
from qsbearing.results.report import (
    channels_table,
    contacts_table,
    digits,
    distinct,
    ending,
    heat_tables,
    outer_turning,
    requested_for,
    stiffness_matrix_table,
    stiffness_table,
    temperature_tables,
)
from qsbearing.results.set_record import set_record
from qsbearing.results.shaft_report import shaft_tables
from qsbearing.results.tables import digits_of
from qsbearing.systems.sets.set_solution import SetSolution


def set_result(solution: SetSolution, readings: Sequence[Readings], words: Words = IN_FILE) -> list[Block]:
    """The report on a single case of a set; with what each row was asked to be read off."""
    record = set_record(solution, readings)
    parts = heading(solution, record)
    if record["status"] == "converged":
        from qsbearing.results.set_key_results import answer

        parts.append(answer(solution, readings))
        parts += [*_tables(solution, record), *_temperatures(record)]
        for number, row in enumerate(record["rows"]):
            title = f"{capital(row_name(solution.set.rows[number], number))}: contacts"
            parts.append(replace(contacts_table(distinct(row["balls"]), len(row["balls"])), caption=title))
            if readings[number]:
                from qsbearing.results.readings_report import (
                    readings_tables,  # a set without readings does not load them
                )

                parts += readings_tables(readings[number], solution.rows[number].scene)
        parts += [*heat_tables(record), *_system_life(record)]
    return [*parts, *blocks(every_remark(solution, readings), is_apart=True, words=words)]


def tables(solution: SetSolution, readings: Sequence[Readings]) -> list[Block]:
    """What there is to say of a single solved case as a whole: shaft, rows, stiffness, and life where each row has one
    in hours."""
    record = set_record(solution, readings)
    return [*_tables(solution, record), *_system_life(record)]


def _tables(solution: SetSolution, record: Record) -> list[Block]:
    tables: list[Block] = [
        channels_table("Shaft", solution, record),
        *rows_tables(record),
        *play_of(record),
        *shaft_tables(record["shaft"]),
        stiffness_table(solution, record),
    ]
    return tables if record["stiffness_SI"][0][0] is None else [*tables, stiffness_matrix_table(record)]


def _temperatures(record: Record) -> list[Table]:
    """Of each row; once where all are alike."""
    rows = record["rows"]
    if all(row["temperatures"] == rows[0]["temperatures"] for row in rows):
        return temperature_tables(rows[0])
    return [
        replace(table, caption=f"Row {number}. {table.caption}")
        for number, row in enumerate(rows, 1)
        for table in temperature_tables(row)
    ]


def _system_life(record: Record) -> list[Block]:
    basic, modified = record["system_basic_life_h"], record["system_life_h"]
    if modified is None:
        return []
    together = f"{digits_of(basic)} h"
    if modified != basic:
        together = f"basic {digits_of(basic)} h, modified {digits_of(modified)} h"
    return [Paragraph(f"Life of all rows together: {together}", is_apart=True)]


def heading(solution: SetSolution, record: Record) -> list[Block]:
    """What a set is, and why its case has no solution, where it has none."""
    of = solution.set
    name = of.name or "Set"
    count = "1 row" if len(of.rows) == 1 else f"{len(of.rows)} rows"
    number = record["axial_datum_row"]
    datum = "" if number is None else f"; row {number} is the axial datum of spacers, which move the other rows"
    turning = f"{float(np.asarray(of.operation.speed)) / rpm:.6g} rpm{outer_turning(of.operation.outer_speed)}"
    what = (
        f"{name}  {count}, {of.arrangement}; shaft {turning}, its channels at "
        f"x = {record['reference_position_mm']:.6g} mm{datum}. {requested_for(record)}"
    )
    preload = [] if of.preload is None else [Paragraph(f"Preload ({of.preload.kind.replace('_', ' ')})")]
    return [Paragraph(what, name), *preload, *ending(record)]


def play_of(record: Record) -> list[Block]:
    """How far the shaft goes along x until rows carry it, where some row has two sides."""
    play = record["axial_play"]
    if play is None:
        return []
    low, high = (None if play[end] is None else digits(play[end], 1e-9) for end in ("from_um", "to_um"))
    if low is None and high is None:
        said = "no row holds the shaft in +x or -x"
    elif low is None or high is None:
        ends = (f"to {high} µm in +x", "-x") if low is None else (f"to {low} µm in -x", "+x")
        said = f"{ends[0]}; no row holds the shaft in {ends[1]}"
    elif play["from_um"] <= play["to_um"]:
        said = f"from {low} to {high} µm"
    else:
        said = f"none; rows are pressed against each other by {digits(play['from_um'] - play['to_um'], 1e-9)} µm"
    return [Paragraph(f"Axial play: {said} (straight and centred, counted as its displacement)", is_apart=True)]


def rows_tables(record: Record) -> list[Table]:
    """What each row of a record carries; and where rows press each other, what has become of the preload."""
    heading = ("row", "bearing", "at\nmm", "carries", "axial\nN", "radial y\nN", "radial z\nN", "largest ball\nN")
    cells = []
    noise = NOISE * max(abs(load) for row in record["rows"] for load in list(row["share"].values())[:3])
    for number, row in enumerate(record["rows"], 1):
        loads = [row["axial_load_N"], row["share"]["radial_y_N"], row["share"]["radial_z_N"]]
        loads.append(max(ball[side]["load_N"] for ball in row["balls"] for side in ("inner", "outer")))
        place = (str(number), row["bearing"], f"{row['position_mm']:.6g}", row["carries"])
        cells.append((*place, *(digits(load, noise) for load in loads)))
    is_either = any(row["carries"] in ("both", "none") for row in record["rows"])
    notes = [("axial:", "in the direction that the row carries; in +x where that is both or none")] * is_either
    tables = [Table(heading, cells, "llrlrrrr", "Rows: load on each", notes=notes)]
    if all(row["preload_unmounted_N"] is None for row in record["rows"]):
        return tables
    heads = ("before\nfitting N", "mounted\nN", "in operation\nN", "of what\nis given", "with the\nloads N")
    cells = []
    for number, row in enumerate(record["rows"], 1):
        loads = [row[f"preload_{which}_N"] for which in ("unmounted", "mounted", "in_operation")]
        share = "-" if row["preload_share"] is None else percent(row["preload_share"], digits=3)
        given, carried = [digits(load, noise) for load in loads], digits(row["axial_load_N"], noise)
        cells.append((str(number), *given, share, carried, row["preload_state"] or "none given"))
    title = "Preload: axial load of each row, without external loads and with them"
    return [*tables, Table(("row", *heads, ""), cells, "lrrrrrl", title)]
