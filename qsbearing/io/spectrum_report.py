"""A solved load spectrum as plain data for `run --json` and as tables for people."""

from __future__ import annotations

from typing import Any

import numpy as np
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from qsbearing import __version__, messages
from qsbearing.io.json_record import record
from qsbearing.io.readings_record import Readings, number
from qsbearing.io.report import asked_for, warnings_below
from qsbearing.io.tables import digits_of, plain_table
from qsbearing.ranked_warning import RankedWarning, said_of
from qsbearing.readings.rating_life import HOUR, MILLION
from qsbearing.result_keys import LOAD
from qsbearing.solution.solution import Solution
from qsbearing.units import rpm

NAMES = ("axial\nN", "radial y\nN", "radial z\nN", "moment y\nNm", "moment z\nNm")


def spectrum_record(solution: Solution, readings: Readings) -> dict[str, Any]:
    """The points, each as a scene of its own, and what they do together.

    Returns:
        None stands for a number that there is not: the life together where a point is not solved.
    """
    solved = bool(np.all(solution.converged))
    together = readings["spectrum"]
    shares = solution.scene.readings["spectrum"]["time_share"]
    return {
        "version": __version__,
        "status": "converged" if solved else str(solution.status[np.argmin(solution.converged)]),
        "message": messages.message(solution),
        "seconds": solution.seconds,
        "bearing": solution.scene.bearing.name,
        "life_Mrev": number(together.life / MILLION),
        "duration_h": number(together.duration / HOUR),
        "points": [
            {
                "share": float(share),
                "damage_share": number(together.damage_share[k]),
                **record(solution, readings, (k,)),
            }
            for k, share in enumerate(shares)
        ],
    }


def spectrum_result(solution: Solution, readings: Readings) -> Group:
    """A row for each operating point, and the life of all together."""
    found, life = spectrum_record(solution, readings), readings["life"]
    head = Text.assemble((found["bearing"] or "Bearing", "bold"), f"  {len(found['points'])} operating points. ")
    head.append(f"{asked_for(found['points'][0])}\n{found['message']}")
    loads = [i for i in range(5) if np.nan_to_num(solution.load[:, i]).any()]
    results = ("largest\nball load\nN", "life\nMrev", "life\nh", "damage\n%")
    table = plain_table("Load spectrum", ("point", "share", "speed\nrpm", *(NAMES[i] for i in loads), *results))
    inner, outer = solution.inner.load, solution.outer.load
    for k, point in enumerate(found["points"]):
        largest = np.fmax(inner[k], outer[k])
        own = life.duration[k] / HOUR
        turns = own * HOUR * abs(life.speed[k]) / (2.0 * np.pi) / MILLION if life.speed[k] else np.nan
        table.add_row(
            f"{k + 1}",
            f"{point['share']:.6g}",
            f"{life.speed[k] / rpm:.6g}",
            *(digits_of(solution.load[k, i] / LOAD[i][1]) for i in loads),
            digits_of(np.nan if np.isnan(largest).all() else np.nanmax(largest)),
            digits_of(turns),
            digits_of(own),
            digits_of(100.0 * (np.nan if point["damage_share"] is None else point["damage_share"])),
        )
    parts: list[RenderableType] = [head, Padding(table, (1, 0, 0, 0))]
    if found["duration_h"] is not None:
        together = f"Life under all of them: {found['duration_h']:.5g} h, {found['life_Mrev']:.5g} million revolutions"
        parts.append(Padding(Text(together), (1, 0, 0, 0)))
    said: dict[RankedWarning, list[str]] = {}
    for k in range(len(found["points"])):
        for sentence in found["points"][k]["warnings"]:
            said.setdefault(sentence, []).append(f"{k + 1}")
    sentences = [said_of(f"point {', '.join(points)}", sentence) for sentence, points in said.items()]
    sentences += [said_of("life (points counted from 0)", sentence) for sentence in life.warnings]
    return Group(*parts, *warnings_below(sentences))
