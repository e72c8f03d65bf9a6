"""A solved load spectrum as plain data for `run --json` and as tables for people."""

from __future__ import annotations

import numpy as np

from qsbearing.documents.model import Block, Paragraph, Table
from qsbearing.model.solution.result_keys import LOAD
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import rpm
from qsbearing.model.version import __version__
from qsbearing.readings.rating_life import HOUR, MILLION
from qsbearing.remarks.of_solution import message
from qsbearing.results.json_record import record
from qsbearing.results.readings_record import Readings, number
from qsbearing.results.record_type import Record
from qsbearing.results.remarks import blocks, of_points
from qsbearing.results.report import requested_for
from qsbearing.results.tables import digits_of

NAMES = ("axial\nN", "radial y\nN", "radial z\nN", "moment y\nN m", "moment z\nN m")


def spectrum_record(solution: Solution, readings: Readings) -> Record:
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
        "message": message(solution),
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


def spectrum_result(solution: Solution, readings: Readings) -> list[Block]:
    """A row for each operating point, and the life of all together."""
    spectrum, life = spectrum_record(solution, readings), readings["life"]
    name, inner, outer = spectrum["bearing"] or "Bearing", solution.inner.load, solution.outer.load
    head = f"{name}  {len(spectrum['points'])} operating points. {requested_for(spectrum['points'][0])}"
    loads = [i for i in range(5) if np.nan_to_num(solution.load[:, i]).any()]
    results = ("largest\nball load\nN", "life\nMrev", "life\nh", "damage\n%")
    heading, rows = ("point", "share", "speed\nrpm", *(NAMES[i] for i in loads), *results), []
    for k, point in enumerate(spectrum["points"]):
        largest = np.fmax(inner[k], outer[k])
        own = life.duration[k] / HOUR
        turns = own * HOUR * abs(life.speed[k]) / (2.0 * np.pi) / MILLION if life.speed[k] else np.nan
        rows.append((
            f"{k + 1}",
            f"{point['share']:.6g}",
            f"{life.speed[k] / rpm:.6g}",
            *(digits_of(LOAD[i].of(solution.load[k])) for i in loads),
            digits_of(np.nan if np.isnan(largest).all() else np.nanmax(largest)),
            digits_of(turns),
            digits_of(own),
            digits_of(100.0 * (np.nan if point["damage_share"] is None else point["damage_share"])),
        ))  # fmt: skip
    parts: list[Block] = [Paragraph(head, name), Paragraph(spectrum["message"])]
    parts.append(Table(heading, rows, caption="Load spectrum"))
    if spectrum["duration_h"] is not None:
        whole = (
            f"Life under the whole spectrum: {digits_of(spectrum['duration_h'])} h, {digits_of(spectrum['life_Mrev'])} "
            "million revolutions"
        )
        parts.append(Paragraph(whole, is_apart=True))
    return [*parts, *blocks(of_points(solution, readings), is_apart=True)]
