"""Rows of makers' catalogues as data sheets, and how the inferred lists do against what is known."""

from __future__ import annotations

import csv
from collections import defaultdict
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import qsbearing as qs
from fem_check.book.cases.gmn_rigidities import Rows
from qsbearing.inference.ball_sets import INCH_SIZES

DATA = Path(__file__).parent / "data"
KGF = 9.80665
SAME = 0.001
"""Part of a ball diameter by which printed ones may differ from steps of an inch."""


class Known(NamedTuple):
    """A data sheet, and its ball set as printed elsewhere in the row."""

    name: str
    sheet: dict[str, Any]
    ball_count: int
    ball_diameter: float

    def place(self, found: qs.InferredBearing) -> int:
        """Of the known set in the list; -1 where it is not."""
        same = (found.bearing.ball_count == self.ball_count) & self.has_diameter(found)
        return int(found.set_number[same][0]) if same.any() else -1

    def has_diameter(self, found: qs.InferredBearing) -> Any:
        """Which cases have its ball diameter."""
        return np.abs(found.bearing.ball_diameter / self.ball_diameter - 1.0) < SAME


def sheet(d: float, D: float, angle: float, C: float, C0: float, **others: Any) -> dict[str, Any]:
    """Fields of a data sheet, from mm, degrees and N."""
    return {
        "bore_diameter": d * qs.mm, "outside_diameter": D * qs.mm, "free_contact_angle": angle * qs.deg,
        "dynamic_load_rating": C, "static_load_rating": C0, **others,
    }  # fmt: skip


def deep_groove(d: float, D: float, C: float, C0: float, **others: Any) -> dict[str, Any]:
    """Likewise, with a clearance of 10 um."""
    fields = sheet(d, D, 0.0, C, C0, kind="deep_groove", diametral_clearance=10 * qs.um, **others)
    del fields["free_contact_angle"]
    return fields


def gmn(rows: Rows, series: str, **others: Any) -> list[Known]:
    """GMN's rows of a series."""
    return [
        Known(
            row["name"],
            sheet(row["d_mm"], row["D_mm"], row["alpha_deg"], row["C"], row["C0"], **others),
            int(row["Z"]),
            row["Dw_mm"] * qs.mm,
        )
        for row in rows
        if row["name"].startswith(series)
    ]


def read(name: str) -> list[dict[str, str]]:
    """A table of this folder."""
    with (DATA / f"{name}.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def snfa() -> dict[tuple[str, int], list[Known]]:
    """SNFA's rows by series and contact angle, but screw-support bearings."""
    found = defaultdict(list)
    for row in read("snfa_spindle_bearings"):
        series = row["name"].rpartition(" ")[0]
        nominal = float(row["Dw_mm"]) * qs.mm
        diameter = float(INCH_SIZES[np.argmin(np.abs(INCH_SIZES - nominal))])
        for angle in (15, 25):
            C, C0 = row[f"C_{angle}deg"], row[f"C0_{angle}deg"]
            if C and C0 and not series.startswith("BS"):
                ratings = float(C) * KGF, float(C0) * KGF
                fields = sheet(float(row["bore_mm"]), float(row["outside_mm"]), angle, *ratings)
                found[series, angle].append(Known(row["name"], fields, int(float(row["Z"])), diameter))
    return found


def snfa_rigidities(known: Known) -> list[tuple[float, float, float]]:
    """Of series VEB: preload [N], rigidity of a pair [N/m] and half of its last digit; unloading rigidities."""
    angle = round(known.sheet["free_contact_angle"] / qs.deg)
    rows = [row for row in read("snfa_veb") if row["size"] == known.name and int(row["angle_deg"]) == angle]
    unit = 10.0 * qs.N / qs.um
    return [
        (10.0 * float(row["preload_daN"]), float(row["pair_rigidity_daN_per_um"]) * unit, 0.05 * unit) for row in rows
    ]
