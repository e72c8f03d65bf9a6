"""`qsbearing sweep` as its user meets it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pandas
import pytest
import xarray

import qsbearing as qs
from qsbearing.studies import sweep as sweeping
from tests.cli.command import call
from tests.systems.sets.arrangements import PAIR_FILE


def test_a_quick_look_says_how_points_ended_and_what_came_out() -> None:
    result = call("sweep", "b218", "--vary", "ball_count=16,17,18", "-y", "inner_load_max", "-y", "inner_angle_max")
    assert result.exit_code == 0
    assert "balls do not" in result.stdout
    assert "ball_count 18" in result.stdout
    load = qs.solve(qs.load_scene("b218")).inner.load[0]
    (line,) = (line for line in result.stdout.splitlines() if line.startswith("inner_load_max"))
    assert line.split()[-1] == "N"
    assert f"{load:.5g}" in line.split()


def test_files_of_every_kind_hold_the_same(tmp_path: Path) -> None:
    given = ("sweep", "b218", "--vary", "ball_count=3,18", "--vary", "speed_rpm=0:1:2", "--out")
    for name in ("r.nc", "r.csv", "r.parquet"):
        assert call(*given, tmp_path / name).exit_code == 0
    table = pandas.read_csv(tmp_path / "r.csv")
    assert len(table) == 2 * 3 + 2, "a row per ball, and one of each point without balls"
    assert set(table["status"]) == {"converged", "impossible"}
    with qs.open_results(tmp_path / "r.nc") as results:
        found = table[(table.ball_count == 3) & (table.speed_rpm == 1)]
        assert found["inner_load_N"].tolist() == pytest.approx(
            results["inner_load"][0, 1].values.tolist()[:3], rel=1e-9
        )
    parquet = pandas.read_parquet(tmp_path / "r.parquet").fillna({"reason": ""})
    pandas.testing.assert_frame_equal(parquet, table.fillna({"reason": ""}), check_dtype=False)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("b218",), "nothing varies"),
        (("b218", "--vary", "speed_rpm"), "has no values"),
        (("b218", "--vary", "speed_rpm=1,2", "--vary", "speed_rpm=1,3"), "varied twice"),
        (("b218", "--vary", "speed=0:1:3"), "Did you mean speed_rpm"),
        (("b218", "--vary", "rpm=0:1:3"), "Did you mean speed_rpm?"),
        (("b218", "--vary", "speed_rpm=0:1000,5:3"), "Decimals take a point: 1000.5"),
        (("b218", "--vary", "speed_rpm=0:22,000:3"), "Write 22000 (thousands take no comma) or 22.000, which is 22"),
        (("b217", "--vary", "speed_rpm=0:1:3"), "Did you mean B218"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--out", "r.txt"), "must end in"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--resume"), "--resume needs"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--out", "none/r.nc"), "no folder"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--sampling", "sobel"), "none of the choices"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--scheduler", "nowhere"), "cannot be reached"),
        (("b218", "--vary", "ball_diameter_mm=normal(22,3)", "--out", "r.nc"), "leaves the possible"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--out", "none/r.csv"), "no folder"),
        (("b218", "--vary", "speed_rpm=0:1:3", "--plot", "none/r.png"), "no folder"),
    ],
)
def test_bad_input_is_a_sentence(
    arguments: tuple[str, ...], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = call("sweep", *arguments)
    assert result.exit_code == 2
    assert said in result.stderr
    assert "Traceback" not in result.output
    assert not list(tmp_path.iterdir())


def test_tables_write_units_as_people_do() -> None:
    """Also those of `find` and `compare`; keys in files stay plain ASCII."""
    found = call("find", "b218", "--vary", "axial_load_N=1000:2000", "--goal", "ring_displacement_axial=0")
    for table in (call("sweep", "b218", "--vary", "speed_rpm=0,1"), call("compare", "b218", "7210c"), found):
        assert " µm" in table.stdout and " um" not in table.stdout, table.output


@pytest.mark.parametrize("vary", ["axial_load_N=-1,-2", "ball_count=40,41"])
@pytest.mark.parametrize("out", ["r.nc", "r.csv", "r.parquet"])
def test_no_point_solved_is_exit_code_1_and_a_file_that_says_why(vary: str, out: str, tmp_path: Path) -> None:
    result = call("sweep", "b218", "--vary", vary, "--out", tmp_path / out, "--plot", tmp_path / "r.png")
    assert result.exit_code == 1
    assert "nothing to draw" in result.stderr
    assert [file.name for file in tmp_path.iterdir()] == [out]
    if out == "r.nc":
        assert "no point of these results is solved" in call("plot", tmp_path / out).stderr


@pytest.mark.parametrize("out", ["r.nc", "r.csv", "r.parquet"])
def test_a_single_point_is_written_drawn_and_shown(out: str, tmp_path: Path) -> None:
    result = call("sweep", "b218", "--vary", "speed_rpm=12000", "--out", tmp_path / out, "--plot", tmp_path / "r.png")
    assert result.exit_code == 0
    assert {file.name for file in tmp_path.iterdir()} == {out, "r.png"}


def test_an_interrupt_says_how_to_go_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*given: object) -> object:
        raise KeyboardInterrupt

    monkeypatch.setattr(sweeping, "solved_chunks", interrupted)
    result = call("sweep", "b218", "--vary", "speed_rpm=0:1:2", "--out", tmp_path / "r.nc")
    assert result.exit_code == 130
    assert "--resume continues the run" in result.stderr
    assert [file.name for file in tmp_path.iterdir()] == ["r.nc.parts"]


@pytest.mark.parametrize("out", ["r.nc", "r.csv", "r.parquet"])
def test_a_finished_file_is_replaced_only_where_that_is_asked_for(
    out: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = ("sweep", "b218", "--vary", "speed_rpm=0:1:2", "--out", tmp_path / out)
    (tmp_path / out).write_bytes(b"mine")
    refused = call(*given)
    assert refused.exit_code == 2
    assert "--overwrite replaces it" in refused.stderr
    assert (tmp_path / out).read_bytes() == b"mine"
    if out == "r.nc":  # once asked for is enough: a run that goes on may do what it was to do
        assert call(*given, "--resume").exit_code == 2
        with monkeypatch.context() as patch:
            patch.setattr(sweeping, "solved_chunks", lambda *given: (_ for _ in ()).throw(KeyboardInterrupt))
            assert call(*given, "--overwrite").exit_code == 130
        assert (tmp_path / out).read_bytes() == b"mine"
    assert call(*given, "--resume" if out == "r.nc" else "--overwrite").exit_code == 0
    assert (tmp_path / out).read_bytes() != b"mine"


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
@pytest.mark.parametrize(
    ("out", "begun", "left"),
    [("r.nc", "r.nc.parts/plan.json", "r.nc.parts"), ("r.csv", "qsbearing-*/*/plan.json", None)],
)
def test_a_run_that_is_terminated_leaves_nothing_half_written(
    out: str, begun: str, left: str | None, tmp_path: Path
) -> None:
    command = [sys.executable, "-m", "qsbearing", "sweep", "b218", "--samples", "3000000", "-y", "inner_load_max"]
    command += ["--vary", "ball_diameter_mm=normal(22.225,0.001)", "--out", str(tmp_path / out)]
    environment = os.environ | {"TMPDIR": str(tmp_path)}
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True, env=environment) as running:
        while not list(tmp_path.glob(begun)) and running.poll() is None:
            time.sleep(0.02)
        running.terminate()
        _, said = running.communicate(timeout=60)
    assert running.returncode == 143
    assert "Traceback" not in said
    assert [file.name for file in tmp_path.iterdir()] == ([left] if left else [])


@pytest.mark.parametrize("given", ["axes", "random", "set", "auto"])
def test_a_sweep_is_reproduced_from_its_file(given: str, tmp_path: Path) -> None:
    """The study again, to the last bit; and `run` solves the scene of its first point."""
    first, again, file = tmp_path / "first.nc", tmp_path / "again.nc", tmp_path / "my.toml"
    text = "[operation]\nspeed_rpm = 9000\naxial_load_N = 3000\n"
    file.write_text({"set": PAIR_FILE, "auto": 'effects = "auto"\ntolerance = 0.03\n'}.get(given, "") + {
        "axes": f'[bearing]\nname = "B218"\nball_count = 15\n{text}[readings.life]\n[vary]\nspeed_rpm = [0, 7e3]\n',
        "random": f'[bearing]\nname = "B218"\n{text}[study]\nsamples = 9\nseed = 3\nsampling = "latin_hypercube"\n',
        "set": "[vary]\nspeed_rpm = {start = 1000, stop = 9000, count = 3}\n",
        "auto": f'[bearing]\nname = "B218"\n{text}[vary]\ngroove_radius_coefficient = [0.5217, 0.53]\n',
    }[given])  # fmt: skip
    options = ["--vary", "ball_diameter_deviation_um=normal(0,0.1)", "-y", "inner_load"] if given == "random" else []
    assert call("sweep", file, *options, "--out", first).exit_code == 0
    file.unlink()
    result = call("sweep", first, "--out", again)
    assert (result.exit_code, result.stderr) == (0, "")
    with qs.open_results(first) as one, qs.open_results(again) as other:
        xarray.testing.assert_identical(other.load(), one.load())
        place = dict.fromkeys(one["status"].dims, 0)
        result = call("run", first, "--json")
        alone = json.loads(result.stdout)
        assert result.exit_code == 0
        assert bool(result.stderr) == bool(json.loads(one.attrs["remarks"])), "the remarks that the sweep made"
        assert alone["input"] == json.loads(one.attrs["input"])
        if given == "random":
            return  # its scene has the distributions' medians
        name = "displacement_axial" if given == "set" else "ring_displacement_axial"
        (found,) = (key for key in one if str(key).endswith(name))
        assert alone["displacement"]["axial_um"] == pytest.approx(float(one[found][place]), rel=1e-12)


def test_a_study_file_is_no_scene_to_run(tmp_path: Path) -> None:
    file = tmp_path / "my.toml"
    file.write_text('[bearing]\nname = "B218"\n[operation]\naxial_load_N = 1\n[vary]\nspeed_rpm = [1, 2]\n')
    result = call("run", file)
    assert result.exit_code == 2
    assert "qsbearing sweep" in result.stderr
    assert call("sweep", file, "-y", "inner_load").exit_code == 0
