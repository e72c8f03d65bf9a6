"""A new remark is an entry with its sentence, and a line where its numbers are known; all else follows.

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
ENTRY = """    Kind("balls_heavy", CHECK, "ten_minutes#2-write-your-own",
         "{balls:weighs/weigh} more than {most_g:.3g} g: {mass_g:.3g} g each."),
"""
BEFORE_ENTRY = '    Kind("balls_sparse", '
LINE = """    mass = np.broadcast_to(bearing.ball_mass, solution.shape).reshape(-1)[part]
    is_there = rows(np.isfinite(solution.azimuth).astype(float), part) > 0.0
    yield mass > 0.04, lambda i: remark("balls_heavy", balls=is_there[i], most_g=40.0, mass_g=1e3 * mass[i])
"""
BEFORE_LINE = "    share = np.asarray(bearing.ball_count)"
SCENE = """[bearing]
name = "B218"
[operation]
speed_rpm = 1000
axial_load_N = 5000
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
    put_before(folder / "qsbearing" / "remarks" / "kinds.py", BEFORE_ENTRY, ENTRY)
    put_before(folder / "qsbearing" / "remarks" / "bearing.py", BEFORE_LINE, LINE)
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


def test_the_guide_lists_it_with_its_values(answers: dict[str, Any]) -> None:
    assert "balls_heavy" in answers["guide"] and "mass_g" in answers["guide"]
