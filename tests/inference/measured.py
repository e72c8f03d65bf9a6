"""How often the list of a data sheet holds the printed ball set: the table of the guide's page.

python -m tests.inference.measured prints it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

import qsbearing as qs
from fem_check.book.published import gmn_rows
from qsbearing.inference.ball_sets import BallSets
from qsbearing.inference.practice import FACTORS
from qsbearing.inference.ratings_fit import ISO_GROOVES, ISO_STEEL, rated
from qsbearing.inference.rigidity import pair_rigidity
from qsbearing.readings import Rating, dynamic_load_rating, static_load_rating
from tests.inference.data_sheets import Known, gmn, snfa

HEADING = (
    "| rows, read as | rows | refused | diameter in the list | set in the list | set first | sets listed, median |"
)


def over_iso(known: Known) -> tuple[float, float]:
    """C and C0 printed over those of the standards."""
    sets = BallSets(np.array([known.ball_count]), np.array([known.ball_diameter]))
    bearing = rated(qs.DataSheet(**known.sheet), sets, *ISO_GROOVES, ISO_STEEL)
    computed = dynamic_load_rating(bearing, Rating.ISO_281), static_load_rating(bearing)
    return known.sheet["dynamic_load_rating"] / computed[0][0], known.sheet["static_load_rating"] / computed[1][0]


def with_factors_of_the_others(series: list[Known]) -> list[Known]:
    """Each row with the median factors of the series' other rows."""
    ratios = np.array([over_iso(known) for known in series])
    medians = [np.median(np.delete(ratios, number, axis=0), axis=0) for number in range(len(series))]
    return [
        known._replace(sheet=known.sheet | dict(zip(FACTORS, map(float, each), strict=True)))
        for known, each in zip(series, medians, strict=True)
    ]


def inferred(known: Known) -> qs.InferredBearing | None:
    """None where it is refused."""
    try:
        return qs.infer_bearing(**known.sheet)
    except qs.SceneError:
        return None


def row(name: str, rows: Iterable[Known]) -> str:
    """A line of the table."""
    found = [(known, inferred(known)) for known in rows]
    lists = [(known, each) for known, each in found if each is not None]
    places = [known.place(each) for known, each in lists]
    counts = [
        len(found) - len(lists),
        sum(bool(known.has_diameter(each).any()) for known, each in lists),
        sum(place >= 0 for place in places),
        sum(place == 0 for place in places),
    ]
    shares = [f"{100.0 * count / len(found):.0f} %" for count in counts]
    median = f"{np.median([each.set_number[-1] + 1 for _, each in lists]):g}" if lists else "-"
    return f"| {' | '.join([name, str(len(found)), *shares, median])} |"


def table() -> list[str]:
    """Its lines."""
    rows = gmn_rows()
    light = [known for angle in (17.0, 25.0) for known in with_factors_of_the_others(_of_angle(gmn(rows, "KH"), angle))]
    others = [known for series in snfa().values() for known in with_factors_of_the_others(series)]
    return [
        HEADING,
        "|---|---|---|---|---|---|---|",
        row("GMN, series S; own grooves", gmn(rows, "S ", maker="GMN")),
        row("GMN, series S; ISO as printed", gmn(rows, "S ", rating_practice="iso")),
        row("GMN, series S; nothing stated", gmn(rows, "S ")),
        row("GMN, series KH of light balls; nothing stated", gmn(rows, "KH")),
        row("GMN, series KH of light balls; own grooves", gmn(rows, "KH", maker="GMN")),
        row("GMN, series KH of light balls; factors of the series", light),
        row("SNFA; nothing stated", [known for series in snfa().values() for known in series]),
        row("SNFA; factors of the series", others),
    ]


def _of_angle(rows: list[Known], angle: float) -> list[Known]:
    return [known for known in rows if np.isclose(known.sheet["free_contact_angle"], angle * qs.deg)]


def stiffness_shares() -> tuple[float, ...]:
    """Of GMN's series S: how often the true rigidity of a pair at light, medium and heavy preload is in the range."""
    inside = []
    rows: dict[str, Any] = {each["name"]: each for each in gmn_rows()}
    for known in gmn(gmn_rows(), "S ", maker="GMN"):
        printed = rows[known.name]
        groove = printed["inferred_f"] * known.ball_diameter
        lengths = known.ball_diameter, printed["dm_mm"] * qs.mm, groove, groove
        true = qs.BallBearing(known.ball_count, *lengths, known.sheet["free_contact_angle"])
        listed = qs.infer_bearing(**known.sheet)
        preloads = [printed[f"Fv{size}"] for size in "LMS"]
        ranges = [listed.range_of(pair_rigidity(listed.bearing, preload)) for preload in preloads]
        found = pair_rigidity(true, np.array(preloads))
        inside.append([each.least <= own <= each.most for each, own in zip(ranges, found, strict=True)])
    return tuple(np.mean(inside, axis=0))


if __name__ == "__main__":
    print("\n".join(table()))
    print("true rigidity within the range, light, medium, heavy preload:", stiffness_shares())
