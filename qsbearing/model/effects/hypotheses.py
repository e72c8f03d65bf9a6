"""The hypotheses of a ball's motion as they go together: every raceway control, with the gyroscopic moment shared in
every way that differs under it. Friction is none of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from qsbearing.model.effects.entry import Assumed, as_setting, other_than, part_of_effect
from qsbearing.model.validation import SceneError

SHARES = "moment_shares"
FRICTION = "friction"


def under_control(of: Any, control: Any) -> Any:
    """A scene or set under another raceway control; a law of friction goes with friction."""
    changes = {} if control == FRICTION or getattr(of, "traction", None) is None else {"traction": None}
    return replace(of, raceway_control=control, **changes)


def _ways_of_sharing(of: Any) -> list[tuple[str, Any]]:
    """A scene or set with each way, and its setting; as it stands, without a setting, where none differs."""
    members = [type(getattr(each, SHARES)) for each in of.ball_effects if hasattr(each, SHARES)]
    if of.raceway_control in ("outer", FRICTION) or not members:
        return [("", of)]
    return [
        (as_setting(SHARES, each), part_of_effect("ball_effects", SHARES, None, each).finer(of)) for each in members[0]
    ]


def other_shares(of: Any) -> list[Assumed]:
    """A scene or set with the moment shared in every other way that differs under its raceway control."""
    return other_than(of, _ways_of_sharing(of))


def other_controls(of: Any) -> list[Assumed]:
    """Under every other control, with the moment shared in every way that differs under it."""
    if of.raceway_control is None:
        return []
    every = []
    for control in type(of.raceway_control):
        if control == FRICTION:
            continue
        named = as_setting("raceway_control", control)
        try:
            under = of if control == of.raceway_control else under_control(of, control)
        except SceneError:  # which the scene's other choices leave out
            continue
        every += [(", ".join(filter(None, (named, how))), each) for how, each in _ways_of_sharing(under)]
    return other_than(of, every)
