"""How close a solved case is to each limit that is known of it, and the answer that a report opens with."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.documents.model import Remark as Shown
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.model.solution.preload_state import EXCESSIVE, PreloadLoads
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, mm, rpm
from qsbearing.remarks.balls import FRICTION_BEYOND
from qsbearing.remarks.kinds import Severity
from qsbearing.remarks.remark import Remark, row_name
from qsbearing.remarks.wording import capital, listed
from qsbearing.systems.sets.set_solution import SetSolution

if TYPE_CHECKING:
    from qsbearing.systems.heat.state import ThermalState


@dataclass(frozen=True)
class Margin:
    """A number beside its limit."""

    what: str
    value: float
    limit: float
    unit: str
    source: str
    """Whose limit it is."""
    row: str = ""
    """Of a set: which row."""

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
    for number, (row, found) in enumerate(zip(solution.rows, readings, strict=True)):
        name = row_name(solution.set.rows[number], number)
        for each in (*_of_contacts(row, found), *_of_preload_of_row(solution, number)):
            known = worst.get(each.what)
            if known is None or each.used > known.used:
                worst[each.what] = replace(each, row=name)
    return [*worst.values(), *_of_heat(solution.thermal)]


def _of_contacts(solution: Solution, readings: Mapping[str, Any]) -> Iterator[Margin]:
    sides = {"inner": solution.inner, "outer": solution.outer}
    pressure = max(float(np.nanmax(side.max_pressure)) for side in sides.values())
    yield Margin("contact pressure", pressure / MPa, STATIC_PRESSURE / MPa, "MPa", "ISO 76; beyond it permanent dents")
    moment = solution.scene.gyroscopic_moment
    if moment is not None:
        given = moment.friction_coefficient
        limit, source = (
            (FRICTION_BEYOND, "usual of lubricated steel") if given is None else (float(np.asarray(given)), "input")
        )
        required = [np.asarray(side.required_friction)[side.load > 0.0] for side in sides.values()]
        largest = max((float(np.max(each)) for each in required if each.size), default=0.0)
        yield Margin("friction coefficient", largest, limit, "", f"{source}; beyond it balls slip")
    overrun = readings.get("overrun")
    for name, side in sides.items():
        at_edge = None if overrun is None else getattr(overrun, name)
        if at_edge is not None and np.any(side.load > 0.0):
            reach = np.where(side.load > 0.0, side.semi_major_axis, 0.0)
            room = np.where(side.load > 0.0, reach + at_edge.edge_distance, np.inf)
            nearest = int(np.argmax(reach / np.maximum(room, 1e-300)))
            share = max(float(room[nearest]), 0.0) / mm
            yield Margin(
                f"{name} contact to groove edge", float(reach[nearest]) / mm, share, "mm", "shoulder of the input"
            )
    expansion = solution.scene.ring_expansion
    if expansion is not None:
        states = [state for state in (solution.inner_ring, solution.outer_ring) if state is not None]
        stress = max((float(state.equivalent_stress) for state in states), default=0.0)
        if stress > 0.0:
            yield Margin("ring stress", stress / MPa, float(expansion.yield_strength) / MPa, "MPa", "yield strength")


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
    return [Margin("preload", alone, EXCESSIVE * given, "N", f"{EXCESSIVE:g} times its given value")]


def _of_heat(state: ThermalState | None) -> list[Margin]:
    """Against the speed of runaway, or that at which the temperature limit is reached."""
    if state is None:
        return []
    curve = state.speeds
    end, source = (curve.fold, "thermal runaway") if curve.fold is not None else (curve.at_limit, "temperature limit")
    if end is None:
        return []
    return [
        Margin(
            "speed",
            float(state.speed) / rpm,
            end.factor * float(state.speed) / rpm,
            "rpm",
            f"{source}{state.thermal.bound}",
        )
    ]


def answer(found: Sequence[Margin], said: Iterable[Remark]) -> Shown:
    """Whether all limits hold, which is the closest, and what to read before the numbers are used."""
    worst = min((each.kind.severity for each in said), default=Severity.GOOD_TO_KNOW)
    beyond = [each for each in found if each.used > 1.0]
    if beyond:
        first = f"{capital(listed([_of_limit(each) for each in beyond]))}: beyond the limit."
    elif worst is Severity.WRONG_MODEL:
        first = "The model does not describe this case."
    else:
        nearest = max(found, key=lambda each: each.used)
        first = f"Within every known limit; the closest is {_of_limit(nearest)}."
    then = {
        Severity.WRONG_MODEL: "Read the warnings before using any number.",
        Severity.INCOMPLETE_MODEL: "The model is incomplete for this case: see the warnings.",
        Severity.CHECK_DATA: "Check the data: see the warnings.",
        Severity.GOOD_TO_KNOW: "",
    }[worst]
    is_good = not beyond and worst is Severity.GOOD_TO_KNOW
    is_bad = bool(beyond) or worst is Severity.WRONG_MODEL
    return Shown(f"{first} {then}".rstrip(), "pass" if is_good else "fail" if is_bad else "warning")


def _of_limit(each: Margin) -> str:
    row = f" of {each.row}" if each.row else ""
    part = f" ({100.0 * each.used:.0f} %)" if np.isfinite(each.used) else ""
    return f"{each.what}{row}, {each.text}{part}"


def _short(value: float) -> str:
    return f"{value:.0f}" if abs(value) >= 1000.0 else f"{value:.3g}"
