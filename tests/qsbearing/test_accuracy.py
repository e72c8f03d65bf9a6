"""`run --accuracy`: indicators, measured factors, the choice, and whether it keeps its word."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.studies.cost import accuracy, indicators, levels, text
from tests.benchmarks import acceptance, advice, random_scenes

from .scenes import PER_BALL, fewer, resting, solved, turning

COMBINED = {"axial_load": 17_800.0, "radial_load_y": 3_000.0, "moment_z": 0.0}


def everything(rpm: Any, **operation: Any) -> qs.Scene:
    """All that a scene can name."""
    return turning(rpm, control=PER_BALL, hertz_angle="actual", **(operation or COMBINED))


# Indicators ---------------------------------------------------------------------------------------------------------


def indicated(scene: qs.Scene) -> dict[str, Any]:
    """By the coarsest solution, as `accuracy.choose` has them."""
    found, _ = indicators.indicators(scene, qs.solve(levels.simplifications(scene)[0][1]))
    return found


def test_at_rest_inertia_matters_nothing() -> None:
    found = indicated(everything(0.0))
    assert found["centrifugal_force"] == found["gyroscopic_moment"] == 0.0
    assert found["actual_angle"] > 0.0


def test_indicators_grow_with_speed_and_fall_with_load() -> None:
    speeds = indicated(everything(np.array([100.0, 200.0, 5000.0, 10_000.0])))
    for name in ("centrifugal_force", "gyroscopic_moment"):
        assert np.all(np.diff(speeds[name]) > 0.0)
        assert speeds[name][1] / speeds[name][0] == pytest.approx(4.0, rel=0.05)  # the square of the speed, while small
    loads = indicated(everything(3000.0, axial_load=np.array([2e3, 2e4])))
    assert loads["centrifugal_force"][0] > 5.0 * loads["centrifugal_force"][1]


def test_inertia_is_that_of_the_solution() -> None:
    """Fc and Mg from equal contact angles against those of the solution, at a speed that hardly parts the angles."""
    scene = turning(1000.0, axial_load=17_800.0)
    solution = solved(scene)
    force, moment = indicators.inertia(scene, solution.inner.angle[0])
    assert force == pytest.approx(solution.centrifugal_force[0], rel=2e-3)  # type: ignore[index]
    assert moment == pytest.approx(abs(solution.gyroscopic_moment[0]), rel=1e-2)  # type: ignore[index]


def test_a_ball_about_to_lose_its_raceway_is_noticed() -> None:
    for radial, is_near in ((3e3, False), (17_800.0, True)):
        scene = resting(axial_load=17_800.0, radial_load_y=radial, tilt_y=0.0, tilt_z=0.0)
        assert indicators.indicators(scene, solved(scene))[1] == is_near


# Factors ------------------------------------------------------------------------------------------------------------


def test_a_factor_is_the_quantile_and_its_margin() -> None:
    indicator = np.linspace(0.0, 0.3, 40_001)
    error = indicator * np.linspace(2.0, 0.0, indicator.size)
    assert advice.factor(indicator, error) == pytest.approx(2.0 * advice.QUANTILE * advice.MARGIN, rel=0.01)


def test_every_omission_has_factors_and_what_is_no_number_no_promise() -> None:
    assert list(accuracy.factors()["error_over_indicator"]) == list(indicators.OMISSIONS)
    for name in indicators.OMISSIONS:
        assert accuracy.bound(name, 0.0, False) == 0.0
        assert accuracy.bound(name, float("nan"), False) == accuracy.bound(name, float("inf"), True) == np.inf
        assert accuracy.bound(name, 2e-4, False) == pytest.approx(2.0 * accuracy.bound(name, 1e-4, False))


def test_fresh_scenes_stay_below_their_bounds() -> None:
    """99 % of the errors of other scenes than those measured, for each thing left out alone."""
    for name, columns in advice.ratios(fewer(20, 2), fewer(40, 8), seed=4711).items():
        bounds = [
            accuracy.bound(name, float(indicator), bool(near))
            for indicator, near in zip(columns["indicator"], columns["nearly_unloaded"], strict=True)
        ]
        assert len(bounds) > fewer(200, 2)
        assert np.mean(columns["error"] <= np.array(bounds) + 1e-9) >= 0.99


# Choice -------------------------------------------------------------------------------------------------------------


def test_asking_for_more_never_leaves_out_more() -> None:
    scene = everything(300.0)
    left_out = [len(accuracy.choose(scene, asked).option.left_out) for asked in (1e-1, 1e-2, 1e-3, 1e-6, 1e-12)]
    assert left_out == sorted(left_out, reverse=True)
    assert (left_out[0], left_out[-1]) == (3, 0)


def test_the_coarsest_of_those_that_do_is_chosen() -> None:
    for batch in random_scenes.batches(12, fewer(15, 3), 1):
        scene = random_scenes.case(batch, 0)
        choice = accuracy.choose(scene, 1e-2)
        place = choice.options.index(choice.option)
        assert choice.option.error <= 1e-2
        assert all(option.error > 1e-2 for option in choice.options[:place])
        assert choice.options[-1].scene == scene


def test_the_actual_angle_takes_longer_by_the_balls_that_differ() -> None:
    scene = everything(3000.0)
    coarse = [solved(resting(**operation)) for operation in ({"axial_load": 1e4}, COMBINED)]
    thrust, combined = (accuracy.relative_time(scene, solution) for solution in coarse)
    measured = accuracy.factors()["time"]
    assert accuracy.relative_time(replace(scene, hertz_angle=qs.HertzAngle.FREE), coarse[0]) == pytest.approx(
        measured["first_over_repeated"]
    )
    each = measured["first_over_repeated"] * measured["actual_angle_of_a_ball"]
    assert combined - thrust == pytest.approx((9 - 1) * each)  # of 16 balls 9 are not mirror images


def test_a_solution_that_says_no_is_followed_by_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a choice blind to inertia, the solution's own contacts must set it right."""
    scene = turning(9000, **COMBINED)
    with monkeypatch.context() as blind:
        blind.setattr(accuracy, "bound", lambda name, indicator, near: 1e-6)
        choice = accuracy.choose(scene, 1e-3)
    assert choice.option.left_out
    reached = accuracy.solve_to(choice)
    assert (reached.solves, reached.error) == (2, 0.0)
    assert reached.option.scene == scene
    assert text.after(reached).startswith("That would not have done")
    assert reached.solution.displacement == pytest.approx(solved(scene).displacement, rel=1e-9, abs=1e-15)


def test_arrays_and_accuracies_out_of_range_are_refused() -> None:
    with pytest.raises(ValueError, match="array fields"):
        accuracy.choose(everything(np.array([1.0, 2.0])), 1e-3)
    for asked in (0.0, -1.0, 2.0, float("nan")):
        with pytest.raises(ValueError, match="must lie between"):
            accuracy.choose(everything(300.0), asked)


# Its word -----------------------------------------------------------------------------------------------------------


def test_what_is_asked_is_met_by_scenes_that_were_not_measured() -> None:
    found = acceptance.outcomes(fewer(60, 4), seed=1234, rounds=1)
    assert all(one.is_met for one in found)
    assert sum(one.is_simplified for one in found) >= fewer(5, 0)


@pytest.mark.heavy
def test_what_is_asked_is_met_by_99_of_100_scenes_that_were_not_measured() -> None:
    found = acceptance.outcomes(500, seed=991, rounds=1)
    assert sum(one.is_met for one in found) >= 495
    assert np.mean([one.is_simplified for one in found]) > 0.1


def test_the_kept_trial_met_what_was_asked() -> None:
    trial = accuracy.factors()["trial"]
    assert trial["scenes"] == acceptance.SCENES
    assert trial["met"] >= 0.99 * trial["scenes"]


# Command ------------------------------------------------------------------------------------------------------------

SLOW = """
[bearing]
name = "B218"
[operation]
speed_rpm = 300
axial_load_N = 17800
radial_load_y_N = 3000
tilt_z_mrad = 0
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "per_ball"
hertz_angle = "actual"
"""


def call(*arguments: str | Path) -> Result:
    """One command in this process; anything but a clean exit is an error."""
    result = CliRunner().invoke(cli, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
    return result


@pytest.fixture
def slow(tmp_path: Path) -> Path:
    path = tmp_path / "slow.toml"
    path.write_text(SLOW)
    return path


def test_the_choice_is_told_before_and_what_was_reached_after(slow: Path) -> None:
    result = call("run", slow, "--accuracy", "1e-2")
    assert (result.exit_code, result.stderr) == (0, "")
    before, _, rest = result.stdout.partition("\n")
    assert before.startswith("Accuracy 0.01: static, will do, within ")
    assert "left out: the centrifugal force" in before
    assert "to solve." in before
    assert "No ball effects (static)" in rest
    assert "Reached: within" in rest.splitlines()[-1]


def test_json_adds_one_key_and_keeps_the_others_meaning(slow: Path) -> None:
    result = call("run", slow, "--accuracy", "1e-2", "--json")
    assert result.exit_code == 0
    assert result.stderr.startswith("Accuracy 0.01: static")
    found, plain = json.loads(result.stdout), json.loads(call("run", slow, "--json").stdout)
    said = found.pop("accuracy")
    assert list(found) == list(plain)
    assert said["left_out"] == ["centrifugal_force", "gyroscopic_moment", "actual_angle"]
    assert said["fidelity"] == "static"
    assert 0.0 < said["expected_error"] <= said["asked"] == 0.01
    assert 0.0 < said["reached_error"] <= 0.01
    assert said["expected_seconds"] > 0.0
    assert said["seconds"] > 0.0
    # What was left out is null, not zero.
    assert found["effects"] == []
    assert found["balls"][0]["centrifugal_force_N"] is None
    scale = max(abs(value) for value in plain["displacement"].values() if value is not None)
    assert found["displacement"]["axial_um"] == pytest.approx(plain["displacement"]["axial_um"], abs=0.01 * scale)


def test_the_full_scene_is_solved_where_nothing_simpler_will_do(slow: Path) -> None:
    found = json.loads(call("run", slow, "--accuracy", "1e-9", "--json").stdout)
    plain = json.loads(call("run", slow, "--json").stdout)
    said = found.pop("accuracy")
    assert (said["fidelity"], said["left_out"], said["expected_error"], said["reached_error"]) == ("full", [], 0.0, 0.0)
    assert found["balls"] == plain["balls"]


@pytest.mark.parametrize("asked", ["0", "-1e-3", "2", "nan", "1e-13", "a little"])
def test_an_accuracy_out_of_range_is_bad_input(asked: str) -> None:
    result = call("run", "b218", f"--accuracy={asked}")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "--accuracy" in result.stderr


def test_no_equilibrium_stays_one(tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text('[bearing]\nname = "B218"\n[operation]\naxial_load_N = -1000\n')
    result = call("run", scene, "--accuracy", "1e-2", "--json")
    assert result.exit_code == 1
    found = json.loads(result.stdout)
    assert found["status"] == "no_equilibrium"
    assert found["accuracy"]["reached_error"] is None


def test_a_plain_run_and_the_help_know_nothing_of_costs() -> None:
    code = (
        "import sys\nfrom click.testing import CliRunner\nfrom qsbearing.cli import cli\n"
        "for arguments in (['--help'], ['run', 'b218']):\n"
        "    assert CliRunner().invoke(cli, arguments).exit_code == 0\n"
        "assert not [name for name in sys.modules if name.startswith('qsbearing.studies.cost')]\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
