"""Moment shares: how the raceways share the gyroscopic moment. A hypothesis.

Source        Harris & Kotzalas; the formula stands with the moment itself (`gyroscopic_moment.moment_shares`)
Equation      (lambda_i, lambda_o) = (0, 2) under outer control; under inner control (2, 0), or (1, 1) after Harris
Assumes       what raceway control assumes
When not      outer control: both are the same there
Parameters    none
Indicator     y = 2 |Mg|/(D Q) of balls that the outer raceway does not control: half of this friction moves to the
              other raceway
Example       GyroscopicMoment(MomentShares.HARRIS)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.angle_difference import by_friction
from qsbearing.model.effects.entry import Entry, Members, largest, part_of_effect
from qsbearing.model.effects.hypotheses import other_shares
from qsbearing.model.effects.operating_point import OperatingPoint


def _moving_friction(point: OperatingPoint) -> NDArray:
    """Of each ball (*cases, ball)."""
    inner, control = point.solution.inner.required_friction, point.solution.raceway_control
    if inner is None or control is None:
        return np.zeros_like(point.load)
    return np.where(point.is_heavy & (control != "outer"), 0.5 * np.nan_to_num(inner), 0.0)


_SWITCH = part_of_effect("ball_effects", "moment_shares", "controlling", "harris")

ENTRY = Entry(
    "moment_shares",
    "the gyroscopic moment shared as Harris has it (all on the controlling raceway instead)",
    _SWITCH._replace(members=Members(other_shares)),
    indicator=largest(_moving_friction, 2.0),
    errors=by_friction(_moving_friction),
    hypothesis="how the raceways share the moment is a hypothesis, which the model cannot test",
    saves_time=False,
)
