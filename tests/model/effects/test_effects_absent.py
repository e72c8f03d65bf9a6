"""Off means absent: what a scene does not name is not evaluated, and has no result."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

import qsbearing as qs
from tests.qsbearing.scenes import BOTH, CENTRIFUGAL, resting, solved, turning

LOADS = {"axial_load": 12e3, "radial_load_y": 3e3, "moment_z": 0.0}
MOTION = ("kinematics.", "centrifugal_force.", "gyroscopic_moment.", "raceway_control.")


@pytest.fixture(scope="module")
def calls() -> dict[str, dict[str, int]]:
    """Functions entered by the solve of each kind of scene, seen in a process without compilation."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-m", "tests.model.effects.calls_of_a_solve"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found: dict[str, dict[str, int]] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize("name", ["static", "static, actual angle", "at zero speed"])
def test_at_rest_nothing_moves(calls: dict[str, dict[str, int]], name: str) -> None:
    """No kinematics, no inertia, no hypothesis on rolling in a scene at rest, named effects or not."""
    assert calls[name]["hertz.stiffness_at_angle"] > 0
    assert [function for function in calls[name] if function.startswith(MOTION)] == []


def test_each_effect_is_evaluated_where_it_is_named_and_nowhere_else(calls: dict[str, dict[str, int]]) -> None:
    """Centrifugal force needs the orbit, and neither the rotation nor the moment; Jones's criterion is for per-ball
    control only."""
    force, moment = "centrifugal_force.centrifugal_force", "gyroscopic_moment.gyroscopic_moment"
    rotation, criterion = "kinematics.rotation_per_axis_length", "raceway_control.outer_controls"
    radius, weight, spin = (
        "orbit_radius.displaced_radius",
        "raceway_control.inner_weight",
        "raceway_stiffness.spin_constant",
    )
    slip, slopes = "solve_case.bound_friction", "inertia_slopes.directional"
    own, form = "unequal_balls.from_own_touching", "seats_out_of_round.radial_form"
    watched = {force, moment, rotation, criterion, radius, weight, spin, slip, slopes, own, form}
    both = {force, moment, rotation}
    expected = {
        "centrifugal": {force},
        "gyroscopic": {moment, rotation},
        "both": both,
        "inner control": both,
        "unequal balls": both | {own},
        "seats out of round": both | {form},
        "by each ball": both | {criterion, spin},
        "friction coefficient": {moment, rotation, slip},
        "own orbits": both | {radius, slopes},
        "minimum dissipation": both | {weight, spin, slopes},
    }
    for name, functions in expected.items():
        assert calls[name]["kinematics.orbital_speed"] > 0
        assert watched & set(calls[name]) == functions, name


@pytest.mark.parametrize(("free", "actual"), [("static", "static, actual angle"), ("both", "both, actual angle")])
def test_constant_stiffnesses_are_found_once(calls: dict[str, dict[str, int]], free: str, actual: str) -> None:
    """With Hertz at the free angle one ellipse per raceway is solved, however many iterations follow."""
    assert calls[free]["hertz.stiffness_at_angle"] == 2
    assert calls[actual]["hertz.stiffness_at_angle"] > 20


# ------------------------------------------------------------------------------------------------------- in the results


def of_motion(solution: qs.Solution) -> set[str]:
    """Which results of motion the solution has."""
    names = ("orbital_speed", "rotation_speed", "raceway_control", "centrifugal_force", "gyroscopic_moment")
    found = {name for name in names if getattr(solution, name) is not None}
    assert (solution.inner.required_friction is None) == (solution.outer.required_friction is None)
    return found if solution.outer.required_friction is None else found | {"required_friction"}


def test_a_solution_has_what_its_scene_names() -> None:
    """None, not zero, for what it does not name; and each of the four combinations has its own answer."""
    rolling = {"orbital_speed", "rotation_speed", "raceway_control"}
    turned = rolling | {"gyroscopic_moment", "required_friction"}
    scene = turning(9000, effects=BOTH, **LOADS)
    solutions = [solved(resting(**LOADS))]
    solutions += [
        solved(replace(scene, ball_effects=effects)) for effects in (CENTRIFUGAL, (qs.GyroscopicMoment(),), BOTH)
    ]
    expected = [set(), rolling | {"centrifugal_force"}, turned, turned | {"centrifugal_force"}]
    for solution, names in zip(solutions, expected, strict=True):
        assert of_motion(solution) == names
    for one, other in combinations(solutions, 2):
        assert np.abs(one.displacement - other.displacement).max() > 1e-7


def test_a_table_has_the_columns_of_its_scene() -> None:
    """Columns of what was not asked for are absent, not empty."""
    pytest.importorskip("pandas")
    static = solved(resting(**LOADS)).to_dataframe()
    assert len(static) == 16
    absent = ("friction", "orbital_speed", "rotation_speed", "centrifugal", "gyroscopic", "raceway_control")
    assert [name for name in static.columns if any(word in name for word in absent)] == []
    full = solved(turning(6000, **LOADS)).to_dataframe()
    for name in ("centrifugal_force_N", "gyroscopic_moment_Nmm", "orbital_speed_rpm", "raceway_control"):
        assert name in full.columns
    assert (full["outer_required_friction"] > 0.0).all()
    assert not full.isna().any().any()
