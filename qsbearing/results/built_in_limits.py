"""The limits that hold without anybody asking: of contacts, balls, shoulders, rings, preload and heat.

Each is a line of `BUILT_IN`, which states its name, what makes the smaller of two estimates the safe one, and what must
be given for it to be checked; reports, `run --json` and the list of what was not checked follow.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.groups import CONTACTS, FRICTION, OF_PRELOAD, RING, RINGS, channels
from qsbearing.model.solution.limit import Answer, Estimate, Limit, Origin, answers
from qsbearing.model.solution.preload_state import EXCESSIVE
from qsbearing.model.solution.result_keys import MAX, SIZE, Group, Place, Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, mm, rpm
from qsbearing.remarks.balls import LEAST_TYPICAL, MOST_TYPICAL
from qsbearing.remarks.bearing import STATIC_LIMIT

if TYPE_CHECKING:
    from qsbearing.model.effects import RingExpansion
    from qsbearing.systems.heat.state import ThermalState
    from qsbearing.systems.sets.set_solution import SetSolution

Readings = Mapping[str, Any]


class Part(NamedTuple):
    """A bearing, or a row of a set, with what was read off."""

    solution: Solution
    readings: Readings
    whole: Any
    """The solution of the bearing or set."""
    row: int = 0
    """From 1; 0: a bearing alone."""

    def place(self, group: Group, result: Result, over: str = "") -> Place:
        """Of this bearing or row."""
        return Place(group, result, self.row, over)

    def of_reading(self, name: str, result: str) -> Place:
        """A number that a reading has of the whole bearing."""
        from qsbearing.readings.asked import READINGS  # where nothing is read off, they are not loaded

        group = READINGS[name].groups[0]
        return self.place(group, next(each for each in group.results if each.name == result))


class BuiltIn(NamedTuple):
    """A limit that is known without being asked for."""

    name: str
    safe: str
    """What makes the smaller of two estimates the safe one."""
    needs: str
    """What must be there for it to be checked."""
    of: Callable[[Part], Iterator[Limit]]
    """Of a bearing or row; nothing where it is not checked."""


def _pressure(part: Part) -> Iterator[Limit]:
    yield STATIC_LIMIT._replace(places=tuple(each._replace(row=part.row) for each in STATIC_LIMIT.places))


def _of_loaded(contacts: Any) -> NDArray | None:
    """The coefficient that the moment requires, of contacts that carry load."""
    required = contacts.required_friction
    return None if required is None else np.where(contacts.load > 0.0, required, np.nan)


def _friction(part: Part) -> Iterator[Limit]:
    moment, slip = part.solution.scene.gyroscopic_moment, part.readings.get("ball_slip")
    if moment is None:
        return
    law = part.solution.scene.traction
    given = moment.friction_coefficient if law is None else law.coefficient
    if given is None and slip is not None:
        given = slip.friction_coefficient
    places = tuple(part.place(group, FRICTION._replace(path=_of_loaded), MAX) for group in CONTACTS)
    if given is not None:
        origin = "input" if law is None or not law.is_assumed else "assumed"
        yield Limit(places, "<=", np.asarray(given, float)[..., None], f"{origin}; beyond it balls slip")
        return
    others = (Estimate(MOST_TYPICAL, "the contacts offer that much friction"),)
    yield Limit(places, "<=", LEAST_TYPICAL, "the least of lubricated steel; beyond it balls may slip", others=others)


def _drag(part: Part) -> Iterator[Limit]:
    slip = part.readings.get("ball_slip")
    if slip is not None and slip.most_drag_used is not None:
        place = part.of_reading("ball_slip", "most_drag_used")
        yield Limit((place,), "<=", 1.0, "friction that drives them, most oil")


def _least_load(part: Part) -> Iterator[Limit]:
    slip = part.readings.get("ball_slip")
    if slip is not None and slip.maker_axial_load is not None:
        group = next(each for each in channels(RING) if each.prefix == "load")
        place = part.place(group, group.results[0], SIZE)
        source = "the maker's factor, by the square of the speed; a lighter load lets balls skid"
        yield Limit((place,), ">=", slip.maker_axial_load, source, Origin.MAKER)


def _shoulder(side: str, part: Part) -> Iterator[Limit]:
    overrun = part.readings.get("overrun")
    at_edge = None if overrun is None else getattr(overrun, side)
    if at_edge is None:
        return
    group = next(each for each in CONTACTS if each.raceway == side)
    reach = next(each for each in group.results if each.name == "semi_major_axis")._replace(path=_reach)
    room = np.maximum(getattr(part.solution, side).semi_major_axis + at_edge.edge_distance, 0.0) / mm
    yield Limit((part.place(group, reach),), "<=", room, "shoulder of the input")


def _reach(contacts: Any) -> NDArray:
    """Of the ellipses of contacts that carry load."""
    return np.where(contacts.load > 0.0, contacts.semi_major_axis, np.nan)


def _yield(part: Part) -> Iterator[Limit]:
    rings = part.solution.scene.ring_expansion
    if rings is None:
        return
    for number, (side, group) in enumerate(zip(("inner", "outer"), RINGS, strict=True)):
        stress, state = max(_stresses(part.solution, rings, number), key=lambda each: float(np.max(each[0])))
        if np.max(stress) > 0.0:
            result = next(each for each in group.results if each.name == "equivalent_stress")
            place = part.place(group._replace(holder=KnownNumber(stress)), result._replace(path=""))
            source = f"yield strength; the {side} ring {state}"
            yield Limit((place,), "<=", np.asarray(rings.yield_strength, float) / MPa, source)


class KnownNumber(NamedTuple):
    """What has a number that is known already."""

    values: NDArray

    def __call__(self, solution: Any) -> NDArray:
        """Of any solution."""
        return self.values


def _stresses(solution: Solution, rings: RingExpansion, number: int) -> Iterator[tuple[NDArray, str]]:
    """The largest stress of a ring and where it has it: in operation, at rest and cold; at the limits of its fits."""
    operation = solution.scene.operation
    still = replace(operation, speed=0.0, outer_speed=None)
    fits = {"": {}} if not rings.fits else {
        f" with its fit at the {words} interference": {
            f"{seat}_interference": getattr(fit, end) for seat, fit in rings.fits.items()
        }
        for end, words in (("most", "largest"), ("least", "least"))
    }  # fmt: skip
    state = (solution.inner_ring, solution.outer_ring)[number]
    if state is not None:
        yield np.asarray(state.equivalent_stress), "in operation" + " with its mean fit" * bool(rings.fits)
    for words, seats in fits.items():
        there = replace(rings, **seats)
        if seats:
            yield there.states(solution.scene.bearing, operation)[number].equivalent_stress, f"in operation{words}"
        cold = there.without_heat.states(solution.scene.bearing, still)[number]
        yield cold.equivalent_stress, f"at rest and cold{words}"


def _preload(part: Part) -> Iterator[Limit]:
    whole = part.whole
    if part.row:
        from qsbearing.systems.sets.set_groups import PRELOAD  # a bearing alone does not load it

        group, loads = PRELOAD, whole.preload_loads
    else:
        preload = part.solution.scene.preload
        group, loads = OF_PRELOAD, None if preload is None or preload.kind == "spring" else whole.preload_loads
    if loads is None:
        return
    given, alone, _ = (each[..., part.row - 1] if part.row else each for each in loads.arrays)
    if np.all(given > 0.0):
        result = next(each for each in group.results if each.name == "alone")
        place = part.place(group._replace(holder=KnownNumber(alone), axis=""), result._replace(path=""))
        yield Limit((place,), "<=", EXCESSIVE * given, f"{EXCESSIVE:g} times its given value")


SPEED = Group((Result("speed", "rpm", "speed of the faster ring", path="speed"),), prefix="steady", holder="thermal")
OPEN_HEAT = (
    "The limit of speed rests on a lower bound of the heat: with the friction of the whole bearing it is not computed "
    "(see the heat balance)."
)


def _runaway(part: Part) -> Iterator[Limit]:
    """Against the speed of runaway, or that at which the temperature limit is reached; where the friction model leaves
    heat out, with the friction of the whole bearing too."""
    state = part.whole.thermal
    if state is None or part.row > 1 or part.whole.shape or not state.speeds.states:
        return
    whole = state.whole_bearing
    other = None if whole is None else whole.state
    known = [each for each in (state, other) if each is not None and each.speeds.states]
    is_open = whole is not None and len(known) < 2
    if not is_open and all(each.speeds.end is None for each in known):
        return
    ends = sorted((_end(each, each is state and whole is not None) for each in known), key=lambda each: each[0].value)
    (nearest, source), *farther = ends
    others = tuple(each for each, _ in farther if each.needs)
    place = Place(SPEED, SPEED.results[0])
    yield Limit((place,), "<=", nearest.value, source, others=others, doubt=OPEN_HEAT if is_open else "")


def _end(state: ThermalState, is_least_friction: bool) -> tuple[Estimate, str]:
    """Where steady states end, or how far they were followed without an end; and whose number that is."""
    curve = state.speeds
    source = "thermal runaway" if curve.fold is not None else "temperature limit" if curve.end else "followed so far"
    factor = (curve.end or curve.states[-1]).factor
    needs = "friction is no more than that of the contacts alone" if is_least_friction else ""
    value = factor * float(state.speed) / rpm
    return Estimate(value, needs), f"{source}, with the friction model {state.thermal.friction}"


_EDGE, _SHOULDERS = "the nearer edge cuts the contact first", "[readings.overrun] with the diameter of its shoulder"
BUILT_IN = (
    BuiltIn("contact pressure", "the lower pressure dents first", "", _pressure),
    BuiltIn(
        "friction coefficient",
        "contacts that offer less let the balls slip first",
        "the gyroscopic moment among [effects]",
        _friction,
    ),
    BuiltIn(
        "drag on the balls",
        "with less of the space free of oil balls skid first",
        "[readings.ball_slip] with drag_coefficient and shares of oil",
        _drag,
    ),
    BuiltIn(
        "maker's least axial load",
        "a lighter load lets balls skid first",
        "[readings.ball_slip] with minimum_load_factor",
        _least_load,
    ),
    BuiltIn("inner contact to groove edge", _EDGE, _SHOULDERS, partial(_shoulder, "inner")),
    BuiltIn("outer contact to groove edge", _EDGE, _SHOULDERS, partial(_shoulder, "outer")),
    BuiltIn("ring stress", "the weaker steel yields first", "[effects.ring_expansion] with fits or speed", _yield),
    BuiltIn(
        "preload",
        "the smaller multiple of what was given is reached first",
        "[preload], other than a spring",
        _preload,
    ),
    BuiltIn(
        "thermal speed limit",
        "with more friction the preload runs away, or the limit of temperature is reached, at less",
        "[thermal], of one operating point, and a speed at which steady states end",
        _runaway,
    ),
)
"""All that there are, in the order of reports."""
NAMES = {each.name: each for each in BUILT_IN}
WITHOUT_LIMIT = ("life", "static safety", "speed factor n dm", "film", "stiffness")
"""What designs are judged by, of which this program knows no limit: [require] has them."""


def built_in_answers(solution: Solution | SetSolution, readings: Any) -> list[Answer]:
    """How a solution answers each limit; of a set that of the row that is closest to it.

    Args:
        readings: what was read off, by name; of a set those of each row.
    """
    every = (_answer(each, solution, readings) for each in BUILT_IN)
    return [each for each in every if each is not None]


def not_checked(checked: Sequence[Answer]) -> dict[str, str]:
    """The limits that nothing answers, and what each needs."""
    known = {each.limit.name for each in checked}
    return {each.name: each.needs for each in BUILT_IN if each.name not in known}


def _answer(built_in: BuiltIn, solution: Any, readings: Any) -> Answer | None:
    limits = [each for part in _parts(solution, readings) for each in built_in.of(part)]
    named = (each._replace(name=built_in.name, origin=_origin(each)) for each in limits)
    return max(answers(solution, named, readings), key=lambda each: np.nan_to_num(each.used, nan=-1.0), default=None)


def _origin(of: Limit) -> Origin:
    return Origin.MODEL if of.origin is Origin.INPUT else of.origin


def _parts(solution: Any, readings: Any) -> list[Part]:
    if isinstance(solution, Solution):
        return [Part(solution, readings, solution)]
    rows = zip(solution.rows, readings, strict=True)
    return [Part(row, own, solution, number) for number, (row, own) in enumerate(rows, 1)]
