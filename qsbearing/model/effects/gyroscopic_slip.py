"""Gyroscopic slip: contacts carry at most mu Q of the friction that the gyroscopic moment asks for.

Source        Harris & Kotzalas; the formula stands with the moment itself (`gyroscopic_moment.carried_friction`)
Equation      |T| <= mu Q
Assumes       one coefficient for all contacts, whatever else they do
When not      the friction that the moment asks for stays below what the contacts offer: then it changes nothing
Parameters    friction_coefficient of the gyroscopic moment
Indicator     how much more friction than mu some contact would need, of those that count, over its load
Example       GyroscopicMoment(friction_coefficient=0.07)
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import Assumed, Entry, largest, part_of_effect
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.parting import by_friction

TYPICAL = 0.1
"""Most of what lubricated steel contacts offer: where no coefficient is given, it stands for it."""


def _excess(point: OperatingPoint) -> NDArray:
    """Of the friction that each ball needs over mu (*cases, ball)."""
    given = [getattr(one, "friction_coefficient", None) for one in point.full_scene.ball_effects]
    bound = next((np.asarray(one, float)[..., None] for one in given if one is not None), np.asarray(TYPICAL))
    found = [side.required_friction for side in (point.solution.inner, point.solution.outer)]
    needed = [np.nan_to_num(each) for each in found if each is not None]
    if not needed:
        return np.zeros_like(point.load)
    return np.where(point.is_heavy, np.maximum(np.max(needed, axis=0) - bound, 0.0), 0.0)


def _usual(of: Any, points: list[OperatingPoint]) -> list[Assumed]:
    """That coefficient; no contact slips under it that needs less."""
    found = part_of_effect("ball_effects", "friction_coefficient", None, TYPICAL).finer(of)
    if found is of:
        return []
    slips = any(np.any(_excess(point) > 0.0) for point in points)
    return [Assumed("", f"a coefficient of {TYPICAL:g}", found if slips else of)]


ENTRY = Entry(
    "gyroscopic_slip",
    "the slip of contacts that cannot carry the gyroscopic moment",
    part_of_effect("ball_effects", "friction_coefficient", None),
    indicator=largest(_excess),
    errors=by_friction(_excess),
    needs="friction_coefficient, together with the gyroscopic moment",
    assume=_usual,
    tells_without=True,
    saves_time=False,
)
