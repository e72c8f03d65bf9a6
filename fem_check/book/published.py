"""Published tables that cases and tests are held against, as printed, and bearings in the units they are printed in."""

from __future__ import annotations

import csv
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs

# ISO 76:2006, table 1 (GOST 18854-2013, pp. 5-6): f0 by gamma in steps of 0.01.
# fmt: off
STATIC_RADIAL = np.array([
    14.7, 14.9, 15.1, 15.3, 15.5, 15.7, 15.9, 16.1, 16.3, 16.5, 16.4, 16.1, 15.9, 15.6, 15.4, 15.2, 14.9, 14.7, 14.4,
    14.2, 14.0, 13.7, 13.5, 13.2, 13.0, 12.8, 12.5, 12.3, 12.1, 11.8, 11.6, 11.4, 11.2, 10.9, 10.7, 10.5, 10.3, 10.0,
    9.8, 9.6, 9.4,
])
STATIC_THRUST = np.array([
    61.6, 60.8, 59.9, 59.1, 58.3, 57.5, 56.7, 55.9, 55.1, 54.3, 53.5, 52.7, 51.9, 51.2, 50.4, 49.6, 48.8, 48.0, 47.3,
    46.5, 45.7, 45.0, 44.2, 43.5, 42.7, 41.9, 41.2, 40.5, 39.7, 39.0, 38.2, 37.5, 36.8, 36.0, 35.3, 34.6,
])
RELIABILITY = {  # ISO 281:2007, table 12 (GOST 18855-2013, p. 21)
    0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25, 0.992: 0.22, 0.994: 0.19, 0.996: 0.16,
    0.998: 0.12, 0.999: 0.093, 0.9992: 0.087, 0.9994: 0.080, 0.9995: 0.077,
}
RADIAL_FACTOR = np.array([  # ISO 281:2007, table 2 (GOST 18855-2013): fc by gamma from 0.01 in steps of 0.01
    29.1, 35.8, 40.3, 43.8, 46.7, 49.1, 51.1, 52.8, 54.3, 55.5, 56.6, 57.5, 58.2, 58.8, 59.3, 59.6, 59.8, 59.9, 60.0,
    59.9, 59.8, 59.6, 59.3, 59.0, 58.6, 58.2, 57.7, 57.1, 56.6, 56.0, 55.3, 54.6, 53.9, 53.2, 52.4, 51.7, 50.9, 50.0,
    49.2, 48.4,
])
# fmt: on

ISO_STEEL = qs.Material(207e9, 0.3, 7800.0)
"""The steel that ISO 76 and ISO 281 take."""


def bearing(
    Z: Any, D: Any, dm: Any, angle: Any, inner_f: Any = 0.52, outer_f: Any = 0.52, **more: Any
) -> qs.BallBearing:
    """A bearing from millimetres and degrees, of the standards' steel unless told otherwise; arrays span cases."""
    fields = {"ball_material": ISO_STEEL, "ring_material": ISO_STEEL} | more
    return qs.BallBearing(Z, D * 1e-3, dm * 1e-3, inner_f * D * 1e-3, outer_f * D * 1e-3, angle * qs.deg, **fields)


def gmn_rows() -> list[dict[str, Any]]:
    """GMN's catalogue: `name` and numbers in the units of the column names; forces in N, rigidities in N/um.

    One column is not GMN's, `inferred_f`, which no case of the book reads.
    """
    text = (files("qsbearing.files.catalogue") / "gmn_spindle_bearings.csv").read_text("utf-8")
    return [
        {key: value if key == "name" else float(value) for key, value in row.items() if value}
        for row in csv.DictReader(text.splitlines())
    ]


def gmn(series: str, angle: float) -> list[dict[str, Any]]:
    """Rows of GMN's catalogue of one series and contact angle."""
    return [row for row in gmn_rows() if row["name"].startswith(series) and row["alpha_deg"] == angle]


def columns_of(table: str) -> dict[str, NDArray]:
    """A table of the book's data folder by its columns: numbers in the units of their names, and `name`."""
    text = (files("fem_check.book") / "data" / f"{table}.csv").read_text("utf-8")
    rows = list(csv.DictReader(text.splitlines()))
    return {key: np.array([row[key] for row in rows], str if key == "name" else float) for key in rows[0]}


def endurance_groups() -> NDArray:
    """Lieblein & Zelen: columns company, bearings, load [N], Z, D [mm], L10 [10^6 rev]."""
    lines = (files("fem_check.book") / "data" / "lieblein_zelen_1956.dat").read_text("utf-8").splitlines()
    table = np.genfromtxt(lines, skip_header=1, usecols=(0, 3, 4, 5, 6, 7))
    table[:, 2] *= 4.4482216
    table[:, 4] *= 25.4
    return table
