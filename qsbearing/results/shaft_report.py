"""What a solved shaft does along it and at its points, as plain data and as tables for people."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from qsbearing.documents.model import Table
from qsbearing.files.keys import keys_of
from qsbearing.model.solution.judgement import percent
from qsbearing.model.units import mm
from qsbearing.remarks.wording import listed
from qsbearing.results.group_numbers import tables_of
from qsbearing.results.record_type import Record
from qsbearing.results.report import digits
from qsbearing.results.tables import digits_of
from qsbearing.systems.sets.bearing_set import places_on_shaft
from qsbearing.systems.sets.set_groups import BELT, GEAR, SHAFT, SHARES, TORQUES, groups_of_set
from qsbearing.systems.sets.set_solution import SetSolution

NOISE = 1e-9
"""Of the largest in a column, or of a kind: less is rounding of equilibria that are found to 1e-10."""
LEAST_SHARE = 1e-4
"""Less is said to be nothing."""
TORQUE_SUM = TORQUES.results[0].in_record
_DRIVES = {"gear": (GEAR, ("tangential", "inwards", "axial")), "belt": (BELT, ("tight", "slack"))}
"""What the table of each kind shows, and the headings."""
_SIGNS = {
    "gear": "forces of the mate (tangential: towards growing azimuth; axial: +x)",
    "belt": "tensions of the strands",
}


def shaft_record(solution: SetSolution) -> Record | None:
    """Of a single case; None without a shaft."""
    shaft = solution.set.shaft
    if shaft is None:
        return None
    tables = tables_of(
        (each for each in groups_of_set(solution.set) if each.table and each.table[0] == SHAFT), solution
    )
    own = tables[SHAFT]
    line = [
        {"at": name, "position_mm": float(position / mm), **own["line"][name]}
        for name, position in places_on_shaft(solution.set).items()
    ]
    points = {
        name: {"position_mm": float(point.position / mm), **own["points"][name]}
        for name, point in solution.points.items()
    }
    standing = {kind: [*own.get(kind, {}).values()] for kind in ("supports", "gears", "belts")}
    for kind in _DRIVES:
        for each, drive in zip(standing[f"{kind}s"], shaft.standing[kind], strict=True):
            keys = (key for key in keys_of(type(drive)) if key.field in drive.assumed)
            each["assumed"] = {key.name: key.in_file(drive.assumed[key.field]) for key in keys}
    return {"points": points, "line": line, **standing, TORQUE_SUM: own.get(TORQUE_SUM)}


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
    tables = [*_drive_tables(shaft), Table(heading, cells, caption=title)]
    for name, point in shaft["points"].items():
        heading = ["", *(each.plain_name for each in SHARES)]
        cells = [("stiffness, N/µm, N m/mrad", *map(digits_of, point["effective_stiffness"].values()))]
        for part, share in point["shares"].items():
            cells.append((f"deflection due to {part}", *map(_share, share.values())))
        tables.append(Table(heading, cells, caption=f"Point {name}, at {point['position_mm']:.6g} mm"))
    return tables


def _drive_tables(shaft: Record) -> list[Table]:
    """What gears and belts put on the shaft; none without them."""
    tables = []
    for kind, (own, named) in _DRIVES.items():
        noise = NOISE * max(
            (abs(each["load"][name]) for each in shaft[f"{kind}s"] for name in each["load"]), default=0.0
        )
        heading = ["", "torque\nN m", *(f"{name}\nN" for name in named), "on shaft\ny N", "on shaft\nz N"]
        cells = [
            (
                f"{kind} {number}",
                *map(digits_of, (each[result.in_record] for result in own)),
                *(digits(each["load"][name], noise) for name in ("radial_y_N", "radial_z_N")),
            )
            for number, each in enumerate(shaft[f"{kind}s"], 1)
        ]
        assumed = [(number, each["assumed"]) for number, each in enumerate(shaft[f"{kind}s"], 1)]
        words = [f"{name} = {value:g} of {kind} {number}" for number, of in assumed for name, value in of.items()]
        if cells:
            caption = (
                f"{kind.capitalize()}s: {_SIGNS[kind]}{'. Assumed: ' * bool(words)}{listed(words) if words else ''}"
            )
            tables.append(Table(heading, cells, caption=caption))
    if tables:
        total = f"Torques on the shaft together: {digits_of(shaft[TORQUE_SUM])} N m about +x"
        tables[-1] = replace(tables[-1], caption=f"{tables[-1].caption}. {total}")
    return tables


def _values(each: Record) -> list[float]:
    """Of a place on the shaft, as a line of the table has them."""
    bent, inner = list(each["displacement"].values()), list(each["inner_forces"].values())
    grown = [] if each["axial_growth_um"] is None else [each["axial_growth_um"]]
    return [each["position_mm"], *bent[:3], bent[4], inner[1], inner[2], inner[4], *grown]


def _share(value: float | None) -> str:
    return "-" if value is None else "0" if value < LEAST_SHARE else percent(value)
