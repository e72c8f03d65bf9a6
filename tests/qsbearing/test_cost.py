"""What accuracy costs: the ladder, the errors, the measuring, the record and the files."""

from __future__ import annotations

import csv
import itertools
import json
import re
from dataclasses import replace
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from hypothesis import given
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.cost import (
    answers,
    fidelity,
    figures,
    ladder,
    measuring,
    outputs,
    record,
    scaling,
    settings,
    situations,
    tables,
    thrust_estimate,
    tolerance,
)
from qsbearing.tables import text_of
from tests.benchmarks import cost as kept
from tests.benchmarks import random_scenes, truth

from .scenes import B218, CENTRIFUGAL, DEEP_GROOVE, SPINDLE, fewer, resting, solved, turning

COMBINED = {"axial_load": 17_800.0, "radial_load_y": 6_000.0, "moment_z": 0.0}
RUNG = {rung.name: rung for rung in ladder.LADDER}


def judged(simple: qs.Scene, full: qs.Scene) -> dict[str, Any]:
    """Errors of one scene's answers against another's."""
    return answers.errors(answers.read(simple, solved(simple)), answers.read(full, solved(full)))


# Ladder -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rung", "scene"),
    [
        ("static", resting(**COMBINED)),
        ("centrifugal", turning(9000, effects=CENTRIFUGAL, **COMBINED)),
        ("quasi_static", turning(9000, **COMBINED)),
        ("per_ball_control", turning(9000, control=qs.RacewayControl.PER_BALL, **COMBINED)),
        ("actual_angle", turning(9000, control=qs.RacewayControl.PER_BALL, hertz_angle="actual", **COMBINED)),
    ],
)
def test_a_rung_is_the_solver_at_that_fidelity(rung: str, scene: qs.Scene) -> None:
    assert RUNG[rung].of(turning(9000, control=qs.RacewayControl.INNER, **COMBINED)).hertz_form is qs.HertzForm.EXACT
    other = replace(scene, ball_effects=(), raceway_control=None, hertz_form=qs.HertzForm.HAMROCK_BREWE_1983)
    assert RUNG[rung].of(other) == scene
    assert answers.accuracy(judged(RUNG[rung].of(other), scene)) == 0.0


def test_a_scene_keeps_its_convention_of_sharing_the_moment() -> None:
    harris = (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))
    assert RUNG["quasi_static"].of(turning(9000, effects=harris, **COMBINED)).ball_effects == harris


def test_simplifying_adds_nothing_and_ends_with_the_scene_itself() -> None:
    for scene in random_scenes.batches(3, 60, 1):
        ways = ladder.ways(scene)
        assert ways[-1][1] == scene
        for place, (_, simple) in enumerate(ways):
            assert set(simple.ball_effects) <= set(scene.ball_effects)
            assert all(not ladder._same(simple, other) for _, other in ways[:place])
            kinds = simple.hertz_angle, simple.hertz_form, simple.raceway_control
            own = scene.hertz_angle, scene.hertz_form, scene.raceway_control
            simpler = qs.HertzAngle.FREE, qs.HertzForm.BREWE_HAMROCK_1977, qs.RacewayControl.OUTER
            assert all(
                now == named or now == less or (now is None and not simple.ball_effects)
                for now, named, less in zip(kinds, own, simpler, strict=True)
            )


def test_a_choice_that_is_no_simplification_stays() -> None:
    scene = replace(turning(3000, control=qs.RacewayControl.INNER, **COMBINED), hertz_angle=qs.HertzAngle.ZERO)
    for _, simple in ladder.ways(scene):
        assert simple.hertz_angle is qs.HertzAngle.ZERO
        assert simple.raceway_control in (None, qs.RacewayControl.INNER)


# Thrust estimate ----------------------------------------------------------------------------------------------------

thrust_scenes = st.builds(
    lambda bearing, angle, load: resting(
        replace(bearing, free_contact_angle=angle * qs.deg),
        axial_load=load * float(bearing.ball_diameter) ** 2 * 1e6,
    ),
    st.sampled_from([B218, SPINDLE, DEEP_GROOVE]),
    st.floats(0.0, 60.0),
    st.floats(1e-3, 100.0),
)


@given(thrust_scenes)
def test_the_thrust_estimate_is_the_static_rung_to_a_thousandth(scene: qs.Scene) -> None:
    """Three substitutions of a contraction by a third at most from a start that is right in both limits."""
    found = fidelity._answers(RUNG["thrust_estimate"], scene)
    assert found is not None
    static = RUNG["static_closed_form_hertz"].of(scene)
    errors = answers.errors(found, answers.read(static, solved(static)))
    given_ = {name: error for name, error in errors.items() if error is not None}
    assert set(given_) >= {"axial_displacement", "axial_stiffness", "inner_load", "outer_angle", "inner_max_pressure"}
    assert "radial_displacement" not in given_ and "tilt_stiffness" not in given_
    assert max(given_.values()) < 1e-3


@pytest.mark.parametrize(
    "operation",
    [COMBINED, {"axial_load": -100.0}, {"axial_displacement": 1e-5}, {"axial_load": 100.0, "tilt_z": 1e-4}, {}],
)
def test_other_loads_have_no_thrust_estimate(operation: dict[str, float]) -> None:
    assert thrust_estimate.thrust_estimate(resting(**operation)) is None


# Errors -------------------------------------------------------------------------------------------------------------


def test_an_answer_has_no_error_against_itself() -> None:
    for scene in random_scenes.batches(5, fewer(20, 3), 3):
        errors = judged(scene, scene)
        assert set(errors) == set(answers.NAMES)
        assert all(np.all(error == 0.0) for error in errors.values())


@pytest.mark.parametrize("name", answers.NAMES)
def test_a_changed_answer_shows_under_its_own_name_alone(name: str) -> None:
    scene = turning(9000, **COMBINED)
    full = answers.read(scene, solved(scene))
    changed = dict(full)
    own = full[name]
    assert own is not None
    largest = np.nanargmax(np.abs(own))
    changed[name] = own.copy()
    changed[name].flat[largest] *= 1.01  # type: ignore[union-attr]
    errors = answers.errors(changed, full)
    assert errors[name] > 1e-6
    assert all(error == 0.0 for other, error in errors.items() if other != name)
    if name.endswith(("load", "axis", "pressure")) and name != "ring_load":
        assert errors[name] == pytest.approx(0.01)


def test_a_ball_nearly_without_load_counts_with_its_load_alone() -> None:
    scene = resting(axial_load=8e3, radial_load_y=8e3, tilt_y=0.0, tilt_z=0.0)
    full = answers.read(scene, solved(scene))
    light = int(np.argmin(full["inner_load"]))  # type: ignore[arg-type]
    for name, counts in (("inner_load", True), ("inner_semi_major_axis", False), ("inner_max_pressure", False)):
        changed = dict(full)
        changed[name] = full[name].copy()  # type: ignore[union-attr]
        changed[name][light] += 0.01 * full[name].max()  # type: ignore[index, union-attr]
        assert (answers.errors(changed, full)[name] > 0.0) == counts


def test_what_has_no_number_is_an_infinite_error() -> None:
    scene = turning(9000, **COMBINED)
    full = answers.read(scene, solved(scene))
    lost = {name: None if array is None else np.full_like(array, np.nan) for name, array in full.items()}
    assert answers.accuracy(answers.errors(lost, full)) == np.inf


# Monotone where it should be ----------------------------------------------------------------------------------------


def test_each_ball_effect_brings_loads_angles_and_displacements_nearer_at_speed() -> None:
    """At spindle speed and above. Per-ball control comes to outer control there; below, a hypothesis is no error."""
    for name, scene in {place.name: place.scene for place in situations.situations(turning(9000, **COMBINED))}.items():
        if name not in ("spindle", "aero engine"):
            continue
        found = fidelity.errors(scene)
        for group in ("displacements", "loads and angles", "stiffness"):
            steps = [max(found[rung][one] for one in answers.GROUPS[group]) for rung in list(RUNG)[2:]]  # type: ignore[index, type-var]
            assert all(after <= before for before, after in itertools.pairwise(steps)), (name, group, steps)
            assert steps[0] > 2.0 * steps[1] > 2.0 * steps[2]  # type: ignore[operator]


def test_at_rest_the_ball_effects_change_nothing() -> None:
    found = fidelity.errors(situations.situations(turning(9000, **COMBINED))[0].scene)
    assert found["static"] == found["centrifugal"] == found["quasi_static"] == found["per_ball_control"]
    assert found["thrust_estimate"] is None
    assert set(found["actual_angle"].values()) == {0.0}  # type: ignore[union-attr]


def test_the_error_of_leaving_inertia_out_grows_with_the_square_of_the_speed() -> None:
    speeds = np.array([100.0, 200.0, 400.0])
    full = turning(speeds, **COMBINED)
    static = RUNG["static"].simplified(full)
    errors = judged(static, full)["inner_load"]
    slopes = np.diff(np.log(errors)) / np.log(2.0)
    assert slopes == pytest.approx([2.0, 2.0], abs=0.05)


@pytest.mark.parametrize("entry", tolerance.truth()["scenes"], ids=lambda entry: entry["name"])
def test_a_tighter_tolerance_is_no_worse(entry: dict[str, Any]) -> None:
    """Up to rounding: 1e-13 is some hundred units of it, what a displacement found from loads may carry."""
    scene = tolerance.scene_of(entry)
    for start in tolerance.starts(scene).values():
        errors = [
            tolerance.error(solved(scene, start=start, tolerance=tight), entry) for tight in tolerance.TOLERANCES[::2]
        ]
        assert all(after <= before or after < 1e-13 for before, after in itertools.pairwise(errors)), errors
        assert errors[0] > 1e-7  # a loose tolerance is felt
        assert errors[-1] < 1e-13


def test_the_ladder_of_tolerances_is_climbed() -> None:
    for start in tolerance._errors(tolerance.truth()["scenes"][2])["starts"]:
        steps = start["steps"]
        assert [step["tolerance"] for step in steps] == list(tolerance.TOLERANCES)
        assert steps[0]["error"] > 1e6 * steps[-1]["error"]
        assert steps[0]["iterations"] < steps[-1]["iterations"]
        assert all(step["residual"] <= step["tolerance"] for step in steps)


# Measuring ----------------------------------------------------------------------------------------------------------


class Clock:
    """A clock that stands still but for what the tasks take."""

    def __init__(self) -> None:
        self.now = 0.0
        self.calls: list[str] = []

    def task(self, name: str, seconds: list[float]) -> Any:
        def run() -> None:
            self.calls.append(name)
            self.now += seconds[min(len(self.calls), len(seconds)) - 1]

        return run

    def perf_counter(self) -> float:
        return self.now


def test_tasks_are_timed_in_turn_and_ratios_outlive_a_drift(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr(measuring, "time", clock)
    drift = [2.0 + 0.3 * k for k in range(100)]
    tasks = {"one": clock.task("one", drift), "two": clock.task("two", [3.0 * value for value in drift])}
    found = measuring.interleaved(tasks, 6)
    assert "".join(name[0] for name in clock.calls) == "ot" + "ototot" + "tototo"
    assert len(found["one"]) == len(found["two"]) == 6
    assert max(found["one"]) > 1.5 * min(found["one"])
    ratio = measuring.ratio(found, "two", "one")
    assert 2.5 < ratio["low"] <= ratio["median"] <= ratio["high"] < 3.5


def test_short_tasks_are_repeated_and_an_interruption_drops_out(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr(measuring, "time", clock)
    calls = [1e-4] * 1000
    calls[7] = 1.0  # another program's turn
    (seconds,) = measuring.interleaved({"short": clock.task("short", calls)}, 3).values()
    assert seconds == pytest.approx([1e-4] * 3, rel=1e-6)


@given(st.lists(st.floats(1e-9, 1e3), min_size=1, max_size=60))
def test_a_spread_holds_its_median(values: list[float]) -> None:
    found = measuring.spread(values)
    assert min(values) * 0.999 <= found["low"] <= found["median"] <= found["high"] <= max(values) * 1.001
    assert measuring.agrees(found, found)
    assert not measuring.agrees(found, {"median": 1.1 * found["high"]})


def test_a_fresh_process_knows_only_its_own_memory() -> None:
    hoard = np.ones(30_000_000)
    (fresh,) = measuring.in_fresh_processes(measuring.peak_MB, processes=1)
    assert hoard.nbytes / 2**20 > 200.0
    assert 10.0 < fresh < 200.0 < measuring.peak_MB()


# Situations and scaling ---------------------------------------------------------------------------------------------


def test_situations_stand_at_the_speeds_they_name() -> None:
    found = situations.situations(turning(10_000, **COMBINED))
    assert [place.name for place in found] == [*(name for name, _ in situations.SPEEDS), situations.OWN]
    assert [situations.dm_n(place.scene) for place in found] == pytest.approx([0.0, 1e5, 1e6, 2.5e6, 1.2526e6])
    assert len(situations.situations(turning(0, **COMBINED))) == len(situations.SPEEDS)


@given(st.integers(1, 300))
def test_a_batch_stays_around_its_scene_and_repeats_nothing(count: int) -> None:
    batch = situations.many(turning(10_000, **COMBINED), count)
    loads = np.asarray(batch.operation.axial_load) / COMBINED["axial_load"] - 1.0
    speeds = np.asarray(batch.operation.speed)
    assert loads.shape == speeds.shape == (count,)
    assert np.abs(loads).max() <= situations.VARIED
    assert len(set(loads)) == count
    assert batch.operation.moment_z == 0.0


def test_more_balls_carry_the_same_each() -> None:
    """At rest, where only the larger circle's curvature makes a difference."""
    scene = resting(**COMBINED)
    few, many = (solved(scaling.with_balls(scene, count)) for count in (32, 128))
    assert scaling.with_balls(scene, 16).bearing == scene.bearing
    assert few.inner.load.mean() == pytest.approx(many.inner.load.mean(), rel=0.02)
    assert few.inner.load.max() == pytest.approx(many.inner.load.max(), rel=0.02)


# Record, tables, pictures, files ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def full_record() -> dict[str, Any]:
    return kept.load("b218_combined")


def test_the_truth_is_the_references() -> None:
    assert truth.TRUTH.read_text(encoding="utf-8") == truth.text()


def test_the_readme_shows_the_record(full_record: dict[str, Any]) -> None:
    readme = kept.README.read_text(encoding="utf-8")
    assert kept.filled(readme, full_record) == readme
    for picture in (kept.PICTURES / f"b218_combined-{name}.png" for name in figures.PICTURES):
        assert picture.is_file()


@pytest.mark.parametrize("name", list(kept.SCENES))
def test_the_kept_errors_are_the_models(name: str) -> None:
    """Times belong to the machine that took them; errors must be those of today's model, to the digits kept."""
    scene = qs.load_scene(kept.SCENES[name][0])
    for place, entry in zip(situations.situations(scene), kept.load(name)["fidelity"], strict=True):
        found = fidelity.errors(place.scene)
        for rung in entry["rungs"]:
            now = found[rung["rung"]]
            assert (now is None) == (rung["errors"] is None)
            if now is not None:
                # a part in a thousand, or what rounding leaves of a residual of 1e-12 in the softest stiffness
                assert rung["errors"] == pytest.approx(now, rel=1e-3, abs=1e-8)


def test_the_report_fits_a_terminal_and_names_every_rung(full_record: dict[str, Any]) -> None:
    text = text_of(tables.report(full_record), 80)
    assert max(map(len, text.splitlines())) <= 80
    # No number is cut: those of a narrow terminal are those of a wide one.
    numbers = re.compile(r"(?<![\w.])\d[\d.,e-]*")
    assert sorted(numbers.findall(text)) == sorted(numbers.findall(text_of(tables.report(full_record), 200)))
    for words in ("static, exact Hertz", "continued", "balls in the bearing", "threads", "aero engine"):
        assert words in text


@pytest.mark.parametrize(
    ("error", "shown"),
    [(0.0, "0"), (None, "-"), (2.5, "2.5"), (0.123, "0.12"), (0.0456, "4.6e-2"), (9.97e-5, "1.0e-4")],
)
def test_errors_are_short(error: float | None, shown: str) -> None:
    assert tables._error(error) == shown


def test_csv_holds_every_point(full_record: dict[str, Any]) -> None:
    rows = list(csv.DictReader(StringIO(tables.csv_text(full_record, "fidelity"))))
    assert len(rows) == len(full_record["fidelity"]) * len(ladder.LADDER)
    chosen = next(row for row in rows if row["situation"] == "spindle" and row["rung"] == "static")
    entry = next(rung for rung in full_record["fidelity"][2]["rungs"] if rung["rung"] == "static")
    assert float(chosen["one_case_s_high"]) == entry["one_case_s"]["high"]
    assert float(chosen["error_inner_load"]) == entry["errors"]["inner_load"]
    steps = list(csv.DictReader(StringIO(tables.csv_text(full_record, "tolerance"))))
    assert len(steps) == 5 * len(tolerance.STARTS) * len(tolerance.TOLERANCES)
    assert {row["by"] for row in csv.DictReader(StringIO(tables.csv_text(full_record, "scaling")))} == {
        "cases",
        "balls",
        "threads",
        "processes",
    }


def test_the_folder_is_filled_whole(tmp_path: Path, full_record: dict[str, Any]) -> None:
    with outputs.OutputFolder(str(tmp_path / "new")) as folder:
        folder.fill(full_record)
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == sorted(outputs.FILES)
    assert json.loads((tmp_path / "new" / "cost.json").read_text()) == full_record
    for name in figures.PICTURES:
        assert (tmp_path / "new" / f"{name}.png").read_bytes().startswith(b"\x89PNG")


def test_a_folder_that_is_not_filled_leaves_nothing(tmp_path: Path, full_record: dict[str, Any]) -> None:
    broken = {key: value for key, value in full_record.items() if key != "scaling"}
    with pytest.raises(KeyError), outputs.OutputFolder(str(tmp_path / "new")) as folder:
        folder.fill(broken)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "old").mkdir()
    with outputs.OutputFolder(str(tmp_path / "old")):
        pass
    assert list((tmp_path / "old").iterdir()) == []


def call(*arguments: str | Path) -> Result:
    """One command in this process; anything but a clean exit is an error."""
    result = CliRunner().invoke(cli, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
    return result


def test_a_place_that_cannot_be_filled_is_refused_before_any_work(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    (tmp_path / "taken" / "cost.json").mkdir(parents=True)
    for target, words in (
        (tmp_path / "none" / "new", "there is no folder"),
        (file, "is a file"),
        (tmp_path / "taken", "cost.json: is a folder"),
    ):
        result = call("cost", "b218", "--out", target)
        assert (result.exit_code, result.stdout) == (2, "")
        assert words in result.stderr
    assert file.read_text() == "mine"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "taken"]
    result = call("cost", "no such bearing", "--out", tmp_path / "new")
    assert result.exit_code == 2
    assert not (tmp_path / "new").exists()


def test_a_scene_without_solution_has_no_cost(tmp_path: Path) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text('[bearing]\nname = "B218"\n[operation]\naxial_load_N = -1000\n')
    result = call("cost", scene, "--out", tmp_path / "new")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "axial" in result.stderr
    assert not (tmp_path / "new").exists()


@pytest.mark.heavy
def test_the_command_measures_and_writes(tmp_path: Path) -> None:
    result = call("cost", "b218", "--quick", "--json", "--out", tmp_path / "new")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["settings"]["rounds"] == settings.QUICK.rounds
    assert found == json.loads((tmp_path / "new" / "cost.json").read_text())
    for place in found["fidelity"]:
        for rung in place["rungs"]:
            assert rung["one_case_s"]["median"] > 0.0
            assert rung["memory_MB"]["median"] > 10.0
    assert {worker["kind"] for worker in found["scaling"]["workers"]} == {"threads", "processes"}


@pytest.mark.heavy
def test_progress_is_told_as_often_as_announced() -> None:
    told: list[str] = []
    tiny = replace(settings.QUICK, rounds=1, batch=2, sizes=(1, 2), ball_counts=(4,), shared=4)
    found = record.measure(turning(8000, **COMBINED), tiny, told.append)
    assert len(told) == record.steps(tiny)
    assert set(record.PARTS) < set(found)
