"""`qsbearing explain`, the warning of a plain run, and files that leave the effects to be chosen."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.effects.changed_geometry import GeometryChange, geometry_errors
from qsbearing.model.solution.comparison import by_quantity
from qsbearing.model.solution.judgement import estimated, judge, shifted
from qsbearing.remarks.missing_effects import MOST_CASES
from qsbearing.studies.chooser import explain as explaining
from qsbearing.studies.chooser.explain import explain
from tests.cli.command import call
from tests.qsbearing.scenes import resting, solved, turning

TRAP = """[bearing]
name = "B218"
[operation]
speed_rpm = 15000
axial_load_N = 17800
"""
"""A designer who has forgotten the effects, at dm n = 1.9e6."""


@pytest.fixture
def trap(tmp_path: Path) -> Path:
    path = tmp_path / "trap.toml"
    path.write_text(TRAP)
    return path


def rows(path: Path, *options: str) -> dict[str, dict[str, Any]]:
    result = call("explain", path, "--json", *options)
    assert result.exit_code == 0
    return {row["effect"]: row for row in json.loads(result.stdout)["effects"]}


# Explain --------------------------------------------------------------------------------------------------------------


def test_every_entry_is_explained(trap: Path) -> None:
    found = rows(trap)
    assert list(found) == [entry.name for entry in EFFECTS]
    for row in found.values():
        assert row["verdict"] in ("needed", "not needed", "likely needed, data missing", "not assessed")
        assert row["verdict"] != "not assessed" or row["why"]


def test_what_is_shown_is_what_two_solves_differ_by_and_not_a_prediction(trap: Path) -> None:
    """The displacement without gyroscopic moment and actual angles: not what indicators expect of it."""
    scene = qs.load_scene(trap)
    row = rows(trap)["centrifugal_force"]
    assert (row["in_scene"], row["verdict"]) == (False, "needed")
    assert row["add"] == ['ball = ["centrifugal_force"]', 'raceway_control = "per_ball"']
    full = replace(scene, ball_effects=(qs.CentrifugalForce(),), raceway_control=qs.RacewayControl.PER_BALL)
    found = {name: float(change) for name, change in by_quantity(solved(scene), solved(full)).items()}
    assert row["actual"] == pytest.approx(found, rel=1e-12)
    assert found["stiffness"] > 4.0  # wrong by a factor of five
    (line,) = [line for line in call("explain", trap).stdout.splitlines() if re.match("centrifugal_force +no", line)]
    shown = line.split()[2 : 2 + len(found)]
    expected = {name: 100.0 * change for name, change in found.items()}
    expected["displacement"] = np.max(np.abs(solved(scene).displacement - solved(full).displacement)[:3]) / qs.um
    assert [float(each) for each in shown] == pytest.approx(list(expected.values()), rel=0.05)
    for name in ("contact_angle", "load", "pressure", "stiffness"):
        assert 0.5 < row["predicted"][name] / found[name] < 2.0, name


def test_only_what_rests_on_usual_parameters_is_marked_so(trap: Path) -> None:
    """In two digits; of elastic rings from those in a housing to free ones, below each other."""
    lines = call("explain", trap).stdout.splitlines()
    assert [line.split()[0] for line in lines[1:] if "≈" in line] == ["ring_expansion", "elastic_rings"]
    (place,) = [number for number, line in enumerate(lines) if line.startswith("elastic_rings  ")]
    for found, link in ((lines[place], "≈"), (lines[place + 1], "to")):
        assert len(re.findall(rf"{link} [\d.]+(?= )", found)) == len(QUANTITIES)
    (row,) = (row for row in explain(qs.load_scene(trap), 0.01)[1] if row.effect == "elastic_rings")
    assert [each["under"] for each in row.assumed] == ["steel housing", "free"]
    first, last = (each["displacement_um"] for each in row.assumed)
    assert row.change("displacement") == f"≈ {first:.2g}\nto {last:.2g}"
    first, last = (each["actual"]["load"] for each in row.assumed)
    assert row.change("load") == f"≈ {100 * first:.2g}\nto {100 * last:.2g}"
    row.assumed[1]["actual"]["load"] = 1.01
    assert row.change("load") == f"≈ {100 * first:.2g}\nto > 100"


def test_what_indicators_predict_is_said_in_one_digit() -> None:
    assert estimated(0.0123) == "≈ 1 %"
    assert [estimated(error) for error in (0.00123, 0.178, 3.6)] == ["≈ 0.1 %", "≈ 20 %", "> 100 %"]


def test_a_scene_that_takes_long_is_solved_no_more_than_it_must_be(monkeypatch: pytest.MonkeyPatch) -> None:
    solves = []

    def slow(scene: qs.Scene, **how: Any) -> qs.Solution:
        solves.append(scene)
        solution = qs.solve(scene)
        solution.seconds = 1.0
        return solution

    monkeypatch.setattr(explaining, "solve", slow)
    _, found = explain(FAST_SPINDLE, 0.01)
    assert len(solves) == 2 * 3 * sum(row.actual is not None for row in found), "the scene as it is, beside"


def test_the_lines_to_add_are_what_they_say(trap: Path) -> None:
    for name in ("centrifugal_force", "gyroscopic_moment", "hertz_angle"):
        lines = rows(trap)[name]["add"]
        trap.write_text(TRAP + "[effects]\n" + "\n".join(lines) + "\n")
        assert rows(trap)[name]["in_scene"]
        trap.write_text(TRAP)


def test_an_effect_is_predicted_alike_whether_the_scene_has_it_or_not() -> None:
    """From the solution without it and from that with it; they part as errors grow."""
    loads = {"axial_load": 17_800.0}
    without = resting(**loads)
    without = qs.Scene(without.bearing, qs.Operation(speed=3000 * qs.rpm, **loads))
    with_it = turning(3000.0, effects=(qs.CentrifugalForce(),), **loads)
    one, other = (
        next(row for row in explain(scene, 0.01)[1] if row.effect == "centrifugal_force")
        for scene in (without, with_it)
    )
    assert (one.in_scene, other.in_scene) == (False, True)
    assert one.predicted is not None
    for name in QUANTITIES:
        assert other.predicted == pytest.approx(one.predicted, rel=0.1), name


def test_at_rest_inertia_is_not_needed_and_says_so_of_a_ball_without_load_too(tmp_path: Path) -> None:
    path = tmp_path / "rest.toml"
    path.write_text(TRAP.replace("15000", "0") + "radial_load_y_N = 20000\ntilt_z_mrad = 0\n")
    found = rows(path)
    for name in ("centrifugal_force", "gyroscopic_moment"):
        assert (found[name]["indicator"], found[name]["verdict"]) == (0.0, "not needed")


def test_light_balls_are_assessed_though_no_prediction_holds_of_them(tmp_path: Path) -> None:
    path = tmp_path / "light.toml"
    path.write_text(TRAP.replace("15000", "100") + "radial_load_y_N = 20000\ntilt_z_mrad = 0\n")
    assert rows(path)["centrifugal_force"]["verdict"] in ("needed", "not needed")


def test_without_any_load_inertia_is_needed(tmp_path: Path) -> None:
    """Nothing to compare the centrifugal force with, so that it is all that there is."""
    path = tmp_path / "idle.toml"
    path.write_text(TRAP.replace("17800", "0"))
    assert rows(path)["centrifugal_force"]["verdict"] == "needed"


def test_the_table_fits_and_tells_what_to_add(trap: Path) -> None:
    result = call("explain", trap)
    assert result.exit_code == 0
    assert call("explain", trap, "--verify").exit_code == 0  # as scripts still have it
    assert max(map(len, result.stdout.splitlines())) <= 120
    assert re.search("^centrifugal_force +no ", result.stdout, flags=re.MULTILINE)
    assert 'ball = ["centrifugal_force"]' in result.stdout


def test_a_scene_without_solution_explains_nothing(tmp_path: Path) -> None:
    path = tmp_path / "pull.toml"
    path.write_text(TRAP.replace("17800", "-17800"))
    result = call("explain", path, "--json")
    assert result.exit_code == 1
    assert {row["verdict"] for row in json.loads(result.stdout)["effects"]} == {"not assessed"}


@pytest.mark.parametrize("tolerance", ["0", "-1", "2", "nan"])
def test_a_tolerance_out_of_range_is_bad_input(tolerance: str) -> None:
    result = call("explain", "b218", f"--tolerance={tolerance}")
    assert (result.exit_code, result.stdout) == (2, "")


def test_arrays_are_refused() -> None:
    with pytest.raises(ValueError, match="one case at a time"):
        explain(turning([1000.0, 2000.0], axial_load=8e3), 0.01)


# Warning --------------------------------------------------------------------------------------------------------------


def test_a_plain_run_warns_of_what_is_missing(trap: Path) -> None:
    said, rings, seats = json.loads(call("run", trap, "--json").stdout)["warnings"]
    assert "the expansion of the rings is not included; it would change the displacement by about " in rings
    assert "rings and their seats are taken as rigid; their deflection would change the locked stiffness by" in seats
    assert "the centrifugal force" in said
    assert "stiffness > 100 %" in said
    assert 'ball = ["centrifugal_force", "gyroscopic_moment"]' in said
    assert "Incomplete model: " in call("run", trap).stdout


RIGID = qs.ElasticRings(housing="rigid")


def test_what_is_there_or_does_not_matter_is_no_warning() -> None:
    fast = turning(5000.0, axial_load=17_800.0)
    assert not any("force" in line for line in qs.warnings(solved(fast)))
    slow = qs.Scene(resting().bearing, qs.Operation(speed=500 * qs.rpm, axial_load=17_800.0))
    (seats,) = qs.warnings(solved(slow))
    assert "rings and their seats are taken as rigid" in seats
    assert qs.warnings(solved(replace(slow, ring_effects=(RIGID,)))) == [], "said to be rigid"


def test_of_many_cases_those_that_lack_it_are_counted() -> None:
    scene = qs.Scene(resting().bearing, qs.Operation(speed=[0.0, 100.0, 1500.0], axial_load=17_800.0))
    said, rings, seats = qs.warnings(solved(scene))
    assert said.startswith("1 of 3 cases, the first 2: the centrifugal force of the balls (")
    assert rings.startswith("1 of 3 cases, the first 2: the expansion of the rings is not included")
    assert seats.startswith("For all 3 cases: rings and their seats are taken as rigid")
    assert qs.warnings(solved(scene), 1) == [seats.partition(": ")[2]]
    single = replace(scene, operation=qs.Operation(speed=1500.0, axial_load=17_800.0))
    assert qs.warnings(solved(scene), 2) == qs.warnings(solved(single))


def test_what_too_many_cases_lack_is_predicted() -> None:
    speed = np.linspace(0.0, 1500.0, MOST_CASES + 1)
    solution = solved(qs.Scene(resting().bearing, qs.Operation(speed=speed, axial_load=17_800.0)))
    said, rings = qs.warnings(solution, MOST_CASES)
    assert re.search(r"\(locked stiffness > 100 %\) and the gyroscopic moment of the balls \([a-z ]* ≈ \d+ %\)", said)
    assert re.search(r"it would change the displacement by ≈ \d+ %", rings)


FAST_SPINDLE = qs.load_scene("7210c")


def test_what_needs_numbers_of_the_scene_is_warned_of_with_what_a_solve_finds() -> None:
    """With the bearing's real diameters, within a factor of 1.5 of that with usual ones."""
    without = solved(FAST_SPINDLE)
    (said,) = [line for line in qs.warnings(without) if "the expansion of the rings" in line]
    assert "give RingExpansion(...) with bore, outside diameter" in said
    row = next(row for row in explain(FAST_SPINDLE, 0.01)[1] if row.effect == "ring_expansion")
    assert (row.in_scene, row.verdict, row.predicted, row.actual) == (False, "likely needed, data missing", None, None)
    (assumed,) = row.assumed
    assert f"change the displacement by about {shifted(assumed['displacement_um'])} µm. " in said
    rings = qs.RingExpansion(50 * qs.mm, 90 * qs.mm)
    given = solved(replace(FAST_SPINDLE, ring_effects=(rings,)))
    assert not any("expansion of the rings" in line for line in qs.warnings(given))
    actual = by_quantity(without, given)
    for name in QUANTITIES:
        assert 1.0 / 1.5 < assumed["actual"][name] / actual[name] < 1.5, name


def test_no_bore_lets_the_rings_grow_more_than_is_estimated() -> None:
    solution = solved(FAST_SPINDLE)
    bearing, operation = FAST_SPINDLE.bearing, FAST_SPINDLE.operation
    bottom = 2.0 * float(bearing.inner_groove_centre_radius - bearing.inner_groove_radius)
    (entry,) = (entry for entry in EFFECTS if entry.name == "ring_expansion")
    estimated = judge(entry, solution).errors["displacement"]
    shares = []
    for bore in (0.5 * bottom, 0.9 * bottom, 0.99 * bottom):
        growth = qs.RingExpansion(bore, 90 * qs.mm).states(bearing, operation)[0].groove_growth
        found = geometry_errors(solution.operating_point, GeometryChange(growth, 0.0))["displacement"]
        shares.append(float(found / estimated))
    assert shares == sorted(shares)
    assert 0.97 < shares[-1] < 1.0


def test_effects_chosen_to_a_tolerance_do_not_hide_what_needs_numbers() -> None:
    chosen = qs.solve(replace(FAST_SPINDLE, tolerance=0.01))
    assert any("the expansion of the rings" in line for line in qs.warnings(chosen))


def test_slow_rings_are_no_warning() -> None:
    slow = replace(FAST_SPINDLE, operation=qs.Operation(speed=2000 * qs.rpm, axial_load=500.0))
    assert not any("expansion of the rings" in line for line in qs.warnings(solved(slow)))


# Files ----------------------------------------------------------------------------------------------------------------


def test_a_file_may_leave_its_effects_to_be_chosen(tmp_path: Path) -> None:
    path = tmp_path / "auto.toml"
    path.write_text('effects = "auto"\n' + TRAP.replace("15000", "3000"))
    assert qs.load_scene(path).tolerance == 0.01
    found = json.loads(call("run", path, "--json").stdout)
    assert {one["effect"] for one in found["left_out"]} == {"gyroscopic_moment", "hertz_angle", "orbit_radius"}
    assert all(0.0 < one["estimated_error"] < 0.01 for one in found["left_out"])
    assert found["effects"] == found["accuracy"]["added"] == ["centrifugal_force"]
    assert found["balls"][0]["gyroscopic_moment_Nmm"] is None
    text = call("run", path).stdout
    assert "Tolerance 0.01: left out, with the expected error: the gyroscopic moment" in text
    assert "Needed, and so simulated though the scene does not name it: the centrifugal force" in text


def test_accuracy_judges_the_operating_point_and_not_what_the_file_names(trap: Path) -> None:
    found = json.loads(call("run", trap, "--accuracy", "1e-2", "--json").stdout)
    assert {"centrifugal_force", "gyroscopic_moment"} <= set(found["accuracy"]["added"])
    plain = json.loads(call("run", trap, "--json").stdout)
    assert list(found) == list(plain)
    assert plain["left_out"] is plain["accuracy"] is None
    assert plain["stiffness_SI"][4][4] > 4.0 * found["stiffness_SI"][4][4]


@pytest.mark.parametrize("asked", ["0", "-1e-3", "2", "nan", "1e-13", "a little"])
def test_an_accuracy_out_of_range_is_bad_input(asked: str) -> None:
    result = call("run", "b218", f"--accuracy={asked}")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "--accuracy" in result.stderr


@pytest.mark.parametrize(
    ("head", "said"),
    [
        ("tolerance = 0.01\n", "is given without effects"),
        ('effects = "automatic"\n', "is not a table"),
        ('effects = "auto"\ntolerance = 2\n', "is not a relative error"),
        ('effects = "auto"\ntolerance = "fine"\n', "is not a relative error"),
        ('effects = "auto"\ntolerance = true\n', "is not a relative error"),
    ],
)
def test_a_mistaken_request_is_bad_input_together_with_the_rest(tmp_path: Path, head: str, said: str) -> None:
    path = tmp_path / "wrong.toml"
    path.write_text(head + TRAP + "wrong_key = 1\n")
    result = call("run", path)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "wrong_key" in result.stderr


def test_rings_that_no_scene_may_have_are_not_assessed() -> None:
    """A pitch circle of 20 m: the usual ring around it is larger than any."""
    metres = {"ball_diameter": 0.9, "inner_groove_radius": 0.47, "outer_groove_radius": 0.47, "pitch_diameter": 20.0}
    bearing = replace(qs.load_scene("b218").bearing, **metres)
    _, found = explain(qs.Scene(bearing, qs.Operation(axial_load=1e6)), 0.01)
    (row,) = (row for row in found if row.effect == "elastic_rings")
    assert (row.verdict, row.assumed) == ("not assessed", [])
