"""A set of rows on the page: the numbers, refusals and remarks are those of its file."""

from __future__ import annotations

import copy
import re
from functools import reduce
from html import unescape
from operator import getitem
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")
import qsbearing as qs
from qsbearing.app import answers
from qsbearing.app.inputs import ON_PAGE
from qsbearing.documents.html import part
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.paths import numbers_of
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.results.remarks import blocks, every_remark
from qsbearing.results.set_key_results import results_of_shaft, rows_table
from qsbearing.studies.chooser.explain_set import explain_set
from qsbearing.systems.sets.bearing_set import BearingSet
from tests.app.test_answers import ran
from tests.systems.sets.arrangements import PAIR_FILE

SPINDLE = f"""{PAIR_FILE}
[shaft]
start_mm = -40
[[shaft.sections]]
length_mm = 90
outer_diameter_mm = 50
[[shaft.loads]]
position_mm = -40
radial_y_N = 500
[shaft.points]
tool_mm = -40
"""
"""That pair on a shaft with a tool."""


@pytest.fixture(scope="module")
def first() -> dict[str, Any]:
    return answers.opened(SPINDLE, "spindle")


@pytest.fixture
def spindle(first: dict[str, Any]) -> dict[str, Any]:
    return {"document": copy.deepcopy(first["document"]), "label": "spindle"}


CLIPPED = re.compile(r"shaft-p[0-9a-f]{10}")
"""Names of areas to which lines are cut, which matplotlib numbers as it meets them."""


def set_of(tables: dict[str, Any]) -> BearingSet:
    found = scene_or_set_of(tables["document"], "spindle", "spindle")
    assert isinstance(found, BearingSet)
    return found


def test_the_page_has_fields_of_gears_with_their_own_words() -> None:
    gear = """[[shaft.gears]]
position_mm = 10
azimuth_deg = 0
pitch_diameter_mm = 80
torque_Nm = 20
helix_angle_deg = 10
hand = "left"
kind = "helical"
drives = true
"""
    fields = {each["key"]: each for each in answers.opened(PAIR_FILE + gear, "geared")["fields"]}
    assert fields["shaft.gear 1.hand"]["options"] == ["right", "left"]
    assert fields["shaft.gear 1.kind"]["options"] == ["spur", "helical", "straight_bevel"]
    assert fields["shaft.gear 1.torque_Nm"]["unit"] == "N m"
    assert "shaft.gear 1.drives" not in fields


def test_the_page_has_every_number_of_rows_and_shaft_and_says_what_it_leaves_to_the_file(first: dict[str, Any]) -> None:
    shown = {field["key"]: tuple(field["path"]) for field in first["fields"]}
    assert {"operation.speed_rpm", "operation.axial_load_N", "preload.rigid_N", "shaft.load 1.radial_y_N"} <= set(shown)
    assert shown["shaft.load 1.radial_y_N"] == ("shaft", "loads", 0, "radial_y_N")
    assert next(iter(shown)) == "operation.speed_rpm"
    (load,) = (field for field in first["fields"] if field["key"] == "shaft.load 1.radial_y_N")
    assert (load["group"], load["words"], load["unit"], load["high"]) == ("shaft, load 1", "radial y", "N", 1000.0)
    numbers = {".".join(path) for path in numbers_of(first["document"])}
    there = {".".join(str(step + 1) if isinstance(step, int) else step for step in path) for path in shown.values()}
    assert numbers - there == set()
    seldom = {field["key"] for field in first["fields"] if not field["is_daily"]}
    assert "operation.first_ball_azimuth_deg" in seldom and "row 1.position_mm" in seldom
    daily = {field["key"].rpartition(".")[0] for field in first["fields"] if field["is_daily"]}
    assert daily == {"operation", "preload", "shaft.load 1"}
    places = [field for field in first["fields"] if field["key"].endswith(("position_mm", "start_mm", "tool_mm"))]
    values = [value_at(first["document"], each["path"]) for each in places]
    assert len(places) == 5 and [(each["low"] + each["high"]) / 2.0 for each in places] == values
    assert {each["path"] for each in first["addable"]} == {("operation", "outer_speed_rpm")}
    mounted = answers.put_way(first["document"], "preload", "mounted_N", None)["document"]
    assert mounted["preload"] == {"mounted_N": 720.0}  # one preload; the shaft keeps its axial load
    assert mounted["operation"]["axial_load_N"] == 200.0
    assert "change the file" in first["note"] and "rows, sections or loads" in first["note"]


def value_at(document: dict[str, Any], path: Any) -> Any:
    return reduce(getitem, path, document)


def test_lists_of_row_numbers_are_no_fields() -> None:
    text = SPINDLE.replace("[operation]", "[[spacers]]\nrows = [1, 2]\ninner_length_mm = 4\n[operation]")
    shown = {field["key"] for field in answers.opened(text, "spaced")["fields"]}
    assert "spacer 1.inner_length_mm" in shown and not [key for key in shown if key.startswith("spacer 1.row")]


def test_an_answer_is_that_of_the_same_numbers(spindle: dict[str, Any], drawn: None, tmp_path: Path) -> None:
    """The tool first; each row as the table of all rows has it."""
    document = spindle["document"]
    document["operation"] |= {"speed_rpm": 6000.0, "axial_load_N": 350.0}
    document["shaft"]["loads"][0]["radial_y_N"] = 300.0
    told = answers.solved(**spindle)
    text = SPINDLE.replace("= 10000", "= 6000").replace("axial_load_N = 200", "axial_load_N = 350")
    same = answers.opened(text.replace("radial_y_N = 500", "radial_y_N = 300"), "spindle")["document"]
    assert same == document
    solution = qs.solve_set(set_of(spindle))
    shaft = [each.line for each in results_of_shaft(solution, [{}, {}])]
    rows = rows_table(solution, [{}, {}])
    assert told["is_solved"] and [each["name"] for each in told["key"][:2]] == ["tool: deflection", "tool: stiffness"]
    assert [
        ", ".join(f"{one['of']} {one['number']} {one['unit']}" for one in each["parts"]) for each in told["key"]
    ] == [text for _, text in shaft]
    for row, line in zip(told["rows"], rows.rows, strict=True):
        numbers = {each["name"]: " / ".join(one["number"] for one in each["parts"]) for each in row["key"]}
        assert [row["name"], numbers["axial load"], numbers["preload mounted"]] == list(line[:3])
        assert numbers["maximum contact pressure"] == line[3] and numbers["contact angles"] in line
    assert told["pictures"] == ["shaft", "section", "loads", "angles", "ellipses", "grooves"]
    assert told["warnings"] == part(blocks(every_remark(solution), words=ON_PAGE))
    found = ran(spindle, tmp_path)
    assert told["rows"][1]["key"][0]["parts"][0]["values"][0] == pytest.approx(found["rows"][1]["axial_load_N"])
    assert "Rows: load on each" in answers.detailed(**spindle)["tables"]
    for name in told["pictures"]:
        one, two = (CLIPPED.sub("", answers.pictured(**spindle, name=name, row=row)["picture"]) for row in (0, 1))
        assert one.startswith("<svg") and (one == two) == (name == "shaft"), name
    with pytest.raises(SceneFileError, match="no such picture"):
        answers.pictured(**spindle, name="section", row=2)


def test_the_remarks_are_those_of_run(spindle: dict[str, Any], tmp_path: Path) -> None:
    """But for the names of fields, where a remark has any."""
    spindle["document"]["operation"]["axial_load_N"] = 9000.0  # a row loses its preload, and its balls leave it
    told = re.sub("<[^>]*>", "", unescape(answers.solved(**spindle)["warnings"]))
    remarks = [each for each in ran(spindle, tmp_path)["remarks"] if "give [" not in each["text"]]
    assert len(remarks) > 1
    for each in remarks:
        assert plain(each["text"])[1:].rstrip(".") in plain(told)  # a sentence there: its capital, its end


def plain(text: str) -> str:
    """Without what joins a number and its unit on a page; signs as programs write them."""
    return text.replace("\u2060", "").replace("\xa0", " ").replace("\N{MINUS SIGN}", "-")


def test_a_number_that_cannot_be_is_refused_at_its_field(first: dict[str, Any], spindle: dict[str, Any]) -> None:
    spindle["document"]["operation"]["speed_rpm"] = "fast"
    spindle["document"]["preload"]["rigid_N"] = -400.0
    spindle["document"]["shaft"]["loads"][0]["radial_y_N"] = "much"
    with pytest.raises(SceneFileError) as caught:
        answers.solved(**spindle)
    keys = {each.key for each in caught.value.errors}
    assert keys == {"operation.speed_rpm", "preload.rigid_N", "shaft.load 1.radial_y_N"}
    assert keys <= {field["key"] for field in first["fields"]}


def test_a_set_without_a_solution_says_why(spindle: dict[str, Any]) -> None:
    del spindle["document"]["preload"], spindle["document"]["shaft"]
    spindle["document"]["rows"] = spindle["document"]["rows"][:1]
    spindle["document"]["operation"] = {"speed_rpm": 6000.0, "axial_load_N": -900.0}
    told = answers.solved(**spindle)
    assert not told["is_solved"] and told["picture"] == "" and told["pictures"] == [] and told["rows"] == []
    assert "load" in told["warnings"]


def test_a_saved_set_opens_as_it_was(spindle: dict[str, Any]) -> None:
    kept = answers.saved(**spindle)
    assert kept["file"] == "spindle.toml"
    assert answers.opened(kept["text"], "spindle")["document"] == spindle["document"]


def test_effects_of_a_set_are_switched_and_solved_as_explain_does(spindle: dict[str, Any]) -> None:
    before = {each["effect"]: each for each in answers.solved(**spindle)["effects"]}
    assert list(before) == [entry.name for entry in EFFECTS]
    assert before["centrifugal_force"]["is_in"] and before["gyroscopic_moment"]["can"]
    rows = explain_set(set_of(spindle), 0.01)[1]
    told = answers.effects(**spindle)["effects"]
    assert [each["changes"] for each in told] == [[row.change(name) for name in QUANTITIES] for row in rows]
    other = answers.switched(**spindle, effect="gyroscopic_moment", is_on=True)["document"]
    assert other["effects"]["ball"] == ["centrifugal_force", "gyroscopic_moment"]
    back = answers.switched(other, "spindle", "gyroscopic_moment", False)["document"]
    assert back == spindle["document"]
