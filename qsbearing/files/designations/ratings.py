"""Ratings that makers print of bearings by their designation. Ball sets stand in no such table: they follow from these.

SKF, general catalogue, deep groove ball bearings; NSK, rolling bearings, deep groove ball bearings; NTN-SNR, high
precision bearings ULTAGE, pp. 4-7, of 15 degrees. Rows of other series, which judge the inference, are not in it.
"""

from __future__ import annotations

import csv
from functools import cache
from pathlib import Path
from typing import NamedTuple

from qsbearing.files.designations.designation import Designation


class PrintedRatings(NamedTuple):
    """Of one row of balls."""

    maker: str
    dynamic: float
    """C [N]."""
    static: float
    """C0 [N]."""
    f0: float | None


class _Bearing(NamedTuple):
    """What tells a bearing among those of a maker."""

    series: str
    bore: float
    angle: float | None


def ratings_of(told: Designation) -> list[PrintedRatings]:
    """Those of its maker, or of each maker where it names none; empty where none are known here.

    Nothing is told of ceramic balls and of prefixes that are not known.
    """
    if told.is_refused or told.ball_material or not told.is_prefix_known:
        return []
    suffixes = {told.letters, *told.ignored.split()}
    rows = _table().get(_Bearing(told.series, told.bore, told.angle), {})
    of_makers = {}
    for (maker, suffix), each in rows.items():
        if told.maker in ("", maker) and suffix in suffixes | {""}:
            of_makers[maker] = each  # a row with a suffix goes before one without
    return list(of_makers.values())


@cache
def _table() -> dict[_Bearing, dict[tuple[str, str], PrintedRatings]]:
    """By bearing, then by maker and suffix, those without a suffix first."""
    text = Path(__file__).with_name("ratings.csv").read_text("utf-8")
    table: dict[_Bearing, dict[tuple[str, str], PrintedRatings]] = {}
    for row in sorted(csv.DictReader(text.splitlines()), key=lambda row: row["suffix"]):
        angle = float(row["angle_deg"]) if row["angle_deg"] else None
        printed = PrintedRatings(row["maker"], float(row["C_N"]), float(row["C0_N"]), float(row["f0"] or 0.0) or None)
        of = table.setdefault(_Bearing(row["series"], float(row["bore_mm"]), angle), {})
        of[row["maker"], row["suffix"]] = printed
    return table
