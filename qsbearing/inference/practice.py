"""What C and C0 mean at a maker: the standards as printed, the own grooves, or the standards times factors of a series.

Measured on the data sheets of five makers (guide page data_sheet); a ball set found by the wrong practice is wrong.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from math import radians
from typing import Any

from qsbearing.model.bearing import BearingKind
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
    PROPORTIONS = "proportions"
    """No ratings are known: balls by the proportions of the dimension series, for stiffness and pressure alone."""


@dataclass(frozen=True)
class Practice:
    """How printed ratings are read."""

    kind: RatingPractice
    within: float
    """How far a printed rating may be from a computed one, beside its rounding [-]."""
    spread: float
    """How far it usually is [-], by which sets are ordered."""
    dynamic_factor: tuple[float, float] = (1.0, 1.0)
    """Least and largest C printed over that of ISO 281."""
    static_factor: float = 1.0
    static_share: float = 1.0
    """`within` and `spread` of C0 over those of C."""


ISO = Practice(RatingPractice.ISO, 0.012, 0.004)
"""Wider than how makers round and interpolate, 0.8 %: 7210 BEP, whose set is not known, is 1.1 % off with 14 balls."""
ACCEPTED = 0.008
"""Within which ISO's practice is believed that nobody stated."""
OWN_GROOVE = Practice(RatingPractice.OWN_GROOVE, 0.016, 0.008)
"""C of GMN's S 619 is off by 1.5 % at most, 0.7 % in the standard deviation, where C0 tells f."""
BY_FACTORS = Practice(RatingPractice.SERIES_FACTORS, 0.03, 0.015, static_share=2.0)
"""What factors leave of GMN's series KH, whose C are off by up to 3 % and C0 by up to 6 %."""
MAKERS = {"gmn": OWN_GROOVE, "nsk": ISO, "ntn": ISO, "skf": ISO, "snfa": BY_FACTORS}
"""Whose practice was measured."""
_STEEP_ANGLE = radians(35.0)
_RAISED = {("skf", False): 1.06, ("skf", True): 1.12}
"""The largest C over that of ISO 281 of angular-contact bearings, by maker and whether they are of 40 degrees: SKF's
73 BE, marked "Explorer"."""
_RAISED_DEEP_GROOVE = {"skf": 1.08, "ntn": 1.12}
"""Likewise of deep groove bearings; C0 is not raised. NTN's 6208 of 32.5 and 17.8 kN: 1.09. Each step more costs lists
of one set: of 196 rows of SKF's 39 to 30 with 1.12."""
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


def practice_of(
    maker: str, stated: RatingPractice | None, factors: tuple[float | None, ...], kind: BearingKind, angle: float | None
) -> Practice | None:
    """The practice by which ratings are read; None where nobody knows it.

    Args:
        angle: free contact angle [rad]; None: not given.
    """
    if None not in factors:
        dynamic, static = factors
        return replace(BY_FACTORS, dynamic_factor=(dynamic, dynamic), static_factor=static)  # type: ignore[arg-type]
    maker = maker.strip().lower()
    known = MAKERS.get(maker)
    if stated is None or (known is not None and known.kind == stated):
        return known and replace(known, dynamic_factor=(1.0, _most_raised(maker, kind, angle or 0.0)))
    return {RatingPractice.ISO: ISO, RatingPractice.OWN_GROOVE: OWN_GROOVE}.get(stated)


def _most_raised(maker: str, kind: BearingKind, angle: float) -> float:
    if kind == BearingKind.DEEP_GROOVE:
        return _RAISED_DEEP_GROOVE.get(maker, 1.0)
    return _RAISED.get((maker, angle > _STEEP_ANGLE), 1.0)


def practice_errors(maker: str, stated: Any, given: Mapping[str, Any]) -> list[ErrorDetail]:
    """What a maker or a practice lacks, or has too much."""
    if stated is not None and (wrong := choose("bearing.rating_practice", stated, RatingPractice)[1]):
        return wrong
    if stated == RatingPractice.PROPORTIONS:
        unread = ("dynamic_load_rating", "static_load_rating", *FACTORS, "f0")
        cause = 'Leave it out, or rating_practice = "proportions", which is for bearings whose ratings nobody knows'
        return [
            ErrorDetail(f"bearing.{name}", "is not read by proportions", given[name], cause=cause)
            for name in unread
            if given[name] is not None
        ]
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
