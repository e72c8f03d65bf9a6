"""Whether the text beside an example mentions the remarks that the example prints."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager

from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.remark import Remark
from qsbearing.results import remarks

NO_EXAMPLE = {
    "code.md": "names a command to follow its steps through the folders",
    "releasing.md": "names commands that make numbers of the README again",
    "timing.md": "names commands to say how long they take",
}
"""Pages whose commands show no results. All others are read for it, the notebook cell by cell."""
WORDS = {
    "hypotheses_differ": r"hypothes[ie]s",
    "gyroscopic_slip": r"\bslips?\b|friction coefficient",
    "momentum_gap": r"follow the azimuth",
    "balls_press_cage": r"press the cage",
    "ring_expansion": r"expansion|expand|gr[eo]w",
    "ball_expansion": r"expansion of the balls|balls a temperature",
    "elastic_rings": r"rings?\b[^.]*(?:elastic|rigid|deflect)|(?:elastic|rigid|deflection of)[^.]*\brings?\b",
    "centrifugal_force": r"centrifugal|inertia",
    "gyroscopic_moment": r"gyroscopic|inertia",
    "hertz_angle": r"actual contact angle",
    "preload_lost": r"preload (?:is )?lost",
    "fit_lost": r"fit (?:is )?lost|lose their fit",
    "seat_parts": r"lifts? off",
    "friction_may_be_low": r"balls creep",
    "friction_given_exceeded": r"\bslips?\b|more friction",
    "pressure_viscosity_estimated": r"pressure-viscosity",
    "preload_reduced": r"preload[^.]*(?:reduced|falls?|less)|reduces? (?:the|its) preload",
    "preload_excessive": r"excessive",
}
"""What a text says that mentions a remark, by its code or by the effect that it is about; of any other its code in
words."""


def keys_of(remark: Remark) -> Collection[str]:
    """By which `WORDS` has it."""
    if remark.code == "effects_missing":
        return tuple(map(str, remark.values["effects"]))
    is_of_effect = remark.code in ("effect_data_missing", "effect_unknown_to_friction")
    return (str(remark.values["effect"]) if is_of_effect else remark.code,)


def unmentioned(text: str, printed: Collection[str]) -> set[str]:
    """Of the remarks that an example prints, those that no word of the text is about."""
    plain = re.sub(r"\s+", " ", re.sub(r"`[^`]*`|\]\([^)]*\)", "", text))  # keys and addresses are no words
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
