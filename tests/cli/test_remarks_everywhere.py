"""Every command, tool and page that solves a scene says what the scene lacks; the commands themselves are walked over,
so that a new one is asked too."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from qsbearing.app import answers
from qsbearing.app.mcp.folder import Folder
from qsbearing.app.mcp.tools import Tools
from qsbearing.cli import cli
from qsbearing.files.scene_file import load_scene
from qsbearing.files.scene_tables import input_tables

SCENE = '[bearing]\nname = "B218"\n[operation]\nspeed_rpm = 10000\naxial_load_N = 17800\n'
"""At speed without ball effects: 770 N/µm in place of 289."""
THERMAL = (
    "[readings.friction]\nfriction_coefficient = 0.06\n"
    + '[thermal]\nfriction = "contacts"\n[thermal.fixed]\nambient_C = 20\n'
    + '[[thermal.conductances]]\nbetween = ["inner_ring", "balls"]\nW_per_K = 20\n'
    + '[[thermal.conductances]]\nbetween = ["balls", "outer_ring"]\nW_per_K = 20\n'
    + '[[thermal.conductances]]\nbetween = ["outer_ring", "ambient"]\nW_per_K = 20\n'
)
LACKS = "entrifugal force of the balls"

ASKED: dict[str, list[str] | str] = {
    "run": ["run SCENE", "run SCENE --json", "run SCENE --points points.csv --out out.csv", "run study.nc"],
    "explain": ["explain SCENE", "explain SCENE --json"],
    "sweep": [
        "sweep SCENE --vary speed_rpm=9000:12000:3",
        "sweep SCENE --vary speed_rpm=9000:12000:3 --out new.csv",
        "sweep SCENE --vary axial_load_N=9000:12000:2000",
        "sweep SCENE --vary axial_load_N=normal(9000,100) --samples 16",
        "sweep SCENE --vary axial_load_N=normal(9000,100) --sobol 16",
    ],
    "find": [
        "find SCENE --vary axial_load_N=9000:12000 --goal effective_stiffness_axial=640 --points 32",
        "find SCENE --vary axial_load_N=9000:12000 --goal effective_stiffness_axial=640 --points 32 --json",
    ],
    "compare": ["compare SCENE 7210c"],
    "plot": ["plot study.nc --out picture.svg"],
    "table": ["table SCENE --error 5"],
    "stiffness": ["stiffness SCENE --vary speed_rpm=9000:12000:3", "stiffness SCENE --format json"],
    "report": ["report SCENE --out folder"],
    "heat": ["heat hot.toml", "heat hot.toml --json"],
    "app": "the answers of its page are asked below",
    "mcp": "its tools are asked below",
    "figures": "solves studies of its own, which name every effect that they show",
    "cost": "measures levels of the model, those without effects among them, each with its error",
    "import": "solves nothing",
    "init": "solves nothing",
    "schema": "solves nothing",
    "skill": "solves nothing",
    "catalogue": "solves nothing",
    "guide": "solves nothing",
}

OF_TOOLS: dict[str, Callable[[Tools], Any] | str] = {
    "solve": lambda tools: tools.solve(SCENE),
    "explain": lambda tools: tools.explain(SCENE),
    "find": lambda tools: tools.find(SCENE, {"axial_load_N": "9000:12000"}, ["inner_load_max=1000"], points=32),
    "sweep": lambda tools: tools.sweep(SCENE, {"speed_rpm": "9000:12000:3"}),
    "report": "writes files whose first page has the remarks, as that of the command",
    "describe": "solves nothing",
}


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(SCENE)
    (tmp_path / "hot.toml").write_text(SCENE + THERMAL)
    (tmp_path / "points.csv").write_text("speed_rpm\n9000\n12000\n")
    return tmp_path


def said(*words: str) -> str:
    """What a command prints, as one line."""
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 0, result.output
    return " ".join(result.output.split())


def test_every_command_and_tool_is_asked_or_has_a_reason() -> None:
    assert set(ASKED) == set(cli.commands)
    assert set(OF_TOOLS) == {name for name in vars(Tools) if not name.startswith("_")}


@pytest.mark.parametrize("line", [each for lines in ASKED.values() if isinstance(lines, list) for each in lines])
def test_every_command_says_what_its_scene_lacks(line: str, place: Path) -> None:
    if "study.nc" in line:
        said("sweep", "scene.toml", "--vary", "speed_rpm=0,12000", "--out", "study.nc")
    told = said(*line.replace("SCENE", "scene.toml").split())
    if line.startswith("report"):
        told = " ".join(next((place / "folder").glob("*.html")).read_text(encoding="utf-8").split())
    assert LACKS in told and "not included" in told


def test_json_has_it_as_data(place: Path) -> None:
    for line in ("run SCENE --json", "explain SCENE --json", "heat hot.toml --json"):
        record = json.loads(CliRunner().invoke(cli, line.replace("SCENE", "scene.toml").split()).stdout)
        assert "effects_missing" in [each["code"] for each in record["remarks"]], line


@pytest.mark.parametrize("name", [name for name, ask in OF_TOOLS.items() if callable(ask)])
def test_every_tool_says_what_its_scene_lacks(name: str, tmp_path: Path) -> None:
    ask = OF_TOOLS[name]
    assert callable(ask)
    answer = ask(Tools(Folder(tmp_path)))
    assert "effects_missing" in [each["code"] for each in answer["remarks"]]


def test_the_page_says_it_too(place: Path) -> None:
    assert LACKS in json.dumps(
        answers.solved(input_tables(load_scene("scene.toml")), "")["warnings"], ensure_ascii=False
    )
