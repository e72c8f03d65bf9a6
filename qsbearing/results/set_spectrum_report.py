"""A set under a load spectrum as plain data for `run --json` and as tables for people: life of each row and of all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.model.solution.result_keys import DISPLACEMENT, LOAD
from qsbearing.model.units import mm, rpm
from qsbearing.model.version import __version__
from qsbearing.readings.rating_life import HOUR, MILLION
from qsbearing.remarks.of_solution import message
from qsbearing.results.json_record import number, of_channels
from qsbearing.results.readings_record import Readings
from qsbearing.results.record_type import Record
from qsbearing.results.remarks import blocks, every_remark, of_points, remarks_record
from qsbearing.results.spectrum_report import NAMES
from qsbearing.results.tables import digits_of
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.system_life import system_life


def set_spectrum_record(solution: SetSolution, readings: Sequence[Readings]) -> Record:
    """The points, and what they do together to each row.

    Args:
        readings: of each row.

    Returns:
        None stands for a number that there is not: lives where a point is not solved.
    """
    of, solved = solution.set, solution.converged
    lives = [own["spectrum"] for own in readings]
    shares = np.asarray(of.readings["spectrum"]["time_share"])
    return {
        "version": __version__,
        "status": "converged" if solved.all() else str(solution.status[np.argmin(solved)]),
        "message": message(solution),
        "seconds": solution.seconds,
        "set": of.name,
        "arrangement": of.arrangement,
        "system_life_h": number(system_life([life.duration for life in lives]) / HOUR),
        "rows": [
            {
                "bearing": row.bearing.name,
                "position_mm": float(np.asarray(row.position) / mm),
                "carries": str(row.carries),
                "life_Mrev": number(life.life / MILLION),
                "duration_h": number(life.duration / HOUR),
            }
            for row, life in zip(of.rows, lives, strict=True)
        ],
        "points": [
            {
                "share": float(share),
                "status": str(solution.status[k]),
                "residual": number(solution.residual[k]),
                **remarks_record(every_remark(solution, readings, k)),
                "displacement": of_channels(DISPLACEMENT, solution.displacement[k]),
                "load": of_channels(LOAD, solution.load[k]),
                "rows": [
                    {
                        "axial_load_N": number(solution.axial_loads[k, i]),
                        "duration_h": number(own["life"].duration[k] / HOUR),
                        "damage_share": number(own["spectrum"].damage_share[k]),
                    }
                    for i, own in enumerate(readings)
                ],
            }
            for k, share in enumerate(shares)
        ],
    }


def set_spectrum_result(solution: SetSolution, readings: Sequence[Readings]) -> list[Block]:
    """For each row and operating point what it carries and its part of the damage; the lives of rows and set."""
    record = set_spectrum_record(solution, readings)
    name = record["set"] or "Set"
    head = f"{name}  {record['arrangement']}; {len(record['points'])} operating points. {record['message']}"
    loads = [i for i in range(5) if np.nan_to_num(solution.load[:, i]).any()]
    heading = ("point", "share", "speed\nrpm", *(NAMES[i] for i in loads))
    heading += ("row", "its axial\nload N", "life\nh", "damage\n%")
    rows = []
    for k, point in enumerate(record["points"]):
        own: tuple[str, ...] = (f"{k + 1}", f"{point['share']:.6g}", f"{readings[0]['life'].speed[k] / rpm:.6g}")
        own += tuple(digits_of(LOAD[i].of(solution.load[k])) for i in loads)
        for row_number, row in enumerate(point["rows"], 1):
            damage = None if row["damage_share"] is None else 100.0 * row["damage_share"]
            cells = map(_digits, (row["axial_load_N"], row["duration_h"], damage))
            rows.append((*(own if row_number == 1 else [""] * len(own)), str(row_number), *cells))
    lives = [
        (str(row_number), row["bearing"], _digits(row["duration_h"]), _digits(row["life_Mrev"]))
        for row_number, row in enumerate(record["rows"], 1)
    ]
    lives.append(("all", "", _digits(record["system_life_h"]), ""))
    return [
        Paragraph(head, name),
        Table(heading, rows, caption="Load spectrum"),
        Table(("row", "bearing", "h", "million\nrevolutions"), lives, "llrr", "Life under the whole spectrum"),
        *blocks(of_points(solution, readings), is_apart=True),
    ]


def _digits(value: float | None) -> str:
    return "-" if value is None else digits_of(value)
