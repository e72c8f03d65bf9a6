"""Off means absent: what a scene does not name is not evaluated, and has no result."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs

from .scenes import BOTH, CENTRIFUGAL, resting, solved, turning

LOADS = {"axial_load": 12e3, "radial_load_y": 3e3, "moment_z": 0.0}
MOTION = ("kinematics.", "centrifugal_force.", "gyroscopic_moment.", "raceway_control.")


@pytest.fixture(scope="module")
def calls() -> dict[str, dict[str, int]]:
    """Functions entered by the solve of each kind of scene, seen in a process without compilation."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1"}
    command = [sys.executable, "-m", "tests.qsbearing.calls_of_a_solve"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found: dict[str, dict[str, int]] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize("name", ["static", "static, actual angle", "at zero speed"])
def test_at_rest_nothing_moves(calls: dict[str, dict[str, int]], name: str) -> None:
    """No kinematics, no inertia, no hypothesis on rolling in a scene at rest, named effects or not."""
    assert calls[name]["contact.contact_load"] > 0
    assert [function for function in calls[name] if function.startswith(MOTION)] == []
    assert "ball.moving_ball" not in calls[name]


def test_without_the_gyroscopic_moment_no_ball_turns(calls: dict[str, dict[str, int]]) -> None:
    """Centrifugal force needs the orbit, and neither the rotation nor the moment."""
    found = calls["centrifugal"]
    assert found["centrifugal_force.centrifugal_force"] > 0
    assert found["kinematics.orbital_speed"] > 0
    assert "gyroscopic_moment.gyroscopic_moment" not in found
    assert "kinematics.rotation_per_axis_length" not in found


def test_without_centrifugal_force_none_is_evaluated(calls: dict[str, dict[str, int]]) -> None:
    """The gyroscopic moment alone."""
    found = calls["gyroscopic"]
    assert found["gyroscopic_moment.gyroscopic_moment"] > 0
    assert "centrifugal_force.centrifugal_force" not in found


@pytest.mark.parametrize("name", ["both", "inner control"])
def test_a_given_control_asks_no_criterion(calls: dict[str, dict[str, int]], name: str) -> None:
    """Jones's criterion is evaluated for per-ball control only."""
    assert calls[name]["gyroscopic_moment.gyroscopic_moment"] > 0
    assert calls[name]["centrifugal_force.centrifugal_force"] > 0
    assert "raceway_control.outer_controls" not in calls[name]
    assert calls["by each ball"]["raceway_control.outer_controls"] > 0


@pytest.mark.parametrize(("free", "actual"), [("static", "static, actual angle"), ("both", "both, actual angle")])
def test_constant_stiffnesses_are_found_once(calls: dict[str, dict[str, int]], free: str, actual: str) -> None:
    """With Hertz at the free angle one ellipse a raceway is solved, however many iterations follow."""
    assert calls[free]["hertz.stiffness_at_angle"] == 2
    assert calls[actual]["hertz.stiffness_at_angle"] > 20


# ------------------------------------------------------------------------------------------------------- in the results


def test_a_static_solution_has_no_motion() -> None:
    """None, not zero, where the scene names no effect."""
    solution = solved(resting(**LOADS))
    assert solution.centrifugal_force is None
    assert solution.gyroscopic_moment is None
    assert solution.orbital_speed is None
    assert solution.rotation_speed is None
    assert solution.raceway_control is None
    assert solution.inner.required_friction is None
    assert solution.outer.required_friction is None


def test_a_solution_has_what_its_scene_names() -> None:
    """Centrifugal force without the moment, and the moment without the force."""
    thrown = solved(turning(6000, effects=CENTRIFUGAL, **LOADS))
    assert thrown.centrifugal_force is not None
    assert thrown.orbital_speed is not None
    assert thrown.raceway_control is not None
    assert thrown.gyroscopic_moment is None
    assert thrown.outer.required_friction is None
    turned = solved(turning(6000, effects=(qs.GyroscopicMoment(),), **LOADS))
    assert turned.centrifugal_force is None
    assert turned.gyroscopic_moment is not None
    assert turned.outer.required_friction is not None


def test_effects_together_are_not_effects_alone() -> None:
    """Each of the four combinations has its own answer."""
    scene = turning(9000, effects=BOTH, **LOADS)
    answers = [
        solved(replace(scene, ball_effects=effects)).displacement
        for effects in (BOTH, CENTRIFUGAL, (qs.GyroscopicMoment(),))
    ]
    answers.append(solved(resting(**LOADS)).displacement)
    for i, one in enumerate(answers):
        for other in answers[:i]:
            assert np.abs(one - other).max() > 1e-7


def test_a_table_has_the_columns_of_its_scene() -> None:
    """Columns of what was not asked for are absent, not empty."""
    pytest.importorskip("pandas")
    static = solved(resting(**LOADS)).to_dataframe()
    assert len(static) == 16
    assert not any("friction" in name or "speed" in name or "centrifugal" in name for name in static.columns)
    full = solved(turning(6000, **LOADS)).to_dataframe()
    for name in ("centrifugal_force_N", "gyroscopic_moment_Nmm", "orbital_speed_rpm", "raceway_control"):
        assert name in full.columns
    assert (full["outer_required_friction"] > 0.0).all()
    assert not full.isna().any().any()
