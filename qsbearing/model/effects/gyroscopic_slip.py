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

from qsbearing.model.effects.angle_difference import by_friction
from qsbearing.model.effects.entry import Assumed, Entry, largest, part_of_effect
from qsbearing.model.effects.operating_point import OperatingPoint

TYPICAL = (0.1, 0.03)
"""What lubricated steel contacts offer, from the most to the least: where no coefficient is given, both are tried."""


def _needed(point: OperatingPoint) -> NDArray:
    """The friction that each ball that counts needs (*cases, ball); none where friction moves the balls, which slip as
    far as they must."""
    if point.scene.raceway_control == "friction":
        return np.zeros_like(point.load)
    of_sides = [side.required_friction for side in (point.solution.inner, point.solution.outer)]
    needed = [np.nan_to_num(each) for each in of_sides if each is not None]
    return np.where(point.is_heavy, np.max(needed, axis=0), 0.0) if needed else np.zeros_like(point.load)


def _excess(point: OperatingPoint) -> NDArray:
    """What that is over mu, the least of the typical ones where none is given."""
    given = [getattr(one, "friction_coefficient", None) for one in point.full_scene.ball_effects]
    bound = next((np.asarray(one, float)[..., None] for one in given if one is not None), np.asarray(min(TYPICAL)))
    return np.maximum(_needed(point) - bound, 0.0)


def _usual(of: Any, points: list[OperatingPoint]) -> list[Assumed]:
    """Those coefficients; no contact slips under one that needs less."""
    assumed: list[Assumed] = []
    if of.raceway_control == "friction":
        return assumed
    for bound in TYPICAL:
        slipping = part_of_effect(*_FIELD, None, bound).finer(of)
        if slipping is not of:
            slips = any(np.any(_needed(point) > bound) for point in points)
            assumed.append(Assumed(f"µ = {bound:g}", f"a coefficient of {bound:g}", slipping if slips else of))
    return assumed


_FIELD = "ball_effects", "friction_coefficient"

ENTRY = Entry(
    "gyroscopic_slip",
    "the slip of contacts that cannot carry the gyroscopic moment",
    part_of_effect(*_FIELD, None),
    indicator=largest(_excess),
    errors=by_friction(_excess),
    needs="friction_coefficient, together with the gyroscopic moment",
    applies=lambda of: of.raceway_control != "friction",
    assume=_usual,
    tells_without=True,
    saves_time=False,
)
