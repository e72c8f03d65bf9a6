"""Whether the text beside an example mentions the remarks that the example prints."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager

from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.remark import Remark
from qsbearing.results import remarks

CHECKED = ("ten_minutes.md", "cage_and_grease.md", "data_sheet.md", "design.md")
"""Pages of which every example must; the others are not read for it yet. The notebook is, cell by cell."""
WORDS = {
    "hypotheses_differ": r"hypothes[ie]s",
    "gyroscopic_slip": r"\bslips?\b|friction coefficient",
    "balls_press_cage": r"press the cage",
    "ring_expansion": r"expansion|expand|gr[eo]w",
    "elastic_rings": r"elastic|rigid|deflect",
    "centrifugal_force": r"centrifugal|inertia",
    "gyroscopic_moment": r"gyroscopic|inertia",
    "hertz_angle": r"actual contact angle",
    "preload_lost": r"preload (?:is )?lost",
    "fit_lost": r"fit (?:is )?lost",
    "preload_reduced": r"preload",
    "preload_excessive": r"preload",
}
"""What a text says that mentions a remark, by its code or by the effect that it is about; of any other its code in
words."""


def keys_of(remark: Remark) -> Collection[str]:
    """By which `WORDS` has it."""
    if remark.code == "effects_missing":
        return tuple(map(str, remark.values["effects"]))
    return (str(remark.values["effect"]) if remark.code == "effect_data_missing" else remark.code,)


def unmentioned(text: str, printed: Collection[str]) -> set[str]:
    """Of the remarks that an example prints, those that no word of the text is about."""
    plain = re.sub(r"\s+", " ", text)
    return {key for key in printed if not re.search(WORDS.get(key, key.replace("_", " ")), plain, re.IGNORECASE)}


@contextmanager
def printed() -> Iterator[set[str]]:
    """The remarks that are shown meanwhile, but for those that only add a word to numbers that hold."""
    found: set[str] = set()
    own = remarks.together

    def kept(said: list[Remark]) -> list[Remark]:
        shown = own(said)
        found.update(key for each in shown if each.kind.severity is not Severity.GOOD_TO_KNOW for key in keys_of(each))
        return shown

    remarks.together = kept  # type: ignore[assignment]
    try:
        yield found
    finally:
        remarks.together = own
