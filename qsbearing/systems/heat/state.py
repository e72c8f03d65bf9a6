"""What was found of the heat of a bearing or a set: temperatures, heats, and whether they are steady."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Any, NamedTuple

from numpy.typing import NDArray

from qsbearing.documents.numbers import plain
from qsbearing.model.solution.case_index import Index, case_place
from qsbearing.model.units import rpm, zero_celsius
from qsbearing.model.validation import ErrorDetail
from qsbearing.remarks.of_solution import no_steady_state
from qsbearing.systems.heat.network import Thermal


class NetworkPart(str):
    """A node or a source of a network by its name in files, which also says of which row it is."""

    kind: str
    """The name alone."""
    row: int | None
    """From 0; None where there is one row, or rows share it."""

    def __new__(cls, kind: str, row: int | None = None) -> NetworkPart:
        part = super().__new__(cls, kind if row is None else f"{kind} {row + 1}")
        part.kind, part.row = kind, row
        return part

    def __reduce__(self) -> tuple[Any, ...]:
        return NetworkPart, (self.kind, self.row)

    @property
    def in_words(self) -> str:
        """As people read it: that of a row with its number."""
        kind = self.kind.replace("_", " ")
        return kind if self.row is None else f"{kind} of row {self.row + 1}"


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

    @property
    def end(self) -> State | None:
        """Beyond whose speed there is no steady state: the fold, else where the limit of temperature is reached."""
        return self.at_limit if self.fold is None else self.fold


class ThermalVerdict(StrEnum):
    """Whether there is a steady state below the limit of temperature."""

    STABLE = "stable"
    RUNAWAY = "runaway"
    """Steady states, followed from standstill, turn back below this speed and reach the limit without coming to it."""
    TOO_HOT = "too_hot"
    """Followed from standstill, steady states reach the limit below this speed."""
    UNDECIDED = "undecided"
    """None was found; that is no proof that there is none."""


OVERSHOOT = 0.01
"""Of a preload above where it ends, over where it ends: less is not worth a word."""


@dataclass(frozen=True)
class Course:
    """Temperatures and preload over time; arrays lead with the instants."""

    time: NDArray
    """[s], growing, closer where more happens."""
    temperatures: dict[NetworkPart, NDArray]
    """Of every node [K]."""
    powers: NDArray
    """Of the sources [W]; shape (instant, source)."""
    preloads: NDArray
    """The axial load of each row [N]; shape (instant, row)."""
    end: str
    """What ended it: time, limit (of temperature), or no_equilibrium (of the bearing)."""
    bound: str
    """`Thermal.bound`."""

    def message(self) -> str:
        """What becomes of the preload, in a sentence or two."""
        loads = self.preloads.max(axis=1)
        peak, last = int(loads.argmax()), float(loads[-1])
        ends = {name: value[-1] for name, value in self.temperatures.items()}
        hottest = max(ends, key=lambda name: float(ends[name]))
        state = f"{hottest.replace('_', ' ')} at {ends[hottest] - zero_celsius:.1f} °C"
        if self.end != "time":
            what = "The temperature limit is reached" if self.end == "limit" else "The bearing loses its equilibrium"
            return f"{what} after {_digits(self.time[-1])} s{self.bound}: {state}, axial load {_digits(last)} N."
        text = f"After {_digits(self.time[-1])} s{self.bound}: {state}, axial load {_digits(last)} N"
        if loads[peak] <= (1.0 + OVERSHOOT) * last:
            return f"{text}. The axial load never exceeds this value by more than {100 * OVERSHOOT:.0f} %."
        over = 100.0 * (loads[peak] / last - 1.0)
        highest = f"{_digits(float(loads[peak]))} N ({over:+.0f} %) at {_digits(self.time[peak])} s"
        return f"{text}. Before that, the axial load overshoots to {highest}."


def _digits(load: float) -> str:
    """Four digits, without a power of ten."""
    return plain(load, ".4g")


class WholeBearing(NamedTuple):
    """The same with the friction of the whole bearing, where the friction model leaves heat out."""

    state: ThermalState | None
    """None where it cannot be computed."""
    assumed: list[str]
    """What it takes that nobody gave, in words."""
    errors: tuple[ErrorDetail, ...]
    """Why it cannot be computed."""


@dataclass(frozen=True)
class ThermalState:
    """Temperatures and heats of a solution; arrays of shape (*cases), NaN where there is no steady state."""

    temperatures: dict[NetworkPart, NDArray]
    """Of every node [K]; of a set of several rows, `inner_ring 1` is that of the first."""
    powers: dict[NetworkPart, NDArray]
    """Heat that friction makes, by source [W]."""
    flows: dict[tuple[NetworkPart, NetworkPart], NDArray]
    """Heat on each path, from its first node to its second [W]."""
    imbalance: NDArray
    """The largest heat that any free node takes in and does not give off, of what the solution's friction makes [W]."""
    feedback: NDArray
    """By how much a further watt of heat makes friction grow [-]: at 1 the preload runs away."""
    free: tuple[str, ...]
    """The nodes whose temperatures are found."""
    verdict: NDArray
    """`ThermalVerdict` of each case, as its word."""
    without_steady_state: NDArray
    """Whether a case has an equilibrium, but counts as not solved for want of a steady state."""
    solves: int
    """States of the bearing or set that were solved for it, of each case."""
    thermal: Thermal
    speed: NDArray
    """The larger one of both rings [rad/s]."""
    follow: Callable[[], SpeedCurve]
    with_whole_friction: Callable[[], WholeBearing]
    heat_up: Callable[..., Course]
    """`heat_up(duration, start=None)`: the course of temperatures and preload of a single case, so many seconds at full
    speed from the first instant; from the lowest of the given temperatures, or from `start` [K]. It needs the heat
    capacity of every node that is found."""

    @cached_property
    def speeds(self) -> SpeedCurve:
        """Steady states followed from standstill in speed; of a single case.

        Raises:
            ValueError: there are several cases.
        """
        if self.verdict.shape:
            raise ValueError("steady states are followed in speed for one case; this solution has several")
        return self.follow()

    @cached_property
    def whole_bearing(self) -> WholeBearing | None:
        """With Palmgren's friction; None where the friction model leaves nothing out. Of a single case."""
        return self.with_whole_friction() if self.thermal.bound else None

    def message(self, index: Index = None) -> str:
        """A sentence or two on whether a case is steady.

        Raises:
            ValueError: the index does not name one case.
        """
        place = case_place(index, self.verdict.shape)
        verdict = ThermalVerdict(str(self.verdict[place]))
        if verdict is ThermalVerdict.STABLE:
            name, hottest = max(self.temperatures.items(), key=lambda each: float(each[1][place]))
            return (
                f"Stable at {hottest[place] - zero_celsius:.1f} °C ({name.in_words}){self.thermal.bound}. "
                f"Thermal feedback {self.feedback[place]:.2g} (runaway at 1)."
            )
        limit = f"{self.thermal.limit_temperature - zero_celsius:.4g} °C"
        if verdict is ThermalVerdict.UNDECIDED:
            return (
                f"No steady state below {limit} was found{self.thermal.bound}; this does not prove that there is none."
            )
        curve = self.speeds
        own = f"{float(self.speed) / rpm:.5g} rpm"
        head = f"No steady state below {limit} at {own}{self.thermal.bound}: followed from standstill, steady states"
        if verdict is ThermalVerdict.RUNAWAY and curve.fold is not None:
            fold = self.described(curve.fold)
            return f"Thermal runaway of the preload. {head} exist up to {fold}, where their curve turns back."
        assert curve.at_limit is not None
        return f"Too hot. {head} reach this temperature at {self.described(curve.at_limit)}."

    def onset(self) -> str:
        """Where the steady states of a single case, followed from standstill in speed, end."""
        curve, bound = self.speeds, self.thermal.bound
        if curve.fold is not None:
            return f"Thermal runaway of the preload begins at {self.described(curve.fold)}{bound}."
        limit = f"{self.thermal.limit_temperature - zero_celsius:.4g} °C"
        if curve.at_limit is not None:
            return (
                f"The temperature limit of {limit} is reached at {self.described(curve.at_limit)}, before any "
                f"runaway{bound}."
            )
        if not curve.states:
            return "Steady states could not be followed from standstill."
        return f"Steady states were followed up to {self.described(curve.states[-1])}, without runaway{bound}."

    def described(self, state: State) -> str:
        """A state of the curve in words."""
        loads = " and ".join(dict.fromkeys(map(_digits, state.preloads)))
        hottest = state.temperatures.max() - zero_celsius
        return f"{state.factor * float(self.speed) / rpm:.5g} rpm ({hottest:.1f} °C, axial load {loads} N)"


@no_steady_state.register
def _(thermal: ThermalState, k: int, index: Index) -> str:
    return thermal.message(index) if thermal.without_steady_state.flat[k] else ""


# In records, as JSON has them


def along_curve(curve: dict[str, Any]) -> tuple[list[dict[str, Any]], int | None]:
    """The states of the record of steady states over speed with the fold among them, and the fold's place."""
    states, fold = list(curve["states"]), curve["fold"]
    if fold is None:
        return states, None
    fastest = max(range(len(states)), key=lambda number: float(states[number]["speed_rpm"]))
    place = fastest + (fold["power_W"] > states[fastest]["power_W"])  # the power grows along the curve
    return [*states[:place], fold, *states[place:]], place


def instant(course: dict[str, Any], number: int) -> dict[str, Any]:
    """One instant of the record of heating up, as a state over speed is recorded."""
    return {
        "temperatures_C": {name: values[number] for name, values in course["temperatures_C"].items()},
        "power_W": course["power_W"][number],
        "axial_load_N": [loads[number] for loads in course["axial_load_N"]],
    }


def hottest(temperatures: Mapping[NetworkPart, float]) -> dict[str, float]:
    """By kind of node: of all rows' inner rings, for instance, the hottest."""
    largest: dict[str, float] = {}
    for name, value in temperatures.items():
        kind = name.kind.replace("_", " ")
        largest[kind] = max(value, largest.get(kind, value))
    return largest
