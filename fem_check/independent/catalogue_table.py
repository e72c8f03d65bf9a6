"""The printed table of spindle bearings, read again, and what its rows must be whatever their numbers are.

Ratings for comparison: ISO 281:2007, C = b_m f_c (cos alpha)^0.7 Z^(2/3) Dw^1.8 with f_c by its formula; ISO 76:2006,
C0 = f0 Z Dw^2 cos alpha, of which only the ratio to one value per row is compared.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from math import cos, isclose, radians
from pathlib import Path

TABLE = Path(__file__).parents[2] / "qsbearing" / "files" / "catalogue" / "gmn_spindle_bearings.csv"
INCH = 25.4
SPREAD: dict[str, tuple[float, float | None]] = {"S": (0.16, None), "KH": (0.04, 0.11)}
"""By which C and C0 of a series' bearings may be off the median of their ratio to ISO's: as much as the printed ones
are, rounded up. C0 of the smallest of series S is a third lower: so wide a limit would judge nothing."""
WHY_SPREAD = "the spread of the series as printed: grooves differ from bearing to bearing; it tells of wrong digits"


@dataclass(frozen=True)
class CatalogueRow:
    """A row."""

    columns: dict[str, float]
    name: str
    """As a scene names the bearing."""
    series: str

    @property
    def lengths(self) -> dict[str, float]:
        """By the bearing's fields, SI units."""
        c = self.columns
        return {
            "ball_count": c["Z"],
            "ball_diameter": 1e-3 * c["Dw_mm"],
            "pitch_diameter": 1e-3 * c["dm_mm"],
            "free_contact_angle": radians(c["alpha_deg"]),
            "outline.bore_diameter": 1e-3 * c["d_mm"],
            "outline.outside_diameter": 1e-3 * c["D_mm"],
            "outline.width": 1e-3 * c["B_mm"],
        }

    def others(self, is_hybrid: bool) -> dict[tuple[str, ...], float]:
        """By keys that an entry's dimensions may have: a low shoulder is there a face of its ring."""
        c = self.columns
        return {
            ("inner_shoulder_diameter_mm", "inner_face_diameter_mm"): c["d1_mm"],
            ("outer_shoulder_diameter_mm", "outer_face_diameter_mm"): c["D1_mm"],
            ("dynamic_load_rating_N",): c["C"],
            ("static_load_rating_N",): c["C0_HY"] if is_hybrid else c["C0"],
        }

    @property
    def boundary(self) -> tuple[float, ...]:
        """d, D, B [mm]."""
        return tuple(self.columns[key] for key in ("d_mm", "D_mm", "B_mm"))

    @property
    def size(self) -> str:
        """The designation without series and angle, of which ISO 15 gives the boundary dimensions."""
        return self.name.removeprefix(self.series)[1:-1]

    @property
    def bore_of_designation(self) -> float:
        """By the last two digits [mm]; by what follows a dash, or the last of two digits, below 10 mm."""
        _, dash, bore = self.size.rpartition("-")
        if dash or len(self.size) == 2:
            return float(bore if dash else self.size[1])
        code = int(self.size[-2:])
        return float({0: 10, 1: 12, 2: 15, 3: 17}.get(code, 5 * code))

    @property
    def has_standard_balls(self) -> bool:
        """Whether a maker of balls has this size; inches are printed to a micrometre."""
        size = self.columns["Dw_mm"]
        of_inch = round(size / (INCH / 64.0)) * INCH / 64.0
        return isclose(size, of_inch, abs_tol=6e-4) or isclose(2.0 * size, round(2.0 * size), abs_tol=1e-9)

    @property
    def pitch_over_mean(self) -> float:
        """1 where both rings are as high."""
        c = self.columns
        return 2.0 * c["dm_mm"] / (c["d_mm"] + c["D_mm"])

    @property
    def dynamic_over_iso(self) -> float:
        """C over that of ISO 281; Dw up to 25.4 mm."""
        c = self.columns
        alpha = radians(c["alpha_deg"])
        g = c["Dw_mm"] * cos(alpha) / c["dm_mm"]
        ratio = 1.04 * ((1.0 - g) / (1.0 + g)) ** 1.72
        fc = 0.089 * 39.9 * 10.4 / 8.3125 * 0.9 * g**0.3 * (1.0 - g) ** 1.39 / (1.0 + g) ** (1.0 / 3.0)
        fc *= (1.0 + ratio ** (10.0 / 3.0)) ** -0.3
        return float(c["C"] / (fc * cos(alpha) ** 0.7 * c["Z"] ** (2.0 / 3.0) * c["Dw_mm"] ** 1.8))

    @property
    def static_over_iso(self) -> float:
        """C0 over Z Dw^2 cos alpha: f0, which depends on the grooves."""
        c = self.columns
        return float(c["C0"] / (c["Z"] * c["Dw_mm"] ** 2 * cos(radians(c["alpha_deg"]))))


def rows() -> list[CatalogueRow]:
    """All of the table."""
    bearings = []
    for each in csv.DictReader(TABLE.read_text(encoding="utf-8").splitlines()):
        printed = each.pop("name")
        series, number, letter, *_ = printed.split()
        name = ("" if series == "S" else series) + "7" + number[1:].replace("/", "-") + letter
        bearings.append(CatalogueRow({key: float(value) for key, value in each.items()}, name, series))
    return bearings


def unlike_boundaries(table: list[CatalogueRow]) -> list[str]:
    """Designations whose bore is another than they say, or that have two sets of boundary dimensions."""
    known: dict[str, tuple[float, ...]] = {}
    return [
        row.name
        for row in table
        if row.columns["d_mm"] != row.bore_of_designation or known.setdefault(row.size, row.boundary) != row.boundary
    ]


def unlike_twins(table: list[CatalogueRow]) -> list[str]:
    """Bearings of one size at two angles whose balls or pitch circles differ: their names without the letter."""
    known: dict[str, tuple[float, ...]] = {}
    unlike = []
    for row in table:
        size = tuple(row.columns[key] for key in ("d_mm", "D_mm", "B_mm", "dm_mm", "Dw_mm", "Z"))
        if known.setdefault(row.name[:-1], size) != size:
            unlike.append(row.name[:-1])
    return unlike
