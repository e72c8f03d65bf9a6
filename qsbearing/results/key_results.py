"""The results that most readers look for first: pressures, angles, displacement, stiffness, friction, life."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.documents.model import Facts
from qsbearing.documents.numbers import that_matter
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.groups import (
    ANGLE,
    CONTACT_LOAD,
    CONTACTS,
    FRICTION,
    MAX_PRESSURE,
    OF_MIDDLE,
    OF_PRELOAD,
)
from qsbearing.model.solution.result_keys import (
    DISPLACEMENT,
    LOAD,
    STIFFNESS,
    Group,
    Place,
    Result,
    printed_unit,
)
from qsbearing.model.solution.solution import Solution
from qsbearing.results.tables import freedom

if TYPE_CHECKING:
    from qsbearing.systems.sets.set_solution import SetSolution

FROM_MIDDLE = Place(OF_MIDDLE, OF_MIDDLE.results[0])
NOISE = 1e-8
"""Part of the largest of its kind up to which a displacement or load of the ring is left out, as rounding is: a
hundredth of the last of the six digits that are printed."""


class KeyNumber(NamedTuple):
    """One number of a key result, or the smallest and the largest of several."""

    of: str
    """Whose it is: a raceway, a channel; empty for the only one."""
    values: tuple[float, ...]
    unit: str
    digits: int | None = 4
    """None: one decimal."""

    @property
    def number(self) -> str:
        """As it reads, without its unit."""
        if self.digits is None:
            return " to ".join(dict.fromkeys(f"{each + 0.0:.1f}" for each in np.round(self.values, 1))) or "none"
        return " to ".join(_number(each, self.digits) for each in self.values)

    @property
    def text(self) -> str:
        """With whose it is and its unit."""
        return " ".join(filter(None, (self.of, self.number, self.unit if self.values else "")))


class KeyResult(NamedTuple):
    """One result with its numbers."""

    name: str
    parts: tuple[KeyNumber, ...] = ()
    condition: str = ""
    """Under which it holds."""
    note: str = ""
    """Words besides the numbers, or in place of them."""

    @property
    def line(self) -> tuple[str, str]:
        """Of a table."""
        name = f"{self.name}, {self.condition}" if self.condition else self.name
        return name, ": ".join(filter(None, (", ".join(part.text for part in self.parts), self.note)))


def results_of(solution: Solution, readings: Mapping[str, Any]) -> list[KeyResult]:
    """Those of a single case of a bearing.

    Args:
        readings: what the scene asked to be read off, by name.
    """
    ring = ring_lines(solution, "inner ring")
    heat = heat_lines(solution)
    return [*contact_lines(solution), *ring, *_preload_lines(solution), *heat, *life_lines(readings)]


def answer(solution: Solution, readings: Mapping[str, Any]) -> Facts:
    """The same for a terminal, in the order in which they are looked for; the preload stands in the heading there."""
    ring, contacts = _ring_results(solution, "inner ring"), _contact_results(solution)
    moved = [ring.moved, ring.from_middle, ring.reactions, contacts.angles, contacts.load, contacts.pressure]
    others = [contacts.friction, contacts.unloaded, ring.stiffness, *heat_lines(solution), *life_lines(readings)]
    return facts([*moved, *others])


def facts(results: Iterable[KeyResult]) -> Facts:
    """Those that have anything to say, a line each; conditions stand in the tables below it."""
    return Facts([each._replace(condition="").line for each in results if each.parts or each.note])


class ResultsOfContacts(NamedTuple):
    """Those of the contacts of each raceway."""

    pressure: KeyResult
    angles: KeyResult
    load: KeyResult
    friction: KeyResult
    unloaded: KeyResult


def _contact_results(solution: Solution) -> ResultsOfContacts:
    is_ball = np.isfinite(solution.azimuth)
    empty = int((is_ball & (solution.inner_load == 0.0)).sum())
    count = (KeyNumber("", (empty,), f"of {is_ball.sum()}"),) if empty else ()
    return ResultsOfContacts(
        KeyResult("maximum contact pressure", largest_of(solution, MAX_PRESSURE)),
        KeyResult("contact angles", tuple(angles_of(solution, side, side.raceway) for side in CONTACTS)),
        KeyResult("maximum contact load", largest_of(solution, CONTACT_LOAD)),
        KeyResult("required friction coefficient", largest_of(solution, FRICTION, 2)),
        KeyResult("balls without load on the inner raceway", count),
    )


def contact_lines(solution: Solution) -> list[KeyResult]:
    """Maximum pressure, range of the contact angles, maximum load and required friction, of each raceway."""
    return [each for each in _contact_results(solution) if each.parts]


def largest_of(solution: Solution, result: Result, digits: int = 4) -> tuple[KeyNumber, ...]:
    """Of the contacts of each raceway."""
    places = (Place(side, result, over="max") for side in CONTACTS)
    return tuple(one for each in places for one in numbers_at(each, solution, each.group.raceway, digits))


def angles_of(solution: Solution, side: Group, of: str = "") -> KeyNumber:
    """From the least to the largest of the loaded contacts."""
    angles, loads = (np.asarray(Place(side, each).of(solution)) for each in (ANGLE, CONTACT_LOAD))
    loaded = angles[loads > 0.0]
    ends = (float(loaded.min()), float(loaded.max())) if loaded.size else ()
    return KeyNumber(of, ends, printed_unit(ANGLE.unit), None)


class KeyRing(NamedTuple):
    """Those of a ring or shaft."""

    moved: KeyResult
    from_middle: KeyResult
    stiffness: KeyResult
    reactions: KeyResult


def ring_lines(solution: Solution | SetSolution, what: str) -> list[KeyResult]:
    """Displacement and effective stiffness where ring or shaft is free to move, loads where it is not.

    Args:
        what: moves.
    """
    return [each for each in _ring_results(solution, what) if each.parts]


def levers_of(solution: Solution | SetSolution) -> NDArray:
    """What makes each channel's displacement a shift: of a tilt the radius of the largest pitch circle [m], else 1."""
    of = [solution.scene] if isinstance(solution, Solution) else solution.set.rows
    lever = 0.5 * max(float(np.asarray(each.bearing.pitch_diameter)) for each in of)
    return np.array([lever if channel.is_rotation else 1.0 for channel in CHANNELS])


def are_rounding(values: NDArray, levers: NDArray) -> NDArray:
    """Which of five channels are nothing beside the largest; none that is not known."""
    sizes = np.abs(values) * levers
    return np.asarray(sizes <= NOISE * np.nan_to_num(sizes, nan=0.0).max())


def _ring_results(solution: Solution | SetSolution, what: str) -> KeyRing:
    free, levers = set(map(int, solution.free_channels)), levers_of(solution)
    moved = of_channels(DISPLACEMENT, solution.displacement, levers, free)
    stiff = of_channels(STIFFNESS, solution.effective_stiffness, 1.0 / levers**2, free)
    given = set(range(len(CHANNELS))) - free
    reactions = of_channels(LOAD, solution.load, 1.0 / levers, given)
    from_middle = numbers_at(FROM_MIDDLE, solution) if isinstance(solution, Solution) else ()
    return KeyRing(
        KeyResult(f"displacement of the {what}", moved),
        KeyResult("axial displacement from the middle", from_middle),
        KeyResult("effective stiffness", stiff, freedom(free)),
        KeyResult("load where a displacement is given", reactions),
    )


def _preload_lines(solution: Solution) -> list[KeyResult]:
    if solution.scene.preload is None:
        return []
    words = {"unmounted": "before fitting", "mounted": "mounted at rest", "in_operation": "in operation"}
    places = (Place(OF_PRELOAD, each) for each in OF_PRELOAD.results if each.name in words)
    return [KeyResult("preload", tuple(numbers_at(each, solution, words[each.result.name])[0] for each in places))]


def numbers_at(place: Place, solution: Any, of: str = "", digits: int = 4) -> tuple[KeyNumber, ...]:
    """The number of a place, in a single case; none where there is none."""
    value = place.of(solution)
    return () if value is None else (KeyNumber(of, (float(value),), printed_unit(place.unit), digits),)


def of_channels(
    channels: tuple[Result, ...], values: NDArray, levers: NDArray, which: set[int]
) -> tuple[KeyNumber, ...]:
    """Channels with their values; what is rounding beside the largest, measured at the pitch circle, is left out."""
    rounding = are_rounding(values, levers)
    return tuple(
        KeyNumber(channel.label, (float(np.asarray(each.of(values))),), printed_unit(each.unit))
        for i, (channel, each) in enumerate(zip(CHANNELS, channels, strict=True))
        if i in which and np.isfinite(values[i]) and not rounding[i]
    )


def heat_lines(solution: Solution | SetSolution) -> list[KeyResult]:
    return [] if solution.thermal is None else [KeyResult("heat balance", note=solution.thermal.message())]


def life_lines(readings: Mapping[str, Any]) -> list[KeyResult]:
    life = readings.get("life")
    if life is None:
        return []
    factors = [] if life.reliability_factor == 1.0 else [f"a1 {life.reliability_factor:.2g}"]
    if life.life_modification_factor is not None:
        limit = ", at its limit" if life.is_at_limit else ""
        factors.append(f"aISO {_number(float(life.life_modification_factor), 3)}{limit}")
    lines = [KeyResult("basic reference rating life", _life(life, "basic_reference_rating_life", "basic_duration"))]
    if factors:
        parts = _life(life, "reference_rating_life", "duration")
        lines.append(KeyResult("modified reference rating life", parts, note=", ".join(factors)))
    return lines


def _life(life: Any, turns: str, duration: str) -> tuple[KeyNumber, ...]:
    """In revolutions and, where there is a speed, in hours."""
    both = (number_of_life(name, life) for name in (turns, duration))
    return tuple(each for each in both if each.unit != "h" or np.isfinite(each.values[0]))


def number_of_life(name: str, life: Any) -> KeyNumber:
    from qsbearing.readings.rating_life import ENTRY  # loaded only where a life is read off

    with_factors = {"reference_rating_life": ("basic_reference_rating_life", "reference_rating_life")}
    known, path = with_factors.get(name, (name, ""))
    result = next(each for each in ENTRY.of_case if each.name == known)
    result = result._replace(path=path) if path else result
    unit = "million revolutions" if result.unit == "Mrev" else result.unit
    return KeyNumber("", (float(np.asarray(result.of(life))),), unit)


def _number(value: float, digits: int = 4) -> str:
    """So many digits, without an exponent where it is long."""
    if digits == 3:
        return that_matter(value)
    return f"{value:.0f}" if 10**digits <= abs(value) < 1e9 else f"{value:.{digits}g}"
