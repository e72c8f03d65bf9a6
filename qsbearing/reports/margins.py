"""How close a solved case is to each limit that is known of it, and the answer that a report opens with."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from qsbearing.documents.model import Callout
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.model.solution.preload_state import EXCESSIVE, PreloadLoads
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, mm, rpm
from qsbearing.readings.ball_slip import BallSlip
from qsbearing.remarks.balls import FRICTION_BEYOND, FRICTION_IN_DOUBT
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.remark import Remark, row_name
from qsbearing.remarks.wording import capital, listed
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from qsbearing.systems.heat.state import ThermalState


class Limit(NamedTuple):
    """What is the same of a limit in every case. Each is an upper one, so that of several estimates the smallest is on
    the safe side: `Margin.limit` is that."""

    unit: str
    safe: str
    """What makes the smaller of two estimates the safe one."""


_EDGE = Limit("mm", "the nearer edge cuts the contact first")
LIMITS = {
    "contact pressure": Limit("MPa", "the lower pressure dents first"),
    "friction coefficient": Limit("", "contacts that offer less let the balls slip first"),
    "drag on the balls": Limit("", "with less of the space free of oil balls skid first"),
    "least axial load": Limit("N", "a lighter load lets balls skid first"),
    "inner contact to groove edge": _EDGE,
    "outer contact to groove edge": _EDGE,
    "ring stress": Limit("MPa", "the weaker steel yields first"),
    "preload": Limit("N", "the smaller multiple of what was given is reached first"),
    "speed": Limit("rpm", "with more friction the preload runs away, or the limit of temperature is reached, at less"),
}
"""All that there are, by their names."""


OPEN_HEAT = (
    "The limit of speed rests on a lower bound of the heat: with the friction of the whole bearing it is not computed "
    "(see the heat balance)."
)


class Estimate(NamedTuple):
    """One number for a limit."""

    value: float
    source: str
    """Whose it is."""
    needs: str = ""
    """Of one beside a safer one: what must be true for it to hold, in words that follow "unless"."""


USUAL_FRICTION = (
    Estimate(FRICTION_IN_DOUBT, "the least of lubricated steel; beyond it balls may slip"),
    Estimate(FRICTION_BEYOND, "the most of lubricated steel", "the contacts offer that much friction"),
)


@dataclass(frozen=True)
class Margin:
    """A number beside its limit."""

    what: str
    """One of `LIMITS`."""
    value: float
    estimates: tuple[Estimate, ...]
    row: str = ""
    """Of a set: which row."""
    doubt: str = ""
    """Why its limit may lie below all its estimates, as a sentence."""

    @property
    def limit(self) -> float:
        """On the safe side."""
        return self._safe.value

    @property
    def source(self) -> str:
        """Whose limit it is."""
        return self._safe.source

    @property
    def unit(self) -> str:
        """Of the number and its limit."""
        return LIMITS[self.what].unit

    @property
    def _safe(self) -> Estimate:
        return min(self.estimates, key=lambda each: each.value)

    @property
    def unless(self) -> str:
        """Beyond the limit, but not beyond another estimate of it: what that one needs; else empty."""
        farther = [each for each in self.estimates if each.needs and self.limit < self.value <= each.value]
        if not farther:
            return ""
        nearest = min(farther, key=lambda each: each.value)
        return f"{nearest.needs} (the limit is then {_short(nearest.value)} {self.unit}".rstrip() + ")"

    @property
    def used(self) -> float:
        """Part of the limit that is used; 1 at the limit."""
        return self.value / self.limit if self.limit > 0.0 else np.inf

    @property
    def text(self) -> str:
        """The number and its limit."""
        return f"{_short(self.value)} of {_short(self.limit)} {self.unit}".rstrip()


def margins(solution: Solution, readings: Mapping[str, Any]) -> list[Margin]:
    """Those of a single case of a bearing; a limit that nothing gives has none.

    Args:
        readings: what was read off, by name.
    """
    return [*_of_contacts(solution, readings), *_of_preload(solution), *_of_heat(solution.thermal)]


def margins_of_set(solution: SetSolution, readings: Sequence[Mapping[str, Any]]) -> list[Margin]:
    """Likewise of a set: of each limit, that of the row that is closest to it."""
    worst: dict[str, Margin] = {}
    for number, (row, of_row) in enumerate(zip(solution.rows, readings, strict=True)):
        name = row_name(solution.set.rows[number], number)
        for each in (*_of_contacts(row, of_row), *_of_preload_of_row(solution, number)):
            known = worst.get(each.what)
            if known is None or each.used > known.used:
                worst[each.what] = replace(each, row=name)
    return [*worst.values(), *_of_heat(solution.thermal)]


def _of_contacts(solution: Solution, readings: Mapping[str, Any]) -> Iterator[Margin]:
    sides = {"inner": solution.inner, "outer": solution.outer}
    pressure = max(float(np.nanmax(side.max_pressure)) for side in sides.values())
    dents = Estimate(STATIC_PRESSURE / MPa, "ISO 76; beyond it permanent dents")
    yield Margin("contact pressure", pressure / MPa, (dents,))
    moment, slip = solution.scene.gyroscopic_moment, readings.get("ball_slip")
    if moment is not None:
        given = moment.friction_coefficient
        if given is None and slip is not None:
            given = slip.friction_coefficient
        own = () if given is None else (Estimate(float(np.asarray(given)), "input; beyond it balls slip"),)
        required = [np.asarray(side.required_friction)[side.load > 0.0] for side in sides.values()]
        largest = max((float(np.max(each)) for each in required if each.size), default=0.0)
        yield Margin("friction coefficient", largest, own or USUAL_FRICTION)
    yield from _of_slip(solution, slip)
    overrun = readings.get("overrun")
    for name, side in sides.items():
        at_edge = None if overrun is None else getattr(overrun, name)
        if at_edge is not None and np.any(side.load > 0.0):
            reach = np.where(side.load > 0.0, side.semi_major_axis, 0.0)
            room = np.where(side.load > 0.0, reach + at_edge.edge_distance, np.inf)
            nearest = int(np.argmax(reach / np.maximum(room, 1e-300)))
            share = max(float(room[nearest]), 0.0) / mm
            edge = Estimate(share, "shoulder of the input")
            yield Margin(f"{name} contact to groove edge", float(reach[nearest]) / mm, (edge,))
    expansion = solution.scene.ring_expansion
    if expansion is not None:
        states = [state for state in (solution.inner_ring, solution.outer_ring) if state is not None]
        stress = max((float(state.equivalent_stress) for state in states), default=0.0)
        if stress > 0.0:
            strength = Estimate(float(expansion.yield_strength) / MPa, "yield strength")
            yield Margin("ring stress", stress / MPa, (strength,))


def _of_slip(solution: Solution, slip: BallSlip | None) -> Iterator[Margin]:
    if slip is None:
        return
    if slip.most_drag_used is not None and np.isfinite(slip.most_drag_used):
        yield Margin(
            "drag on the balls", float(slip.most_drag_used), (Estimate(1.0, "friction that drives them, most oil"),)
        )
    axial = abs(float(solution.load[0]))
    if slip.maker_axial_load is not None and axial > 0.0:
        yield Margin("least axial load", float(slip.maker_axial_load), (Estimate(axial, "axial load"),))


def _of_preload(solution: Solution) -> list[Margin]:
    preload = solution.scene.preload
    is_held = preload is not None and preload.kind != "spring"
    return _excessive(solution.preload_loads) if is_held else []


def _of_preload_of_row(solution: SetSolution, number: int) -> list[Margin]:
    loads = solution.preload_loads
    return [] if loads is None else _excessive(PreloadLoads(*(np.asarray(each)[number] for each in loads)))


def _excessive(loads: PreloadLoads | None) -> list[Margin]:
    if loads is None:
        return []
    given, alone, _ = (float(each) for each in loads.arrays)
    if not given > 0.0:
        return []
    most = Estimate(EXCESSIVE * given, f"{EXCESSIVE:g} times its given value")
    return [Margin("preload", alone, (most,))]


def _of_heat(state: ThermalState | None) -> list[Margin]:
    """Against the speed of runaway, or that at which the temperature limit is reached; where the friction model leaves
    heat out, with the friction of the whole bearing too."""
    if state is None or not state.speeds.states:
        return []
    whole = state.whole_bearing
    other = None if whole is None else whole.state
    known = [each for each in (state, other) if each is not None and each.speeds.states]
    is_open = whole is not None and len(known) < 2
    if not is_open and all(each.speeds.end is None for each in known):
        return []
    estimates = tuple(_end(each, each is state and whole is not None) for each in known)
    return [Margin("speed", float(state.speed) / rpm, estimates, doubt=OPEN_HEAT if is_open else "")]


def _end(state: ThermalState, is_least_friction: bool) -> Estimate:
    """Where steady states end, or how far they were followed without an end."""
    curve = state.speeds
    source = "thermal runaway" if curve.fold is not None else "temperature limit" if curve.end else "followed so far"
    factor = (curve.end or curve.states[-1]).factor
    needs = "friction is no more than that of the contacts alone" if is_least_friction else ""
    by = f", with the friction model {state.thermal.friction}"
    return Estimate(factor * float(state.speed) / rpm, f"{source}{by}", needs)


def answer(every: Sequence[Margin], said: Iterable[Remark]) -> Callout:
    """Whether all limits hold, which is the closest, and what to read before the numbers are used."""
    worst = min((each.kind.severity for each in said), default=Severity.GOOD_TO_KNOW)
    beyond = [each for each in every if each.used > 1.0]
    doubts = [each.doubt for each in every if each.doubt]
    if beyond:
        first = " ".join(
            f"{capital(listed(map(_of_limit, each)))}: beyond the limit{f', unless {unless}' if unless else ''}."
            for unless, each in _by_unless(beyond).items()
        )
    elif worst is Severity.WRONG_MODEL:
        first = "The model does not describe this case."
    else:
        nearest = max(every, key=lambda each: each.used)
        first = f"Within every known limit; the closest is {_of_limit(nearest)}."
    then = {
        Severity.WRONG_MODEL: "Read the warnings before using any number.",
        Severity.INCOMPLETE_MODEL: "The model is incomplete for this case: see the warnings.",
        Severity.CHECK_DATA: "Check the data: see the warnings.",
        Severity.GOOD_TO_KNOW: "",
    }[worst]
    is_good = not beyond and not doubts and worst is Severity.GOOD_TO_KNOW
    is_bad = any(not each.unless for each in beyond) or worst is Severity.WRONG_MODEL
    text = " ".join(filter(None, (first, *doubts, then)))
    return Callout(text, "pass" if is_good else "fail" if is_bad else "warning")


def _by_unless(beyond: Iterable[Margin]) -> dict[str, list[Margin]]:
    groups: dict[str, list[Margin]] = {}
    for each in beyond:
        groups.setdefault(each.unless, []).append(each)
    return groups


def _of_limit(each: Margin) -> str:
    row = f" of {each.row}" if each.row else ""
    part = f" ({100.0 * each.used:.0f} %)" if np.isfinite(each.used) else ""
    return f"{each.what}{row}, {each.text}{part}"


def _short(value: float) -> str:
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"
