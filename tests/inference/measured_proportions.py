"""From which ball sets the proportions of a dimension series come, and how often the range of a guess holds the axial
stiffness of printed sets that chose none of them: python -m tests.inference.measured_proportions prints both.
"""

from __future__ import annotations

import csv
from collections import defaultdict
from collections.abc import Iterable
from importlib.resources import files
from typing import Any, NamedTuple

import numpy as np

import qsbearing as qs
from fem_check.book.published import columns_of
from qsbearing.inference import iso15
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.inference.proportions import WIDENED, proportions_of
from tests.inference.data_sheets import Known, deep_groove, sheet, snfa
from tests.inference.measured import inferred, own_grooves

HEADING = "| rows | answered | stiffness of the printed set in the range | range, median | sets listed, median |"
OF_40_DEGREES = {  # SKF, general catalogue: bore, outside diameter [mm], C, C0 [N]
    "7208 BEP": (40, 80, 36500, 26000),
    "7210 BEP": (50, 90, 37700, 28500),
    "7211 BEP": (55, 100, 46200, 36000),
    "7308 BEGAPH": (40, 90, 50000, 32500),
    "7310 BEP": (50, 110, 68900, 47500),
}
SERIES = "series 10", "series 19"


class Share(NamedTuple):
    """Of one ball set."""

    height: float
    fill: float


def share(bore: float, outside: float, count: float, diameter: float) -> Share:
    """Of lengths in one unit."""
    return Share(diameter / (0.5 * (outside - bore)), count * diameter / (0.5 * np.pi * (bore + outside)))


def of_known(known: Known) -> Share:
    """Of a printed set."""
    return share(known.sheet["bore_diameter"], known.sheet["outside_diameter"], known.ball_count, known.ball_diameter)


def of_single_lists() -> dict[str, list[Share]]:
    """Of deep groove bearings of 10 mm bore and more, whose ratings allow one set, by dimension series."""
    shares = defaultdict(list)
    table = files("qsbearing.files.designations").joinpath("ratings.csv").read_text("utf-8")
    for row in csv.DictReader(table.splitlines()):
        series, bore = row["series"], float(row["bore_mm"])
        code = {"618": "18", "619": "19", "60": "10", "62": "02", "63": "03", "64": "04"}.get(series, "")
        if not code or row["angle_deg"] or row["suffix"] or bore < 10.0:
            continue
        outside, _ = iso15.table()[code, bore]
        f0 = {"f0": float(row["f0"])} if row["f0"] else {}
        ratings = float(row["C_N"]), float(row["C0_N"])
        found = inferred(Known(series, deep_groove(bore, outside, *ratings, maker=row["maker"], **f0), 0, 1.0))
        if found is not None and found.set_number[-1] == 0:
            best: Any = found.at(0)
            shares[code].append(share(bore, outside, best.ball_count, best.ball_diameter / qs.mm))
    return shares


def of_ntn() -> dict[str, list[Share]]:
    """Of NTN's spindle bearings, by dimension series, as their ratings tell them."""
    shares = defaultdict(list)
    columns = columns_of("ntn_ultage_rigidities")
    names = "bore_mm", "outside_mm", "Z_inferred", "Dw_inferred_mm"
    for bore, outside, count, diameter in zip(*(columns[name] for name in names), strict=True):
        each = share(float(bore), float(outside), float(count), float(diameter))
        shares[iso15.series_of(float(bore), float(outside))].append(each)
    return shares


def of_40_degrees() -> list[Share]:
    """Of every set that the ratings of SKF's BE allow."""
    shares = []
    for bore, outside, *ratings in OF_40_DEGREES.values():
        found = inferred(Known("", sheet(bore, outside, 40, *ratings, maker="SKF"), 0, 1.0))
        assert found is not None
        pairs = zip(found.bearing.ball_count, found.bearing.ball_diameter, strict=True)  # type: ignore[arg-type]
        shares += [share(bore, outside, count, diameter / qs.mm) for count, diameter in pairs]
    return shares


def quantiles(shares: Iterable[Share]) -> tuple[tuple[float, float], ...]:
    """Of 2 and 98 %, widened: of heights, of fills."""
    low, high = np.quantile(np.array(list(shares)), [0.02, 0.98], axis=0)
    return tuple((float(a * (1.0 - WIDENED)), float(b * (1.0 + WIDENED))) for a, b in zip(low, high, strict=True))


def measured() -> dict[str, tuple[tuple[float, float], ...]]:
    """By kind and series."""
    ntn = of_ntn()
    spindle = {
        "19": [*map(of_known, own_grooves("S 619")), *ntn["19"]],
        "10": ntn["10"],
        "02": [of_known(known) for (name, _), rows in snfa().items() if name == "E 2" for known in rows],
    }
    every = {f"angular_contact {series}": quantiles(shares) for series, shares in spindle.items()}
    every |= {f"deep_groove {series}": quantiles(shares) for series, shares in sorted(of_single_lists().items())}
    return every | {"40 degrees": quantiles(of_40_degrees())}


JUDGES = {
    "GMN S 62": ("own", "S 62"),
    "SNFA SEB": ("snfa", "SEB"),
    "SNFA EX": ("snfa", "EX"),
}


def judges(name: str) -> list[Known]:
    """Rows whose series has proportions, of printed sets that chose none."""
    whose, series = JUDGES[name]
    by_series = [known for (each, _), rows in snfa().items() if each == series for known in rows]
    rows = own_grooves(series) if whose == "own" else by_series
    return [known for known in rows if proportions_of(guess(known)) is not None]


def guess(known: Known) -> DataSheet:
    """The row without its ratings."""
    names = "bore_diameter", "outside_diameter", "free_contact_angle"
    return DataSheet(**{name: known.sheet[name] for name in names}, rating_practice="proportions")  # type: ignore[arg-type]


def coverage(name: str) -> tuple[int, float, float, float]:
    """Rows; how often the stiffness of the printed set lies in the range, both of f = 0.52; the range; sets."""
    inside, widths, sets = [], [], []
    for known in judges(name):
        listed = qs.infer_bearing(guess(known))
        load = 0.01 * known.sheet["dynamic_load_rating"]
        operation = qs.Operation(axial_load=load)
        f = 0.52 * known.ball_diameter
        lengths = known.ball_diameter, np.mean([known.sheet["bore_diameter"], known.sheet["outside_diameter"]])
        true = qs.BallBearing(known.ball_count, *lengths, f, f, known.sheet["free_contact_angle"])
        own = float(qs.solve(qs.Scene(true, operation)).stiffness[0, 0])
        usual = qs.solve(qs.Scene(listed.bearing, operation)).stiffness[::3, 0, 0]
        between = listed.range_of(usual)
        inside.append(between.least <= own <= between.most)
        widths.append(between.width / own)
        sets.append(listed.set_number[-1] + 1)
    return len(inside), float(np.mean(inside)), float(np.median(widths)), float(np.median(sets))


def table() -> list[str]:
    """Its lines."""
    lines = [HEADING, "|---|---|---|---|---|"]
    for name in JUDGES:
        count, inside, width, sets = coverage(name)
        lines.append(f"| {name} | {count} | {100.0 * inside:.0f} % | {100.0 * width:.0f} % | {sets:g} |")
    return lines


if __name__ == "__main__":
    for name, limits in measured().items():
        print(name, ", ".join(f"({low:.3f}, {high:.3f})" for low, high in limits))
    print("\n".join(table()))
