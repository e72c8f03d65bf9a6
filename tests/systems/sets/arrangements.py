"""Sets that the tests share."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import qsbearing as qs
from tests.qsbearing.scenes import BOTH, OUTER

CATALOGUE = Path(__file__).parents[3] / "qsbearing" / "files" / "catalogue" / "gmn_spindle_bearings.csv"
PAIR_FILE = """
[bearing]
name = "7210C"
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 20
carries = "-x"
[operation]
speed_rpm = 10000
axial_load_N = 200
[preload]
rigid_N = 720
[effects]
ball = ["centrifugal_force"]
raceway_control = "outer"
"""
"""A rigidly preloaded pair in a file."""
PRINTED_STEEL = qs.Material(208 * qs.GPa, 0.3, 7800.0)
"""E' with which the maker's printed rigidities were shown to be made."""


def printed(name: str) -> dict[str, Any]:
    """A row of the maker's catalogue."""
    with CATALOGUE.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["name"] == name:
                return {key: value if key == "name" else float(value) for key, value in row.items()}
    raise LookupError(name)


def spindle(name: str, f: float) -> qs.BallBearing:
    """A bearing of that catalogue with both groove radii f D."""
    row = printed(name)
    diameter = row["Dw_mm"] * qs.mm
    return qs.BallBearing(
        ball_count=int(row["Z"]),
        ball_diameter=diameter,
        pitch_diameter=row["dm_mm"] * qs.mm,
        inner_groove_radius=f * diameter,
        outer_groove_radius=f * diameter,
        free_contact_angle=row["alpha_deg"] * qs.deg,
        ball_material=PRINTED_STEEL,
        ring_material=PRINTED_STEEL,
        name=name.removesuffix(" TA"),
    )


def grooved_both_ways(diametral_clearance: ArrayLike) -> qs.BallBearing:
    """Of 60 mm pitch diameter with this clearance [m], whose grooves carry both ways."""
    ball = 11.90625 * qs.mm
    return qs.BallBearing.from_diametral_clearance(
        kind=qs.BearingKind.DEEP_GROOVE, ball_count=9, ball_diameter=ball, pitch_diameter=60 * qs.mm,
        inner_groove_radius=0.52 * ball, outer_groove_radius=0.52 * ball, diametral_clearance=diametral_clearance,
        ball_material=qs.STEEL, ring_material=qs.STEEL,
    )  # fmt: skip


S6210C, S6210E = spindle("S 6210 C TA", 0.5182), spindle("S 6210 E TA", 0.5182)
DISTANCE = 20 * qs.mm
ROWS = {
    "DB": ("+x", "-x"),
    "DF": ("-x", "+x"),
    "DT": ("+x", "+x"),
    "TBT": ("+x", "+x", "-x"),
    "QBC": ("+x", "+x", "-x", "-x"),
}


def rows(arrangement: str, *bearings: qs.BallBearing, distance: float = DISTANCE, **fields: Any) -> tuple[qs.Row, ...]:
    """Rows at equal distances, about x = 0; the bearings in turn."""
    directions, given = ROWS[arrangement], bearings or (S6210C,)
    first = -0.5 * distance * (len(directions) - 1)
    return tuple(
        qs.Row(given[n % len(given)], first + n * distance, carries, **fields)  # type: ignore[arg-type]
        for n, carries in enumerate(directions)
    )


def pair(
    arrangement: str = "DB", preload: Any = None, *, distance: float = DISTANCE, **operation: Any
) -> qs.BearingSet:
    """Two rows of S 6210 C, both ball effects where they turn."""
    force = None if preload is None else qs.Preload(rigid=preload)
    effects = {"ball_effects": BOTH, "raceway_control": OUTER} if "speed" in operation else {}
    return qs.BearingSet(rows(arrangement, distance=distance), qs.Operation(**operation), force, **effects)


def solved(of: qs.BearingSet) -> qs.SetSolution:
    """Its solution; every case must have one."""
    solution = qs.solve_set(of)
    assert np.all(solution.converged), solution.message(None if not solution.shape else (0,) * len(solution.shape))
    return solution


def with_load(of: qs.BearingSet, **operation: Any) -> qs.BearingSet:
    """The same set under another operation, its speed kept."""
    return replace(of, operation=replace(of.operation, **operation))
