"""What a study keeps of each point: results of the solution, and the readings that the scene asks for, by name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution import quantities
from qsbearing.model.solution.result_keys import attributes, printed_unit, split
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import alike, question
from qsbearing.readings.asked import BEFORE, READINGS, all_values, by_short_name, named, take_asked
from qsbearing.readings.entry import Reading
from qsbearing.systems.sets.set_quantities import SetQuantity, set_quantities
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.system_life import system_life

LIVES = ("life_basic_duration_h", "life_duration_h")
"""Of which a set has one for all rows together."""


def _size(values: NDArray, axis: int) -> NDArray:
    return np.asarray(np.fmax.reduce(np.abs(values), axis=axis))


SIZE = "size"
OVER_BALLS: dict[str, Callable[..., Any]] = {"max": np.fmax.reduce, "min": np.fmin.reduce, SIZE: _size}
"""With these after its name, the maximum or minimum over the balls of a result that each ball has; of one whose sign is
a direction also the largest size."""
SAID = {"max": "maximum", "min": "minimum", SIZE: "largest size"}


class Result(NamedTuple):
    """One result as plain data, which travels between processes."""

    name: str
    unit: str
    is_per_ball: bool
    column: str
    """Its name in a table, with the unit."""
    is_signed: bool = False
    """Whether its sign is a direction."""

    @property
    def endings(self) -> tuple[str, ...]:
        """What may follow its name, for one number of all balls."""
        return tuple(end for end in OVER_BALLS if self.is_per_ball and (self.is_signed or end != SIZE))


def known_results(solution: Solution | SetSolution) -> dict[str, Result]:
    """Every result that this solution gives, by its name."""
    if isinstance(solution, SetSolution):
        return {each.name: Result(each.name, each.unit, False, each.column) for each in _of_set(solution).values()}
    found = {}
    for quantity in quantities.ALL.values():
        if quantity.read(solution) is not None:
            own = quantity.unit, quantity.is_per_ball, quantity.column, quantity.is_signed
            found[quantity.name] = Result(quantity.name, *own)
    for column, (is_per_ball, _) in _readings(solution).items():
        name, unit = split(column)
        found[name] = Result(name, unit, is_per_ball, column, name in of_readings() and of_readings()[name].is_signed)
    return found


def _by_every_name(known: Mapping[str, Result]) -> dict[str, Result]:
    """Results by their names and by those of their columns, the largest and smallest of all balls among them."""
    found: dict[str, Result] = {}
    for each in known.values():
        found |= {each.column: each, each.name: each}
        for full in (f"{each.name}_{ending}" for ending in each.endings):
            one = Result(full, each.unit, False, each.column.replace(each.name, full, 1))
            found |= {one.column: one, one.name: one}
    return found


def find(name: str, known: Mapping[str, Result]) -> Result | None:
    """The result of a name: with or without its unit, the reading's name, and the words ring, shaft or system before
    it; with points as in `life.duration_h`; the endings of `OVER_BALLS` understood. None: there is none."""
    every = _by_every_name(known)
    meant = named(name, every)
    return None if meant is None else every[meant]


def reading_of(name: str) -> str | None:
    """The reading that a result's name belongs to, spelled as for `find`; None where it is none of a reading."""
    full, plain = of_readings(), re.sub(r"^(row_\d+|system)_", "", name.replace(".", "_"))
    for each in (plain, split(plain)[0]):
        for stem in (each, stem_of(each)[0]):
            meant = stem if stem in full else by_short_name(stem, full)
            if meant is not None:
                return full[meant].reading
    return None


class OfReading(NamedTuple):
    """A result that a reading may give."""

    reading: str
    attributes: dict[str, str]
    """What a dataset says of it."""
    is_signed: bool


def stem_of(name: str) -> tuple[str, str]:
    """A name without what makes one number of all balls, and that; a result whose own name ends so has none."""
    stem, _, ending = name.rpartition("_")
    is_own = name in quantities.ALL or name in of_readings() or ending not in OVER_BALLS
    return (name, "") if is_own else (stem, ending)


def of_readings() -> dict[str, OfReading]:
    """Each result that a reading may give."""
    return _of_entries(tuple(READINGS.items()))


def why_unknown(name: str, known: Mapping[str, Result]) -> tuple[str, str]:
    """What is wrong with a name that no result of a scene or set has, and what is likely meant."""
    every, plain = _by_every_name(known), name.replace(".", "_")
    stem = max((each for each in every if any((b + plain).startswith(f"{each}_") for b in BEFORE)), key=len, default="")
    if stem:
        return "is in another unit", f"It is in {printed_unit(every[stem].unit)}: write {every[stem].column}"
    of_rows = [each for each in every if re.fullmatch(rf"row_\d+_(inner_|outer_)?{re.escape(plain)}", each)]
    if of_rows:
        return "is a result of each row", f"Such as {of_rows[0]}"
    if stem_of(plain)[0] in quantities.ALL:
        return "is not called for by this scene", "Name in [effects] the effect that it belongs to"
    if reading := reading_of(name):
        cause = f"Give in [readings.{reading}] what it is computed from; see `qsbearing guide readings`"
        return "is not called for by this scene", cause
    names = dict.fromkeys(each.name for each in every.values())
    found = alike(plain, every)
    meant = [each for each in found if not any(each.startswith(f"{other}_") for other in found)]
    there = f"There are {', '.join(names)}; with _max, _min or, where a sign is a direction, _size for all balls of one"
    return "is not a result", question(meant) or there


@lru_cache(maxsize=1)  # asked for each result of a dataset
def _of_entries(entries: tuple[tuple[str, Reading], ...]) -> dict[str, OfReading]:
    found = {}
    for reading, entry in entries:
        for side, shown, _ in entry.shown() if entry.table is not None else ():  # a spectrum is asked for by its points
            name, unit = split(entry.column(side, shown))
            words = ", ".join(filter(None, (shown.plain_name, side)))
            found[name] = OfReading(reading, attributes(unit, words, shown.symbol, entry.by), shown.is_signed)
    return found


def attributes_of(result: Result) -> dict[str, str]:
    """What a dataset says of a result: unit, words, symbol and source."""
    known = of_readings()
    name, ending = stem_of(result.name)
    words = f", {SAID[ending]}" if ending else ""
    if name in known:
        found = known[name].attributes
    elif name in quantities.ALL:
        found = quantities.ALL[name].attributes
    else:
        found = attributes(result.unit, name.replace("_", " "), "", "")  # of a set: its rows' among them
    return found | {"long_name": found["long_name"] + words}


def is_of_solution(name: str) -> bool:
    """Whether a result of a bearing is read off its solution itself, not by a reading."""
    return stem_of(name)[0] in quantities.ALL


def _of_set(solution: SetSolution, readings: Any = None) -> dict[str, SetQuantity]:
    """Results of shaft and rows, the readings of each row that are the bearing's own, and the life of all rows."""
    found = set_quantities(solution)
    columns: dict[str, NDArray] = {}
    given = readings or [None] * len(solution.rows)
    of_rows = [_readings(row, own) for row, own in zip(solution.rows, given, strict=True)]
    for number, own in enumerate(of_rows, 1):
        columns |= {f"row_{number}_{name}": values for name, (is_per_ball, values) in own.items() if not is_per_ball}
    for name in LIVES:
        if all(name in own for own in of_rows):
            columns[f"system_{name}"] = system_life([own[name][1] for own in of_rows])
    for column, values in columns.items():
        name, unit = split(column)
        found[name] = SetQuantity(name, unit, column, lambda values=values: values)  # type: ignore[misc]
    return found


def read(solution: Solution | SetSolution, results: Iterable[Result], taken: Any = None) -> dict[str, NDArray]:
    """The values of these results over the cases, and the balls of those that each ball has.

    Args:
        taken: the readings, where they are taken already; of a set those of each row.
    """
    if isinstance(solution, SetSolution):
        quantities_of_set = _of_set(solution, taken)
        return {result.name: quantities_of_set[result.name].read() for result in results}
    readings: dict[str, tuple[bool, NDArray]] | None = None
    found: dict[str, Any] = {}
    kept: dict[str, Any] = {}  # what is read once and shown as maximum and minimum
    for result in results:
        name, ending = stem_of(result.name)
        if name not in kept:
            if name in quantities.ALL:
                kept[name] = quantities.ALL[name].read(solution)
            else:
                readings = readings or {split(key)[0]: value for key, value in _readings(solution, taken).items()}
                kept[name] = readings[name][1]
        found[result.name] = OVER_BALLS[ending](kept[name], axis=-1) if ending else kept[name]
    return found


def _readings(solution: Solution, taken: Any = None) -> dict[str, tuple[bool, NDArray]]:
    """Numbers of the readings that the scene asks for, by column: whether each ball has its own, and the values."""
    if taken is None:
        taken = take_asked(solution) if solution.scene.readings else {}
    return {column: (is_per_ball, values) for column, is_per_ball, values in all_values(solution, taken)}
