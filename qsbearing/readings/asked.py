"""The readings that a scene asks for by name, each with its arguments: checked before the solve, taken after it.

`Scene.readings` holds plain numbers (SI) under each reading's name, as the [readings] table of a scene file gives them;
"lubricant" is no reading but the oil that film and life share.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from inspect import signature
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from qsbearing.readings import (
    ball_motion,
    contact_friction,
    film_thickness,
    pass_frequencies,
    rating_life,
    shoulder_overrun,
    subsurface_stress,
)
from qsbearing.readings.ball_motion import kinematics, ring_speeds
from qsbearing.readings.cleanliness import Cleanliness, contamination_factor
from qsbearing.readings.contact_friction import friction, friction_errors
from qsbearing.readings.film_thickness import film, film_errors
from qsbearing.readings.friction_estimate import FrictionEstimates, estimate_errors, friction_estimates
from qsbearing.readings.life_arguments import life_errors
from qsbearing.readings.life_factors import viscosity_ratio
from qsbearing.readings.load_spectrum import SpectrumLife, spectrum_errors, spectrum_life
from qsbearing.readings.lubricant import FREEZING, Lubricant, OilState
from qsbearing.readings.pass_frequencies import frequencies
from qsbearing.readings.pivot_points import pivot_points
from qsbearing.readings.rating_life import Life, life
from qsbearing.readings.shoulder_overrun import overrun, overrun_errors
from qsbearing.readings.static_rating import static_safety, static_safety_errors
from qsbearing.readings.subsurface_stress import stress
from qsbearing.scene.bearing import BearingKind
from qsbearing.scene.scene import Scene
from qsbearing.solution import Solution
from qsbearing.validation import ErrorDetail, SceneError, choose

Arguments = Mapping[str, Any]
Errors = list[ErrorDetail]
LUBRICANT = "lubricant"
NEEDS_OIL = "Give [readings.lubricant], such as iso_viscosity_grade = 68 and oil_temperature_C = 70"


class Reading(NamedTuple):
    """How a reading is checked and taken."""

    errors: Callable[[Scene | None, Arguments, OilState | None], Errors]
    take: Callable[[Solution, Arguments, OilState | None], Any]
    needs: tuple[tuple[str, ...], tuple[str, ...]] = (), ()
    """Arrays of contacts and of balls that it takes from the solution."""


def _no_errors(scene: Scene | None, arguments: Arguments, oil: OilState | None) -> Errors:
    return []


def _life_errors(scene: Scene | None, arguments: Arguments, oil: OilState | None) -> Errors:
    plain, errors = dict(arguments), []
    if "cleanliness" in plain:
        errors += choose("cleanliness", plain.pop("cleanliness"), Cleanliness)[1]
        if "contamination_factor" in plain:
            cause = "Keep one: the class gives the factor"
            errors.append(ErrorDetail("cleanliness", "is given beside contamination_factor", cause=cause))
        plain.setdefault("contamination_factor", 1.0)
    if "contamination_factor" in plain and "viscosity_ratio" not in plain and oil is not None:
        plain["viscosity_ratio"] = 1.0  # stands for the one that follows from the oil and the speed
    return errors + life_errors(**plain)


def _life(solution: Solution, arguments: Arguments, oil: OilState | None) -> Life:
    plain = dict(arguments)
    pitch = np.asarray(solution.scene.bearing.pitch_diameter, float)
    kind = plain.pop("cleanliness", None)
    is_modified = kind is not None or "contamination_factor" in plain
    if is_modified and "viscosity_ratio" not in plain and oil is not None and oil.kinematic_viscosity is not None:
        inner, outer = ring_speeds(solution)
        plain["viscosity_ratio"] = viscosity_ratio(oil.kinematic_viscosity, (inner - outer)[..., 0], pitch)
    if kind is not None:
        plain["contamination_factor"] = contamination_factor(kind, plain["viscosity_ratio"], pitch)
    return life(solution, **plain)


def _spectrum(solution: Solution, arguments: Arguments, oil: OilState | None) -> SpectrumLife:
    return spectrum_life(_life(solution, solution.scene.readings.get("life", {}), oil), **arguments)


def _film_errors(scene: Scene | None, arguments: Arguments, oil: OilState | None) -> Errors:
    if oil is None:
        return [ErrorDetail("", "needs an oil", cause=NEEDS_OIL)]
    return film_errors(oil, **arguments)


def _estimate_errors(scene: Scene | None, arguments: Arguments, oil: OilState | None) -> Errors:
    deep = scene is not None and scene.bearing.kind is BearingKind.DEEP_GROOVE
    found = estimate_errors(deep, **arguments)
    return found if oil is not None else [ErrorDetail("", "needs an oil", cause=NEEDS_OIL), *found]


def _estimates(solution: Solution, arguments: Arguments, oil: OilState | None) -> FrictionEstimates:
    assert oil is not None  # checked before
    assert oil.kinematic_viscosity is not None  # that of a lubricant always is
    return friction_estimates(solution, kinematic_viscosity=oil.kinematic_viscosity, **arguments)


READINGS: dict[str, Reading] = {
    "life": Reading(_life_errors, _life, rating_life.NEEDS),
    "spectrum": Reading(lambda scene, arguments, oil: spectrum_errors(None, **arguments), _spectrum, rating_life.NEEDS),
    "static_safety": Reading(
        lambda scene, arguments, oil: static_safety_errors(**arguments),
        lambda solution, arguments, oil: static_safety(solution, **arguments),
        (("max_pressure",), ()),
    ),
    "kinematics": Reading(_no_errors, lambda solution, arguments, oil: kinematics(solution), ball_motion.NEEDS),
    "frequencies": Reading(_no_errors, lambda solution, arguments, oil: frequencies(solution), pass_frequencies.NEEDS),
    "film": Reading(
        _film_errors,
        lambda solution, arguments, oil: film(solution, oil, **arguments),  # type: ignore[arg-type]
        film_thickness.NEEDS,
    ),
    "friction": Reading(
        lambda scene, arguments, oil: friction_errors(**arguments),
        lambda solution, arguments, oil: friction(solution, **arguments),
        contact_friction.NEEDS,
    ),
    "pivot_points": Reading(_no_errors, lambda solution, arguments, oil: pivot_points(solution), ball_motion.NEEDS),
    "friction_estimate": Reading(_estimate_errors, _estimates),
    "overrun": Reading(
        lambda scene, arguments, oil: overrun_errors(None if scene is None else scene.bearing, **arguments),
        lambda solution, arguments, oil: overrun(solution, **arguments),
        shoulder_overrun.NEEDS,
    ),
    "stress": Reading(_no_errors, lambda solution, arguments, oil: stress(solution), subsurface_stress.NEEDS),
}
"""Every reading, in the order in which they are shown."""


def asked_errors(readings: Mapping[str, Arguments], scene: Scene | None = None) -> Errors:
    """Everything that is wrong with what is asked for; fields begin with `readings.` and the reading's name.

    Args:
        scene: None where there is none yet: then what depends on it is not judged.
    """
    oil, errors = _oil(readings)
    if errors:
        oil = OilState(0.02, 2e-8, 2e-5)  # any: what else is wrong shall be said as well
    for name, arguments in readings.items():
        if name == LUBRICANT:
            continue
        if name not in READINGS:
            cause = f"One of {', '.join(READINGS)}"
            errors.append(ErrorDetail(f"readings.{name}", "is no reading", cause=cause))
        else:
            found = READINGS[name].errors(scene, arguments, oil)
            errors += [replace(each, field=f"readings.{name}.{each.field}".rstrip(".")) for each in found]
    return errors


def take_asked(solution: Solution) -> dict[str, Any]:
    """Every reading that the solution's scene asks for, by its name.

    Raises:
        SceneError: arguments that are out of range; everything, at once.
    """
    asked = solution.scene.readings
    errors = asked_errors(asked, solution.scene)
    if errors:
        raise SceneError(errors)
    oil, _ = _oil(asked)
    needs = [each.needs for name, each in READINGS.items() if name in asked]
    solution.read_at_once(*(dict.fromkeys(chain.from_iterable(each)) for each in zip(*needs, strict=True)))
    return {name: each.take(solution, asked[name], oil) for name, each in READINGS.items() if name in asked}


OIL_DENSITY, VISCOSITY_INDEX = 870.0, 95.0
"""Of an oil of which nothing else is said; the index, where a grade is given."""


def with_defaults(name: str, given: Arguments) -> dict[str, Any]:
    """The arguments of a reading or of the oil, and what counts for those that were left out; nothing for what is then
    derived, or not computed."""
    usual: dict[str, Any] = {}
    if name == "life":
        usual = {
            each.name: each.default for each in signature(life).parameters.values() if each.default is not each.empty
        }
    elif name == LUBRICANT:
        usual = {"oil_density": OIL_DENSITY} | (
            {"viscosity_index": VISCOSITY_INDEX} if "iso_viscosity_grade" in given else {}
        )
    return {field: value for field, value in (usual | dict(given)).items() if value is not None}


def _oil(readings: Mapping[str, Arguments]) -> tuple[OilState | None, Errors]:
    """The oil at its temperature, if there is one."""
    if LUBRICANT not in readings:
        return None, []
    given = dict(readings[LUBRICANT])
    temperature = given.pop("oil_temperature", None)
    fields = {
        "density": given.pop("oil_density", OIL_DENSITY),
        "pressure_viscosity": given.pop("pressure_viscosity", None),
    }
    grade, index = given.pop("iso_viscosity_grade", None), given.pop("viscosity_index", None)
    cold, hot = given.pop("viscosity_at_40", None), given.pop("viscosity_at_100", None)
    errors: Errors = []
    if temperature is None:
        errors.append(ErrorDetail(f"readings.{LUBRICANT}.oil_temperature", "missing"))
    by_points = cold is not None and hot is not None
    if (grade is None) == (cold is None and hot is None) or (grade is None and not by_points):
        cause = "Give iso_viscosity_grade, or viscosity_at_40 and viscosity_at_100"
        errors.append(ErrorDetail(f"readings.{LUBRICANT}.iso_viscosity_grade", "does not make one oil", cause=cause))
    elif index is not None and grade is None:
        cause = "Leave it out: two viscosities make the index"
        errors.append(
            ErrorDetail(f"readings.{LUBRICANT}.viscosity_index", "is given beside two viscosities", cause=cause)
        )
    if errors:
        return None, errors
    try:
        if grade is not None:
            oil = Lubricant.from_grade(grade, VISCOSITY_INDEX if index is None else index, **fields)
        else:
            points = (FREEZING + 40.0, FREEZING + 100.0), (cold, hot)
            oil = Lubricant(*points, **fields)
        return oil.at(temperature), []
    except SceneError as error:
        return None, [
            replace(each, field=f"readings.{LUBRICANT}.{_KEY.get(each.field, each.field)}") for each in error.errors
        ]


_KEY = {
    "grade": "iso_viscosity_grade",
    "density": "oil_density",
    "temperature": "oil_temperature",
    "viscosities[0]": "viscosity_at_40",
    "viscosities[1]": "viscosity_at_100",
    "viscosities": "viscosity_at_100",
}
"""What an oil's fields are called here."""
