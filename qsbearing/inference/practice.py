"""What C and C0 mean at a maker: the standards as printed, the own grooves, or the standards times factors of a series.

Measured on the data sheets of five makers (guide page data_sheet); a ball set found by the wrong practice is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from qsbearing.model.validation import ErrorDetail, choose, printable
from qsbearing.remarks.wording import listed


class RatingPractice(StrEnum):
    """What the printed ratings follow from."""

    ISO = "iso"
    """C by ISO 281's table, C0 by ISO 76's, which know no groove radii."""
    OWN_GROOVE = "own_groove"
    """C by Lundberg and Palmgren, C0 by Hertz, both with the bearing's own groove radii, equal in both rings."""
    SERIES_FACTORS = "series_factors"
    """Those of ISO times two factors, constant within a series."""


@dataclass(frozen=True)
class Practice:
    """How printed ratings are read."""

    kind: RatingPractice
    within: float
    """How far a printed rating may be from a computed one, beside its rounding [-]."""
    dynamic_factor: tuple[float, float] = (1.0, 1.0)
    """Least and largest C printed over that of ISO 281."""
    static_factor: float = 1.0


ISO = Practice(RatingPractice.ISO, 0.012)
"""Wider than how makers round and interpolate, 0.8 %: 7210 BEP, whose set is not known, is 1.1 % off with 14 balls."""
ACCEPTED = 0.008
"""Within which ISO's practice is believed that nobody stated."""
OWN_GROOVE = Practice(RatingPractice.OWN_GROOVE, 0.016)
"""Twice 0.8 % of C, by which C and C0 of 85 rows disagree: 0.0004 in f."""
SERIES_SPREAD = 0.03
"""What factors leave: 82 % of 60 rows and 76 % of 160 have their set in the list; within 2 % 68 % and 69 %."""
MAKERS = {
    "gmn": OWN_GROOVE,
    "nsk": ISO,
    "ntn": ISO,
    "skf": Practice(RatingPractice.ISO, ISO.within, (1.0, 1.06)),  # "Explorer" lines have C raised, C0 not
    "snfa": Practice(RatingPractice.SERIES_FACTORS, SERIES_SPREAD),
}
"""Whose practice was measured."""
FACTORS = ("dynamic_rating_factor", "static_rating_factor")


def how_to_state(maker: str) -> str:
    """What to add to a data sheet whose practice nothing tells, a sentence without its end.

    Args:
        maker: as given, of whom no practice is known; empty: none is given.
    """
    first, *others = (each.upper() for each in sorted(MAKERS, key=lambda each: each != "skf"))
    known = f"No practice of {printable(maker)} is known; known are {listed([first, *others])}. Add"
    begun = known if maker else f'Whose ratings are these? Add maker = "{first}" (or {", ".join(others)}), or'
    return (
        f'{begun} rating_practice = "iso" (C of ISO 281, C0 of ISO 76), "own_groove" (both with the bearing\'s '
        f'own groove radii) or "series_factors" (with {" and ".join(FACTORS)})'
    )


def practice_of(maker: str, stated: RatingPractice | None, factors: tuple[float | None, ...]) -> Practice | None:
    """The practice by which ratings are read; None where nobody knows it."""
    if None not in factors:
        dynamic, static = factors
        return Practice(RatingPractice.SERIES_FACTORS, SERIES_SPREAD, (dynamic, dynamic), static)  # type: ignore[arg-type]
    known = MAKERS.get(maker.strip().lower())
    if stated is None or (known is not None and known.kind == stated):
        return known
    return ISO if stated == RatingPractice.ISO else OWN_GROOVE


def practice_errors(maker: str, stated: Any, given: Mapping[str, Any]) -> list[ErrorDetail]:
    """What a maker or a practice lacks, or has too much."""
    if stated is not None and (wrong := choose("bearing.rating_practice", stated, RatingPractice)[1]):
        return wrong
    known = MAKERS.get(maker.strip().lower())
    kind = stated or (known.kind if known else None)
    lacking = [name for name in FACTORS if given[name] is None]
    if kind == RatingPractice.SERIES_FACTORS or len(lacking) == 1:
        cause = "Printed over computed, of a row of the series whose balls are known; the guide lists measured ones"
        return [ErrorDetail(f"bearing.{name}", "missing", cause=cause) for name in lacking]
    if stated is not None and not lacking:
        cause = 'Write rating_practice = "series_factors", or leave the factors out'
        return [ErrorDetail("bearing.rating_practice", "has no factors", str(stated), cause=cause)]
    return []
