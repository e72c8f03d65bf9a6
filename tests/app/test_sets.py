"""A set of rows on the page: the numbers, refusals and remarks are those of its file."""

from __future__ import annotations

import copy
import re
from html import unescape
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")
import qsbearing as qs
from qsbearing.app import answers
from qsbearing.documents.html import part
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.file_keys import IN_FILE
from qsbearing.files.set_file import set_of
from qsbearing.files.toml import tables_of
from qsbearing.reports.key_results import key_results_of_set
from qsbearing.results.remarks import blocks, every_remark
from tests.app.test_answers import ran

PAIR = """
[bearing]
name = "7210C"

[[rows]]
position_mm = 0
carries = "+x"

[[rows]]
position_mm = 20
carries = "-x"

[shaft]
start_mm = -40
[[shaft.sections]]
length_mm = 90
outer_diameter_mm = 50
[shaft.points]
tool_mm = -40

[operation]
speed_rpm = 9000
axial_load_N = 200
radial_load_y_N = 500
moment_z_Nm = 0

[preload]
rigid_N = 400

[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
"""


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    file = tmp_path_factory.mktemp("sets") / "pair.toml"
    file.write_text(PAIR)
    return answers.start(str(file))


@pytest.fixture
def pair(first: dict[str, Any]) -> dict[str, Any]:
    return {"document": copy.deepcopy(first["document"]), "label": first["label"]}


def test_the_page_has_the_inputs_of_the_shaft_and_says_what_it_leaves_to_the_file(first: dict[str, Any]) -> None:
    shown = {tuple(field["path"]) for field in first["fields"]}
    assert {("operation", "speed_rpm"), ("operation", "axial_load_N"), ("preload", "rigid_N")} <= shown
    addable = {each["path"]: each["replaces"] for each in first["addable"]}
    assert {path[0] for path in [*shown, *addable]} == {"operation", "preload"}
    assert addable["preload", "mounted_N"]  # one preload; the shaft keeps its axial load
    assert all(path[0] == "preload" for path in addable["preload", "mounted_N"])
    assert "change the file" in first["note"] and "effects" in first["note"]


def test_an_answer_is_that_of_the_same_numbers(pair: dict[str, Any], drawn: None, tmp_path: Path) -> None:
    pair["document"]["operation"] |= {"speed_rpm": 6000.0, "axial_load_N": 350.0}
    told = answers.solved(**pair)
    text = PAIR.replace("= 9000", "= 6000").replace("axial_load_N = 200", "axial_load_N = 350")
    solution = qs.solve_set(set_of(tables_of(text, Path("pair")), "pair", "pair"))
    assert told["is_solved"] and told["key"] == part(key_results_of_set(solution, [{}, {}]))
    assert "tool: stiffness" in told["key"] and told["pictures"] == ["loads", "angles", "shaft"]
    assert told["warnings"] == part(blocks(every_remark(solution), words=IN_FILE))
    found = ran(pair, tmp_path)
    assert f">{found['rows'][1]['axial_load_N']:.4g}<" in told["key"]
    assert answers.detailed(**pair)["effects"] == [] and "Rows: load on each" in answers.detailed(**pair)["tables"]
    for name in told["pictures"]:
        assert answers.pictured(**pair, name=name)["picture"].startswith("<svg"), name


def test_the_remarks_are_those_of_run(pair: dict[str, Any], tmp_path: Path) -> None:
    pair["document"]["operation"]["axial_load_N"] = 9000.0  # a row loses its preload, and its balls leave it
    told = re.sub("<[^>]*>", "", unescape(answers.solved(**pair)["warnings"]))
    remarks = ran(pair, tmp_path)["remarks"]
    assert len(remarks) > 2
    for each in remarks:
        assert plain(each["text"])[1:].rstrip(".") in plain(told)  # a sentence there: its capital, its end


def plain(text: str) -> str:
    """Without what joins a number and its unit on a page."""
    return text.replace("\u2060", "").replace("\xa0", " ")


def test_a_number_that_cannot_be_is_refused_at_its_field(pair: dict[str, Any]) -> None:
    pair["document"]["operation"]["speed_rpm"] = "fast"
    pair["document"]["preload"]["rigid_N"] = -400.0
    with pytest.raises(SceneFileError) as caught:
        answers.solved(**pair)
    assert {each.key for each in caught.value.errors} == {"operation.speed_rpm", "preload.rigid_N"}


def test_a_set_without_a_solution_says_why(pair: dict[str, Any]) -> None:
    del pair["document"]["preload"], pair["document"]["shaft"]
    pair["document"]["rows"] = pair["document"]["rows"][:1]
    pair["document"]["operation"] = {"speed_rpm": 6000.0, "axial_load_N": -900.0}
    told = answers.solved(**pair)
    assert not told["is_solved"] and told["picture"] == "" and told["pictures"] == [] and "load" in told["key"]


def test_a_saved_set_opens_as_it_was(pair: dict[str, Any]) -> None:
    kept = answers.saved(**pair)
    assert kept["file"] == "pair.toml"
    assert answers.opened(kept["text"], "pair")["document"] == pair["document"]


def test_effects_of_a_set_are_not_switched(pair: dict[str, Any]) -> None:
    with pytest.raises(SceneFileError, match="is a set of rows"):
        answers.switched(**pair, effect="hertz_angle", is_on=True)
