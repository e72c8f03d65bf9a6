"""What accuracy costs: the model levels, the errors, the measuring, the record and the files."""

from __future__ import annotations

import copy
import itertools
import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given
from hypothesis import strategies as st

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents.terminal import text_of
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.solution import comparison as results
from qsbearing.studies.cost import accuracy_table, figures, measuring, record, speeds, tables
from tests.cli.command import call
from tests.qsbearing.scenes import CENTRIFUGAL, PER_BALL, resting, solved, turning
from tests.verification.benchmarks import cost as kept
from tests.verification.benchmarks import random_scenes

COMBINED = {"axial_load": 17_800.0, "radial_load_y": 6_000.0, "moment_z": 0.0}
LEVEL = {level.name: level for level in record.LEVELS}
JUDGED = [name for names in results.GROUPS.values() for name in names]


def displaced(scene: qs.Scene) -> qs.Scene:
    """The scene with each ball on its own orbit."""
    return replace(scene, orbit_radius=qs.OrbitRadius.DISPLACED)


def judged(simple: qs.Scene, full: qs.Scene) -> dict[str, Any]:
    """Errors of one scene's results against another's."""
    return results.errors(results.read(solved(simple)), results.read(solved(full)))


# Model levels -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("level", "scene"),
    [
        ("tilt_lever", resting(**COMBINED)),
        ("centrifugal_force", turning(9000, effects=CENTRIFUGAL, control=PER_BALL, **COMBINED)),
        ("gyroscopic_moment", turning(9000, control=PER_BALL, **COMBINED)),
        ("hertz_angle", turning(9000, control=PER_BALL, hertz_angle="actual", **COMBINED)),
        ("orbit_radius", displaced(turning(9000, control=PER_BALL, hertz_angle="actual", **COMBINED))),
    ],
)
def test_a_level_has_its_own_effects_and_choices(level: str, scene: qs.Scene) -> None:
    static = {"ball_effects": (), "raceway_control": None, "orbit_radius": "pitch_circle"}
    other = replace(scene, **static, hertz_form=qs.HertzForm.HAMROCK_BREWE_1983)
    assert LEVEL[level].of(other) == scene


def test_every_level_is_finer_than_the_one_before() -> None:
    scene = turning(9000, **COMBINED)
    found = [level.of(scene) for level in record.LEVELS]
    assert all(one != other for one, other in itertools.pairwise(found))
    assert [level.name for level in record.LEVELS[1:]] == [
        entry.name for entry in EFFECTS if not entry.needs and not entry.hypothesis
    ]


# Errors -------------------------------------------------------------------------------------------------------------


def test_a_result_has_no_error_against_itself() -> None:
    for scene in random_scenes.batches(5, 4, 3):
        errors = judged(scene, scene)
        assert set(errors) == set(JUDGED)
        assert all(np.all(error == 0.0) for error in errors.values())


@pytest.mark.parametrize("name", JUDGED)
def test_a_changed_result_shows_under_its_own_name_alone(name: str) -> None:
    scene = turning(9000, **COMBINED)
    full = results.read(solved(scene))
    changed = full | {name: full[name].copy()}
    changed[name].flat[np.nanargmax(np.abs(full[name]))] *= 1.01
    errors = results.errors(changed, full)
    assert errors[name] > 1e-6
    assert all(error == 0.0 for other, error in errors.items() if other != name)
    if name.endswith(("load", "axis", "pressure")) and name != "ring_load":
        assert errors[name] == pytest.approx(0.01)


def test_a_ball_nearly_without_load_counts_with_its_load_alone() -> None:
    scene = resting(axial_load=8e3, radial_load_y=8e3, tilt_y=0.0, tilt_z=0.0)
    full = results.read(solved(scene))
    light = int(np.argmin(full["inner_load"]))
    for name, counts in (("inner_load", True), ("inner_semi_major_axis", False), ("inner_max_pressure", False)):
        changed = full | {name: full[name].copy()}
        changed[name][light] += 0.01 * full[name].max()
        assert (results.errors(changed, full)[name] > 0.0) == counts


def test_what_has_no_number_is_an_infinite_error() -> None:
    scene = turning(9000, **COMBINED)
    full = results.read(solved(scene))
    lost = {name: np.full_like(array, np.nan) for name, array in full.items()}
    errors = results.errors(lost, full)
    assert all(np.isinf(errors[name]) for name in JUDGED)


def test_a_case_that_one_alone_solves_is_an_infinite_error() -> None:
    loads = np.array([8e3, -8e3])
    one, other = (qs.solve(resting(axial_load=load)) for load in (loads, -loads))
    assert results.largest(one, one) == pytest.approx([0.0, 0.0], abs=0.0)
    assert np.isinf(results.largest(one, other)).all()


BALL_EFFECTS = ("tilt_lever", "centrifugal_force", "gyroscopic_moment")
"""The levels before them, with one and with both."""

# Monotone where it should be ----------------------------------------------------------------------------------------


def test_each_ball_effect_brings_every_group_nearer_at_speed() -> None:
    """At spindle speed and above, one after the other. Below they hardly matter, and may make up for each other."""
    rows = record.errors(turning(9000, **COMBINED))
    for speed, group in itertools.product(("spindle", "aero engine"), QUANTITIES):
        steps = [tables.select(rows, speed=speed, level=level)[0][group] for level in BALL_EFFECTS]
        assert all(after <= before for before, after in itertools.pairwise(steps)), (speed, group, steps)


def test_at_rest_the_ball_effects_change_nothing() -> None:
    rows = {row["level"]: row for row in tables.select(record.errors(turning(9000, **COMBINED)), speed="rest")}
    groups = {level: tuple(rows[level][group] for group in QUANTITIES) for level in LEVEL}
    assert groups["tilt_lever"] == groups["centrifugal_force"] == groups["gyroscopic_moment"]
    assert set(groups["hertz_angle"]) == set(groups["orbit_radius"]) == {0.0}


def test_the_error_of_leaving_inertia_out_grows_with_the_square_of_the_speed() -> None:
    full = turning(np.array([100.0, 200.0, 400.0]), **COMBINED)
    errors = judged(replace(full, ball_effects=(), raceway_control=None), full)["inner_load"]
    assert np.diff(np.log2(errors)) == pytest.approx([2.0, 2.0], abs=0.05)


# Measuring ----------------------------------------------------------------------------------------------------------


class Clock:
    """A clock that stands still but for what the calls take."""

    def __init__(self) -> None:
        self.seconds = 0.0
        self.calls: list[str] = []

    def call(self, name: str, seconds: list[float]) -> Any:
        def run() -> None:
            self.calls.append(name)
            self.seconds += seconds[min(len(self.calls), len(seconds)) - 1]

        return run

    def now(self) -> float:
        return self.seconds


def test_calls_are_timed_in_turn_and_ratios_outlive_a_drift(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr(measuring, "now", clock.now)
    monkeypatch.setattr(measuring.gc, "collect", int)
    drift = [2.0 + 0.3 * k for k in range(100)]
    calls = {"one": clock.call("one", drift), "two": clock.call("two", [3.0 * value for value in drift])}
    found = measuring.interleaved(calls, 6)
    assert "".join(name[0] for name in clock.calls) == "oott" + "ototot" + "tototo"
    assert len(found["one"]) == len(found["two"]) == 6
    assert max(found["one"]) > 1.5 * min(found["one"])
    ratio = measuring.ratio(found, "two", "one")
    assert 2.5 < ratio["low"] <= ratio["median"] <= ratio["high"] < 3.5


def test_short_calls_are_repeated_and_neither_a_cold_start_nor_an_interruption_counts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    clock = Clock()
    monkeypatch.setattr(measuring, "now", clock.now)
    monkeypatch.setattr(measuring.gc, "collect", int)
    seconds = [1e-4] * 1000
    seconds[0] = 5.0  # machine code is loaded
    seconds[7] = 1.0  # another program's turn
    (found,) = measuring.interleaved({"short": clock.call("short", seconds)}, 3).values()
    assert found == pytest.approx([1e-4] * 3, rel=1e-6)


@given(st.lists(st.floats(1e-9, 1e3), min_size=1, max_size=60))
def test_a_spread_holds_its_median(values: list[float]) -> None:
    found = measuring.spread(values)
    assert min(values) * 0.999 <= found["low"] <= found["median"] <= found["high"] <= max(values) * 1.001


def test_a_fresh_process_knows_only_its_own_memory() -> None:
    hoard = np.ones(30_000_000)
    fresh = measuring.in_fresh_process(measuring.peak_MB)
    assert hoard.nbytes / 2**20 > 200.0
    assert 10.0 < fresh < 200.0 < measuring.peak_MB()


# Speeds and batches -------------------------------------------------------------------------------------------------


def test_scenes_stand_at_the_speeds_they_name() -> None:
    scene = turning(10_000, **COMBINED)
    names, swept = speeds.along_speeds(scene)
    found = dict(zip(names, speeds.dm_n(swept), strict=True))
    assert [found[name] for name in (*speeds.NAMED, speeds.OWN)] == pytest.approx([*speeds.NAMED.values(), 1.2526e6])
    own = replace(scene, operation=replace(scene.operation, speed=0.0, outer_speed=-500.0))
    _, swept = speeds.along_speeds(own)
    assert list(np.asarray(swept.operation.outer_speed)) == [0.0] * (len(names) - 1) + [-500.0]


@given(st.integers(2, 300))
def test_a_batch_stays_around_its_scene_and_repeats_nothing(count: int) -> None:
    batch = speeds.batch(turning(10_000, **COMBINED), count)
    loads = np.asarray(batch.operation.axial_load) / COMBINED["axial_load"] - 1.0
    assert loads.shape == np.asarray(batch.operation.speed).shape == (count,)
    assert np.abs(loads).max() <= speeds.VARIED
    assert len(set(loads)) == count
    assert batch.operation.moment_z == 0.0


# Record, tables, pictures, files ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def full_record() -> dict[str, Any]:
    return kept.load()


def test_the_table_has_a_line_for_every_level_and_each_picture_is_kept(full_record: dict[str, Any]) -> None:
    shown = kept.table(full_record)
    assert all(level.text in shown for level in tables.levels_of(full_record))
    for name in figures.PICTURES:
        assert (kept.PICTURES / f"b218_combined-{name}.png").is_file()


def test_the_kept_errors_are_the_models(full_record: dict[str, Any]) -> None:
    """Times belong to the machine that took them; errors must be those of today's model, to the digits kept."""
    found = record.errors(qs.load_scene(kept.SCENE), tuple(tables.levels_of(full_record)))
    assert [row["level"] for row in found] == [row["level"] for row in full_record["errors"]]
    for now, before in zip(found, full_record["errors"], strict=True):
        for group in QUANTITIES:
            # a part in a thousand, or what rounding leaves of a residual of 1e-12 in the softest stiffness
            assert now[group] == pytest.approx(before[group], rel=1e-3, abs=1e-8)


def test_the_report_fits_a_terminal_and_names_every_level(full_record: dict[str, Any]) -> None:
    shown = text_of(tables.report(full_record), 80)
    assert max(map(len, shown.splitlines())) <= 80
    # No number is cut: those of a narrow terminal are those of a wide one.
    numbers = re.compile(r"(?<![\w.])\d[\d.,e-]*")
    assert sorted(numbers.findall(shown)) == sorted(numbers.findall(text_of(tables.report(full_record), 200)))
    for name in ("centrifugal force", "Scaling", "aero engine"):
        assert name in shown


@pytest.mark.parametrize(
    ("error", "shown"),
    [(0.0, "0"), (None, "-"), (2.5, "2.5"), (0.123, "0.12"), (9.97e-5, "0.0001"), (1.6e-12, "1.6e-12")],
)
def test_errors_are_short(error: float | None, shown: str) -> None:
    assert tables.short(error) == shown


def test_an_error_of_zero_is_drawn_at_zero_and_the_others_in_their_decades(full_record: dict[str, Any]) -> None:
    """A logarithmic axis has no place for 0: it becomes linear below the smallest error."""
    for axes in figures.levels(full_record).axes:
        heights = [float(line.get_ydata()[0]) for line in axes.lines if len(line.get_xdata()) == 1]  # type: ignore[index]
        smallest = min(height for height in heights if height > 0.0)
        assert 0.0 in heights
        assert axes.get_ylim()[0] <= 0.0
        transform = axes.yaxis.get_transform()
        assert transform.linthresh <= smallest  # type: ignore[attr-defined]


@pytest.fixture
def measured(monkeypatch: pytest.MonkeyPatch, full_record: dict[str, Any]) -> dict[str, Any]:
    """A record of `qsbearing cost` that takes no time, and that a test may break."""
    found = copy.deepcopy(full_record)
    monkeypatch.setattr(record, "measure", lambda *given: found)
    return found


# One scene, at a glance ----------------------------------------------------------------------------------------------


def at_a_glance(scene: qs.Scene, seconds: float, monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """The table of a scene on a clock of its own, by which every case takes so many seconds."""
    clock = Clock()
    true_solve = record.solve_one

    def solved_in_time(of: qs.Scene, threads: int | None = None) -> Any:
        cases = np.size(of.operation.axial_load)
        clock.seconds += seconds * cases
        return true_solve(of, threads) if cases == 1 else None

    monkeypatch.setattr(measuring, "now", clock.now)
    monkeypatch.setattr(accuracy_table, "solve_one", solved_in_time)
    found = accuracy_table.measure(scene)
    assert clock.seconds <= accuracy_table.BUDGET
    return found


def test_own_errors_are_those_against_the_full_model() -> None:
    warm = qs.RingExpansion(0.09, 0.16, inner_ring_temperature=350.0)
    scene = replace(turning(9000, **COMBINED), ring_effects=(warm,))
    listed = accuracy_table.levels(scene)
    assert "ring_expansion" in [name for name, _, _ in listed]
    found = accuracy_table.measure(scene)
    (own,) = (row for row in found["levels"] if row["is_asked"])
    expected = results.by_quantity(qs.solve(scene), qs.solve(listed[-1][2]))
    assert own["errors"] == {name: pytest.approx(float(expected[name]), rel=1e-3) for name in QUANTITIES}
    assert set(found["levels"][-1]["errors"].values()) == {0.0}


def test_times_are_measured_as_far_as_ten_seconds_go_and_the_rest_is_marked(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = turning(9000, **COMBINED)
    fast = at_a_glance(scene, 1e-5, monkeypatch)
    assert [cost["measured"] for cost in fast["levels"][0]["costs"]] == [True, True, False]
    slow = at_a_glance(scene, 2e-2, monkeypatch)
    (_, thousand, million) = slow["levels"][0]["costs"]
    assert (thousand["measured"], million["measured"]) == (False, False)
    assert (thousand["seconds"], million["seconds"]) == pytest.approx((20.0, 20_000.0), rel=1e-3)
    shown = text_of(accuracy_table.blocks(slow), 80)
    assert "5.6 h*" in shown and "20 s*" in shown and "20 ms" in shown
    assert max(map(len, shown.splitlines())) <= 80


def test_a_scene_that_is_no_level_has_a_line_of_its_own() -> None:
    scene = replace(turning(9000, **COMBINED), hertz_form=qs.HertzForm.HAMROCK_BREWE_1983)
    rows = accuracy_table.levels(scene)
    assert rows[0] == ("as_given", "the scene as it is", scene)
    assert len(rows) == len(accuracy_table.levels(rows[1][2])) + 1


def test_finite_elements_are_their_record_and_are_not_imported() -> None:
    kept_record = json.loads((Path(qs.__file__).parents[1] / "fem_check/records/cost/release.json").read_text())
    least = min(mesh["worst_error"] for mesh in kept_record["meshes"])
    found = accuracy_table.elements()
    assert found is not None
    assert found["error"] == pytest.approx(least, rel=1e-3)
    assert found["seconds"] in [mesh["seconds"]["median"] for mesh in kept_record["meshes"]]
    code = "import sys, qsbearing.studies.cost.accuracy_table as a; a.elements(); print('fem_check' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"


def test_the_command_shows_the_table_its_json_and_its_picture(tmp_path: Path, drawn: None) -> None:
    result = call("cost", "b218", "--out", tmp_path / "new")
    assert result.exit_code == 0
    assert "moment of the balls ←" in " ".join(result.stdout.split())
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == ["accuracy.png", "cost.json"]
    found = json.loads((tmp_path / "new" / "cost.json").read_text())
    assert found["kind"] == "qsbearing cost, one scene"
    assert found["provenance"]["command"] == "qsbearing cost b218"


def test_the_folder_is_filled_whole(tmp_path: Path, measured: dict[str, Any], drawn: None) -> None:
    assert call("cost", "b218", "--thorough", "--out", tmp_path / "new").exit_code == 0
    pictures = [f"{name}.png" for name in figures.PICTURES]
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == sorted(["cost.json", *pictures])
    assert json.loads((tmp_path / "new" / "cost.json").read_text()) == measured
    for name in pictures:
        assert (tmp_path / "new" / name).read_bytes().startswith(b"\x89PNG")


def test_a_folder_that_is_not_filled_keeps_no_file(tmp_path: Path, measured: dict[str, Any]) -> None:
    del measured["errors"]
    result = CliRunner().invoke(cli, ["cost", "b218", "--thorough", "--json", "--out", str(tmp_path / "new")])
    assert isinstance(result.exception, KeyError)
    assert list((tmp_path / "new").iterdir()) == []


def test_a_place_that_cannot_be_filled_is_refused_before_any_work(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("mine")
    (tmp_path / "taken" / "cost.json").mkdir(parents=True)
    for target, said in (
        (file / "new", "cannot be a folder"),
        (file, "cannot be a folder"),
        (tmp_path / "taken", "cost.json: is a folder"),
    ):
        result = call("cost", "b218", "--out", target)
        assert (result.exit_code, result.stdout) == (2, "")
        assert said in result.stderr
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


TINY = record.Settings(rounds=1, processes=1, batch=2, sizes=(1, 2))


def test_all_is_measured_and_progress_told_as_often_as_announced(monkeypatch: pytest.MonkeyPatch) -> None:
    """In this process: fresh ones are another test's."""
    monkeypatch.setattr(measuring, "in_fresh_process", lambda function, *arguments: function(*arguments))
    told: list[str] = []
    found = record.measure(turning(8000, **COMBINED), TINY, told.append)
    assert len(told) == record.steps(TINY)
    assert len(found["measured"]) == 2 * len(record.LEVELS) + 2
    for row in found["measured"]:
        assert 0.0 < row["case_s"]["low"] <= row["case_s"]["median"] <= row["case_s"]["high"]
        assert (row["memory_MB"] is None) == (row["part"] != "cases")
        assert (row["error"] is None) == (row["part"] == "cases")
    # The last of a series is what the others are compared with.
    for cases in (1, 2):
        last = tables.select(found["measured"], part="levels", cases=cases)[-1]
        assert (last["error"], last["over_last"]["median"]) == (0.0, 1.0)


@pytest.mark.heavy
def test_the_command_measures_and_writes(tmp_path: Path) -> None:
    result = call("cost", "b218", "--quick", "--json", "--out", tmp_path / "new")
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["settings"]["rounds"] == record.QUICK.rounds
    assert found == json.loads((tmp_path / "new" / "cost.json").read_text())
