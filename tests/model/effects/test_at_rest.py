"""What of the ring effects a bearing has at rest and cold, where its preload is given: each says it itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import qsbearing as qs
from qsbearing.model.effects import as_fitted, as_made

EXPANSION = qs.RingExpansion(
    bore_diameter=90 * qs.mm, outside_diameter=160 * qs.mm, shaft_interference=5 * qs.um,
    shaft_temperature=qs.zero_celsius + 60.0,
)  # fmt: skip
DEVIATIONS = qs.BallDiameterDeviations([0.0] * 16)


@dataclass(frozen=True)
class Worn:
    """Not of the list."""

    name = "worn"

    def at_rest(self, fitted: bool) -> Any:
        return self


def test_each_effect_says_what_of_it_acts_at_rest() -> None:
    hot = qs.BallExpansion(ball_temperature=qs.zero_celsius + 60.0)
    effects: Any = (EXPANSION, hot, DEVIATIONS, Worn())
    assert as_made(effects) == (DEVIATIONS, Worn())
    assert as_fitted(effects) == (EXPANSION.without_heat, DEVIATIONS, Worn())
    assert EXPANSION.without_heat.shaft_temperature is None
