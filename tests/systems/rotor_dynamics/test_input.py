"""What `to_ross` refuses, and how; none of it needs ROSS."""

from __future__ import annotations

import dataclasses
import re
import sys
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.documents.installation import pip_install
from tests.systems.rotor_dynamics.scenes import spindle_bearing

SPEEDS = np.array([0.0, 3_000.0, 6_000.0]) * qs.rpm


def errors(call: Any, *arguments: Any, **named: Any) -> dict[str, str]:
    """What is said of each field."""
    with pytest.raises(qs.SceneError) as caught:
        call(*arguments, **named)
    return {error.field: str(error) for error in caught.value.errors}


def test_every_error_is_said_at_once() -> None:
    stiffness = spindle_bearing(SPEEDS).stiffness.copy()
    stiffness[1, 0, 0] = np.nan
    found = errors(qs.to_ross, stiffness, SPEEDS[::-1], 0, tilt="loose")
    assert set(found) == {"tilt", "speed", "stiffness"}
    assert "'loose': is not one of included, held, free" in found["tilt"]
    assert "does not rise from case to case" in found["speed"]
    assert "1 of 3 matrices hold NaN, the first at index 1" in found["stiffness"]


def test_balls_that_friction_moves_have_no_stiffness_against_tilts() -> None:
    """So that only held ones make an element."""
    both, thrust = (qs.CentrifugalForce(), qs.GyroscopicMoment()), qs.Operation(speed=SPEEDS, axial_load=300.0)
    solution = qs.solve(qs.Scene(spindle_bearing(SPEEDS).scene.bearing, thrust, both, "friction"))  # type: ignore[arg-type]
    assert solution.converged.all()
    for tilt in ("included", "free"):
        said = errors(solution.to_ross, 0, slice(1, 3), tilt=tilt)
        assert set(said) == {"tilt"} and 'tilt = "held" needs none' in said["tilt"]
    try:
        solution.to_ross(0, slice(1, 3), tilt="held")
    except ImportError as error:
        assert "ROSS" in str(error)


@pytest.mark.parametrize(
    ("speed", "said"),
    [
        (SPEEDS[:2], "speed: (speed, 5, 5) and (speed,)"),
        (SPEEDS[0], "is of shape (3, 5, 5), the speed of shape ()"),
        (-SPEEDS, "is negative. ROSS turns its shaft about +z"),
        (np.array([0.0, 1.0, 1.0]), "speed = 1 rad/s: does not rise"),
        ("fast", "is not a number"),
    ],
)
def test_speeds_that_do_not_go_with_it(speed: Any, said: str) -> None:
    found = errors(qs.to_ross, spindle_bearing(SPEEDS).stiffness, speed, 0)
    assert said in " ".join(found.values())


def test_a_bearing_with_tilts_stands_on_ground() -> None:
    found = errors(spindle_bearing(SPEEDS).to_ross, 0, n_link=7)
    assert 'tilt = "held" or "free" links' in found["n_link"]


def test_tilts_that_nothing_resists_cannot_be_left_free() -> None:
    stiffness = spindle_bearing(SPEEDS[0]).stiffness.copy()
    stiffness[3:, 3:] = [[1.0, 1.0], [1.0, 1.0]]
    assert "cannot be left free at index 0" in errors(qs.to_ross, stiffness, 0.0, 0, tilt="free")["tilt"]


def test_cases_that_are_not_solved_are_named_with_their_reason() -> None:
    """Thrust the wrong way has no equilibrium; the sentence is a call away."""
    scene = qs.load_scene("7210c")
    load = np.array([[500.0], [-500.0]])
    solution = qs.solve(dataclasses.replace(scene, operation=qs.Operation(speed=SPEEDS, axial_load=load)))
    found = errors(solution.to_ross, 0, index=(1, slice(None)))
    assert "3 of 3 cases: no_equilibrium (open_side)" in found["status"]
    assert "qs.message(solution, (1, 0)) says why" in found["status"]
    assert "leaves 2 axes of cases" in errors(solution.to_ross, 0)["index"]
    assert "This solution has the cases (2, 3)" in errors(solution.to_ross, 0, index=5)["index"]
    assert "leave index out" in errors(spindle_bearing(0.0).to_ross, 0, index=0)["index"]
    along_load = qs.solve(dataclasses.replace(scene, operation=qs.Operation(axial_load=[100.0, 200.0])))
    assert "give it one axis, that of speed" in errors(along_load.to_ross, 0)["speed"]


def test_a_set_that_is_not_solved_says_so() -> None:
    bearing = qs.load_scene("7210c").bearing
    rows = qs.Row(bearing), qs.Row(bearing, position=0.02)
    solution = qs.solve_set(qs.BearingSet(rows, qs.Operation(speed=SPEEDS, axial_load=-500.0)))
    said = errors(solution.to_ross, 0)["status"]
    assert "3 of 3 cases: no_equilibrium (unsupported). solution.message(0) says why" in said
    assert "row" in solution.message(0)


def test_where_ross_is_missing_it_is_said_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ross", None)
    with pytest.raises(ImportError, match=re.escape(pip_install("ross"))):
        spindle_bearing(0.0).to_ross(0)


@pytest.mark.parametrize(("version", "axis"), [("2.3.0", "frequency"), ("3.0.0", "speed"), ("3.1.0", "speed")])
def test_the_speed_of_the_shaft_goes_by_the_name_it_has_in_that_version(
    version: str, axis: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In ROSS 3 `frequency` is the frequency of the whirl: taken without an error, and wrong."""
    monkeypatch.setitem(sys.modules, "ross", SimpleNamespace(__version__=version, BearingElement=dict))
    made = spindle_bearing(SPEEDS).to_ross(0, tilt="held")
    assert (made[axis] == SPEEDS).all()
    assert {"speed", "frequency"} & set(made) == {axis}


@pytest.mark.parametrize("version", ["1.6.1", "4.0.0"])
def test_a_version_whose_words_are_not_known_is_refused(version: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ross", SimpleNamespace(__version__=version, BearingElement=dict))
    with pytest.raises(ImportError, match=rf"ROSS 2 and 3, not {version}"):
        spindle_bearing(SPEEDS).to_ross(0, tilt="held")
