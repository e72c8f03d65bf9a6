"""What a study keeps of each point: results of the solution, and the readings that the scene asks for, by name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.require_table import SPARE, required_limits
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.groups import GROUPS, STEADY, unasked
from qsbearing.model.solution.result_keys import Group, Place, reduced
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.asked import READINGS, take_asked
from qsbearing.systems.heat.heat_groups import groups_of_heat
from qsbearing.systems.sets.set_groups import OF_ROWS, OF_SHAFT, SYSTEM, groups_of_set, of_bearing
from qsbearing.systems.sets.set_solution import SetSolution

OF_BEARING = of_bearing(GROUPS)
"""What a row has as any bearing has it."""


def known_results(solution: Solution | SetSolution) -> dict[str, Place]:
    """Every result that this solution has, by its name; of a set those first that most readers look for.

    Raises:
        SceneError: its scene or set requires what is no result.
    """
    required_limits(solution)
    every = _of_set(solution) if isinstance(solution, SetSolution) else _of_bearing(solution)
    return {each.name: each for each in chain(every, _there([SPARE], solution, {}))}


def _of_bearing(solution: Solution) -> Iterator[Place]:
    taken = _taken(solution)
    of_readings = chain.from_iterable(READINGS[name].groups for name in taken)
    return _there((*GROUPS, *groups_of_heat(solution.thermal), *of_readings), solution, taken)


def _there(groups: Iterable[Group], solution: Any, taken: Any) -> Iterator[Place]:
    """Results of which there are numbers."""
    for group in groups:
        if group.is_requested is None:
            yield from (Place(group, each) for each, values in group.values(solution, taken) if values is not None)
        elif group.is_requested(requested(solution)):
            yield from (Place(group, each) for each in group.results)


def _of_set(solution: SetSolution) -> list[Place]:
    """What is kept unasked before all else; of this axial loads, and the shaft's stiffness, before all others."""
    taken = [_taken(row) for row in solution.rows]
    of_rows: list[Place] = []
    of_readings: list[Place] = []
    for number, (row, own) in enumerate(zip(solution.rows, taken, strict=True), 1):
        every = [*_there(OF_ROWS, solution, own), *_there(OF_BEARING, row, own)]
        every += _there(chain.from_iterable(READINGS[name].groups for name in own), row, own)
        for each in every:
            one = each._replace(row=number)
            (of_readings if each.group.reading else of_rows).extend(one.overs if one.is_per_ball else [one])
    heat = [STEADY._replace(results=unasked(STEADY.results)), *groups_of_heat(solution.thermal)]
    of_whole = _there([*groups_of_set(solution.set), *heat], solution, taken)
    return sorted([*of_rows, *of_whole, *of_readings, *_there([SYSTEM], solution, taken)], key=_rank)


def _rank(place: Place) -> int:
    if not place.is_usual:
        return 3
    if place.row and place.result.name == "axial_load":
        return 0
    return 1 if place.group == OF_SHAFT[-1] else 2


def read(solution: Solution | SetSolution, places: Iterable[Place], taken: Any = None) -> dict[str, NDArray]:
    """The values of these results over the cases, and the balls of those that each ball has; by their names.

    Args:
        taken: the readings, where they are taken already; of a set those of each row.
    """
    read_once: dict[str, Any] = {}
    values: dict[str, NDArray] = {}
    for place in places:
        whole = place._replace(over="")
        if taken is None and place.group.reading:
            taken = _taken(solution) if isinstance(solution, Solution) else [_taken(row) for row in solution.rows]
        if whole.name not in read_once:
            numbers = whole.of(solution, taken)
            read_once[whole.name] = np.full(solution.shape, np.nan) if numbers is None else numbers
        numbers = read_once[whole.name]
        values[place.name] = reduced(place.over, numbers, whole.is_per_ball) if place.over else numbers
    return values


def _taken(solution: Solution) -> dict[str, Any]:
    return take_asked(solution) if solution.scene.readings else {}
