"""A limit is described once: who sets it does not change how it is answered, and the worst of what its name leaves out
counts."""

from __future__ import annotations

import copy
import json
import math
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.require_table import required_limits
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.files.scene_tables import input_tables
from qsbearing.model.contact.hertz import HertzForm
from qsbearing.model.scene.requirement import Requirement
from qsbearing.model.solution.limit import MET, Answer, Standing, answers
from qsbearing.results.built_in_limits import BUILT_IN
from qsbearing.results.readings_record import all_taken
from qsbearing.results.requirements import answered, headline, required_answers, verdict, whose
from qsbearing.results.whole import whole_record
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.systems.heat.heat_groups import groups_of_heat, names_of
from qsbearing.systems.sets.deflection import parts_of
from tests.systems.heat import spindle as heated

LOADED = {"axial_load_N": 500, "radial_load_y_N": 300, "tilt_y_mrad": 0, "tilt_z_mrad": 0, "speed_rpm": 6000}
SCENE: dict[str, Any] = {
    "bearing": {"name": "7210C"},
    "operation": LOADED,
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
}
ROW = {"position_mm": 0, "carries": "+x"}
PAIR = {**SCENE, "rows": [ROW, ROW | {"position_mm": 60, "carries": "-x"}], "preload": {"rigid_N": 300}}


def made(tables: dict[str, Any], require: dict[str, Any], **changes: Any) -> Any:
    return scene_or_set_of(copy.deepcopy({**tables, **changes, "require": require}), "", "")


def asked(tables: dict[str, Any], require: dict[str, Any], **changes: Any) -> tuple[Any, list[Answer]]:
    """A solution and the answers to what is required of it, as the model stands."""
    solution = solve_any(made(tables, require, **changes))
    return solution, answers_of(solution)


def answers_of(solution: Any) -> list[Answer]:
    return answers(solution, required_limits(solution), all_taken(solution))


def only(tables: dict[str, Any], require: dict[str, Any], **changes: Any) -> Answer:
    (answer,) = asked(tables, require, **changes)[1]
    return answer


# ----------------------------------------------------------------------------------------------------- what is answered


def test_the_worst_ball_and_raceway_count_and_are_named() -> None:
    solution, (both, one) = asked(SCENE, {"max_pressure_MPa": "<= 1700", "outer.max_pressure_MPa": ">= 900"})
    inner, outer = solution.inner.max_pressure / 1e6, solution.outer.max_pressure / 1e6
    assert both.value == pytest.approx(inner.max(), rel=1e-12) and inner.max() > outer.max()
    assert (both.worst.raceway, both.worst.ball) == ("inner", int(inner.argmax()))
    assert both.margin == pytest.approx(1700.0 - inner.max()) and both.state is Standing.MET
    assert one.value == pytest.approx(outer.min(), rel=1e-12) and one.state is Standing.NOT_MET
    assert one.worst.ball == int(outer.argmin()) and "outer raceway" in whose(one)
    assert one.worst.azimuth_deg == pytest.approx(math.degrees(solution.azimuth[one.worst.ball]))


def test_the_worst_row_counts_where_the_name_leaves_it_out() -> None:
    solution, (all_rows, second) = asked(PAIR, {"inner.max_pressure_MPa": "<= 3000", "row_2_axial_load_N": ">= 0"})
    largest = [row.inner.max_pressure.max() / 1e6 for row in solution.rows]
    assert all_rows.value == pytest.approx(max(largest), rel=1e-12) and largest[0] != pytest.approx(
        largest[1], rel=1e-3
    )
    assert all_rows.worst.row == int(np.argmax(largest)) + 1
    assert second.value == pytest.approx(solution.axial_loads[1]) and second.worst.row == 2


def test_signed_results_count_by_their_size_but_for_negative_limits() -> None:
    """The gyroscopic moment is negative throughout; so is a radial displacement against the load."""
    moved = {"radial_load_y_N": -300}
    require = {
        "gyroscopic_moment": "<= 10", "gyroscopic_moment_max": "<= 10", "displacement_radial_y_um": "<= 0.5",
        "displacement_radial_y_um_max": "<= 0.5",
    }  # fmt: skip
    require["displacement_radial_y_max"] = require.pop("displacement_radial_y_um_max")
    solution, given = asked(SCENE, require, operation=LOADED | moved)
    size, algebraic, moves, moves_algebraically = given
    moment, y = solution.gyroscopic_moment * 1e3, solution.displacement[1] * 1e6
    assert (moment < 0.0).all() and y < -0.5
    assert size.value == pytest.approx(np.abs(moment).max()) and size.state is Standing.NOT_MET
    assert size.limit.is_of_sizes and not algebraic.limit.is_of_sizes
    assert algebraic.value == pytest.approx(moment.max()) and algebraic.state is Standing.MET
    assert moves.value == pytest.approx(-y) and moves.state is Standing.NOT_MET
    assert moves_algebraically.value == pytest.approx(y) and moves_algebraically.state is Standing.MET
    least, most = asked(SCENE, {"displacement_radial_y_um": {"least": -9, "most": 0.5}}, operation=LOADED | moved)[1]
    assert least.value == most.value == pytest.approx(y) and {least.state, most.state} == {Standing.MET}
    smallest = only(SCENE, {"gyroscopic_moment": ">= 10"}, operation=LOADED | moved)
    assert smallest.value == pytest.approx(np.abs(moment).min())


def test_a_limit_that_is_reached_is_met() -> None:
    value = only(SCENE, {"effective_stiffness_axial": ">= 1"}).value
    for sense, factor, state in (
        (">=", 1.0, Standing.MET), ("<=", 1.0, Standing.MET), (">=", 1.0 + 0.5 * MET, Standing.MET),
        (">=", 1.0 + 2.0 * MET, Standing.NOT_MET), ("<=", 1.0 - 2.0 * MET, Standing.NOT_MET),
    ):  # fmt: skip
        assert only(SCENE, {"effective_stiffness_axial": f"{sense} {value * factor!r}"}).state is state, (sense, factor)


def test_two_ends_are_two_limits() -> None:
    least, most = asked(SCENE, {"effective_stiffness_axial": {"least": 45, "most": 60, "source": "customer"}})[1]
    assert (least.limit.sense, least.state, most.limit.sense, most.state) == (
        ">=",
        Standing.NOT_MET,
        "<=",
        Standing.MET,
    )
    assert least.limit.source == most.limit.source == "customer"


def test_what_cannot_be_judged_is_open() -> None:
    """Arguments missing, not called for, no number, no solution."""
    require = {"film.film_parameter": ">= 1", "inner_ring.seat_pressure_MPa": ">= 1", "life.basic_duration_h": ">= 1"}
    solution, (film, seat, life) = asked(SCENE, require)
    assert [each.state for each in (film, seat, life)] == [Standing.OPEN, Standing.OPEN, Standing.MET]
    assert film.reason is not None and film.reason.code == "arguments_missing"
    assert seat.reason is not None and seat.reason.code == "not_called_for"
    record = whole_record(solution, all_taken(solution))["requirements"]
    assert "needs an oil" in record[0]["text"] and record[0]["found"] is None
    held = {key: value for key, value in LOADED.items() if key != "axial_load_N"} | {"axial_displacement_um": 10}
    stiff = only(SCENE, {"effective_stiffness_axial": ">= 1"}, operation=held)
    assert stiff.state is Standing.OPEN and stiff.reason is not None and stiff.reason.code == "no_number"
    falls = {"axial_load_N": 100, "radial_load_y_N": 1e7, "tilt_y_mrad": 0, "tilt_z_mrad": 0}
    for lost in asked(SCENE, {"max_pressure": "<= 1", "life.duration_h": ">= 1"}, operation=falls)[1]:
        assert lost.state is Standing.OPEN and lost.reason is not None and lost.reason.code == "not_solved"


@pytest.mark.parametrize(("least", "state"), [(0.0, Standing.OPEN), (99.0, Standing.NOT_MET)])
def test_of_two_raceways_one_of_which_is_unknown_the_other_alone_can_fail(least: float, state: Standing) -> None:
    """The outer shoulder is not given."""
    shoulder = {"overrun": {"inner_shoulder_diameter_mm": 64}}
    bearing = SCENE["bearing"] | {"groove_radius_coefficient": 0.52}
    answer = only(SCENE, {"overrun.edge_distance": f">= {least}"}, readings=shoulder, bearing=bearing)
    assert answer.state is state and (answer.worst.raceway == "inner") == (state is Standing.NOT_MET)


def test_a_name_of_a_reading_asks_for_it() -> None:
    scene = made(SCENE, {"static_safety.contact_safety": ">= 2", "film.film_parameter": ">= 1"})
    assert set(scene.readings) == {"static_safety"}
    own = made(PAIR, {"life.duration_h": ">= 2"}, rows=[ROW | {"readings": {"kinematics": {}}}, PAIR["rows"][1]])
    assert set(own.readings) == {"life"} and set(own.rows[0].readings) == {"kinematics", "life"}
    oil = {"lubricant": {"iso_viscosity_grade": 32, "oil_temperature_C": 60}}
    assert "film" in made(SCENE, {"inner.film.minimum_thickness": ">= 1"}, readings=oil).readings


SPECTRUM = [
    {"share": 0.25, "axial_load_N": 3000, "speed_rpm": 6000}, {"share": 0.75, "axial_load_N": 1000, "speed_rpm": 2000},
]  # fmt: skip


@pytest.mark.parametrize("tables", [SCENE, PAIR], ids=["bearing", "pair"])
def test_of_a_spectrum_the_life_is_that_of_all_points_and_else_the_worst_point_counts(tables: dict[str, Any]) -> None:
    turning = {key: value for key, value in LOADED.items() if key not in ("axial_load_N", "speed_rpm")}
    required = {"life.duration_h": ">= 20000", "max_pressure": "<= 1e4", "life.basic_reference_rating_life": ">= 1"}
    points = {"readings": {"life": {}}, "spectrum": SPECTRUM}
    solution, (life, pressure, turns) = asked(tables, required, operation=turning, **points)
    record = whole_record(solution, all_taken(solution))
    whole = record["system_life_h"] if "system_life_h" in record else record["duration_h"]
    assert life.value == pytest.approx(whole, rel=1e-12) and life.worst.point == 0
    whole = min(row["life_Mrev"] for row in record["rows"]) if "rows" in record else record["life_Mrev"]
    assert turns.value == pytest.approx(whole, rel=1e-12) and turns.worst.point == 0
    assert pressure.worst.point == 1
    rows = getattr(solution, "rows", (solution,))
    largest = max(side.max_pressure.max() for row in rows for side in (row.inner, row.outer))
    assert pressure.value == pytest.approx(largest / 1e6)


def test_what_an_effect_left_out_would_use_up_is_open() -> None:
    """Rings that turn and bend, and other hypotheses, are solved with usual numbers: what is then beyond its limit is
    not shown to be met."""
    stiff = {"effective_stiffness_axial": ">= 40.5"}
    solution, (as_it_stands,) = asked(SCENE, stiff)
    (answer,) = required_answers(solution, all_taken(solution))
    assert as_it_stands.state is Standing.MET and answer.state is Standing.OPEN and answer.value == as_it_stands.value
    assert answer.reason is not None and answer.reason.code == "estimate"
    effect, found = answer.reason.values["effect"], answer.reason.values["found"]
    assert effect == "elastic_rings" and 0.5 * answer.value < found < 40.5
    assert verdict(answer) == "open, 4.1 % to spare"
    record = whole_record(solution, all_taken(solution))["requirements"][0]
    assert record["text"] == f"with the deflection of the rings (free), which is left out, it would be {found:.4g} N/µm"
    far = solve_any(made(SCENE, {"effective_stiffness_axial": ">= 20", "displacement_radial_y_um": "<= 0.1"}))
    assert [each.state for each in required_answers(far, all_taken(far))] == [Standing.MET, Standing.NOT_MET]


def test_what_remarks_do_not_try_counts_where_little_is_to_spare() -> None:
    """A choice that moves a result by 0.3 %, of which no remark speaks."""
    cold = {key: value for key, value in SCENE.items() if key != "effects"}
    form = {"hertz_form": next(str(each) for each in HertzForm if each is not HertzForm.EXACT)}
    still = {"operation": {"axial_load_N": 2000}, "effects": form}
    value = only(cold, {"inner.max_pressure_MPa": ">= 1"}, **still).value
    exact = only(cold, {"inner.max_pressure_MPa": ">= 1"}, operation=still["operation"], effects={}).value
    assert 1e-4 < abs(exact / value - 1.0) < 0.02
    sense = "<=" if exact > value else ">="
    bound = {"inner.max_pressure_MPa": f"{sense} {0.5 * (exact + value)!r}"}
    solution = solve_any(made(cold, bound, **still))
    (answer,) = required_answers(solution, all_taken(solution))
    assert answer.state is Standing.OPEN and answer.reason is not None
    assert answer.reason.values["effect"] == "hertz_form"


# ------------------------------------------------------------------------------------------------ what its names may be

BENT = {
    "rows": [ROW | {"housing_stiffness": {"radial_stiffness_N_per_um": 900, "axial_stiffness_N_per_um": 900}},
             ROW | {"position_mm": 60, "carries": "-x"}],
    "shaft": {"sections": [{"length_mm": 140, "outer_diameter_mm": 45}], "start_mm": -40, "points": {"tool_mm": -40},
              "supports": [{"position_mm": 90, "radial_y_stiffness_N_per_um": 50}]},
}  # fmt: skip


@pytest.mark.parametrize(
    ("tables", "right", "wrong", "meant"),
    [
        (heated.tables(), "steady_heat_inner_ring_to_balls", "steady_heat_iner_ring_to_balls", "inner_ring_to_balls"),
        (input_tables(heated.pair()), "steady_inner_ring_2_temperature", "steady_iner_ring_2_temperature",
         "steady_inner_ring_2_temperature"),
        (PAIR | BENT, "tool_share_housing_1_radial_y", "tool_share_housing_2_radial_y", "tool_share_housing_1"),
        (PAIR | BENT, "support_1_load_radial_y", "tol_share_shaft_radial_y", "tool_share_shaft_radial_y"),
    ],
    ids=["heated bearing", "heated pair", "shaft", "support"],
)  # fmt: skip
def test_every_name_is_known_before_anything_is_solved(
    tables: dict[str, Any], right: str, wrong: str, meant: str
) -> None:
    answer = only(tables, {right: ">= -1e9"})
    assert answer.state is Standing.MET and math.isfinite(answer.value)
    with pytest.raises(qs.SceneError) as caught:
        made(tables, {wrong: ">= 1"})
    assert f"require.{wrong}: is not a result" in str(caught.value) and meant in str(caught.value)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("stiffness_at_tool", "tool_effective_stiffness_axial"), ("contact_pressure", "max_pressure"),
        ("pressure_MPa", "max_pressure"), ("life.hours", "life_duration"),
    ],
)  # fmt: skip
def test_words_of_a_name_lead_to_results_that_have_them(name: str, meant: str) -> None:
    with pytest.raises(qs.SceneError) as caught:
        made(PAIR | BENT, {name: ">= 1"})
    asked_for = str(caught.value).partition("Did you mean ")[2]
    assert meant in asked_for.replace("?", "").replace(" or ", ", ").split(", ")
    with pytest.raises(qs.SceneError, match="show names"):
        made(PAIR | BENT, {"L10h": ">= 1"})


@pytest.mark.parametrize("tables", [heated.tables(), input_tables(heated.pair()), PAIR | BENT])
def test_names_before_and_after_the_solution_are_the_same(tables: dict[str, Any]) -> None:
    of = made(tables, {})
    solution = solve_any(of)
    if solution.thermal is not None:
        readings = [of.readings] * len(getattr(of, "rows", "1"))
        before, after = map(groups_of_heat, (names_of(of.thermal, readings), solution.thermal))
        assert [(each.prefix, [x.name for x in each.results]) for each in before] == [
            (each.prefix, [x.name for x in each.results]) for each in after
        ]
    for point in getattr(solution, "points", {}).values():
        assert parts_of(of) == list(point.shares)


def test_json_has_the_speed_at_which_steady_states_end() -> None:
    solution = solve_any(made(heated.tables(), {}))
    record = whole_record(solution, all_taken(solution))
    (speed,) = (each for each in record["requirements"] if each["name"] == "thermal speed limit")
    whole = solution.thermal.whole_bearing
    ends = [each.speeds.end for each in (solution.thermal, whole.state) if each is not None and each.speeds.end]
    assert speed["found"] == pytest.approx(8000) and (speed["unit"], speed["origin"]) == ("rpm", "model")
    assert speed["limit"] == pytest.approx(8000 * min(each.factor for each in ends))
    assert "thermal speed limit" not in [each["name"] for each in record["not_checked"]]


# ----------------------------------------------------------------------------------------------------- what is refused


def test_all_that_is_wrong_is_said_at_once() -> None:
    require = {
        "inner.max_presure": "<= 3", "outer.max_pressure_kPa": "<= 3", "azimuth": ">= 3", "load_radial_y": 5,
        "load_axial": {"least": 5, "most": 3, "mots": 4}, "balls_off_inner": "<= a", "inner_angle": True,
        "load_radial_z": {"source": "x"}, "max_pressure_GPa": "<= 2", "outer_load": {"least": "5"},
    }  # fmt: skip
    with pytest.raises(qs.SceneError) as caught:
        made(SCENE | {"operation": LOADED | {"sped_rpm": 1}}, require)
    text = str(caught.value)
    for said in (
        "operation.sped_rpm: unknown key", "inner.max_presure: is not a result\n    Did you mean inner_max_pressure?",
        "outer.max_pressure_kPa: is in another unit", "azimuth: is a place around the bearing",
        'load_radial_y = 5: has no sense: at least, or at most?\n    Write ">= 5"', "load_axial.mots: unknown key",
        "load_axial: is met by no number: 5 at least, 3 at most", "balls_off_inner = '<= a': 'a' is not a number",
        "inner_angle = true: is no requirement", "load_radial_z: has neither least nor most",
        "max_pressure_GPa: is in another unit\n    It is in MPa", "outer_load.least = '5': is not a number",
    ):  # fmt: skip
        assert said in text, said
    assert "12 errors" in text or text.count("\n") > 12


@pytest.mark.parametrize(
    ("require", "said"),
    [
        ("<= 3", "is not a table"),
        ({"row_3_axial_load": ">= 3"}, "is not a result"),
        ({"tol_load_axial": ">= 3"}, "not a"),
    ],
)
def test_a_set_refuses_as_well(require: Any, said: str) -> None:
    shaft = {"sections": [{"length_mm": 140, "outer_diameter_mm": 45}], "start_mm": -40, "points": {"tool_mm": -40}}
    for more in ({}, {"shaft": shaft}):
        if isinstance(require, dict) and "tol_load_axial" in require and not more:
            continue
        with pytest.raises(qs.SceneError, match=said):
            asked(PAIR, require, **more)
        with pytest.raises(qs.SceneError, match=said):
            qs.find(PAIR | more | {"require": require}, {"rigid_N": (100, 900)}, maximise="effective_stiffness_axial")


def test_a_list_of_bearings_answers_nothing() -> None:
    sheet = {"dynamic_load_rating_N": 47500, "static_load_rating_N": 37000, "bore_diameter_mm": 50}
    sheet |= {"outside_diameter_mm": 90, "width_mm": 20, "free_contact_angle_deg": 15, "maker": "GMN"}
    tables = {"bearing": sheet, "operation": LOADED}
    with pytest.raises(qs.SceneError, match="is not answered for a list of bearings"):
        scene_or_set_of(copy.deepcopy(tables | {"require": {"max_pressure": "<= 1700"}}), "", "", may_infer=True)


def test_python_takes_the_table_and_says_what_is_wrong_with_it() -> None:
    bearing = qs.load_scene("B218").bearing
    scene = qs.Scene(bearing, qs.Operation(axial_load=1e3), require={"inner.max_pressure_MPa": "<= 1700"})  # type: ignore[arg-type]
    assert scene.require == (Requirement("inner.max_pressure_MPa", "<=", 1700.0),)
    (answer,) = qs.requirements(qs.solve(scene))
    assert answer.state == "met" and answer.margin == pytest.approx(1700.0 - answer.value)
    with pytest.raises(qs.SceneError, match="has no sense"):
        qs.Scene(bearing, require={"inner.max_pressure_MPa": 1700})  # type: ignore[arg-type]
    wrong = qs.Scene(bearing, qs.Operation(axial_load=1e3), require={"presure": "<= 1"})  # type: ignore[arg-type]
    with pytest.raises(qs.SceneError, match="is not a result"):
        qs.requirements(qs.solve(wrong))


# ------------------------------------------------------------------------------------------------------------ the doors

FILE = """[bearing]
name = "7210C"
[operation]
speed_rpm = 6000
axial_load_N = 500
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
[require]
"life.basic_duration_h" = ">= 20000"
inner.max_pressure_MPa = {most = 1700, source = "house rule 12"}
"""


def run(folder: Path, text: str, *words: str) -> Result:
    (folder / "my.toml").write_text(text, encoding="utf-8")
    return CliRunner().invoke(cli, [words[0], str(folder / "my.toml"), *words[1:]])


@pytest.mark.parametrize(
    ("more", "code", "first"),
    [
        ("", 0, "Both requirements are met."),
        ('max_pressure = "<= 500"\n', 3, "2 of 3 requirements met; 1 not met."),
        ('film.film_parameter = ">= 1"\n', 0, "2 of 3 requirements met; 1 open."),
        ('max_pressure = "<= 500"\nfilm.film_parameter = ">= 1"\n', 3, "2 of 4 requirements met; 1 not met; 1 open."),
        ("max_pressure = 500\n", 2, ""),
    ],
)
def test_run_answers_first_and_its_exit_code_tells(tmp_path: Path, more: str, code: int, first: str) -> None:
    done = run(tmp_path, FILE + more, "run", "--csv", str(tmp_path / "my.csv"))
    assert done.exit_code == code, done.output
    if code != 2:
        assert done.output.splitlines()[0] == first
        assert (tmp_path / "my.csv").exists(), "what is asked for is written all the same"


def test_no_equilibrium_stays_another_code(tmp_path: Path) -> None:
    falls = FILE.replace(
        "axial_load_N = 500", "axial_load_N = 1\nradial_load_y_N = 1e7\ntilt_y_mrad = 0\ntilt_z_mrad = 0"
    )
    done = run(tmp_path, falls, "run")
    assert done.exit_code == 1 and "2 open" in done.output


def test_built_in_limits_change_no_exit_code(tmp_path: Path) -> None:
    heavy = FILE.partition("[require]")[0].replace("axial_load_N = 500", "axial_load_N = 400000")
    done = run(tmp_path, heavy, "run", "--json")
    assert done.exit_code == 0
    record = json.loads(done.stdout)
    beyond = {each["name"]: each for each in record["requirements"]}["contact pressure"]
    assert (beyond["answer"], beyond["origin"]) == ("not met", "model") and beyond["margin"] < 0.0
    assert {each["name"] for each in record["not_checked"]} >= {"preload", "ring stress"}
    assert not any("required" in line for line in run(tmp_path, heavy, "run").output.splitlines()[:3])


def test_a_record_answers_again(tmp_path: Path) -> None:
    done = run(tmp_path, FILE, "run", "--json")
    record = json.loads(done.stdout)
    (tmp_path / "my.json").write_text(done.stdout, encoding="utf-8")
    again = CliRunner().invoke(cli, ["run", str(tmp_path / "my.json"), "--json"])
    assert json.loads(again.stdout)["requirements"] == record["requirements"]
    first = record["requirements"][1]
    assert (first["name"], first["answer"], first["limit"], first["source"], first["origin"]) == (
        "inner.max_pressure_MPa", "met", 1700.0, "house rule 12", "input",
    )  # fmt: skip
    scene = scene_or_set_of(tomllib.loads(FILE), "", "")
    assert scene_or_set_of(json.loads(json.dumps(input_tables(scene))), "", "").require == scene.require


def test_a_report_answers_on_its_first_page_and_ends_alike(tmp_path: Path) -> None:
    done = run(tmp_path, f'{FILE}effective_stiffness_axial = ">= 450"\n', "report", "--out", str(tmp_path / "out"))
    assert done.exit_code == 3, done.output
    page = (tmp_path / "out" / "my_report.html").read_text(encoding="utf-8")
    head = page[: page.index("Key") if "Key" in page else len(page)]
    assert "2 of 3 requirements met; 1 not met." in head and "house rule 12" in head
    assert "Not checked: preload" in head or "Not checked: drag" in head


def test_run_and_find_agree_at_the_point_found(tmp_path: Path) -> None:
    """The requirement on both raceways, on a stiffness by its reciprocal's sense, and one of --limit."""
    preloaded = FILE.replace("axial_load_N = 500", "radial_load_y_N = 300\ntilt_z_mrad = 0\n[preload]\nrigid_N = 300")
    text = f'{preloaded}max_pressure = "<= 1100"\ngyroscopic_moment = "<= 900"\nfilm.film_parameter = ">= 1"\n'
    words = ("--vary", "rigid_N=50:4000", "--maximise", "effective_stiffness_radial_y", "--points", "256", "--json")
    done = run(tmp_path, text, "find", *words)
    assert done.exit_code == 0, done.output
    record = json.loads(done.stdout)
    assert any("max_pressure_max <= 1100" in each for each in record["binding"]), record["binding"]
    assert record["open"] == ["film.film_parameter >= 1"]
    (tmp_path / "found.json").write_text(done.stdout, encoding="utf-8")
    again = CliRunner().invoke(cli, ["run", str(tmp_path / "found.json"), "--json"])
    assert again.exit_code == 0
    required = {each["name"]: each for each in json.loads(again.stdout)["requirements"] if each["origin"] == "input"}
    assert required["max_pressure"]["reason"]["code"] == "estimate", "met, with nothing to spare for what is left out"
    assert required["film.film_parameter"]["answer"] == "open"
    assert required["max_pressure"]["found"] == pytest.approx(1100.0, rel=1e-5)
    for name in ("gyroscopic_moment", "life.basic_duration_h"):
        result = required[name]["result"]
        kept = record["results"][next(each for each in record["results"] if result.startswith(each))]
        assert required[name]["found"] == pytest.approx(kept, rel=1e-9)
    lower = run(tmp_path, text, "find", *words, "--limit", "inner.max_pressure<=1000")
    assert json.loads(lower.stdout)["results"]["inner_max_pressure_max"] == pytest.approx(1000.0, rel=1e-4)


def test_a_sweep_has_what_is_to_spare_as_a_column(tmp_path: Path) -> None:
    study = qs.Study.of(tomllib.loads(FILE) | {"vary": {"axial_load_N": [500, 5000, 20000]}})
    results = qs.sweep(study)
    column = results["requirements_margin"].values
    for load, margin in zip((500, 5000, 20000), column, strict=True):
        tables = tomllib.loads(FILE.replace("axial_load_N = 500", f"axial_load_N = {load}"))
        solution = solve_any(scene_or_set_of(tables, "", ""))
        spare = [each.spare for each in answers_of(solution)]
        assert margin == pytest.approx(min(spare), rel=1e-9)
    assert column[0] > 0.0 > column[-1]


def test_a_comparison_says_who_meets_what(tmp_path: Path) -> None:
    text = f'{FILE}max_pressure = "<= 960"\n'
    done = run(tmp_path, text, "compare", "7210C_hybrid", "--csv", str(tmp_path / "c.csv"))
    assert done.exit_code == 0, done.output
    lines = {line.partition(",")[0].strip('"'): line for line in (tmp_path / "c.csv").read_text("utf-8").splitlines()}
    assert lines["max_pressure ≤ 960"].endswith("MPa,met,not met")
    assert "Requirements" in done.output.splitlines()[0]


def test_words_of_answers() -> None:
    solution, given = asked(SCENE, {"max_pressure": "<= 1e6", "outer_load": "<= 1", "life.duration_h": ">= 1"})
    assert [verdict(each) for each in given] == ["met, 100 % to spare", "not met, by far", "met, by far"]
    assert headline(given[:1]) == "The requirement is met."
    whole = answered(solution, all_taken(solution))
    assert len(whole.required) == 3 and "preload" in whole.not_checked


# ---------------------------------------------------------------------------------------------------------- a new limit

NEW = """    BuiltIn(
        "seal", "the slower seal wears first", "",
        lambda part: iter(
            [Limit((Place(SPEED._replace(holder="scene.operation"), SPEED.results[0]),), "<=", 9e3, "its maker")]
        ),
    ),
"""
BUILT_IN_FILE = "qsbearing/results/built_in_limits.py"
PROGRAM = """
import json, sys
from click.testing import CliRunner
from qsbearing.cli import cli
from qsbearing.files.scene_or_set import load_scene_or_set
from qsbearing.reports.of_any import document_of_any
from qsbearing.studies.chooser.choose_set import solve_any
of = load_scene_or_set("my.toml")
solution = solve_any(of)
head = [type(each).__name__ + str(each) for each in document_of_any(solution, of, "", "").head]
done = CliRunner().invoke(cli, ["run", "my.toml", "--json"])
print(json.dumps([done.stdout, head]))
"""


def test_a_new_limit_appears_everywhere_with_one_place_edited(tmp_path: Path) -> None:
    package = Path(qs.__file__).parent
    shutil.copytree(package, tmp_path / "qsbearing", ignore=shutil.ignore_patterns("__pycache__"))
    file = tmp_path / BUILT_IN_FILE
    text = file.read_text(encoding="utf-8")
    assert text.count("BUILT_IN = (\n") == 1
    file.write_text(text.replace("BUILT_IN = (\n", f"BUILT_IN = (\n{NEW}"), encoding="utf-8")
    (tmp_path / "my.toml").write_text(FILE.replace("6000", "12000"), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], cwd=tmp_path, env=os.environ | {"PYTHONPATH": str(tmp_path)},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    record, head = json.loads(done.stdout)
    (seal,) = (each for each in json.loads(record)["requirements"] if each["name"] == "seal")
    assert (seal["found"], seal["answer"], seal["origin"]) == (pytest.approx(12000.0), "not met", "model")
    callout = next(each for each in head if each.startswith("Callout"))
    assert "Seal, 12,000 of 9000 rpm" in callout and "beyond the limit" in callout
    assert any("'Seal', '12,000 rpm', '≤\\xa09000'" in each for each in head if each.startswith("Table"))


def test_each_built_in_limit_says_what_it_needs() -> None:
    assert [each.name for each in BUILT_IN if not each.needs] == ["contact pressure"]
