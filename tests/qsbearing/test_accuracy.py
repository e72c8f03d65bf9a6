"""`run --accuracy`: indicators, the measured table, the choice, and whether it keeps its word."""

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
from hypothesis import given
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.cost import accuracy, answers, indicators, ladder, pace, words
from tests.benchmarks import acceptance, advice, random_scenes

from .scenes import B218, PER_BALL, fewer, resting, solved, turning

PACE = {"thrust": 5e-5, "combined": 1.5e-4}
"""A machine's calibration; what is chosen must not hang on the one that runs the test."""
COMBINED = {"axial_load": 17_800.0, "radial_load_y": 3_000.0, "moment_z": 0.0}


def everything(rpm: Any, **operation: Any) -> qs.Scene:
    """All that a scene can name."""
    return turning(rpm, control=PER_BALL, hertz_angle="actual", **(operation or COMBINED))


# Indicators ---------------------------------------------------------------------------------------------------------


def indicated(scene: qs.Scene) -> dict[str, Any]:
    judge = indicators.Judge(scene)
    contacts = indicators.estimated(judge)
    return {one.name: one.indicator(judge, contacts) for one in indicators.OMISSIONS}


def test_at_rest_inertia_matters_nothing() -> None:
    found = indicated(everything(0.0))
    assert found["centrifugal_force"] == found["gyroscopic_moment"] == found["per_ball_control"] == 0.0
    assert found["actual_angle"] > 0.0
    assert found["exact_hertz"] > 0.0


def test_indicators_grow_with_speed_and_fall_with_load() -> None:
    speeds = indicated(everything(np.array([100.0, 200.0, 5000.0, 10_000.0])))
    for name in ("centrifugal_force", "gyroscopic_moment"):
        values = speeds[name]
        assert np.all(np.diff(values) > 0.0)
        assert values[1] / values[0] == pytest.approx(4.0, rel=0.05)  # the square of the speed, while small
    loads = indicated(everything(3000.0, axial_load=np.array([2e3, 2e4])))
    assert loads["centrifugal_force"][0] > 5.0 * loads["centrifugal_force"][1]


def test_formulas_and_solution_agree_on_inertia_forces() -> None:
    """Fc and Mg from equal contact angles against those of the solution, at a speed that hardly parts the angles."""
    scene = turning(1000.0, axial_load=17_800.0)
    solution = solved(scene)
    judge = indicators.Judge(scene)
    angle = solution.inner.angle[0]
    assert judge.centrifugal_force(angle) == pytest.approx(solution.centrifugal_force[0], rel=2e-3)  # type: ignore[index]
    friction = 2.0 * abs(solution.gyroscopic_moment[0]) / 22.225e-3  # type: ignore[index]
    assert judge.gyroscopic_force(angle) == pytest.approx(friction, rel=1e-2)


def test_what_formulas_estimate_is_what_is_found() -> None:
    """Under thrust at rest to the estimate's own error; elsewhere within what makes the choice a fair one."""
    scene = resting(axial_load=17_800.0)
    judge = indicators.Judge(scene)
    before, after = indicators.estimated(judge), indicators.found(judge, solved(scene))
    for name in ("most", "least", "angle", "approach", "turn"):
        assert getattr(before, name) == pytest.approx(getattr(after, name), rel=1e-2), name
    ratios = []
    for batch in random_scenes.batches(8, fewer(40, 4), 5):
        judge = indicators.Judge(batch)
        most = indicators.found(judge, qs.solve(ladder.ways(batch)[0][1])).most
        ratios.append(indicators.estimated(judge).most / most)
    assert np.quantile(np.concatenate(ratios), 0.1) > 0.5
    assert np.quantile(np.concatenate(ratios), 0.9) < 2.0


def test_outer_control_is_settled_only_where_every_ball_obeys_it() -> None:
    for batch in random_scenes.batches(9, fewer(60, 4), 5):
        if batch.raceway_control is not PER_BALL:
            continue
        outer = replace(batch, raceway_control=qs.RacewayControl.OUTER)
        solution = qs.solve(outer)
        judge = indicators.Judge(batch)
        settled = indicators.control(judge, indicators.found(judge, solution)) == 0.0
        chosen = qs.solve(batch).raceway_control
        heavy = solution.inner.load > answers.LIGHT * np.nanmax(solution.inner.load, axis=-1, keepdims=True)
        assert np.all((chosen == "outer") | ~heavy | ~settled[:, None])


# Table --------------------------------------------------------------------------------------------------------------


def test_factors_are_the_quantile_and_its_margin() -> None:
    rng = np.random.default_rng(0)
    indicator = np.exp(rng.uniform(np.log(1e-6), np.log(0.3), 40_000))
    error = indicator * rng.uniform(0.0, 2.0, indicator.size)
    found = advice.factors(indicator, error, 0.99)
    inside = [factor for factor in found[1:11] if factor is not None]
    assert inside == pytest.approx([2.0 * 0.99 * advice.MARGIN] * 10, rel=0.02)
    assert found[-1] is None  # an error of the whole answer is no promise


def test_the_table_knows_every_omission_and_promises_less_where_balls_nearly_lift_off() -> None:
    table = accuracy.table()["omissions"]
    assert list(table) == [one.name for one in indicators.OMISSIONS]
    for name, entry in table.items():
        assert entry["scenes"] > 1000
        assert accuracy.bound(name, "before", 0.0, False) == 0.0
        assert accuracy.bound(name, "after", 1e3, False) == np.inf
        assert accuracy.bound(name, "after", float("nan"), False) == np.inf
        loaded, touching = (accuracy.bound(name, "after", 1e-4, touches) for touches in (False, True))
        assert 0.0 < loaded <= 1.2 * touching
        tiny = [accuracy.bound(name, "before", 10.0**power, False) for power in (-12, -9)]
        assert tiny[1] == pytest.approx(1e3 * tiny[0])


def test_fresh_scenes_stay_below_the_tables_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """The generator run on a few other scenes: 99 % of the errors at each step of the ladder are below their bound."""
    monkeypatch.setattr(advice, "SEED", 4711)
    monkeypatch.setattr(advice, "CASES", fewer(50, 8))
    met, count = 0, 0
    for name, columns in advice.ratios(fewer(60, 2)).items():
        for indicator, touches, error in zip(
            np.concatenate(columns["after"]),
            np.concatenate(columns["after touching"]),
            np.concatenate(columns["error"]),
            strict=True,
        ):
            count += 1
            met += error <= accuracy.bound(name, "after", float(indicator), bool(touches)) + 1e-9
    assert count > fewer(3000, 10)
    assert met >= 0.99 * count


# Choice -------------------------------------------------------------------------------------------------------------


def test_asking_for_more_never_leaves_out_more() -> None:
    scene = everything(300.0)
    left_out = [len(accuracy.choose(scene, asked, PACE).way.left_out) for asked in (1e-1, 1e-2, 1e-3, 1e-6, 1e-12)]
    assert left_out == sorted(left_out, reverse=True)
    assert left_out[0] >= 3
    assert left_out[-1] == 0


def test_the_quickest_of_those_that_do_is_chosen() -> None:
    for batch in random_scenes.batches(12, fewer(30, 3), 1):
        one = random_scenes.case(batch, 0)
        choice = accuracy.choose(one, 1e-2, PACE)
        assert choice.way.seconds == min(way.seconds for way in choice.ways)
        assert all(way.error <= 1e-2 for way in choice.ways)
        assert any(way.scene == one for way in choice.ways)


def test_time_grows_with_what_is_asked_of_the_solver() -> None:
    table = accuracy.table()["seconds"]
    scene = everything(3000.0)
    dear, cheap = (pace.seconds(one, table, PACE) for one in (scene, replace(scene, hertz_angle=qs.HertzAngle.FREE)))
    assert dear > 1.5 * cheap
    assert pace.seconds(scene, table, {name: 3.0 * value for name, value in PACE.items()}) == pytest.approx(3.0 * dear)
    assert set(table["ball"]) >= {pace.kind(one) for one in (scene, resting(**COMBINED), turning(9000, axial_load=1e3))}


def test_balls_that_a_solve_iterates() -> None:
    assert pace.balls(resting(axial_load=1e3)) == 1.0
    assert pace.balls(turning(3000, **COMBINED)) == 9.0
    assert (
        pace.balls(
            turning(3000, axial_load=1e4, radial_load_y=1e3, radial_load_z=5.0, **{"moment_y": 0.0, "moment_z": 0.0})
        )
        == 16.0
    )


def test_a_solution_that_says_no_is_followed_by_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    """With formulas that see no inertia at all, the contacts found must set the choice right."""
    blind = indicators.estimated

    def estimated(judge: indicators.Judge) -> indicators.Contacts:
        seen = blind(judge)
        return replace(seen, most=1e12 * seen.most, least=1e12 * seen.least, approach=seen.approach)

    monkeypatch.setattr(indicators, "estimated", estimated)
    scene = turning(9000, **COMBINED)
    choice = accuracy.choose(scene, 1e-3, PACE)
    assert choice.way.left_out
    reached = accuracy.solve_to(choice)
    assert reached.solves > 1
    assert reached.way.scene == scene
    assert "would not have done" in words.after(reached)
    assert reached.solution.displacement == pytest.approx(solved(scene).displacement, rel=1e-9, abs=1e-15)


def test_arrays_and_accuracies_out_of_range_are_refused() -> None:
    with pytest.raises(ValueError, match="array fields"):
        accuracy.choose(everything(np.array([1.0, 2.0])), 1e-3, PACE)
    for asked in (0.0, -1.0, 2.0, float("nan")):
        with pytest.raises(ValueError, match="must lie between"):
            accuracy.choose(everything(300.0), asked, PACE)


# Its word -----------------------------------------------------------------------------------------------------------


def test_what_is_asked_is_met_by_some_scenes_it_was_not_built_from() -> None:
    found = acceptance.outcomes(fewer(60, 4), seed=fewer(1234, 1235))
    missed = [one for one in found if not one.is_met]
    assert len(missed) <= 1
    assert sum(one.is_simplified for one in found) >= fewer(5, 0)
    assert all(one.error <= 10.0 * one.asked for one in missed)


def test_contacts_that_say_no_say_it_of_every_fidelity_at_once() -> None:
    """A scene whose contacts call for all it names, though formulas would have let four fidelities pass."""
    scene, asked = list(acceptance.requests(335, acceptance.SEED))[334]
    choice = accuracy.choose(scene, asked, PACE)
    reached = accuracy.solve_to(choice)
    assert len(choice.ways) == 4
    assert choice.way.left_out and not reached.way.left_out
    assert (reached.solves, reached.error) == (2, 0.0)


@pytest.mark.heavy
def test_what_is_asked_is_met_by_99_of_100_scenes_it_was_not_built_from() -> None:
    found = acceptance.outcomes(500, seed=991)
    assert sum(one.is_met for one in found) >= 495
    assert np.mean([one.is_simplified for one in found]) > 0.1
    print({name: value for name, value in acceptance.summary(found).items() if name.startswith("time")})


def test_the_kept_trial_met_what_was_asked() -> None:
    trial = accuracy.table()["trial"]
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
    assert before.startswith("Accuracy 0.01: static, exact Hertz, will do, within ")
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
        "assert CliRunner().invoke(cli, sys.argv[1:]).exit_code == 0\n"
        "assert not [name for name in sys.modules if name.startswith('qsbearing.cost')]\n"
    )
    for arguments in (["--help"], ["run", "b218"]):
        done = subprocess.run([sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


@given(st.floats(1e-12, 1.0))
def test_any_accuracy_is_answered(asked: float) -> None:
    choice = accuracy.choose(everything(2000.0), asked, PACE)
    assert choice.way.error <= asked
    assert f"Accuracy {asked:g}" in words.before(choice)
    assert float(B218.ball_count) == 16  # type: ignore[arg-type]
