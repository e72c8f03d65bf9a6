"""The map of a result: its numbers are those of `run` at each point, and a point without one says why."""

from __future__ import annotations

import copy
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")
from qsbearing.app import answers, maps
from qsbearing.files.file_errors import SceneFileError
from tests.app.served import asked, served
from tests.app.test_answers import ran
from tests.app.test_sets import SPINDLE

SPEED, LOAD = ["operation", "speed_rpm"], ["operation", "axial_load_N"]
STIFFNESS = "ring_effective_stiffness_axial"


@pytest.fixture
def scene() -> dict[str, Any]:
    return {"document": copy.deepcopy(answers.start("7210C_hybrid")["document"]), "label": ""}


@pytest.fixture
def spindle() -> dict[str, Any]:
    return {"document": copy.deepcopy(answers.opened(SPINDLE, "spindle")["document"]), "label": "spindle"}


def test_a_point_of_the_map_is_what_run_prints(scene: dict[str, Any], tmp_path: Path) -> None:
    speeds, loads = [9000.0, 15000.0, 21000.0], [700.0, 1500.0]
    told = maps.values(**scene, x=SPEED, y=LOAD, result=STIFFNESS, xs=speeds, ys=loads)
    assert told["why"] == [[""] * 3] * 2
    assert len({round(each, 3) for row in told["values"] for each in row}) == 6
    for row, column in ((0, 2), (1, 0)):
        scene["document"]["operation"] |= {"speed_rpm": speeds[column], "axial_load_N": loads[row]}
        found = ran(scene, tmp_path)["effective_stiffness"]["axial_N_per_um"]
        assert told["values"][row][column] == pytest.approx(found, rel=1e-6)  # found from another start


def test_a_map_of_a_set_moves_its_rows(spindle: dict[str, Any], tmp_path: Path) -> None:
    places, speeds = [20.0, 35.0], [4000.0, 10000.0]
    name, path = "tool_effective_stiffness_radial_y", ["rows", 1, "position_mm"]
    told = maps.values(**spindle, x=path, y=SPEED, result=name, xs=places, ys=speeds)["values"]
    spindle["document"]["rows"][1]["position_mm"] = 35.0
    spindle["document"]["operation"]["speed_rpm"] = 4000.0
    found = ran(spindle, tmp_path)["shaft"]["points"]["tool"]["effective_stiffness"]["radial_y_N_per_um"]
    assert told[0][1] == pytest.approx(found, rel=1e-6) and told[0][1] != pytest.approx(told[0][0], rel=0.01)


def test_a_point_without_a_result_says_why(scene: dict[str, Any]) -> None:
    told = maps.values(**scene, x=SPEED, y=LOAD, result=STIFFNESS, xs=[9000.0], ys=[-900.0, 900.0])
    assert told["values"][0] == [None] and told["why"][0][0].startswith("no equilibrium: ")
    assert told["values"][1][0] > 0.0 and told["why"][1] == [""]
    path = ["bearing", "ball_diameter_mm"]
    told = maps.values(**scene, x=path, y=LOAD, result=STIFFNESS, xs=[-1.0, 12.7], ys=[900.0])
    assert told["values"][0][0] is None and "bearing.ball_diameter_mm" in told["why"][0][0]
    told = maps.values(**scene, x=path, y=LOAD, result=STIFFNESS, xs=[-2.0, -1.0], ys=[900.0])
    assert told["values"] == [[None, None]] and all(each.startswith("impossible") for each in told["why"][0])


def test_a_row_beyond_the_shaft_is_a_point_without_a_result(spindle: dict[str, Any]) -> None:
    question = {"x": ["rows", 1, "position_mm"], "y": SPEED, "result": "row_1_axial_load", "ys": [4000.0]}
    for places in ([70.0], [20.0, 70.0], [70.0, 80.0]):
        told = maps.values(**spindle, **question, xs=places)
        assert [each is None for each in told["values"][0]] == [place > 50.0 for place in places]
        assert ["beyond the sections" in each for each in told["why"][0]] == [place > 50.0 for place in places]
    spindle["document"]["rows"][0]["position_mm"] = 70.0
    with pytest.raises(SceneFileError, match="beyond the sections"):
        maps.values(**spindle, **question, xs=[20.0])


def test_what_is_offered_is_what_the_page_has_and_the_case_results_in(
    scene: dict[str, Any], spindle: dict[str, Any]
) -> None:
    for tables, first in ((scene, STIFFNESS), (spindle, "tool_effective_stiffness_radial_y")):
        told = maps.choices(**tables)
        shown = {field["key"]: field for field in answers.shown(tables["document"])["fields"]}
        assert set(told["inputs"]) <= set(shown) and all("low" in shown[key] for key in told["inputs"])
        left = {key for key, field in shown.items() if "low" in field} - set(told["inputs"])
        assert left == {"bearing.ball_count"}
        assert told["first"]["result"] == first and told["first"]["x"] == "operation.speed_rpm"
        x, y = (shown[told["first"][axis]] for axis in "xy")
        assert y["unit"] == "N"
        for result in (told["results"][0], told["results"][-1], {"name": first}):
            ends = {"xs": [x["high"]], "ys": [y["high"]]}
            found = maps.values(**tables, x=list(x["path"]), y=list(y["path"]), result=result["name"], **ends)
            assert found["values"][0][0] is not None, result["name"]
    rows = {each["group"] for each in maps.choices(**spindle)["results"]}
    assert {"row 1", "row 2", ""} <= rows


@pytest.mark.parametrize(
    ("question", "said"),
    [
        ({"x": SPEED}, "two different"),
        ({"x": ["operation", "no_such_key"]}, "is not a numeric key"),
        ({"x": ["rows", 7, "position_mm"]}, "is not in the file"),
        ({"result": "no_such_result"}, "is not a result"),
        ({"xs": []}, "1 to"),
        ({"xs": ["much"]}, "is not a number"),
        ({"xs": [float(n) for n in range(3000)]}, "1 to"),
    ],
)
def test_a_question_that_is_none_is_refused(scene: dict[str, Any], question: dict[str, Any], said: str) -> None:
    good = {"x": LOAD, "y": SPEED, "result": STIFFNESS, "xs": [900.0], "ys": [9000.0]}
    assert maps.values(**scene, **good)["values"][0][0] > 0.0
    with pytest.raises(SceneFileError, match=said):
        maps.values(**scene, **{**good, **question})


def test_the_server_answers_for_a_map(scene: dict[str, Any]) -> None:
    with served("7210C_hybrid") as address:
        question = {"x": SPEED, "y": LOAD, "result": STIFFNESS, "xs": [9000.0], "ys": [900.0]}
        status, told = asked(address, "map_values", {**scene, **question})
        assert status == 200 and told == maps.values(**scene, **question)
        status, told = asked(address, "map_values", {**scene, **question, "xs": 3})
        assert status == 400 and told["errors"]
        assert asked(address, "map_choices", scene)[1] == maps.choices(**scene)
