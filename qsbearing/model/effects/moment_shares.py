"""Moment shares: how the raceways share the gyroscopic moment. A hypothesis.

Source        Harris & Kotzalas; the formula stands with the moment itself (`gyroscopic_moment.moment_shares`)
Equation      (lambda_i, lambda_o) = (0, 2) under outer control; under inner control (2, 0), or (1, 1) after Harris
Assumes       what raceway control assumes
When not      outer control: both are the same there
Parameters    none
Indicator     y = 2 |Mg|/(D Q) of inner-controlled balls: the friction that moves to the other raceway is half of it
Example       GyroscopicMoment(MomentShares.HARRIS)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import Entry, largest, part_of_effect
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.parting import by_friction


def _moving_friction(point: OperatingPoint) -> NDArray:
    """Of each ball (*cases, ball)."""
    inner, control = point.solution.inner.required_friction, point.solution.raceway_control
    if inner is None or control is None:
        return np.zeros_like(point.load)
    return np.where(point.is_heavy & (control == "inner"), 0.5 * np.nan_to_num(inner), 0.0)


ENTRY = Entry(
    "moment_shares",
    "the gyroscopic moment shared as Harris has it (all on the controlling raceway instead)",
    part_of_effect("ball_effects", "moment_shares", "controlling", "harris"),
    indicator=largest(_moving_friction, 2.0),
    errors=by_friction(_moving_friction),
    hypothesis="how the raceways share the moment is a hypothesis, which the model cannot test",
    saves_time=False,
)
