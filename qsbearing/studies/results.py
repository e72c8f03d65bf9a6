"""What a study keeps of each point: results of the solution, and the readings that the scene asks for, by name."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.groups import GROUPS, STEADY, unasked
from qsbearing.model.solution.result_keys import OVER, Group, Place, place_of, printed_unit, spelled
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import alike, question
from qsbearing.readings.asked import READINGS, every_group, take_asked
from qsbearing.systems.heat.heat_groups import groups_of_heat
from qsbearing.systems.sets.set_groups import OF_ROWS, OF_SHAFT, SYSTEM, groups_of_row, groups_of_set, of_bearing
from qsbearing.systems.sets.set_solution import SetSolution

Known = Mapping[str, Place]
"""Results by their names; of those that each ball has, in a row of a set those of all its balls."""


OF_BEARING = of_bearing(GROUPS)
"""What a row has as any bearing has it."""


def known_results(solution: Solution | SetSolution) -> dict[str, Place]:
    """Every result that this solution has, by its name; of a set those first that most readers look for."""
    if isinstance(solution, SetSolution):
        return {each.name: each for each in _of_set(solution)}
    return {each.name: each for each in _of_bearing(solution)}


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
    of_whole = _there([*groups_of_set(solution), *heat], solution, taken)
    return sorted([*of_rows, *of_whole, *of_readings, *_there([SYSTEM], solution, taken)], key=_rank)


def _rank(place: Place) -> int:
    if not place.is_usual:
        return 3
    if place.row and place.result.name == "axial_load":
        return 0
    return 1 if place.group == OF_SHAFT[-1] else 2


def find(name: str, known: Known) -> Place | None:
    """The result of a name, as `place_of` reads it; of one that each ball has also its maximum, minimum or, where its
    sign is a direction, its largest size. None: there is none."""
    groups: dict[int, Group] = {id(each.group): each.group for each in known.values() if not each.row}
    of_rows: dict[int, Group] = {id(each.group): each.group for each in known.values() if each.row}
    place = place_of(name, groups.values(), of_rows.values())
    if place is None:
        return None
    return place if place.name in known or place._replace(over="").name in known else None


def reading_of(name: str) -> str:
    """The reading that a result's name belongs to, spelled as for `find`; empty where it is none of a reading."""
    every = every_group()
    place = place_of(name, [*every, SYSTEM], groups_of_row(every))
    return "" if place is None else place.group.reading


def why_unknown(name: str, known: Known) -> tuple[str, str]:
    """What is wrong with a name that no result of a scene or set has, and what is likely meant."""
    plain = name.replace(".", "_")
    parts = plain.split("_")
    stems = (find("_".join(parts[:count]), known) for count in range(len(parts) - 1, 0, -1))
    stem = next((each for each in stems if each is not None), None)
    if stem is not None:
        return "is in another unit", f"It is in {printed_unit(stem.unit)}: write {stem.column}"
    of_row = next((each for each in known.values() if each.row and plain in _without_row(each)), None)
    if of_row is not None:
        return "is a result of each row", f"Such as {of_row.name}"
    place = place_of(plain, every_group())
    if place is not None and not place.group.reading:
        return "is not called for by this scene", "Name in [effects] the effect that it belongs to"
    if reading := reading_of(name):
        cause = f"Give in [readings.{reading}] what it is computed from; see `qsbearing guide readings`"
        return "is not called for by this scene", cause
    every = _usual_names(known)
    near = alike(plain, every)
    meant = [each for each in near if not any(each.startswith(f"{other}_") for other in near)]
    names = dict.fromkeys(each.name for each in every.values())
    there = f"There are {', '.join(names)}; with _max, _min or, where a sign is a direction, _size for all balls of one"
    return "is not a result", question(meant) or there


def _without_row(place: Place) -> tuple[str, str]:
    """A row's result as if it were a bearing's own; and without its raceway, as of either."""
    whole = place._replace(row=0)
    return spelled(whole), spelled(whole._replace(group=place.group._replace(raceway="")))


def _usual_names(known: Known) -> dict[str, Place]:
    """Results that are kept unasked, by their names and those of their columns."""
    usual = [one for each in known.values() if each.is_usual for one in (each, *each.overs)]
    return {name: each for each in usual for name in (each.column, each.name)}


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
        values[place.name] = OVER[place.over](numbers, axis=-1) if place.over else numbers
    return values


def _taken(solution: Solution) -> dict[str, Any]:
    return take_asked(solution) if solution.scene.readings else {}
