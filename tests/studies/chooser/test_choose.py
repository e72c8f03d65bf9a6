"""`solve(scene, effects="auto")`: just what the tolerance needs, and its word is kept."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects import EFFECTS
from qsbearing.model.solution import solver
from qsbearing.model.solution.comparison import largest
from qsbearing.studies.chooser import choose
from qsbearing.studies.chooser.choose import completed, without
from tests.qsbearing.scenes import BOTH_HARRIS, INNER, PER_BALL, fewer, resting, solved, turning
from tests.verification.benchmarks import auto_accuracy

THRUST = {"axial_load": 17_800.0}
COMBINED = {"axial_load": 17_800.0, "radial_load_y": 3_000.0, "moment_z": 0.0}


def bare(rpm: Any, **operation: Any) -> qs.Scene:
    """An operating point that names nothing."""
    return replace(resting(**operation), operation=qs.Operation(speed=np.asarray(rpm, float) * qs.rpm, **operation))


def left_out(solution: qs.Solution) -> tuple[str, ...]:
    assert solution.choice is not None
    return tuple(one.effect for one in solution.choice.left_out)


def test_everything_that_may_be_named_is_in_the_full_model() -> None:
    full = completed(bare(9000.0, **COMBINED))
    assert all(entry.is_in(full) for entry in EFFECTS if not entry.needs and not entry.hypothesis)
    assert full.raceway_control is PER_BALL
    assert completed(full) is full


def test_what_is_stated_is_kept() -> None:
    """A hypothesis, a parameter of an effect, a convention."""
    scene = turning(9000.0, effects=BOTH_HARRIS[1:], control=INNER, hertz_angle="zero", **COMBINED)
    full = completed(scene)
    assert full.raceway_control is INNER
    assert full.gyroscopic_moment == BOTH_HARRIS[1]
    assert full.hertz_angle is qs.HertzAngle.ZERO


def test_at_rest_nothing_of_inertia_is_simulated_and_one_solve_does() -> None:
    solution = qs.solve(bare(0.0, **THRUST), effects="auto")
    assert solution.scene.ball_effects == ()
    assert solution.choice is not None
    assert solution.choice.solves == 1
    assert set(left_out(solution)) == {"centrifugal_force", "gyroscopic_moment", "hertz_angle", "orbit_radius"}
    errors = {one.effect: one.estimated_error for one in solution.choice.left_out}
    assert errors["centrifugal_force"] == errors["gyroscopic_moment"] == 0.0
    assert solution.centrifugal_force is None


def test_at_speed_inertia_is_added_though_not_named() -> None:
    solution = qs.solve(bare(15_000.0, **THRUST), effects="auto", accuracy=0.01)
    assert solution.choice is not None
    assert {"centrifugal_force", "gyroscopic_moment"} <= set(solution.choice.added)
    assert float(largest(solution, solved(completed(solution.scene)))) <= 0.01


def test_asking_for_more_never_leaves_out_more() -> None:
    scene = bare(1500.0, **COMBINED)
    counts = [
        len(left_out(qs.solve(scene, effects="auto", accuracy=asked))) for asked in (1.0, 1e-1, 1e-2, 1e-3, 1e-12)
    ]
    assert counts == sorted(counts, reverse=True)
    assert (counts[0], counts[-1]) == (4, 0)


def test_its_word_is_kept_on_scenes_that_nothing_was_fitted_to() -> None:
    found = auto_accuracy.outcomes(fewer(60, 4), seed=4711)
    assert all(one.error <= auto_accuracy.TOLERANCE for one in found)
    assert sum(bool(one.left_out) for one in found) >= fewer(30, 1)


def test_the_kept_trial_met_what_was_asked() -> None:
    trial = json.loads(auto_accuracy.RECORD.read_text(encoding="utf-8"))
    assert trial["scenes"] == auto_accuracy.SCENES == 2000
    assert trial["within_tolerance"] >= 0.995 * trial["scenes"]
    assert trial["worst"][0]["error"] <= 0.03
    assert trial["something_left_out"] >= 0.5 * trial["scenes"]


def test_what_is_found_by_trying_is_its_error(monkeypatch: pytest.MonkeyPatch) -> None:
    """With indicators that always doubt, errors are those of the solutions."""
    monkeypatch.setattr(choose, "MARGIN", 1e9)
    scene = bare(1200.0, **THRUST)
    solution = qs.solve(scene, effects="auto", accuracy=0.05)
    assert solution.choice is not None
    assert left_out(solution)
    estimated = sum(float(one.estimated_error) for one in solution.choice.left_out)
    assert estimated == pytest.approx(float(largest(solution, solved(completed(scene)))), rel=1e-6)


def test_blind_indicators_are_set_right_where_balls_are_light(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a ball carries little, solutions decide: predictions of nothing do no harm."""
    scene = bare(6000.0, axial_load=17_800.0, radial_load_y=17_800.0, tilt_y=0.0, tilt_z=0.0)
    real = choose.judge

    def blind(*given: Any) -> Any:
        judged = real(*given)
        return replace(judged, errors={name: 1e-9 * error for name, error in judged.errors.items()})

    monkeypatch.setattr(choose, "judge", blind)
    solution = qs.solve(scene, effects="auto", accuracy=0.01)
    assert float(largest(solution, solved(completed(scene)))) <= 0.01
    assert len(solution.scene.ball_effects) == 2


def test_arrays_get_one_choice_that_serves_all_cases() -> None:
    speeds = np.array([0.0, 500.0, 15_000.0])
    many = qs.solve(bare(speeds, **THRUST), effects="auto", accuracy=0.01)
    slow = qs.solve(bare(speeds[:2], **THRUST), effects="auto", accuracy=0.01)
    assert many.shape == (3,)
    assert len(many.scene.ball_effects) == 2
    assert slow.scene.ball_effects == ()
    assert slow.choice is not None
    for one in slow.choice.left_out:
        assert np.shape(one.estimated_error) == (2,)
        assert np.max(one.estimated_error) <= 0.01
    full = solved(completed(bare(speeds, **THRUST)))
    assert (largest(many, full) <= 0.01).all()


def test_a_scene_may_ask_for_it_itself() -> None:
    scene = replace(bare(3000.0, **THRUST), tolerance=0.01)
    own, asked = qs.solve(scene), qs.solve(replace(scene, tolerance=None), effects="auto", accuracy=0.01)
    assert own.choice == asked.choice
    assert own.scene.tolerance is None
    with pytest.raises(ValueError, match=r"qsbearing\.solve"):
        solver.solve(scene)


def test_a_plain_solve_chooses_nothing() -> None:
    assert solved(turning(9000.0, **THRUST)).choice is None


def test_what_cannot_be_asked_is_refused() -> None:
    scene = bare(300.0, **THRUST)
    with pytest.raises(ValueError, match="effects"):
        qs.solve(scene, effects="all")
    for asked in (0.0, -1.0, 2.0, float("nan")):
        with pytest.raises(ValueError, match="must lie between"):
            qs.solve(scene, effects="auto", accuracy=asked)
    with pytest.raises(qs.SceneError, match="tolerance"):
        replace(scene, tolerance=2.0)


def test_an_accuracy_without_effects_to_choose_is_refused_and_says_what_was_meant() -> None:
    for asked in (0.01, 1e-12):
        with pytest.raises(ValueError, match=r"give effects='auto' too.* residual_tolerance"):
            qs.solve(bare(300.0, **THRUST), accuracy=asked)


def test_tolerance_is_accuracy_by_its_old_name() -> None:
    scene = bare(9000.0, **COMBINED)
    for asked in (1.0, 1e-6):
        with pytest.warns(DeprecationWarning, match="tolerance is called accuracy") as said:
            by_old = qs.solve(scene, effects="auto", tolerance=asked)
        assert said[0].filename == __file__
        assert by_old.choice.tolerance == asked
        assert left_out(by_old) == left_out(qs.solve(scene, effects="auto", accuracy=asked))
    with pytest.raises(ValueError, match="give accuracy alone"):
        qs.solve(scene, effects="auto", tolerance=0.1, accuracy=0.1)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ("b218", r"qs\.load_scene\('b218'\)"),
        (Path("b218.toml"), r"qs\.load_scene\('b218.toml'\)"),
        (bare(300.0, **THRUST).bearing, r"not BallBearing: .*qs\.Scene\("),
        (None, "not NoneType"),
    ],
)
def test_what_is_no_scene_is_refused_and_says_what_to_do(given: Any, words: str) -> None:
    with pytest.raises(TypeError, match=words):
        qs.solve(given)


def test_the_loosest_residual_leaves_the_digits_of_tables() -> None:
    scene = turning(9000.0, **COMBINED)
    for effects in (None, "auto"):
        loose, tight = (
            qs.solve(scene, effects=effects, residual_tolerance=asked) for asked in reversed(solver.RESIDUALS)
        )
        assert loose.inner.load == pytest.approx(tight.inner.load, rel=5e-6)
        assert loose.displacement == pytest.approx(tight.displacement, rel=5e-6)


def test_no_equilibrium_stays_one() -> None:
    solution = qs.solve(bare(3000.0, axial_load=-1000.0), effects="auto")
    assert solution.status == "no_equilibrium"


def test_taking_out_is_in_any_order() -> None:
    full = completed(bare(9000.0, **COMBINED))
    assert without(full, EFFECTS) == without(full, reversed(EFFECTS))
