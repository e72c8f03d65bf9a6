"""Every scene of the independent 50-digit reference: state, contacts, motion and stiffness, alone and in batches.

The reference solves the full system of Jones and Harris, four unknowns a ball, with mpmath and shares no code with the
package. The tolerance is 1e-10 throughout: two digits coarser than the solver's own, which stops at a force imbalance
of 1e-12, and what the number of units of rounding in a stiffness of 1e9 N/m leaves.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import fields
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from tests.reference.generate import load_reference

from .scenes import DISPLACEMENTS, LOADS, solved

TOLERANCE = 1e-10
ENTRIES = {entry["case"]["name"]: entry for entry in load_reference()}
NAMES = list(ENTRIES)
CHANNEL_KEYS = ("x", "y", "z", "tilt_y", "tilt_z")


def material(case: dict[str, Any], key: str) -> dict[str, float]:
    return {name: float(value) for name, value in case[key].items()}


def bearing_numbers(case: dict[str, Any]) -> dict[str, float]:
    keys = ("ball_count", "ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius")
    return {key: float(case[key]) for key in keys} | {
        "free_contact_angle": float(case["free_contact_angle_deg"]) * qs.deg
    }


def operation_numbers(case: dict[str, Any]) -> dict[str, float]:
    numbers = {
        "speed": float(case["inner_speed_rpm"]) * qs.rpm,
        "outer_speed": float(case["outer_speed_rpm"]) * qs.rpm,
    }
    for key, load, displacement in zip(CHANNEL_KEYS, LOADS, DISPLACEMENTS, strict=True):
        kind, value = case["channels"][key]
        numbers[displacement if kind == "displacement" else load] = float(value)
    return numbers


def choices(case: dict[str, Any]) -> dict[str, Any]:
    effects: tuple[Any, ...] = (qs.CentrifugalForce(),) if case["centrifugal_force"] else ()
    if case["gyroscopic_moment"]:
        effects += (qs.GyroscopicMoment(qs.MomentShares(case["shares"])),)
    return {
        "ball_effects": effects,
        "raceway_control": qs.RacewayControl(case["control"]) if effects else None,
        "hertz_angle": qs.HertzAngle(case["hertz_angle"]),
    }


def scene_of(*cases: dict[str, Any]) -> qs.Scene:
    """One scene for cases that make the same choices: numbers for one, arrays in every field for several."""

    def gather(numbers: list[dict[str, float]]) -> dict[str, Any]:
        if len(numbers) == 1:
            return dict(numbers[0])
        return {key: np.array([one[key] for one in numbers]) for key in numbers[0]}

    bearing = qs.BallBearing(
        **gather([bearing_numbers(case) for case in cases]),
        ball_material=qs.Material(**gather([material(case, "ball_material") for case in cases])),
        ring_material=qs.Material(**gather([material(case, "ring_material") for case in cases])),
        kind=qs.BearingKind.DEEP_GROOVE,  # the reference knows no open side
    )
    return qs.Scene(bearing, qs.Operation(**gather([operation_numbers(case) for case in cases])), **choices(cases[0]))


def structure(case: dict[str, Any]) -> tuple:
    """What one array call cannot vary: which channels are held, and the choices of the model."""
    held = tuple(case["channels"][key][0] for key in CHANNEL_KEYS)
    effects = case["centrifugal_force"], case["gyroscopic_moment"]
    return held, effects, case["control"], case["shares"], case["hertz_angle"]


BATCHES: dict[tuple, list[str]] = defaultdict(list)
for _name, _entry in ENTRIES.items():
    BATCHES[structure(_entry["case"])].append(_name)


@cache
def alone(name: str) -> tuple[qs.Solution, NDArray]:
    scene = scene_of(ENTRIES[name]["case"])
    solution = solved(scene)
    return solution, qs.stiffness(scene, solution)


@cache
def together(key: tuple) -> tuple[qs.Solution, NDArray]:
    """The whole batch, and the first case once more so that no batch is a single case."""
    cases = [ENTRIES[name]["case"] for name in BATCHES[key]]
    scene = scene_of(*cases, cases[0])
    solution = solved(scene)
    return solution, qs.stiffness(scene, solution)


def answer(name: str, way: str) -> tuple[qs.Solution, NDArray, Any]:
    """(solution, its stiffness, index of the case within it)."""
    if way == "alone":
        return *alone(name), ()
    key = structure(ENTRIES[name]["case"])
    return *together(key), (BATCHES[key].index(name),)


def number(text: str | None) -> float:
    return np.nan if text is None else float(text)


def of_balls(name: str, key: str, race: str = "") -> NDArray:
    balls = ENTRIES[name]["result"]["balls"]
    return np.array([number((ball[race] if race else ball)[key]) for ball in balls])


def found(array: NDArray | None, index: Any, name: str) -> NDArray:
    """The case's row, without the balls that only larger bearings of its batch have (which hold NaN)."""
    assert array is not None
    count = len(ENTRIES[name]["result"]["balls"])
    row = array[index]
    assert np.isnan(row[count:]).all()
    return row[:count]


def agree(found: NDArray, reference: NDArray, *, scale: Any) -> None:
    """Equal to TOLERANCE of the scale, and without a number in the same places."""
    assert np.array_equal(np.isnan(found), np.isnan(reference))
    deviation = np.abs(found - reference) / scale
    assert np.nanmax(deviation, initial=0.0) <= TOLERANCE, deviation


both_ways = pytest.mark.parametrize("way", ["alone", "together"])
every_scene = pytest.mark.parametrize("name", NAMES)
turning_scenes = pytest.mark.parametrize("name", [name for name in NAMES if ENTRIES[name]["case"]["centrifugal_force"]])
gyroscopic_scenes = pytest.mark.parametrize(
    "name", [name for name in NAMES if ENTRIES[name]["case"]["gyroscopic_moment"]]
)


@both_ways
@every_scene
def test_displacements_and_ring_loads(name: str, way: str) -> None:
    """Ring displacements over the largest translation or rotation; loads over the largest contact load."""
    solution, _, index = answer(name, way)
    result = ENTRIES[name]["result"]
    displacement = np.array([float(value) for value in result["displacement"]])
    load = np.array([float(value) for value in result["load"]])
    radius = 0.5 * float(ENTRIES[name]["case"]["pitch_diameter"])
    length = np.array([1.0, 1.0, 1.0, radius, radius])
    agree(solution.displacement[index] * length, displacement * length, scale=np.abs(displacement * length).max())
    largest = max(np.nanmax(of_balls(name, "load", race)) for race in ("inner", "outer"))
    agree(solution.load[index] / length, load / length, scale=largest)


@both_ways
@pytest.mark.parametrize("race", ["inner", "outer"])
@every_scene
def test_contact_loads_and_angles(name: str, race: str, way: str) -> None:
    """Each contact's load by itself, and all over the largest; unloaded ones are exactly zero. Angles in radians."""
    solution, _, index = answer(name, way)
    contacts = getattr(solution, race)
    load = of_balls(name, "load", race)
    got = found(contacts.load, index, name)
    assert np.array_equal(got == 0.0, load == 0.0)
    agree(got, load, scale=np.nanmax(load))
    agree(got[load > 0.0], load[load > 0.0], scale=load[load > 0.0])
    angle = of_balls(name, "angle", race)
    agree(found(contacts.angle, index, name), angle, scale=np.maximum(np.abs(angle), 0.1))


@both_ways
@pytest.mark.parametrize("race", ["inner", "outer"])
@every_scene
def test_contact_ellipses_and_pressures(name: str, race: str, way: str) -> None:
    """Approach over the largest (a gap is a difference of lengths), semi-axes and pressure each by itself."""
    solution, _, index = answer(name, way)
    contacts = getattr(solution, race)
    approach = of_balls(name, "approach", race)
    agree(found(contacts.approach, index, name), approach, scale=np.nanmax(np.abs(approach)))
    load = of_balls(name, "load", race)
    for key in ("semi_major_axis", "semi_minor_axis", "max_pressure"):
        # The reference leaves out the contacts of a ball without a place; without load there is no ellipse either way.
        reference = np.where(load > 0.0, of_balls(name, key, race), 0.0)
        agree(found(getattr(contacts, key), index, name), reference, scale=np.where(load > 0.0, reference, 1e-9))


@both_ways
@turning_scenes
def test_motion_and_inertia(name: str, way: str) -> None:
    """Orbit, rotation (signed) and centrifugal force, each ball's by itself; an orbit may nearly stand still."""
    solution, _, index = answer(name, way)
    case = ENTRIES[name]["case"]
    fastest = max(abs(float(case[key])) for key in ("inner_speed_rpm", "outer_speed_rpm")) * qs.rpm
    agree(found(solution.orbital_speed, index, name), of_balls(name, "orbital_speed"), scale=fastest)
    rotation = of_balls(name, "rotation_speed")
    agree(found(solution.rotation_speed, index, name), rotation, scale=np.abs(rotation))
    force = of_balls(name, "centrifugal_force")
    agree(found(solution.centrifugal_force, index, name), force, scale=np.nanmax(force))


@both_ways
@gyroscopic_scenes
def test_gyroscopic_moment_and_friction(name: str, way: str) -> None:
    """Mg with its sign, and the friction it demands at both contacts.

    The reference gives no coefficient at a contact without load; here none of those is asked for friction, which is 0.
    A coefficient of a ten-thousandth is nothing to a contact: smaller ones count as that, so that the last bits of the
    angle at which an idle ball lies do not.
    """
    solution, _, index = answer(name, way)
    moment = of_balls(name, "gyroscopic_moment")
    agree(found(solution.gyroscopic_moment, index, name), moment, scale=np.abs(moment).max())
    for race in ("inner", "outer"):
        load = of_balls(name, "load", race)
        friction = np.where(load > 0.0, of_balls(name, "required_friction", race), 0.0)
        got = found(getattr(solution, race).required_friction, index, name)
        agree(got, friction, scale=np.maximum(np.abs(friction), 1e-4))


@both_ways
@turning_scenes
def test_choices_of_control(name: str, way: str) -> None:
    """Which raceway controls each ball: given, or found by Jones's criterion."""
    solution, _, index = answer(name, way)
    count = len(ENTRIES[name]["result"]["balls"])
    assert solution.raceway_control is not None
    row = solution.raceway_control[index]
    assert list(row[:count]) == [ball["control"] for ball in ENTRIES[name]["result"]["balls"]]
    assert set(row[count:]) <= {""}


@both_ways
@every_scene
def test_stiffness(name: str, way: str) -> None:
    """All 25 entries, over the geometric mean of the two diagonal entries they join."""
    _, stiffness, index = answer(name, way)
    reference = np.array([[float(value) for value in row] for row in ENTRIES[name]["result"]["stiffness"]])
    # A deep groove without load across has no stiffness there at all: its scale is that of the stiffest channel.
    radius = 0.5 * float(ENTRIES[name]["case"]["pitch_diameter"])
    unit = np.array([1.0, 1.0, 1.0, radius, radius])
    own = np.abs(np.diag(reference))
    diagonal = np.maximum(own, (own / unit**2).max() * unit**2 * 1e-6)
    agree(stiffness[index], reference, scale=np.sqrt(np.outer(diagonal, diagonal)))


def test_the_batches_are_batches() -> None:
    """Bearings, counts, materials and speeds vary within a batch, so that every array field is put to use."""
    varied = [key for key, names in BATCHES.items() if len(names) > 1]
    assert len(varied) >= 3
    counts = [{ENTRIES[name]["case"]["ball_count"] for name in BATCHES[key]} for key in varied]
    assert any(len(different) > 1 for different in counts)
    assert {field.name for field in fields(qs.Operation)} >= set(LOADS) | set(DISPLACEMENTS)
