"""Every scene of the independent 50-digit reference: state, contacts, motion and stiffness, alone and in batches.

The reference solves the full system of Jones and Harris, four unknowns per ball, with mpmath and shares no code with
the package. The tolerance is 1e-10 throughout: two digits coarser than the solver's own, which stops at a force
imbalance of 1e-12, and what rounding leaves of a stiffness of 1e9 N/m.
"""

from __future__ import annotations

from collections import defaultdict
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from tests.qsbearing.scenes import solved
from tests.verification.reference.as_scene import CHANNELS, scene_of
from tests.verification.reference.generate import load_reference

TOLERANCE = 1e-10
ENTRIES = {entry["case"]["name"]: entry for entry in load_reference()}


def structure(case: dict[str, Any]) -> tuple:
    """What one array call cannot vary: which channels are held, and the choices of the model."""
    held = tuple(case["channels"][key][0] for key in CHANNELS)
    effects = case["centrifugal_force"], case["gyroscopic_moment"]
    choices = case["control"], case["shares"], case["hertz_angle"], case.get("orbit_radius")
    optional = ("friction_coefficient", "ball_diameter_deviations", "seat_lobes")
    return held, effects, *choices, *(name in case for name in optional)


BATCHES: dict[tuple, list[str]] = defaultdict(list)
for _name, _entry in ENTRIES.items():
    BATCHES[structure(_entry["case"])].append(_name)


@cache
def together(key: tuple) -> tuple[qs.Solution, NDArray]:
    """The whole batch, and the first case once more so that no batch is a single case."""
    cases = [ENTRIES[name]["case"] for name in BATCHES[key]]
    solution = solved(scene_of(*cases, cases[0]))
    return solution, qs.stiffness(solution.scene, solution)


def answer(name: str, way: str) -> tuple[qs.Solution, NDArray, Any]:
    """(solution, its stiffness, index of the case within it)."""
    case = ENTRIES[name]["case"]
    if way == "alone":
        solution = solved(scene_of(case))
        return solution, qs.stiffness(solution.scene, solution), ()
    return *together(structure(case)), (BATCHES[structure(case)].index(name),)


def agree(found: NDArray, reference: NDArray, scale: Any, what: str) -> None:
    """Equal to TOLERANCE of the scale, and without a number at the same positions."""
    assert np.array_equal(np.isnan(found), np.isnan(reference)), what
    deviation = np.abs(found - reference) / scale
    assert np.nanmax(deviation, initial=0.0) <= TOLERANCE, (what, deviation)


@pytest.mark.parametrize("way", ["alone", "together"])
@pytest.mark.parametrize("name", ENTRIES)
def test_every_result_to_ten_digits(name: str, way: str) -> None:
    """Ring, contacts, motion, friction and stiffness."""
    solution, stiffness, index = answer(name, way)
    case, result = ENTRIES[name]["case"], ENTRIES[name]["result"]
    balls = result["balls"]

    def expected(key: str, race: str = "") -> NDArray:
        values = [(ball[race] if race else ball)[key] for ball in balls]
        return np.array([np.nan if value is None else float(value) for value in values])

    def found(array: NDArray | None) -> NDArray:
        """The case's row, without the balls that only larger bearings of its batch have (which hold NaN)."""
        assert array is not None
        assert np.isnan(array[index][len(balls) :]).all()
        return array[index][: len(balls)]

    radius = 0.5 * float(case["pitch_diameter"])
    unit = np.array([1.0, 1.0, 1.0, radius, radius])
    heaviest = max(np.nanmax(expected("load", race)) for race in ("inner", "outer"))
    displacement = np.array([float(value) for value in result["displacement"]]) * unit
    agree(solution.displacement[index] * unit, displacement, np.abs(displacement).max(), "displacement")
    load = np.array([float(value) for value in result["load"]]) / unit
    agree(solution.load[index] / unit, load, heaviest, "load")

    for race in ("inner", "outer"):
        contacts = getattr(solution, race)
        load, angle, approach = (expected(key, race) for key in ("load", "angle", "approach"))
        got = found(contacts.load)
        assert np.array_equal(got == 0.0, load == 0.0)  # unloaded contacts are exactly so
        agree(got[load > 0.0], load[load > 0.0], load[load > 0.0], f"{race} load")
        agree(found(contacts.angle), angle, np.maximum(np.abs(angle), 0.1), f"{race} angle")
        # A gap is a difference of lengths: right to the largest approach.
        agree(found(contacts.approach), approach, np.nanmax(np.abs(approach)), f"{race} approach")
        for key in ("semi_major_axis", "semi_minor_axis", "max_pressure"):
            # The reference leaves out the contacts of an unloaded ball at rest; there is no ellipse either way.
            size = np.where(load > 0.0, expected(key, race), 0.0)
            agree(found(getattr(contacts, key)), size, np.where(load > 0.0, size, 1e-9), f"{race} {key}")
        if case["gyroscopic_moment"]:
            # The reference gives no coefficient at a contact without load, the package none asked for: zero.
            # Coefficients below a ten-thousandth count as that: they hang on the last bits of an angle.
            friction = np.where(load > 0.0, expected("required_friction", race), 0.0)
            agree(found(contacts.required_friction), friction, np.maximum(np.abs(friction), 1e-4), f"{race} friction")

    if case["gyroscopic_moment"]:
        moment = expected("gyroscopic_moment")
        agree(found(solution.gyroscopic_moment), moment, np.abs(moment).max(), "gyroscopic moment")
    if case["centrifugal_force"]:
        # Between rings turning against each other the orbit nearly stands still: right to the faster ring.
        fastest = max(abs(float(case[key])) for key in ("inner_speed_rpm", "outer_speed_rpm")) * qs.rpm
        agree(found(solution.orbital_speed), expected("orbital_speed"), fastest, "orbit")
        rotation, force = expected("rotation_speed"), expected("centrifugal_force")
        agree(found(solution.rotation_speed), rotation, np.abs(rotation), "rotation")
        agree(found(solution.centrifugal_force), force, np.nanmax(force), "centrifugal force")
        assert solution.raceway_control is not None
        row = solution.raceway_control[index]
        assert list(row[: len(balls)]) == [ball["control"] for ball in balls]
        assert set(row[len(balls) :]) <= {""}

    # Entries over the geometric mean of the two diagonal entries that they join; a deep groove without load across
    # has no stiffness there at all, and its scale is that of the stiffest channel.
    matrix = np.array([[float(value) for value in row] for row in result["stiffness"]])
    own = np.abs(np.diag(matrix))
    diagonal = np.maximum(own, (own / unit**2).max() * unit**2 * 1e-6)
    agree(stiffness[index], matrix, np.sqrt(np.outer(diagonal, diagonal)), "stiffness")


def test_the_batches_are_batches() -> None:
    """Ball counts and materials vary within a batch, so that array fields and padding are put to use."""
    varied = [[ENTRIES[name]["case"] for name in names] for names in BATCHES.values() if len(names) > 1]
    assert len(varied) >= 3
    assert any(len({case["ball_count"] for case in cases}) > 1 for cases in varied)
    assert any(len({str(case["ball_material"]) for case in cases}) > 1 for cases in varied)
