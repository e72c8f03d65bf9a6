"""The readings that a scene asks for by name, each with its arguments: checked before the solve, taken after it.

`Scene.readings` holds plain numbers (SI) under each reading's name, as the [readings] table of a scene file gives them;
"lubricant" is no reading but the oil that film and life share.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from inspect import signature
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.groups import GROUPS
from qsbearing.model.solution.result_keys import Group, Place
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import ErrorDetail, SceneError, check_kind
from qsbearing.readings import (
    ball_advance,
    ball_motion,
    ball_slip,
    contact_friction,
    film_thickness,
    friction_estimate,
    load_spectrum,
    lubricant,
    pass_frequencies,
    pivot_points,
    rating_life,
    shoulder_overrun,
    static_rating,
    subsurface_stress,
)
from qsbearing.readings.entry import Reading, ReadingTable
from qsbearing.readings.lubricant import FREEZING, OIL_DENSITY, VISCOSITY_INDEX, OilState, oil_of

Arguments = Mapping[str, Any]
Errors = list[ErrorDetail]
LUBRICANT = "lubricant"
NEEDS_OIL = "Give [readings.lubricant], such as iso_viscosity_grade = 68 and oil_temperature_C = 70"
ANY_OIL = OilState(0.02, 2e-8, 2e-5)
"""Where the oil is wrong or missing: what else is wrong shall be said as well."""

_FILES = (
    rating_life,
    load_spectrum,
    static_rating,
    ball_motion,
    ball_advance,
    pass_frequencies,
    film_thickness,
    contact_friction,
    ball_slip,
    pivot_points,
    friction_estimate,
    shoulder_overrun,
    subsurface_stress,
)
READINGS: dict[str, Reading] = {file.ENTRY.name: file.ENTRY for file in _FILES}
"""Every reading, in the order in which they are taken and shown."""


def tables() -> dict[str, ReadingTable]:
    """What a file may have within [readings]: each reading, and before film the lubricant."""
    in_file: dict[str, ReadingTable] = {}
    for name, each in READINGS.items():
        if name == film_thickness.ENTRY.name:
            in_file[LUBRICANT] = lubricant.TABLE
        if each.in_file is not None:
            in_file[name] = each.in_file
    return in_file


def name_errors(readings: Iterable[str]) -> Errors:
    """Names that no reading has."""
    cause = f"One of {', '.join(READINGS)}"
    unknown = (name for name in readings if name not in (LUBRICANT, *READINGS))
    return [ErrorDetail(f"readings.{name}", "is not a reading", cause=cause) for name in unknown]


def requested_errors(
    readings: Mapping[str, Arguments], scene: Scene | None = None, oil_is_found: bool = False
) -> Errors:
    """Everything that is wrong with what is asked for; fields begin with `readings.` and the reading's name.

    Args:
        scene: None where there is none yet: then what depends on it is not judged.
        oil_is_found: whether a heat balance will find the oil's temperature.
    """
    oil, errors = _oil(readings, oil_is_found)
    errors += name_errors(readings)
    for name, arguments in readings.items():
        if name not in READINGS:
            continue
        entry = READINGS[name]
        if entry.needs_oil and LUBRICANT not in readings:
            errors.append(ErrorDetail(f"readings.{name}", "needs an oil", cause=NEEDS_OIL))
        given = entry.arguments(arguments, oil or ANY_OIL if LUBRICANT in readings or entry.needs_oil else None)
        own_errors = given.errors(None if scene is None else scene.bearing)
        errors += [replace(each, field=f"readings.{name}.{each.field}") for each in own_errors]
    return errors


def take_asked(solution: Solution) -> dict[str, Any]:
    """Every reading that the solution's scene asks for, by its name.

    Returns:
        By the name of the reading, what it gives.

    Raises:
        SceneError: arguments that are out of range; everything, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(qs.readings.take_asked(solution))
        {}
    """
    check_kind("take_asked", solution, "Solution")
    requested = solution.scene.readings
    errors = requested_errors(requested, solution.scene)
    if errors:
        raise SceneError(errors)
    oil, _ = _oil(requested)
    entries = [each for name, each in READINGS.items() if name in requested]
    needs = [each.needs for each in entries]
    solution.read_at_once(*(dict.fromkeys(chain.from_iterable(each)) for each in zip(*needs, strict=True)))
    taken: dict[str, Any] = {}
    for each in entries:
        taken[each.name] = each.take(solution, each.arguments(requested[each.name], oil), taken)
    return taken


def arguments_of(solution: Solution, name: str) -> Any:
    """What a reading that the solution's scene asks for is taken from: its record, with the oil where it has one."""
    requested = solution.scene.readings
    return READINGS[name].arguments(requested[name], _oil(requested)[0])


def with_defaults(name: str, given: Arguments) -> dict[str, Any]:
    """The arguments of a reading or of the oil, and what counts for those that were left out; nothing for what is then
    derived, or not computed."""
    if name == LUBRICANT:
        usual: dict[str, Any] = {"oil_density": OIL_DENSITY}
        usual |= {"viscosity_index": VISCOSITY_INDEX} if "iso_viscosity_grade" in given else {}
    else:
        parameters = signature(READINGS[name].record).parameters.values()
        usual = {each.name: each.default for each in parameters if each.default is not each.empty}
    return {field: value for field, value in (usual | dict(given)).items() if value is not None}


def _oil(readings: Mapping[str, Arguments], is_found: bool = False) -> tuple[OilState | None, Errors]:
    """The oil at its temperature, if there is one, and what is wrong with it; at any where that is yet to be found."""
    if LUBRICANT not in readings:
        return None, []
    later = {"oil_temperature": FREEZING + 40.0} if is_found else {}  # to judge the rest by
    oil, errors = oil_of(later | dict(readings[LUBRICANT]))
    return oil, [replace(each, field=f"readings.{LUBRICANT}.{each.field}") for each in errors]


def every_group() -> list[Group]:
    """Of all results of a bearing: its own, and those of every reading that a file may ask for."""
    return [*GROUPS, *chain.from_iterable(each.groups for each in READINGS.values() if each.table is not None)]


def all_values(solution: Solution, readings: Mapping[str, Any]) -> Iterator[tuple[Place, NDArray]]:
    """What the readings have; shape (*cases) or (*cases, ball)."""
    for name, result in readings.items():
        for place, values in READINGS[name].values(result):
            if values is not None:
                shape = solution.azimuth.shape if place.is_per_ball else solution.shape
                yield place, np.broadcast_to(values, shape)


def reading_columns(solution: Solution, readings: Mapping[str, Any]) -> dict[str, NDArray]:
    """More columns for `Solution.to_dataframe`: readings, one row per ball of every case, units in the names.

    Args:
        readings: results by the name of their reading, as `take_asked` gives them.

    Returns:
        Columns by their names, each with a value for a ball of a case.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> columns = qs.readings.reading_columns(solution, {"life": qs.readings.life(solution)})
        >>> print(len(columns) > 0)
        True
    """
    check_kind("reading_columns", solution, "Solution")
    exists = np.isfinite(solution.azimuth)
    return {
        place.column: (values if place.is_per_ball else np.broadcast_to(values[..., None], exists.shape))[exists]
        for place, values in all_values(solution, readings)
    }
