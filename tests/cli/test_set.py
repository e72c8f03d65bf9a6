"""`--set`: keys of a scene with another value than its file, in every command that reads one."""

from __future__ import annotations

import inspect
import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from qsbearing.app.mcp.folder import Folder
from qsbearing.app.mcp.tools import Tools
from qsbearing.cli import cli
from qsbearing.files.scene_file import load_scene
from qsbearing.studies.changed_keys import value_of

PAIR = (
    '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 1000\n[preload]\nrigid_N = 300\n'
    '[[rows]]\nposition_mm = 0\ncarries = "+x"\n[[rows]]\nposition_mm = 20\ncarries = "-x"\n'
)
TAKES_NO_SCENE = {"catalogue", "compare", "figures", "guide", "import", "init", "mcp", "plot", "schema", "skill"}
"""Or several."""


def call(*arguments: str | Path, code: int = 0) -> Result:
    result = CliRunner().invoke(cli, [str(argument) for argument in arguments])
    assert result.exit_code == code, result.output
    return result


def record(*arguments: str | Path) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(call("run", *arguments, "--json").stdout)
    return answer


def test_a_set_key_is_as_if_it_stood_in_the_file(tmp_path: Path) -> None:
    text = (
        '[bearing]\nname = "B218"\nball_count = 15\n[operation]\nspeed_rpm = 12000\naxial_load_N = 17800\n[effects]\n'
        'ball = ["centrifugal_force", "gyroscopic_moment"]\nraceway_control = "friction"\n'
    )
    (tmp_path / "own.toml").write_text(text)
    own, set_here = (
        record(tmp_path / "own.toml"),
        record("b218", "--set", "operation.speed_rpm=12000", "--set", "effects.raceway_control=friction",
               "--set", "bearing.ball_count=15"),
    )  # fmt: skip
    assert "changed_input" not in own
    for name in ("displacement", "load", "balls", "choices"):
        assert own[name] == set_here[name]
    assert own["displacement"] != record("b218")["displacement"]
    assert [(each["key"], each["value"], each["before"]) for each in set_here["changed_input"]] == [
        ("operation.speed_rpm", 12000, 10000), ("effects.raceway_control", "friction", "outer"),
        ("bearing.ball_count", 15, 16),
    ]  # fmt: skip
    assert set_here["input"]["operation"]["speed_rpm"] == 12000


def test_text_says_what_was_set() -> None:
    first = call("run", "b218", "--set", "speed_rpm=12000").stdout.splitlines()[0]
    assert first == "Set: operation.speed_rpm = 12000 (before: 10000)"
    assert "Set:" not in call("run", "b218").stdout


def test_a_displacement_takes_the_place_of_the_load() -> None:
    answer = record("b218", "--set", "axial_displacement_um=14.75785")
    assert abs(answer["load"]["axial_N"] / 17800 - 1.0) < 1e-5
    assert answer["changed_input"][0]["replaces"] == {"operation.axial_load_N": 17800}


def test_rows_count_from_1_and_take_their_own_table(tmp_path: Path) -> None:
    (tmp_path / "pair.toml").write_text(PAIR)
    answer = record(tmp_path / "pair.toml", "--set", "rows.2.bearing.ball_count=14", "--set", "rows.2.position_mm=25")
    assert [len(row["balls"]) for row in answer["rows"]] == [15, 14]
    assert [row["position_mm"] for row in answer["rows"]] == [0, 25]
    assert [each["before"] for each in answer["changed_input"]] == [15, 20]


def test_everything_wrong_is_told_at_once_with_the_files_own_faults(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text(PAIR.replace("rigid_N = 300", "rigid_N = -300"))
    wrong = ("speed_rmp=5", "rows.3.position_mm=7", "rows.1.position_mm=near", "operation.axial_load_N=1e40")
    wrong += ("bearing.kind=deep_grove", "bearing.ball_count=12", "ball_count=13", "preload.rigid_N.x=1")
    given = [word for each in wrong for word in ("--set", each)]
    said = call("run", tmp_path / "bad.toml", *given, code=2).stderr
    assert said.splitlines()[0].endswith("8 errors")
    for words in (
        "speed_rmp (as set): unknown key\n    Did you mean speed_rpm under [operation]?",
        "rows.3.position_mm = 7 (as set): is not in the file: there are 2 rows",
        "row 1.position_mm = 'near' (as set): is not a number",
        "operation.axial_load_N = 1e+40 N (as set): is too large\n    allowed: -1e+08 to 1e+08 N",
        "bearing.kind = 'deep_grove' (as set): is none of the choices\n    Did you mean deep_groove?",
        "ball_count = 13 (as set): is set twice",
        "preload.rigid_N.x = 1 (as set): has no place: preload.rigid_N is -300, which is no table",
        "preload.rigid_N = -300 N: ",
    ):
        assert words in said, said


@pytest.mark.parametrize("text", ["speed_rpm", "=5", "speed_rpm=", " "])
def test_what_is_no_setting_is_refused(text: str) -> None:
    assert "write KEY=VALUE" in call("run", "b218", "--set", text, code=2).stderr


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("12000", 12000), ("1e4", 1e4), (".5", 0.5), ("-2.5", -2.5), ("true", True), ("friction", "friction"),
        ('"friction"', "friction"), ('["a", "b"]', ["a", "b"]), ("{x = 1}", {"x": 1}), (">= 20000", ">= 20000"),
        ("12,7", "12,7"), ("1\nx = 2", "1\nx = 2"), ("2026-11-28", "2026-11-28"), ("[" * 5000, "[" * 5000),
    ],
)  # fmt: skip
def test_a_value_is_toml_or_a_word(text: str, value: Any) -> None:
    assert value_of(text) == value


def test_every_command_with_a_scene_takes_it() -> None:
    takes = {name for name, one in cli.commands.items() if any("--set" in each.opts for each in one.params)}
    assert takes - {"init"} == set(cli.commands) - TAKES_NO_SCENE


def test_every_tool_with_a_scene_takes_it() -> None:
    tools = {name: each for name, each in vars(Tools).items() if not name.startswith("_")}
    named = {name: inspect.signature(each).parameters for name, each in tools.items()}
    assert {name for name, each in named.items() if "scene" in each} == {
        name for name, each in named.items() if "changes" in each
    }


SET = ("--set", "speed_rpm=9000")


@pytest.mark.parametrize(
    "line",
    [
        "run b218 --json", "explain b218 --json", "cost b218 --json", "heat hot.toml --json",
        "find b218 --vary axial_load_N=9000:12000 --goal effective_stiffness_axial=240 --points 16 --json",
    ],
)  # fmt: skip
def test_data_say_what_was_set(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from tests.cli.test_remarks_everywhere import SCENE, THERMAL

    monkeypatch.chdir(tmp_path)
    Path("hot.toml").write_text(SCENE + THERMAL)
    result = CliRunner().invoke(cli, [*line.split(), *SET])
    (change,) = json.loads(result.stdout)["changed_input"]
    assert (change["key"], change["value"], change["before"]) == ("operation.speed_rpm", 9000, 10000)


@pytest.mark.parametrize(
    "line",
    [
        "explain b218", "sweep b218 --vary axial_load_N=9000,12000", "stiffness b218 --format json",
        "stiffness b218 --vary axial_load_N=9000,12000", "run b218 --points points.csv --out out.csv",
    ],
)  # fmt: skip
def test_tables_say_what_was_set(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("points.csv").write_text("axial_load_N\n9000\n")
    said = call(*line.split(), *SET).output
    assert "Set: operation.speed_rpm = 9000 (before: 10000)" in said
    assert said != call(*line.split()).output


def test_points_are_solved_with_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("points.csv").write_text("axial_load_N\n17800\n")
    call("run", "b218", "--points", "points.csv", "--out", "out.csv", "--set", "effects.raceway_control=inner")
    heads, cells = (line.split(",") for line in Path("out.csv").read_text().splitlines())
    found = dict(zip(heads, cells, strict=True))["ring_displacement_axial_um"]
    assert float(found) == record("b218", "--set", "effects.raceway_control=inner")["displacement"]["axial_um"]


def test_the_report_says_it_and_has_the_numbers_as_set(tmp_path: Path) -> None:
    pytest.importorskip("typst")
    from tests.documents.page import Page

    text = '[bearing]\nname = "B218"\nfree_contact_angle_deg = 35\n[operation]\naxial_load_N = 1000\n'
    (tmp_path / "my.toml").write_text(text)
    call("report", tmp_path / "my.toml", "--set", "bearing.diametral_clearance_mm=0.5", "--out", tmp_path)
    page = Page.of((tmp_path / "my_report.html").read_text(encoding="utf-8")).text
    set_here = (
        "bearing.diametral_clearance_mm = 0.5 (before: not given; in place of bearing.free_contact_angle_deg = 35)"
    )
    assert f"Set: {set_here}" in page
    assert "computed from the clearance" in page and "computed from the free contact angle" not in page
    assert "--set bearing.diametral_clearance_mm=0.5 --out DIR" in page


def test_tools_take_changes(tmp_path: Path) -> None:
    tools = Tools(Folder(tmp_path))
    changes = {"speed_rpm": 9000, "effects.raceway_control": "inner"}
    answer = tools.solve("b218", changes=changes)
    assert answer["displacement"] == record("b218", *SET, "--set", "raceway_control=inner")["displacement"]
    assert [each["key"] for each in answer["changed_input"]] == ["operation.speed_rpm", "effects.raceway_control"]
    assert "changed_input" not in tools.solve("b218")
    swept = tools.sweep("b218", {"axial_load_N": "9000,12000"}, changes=changes)
    assert swept["changed_input"] == answer["changed_input"]
    assert tools.explain("b218", changes=changes)["changed_input"] == answer["changed_input"]
    found = tools.find("b218", {"axial_load_N": "9000:12000"}, ["inner_load_max=1000"], points=16, changes=changes)
    assert found["input"]["operation"]["speed_rpm"] == 9000
    with pytest.raises(ValueError, match="Did you mean speed_rpm"):
        tools.solve("b218", changes={"speed_rmp": 9000})


def test_the_scene_of_the_catalogue_stays_as_it_is() -> None:
    before = load_scene("b218").operation.speed
    call("run", "b218", *SET)
    assert load_scene("b218").operation.speed == before
