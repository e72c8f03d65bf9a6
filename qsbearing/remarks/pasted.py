"""The line that each remark ends with, to be pasted: an option behind the command that was given, which does what the
remark asks for, or else the command that shows the page of the guide."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from typing import Any

from qsbearing.model.effects import EFFECTS
from qsbearing.model.validation import Field, Sentence, Setting
from qsbearing.remarks.wording import Audience, Words

BY_FRICTION = "effects.raceway_control=friction"
SETTINGS = {
    "hypotheses_differ": "effects.raceway_control={alternative}",
    "control_inconsistent": BY_FRICTION,
    "friction_doubtful": BY_FRICTION,
    "friction_beyond": BY_FRICTION,
    "friction_above_load": BY_FRICTION,
    "momentum_gap": BY_FRICTION,
    "friction_assumed": "effects.traction.friction_coefficient={assumed:g}",
    "rows_press": "floating=[{{rows = [{slides:.0f}]}}]",
    "life_grooves_uncovered": "readings.life.rating=lundberg_palmgren",
    "sheet_sets_left_out": "bearing.ball_set=1",
    "sheet_ratings_unstated": "bearing.maker=SKF",
}
"""Of a code: a key and its value, over the values of the remark. Codes without one point to the guide."""
OF_EFFECTS = {"gyroscopic_slip": "effects.friction_coefficient=0.06"}
"""Of an effect that lacks its numbers, where no example stands beside what it needs: the least of lubricated steel."""
NEEDED = {entry.name: entry.needs_beside_size for entry in EFFECTS}


def pasted(code: str, values: Mapping[str, Any], see: str, is_of_whole: bool, words: Words) -> str:
    """The line.

    Args:
        values: of the remark.
        see: page of the guide, and its section behind a #.
        is_of_whole: whether the remark is about all of one bearing or set, whose keys an option names.
    """
    settings = _settings(code, values, words) if is_of_whole and words.reader is Audience.FILE else []
    options = [word for each in settings for word in ("--set", each)]
    return shlex.join(options) if options else f"qsbearing guide {see}"


def _settings(code: str, values: Mapping[str, Any], words: Words) -> list[str]:
    if code in SETTINGS:
        return [SETTINGS[code].format_map(values)]
    if code == "effects_missing":
        return _under("effects", values["add"], words)
    if code == "effect_data_missing":
        return _of_effect(values["effect"], bool(values["has_size"]), words)
    return []


def _of_effect(name: str, has_size: bool, words: Words) -> list[str]:
    """What makes an effect act that needs numbers of the scene: the example beside what it needs."""
    needed = NEEDED[name]
    if not has_size or not isinstance(needed, Sentence):
        return [OF_EFFECTS[name]] if name in OF_EFFECTS else []
    return _under(f"effects.{name}", needed.values["example"], words)


def _under(table: str, settings: Sequence[Field], words: Words) -> list[str]:
    """Keys of a table with their values; none where one takes a table of its own."""
    pairs = [words.spell(each, "").partition(" = ") for each in settings if isinstance(each, Setting)]
    return [f"{table}.{key}={_bare(value)}" for key, _, value in pairs] if all(value for *_, value in pairs) else []


def _bare(value: str) -> str:
    """A word without its quotation marks."""
    word = value.strip('"')
    return word if word.isidentifier() else value
