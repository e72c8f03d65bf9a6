"""The table [require] of a scene or set: which results are meant, and which readings they ask for.

[require]
"life.basic_duration_h" = ">= 20000"
inner.max_pressure_MPa = {most = 1700, source = "house rule 12"}
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, translate
from qsbearing.files.file_keys import REQUIRE
from qsbearing.files.result_names import AZIMUTH, places_of, why_unknown
from qsbearing.files.table_checks import Errors
from qsbearing.model.scene.requirement import Requirement, requirements_of
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.changes import requested
from qsbearing.model.solution.groups import STEADY
from qsbearing.model.solution.limit import Limit, ending, spare
from qsbearing.model.solution.result_keys import Group, Path, Place, Result, printed_unit, value_at
from qsbearing.readings.asked import every_group, take_asked
from qsbearing.systems.heat.heat_groups import groups_of_heat, names_of
from qsbearing.systems.heat.state import ThermalState
from qsbearing.systems.sets.set_groups import (
    OF_SHAFT,
    PLAY,
    SLIDE,
    SYSTEM,
    OfAllRows,
    groups_of_row,
    groups_of_set,
)


class PossibleResults(NamedTuple):
    """What a scene or set may have of results."""

    groups: list[Group]
    of_rows: list[Group]
    rows: int
    is_all: bool
    """Whether there is nothing else, which only the whole scene or set tells."""

    def places(self, name: str) -> tuple[Place, ...]:
        """What a name means."""
        places = places_of(name, self.groups, self.of_rows, self.rows)
        return tuple(each for each in places if each.row <= self.rows)

    @property
    def by_name(self) -> dict[str, Place]:
        """All of them, those of rows as of the first."""
        every = [Place(group, each) for group in self.groups for each in group.results]
        every += [Place(group, each, 1) for group in self.of_rows for each in group.results]
        return {each.name: each for each in every}


def _known(of_shaft: Iterable[Group] | None, heat: Iterable[Group], rows: int, is_all: bool) -> PossibleResults:
    if of_shaft is None:
        return PossibleResults([*every_group(), *heat], [], 0, is_all)
    return PossibleResults([*of_shaft, STEADY, *heat, SYSTEM], groups_of_row(every_group()), rows, is_all)


def known_in(document: Mapping[str, Any]) -> PossibleResults:
    """Of the file of a scene or set."""
    rows, is_all = document.get("rows"), "thermal" not in document and "shaft" not in document
    return _known([*OF_SHAFT, SLIDE, PLAY] if isinstance(rows, list) else None, (), len(rows or ()), is_all)


def known_of(of: Any, heat: ThermalState | None = None) -> PossibleResults:
    """Of a scene or set: all that there is.

    Args:
        heat: what was found of it, where the scene or set is that of its solution, which asks for none.
    """
    rows = () if isinstance(of, Scene) else of.rows
    readings = [of.readings if row.readings is None else row.readings for row in rows] or [of.readings]
    of_heat = groups_of_heat(heat or names_of(of.thermal, readings))
    return _known(groups_of_set(of) if rows else None, of_heat, len(rows), True)


def limits_named(
    required: Iterable[Requirement], known: PossibleResults, path: str = REQUIRE
) -> tuple[list[Limit], Errors]:
    """The limits that are meant, and everything that is wrong with their names."""
    required = list(required)
    limits: list[Limit] = []
    errors: dict[str, FileErrorDetail] = {}
    negative = {each.name for each in required if each.value < 0.0}
    for each in required:
        places = known.places(each.name)
        if problem := _problem(each.name, places, known):
            errors[each.name] = FileErrorDetail(f"{REQUIRE}.{each.name}", problem[0], cause=problem[1])
        elif places:
            ends = tuple(ending(place, each.sense, each.name in negative) for place in places)
            limits.append(Limit(ends, each.sense, each.value, each.source, name=each.name))
    return limits, list(errors.values())


def _problem(name: str, places: tuple[Place, ...], known: PossibleResults) -> tuple[str, str] | None:
    if any(place.result.is_azimuth for place in places):
        return AZIMUTH, "Limit a load or an angle there"
    if places or not known.is_all:
        return None
    parts = name.replace(".", "_").split("_")
    for count in range(len(parts) - 1, 0, -1):
        if stem := known.places("_".join(parts[:count])):
            return "is in another unit", f"It is in {printed_unit(stem[0].unit) or 'no unit'}"
    return why_unknown(name, known.by_name, is_listed=False)


def required_limits(solution: Any) -> list[Limit]:
    """The limits that the scene or set of a solution states.

    Raises:
        SceneFileError: names that no result has.
    """
    of = requested(solution)
    limits, errors = limits_named(of.require, known_of(of, solution.thermal)) if of.require else ([], [])
    if errors:
        raise SceneFileError(REQUIRE, errors)
    if "spectrum" not in of.readings:
        return limits
    shares = np.asarray(of.readings["spectrum"]["time_share"], float)
    return [each._replace(places=tuple(_under(shares, place) for place in each.places)) for each in limits]


def _least_spare(solution: Any) -> NDArray:
    limits = required_limits(solution)
    has_readings = any(place.group.reading for each in limits for place in each.places)
    rows = getattr(solution, "rows", None)
    readings: Any = None
    if has_readings:
        readings = take_asked(solution) if rows is None else [take_asked(row) for row in rows]
    return spare(solution, limits, readings)


SPARE = Group(
    (Result("requirements_margin", words="least part of a required limit that is to spare", path=_least_spare),),
    is_requested=attrgetter("require"), by_words=True,
)  # fmt: skip
"""Of a scene or set that requires something, as a result of its own: negative where a requirement is not met, NaN where
one is open."""


class UnderSpectrum(NamedTuple):
    """A life of all operating points together, from that of each."""

    of_points: Path
    shares: NDArray
    """Of the time."""
    is_in_turns: bool

    def __call__(self, life: Any) -> NDArray:
        """In the unit of those."""
        lives = np.asarray(value_at(self.of_points, life), float)
        shares = self.shares * np.abs(life.speed) if self.is_in_turns else self.shares
        with np.errstate(divide="ignore"):
            return np.asarray(np.sum(shares) / np.sum(shares / lives))


def _under(shares: NDArray, place: Place) -> Place:
    """Of a life that under the whole spectrum; other results hold at every point."""
    if place.group.reading != "life" or place.unit not in ("h", "Mrev"):
        return place
    of_points = place.result.name if place.result.path is None else place.result.path
    if isinstance(of_points, OfAllRows):
        path: Path = OfAllRows(UnderSpectrum(of_points.duration, shares, False))
    else:
        path = UnderSpectrum(of_points, shares, place.unit == "Mrev")
    return place._replace(result=place.result._replace(path=path))


def required_in(document: Mapping[str, Any], errors: Errors) -> tuple[Requirement, ...]:
    """What the table of a file requires, with all that is wrong with it, as far as the file tells."""
    required, wrong = requirements_of(document[REQUIRE])
    errors += [*map(translate, wrong), *limits_named(required, known_in(document))[1]]
    return required


def name_errors(of: Any) -> Errors:
    """What is wrong with the names that a scene or set requires."""
    return limits_named(of.require, known_of(of))[1]


def readings_of(document: Mapping[str, Any], required: Iterable[Requirement]) -> tuple[str, ...]:
    """The readings of which a number is required."""
    known = known_in({"rows": document["rows"]} if "rows" in document else {})
    names = (place.group.reading for each in required for place in known.places(each.name)[:1])
    return tuple(name for name in dict.fromkeys(names) if name)
