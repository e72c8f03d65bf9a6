"""The command line as a user meets it: exit codes, which stream says what, and files that are whole or not there."""

from __future__ import annotations

import csv
import importlib
import json
import os
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.documents.installation import pip_install
from qsbearing.files import output_file
from qsbearing.files.catalogue import find
from qsbearing.files.csv_table import csv_bytes
from qsbearing.systems.sets.row import Direction
from tests.cli.command import call
from tests.guide.pages import GUIDE

COMBINED = """
[bearing]
name = "B218"
[operation]
speed_rpm = 10000
axial_load_N = 3000
radial_load_y_N = 4000
tilt_z_mrad = 0
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
"""
STATIC = COMBINED.partition("[effects]")[0].replace("10000", "0")
NO_EQUILIBRIUM = '[bearing]\nname = "B218"\n[operation]\naxial_load_N = -1000\n'
BAD = '[bearing]\nname = "B218"\nball_diameter_mm = 0.022225\n[operation]\naxial_load_kN = 1\n'


@pytest.fixture
def scene(tmp_path: Path) -> Any:
    """Write a scene file, and name it."""

    def write(text: str) -> Path:
        file = tmp_path / "scene.toml"
        file.write_text(text)
        return file

    return write


def strict(text: str) -> Any:
    """JSON as its standard has it: NaN and Infinity are errors."""

    def refuse(word: str) -> None:
        raise AssertionError(f"{word} is not JSON")

    return json.loads(text, parse_constant=refuse)


# run ----------------------------------------------------------------------------------------------------------------


def test_the_table_of_a_thrust_bearing_shows_the_ring_one_ball_and_the_warning() -> None:
    qs.solve(qs.load_scene("b218"))  # compiled before, if need be: the message of that would stand on stderr
    result = call("run", "b218")
    assert (result.exit_code, result.stderr) == (0, "")
    assert result.stdout.startswith("B218  angular contact, 16 balls of 22.225 mm on 125.26 mm")
    # 17 800 N, 10 000 rpm, Hertz at the free contact angle.
    for number in ("14.7578", "17800", "49.9414", "31.3366", "1453.51", "1921.56", "all 16"):
        assert number in result.stdout
    assert "Good to know: The gyroscopic moment requires a friction coefficient" in result.stdout
    assert "\x1b" not in result.stdout, "no colours where no terminal is"
    assert max(len(line) for line in result.stdout.splitlines()) <= 100
    assert not any(line.endswith(" ") for line in result.stdout.splitlines())


def test_symmetric_balls_share_a_row(scene: Any) -> None:
    rows = call("run", scene(COMBINED)).stdout.splitlines()
    assert sum(row.startswith("1, 15  22.5, 337.5 ") for row in rows) == 3, "in each of the three tables of balls"
    assert sum(row.startswith("8 ") for row in rows) == 3
    assert not any(row.startswith("15") for row in rows)


def test_a_table_fits_eighty_columns(scene: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    for source in (scene(COMBINED), "b218", "iso16281_7ball"):
        lines = call("run", source).stdout.splitlines()
        assert max(map(len, lines)) <= 80
        assert not any("…" in line for line in lines)


def test_json_has_the_agreed_keys_and_the_solutions_numbers(scene: Any) -> None:
    file = scene(COMBINED)
    result = call("run", file, "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    found = strict(result.stdout)
    assert set(found) >= {
        *("version", "status", "message", "residual", "iterations", "seconds", "effects", "warnings"),
        *("displacement", "load", "locked_stiffness", "effective_stiffness", "stiffness_SI", "compliance_SI", "balls"),
    }
    assert set(found["displacement"]) == {"axial_um", "radial_y_um", "radial_z_um", "tilt_y_mrad", "tilt_z_mrad"}
    assert set(found["load"]) == {"axial_N", "radial_y_N", "radial_z_N", "moment_y_Nm", "moment_z_Nm"}
    contact = {
        *("load_N", "angle_deg", "approach_um", "semi_major_axis_mm", "semi_minor_axis_mm"),
        *("max_pressure_MPa", "required_friction"),
    }
    ball = {
        *("azimuth_deg", "inner", "outer", "centrifugal_force_N", "gyroscopic_moment_Nmm"),
        *(
            "orbital_speed_rpm",
            "rotation_speed_rpm",
            "ball_diameter_deviation_um",
            "groove_deflection_um",
            "raceway_control",
            "slips",
        ),
    }
    assert len(found["balls"]) == 16
    for each in found["balls"]:
        assert set(each) == ball
        assert set(each["inner"]) == set(each["outer"]) == contact
    scene_ = qs.load_scene(file)
    solution = qs.solve(scene_)
    assert found["status"] == "converged"
    assert found["version"] == qs.__version__
    assert found["effects"] == ["centrifugal_force", "gyroscopic_moment"]
    assert found["residual"] < 1e-10
    expected = solution.displacement / [qs.um, qs.um, qs.um, qs.mrad, qs.mrad]
    assert list(found["displacement"].values()) == pytest.approx(expected, rel=1e-12, abs=1e-9)
    assert list(found["load"].values()) == pytest.approx(solution.load, rel=1e-12, abs=1e-6)
    np.testing.assert_allclose(found["stiffness_SI"], qs.stiffness(scene_, solution), rtol=1e-9, atol=1.0)
    sizes = [qs.um, qs.um, qs.um, qs.mrad, qs.mrad]
    assert list(found["locked_stiffness"].values()) == pytest.approx(solution.locked_stiffness * sizes, rel=1e-9)
    effective = [np.nan if value is None else value for value in found["effective_stiffness"].values()]
    assert effective == pytest.approx(solution.effective_stiffness * sizes, rel=1e-9, nan_ok=True)
    compliance = np.array(found["compliance_SI"], float)  # null becomes NaN
    np.testing.assert_array_equal(np.isnan(compliance), np.isnan(solution.compliance))
    wanted = solution.compliance[:4, :4]
    rounding = 1e-10 * np.sqrt(np.outer(np.diag(wanted), np.diag(wanted)))  # which is zero in JSON
    assert (np.abs(compliance[:4, :4] - wanted) <= 1e-9 * np.abs(wanted) + rounding).all()
    for name, array, unit in (
        ("load_N", solution.outer.load, 1),
        ("angle_deg", solution.outer.angle, qs.deg),
        ("approach_um", solution.outer.approach, qs.um),
        ("semi_major_axis_mm", solution.outer.semi_major_axis, qs.mm),
        ("semi_minor_axis_mm", solution.outer.semi_minor_axis, qs.mm),
        ("max_pressure_MPa", solution.outer.max_pressure, qs.MPa),
        ("required_friction", solution.outer.required_friction, 1),
    ):
        assert [each["outer"][name] for each in found["balls"]] == pytest.approx(array / unit, rel=1e-9), name
    assert [each["inner"]["load_N"] for each in found["balls"]] == pytest.approx(solution.inner.load)
    for name, array, unit in (
        ("azimuth_deg", solution.azimuth, qs.deg),
        ("centrifugal_force_N", solution.centrifugal_force, 1),
        ("gyroscopic_moment_Nmm", solution.gyroscopic_moment, qs.Nmm),
        ("orbital_speed_rpm", solution.orbital_speed, qs.rpm),
        ("rotation_speed_rpm", solution.rotation_speed, qs.rpm),
    ):
        assert [each[name] for each in found["balls"]] == pytest.approx(array / unit, rel=1e-9, abs=1e-9), name
    assert max(each["rotation_speed_rpm"] for each in found["balls"]) < 0, "signed: the balls roll backwards"
    assert {each["raceway_control"] for each in found["balls"]} == {"outer"}


def test_json_says_null_to_what_the_scene_does_not_call_for(scene: Any) -> None:
    found = strict(call("run", scene(STATIC), "--json").stdout)
    assert found["effects"] == []
    for ball in found["balls"]:
        for name in ("centrifugal_force_N", "gyroscopic_moment_Nmm", "orbital_speed_rpm", "rotation_speed_rpm"):
            assert ball[name] is None
        assert (
            ball["raceway_control"] is ball["inner"]["required_friction"] is ball["outer"]["required_friction"] is None
        )
    unloaded = [ball for ball in found["balls"] if ball["inner"]["load_N"] == 0.0]
    assert unloaded, "this load leaves balls without contact"
    assert all(ball["inner"]["angle_deg"] is None for ball in unloaded), "a ball at rest without contact has no angle"
    centrifugal = COMBINED.replace(', "gyroscopic_moment"', "")
    ball = strict(call("run", scene(centrifugal), "--json").stdout)["balls"][0]
    assert ball["centrifugal_force_N"] > 0
    assert ball["gyroscopic_moment_Nmm"] is ball["outer"]["required_friction"] is None


def test_no_equilibrium_is_told_and_nothing_is_written(scene: Any, tmp_path: Path) -> None:
    file = scene(NO_EQUILIBRIUM)
    result = call("run", file)
    assert result.exit_code == 1
    assert result.stdout.count("No equilibrium") == 1
    assert "axial" in result.stdout
    result = call("run", file, "--json", "--csv", tmp_path / "out.csv", "--plot", tmp_path / "out.png")
    assert result.exit_code == 1
    found = strict(result.stdout)
    assert found["status"] == "no_equilibrium"
    assert found["balls"] == []
    assert found["stiffness_SI"] is None
    assert set(found["displacement"].values()) == {None}
    assert result.stderr.count("is not written") == 2
    assert list(tmp_path.iterdir()) == [file]


def test_bad_input_is_two_and_speaks_on_stderr_only(scene: Any) -> None:
    result = call("run", scene(BAD), "--json")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "22.225 mm" in result.stderr
    assert "axial_load_N" in result.stderr
    for arguments in (("run", "b219"), ("run", "none.toml"), ("run",), ("run", "b218", "--jsn"), ("rum",)):
        result = call(*arguments)
        assert (result.exit_code, result.stdout) == (2, "")
        assert result.stderr
    for arguments in (("init", "b219"), ("catalogue", "b219")):
        result = call(*arguments)
        assert (result.exit_code, result.stdout) == (2, "")
        assert "Did you mean B218?" in result.stderr


def test_a_thread_count_that_is_none_is_bad_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("QSBEARING_THREADS", "many")
    result = call("run", "b218")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "QSBEARING_THREADS" in result.stderr


def test_csv_holds_a_row_a_ball_and_the_ring_on_every_row(scene: Any, tmp_path: Path) -> None:
    file, target = scene(COMBINED), tmp_path / "out.csv"
    assert call("run", file, "--csv", target).exit_code == 0
    with target.open(newline="") as written:
        rows = list(csv.DictReader(written))
    solution = qs.solve(qs.load_scene(file))
    assert [float(row["outer_load_N"]) for row in rows] == pytest.approx(solution.outer.load, rel=1e-12)
    assert [float(row["azimuth_deg"]) for row in rows] == pytest.approx(solution.azimuth / qs.deg)
    for row in rows:
        assert float(row["ring_displacement_axial_um"]) == pytest.approx(solution.displacement[0] / qs.um)
    slope = qs.stiffness(solution.scene, solution)[3, 3]
    assert float(rows[3]["ring_locked_stiffness_tilt_y_Nm_per_mrad"]) == pytest.approx(slope * qs.mrad, rel=1e-12)
    assert float(rows[0]["ring_locked_stiffness_axial_N_per_um"]) == pytest.approx(60.6, rel=1e-3)
    call("run", scene(STATIC), "--csv", target)
    with target.open() as again:
        assert "raceway_control" not in again.readline(), "no column for what the scene does not call for"


@pytest.mark.parametrize("begin", ["=", "+", "-", "@"])
def test_no_cell_of_a_csv_is_a_formula(begin: str, tmp_path: Path) -> None:
    """The bearing is called after its file; numbers below zero and the word +x stay what they are."""
    file, target = tmp_path / f"{begin}cmd.toml", tmp_path / "out.csv"
    own = {key: value for key, value in find("B218").bearing.items() if key != "kind"}  # type: ignore[union-attr]
    bearing = "".join(f"{key} = {json.dumps(value)}\n" for key, value in own.items())
    file.write_text(f"[bearing]\n{bearing}[operation]\naxial_load_N = 1000\nspeed_rpm = -5\n")
    assert call("run", file, "--csv", target).exit_code == 0
    with target.open(newline="") as written:
        rows = list(csv.DictReader(written))
    assert {row["bearing"] for row in rows} == {f"'{begin}cmd"}
    assert {row["speed_rpm"] for row in rows} == {"-5.0"}
    words = {"carries": np.array([Direction.PLUS], object), "of": np.array([f"{begin}1"], object)}
    assert csv_bytes(words).decode() == f"carries,of\n+x,'{begin}1\n"


def test_plots_are_what_their_names_say(tmp_path: Path, drawn: None) -> None:
    for kind, start in (("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")):
        target = tmp_path / f"out.{kind}"
        assert call("run", "b218", "--plot", target).exit_code == 0
        assert target.read_bytes().startswith(start)
    ElementTree.parse(tmp_path / "out.svg")
    assert len(list(tmp_path.iterdir())) == 3, "no temporary file stays"


@pytest.fixture
def unsolved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Solving is an error here: what is refused must be refused before."""

    def solve(*_: Any, **__: Any) -> None:
        raise AssertionError("solved before the outputs were tried")

    importlib.import_module("qsbearing.studies.chunk")  # who is loaded meanwhile would keep this function
    monkeypatch.setattr(sys.modules["qsbearing.model.solution.solver"], "solve", solve)


@pytest.mark.usefixtures("unsolved")
def test_places_that_cannot_be_written_are_refused_before_solving(tmp_path: Path) -> None:
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "file").write_text("kept")
    here = sorted(tmp_path.rglob("*"))
    for option, target, words in (
        ("--csv", tmp_path / "none" / "out.csv", "there is no folder"),
        ("--plot", tmp_path / "none" / "out.png", "there is no folder"),
        ("--csv", tmp_path / "folder.csv", "is a folder"),
        ("--csv", tmp_path / "file" / "out.csv", "there is no folder"),
        ("--csv", "", "no file name"),
        ("--plot", tmp_path / "out.gif", "must end in one of .png, .svg, .pdf"),
        ("--plot", tmp_path / "png", "must end in one of"),
        ("--csv", "/proc/out.csv", "cannot be written"),
    ):
        result = call("run", "b218", option, target)
        assert (result.exit_code, result.stdout) == (2, ""), target
        assert words in result.stderr
    both = call("run", "b218", "--csv", tmp_path / "none" / "out.csv", "--plot", tmp_path / "none" / "out.png")
    assert "--csv" in both.stderr
    assert "--plot" in both.stderr
    assert sorted(tmp_path.rglob("*")) == here
    assert (tmp_path / "file").read_text() == "kept"


@pytest.mark.usefixtures("unsolved")
def test_one_good_and_one_bad_place_leave_nothing_behind(tmp_path: Path) -> None:
    result = call("run", "b218", "--csv", tmp_path / "out.csv", "--plot", tmp_path / "none" / "out.png")
    assert result.exit_code == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.usefixtures("unsolved")
def test_files_that_would_overwrite_each_other_or_the_scene(scene: Any, tmp_path: Path) -> None:
    file = scene(COMBINED)
    assert "the same file" in call("run", file, "--csv", file).stderr
    link = tmp_path / "link.csv"
    link.symlink_to(file)
    assert "the same file" in call("run", file, "--csv", link).stderr
    target = tmp_path / "out.png"
    assert call("run", file, "--csv", target, "--plot", target).exit_code == 2
    assert file.read_text() == COMBINED


@pytest.mark.usefixtures("unsolved")
def test_a_write_protected_file_is_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    target = tmp_path / "out.csv"
    target.write_text("kept")
    # Whoever runs the tests as root may write everywhere.
    monkeypatch.setattr(output_file.os, "access", lambda place, mode: False)
    result = call("run", "b218", "--csv", target)
    assert result.exit_code == 2
    assert "write-protected" in result.stderr
    assert target.read_text() == "kept"


@pytest.mark.usefixtures("unsolved")
@pytest.mark.parametrize("name", ["x.xlsx", "x.XLSX", "x.parquet", "x.json", "x.png"])
def test_csv_into_a_file_of_another_form_is_refused(name: str, tmp_path: Path) -> None:
    for command in (("run", "b218"), ("compare", "b218", "7210C")):
        result = call(*command, "--csv", tmp_path / name)
        assert result.exit_code == 2
        assert f"its name must not end in .{name.lower()[2:]}" in " ".join(result.stderr.split())
        assert list(tmp_path.iterdir()) == []


def test_zeros_are_zeros_and_a_stiffness_says_its_channels_and_units() -> None:
    found = json.loads(call("run", "b218", "--json").stdout)
    assert all(each == 0.0 for each in list(found["load"].values())[1:])
    assert found["channels"] == {
        "order": ["axial", "radial_y", "radial_z", "tilt_y", "tilt_z"],
        "displacement_SI": ["m", "m", "m", "rad", "rad"],
        "load_SI": ["N", "N", "N", "N m", "N m"],
    }
    kept = {(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (1, 4), (4, 1), (2, 3), (3, 2)}
    for name in ("stiffness_SI", "compliance_SI"):
        assert {tuple(map(int, each)) for each in np.argwhere(np.array(found[name]))} == kept, name


@pytest.mark.usefixtures("unsolved")
def test_a_plot_without_matplotlib_says_what_to_install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    result = call("run", "b218", "--plot", tmp_path / "out.png")
    assert result.exit_code == 2
    assert pip_install("plot") in result.stderr


def test_a_bad_scene_leaves_no_output_behind(scene: Any, tmp_path: Path) -> None:
    file = scene(BAD)
    assert call("run", file, "--csv", tmp_path / "out.csv").exit_code == 2
    assert list(tmp_path.iterdir()) == [file]


def test_an_old_file_is_replaced_whole_and_keeps_its_mode_and_its_link(tmp_path: Path) -> None:
    target, link = tmp_path / "out.csv", tmp_path / "link.csv"
    target.write_text("old " * 100_000)
    target.chmod(0o640)
    link.symlink_to(target)
    assert call("run", "b218", "--csv", link).exit_code == 0
    assert link.is_symlink()
    assert target.read_text().startswith("ball,")
    assert target.stat().st_mode & 0o777 == 0o640
    assert call("run", "b218", "--csv", tmp_path / "new.csv").exit_code == 0
    (tmp_path / "plain").touch()
    assert (tmp_path / "new.csv").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_a_device_is_written_to_and_not_replaced() -> None:
    assert call("run", "b218", "--csv", "/dev/null").exit_code == 0
    assert Path("/dev/null").is_char_device()


# init, catalogue ----------------------------------------------------------------------------------------------------


def test_init_prints_a_scene_that_runs(scene: Any) -> None:
    for arguments in (("init",), ("init", "7210c_hybrid")):
        result = call(*arguments)
        assert (result.exit_code, result.stderr) == (0, "")
        assert result.stdout.count("#") > 10
        assert call("run", scene(result.stdout)).exit_code == 0
    assert "name =" not in call("init").stdout
    assert 'name = "7210C_hybrid"' in call("init", "7210c_hybrid").stdout


def test_catalogue_lists_every_entry_with_its_source(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "100")  # wide enough that no name is broken over two lines
    result = call("catalogue")
    assert result.exit_code == 0
    for words in ("B218", "Turbopump25_hybrid", "deep groove", "22.225", "125.26", "silicon", "Wang, Yan, Zhang, Hong"):
        assert words in result.stdout
    result = call("catalogue", "7210c")
    assert "inner_groove_radius_mm" in result.stdout
    assert "assumed: not in the catalogue" in result.stdout


@pytest.mark.parametrize("width", ["40", "80"])
def test_the_summaries_of_the_commands_are_not_cut_off(width: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", width)
    text = " ".join(call("--help").stdout.partition("Commands:")[2].split())
    assert "..." not in text
    for command in cli.commands.values():
        assert command.short_help in text


def test_a_long_solve_says_so_on_a_terminal(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scene_module = importlib.import_module("qsbearing.cli.scene")
    monkeypatch.setattr(scene_module, "PATIENCE", 0.05)
    for on_terminal, said in ((True, "qsbearing: still solving ...\n"), (False, "")):
        monkeypatch.setattr(sys.stderr, "isatty", lambda answer=on_terminal: answer)
        with scene_module.solving():
            time.sleep(0.2)
        assert capsys.readouterr().err == said
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    with scene_module.solving():
        pass
    time.sleep(0.2)
    assert capsys.readouterr().err == "", "a quick one is solved in silence"


def test_version() -> None:
    assert call("--version").stdout == f"qsbearing, version {qs.__version__}\n"


# The real thing -----------------------------------------------------------------------------------------------------


def shell(*arguments: str, **options: Any) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "qsbearing", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=120, **options)


def test_bad_input_to_the_real_command(scene: Any) -> None:
    bad = shell("run", str(scene(BAD)))
    assert (bad.returncode, bad.stdout) == (2, "")
    assert "2 errors" in bad.stderr
    assert "Traceback" not in bad.stderr


def test_help_loads_nothing_heavy() -> None:
    code = (
        "import sys\n"
        "from qsbearing.cli import main\n"
        "sys.argv = ['qsbearing', '--help']\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert end.code == 0\n"
        "heavy = {'numpy', 'numba', 'rich', 'pydantic', 'scipy', 'matplotlib', 'pandas'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "run" in done.stdout


def test_a_run_of_the_real_command_loads_nothing_that_it_does_not_use(scene: Any) -> None:
    code = (
        "import sys\n"
        "from qsbearing.cli import main\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert end.code == 1\n"
        "heavy = {'scipy.linalg', 'scipy.special', 'matplotlib', 'pandas', 'rich', 'xarray'} & set(sys.modules)\n"
        "heavy |= {'numba.np.arrayobj', 'numba.cpython.mathimpl'} & set(sys.modules)  # what compiling takes\n"
        "assert not heavy, heavy\n"
    )
    file = scene(NO_EQUILIBRIUM)
    command = [sys.executable, "-c", code, "run", str(file), "--json"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert strict(done.stdout)["status"] == "no_equilibrium"


def test_a_reader_that_goes_away_is_no_error() -> None:
    command = [sys.executable, "-m", "qsbearing", "catalogue"]
    read, write = os.pipe()
    os.close(read)  # gone before the first line
    done = subprocess.run(command, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert done.stderr == ""
    assert done.returncode == 0


def test_an_old_terminal_gets_question_marks_and_no_traceback(tmp_path: Path) -> None:
    file = tmp_path / "Lager_\u03b1.toml"
    file.write_text(call("init").stdout)
    result = CliRunner(charset="ascii").invoke(cli, ["run", str(file)])
    assert result.exit_code == 0
    assert result.stdout.startswith("Lager_?  angular contact")


def test_letters_that_no_font_has_are_said_once(tmp_path: Path, drawn: None) -> None:
    """A bearing is called after its file; in place of matplotlib's warning for each letter."""
    text = (GUIDE / "ten_minutes.md").read_text(encoding="utf-8").partition("```toml\n")[2].partition("```")[0]
    file = tmp_path / "軸受.toml"
    file.write_text(text, encoding="utf-8")
    picture = tmp_path / "drawn.png"
    result = CliRunner().invoke(cli, ["run", str(file), "--plot", str(picture)])
    assert result.exit_code == 0, result.output
    assert result.stderr.count("letters that no font here has are boxes in") == 1
    assert "Glyph" not in result.stderr and picture.exists()
