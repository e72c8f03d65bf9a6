"""Boundary dimensions of radial ball bearings, by dimension series and bore (ISO 15).

No formula gives them (a growth rule of the diameter meets 0 to 16 % of the rows), so the table is what catalogues
print: 230 pairs of series and bore, 152 of them alike in two or more of five catalogues, none otherwise.
"""

from __future__ import annotations

import csv
from functools import cache, lru_cache
from pathlib import Path


@cache
def table() -> dict[tuple[str, float], tuple[float, float]]:
    """Outside diameter and width [mm] by dimension series, such as "10", and bore diameter [mm]."""
    text = Path(__file__).with_name("iso15.csv").read_text("utf-8")
    return {
        (row["dimension_series"], float(row["bore_mm"])): (float(row["outside_mm"]), float(row["width_mm"]))
        for row in csv.DictReader(text.splitlines())
    }


@lru_cache(1000)
def width(bore: float, outside: float) -> float | None:
    """Width [mm] by bore and outside diameter [mm]; None where no series has this pair.

    Series 00 and 10 have the same diameters; the width is that of 10, which nearly every bearing has.
    """
    widths = [size[1] for (series, d), size in table().items() if (d, size[0]) == (bore, outside) and series != "00"]
    return widths[0] if widths else None


@lru_cache(1000)
def series_of(bore: float, outside: float) -> str:
    """The dimension series of this bore and outside diameter [mm], "10" where it may be 00 too; empty: of none."""
    pair = round(bore, 6), round(outside, 6)
    series = [name for (name, d), size in table().items() if (d, size[0]) == pair and name != "00"]
    return series[0] if series else ""
