"""Results by the names that people write, and what is likely meant by a name that no result has."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from qsbearing.model.solution.groups import SIDES
from qsbearing.model.solution.result_keys import Group, Place, place_of, printed_unit, spelled
from qsbearing.model.validation import alike, question
from qsbearing.readings.asked import every_group
from qsbearing.systems.sets.set_groups import SYSTEM, groups_of_row

AZIMUTH = "is a place around the bearing, of which none is more than another"
"""What is wrong with a limit of one."""
Known = Mapping[str, Place]
"""Results by their names; of those that each ball has, in a row of a set those of all its balls."""


def find(name: str, known: Known) -> Place | None:
    """The result of a name, as `place_of` reads it; of one that each ball has also its maximum, minimum or, where its
    sign is a direction, its largest size. None: there is none."""
    groups: dict[int, Group] = {id(each.group): each.group for each in known.values() if not each.row}
    of_rows: dict[int, Group] = {id(each.group): each.group for each in known.values() if each.row}
    place = place_of(name, groups.values(), of_rows.values())
    if place is None:
        return None
    return place if place.name in known or place._replace(over="").name in known else None


def places_of(name: str, groups: Sequence[Group], of_rows: Sequence[Group] = (), rows: int = 0) -> tuple[Place, ...]:
    """All that a name means: of either raceway and of each row, where it leaves them out; none where it means nothing.

    Args:
        groups, of_rows: as for `place_of`.
        rows: how many a set has.
    """
    if whole := _of_raceways(name, groups, of_rows):
        return whole
    every = [_of_raceways(f"row_{row}_{name}", groups, of_rows) for row in range(1, rows + 1)]
    return tuple(place for places in every for place in places)


def _of_raceways(name: str, groups: Sequence[Group], of_rows: Sequence[Group]) -> tuple[Place, ...]:
    place = place_of(name, groups, of_rows)
    if place is not None:
        return (place,)
    sides = [[[each for each in of if each.raceway == side] for of in (groups, of_rows)] for side in SIDES]
    return tuple(each for side in sides if (each := _of_raceway(name, *side)) is not None)


def _of_raceway(name: str, groups: Iterable[Group], of_rows: Iterable[Group]) -> Place | None:
    """Of one raceway, which the name does not state."""
    without = {each._replace(raceway=""): each for each in (*groups, *of_rows)}
    place = place_of(name, *([each._replace(raceway="") for each in of] for of in (groups, of_rows)))
    return None if place is None else place._replace(group=without[place.group])


def find_all(name: str, known: Known) -> tuple[Place, ...]:
    """Likewise of either raceway and of each row, where the name leaves them out."""
    groups = list({id(each.group): each.group for each in known.values() if not each.row}.values())
    of_rows = list({id(each.group): each.group for each in known.values() if each.row}.values())
    rows = max((each.row for each in known.values()), default=0)
    places = places_of(name, groups, of_rows, rows)
    return tuple(each for each in places if {each.name, each._replace(over="").name, *_over(each)} & known.keys())


def _over(place: Place) -> tuple[str, ...]:
    """Names of all that one number of all balls is known by."""
    return tuple(each.name for each in place._replace(over="").overs)


def reading_of(name: str) -> str:
    """The reading that a result's name belongs to, spelled as for `find`; empty where it is none of a reading."""
    every = every_group()
    places = places_of(name, [*every, SYSTEM], groups_of_row(every))
    return places[0].group.reading if places else ""


def why_unknown(name: str, known: Known, is_listed: bool = True) -> tuple[str, str]:
    """What is wrong with a name that no result of a scene or set has, and what is likely meant.

    Args:
        is_listed: whether all names are told where none is near.
    """
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
    near = alike(plain, every if is_listed else [*every, *known])
    meant = [each for each in near if not any(each.startswith(f"{other}_") for other in near)]
    if not is_listed:
        meant = meant or _sharing(plain, dict.fromkeys(_without_row(each)[1] for each in known.values()))
        return "is not a result", question(meant) or "`qsbearing guide readings` and `qsbearing run --json` show names"
    names = dict.fromkeys(each.name for each in every.values())
    there = f"There are {', '.join(names)}; with _max, _min or, where a sign is a direction, _size for all balls of one"
    return "is not a result", question(meant) or there


MOST_SHARING = 3
"""Names that are told which share words with another."""


def _sharing(name: str, known: Iterable[str]) -> list[str]:
    """Those that have most words of a name, with the fewest others; none where they have none."""
    words = {*name.lower().split("_")}
    shared = {each: len(words & {*each.lower().split("_")}) for each in known}
    most = max(shared.values(), default=0)
    best = [each for each, count in shared.items() if count == most > 0]
    return sorted(best, key=lambda each: each.count("_"))[:MOST_SHARING]


def _without_row(place: Place) -> tuple[str, str]:
    """A row's result as if it were a bearing's own; and without its raceway, as of either."""
    whole = place._replace(row=0)
    return spelled(whole), spelled(whole._replace(group=place.group._replace(raceway="")))


def _usual_names(known: Known) -> dict[str, Place]:
    """Results that are kept unasked, by their names and those of their columns."""
    usual = [one for each in known.values() if each.is_usual for one in (each, *each.overs)]
    return {name: each for each in usual for name in (each.column, each.name)}
