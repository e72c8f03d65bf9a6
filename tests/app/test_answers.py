"""What the page is told, asked as its script asks: the numbers of `run`, errors at their fields, and nothing else."""

from __future__ import annotations

import copy
import json
import re
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import pytest
from click.testing import CliRunner

pytest.importorskip("starlette")
pytest.importorskip("uvicorn")

from qsbearing.app import answers, inputs
from qsbearing.cli import cli
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.keys import EFFECT_TABLES
from qsbearing.files.limits import LARGEST_FILE
from qsbearing.files.scene_file import load_scene
from qsbearing.model.effects import EFFECTS, QUANTITIES
from qsbearing.model.solution.judgement import WORDS
from qsbearing.studies import keys
from qsbearing.studies.chooser.explain import explain
from tests.app.served import asked, served, started
from tests.guide.pages import GUIDE

SESSIONS = 20


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with served("7210C_hybrid") as found:
        yield found


@pytest.fixture
def scene(address: str) -> dict[str, Any]:
    return started(address)


def ran(tables: dict[str, Any], folder: Path) -> dict[str, Any]:
    """What `qsbearing run --json` makes of the file that the page saves."""
    kept = answers.saved(**tables)
    (folder / kept["file"]).write_text(kept["text"])
    printed = CliRunner().invoke(cli, ["run", str(folder / kept["file"]), "--json"], catch_exceptions=False)
    found: dict[str, Any] = json.loads(printed.stdout)
    return found


def test_the_numbers_are_those_of_run(address: str, scene: dict[str, Any], tmp_path: Path) -> None:
    scene["document"]["operation"]["axial_load_N"] = 700.0
    told, found = asked(address, "rest", scene)[1]["tables"], ran(scene, tmp_path)
    for number in (found["effective_stiffness"]["axial_N_per_um"], found["displacement"]["axial_um"]):
        assert f">{number:.6g}<" in told
    pressure = max(ball["inner"]["max_pressure_MPa"] for ball in found["balls"])
    shown = {each["name"]: each["parts"] for each in asked(address, "solve", scene)[1]["key"]}
    inner = shown["maximum contact pressure"][0]
    assert (inner["of"], inner["number"], inner["unit"]) == ("inner", f"{pressure:.0f}", "MPa")
    assert inner["values"] == [pytest.approx(pressure, rel=1e-12)]


def test_a_saved_scene_opens_as_it_was(address: str, scene: dict[str, Any]) -> None:
    kept = asked(address, "save", scene)[1]
    again = asked(address, "open", {"text": kept["text"], "label": "another"})[1]
    assert again["document"] == scene["document"]
    assert kept["text"] in kept["command"] and kept["command"].endswith(f"qsbearing run {kept['file']}\n")


def test_errors_are_those_of_the_file_each_at_its_key(address: str, scene: dict[str, Any], tmp_path: Path) -> None:
    wrong = copy.deepcopy(scene)
    wrong["document"]["bearing"] |= {"ball_diameter_mm": -3.0, "ball_count": 2}
    wrong["document"]["operation"]["speed_rpm"] = "fast"
    told = asked(address, "solve", wrong)[1]["errors"]
    import tomli_w

    (tmp_path / "wrong.toml").write_text(tomli_w.dumps(wrong["document"]))
    with pytest.raises(SceneFileError) as caught:
        load_scene(tmp_path / "wrong.toml")
    assert [(each["key"], each["text"]) for each in told] == [(each.key, str(each)) for each in caught.value.errors]
    shown = {".".join(field["path"]) for field in asked(address, "show", {"document": wrong["document"]})[1]["fields"]}
    assert {each["key"] for each in told} <= shown


def test_every_numeric_key_of_a_file_has_a_field_or_a_choice_or_can_be_added(scene: dict[str, Any]) -> None:
    """Those of an effect once it is switched on."""
    document = scene["document"]
    for name in EFFECT_TABLES:
        document["effects"][name] = {}
    told = answers.shown(document)
    there = {".".join(field["path"]) for field in told["fields"]}
    addable = {".".join(each["path"]) for each in told["addable"]}
    document["effects"]["raceway_control"] = "friction"
    of_friction = {".".join(each["path"]) for each in answers.shown(document)["addable"]} - addable
    assert of_friction and all(path.startswith("effects.traction.") for path in of_friction)
    addable |= of_friction
    chosen = {way["path"] for each in told["channels"] for way in each["ways"] if "path" in way}
    assert not there & addable and not chosen & addable and len(chosen) == 14
    rest = {".".join(key.path) for key in keys.ALL.values()} - there - addable - chosen
    assert [path for path in rest if path.split(".")[1] not in ("ball_material", "ring_material")] == []  # words here


def test_a_slider_holds_its_number(scene: dict[str, Any]) -> None:
    for value in (-3.0, 0.0, 1e-9, 7.0, 1e300):
        scene["document"]["operation"]["axial_load_N"] = value
        (field,) = [each for each in inputs.fields(scene["document"]) if each["path"][-1] == "axial_load_N"]
        assert field["low"] <= min(value, inputs.FARTHEST) <= field["high"] and 0.0 < field["step"] < 1e30


def test_each_effect_is_switched_and_back(address: str, scene: dict[str, Any]) -> None:
    before = {each["effect"]: each for each in asked(address, "solve", scene)[1]["effects"]}
    assert list(before) == [entry.name for entry in EFFECTS] and before["centrifugal_force"]["is_in"]
    switched = 0
    for name in ("centrifugal_force", "hertz_angle", "orbit_radius"):
        assert before[name]["can"]
        other = asked(address, "switch", {**scene, "effect": name, "is_on": not before[name]["is_in"]})[1]
        tables = {**scene, "document": other["document"]}
        after = {each["effect"]: each for each in asked(address, "solve", tables)[1]["effects"]}
        switched += after[name]["is_in"] != before[name]["is_in"]
    assert switched == 3
    assert not before["unequal_balls"]["can"]  # a list, which the page leaves to the file


def test_what_effects_change_is_what_explain_solves(scene: dict[str, Any]) -> None:
    rows = explain(load_scene("7210C_hybrid"), 0.01, inputs.ON_PAGE)[1]
    told = answers.effects(**scene)["effects"]
    assert [(each["effect"], each["verdict"], each["why"]) for each in told] == [
        (row.effect, row.verdict, row.why) for row in rows
    ]
    for each, row in zip(told, rows, strict=True):
        assert each["changes"] == [row.change(quantity) for quantity in QUANTITIES]
        if row.actual is not None and any(row.actual.values()):
            largest = max(QUANTITIES, key=lambda name: row.actual[name] or 0.0)
            assert each["most"] in (f"{WORDS[largest]} {row.change(largest)} %", "0 %")
    assert sum("≈" in each["most"] for each in told) >= 2
    unknown = {"ball_expansion", "unequal_balls", "seats_out_of_round", "moment_shares"}
    assert {each["effect"] for each in told if each["most"] == ""} == unknown, (
        "without numbers of the scene, or unlike it"
    )


def test_a_switch_leaves_all_other_tables() -> None:
    """A heat balance among them, whose solution holds temperatures in place of it."""
    tables = re.findall(r"```toml\n(# tight.toml\n.*?)```", (GUIDE / "heat.md").read_text(), flags=re.DOTALL)[0]
    hot = answers.opened(tables, "tight")
    after = answers.switched(hot["document"], "tight", "hertz_angle", True)["document"]
    assert after["effects"].pop("hertz_angle") == "actual" and hot["document"]["effects"].pop("hertz_angle") == "free"
    assert after == hot["document"] and "thermal" in after


def test_the_page_answers_what_the_file_requires(scene: dict[str, Any]) -> None:
    """Its limits stand with their answers, not with the fields, and in what is saved."""
    assert answers.solved(**scene)["required"] == {"headline": "", "answers": [], "open": ""}
    text = answers.saved(**scene)["text"] + '\n[require]\nmax_pressure = "<= 1"\n"life.duration_h" = ">= 1"\n'
    opened = answers.opened(text, "7210C_hybrid")
    assert not [field for field in opened["fields"] if field["path"][0] == "require"]
    told = answers.solved(opened["document"], "7210C_hybrid")["required"]
    assert told["headline"] == "1 of 2 requirements met; 1 not met."
    pressure, life = told["answers"]
    assert pressure["path"] == ["require", "max_pressure", "most"]
    assert life["path"] == ["require", "life.duration_h", "least"]
    assert (pressure["look"], pressure["verdict"]) == ("fail", "not met, by far")
    assert (life["look"], life["unit"]) == ("pass", "h") and 0.0 < life["used"] < 1.0 < pressure["used"]
    for each in told["answers"]:  # where the page changes it
        assert opened["document"]["require"][each["path"][1]][each["path"][2]] == 1.0
    assert "[require.max_pressure]" in answers.saved(opened["document"], "")["text"]


def test_a_case_without_solution_says_why(address: str, scene: dict[str, Any]) -> None:
    scene["document"]["operation"]["axial_load_N"] = -900.0
    told = asked(address, "solve", scene)[1]
    assert not told["is_solved"] and told["picture"] == "" and told["key"] == [] and told["pictures"] == []
    assert "load" in told["warnings"]
    assert asked(address, "picture", {**scene, "name": "life"})[1]["picture"] == ""


def test_every_picture_is_drawn(scene: dict[str, Any], drawn: None) -> None:
    from qsbearing.app.drawn import PANELS

    for name in PANELS:
        for speed in (0.0, 9000.0):
            scene["document"]["operation"]["speed_rpm"] = speed
            assert answers.pictured(**scene, name=name)["picture"].startswith("<svg"), (name, speed)


def test_sessions_at_once_do_not_meet(address: str, scene: dict[str, Any]) -> None:
    def question(number: int) -> dict[str, Any]:
        own = copy.deepcopy(scene)
        own["document"]["operation"]["axial_load_N"] = 500.0 + 40.0 * number
        return own

    found: dict[int, Any] = {}

    def session(number: int) -> None:
        found[number] = asked(address, "solve", question(number))[1]["key"]

    threads = [threading.Thread(target=session, args=(number,)) for number in range(SESSIONS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({repr(key) for key in found.values()}) == SESSIONS
    for number in (0, 7, SESSIONS - 1):
        assert found[number] == json.loads(json.dumps(answers.solved(**question(number))["key"]))


@pytest.mark.parametrize(
    ("question", "given", "headers", "status"),
    [
        ("solve", b"{" + b" " * LARGEST_FILE + b"}", {}, 413),
        ("solve", b"no JSON", {}, 400),
        ("solve", b'{"document": {"operation": {"speed_rpm": NaN}}, "label": ""}', {}, 400),
        ("solve", b"[" * 100_000, {}, 400),
        ("solve", {"document": [], "label": ""}, {}, 400),
        ("solve", {"document": {}, "label": "", "path": "/etc/passwd"}, {}, 400),
        ("open", {"text": "", "label": 3}, {}, 400),
        ("solve", {"document": {}, "label": ""}, {"Content-Type": "text/plain"}, 415),
        ("solve", {"document": {}, "label": ""}, {"Host": "elsewhere.example"}, 400),
        ("no_such_question", {}, {}, 405),
        ("..%2fserver.py", {}, {}, 405),
    ],
    ids=["long", "no JSON", "NaN", "deep", "a list", "more", "a number", "a form", "another name", "unknown", "above"],
)  # fmt: skip
def test_what_is_no_question_is_refused(
    address: str, question: str, given: Any, headers: dict[str, str], status: int
) -> None:
    assert asked(address, question, given, headers)[0] == status


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("bearing = 3", "is not a table"),
        ("[[rows]]\nposition_mm = 0\n[bearing]\nname = 'b218'", "row 1.carries"),
        ("[[spectrum]]\nshare = 1\n[bearing]\nname = 'b218'", "is several operating points"),
        ("[bearing]\nname = '/etc/passwd'", "is not in the catalogue"),
        ("[bearing", "is not TOML"),
        ("", "is empty"),
    ],
)
def test_a_file_that_is_no_scene_says_so(address: str, text: str, said: str) -> None:
    status, told = asked(address, "open", {"text": text, "label": "mine"})
    assert status == 200 and any(said in each["text"] for each in told["errors"])


def test_the_page_may_load_nothing_from_elsewhere(address: str) -> None:
    with urlopen(address) as page:
        text, policy = page.read().decode(), page.headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy and "http" not in policy
    assert "//" not in text


def test_the_command_refuses_what_run_refuses() -> None:
    result = CliRunner().invoke(cli, ["app", "no_such_bearing"])
    assert result.exit_code == 2 and "neither a file nor a bearing" in result.stderr


def test_the_page_begins_with_what_is_set() -> None:
    settings = [("operation.speed_rpm", 12000), ("effects.raceway_control", "inner")]
    document = answers.start("7210C", settings)["document"]
    assert document["operation"]["speed_rpm"] == 12000 and document["effects"]["raceway_control"] == "inner"
    assert answers.start("7210C")["document"]["operation"]["speed_rpm"] == 24500


def test_a_setting_that_is_none_is_refused_before_the_page_is_served() -> None:
    result = CliRunner().invoke(cli, ["app", "7210C", "--set", "speed_rpm=fast", "--set", "no_such=1"])
    assert result.exit_code == 2 and "no_such" in result.stderr and "speed_rpm" in result.stderr
    assert "shows" not in result.stderr


def test_friction_is_a_choice_in_the_list(scene: dict[str, Any]) -> None:
    tables = copy.deepcopy(scene)
    effects = tables["document"]["effects"]
    assert effects["moment_shares"] == "controlling"
    (field,) = (each for each in inputs.fields(tables["document"]) if each["key"] == "effects.raceway_control")
    assert "friction" in field["options"]
    effects |= {"raceway_control": "friction", "traction": {"friction_coefficient": 0.05}}
    answer = answers.solved(**tables)
    back = answers.saved(**tables)
    assert 'raceway_control = "friction"' in back["text"] and "moment_shares" not in back["text"]
    effects["raceway_control"] = "outer"
    assert answer != answers.solved(**tables) == answers.solved(**scene)
