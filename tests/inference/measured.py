"""How often the list of a data sheet holds the printed ball set, and its range the printed rigidity: the table of the
guide's page, on rows that chose the rules and on rows that judge them.

python -m tests.inference.measured prints it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

import qsbearing as qs
from fem_check.book.published import gmn_rows
from qsbearing.inference.ball_sets import BallSets
from qsbearing.inference.data_sheet import RigidityKind
from qsbearing.inference.practice import FACTORS
from qsbearing.inference.ratings_fit import ISO_GROOVES, ISO_STEEL, rated
from qsbearing.inference.rigidity import pair_rigidity
from qsbearing.readings import Rating, dynamic_load_rating, static_load_rating
from tests.inference.data_sheets import Known, gmn, snfa, snfa_rigidities

HEADING = "| rows, read as | rows | refused | wrong list | wrong list of one set | set first | sets listed, median |"
RIGIDITY_HEADING = (
    "| rows | printed rigidities | in the range, Z known | range, median | in the range | range, median |"
)
Printed = Callable[[Known], Iterable[tuple[float, float, float]]]
"""Preload [N], rigidity [N/m] and half of its last digit, of a row."""


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


def inferred(known: Known, **more: Any) -> qs.InferredBearing | None:
    """None where it is refused."""
    try:
        return qs.infer_bearing(**known.sheet, **more)
    except qs.SceneError:
        return None


class Shares:
    """What becomes of rows."""

    def __init__(self, rows: Iterable[Known]) -> None:
        found = [(known, inferred(known)) for known in rows]
        lists = [(known.place(each), int(each.set_number[-1]) + 1) for known, each in found if each is not None]
        self.rows = len(found)
        self.refused = len(found) - len(lists)
        self.wrong = sum(place < 0 for place, _ in lists)
        self.wrong_of_one = sum(place < 0 and sets == 1 for place, sets in lists)
        self.first = sum(place == 0 for place, _ in lists)
        self.median = float(np.median([sets for _, sets in lists])) if lists else None


def row(name: str, rows: Iterable[Known]) -> str:
    """A line of the table."""
    of = Shares(rows)
    shares = [f"{100.0 * each / of.rows:.0f} %" for each in (of.refused, of.wrong, of.wrong_of_one, of.first)]
    median = "-" if of.median is None else f"{of.median:g}"
    return f"| {' | '.join([name, str(of.rows), *shares, median])} |"


def own_grooves(begin: str) -> list[Known]:
    """GMN's series S 619, or its others, S 62 and the small sizes."""
    return [
        known for known in gmn(gmn_rows(), "S ", maker="GMN") if known.name.startswith("S 619") == (begin == "S 619")
    ]


def light() -> list[Known]:
    """GMN's KH with the factors of its other rows."""
    return [
        known for angle in (17.0, 25.0) for known in with_factors_of_the_others(_of_angle(gmn(gmn_rows(), "KH"), angle))
    ]


def by_factors(*series: str) -> list[Known]:
    """SNFA's with the factors of their other rows."""
    return [each for (name, _), known in snfa().items() if name in series for each in with_factors_of_the_others(known)]


def _of_angle(rows: list[Known], angle: float) -> list[Known]:
    return [known for known in rows if np.isclose(known.sheet["free_contact_angle"], angle * qs.deg)]


def _unstated(rows: Iterable[Known]) -> list[Known]:
    return [known._replace(sheet={key: each for key, each in known.sheet.items() if key != "maker"}) for known in rows]


def table() -> list[str]:
    """Its lines; those below "judge" set no number of the rules, but were seen while they were made."""
    others = [known for rows in snfa().values() for known in rows]
    return [
        HEADING,
        "|---|---|---|---|---|---|---|",
        row("*chose:* GMN S 619; own grooves", own_grooves("S 619")),
        row("GMN S 619; nothing stated", _unstated(own_grooves("S 619"))),
        row("GMN KH, light balls; factors of the series", light()),
        row("GMN KH, light balls; own grooves", gmn(gmn_rows(), "KH", maker="GMN")),
        row("*judge:* GMN S 62; own grooves", own_grooves("S 62")),
        row("GMN S 62; nothing stated", _unstated(own_grooves("S 62"))),
        row("SNFA SEA; factors of the series", by_factors("SEA")),
        row("SNFA SEB; likewise", by_factors("SEB")),
        row("SNFA EX; likewise", by_factors("EX")),
        row("SNFA VEB, light balls; likewise", by_factors("VEB")),
        row("**all that judge, read as stated**", judges()),
        row("SNFA, all; nothing stated", others),
        row("SNFA VEX, two series of one name; factors", by_factors("VEX")),
    ]


def judges() -> list[Known]:
    """The rows by which the rules are judged."""
    return own_grooves("S 62") + by_factors("SEA", "SEB", "EX", "VEB")


def gmn_rigidities(known: Known) -> list[tuple[float, float, float]]:
    """At light, medium and heavy preload."""
    rows: dict[str, Any] = {each["name"]: each for each in gmn_rows()}
    printed = rows[known.name]
    return [(printed[f"Fv{size}"], printed[f"Cax{size}"] * qs.N / qs.um, 0.5 * qs.N / qs.um) for size in "LMS"]


def coverage(rows: Iterable[Known], printed: Printed, kind: RigidityKind, counted: bool) -> tuple[int, float, float]:
    """Of how many printed rigidities; the share within the range; the range over the printed one, median."""
    inside, widths = [], []
    for known in rows:
        listed = inferred(known, **({"ball_count": known.ball_count} if counted else {}))
        for preload, rigidity, last_digit in printed(known) if listed is not None else ():
            assert listed is not None
            between = listed.range_of(pair_rigidity(listed.bearing, preload, kind))
            inside.append(between.least - last_digit <= rigidity <= between.most + last_digit)
            widths.append(between.width / rigidity)
    return len(inside), float(np.mean(inside)), float(np.median(widths))


RIGIDITIES: dict[str, tuple[Callable[[], list[Known]], Printed, RigidityKind]] = {
    "*chose:* GMN S 619": (lambda: own_grooves("S 619"), gmn_rigidities, RigidityKind.TANGENT),
    "GMN KH": (light, gmn_rigidities, RigidityKind.TANGENT),
    "*judge:* GMN S 62": (lambda: own_grooves("S 62"), gmn_rigidities, RigidityKind.TANGENT),
    "SNFA VEB": (lambda: by_factors("VEB"), snfa_rigidities, RigidityKind.UNLOADING),
}


def rigidity_table() -> list[str]:
    """Printed rigidities and the range of the list."""
    lines = [RIGIDITY_HEADING, "|---|---|---|---|---|---|"]
    for name, (rows, printed, kind) in RIGIDITIES.items():
        (count, *known), (_, *unknown) = (coverage(rows(), printed, kind, counted) for counted in (True, False))
        shares = " | ".join(f"{100.0 * each:.0f} %" for each in (*known, *unknown))
        lines.append(f"| {name} | {count} | {shares} |")
    return lines


if __name__ == "__main__":
    print("\n".join([*table(), "", *rigidity_table()]))
