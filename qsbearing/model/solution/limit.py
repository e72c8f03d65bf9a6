"""A limit of a result, whoever sets it, and how a solution answers it: met, not met, or open, and how much there is to
spare. A limit holds for the worst ball, raceway, row and case of what its name leaves out."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.solution.result_keys import BALL, LEAST_SIZE, MAX, MIN, SIZE, SIZES, Place
from qsbearing.model.units import deg


class Origin(StrEnum):
    """Who sets a limit."""

    INPUT = "input"
    MODEL = "model"
    """What the equations, or the material, end at."""
    MAKER = "maker"


MET = 1e-6
"""A limit is met to this part of its value: what a search for it leaves, far below what a drawing states."""


class Estimate(NamedTuple):
    """Another number for the same limit, farther from the safe side."""

    value: float
    needs: str
    """What must be true for it to hold, in words that follow "unless"."""


class Limit(NamedTuple):
    """What a result must not exceed, or fall below. Of several estimates it is the one on the safe side."""

    places: tuple[Place, ...]
    """Of the results that it holds for, each by itself; of several rows or raceways where the name leaves them out."""
    sense: str
    """"<=" or ">="."""
    value: ArrayLike
    """In the unit of the result; of each ball, where each has its own."""
    source: str = ""
    """Whose number it is."""
    origin: Origin = Origin.INPUT
    name: str = ""
    """As whoever sets it calls it."""
    others: tuple[Estimate, ...] = ()
    doubt: str = ""
    """Why it may lie nearer than all that is known of it, as a sentence."""

    @property
    def unit(self) -> str:
        """Of the result, as `result_keys.UNITS` has it."""
        return self.places[0].unit

    @property
    def is_of_sizes(self) -> bool:
        """Whether the sign of the result does not count."""
        return self.places[0].over in SIZES


class Standing(StrEnum):
    """How a limit is answered."""

    MET = "met"
    NOT_MET = "not met"
    OPEN = "open"


class Worst(NamedTuple):
    """Whose number decides; nothing where there is none to tell apart."""

    row: int = 0
    """Of a set, from 1."""
    raceway: str = ""
    ball: int | None = None
    """From 0, as tables count them."""
    azimuth_deg: float | None = None
    """Of this ball."""
    point: int = 0
    """Of several cases, from 1."""


class WhyOpen(NamedTuple):
    """Why a limit is open; the sentence is made when somebody reads it."""

    code: str
    """One of `OPEN`."""
    values: dict[str, Any]


OPEN = ("not_called_for", "arguments_missing", "not_solved", "no_number", "estimate")
"""The scene does not call for the result; its reading lacks arguments; a case has no solution; the number is not
defined there; what the model leaves out may use up what there is to spare."""


class Answer(NamedTuple):
    """How a solution answers a limit."""

    limit: Limit
    state: Standing
    value: float
    """Of the worst, in the unit of the result; NaN where there is none."""
    bound: float
    """The limit there."""
    place: Place
    worst: Worst
    reason: WhyOpen | None = None
    """Of one that is open."""

    @property
    def margin(self) -> float:
        """How much there is to spare, in the unit of the result; negative beyond the limit."""
        return self.bound - self.value if self.limit.sense == "<=" else self.value - self.bound

    @property
    def spare(self) -> float:
        """Part of the limit that is to spare."""
        return self.margin / abs(self.bound) if self.bound else np.copysign(np.inf, self.margin)

    @property
    def used(self) -> float:
        """Part of the limit that is used: of an upper one the value over it, of a lower one it over the value; 1 at
        the limit."""
        part, whole = (self.value, self.bound) if self.limit.sense == "<=" else (self.bound, self.value)
        return part / whole if whole > 0.0 else np.inf

    def moved_to(self, value: float) -> Answer:
        """The answer where the number is this."""
        moved = self._replace(value=value, state=Standing.MET)
        return moved._replace(state=Standing.NOT_MET) if moved._is_beyond else moved

    @property
    def _is_beyond(self) -> bool:
        return self.margin < -MET * abs(self.bound)

    @property
    def unless(self) -> Estimate | None:
        """Beyond the limit, but not beyond another estimate of it: the nearest of these."""
        farther = [each for each in self.limit.others if self.bound < self.value <= each.value]
        return min(farther, key=lambda each: each.value, default=None)


def answers(solution: Any, limits: Iterable[Limit], readings: Any = None) -> list[Answer]:
    """One answer for each limit; a limit that is reached is met.

    Args:
        solution: of a bearing or a set; of several cases the worst counts.
        readings: what was read off, by name; of a set those of each row.
    """
    return [_answer(solution, each, readings) for each in limits]


def spare(solution: Any, limits: Iterable[Limit], readings: Any = None) -> NDArray:
    """The least part of any limit that is to spare, case by case; negative beyond one, NaN where one is open.

    Args:
        limits: of numbers that all balls have together, as `ending` makes them.
        readings: as for `answers`.
    """
    least = np.full(solution.shape, np.inf)
    for limit in limits:
        for place in limit.places:
            values = place.of(solution, readings)
            if values is None:
                return np.full(solution.shape, np.nan)
            margin = limit.value - values if limit.sense == "<=" else values - limit.value
            with np.errstate(divide="ignore", invalid="ignore"):
                part = margin / np.abs(np.asarray(limit.value, float))
            least = np.minimum(least, np.where(np.abs(part) <= MET, 0.0, part))
    return np.where(solution.converged, least, np.nan)


def _answer(solution: Any, limit: Limit, readings: Any) -> Answer:
    """That of the worst place; not met where one is not, else open where one is."""
    every = [_at(solution, limit, place, readings) for place in limit.places]
    for state in (Standing.NOT_MET, Standing.OPEN):
        if some := [each for each in every if each.state is state]:
            return min(some, key=lambda each: each.spare)
    return min(every, key=lambda each: each.spare)


def _at(solution: Any, limit: Limit, place: Place, readings: Any) -> Answer:
    """Of one place."""
    where = Worst(place.row, place.group.raceway)
    none = Answer(limit, Standing.OPEN, np.nan, np.nan, place, Worst(place.row))
    values = place._replace(over="").of(solution, readings)
    if values is None:
        return none._replace(reason=_absent(place) if np.all(solution.converged) else _without_number(solution))
    bounds, values = np.broadcast_arrays(np.asarray(limit.value, float), _counted(values, place))
    index = _worst(values, _beyond(limit, values, bounds), place)
    lacks = None if np.all(_known(values, place)) else _without_number(solution)
    if index is None:
        return none._replace(reason=lacks)
    value, bound = float(values[index]), float(bounds[index])
    worst = _with_index(where, index, solution, place, values)
    answer = Answer(limit, Standing.MET, value, bound, place, worst)
    if answer._is_beyond:
        return answer._replace(state=Standing.NOT_MET)
    return answer if lacks is None else answer._replace(state=Standing.OPEN, reason=lacks)


def _beyond(limit: Limit, values: NDArray, bounds: NDArray) -> NDArray:
    """By what part of the limit each is beyond it; of a limit of zero by how much."""
    beyond = values - bounds if limit.sense == "<=" else bounds - values
    return np.asarray(beyond / np.where(bounds == 0.0, 1.0, np.abs(bounds)))


def _without_number(solution: Any) -> WhyOpen:
    return WhyOpen("no_number" if np.all(solution.converged) else "not_solved", {})


def _absent(place: Place) -> WhyOpen:
    reading = place.group.reading
    return WhyOpen("arguments_missing", {"reading": reading}) if reading else WhyOpen("not_called_for", {})


def _counted(values: NDArray, place: Place) -> NDArray:
    return np.abs(values) if place.over in SIZES else values


def _known(values: NDArray, place: Place) -> NDArray:
    """Whether there is a number of each case: balls that have none, as those without load, do not count beside
    others."""
    known = ~np.isnan(values)
    return known.any(axis=-1) if place.group.axis == BALL else known


def _worst(values: NDArray, beyond: NDArray, place: Place) -> tuple[int, ...] | None:
    """Where the number that decides stands; of a name that says which ball, such as `_max`, of the worst case."""
    marked = ~np.isnan(values)
    if place.group.axis == BALL and place.over:
        of_balls = values if place.over in (MAX, SIZE) else -values
        marked &= of_balls == np.fmax.reduce(of_balls, axis=-1, keepdims=True)
    numbers = np.flatnonzero(marked)
    if not numbers.size:
        return None
    worst = numbers[np.argmax(beyond.reshape(-1)[numbers])]
    return tuple(map(int, np.unravel_index(worst, values.shape)))


def _with_index(where: Worst, index: tuple[int, ...], solution: Any, place: Place, values: NDArray) -> Worst:
    is_per_ball = place.group.axis == BALL
    case = index[:-1] if is_per_ball else index
    if is_per_ball:
        row = solution.rows[place.row - 1] if place.row else solution
        azimuth = float(row.azimuth[index] / deg)
        where = where._replace(ball=index[-1], azimuth_deg=azimuth)
    of_cases = values.reshape(-1, values.shape[-1]) if is_per_ball else values.reshape(-1)
    if case and not np.array_equal(of_cases, np.broadcast_to(of_cases[:1], of_cases.shape), equal_nan=True):
        where = where._replace(point=int(np.ravel_multi_index(case, solution.shape)) + 1)
    return where


def ending(place: Place, sense: str, is_algebraic: bool = False) -> Place:
    """The place of the one number that a limit of this sense looks at, where its name states none: the largest or the
    smallest of all balls; by size, where the sign is a direction."""
    if place.over:
        return place
    by_size = place.result.is_signed and not is_algebraic
    over = {"<=": SIZE, ">=": LEAST_SIZE}[sense] if by_size else {"<=": MAX, ">=": MIN}[sense]
    return place._replace(over=over) if by_size or place.is_per_ball else place
