"""Standard spindle bearings from one printed table: series 719 and 72, and high-speed ones of series 70 and 719.

The table is GMN's; names are those of ISO's dimension series with a letter for the angle: S 61914 C, of 15 degrees, is
71914C here, S 61914 E, of 25 degrees, 71914E; KH, with small balls and 17 or 25 degrees, stays before the number. With
_hybrid behind it the balls are of silicon nitride.
"""

from __future__ import annotations

import csv
from functools import cache
from math import cos, radians
from pathlib import Path
from typing import Any

from qsbearing.files.catalogue.entry import CatalogueEntry

SOURCE = "GMN Paul Mueller Industrie, High precision ball bearings, catalogue 4000 0813 EN, tables of spindle bearings"
HYBRID = "_hybrid"
LEAST_RIGIDITY = 80.0
"""Axial rigidity at heavy preload [N/um] from which the rigidities of a row of series KH tell its groove: their
rounding is 0.6 %. Below it the rows of KH, whose grooves are alike, have the median of the others. Those of series S
are not alike: each has its own, which agrees with that of the same bearing at 25 degrees to 0.0007."""
LEAST_SHOULDER = 0.14
"""Height over the bottom of the groove, in ball diameters, from which a printed d1 or D1 is that of the shoulder that
carries the thrust (chosen: what the ellipse under a thrust of half C0 needs at 15 degrees). The table does not say
which face of a ring it measures, and some of its diameters lie beyond the bottom of the groove."""
_DIMENSIONS = {
    "bore_diameter_mm": "d_mm", "outside_diameter_mm": "D_mm", "width_mm": "B_mm",
    "inner_shoulder_diameter_mm": "d1_mm", "outer_shoulder_diameter_mm": "D1_mm",
    "dynamic_load_rating_N": "C", "static_load_rating_N": "C0", "oil_speed_limit_rpm": "n_oil",
    "preload_light_N": "FvL", "preload_medium_N": "FvM", "preload_heavy_N": "FvS",
}  # fmt: skip


@cache
def spindle_bearings() -> dict[str, CatalogueEntry]:
    """Every row of the table, with steel balls and with ceramic ones, by its name in small letters."""
    return {name: entry for name in _rows() if (entry := spindle_bearing(name)) is not None}


@cache
def spindle_bearing(name: str) -> CatalogueEntry | None:
    """The row of this name in small letters; None where there is none. To make all takes a tenth of a `run`."""
    return _entry(*_rows()[name]) if name in _rows() else None


@cache
def _rows() -> dict[str, tuple[str, dict[str, str], bool]]:
    """Name, row of the table, and whether it is one of ceramic balls, by the name in small letters."""
    text = Path(__file__).with_name("gmn_spindle_bearings.csv").read_text("utf-8")
    rows = {}
    for row in csv.DictReader(text.splitlines()):
        series, number, letter, *_ = row["name"].split()
        name = ("" if series == "S" else series) + "7" + number[1:].replace("/", "-") + letter
        for full, is_hybrid in ((name, False), (name + HYBRID, True)):
            rows[full.lower()] = (full, row, is_hybrid)
    return rows


def _entry(name: str, texts: dict[str, str], is_hybrid: bool) -> CatalogueEntry:
    printed, row = texts["name"], {key: float(each) for key, each in texts.items() if key != "name"}
    diameter, f = row["Dw_mm"], row["inferred_f"]
    bearing: dict[str, Any] = {
        "kind": "angular_contact",
        "ball_count": int(row["Z"]),
        "ball_diameter_mm": diameter,
        "pitch_diameter_mm": row["dm_mm"],
        "inner_groove_radius_mm": round(f * diameter, 5),
        "outer_groove_radius_mm": round(f * diameter, 5),
        "free_contact_angle_deg": row["alpha_deg"],
        "ball_material": "silicon nitride" if is_hybrid else "steel",
        "ring_material": "steel",
    }
    balls = "silicon nitride" if is_hybrid else "steel"
    size = f"{row['d_mm']:g} x {row['D_mm']:g} x {row['B_mm']:g} mm"
    dimensions = {key: row[column] for key, column in _DIMENSIONS.items()}
    if is_hybrid:
        dimensions["static_load_rating_N"] = row["C0_HY"]
    dimensions = {_of_face(key, value, bearing): value for key, value in dimensions.items()}
    return CatalogueEntry(
        name,
        f"{size} spindle bearing, {row['alpha_deg']:g} degrees, {balls} balls (GMN {'HY ' * is_hybrid}{printed})",
        f"{SOURCE}, row {printed}; groove radii are inferred, see provenance",
        bearing,
        _provenance(printed, row, is_hybrid),
        {},
        {
            "operation": {"speed_rpm": row["n_oil"], "axial_load_N": row["Ff"]},
            "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
        },
        dimensions,
    )


def _of_face(key: str, diameter: float, bearing: dict[str, Any]) -> str:
    """The key of a printed dimension: a shoulder that is too low for one is only a face of its ring."""
    side, is_shoulder, rest = key.partition("_shoulder")
    if not is_shoulder:
        return key
    outward, ball = 1.0 if side == "outer" else -1.0, bearing["ball_diameter_mm"]
    spread = 2.0 * bearing["inner_groove_radius_mm"] - ball
    bottom = bearing["pitch_diameter_mm"] + outward * (
        ball + spread * (1.0 - cos(radians(bearing["free_contact_angle_deg"])))
    )
    return key if 0.5 * outward * (bottom - diameter) >= LEAST_SHOULDER * ball else f"{side}_face{rest}"


def _provenance(printed: str, row: dict[str, float], is_hybrid: bool) -> dict[str, str]:
    columns = {
        "ball_count": "Z", "ball_diameter_mm": "Dw", "pitch_diameter_mm": "dm", "free_contact_angle_deg": "alpha",
    }  # fmt: skip
    provenance = {key: f"catalogue row {printed}, column {column}" for key, column in columns.items()}
    is_median = printed.startswith("KH") and row["CaxS"] < LEAST_RIGIDITY
    fitted = (
        "the median of its series, because the row's own rigidities are printed to too few digits"
        if is_median
        else "the value that meets the row's three printed axial rigidities best, with steel of 208 GPa"
    )
    groove = f"inferred: not in the catalogue. f = {row['inferred_f']:g}, equal in both rings (assumed), is {fitted}"
    if printed.startswith("KH"):
        groove += ". The static ratings of KH rows ask for 0.56 at the inner ring, whose pressures may be higher"
    provenance |= {"inner_groove_radius_mm": groove, "outer_groove_radius_mm": "inferred: see inner_groove_radius_mm"}
    provenance["ball_material"] = (
        "catalogue: all sizes are offered with balls of Si3N4, prefix HY; that the rings keep their grooves is assumed"
        if is_hybrid
        else "catalogue: balls of 100Cr6, 7.8 g/cm3; the elastic constants are those of this program's steel, assumed"
    )
    provenance["ring_material"] = (
        "catalogue: rings of 100Cr6; the elastic constants are those of this program's steel, assumed"
    )
    return provenance
