"""The report on a solved set as tables for people: shaft, rows, stiffness, each row's contacts and readings."""

from __future__ import annotations

from typing import Any

import numpy as np
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from qsbearing.io.report import (
    RING_NOISE,
    asked_for,
    contacts_table,
    digits,
    distinct,
    ending,
    stiffness_matrix_table,
    stiffness_table,
)
from qsbearing.io.set_record import set_record
from qsbearing.io.tables import plain_table
from qsbearing.scene.operation import CHANNELS
from qsbearing.sets.set_messages import capital, row_name
from qsbearing.sets.set_solution import SetSolution
from qsbearing.units import rpm


def set_result(solution: SetSolution) -> Group:
    """The report on a single case of a set."""
    found = set_record(solution)
    parts: list[RenderableType] = [_heading(solution, found)]
    if found["status"] == "converged":
        tables = [_shaft(solution, found), _rows(found), stiffness_table(found), stiffness_matrix_table(found)]
        parts += [Padding(table, (1, 0, 0, 0)) for table in tables]
        for number, row in enumerate(found["rows"]):
            table = contacts_table(distinct(row["balls"]), len(row["balls"]))
            table.title = f"{capital(row_name(solution.set.rows[number], number))}: contacts"
            parts.append(Padding(table, (1, 0, 0, 0)))
            if solution.rows[number].scene.readings:
                parts += _readings(solution, number)
        if found["system_life_h"] is not None:
            parts.append(Padding(Text(f"Life of all rows together: {found['system_life_h']:.5g} h"), (1, 0, 0, 0)))
    for sentence in found["warnings"]:
        parts.append(Padding(Text.assemble(("Warning: ", "bold yellow"), sentence), (1, 0, 0, 0)))
    return Group(*parts)


def _heading(solution: SetSolution, found: dict[str, Any]) -> Text:
    of = solution.set
    lines = Text.assemble((of.name or "Set", "bold"))
    lines.append(
        f"  {len(of.rows)} rows, {of.arrangement}; shaft {float(np.asarray(of.operation.speed)) / rpm:.6g} rpm, its "
        f"channels at x = {found['reference_position_mm']:.6g} mm. {asked_for(found)}\n"
    )
    if of.preload is not None:
        lines.append(f"Preload ({of.preload.kind.replace('_', ' ')})\n")
    return lines.append(ending(found))


def _shaft(solution: SetSolution, found: dict[str, Any]) -> Table:
    table = plain_table("Shaft", ("", "displacement", "", "load", "", "imposed"), left=(0, 2, 4, 5))
    table.columns[5].style = "dim"
    noise = RING_NOISE * max(1e-300, *(abs(row["axial_load_N"]) for row in found["rows"]), *map(abs, solution.load))
    values = zip(CHANNELS, found["displacement"].values(), found["load"].values(), strict=True)
    for i, (channel, displacement, load) in enumerate(values):
        length, force = ("mrad", "Nm") if channel.is_rotation else ("um", "N")
        imposed = "load" if i in solution._free_channels else "displacement"
        table.add_row(channel.label, digits(displacement, 1e-9), length, digits(load, noise), force, imposed)
    return table


def _rows(found: dict[str, Any]) -> Table:
    heading = (
        "row", "bearing", "at\nmm", "carries", "axial\nN", "radial y\nN", "radial z\nN", "preload\nat rest N",
        "at speed\nN", "state", "largest\nball N",
    )  # fmt: skip
    table = plain_table("Rows: what each carries, and its preload without external loads", heading, left=(0, 1, 3, 9))
    largest = max(abs(load) for row in found["rows"] for load in list(row["share"].values())[:3])
    noise = RING_NOISE * largest
    for number, row in enumerate(found["rows"], 1):
        loads = [row["axial_load_N"], row["share"]["radial_y_N"], row["share"]["radial_z_N"]]
        loads += [row["preload_at_rest_N"], row["preload_in_operation_N"]]
        pressed = max(ball[side]["load_N"] for ball in row["balls"] for side in ("inner", "outer"))
        state = (row["preload_state"] or "").replace("_", " ")
        cells = [digits(load, noise) for load in loads]
        place = (str(number), row["bearing"], f"{row['position_mm']:.6g}", row["carries"])
        table.add_row(*place, *cells, state, digits(pressed, noise))
    return table


def _readings(solution: SetSolution, number: int) -> list[RenderableType]:
    from qsbearing.io.readings_report import readings_tables  # a set without readings does not load them
    from qsbearing.readings.asked import take_asked

    return readings_tables(take_asked(solution.rows[number]))
