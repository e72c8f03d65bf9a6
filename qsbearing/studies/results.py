"""What a study keeps of each point: results of the solution, and the readings that the scene asks for, by name."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution import quantities
from qsbearing.model.solution.result_keys import attributes, split
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.asked import READINGS, all_values, by_short_name, take_asked
from qsbearing.readings.entry import Reading
from qsbearing.systems.sets.set_quantities import SetQuantity, set_quantities
from qsbearing.systems.sets.set_solution import SetSolution

OVER_BALLS = {"max": np.fmax.reduce, "min": np.fmin.reduce}
"""With these after its name, the largest or smallest over the balls of a result that each ball has."""


class Result(NamedTuple):
    """One result as plain data, which travels between processes."""

    name: str
    unit: str
    is_per_ball: bool
    column: str
    """Its name in a table, with the unit."""


def known_results(solution: Solution | SetSolution) -> dict[str, Result]:
    """Every result that this solution gives, by its name."""
    if isinstance(solution, SetSolution):
        return {each.name: Result(each.name, each.unit, False, each.column) for each in _of_set(solution).values()}
    found = {}
    for quantity in quantities.ALL.values():
        if quantity.read(solution) is not None:
            found[quantity.name] = Result(quantity.name, quantity.unit, quantity.is_per_ball, quantity.column)
    for column, (is_per_ball, _) in _readings(solution).items():
        name, unit = split(column)
        found[name] = Result(name, unit, is_per_ball, column)
    return found


def find(name: str, known: dict[str, Result]) -> Result | None:
    """The result of a name, `_max` and `_min` understood, a reading's with or without the reading's; None: none."""
    if name in known:
        return known[name]
    stem, _, ending = name.rpartition("_")
    if ending in OVER_BALLS:
        of_ball = find(stem, known)
        if of_ball is not None and of_ball.is_per_ball:
            full = f"{of_ball.name}_{ending}"
            return Result(full, of_ball.unit, False, of_ball.column.replace(of_ball.name, full, 1))
    meant = by_short_name(name, known)
    return None if meant is None else known[meant]


def reading_of(name: str) -> str | None:
    """The reading that a result's name belongs to, `_max` and `_min` understood; None where it is none of a reading."""
    full = _of_readings()
    stem, _, ending = name.rpartition("_")
    for each in (name, stem) if ending in OVER_BALLS else (name,):
        meant = each if each in full else by_short_name(each, full)
        if meant is not None:
            return full[meant][0]
    return None


def _of_readings() -> dict[str, tuple[str, dict[str, str]]]:
    """Of each result that a reading gives, the reading and what datasets say of the result."""
    return _of_entries(tuple(READINGS.items()))


@lru_cache(maxsize=1)  # asked for each result of a dataset
def _of_entries(entries: tuple[tuple[str, Reading], ...]) -> dict[str, tuple[str, dict[str, str]]]:
    found = {}
    for reading, entry in entries:
        for side, shown, _ in entry.shown() if entry.table is not None else ():  # a spectrum is asked for by its points
            name, unit = split(entry.column(side, shown))
            words = ", ".join(filter(None, (shown.plain_name, side)))
            found[name] = reading, attributes(unit, words, shown.symbol, entry.by)
    return found


def attributes_of(result: Result) -> dict[str, str]:
    """What a dataset says of a result: unit, words, symbol and source."""
    of_readings = _of_readings()
    name, words = result.name, ""
    stem, _, ending = name.rpartition("_")
    if name not in quantities.ALL and name not in of_readings and ending in OVER_BALLS:
        name, words = stem, f", {'largest' if ending == 'max' else 'smallest'}"
    if name in of_readings:
        found = of_readings[name][1]
    elif name in quantities.ALL:
        found = quantities.ALL[name].attributes
    else:
        found = attributes(result.unit, name.replace("_", " "), "", "")
    return found | {"long_name": found["long_name"] + words}


def suggestion(name: str, known: Mapping[str, Result], has_units: bool = False) -> str:
    """What is likely meant by a name that no result has.

    Args:
        has_units: whether a name may have its unit behind it; where not, the one without is meant.
    """
    names = {each: each for each in known}
    names |= {full: full for each in known for full in (f"{each}_{ending}" for ending in OVER_BALLS)}
    names |= {each.column: each.column if has_units else each.name for each in known.values()}
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    if near:
        return f"Did you mean {names[near[0]]}?"
    return f"There are {', '.join(known)}; with _max or _min for all balls of one"


def _of_set(solution: SetSolution) -> dict[str, SetQuantity]:
    """Results of shaft and rows, and the readings of each row that are the bearing's own."""
    found = set_quantities(solution)
    for number, row in enumerate(solution.rows, 1):
        for column, (is_per_ball, values) in _readings(row).items():
            if not is_per_ball:
                name, unit = split(f"row_{number}_{column}")
                found[name] = SetQuantity(name, unit, f"row_{number}_{column}", lambda values=values: values)  # type: ignore[misc]
    return found


def read(solution: Solution | SetSolution, results: Iterable[Result]) -> dict[str, NDArray]:
    """The values of these results over the cases, and the balls of those that each ball has."""
    if isinstance(solution, SetSolution):
        quantities_of_set = _of_set(solution)
        return {result.name: quantities_of_set[result.name].read() for result in results}
    readings: dict[str, tuple[bool, NDArray]] | None = None
    found: dict[str, Any] = {}
    kept: dict[str, Any] = {}  # what is read once and shown as largest and smallest
    for result in results:
        name, ending = result.name, ""
        if name not in quantities.ALL and name.rpartition("_")[2] in OVER_BALLS:
            name, _, ending = name.rpartition("_")
        if name not in kept:
            if name in quantities.ALL:
                kept[name] = quantities.ALL[name].read(solution)
            else:
                readings = readings or {split(key)[0]: value for key, value in _readings(solution).items()}
                kept[name] = readings[name][1]
        found[result.name] = OVER_BALLS[ending](kept[name], axis=-1) if ending else kept[name]
    return found


def _readings(solution: Solution) -> dict[str, tuple[bool, NDArray]]:
    """Numbers of the readings that the scene asks for, by column: whether each ball has its own, and the values."""
    taken = take_asked(solution) if solution.scene.readings else {}
    return {column: (is_per_ball, values) for column, is_per_ball, values in all_values(solution, taken)}
