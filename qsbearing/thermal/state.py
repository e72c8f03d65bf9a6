"""What was found of the heat of a bearing or a set: temperatures, heats, and whether they are steady."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import NamedTuple

from numpy.typing import NDArray

from qsbearing.solution.case_index import Index, place_of
from qsbearing.thermal.network import Thermal
from qsbearing.units import rpm, zero_celsius


class State(NamedTuple):
    """A point of the curve."""

    factor: float
    """On the speeds."""
    powers: NDArray
    """Of the sources [W]."""
    temperatures: NDArray
    """Of the free nodes [K]."""
    preloads: NDArray
    """The axial load of each row [N]."""


@dataclass(frozen=True)
class SpeedCurve:
    """The curve, and where it turns back or ends."""

    states: tuple[State, ...]
    fold: State | None
    """Where the speed is largest, if the curve turns back."""
    at_limit: State | None
    """Where a node reaches the limit; None: the curve was not followed so far."""
    crossing: State | None
    """The first state at or above the scene's own speed, if the curve gets there."""


class Verdict(StrEnum):
    """Whether there is a steady state below the limit of temperature."""

    STABLE = "stable"
    RUNAWAY = "runaway"
    """Steady states, followed from standstill, turn back below this speed and reach the limit without coming to it."""
    TOO_HOT = "too_hot"
    """Followed likewise, they reach the limit below this speed."""
    UNDECIDED = "undecided"
    """None was found; that is no proof that there is none."""


@dataclass(frozen=True)
class ThermalState:
    """Temperatures and heats of a solution; arrays of shape (*cases), NaN where there is no steady state."""

    temperatures: dict[str, NDArray]
    """Of every node [K]; of a set of several rows, `inner_ring 1` is that of the first."""
    powers: dict[str, NDArray]
    """Heat that friction makes, by source [W]."""
    flows: dict[tuple[str, str], NDArray]
    """Heat on each path, from its first node to its second [W]."""
    imbalance: NDArray
    """The largest heat that any free node takes in and does not give off, of what the solution's friction makes [W]."""
    feedback: NDArray
    """By how much a further watt of heat makes friction grow [-]: at 1 the preload runs away."""
    verdict: NDArray
    """`Verdict` of each case, as its word."""
    solves: int
    """States of the bearing or set that were solved for it, of each case."""
    thermal: Thermal
    speed: NDArray
    """The larger one of both rings [rad/s]."""
    follow: Callable[[], SpeedCurve]

    @cached_property
    def speeds(self) -> SpeedCurve:
        """Steady states followed from standstill in speed; of a single case.

        Raises:
            ValueError: there are several cases.
        """
        if self.verdict.shape:
            raise ValueError("steady states are followed in speed for one case; this solution has several")
        return self.follow()

    def message(self, index: Index = None) -> str:
        """A sentence or two on whether a case is steady.

        Raises:
            ValueError: the index does not name one case.
        """
        place = place_of(index, self.verdict.shape)
        verdict = Verdict(str(self.verdict[place]))
        if verdict is Verdict.STABLE:
            name, hottest = max(self.temperatures.items(), key=lambda each: float(each[1][place]))
            return (
                f"Stable at {hottest[place] - zero_celsius:.1f} C ({name.replace('_', ' ')}): a further watt of heat "
                f"makes friction grow by {self.feedback[place]:.2g} W; at 1 W the preload would run away."
            )
        limit = f"{self.thermal.limit_temperature - zero_celsius:.4g} C"
        if verdict is Verdict.UNDECIDED:
            return f"No steady state below {limit} was found; that does not prove that there is none."
        curve = self.speeds
        own = f"{float(self.speed) / rpm:.5g} rpm"
        head = f"No steady state below {limit} at {own}: followed from standstill, steady states"
        if verdict is Verdict.RUNAWAY and curve.fold is not None:
            fold = self.described(curve.fold)
            return f"Thermal runaway of the preload. {head} go up to {fold} and turn back there."
        assert curve.at_limit is not None
        return f"Too hot. {head} reach it at {self.described(curve.at_limit)}."

    def described(self, state: State) -> str:
        """A state of the curve in words."""
        loads = " and ".join(f"{load:.4g}" for load in state.preloads)
        hottest = state.temperatures.max() - zero_celsius
        return f"{state.factor * float(self.speed) / rpm:.5g} rpm ({hottest:.1f} C, axial load {loads} N)"
