"""What a solved shaft does along it and at its points, as plain data and as tables for people."""

from __future__ import annotations

import numpy as np

from qsbearing.documents.model import Table
from qsbearing.model.solution.judgement import percent
from qsbearing.model.units import mm
from qsbearing.results.group_numbers import tables_of
from qsbearing.results.record_type import Record
from qsbearing.results.report import digits
from qsbearing.results.tables import digits_of
from qsbearing.systems.sets.bearing_set import places_on_shaft
from qsbearing.systems.sets.set_groups import SHAFT, SHARES, groups_of_set
from qsbearing.systems.sets.set_solution import SetSolution

NOISE = 1e-9
"""Of the largest in a column, or of a kind: less is rounding of equilibria that are found to 1e-10."""
LEAST_SHARE = 1e-4
"""Less is said to be nothing."""


def shaft_record(solution: SetSolution) -> Record | None:
    """Of a single case; None without a shaft."""
    shaft = solution.set.shaft
    if shaft is None:
        return None
    tables = tables_of((each for each in groups_of_set(solution) if each.table and each.table[0] == SHAFT), solution)
    own = tables[SHAFT]
    line = [
        {"at": name, "position_mm": float(position / mm), **own["line"][name]}
        for name, position in places_on_shaft(solution.set).items()
    ]
    points = {
        name: {"position_mm": float(point.position / mm), **own["points"][name]}
        for name, point in solution.points.items()
    }
    return {"points": points, "line": line, "supports": [*own.get("supports", {}).values()]}


def shaft_tables(shaft: Record | None) -> list[Table]:
    """Of a record: deflection and inner forces along the shaft; stiffness of its points, and whose it is."""
    if shaft is None:
        return []
    straight = ("x\nmm", "axial\nµm", "radial y\nµm", "radial z\nµm", "tilt z\nmrad")
    heading = ["", *straight, "shear y\nN", "shear z\nN", "moment z\nN m"]
    grows = any(each["axial_growth_um"] is not None for each in shaft["line"])
    heading += ["growth by\nheat µm"] if grows else []
    rows = [_values(each) for each in shaft["line"]]
    noise = NOISE * np.abs(np.array(rows, float)).max(axis=0)
    noise[5:7], noise[1:4] = noise[5:7].max(), noise[1:4].max()
    cells = [(each["at"], *map(digits, values, noise)) for each, values in zip(shaft["line"], rows, strict=True)]
    title = "Shaft: deflection and internal forces (of the part after x on the part before)"
    tables = [Table(heading, cells, caption=title)]
    for name, point in shaft["points"].items():
        heading = ["", *(each.plain_name for each in SHARES)]
        cells = [("stiffness, N/µm and N m/mrad", *map(digits_of, point["effective_stiffness"].values()))]
        for part, share in point["shares"].items():
            cells.append((f"deflection due to {part}", *map(_share, share.values())))
        tables.append(Table(heading, cells, caption=f"Point {name}, at {point['position_mm']:.6g} mm"))
    return tables


def _values(each: Record) -> list[float]:
    """Of a place on the shaft, as a line of the table has them."""
    bent, inner = list(each["displacement"].values()), list(each["inner_forces"].values())
    grown = [] if each["axial_growth_um"] is None else [each["axial_growth_um"]]
    return [each["position_mm"], *bent[:3], bent[4], inner[1], inner[2], inner[4], *grown]


def _share(value: float | None) -> str:
    return "-" if value is None else "0" if value < LEAST_SHARE else percent(value)
