"""A new remark is one edited place: of a bearing or set a kind with the function that tells where it holds, of a
reading a kind and a line in the file of the reading; all else follows.

Done on a copy of the package.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import qsbearing as qs

PACKAGE = Path(qs.__file__).parent
OF_BEARING = """BALLS_HEAVY = Kind(
    "balls_heavy", CHECK, "ten_minutes#2-write-your-own",
    "{balls:weighs/weigh} more than {most_g:.3g} g: {mass_g:.3g} g each.",
)


@SUBJECTS.tells
def _heavy(of: CaseRange) -> Iterator[Holding]:
    mass = of.cases(of.solution.scene.bearing.ball_mass)
    is_there = of.rows(np.isfinite(of.solution.azimuth).astype(float)) > 0.0
    yield mass > 0.04, lambda i: remark(BALLS_HEAVY, balls=is_there[i], most_g=40.0, mass_g=1e3 * mass[i])


"""
OF_SET = """SHAFT_FAST = Kind("shaft_fast", CHECK, "sets", "The shaft turns at {speed_rpm:.4g} rpm.")


@SUBJECTS.tells
def _fast(of: CaseRange) -> Iterator[Holding]:
    speed = of.cases(of.solution.set.operation.speed) * 30.0 / np.pi
    yield speed > 900.0, lambda i: remark(SHAFT_FAST, speed_rpm=speed[i])


"""
OF_READING = 'STRESS_READ = Kind("stress_read", NOTE, "readings", "the stress of {balls_read:g} balls is read")\n'
LINE = """    holding.append((True, remark(STRESS_READ, balls_read=16.0)))
"""
EDITS = [
    ("remarks/bearing.py", [("SPARSE = 0.25", OF_BEARING)]),
    ("systems/sets/remarks.py", [("def _bodies(", OF_SET)]),
    (
        "readings/subsurface_stress.py",
        [("DENT_OF_CERAMIC = ", OF_READING), ("    holding.append((numbers.is_hybrid", LINE)],
    ),
]
"""For each remark the one file, before what in it, and the text."""
SCENE = """[bearing]
name = "B218"
[operation]
speed_rpm = 1000
axial_load_N = 5000
[readings.stress]
"""
ROWS = """[preload]
rigid_N = 300
[[rows]]
position_mm = 0
carries = "+x"
[[rows]]
position_mm = 50
carries = "-x"
"""
PROGRAM = """
import json, sys
from click.testing import CliRunner
import qsbearing as qs
from qsbearing.cli import cli
done = [CliRunner().invoke(cli, words) for words in json.loads(sys.argv[1])]
said = [each.output if each.exit_code == 0 else repr(each.exception or each.output) for each in done]
print(json.dumps([*said, list(qs.warnings(qs.solve(qs.load_scene("my.toml"))))]))
"""


def put_before(file: Path, mark: str, text: str) -> None:
    was = file.read_text(encoding="utf-8")
    assert was.count(mark) == 1
    file.write_text(was.replace(mark, text + mark), encoding="utf-8")


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    folder = tmp_path_factory.mktemp("remark")
    shutil.copytree(PACKAGE, folder / "qsbearing", ignore=shutil.ignore_patterns("__pycache__", "records"))
    for file, insertions in EDITS:
        for mark, text in insertions:
            put_before(folder / "qsbearing" / file, mark, text)
    (folder / "my.toml").write_text(SCENE, encoding="utf-8")
    (folder / "pair.toml").write_text(SCENE.replace("axial_load_N = 5000\n", "") + ROWS, encoding="utf-8")
    commands = {
        "run": ["run", "my.toml"],
        "record": ["run", "my.toml", "--json"],
        "pair": ["run", "pair.toml", "--json"],
        "sweep": ["sweep", "my.toml", "--vary", "ball_diameter_mm=20,22", "--out", "all.nc"],
        "guide": ["guide", "remarks"],
    }
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps([*commands.values()])], cwd=folder, capture_output=True, text=True,
        env=os.environ | {"PYTHONPATH": str(folder)}, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return dict(zip((*commands, "python"), json.loads(done.stdout), strict=True))


def test_it_is_said_in_text_json_and_python(answers: dict[str, Any]) -> None:
    mass = 1e3 * float(qs.load_scene("b218").bearing.ball_mass)
    sentence = f"All 16 balls weigh more than 40 g: {mass:.3g} g each."
    assert sentence in answers["python"]
    assert f"Check your data: {sentence.removesuffix('.')}" in " ".join(answers["run"].split())
    (said,) = (each for each in json.loads(answers["record"])["remarks"] if each["code"] == "balls_heavy")
    assert said["severity"] == "check_data"
    assert len(said["of"]["balls"]) == 16
    assert said["values"] == {"most_g": 40.0, "mass_g": pytest.approx(mass)}


def test_it_is_said_of_rows_and_of_the_points_of_a_study(answers: dict[str, Any]) -> None:
    said = [each for each in json.loads(answers["pair"])["remarks"] if each["code"] == "balls_heavy"]
    assert [each["of"]["rows"] for each in said] == [[1], [2]]
    assert "weigh" in answers["sweep"] and "1 of 2" in " ".join(answers["sweep"].split())


def test_one_of_a_set_is_said_once_of_the_set_alone(answers: dict[str, Any]) -> None:
    (said,) = (each for each in json.loads(answers["pair"])["remarks"] if each["code"] == "shaft_fast")
    assert said["of"] == {} and said["values"] == {"speed_rpm": pytest.approx(1000.0)}
    assert "shaft_fast" not in answers["record"]


def test_one_of_a_reading_is_said_with_its_name(answers: dict[str, Any]) -> None:
    record = json.loads(answers["record"])
    (said,) = (each for each in record["remarks"] if each["code"] == "stress_read")
    assert said["of"] == {"readings": ["stress"]}
    assert "the stress of 16 balls is read" in record["readings"]["stress"]["warnings"]
    assert "stress_read" in answers["pair"] and "the stress of 16 balls" in " ".join(answers["sweep"].split())


def test_the_guide_lists_each_with_its_values(answers: dict[str, Any]) -> None:
    for code, value in (("balls_heavy", "mass_g"), ("shaft_fast", "speed_rpm"), ("stress_read", "balls_read")):
        (line,) = (each for each in answers["guide"].splitlines() if f" {code} " in each)
        assert value in answers["guide"], line
