"""Files of sets: read, run, refused."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.scene_file import load_scene
from tests.systems.sets.arrangements import PAIR_FILE

POSSIBLE = {
    *("offset_um", "sprung", "reference_position_mm", "spring_N", "axial_displacement_um"),
    *("start_mm", "length_mm", "outer_diameter_mm", "inner_diameter_mm", "position_mm", "radial_y_N", "tool_mm"),
    "gravity_m_s2",
    *("azimuth_deg", "pitch_diameter_mm", "helix_angle_deg", "hand", "torque_Nm", "drives"),
    *("max_pressure_MPa", "effective_stiffness_axial", '"life.basic_duration_h"'),  # which is required of results
}
"""Keys that the template shows in comments."""


def written(folder: Path, text: str) -> Path:
    path = folder / "pair.toml"
    path.write_text(text, encoding="utf-8")
    return path


def run(path: Path, *options: str) -> Result:
    return CliRunner().invoke(cli, ["run", str(path), *options], catch_exceptions=False)


def refused(folder: Path, text: str) -> dict[str, str]:
    """What is said of each key of a bad file."""
    with pytest.raises(qs.SceneFileError) as caught:
        qs.load_set(written(folder, text))
    return {each.key: f"{each.problem}. {each.cause}" for each in caught.value.errors}  # type: ignore[attr-defined]


def test_a_file_is_the_set_that_python_makes(tmp_path: Path) -> None:
    from_file = qs.load_set(written(tmp_path, PAIR_FILE))
    bearing = load_scene("7210c").bearing
    rows = (qs.Row(bearing, 0.0), qs.Row(bearing, 20 * qs.mm, "-x"))  # type: ignore[arg-type]
    operation = qs.Operation(10_000 * qs.rpm, axial_load=200.0)
    by_hand = qs.BearingSet(
        rows, operation, qs.Preload(rigid=720.0), None, (qs.CentrifugalForce(),), qs.RacewayControl.OUTER, name="pair"
    )
    assert from_file == by_hand


def test_json_table_and_csv_agree(tmp_path: Path) -> None:
    path = written(tmp_path, PAIR_FILE + "[readings.life]\n")
    found = json.loads(run(path, "--json").stdout)
    solution = qs.solve_set(qs.load_set(path))
    assert found["status"] == "converged"
    assert found["arrangement"] == "DB (back to back)"
    assert found["displacement"]["axial_um"] == pytest.approx(solution.displacement[0] / qs.um, rel=1e-12)
    diagonal = np.sqrt(np.diag(solution.stiffness))
    rounding = 1e-10 * np.outer(diagonal, diagonal)  # which is zero in JSON
    assert (np.abs(found["stiffness_SI"] - solution.stiffness) <= 1e-12 * np.abs(solution.stiffness) + rounding).all()
    loads = [row["axial_load_N"] for row in found["rows"]]
    assert loads[0] - loads[1] == pytest.approx(200.0, rel=1e-9)
    assert [row["preload_at_rest_N"] for row in found["rows"]] == pytest.approx([720.0, 720.0], rel=1e-9)
    for state, loads in (("unmounted", solution.preload_unmounted), ("mounted", solution.preload_mounted)):
        assert [row[f"preload_{state}_N"] for row in found["rows"]] == pytest.approx(list(loads), rel=1e-12)
    assert [row["preload_share"] for row in found["rows"]] == pytest.approx(list(solution.preload_share), rel=1e-12)
    lives = [row["readings"]["life"]["duration_h"] for row in found["rows"]]
    assert found["system_life_h"] == pytest.approx(float(qs.system_life(lives)))
    assert found["rows"][1]["balls"][0]["inner"]["load_N"] == pytest.approx(solution.rows[1].inner.load[0], rel=1e-12)
    text = run(path, "--csv", str(tmp_path / "out.csv")).stdout
    for word in ("Rows: load on each", f"{loads[0]:.6g}", "maintained", "Life of all rows together", "carries -x"):
        assert word in text
    with (tmp_path / "out.csv").open(encoding="utf-8") as file:
        balls = list(csv.DictReader(file))
    assert len(balls) == 30
    assert {(ball["row"], ball["carries"]) for ball in balls} == {("1", "+x"), ("2", "-x")}
    assert float(balls[-1]["shaft_load_axial_N"]) == pytest.approx(200.0, rel=1e-9)
    assert all(ball["life_duration_h"] for ball in balls)


def test_the_template_solves(tmp_path: Path) -> None:
    for name in ("7210C", "B218"):
        text = CliRunner().invoke(cli, ["init", "--set", name]).stdout
        assert run(written(tmp_path, text)).exit_code == 0
        commented = [line for line in text.splitlines() if line.startswith("# ") and " = " in line]
        assert commented  # the possible keys; each is a key of a file
        for line in commented:
            key = line.removeprefix("# ").partition(" = ")[0]
            assert key in POSSIBLE


def test_rows_of_their_own(tmp_path: Path) -> None:
    """A bearing, ring effects and readings of one row alone; a reference elsewhere; a spring."""
    text = """
[[rows]]
position_mm = 0
carries = "+x"
offset_um = 2
  [rows.bearing]
  name = "7210C"
  [rows.ring_expansion]
  bore_diameter_mm = 50
  outside_diameter_mm = 90
  [rows.readings.life]
[[rows]]
position_mm = 40
carries = "-x"
sprung = true
  [rows.bearing]
  name = "7210C_hybrid"
[shaft]
reference_position_mm = 100
[operation]
speed_rpm = 5000
[preload]
spring_N = 300
"""
    found = qs.load_set(written(tmp_path, text))
    first, second = found.rows
    assert (first.offset, first.sprung, second.sprung) == (pytest.approx(2e-6), False, True)
    assert first.ring_effects is not None and first.ring_effects[0].name == "ring_expansion"
    assert second.ring_effects is None and second.readings is None
    assert second.bearing.ball_material == qs.SILICON_NITRIDE
    assert float(found.reference) == pytest.approx(0.1)
    assert run(tmp_path / "pair.toml").exit_code == 0
    shown = json.loads(run(tmp_path / "pair.toml", "--json").stdout)
    assert shown["preload"]["slide_um"] > 0.0
    assert shown["rows"][0]["readings"]["life"]["duration_h"] > 0.0
    assert shown["rows"][1]["readings"] is None
    assert shown["system_life_h"] is None  # one of the lives was not asked for
    assert run(tmp_path / "pair.toml", "--csv", str(tmp_path / "out.csv")).exit_code == 0


def test_everything_wrong_with_a_file_is_said_at_once(tmp_path: Path) -> None:
    said = refused(
        tmp_path,
        """
[bearing]
name = "7210C"
ball_cont = 3
[[rows]]
position = 0
carries = "+X"
[[rows]]
position_mm = "20"
carries = "-x"
sprung = 1
[rows.bearing]
name = "7210D"
[[rows]]
carrys = "-x"
position_mm = 1e6
offset_mm = 0.01
[rows.readings.live]
[shaft]
reference_mm = 1
[operation]
axial_load_kN = 2
[preload]
rigid_N = -3
[effect]
ball = []
""",
    )
    expected = {
        "[effect]": "Did you mean [effects]?",
        "bearing.ball_cont": "Did you mean ball_count?",
        "row 1.position": "Did you mean position_mm?",
        "row 1.carries": "Did you mean +x?",
        "row 2.position_mm": "is not a number",
        "row 2.sprung": "neither true nor false",
        "row 2.bearing.name": "Did you mean 7210C or 7210E?",
        "row 3.carrys": "Did you mean carries?",
        "row 3.position_mm": "is too large",
        "row 3.offset_mm": "Did you mean offset_um = 10?",
        "row 3.readings.live": "Did you mean [readings.life]?",
        "shaft.reference_mm": "Did you mean reference_position_mm?",
        "operation.axial_load_kN": "Did you mean axial_load_N = 2000?",
        "preload.rigid_N": "is negative",
    }
    for key, words in expected.items():
        assert words in said[key], key
    assert set(said) == set(expected)


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        ("[bearing]\nname = '7210C'\n[shaft]\n", "[[rows]]", "missing"),
        ("[bearing]\nname = '7210C'\nrows = 3\n", "bearing.rows", "unknown key"),
        ("rows = 3\n", "[[rows]]", "is not a list of tables"),
        ("rows = [3]\n[bearing]\nname = '7210C'\n", "row 1", "is not a table"),
        ("[[rows]]\nposition_mm = 0\ncarries = '+x'\n", "row 1.bearing", "missing"),
        ("[[rows]]\nbearing = '7210C'\n", "row 1.bearing", "Write it as [rows.bearing]"),
        (
            PAIR_FILE.replace("[preload]\nrigid_N = 720", "[preload]\nspring_N = 720"),
            "preload.spring_N",
            "is given, but no row is sprung",
        ),
        (PAIR_FILE.replace('"-x"', '"+x"'), "preload.rigid_N", "has no row to press against"),
        (PAIR_FILE.replace("position_mm = 20", "position_mm = 0"), "row 2.position_mm", "is the position of row 1 too"),
        (
            "tolerance = 3\neffects = 'auto'\n" + PAIR_FILE.partition("[effects]")[0],
            "tolerance",
            "not a relative error",
        ),
        (PAIR_FILE.replace("10000", "1e7"), "operation.speed_rpm", "is too fast"),
        (PAIR_FILE + "[readings.film]\n", "readings.film", "needs an oil"),
        (PAIR_FILE + "[shaft]\nreference_position_mm = 1e9\n", "shaft.reference_position_mm", "is too large"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, key: str, words: str) -> None:
    said = refused(tmp_path, text)
    assert words in said[key]


def test_a_picture_and_a_table_in_one_run(tmp_path: Path, drawn: None) -> None:
    path = written(tmp_path, PAIR_FILE)
    for form, first in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
        target = tmp_path / f"a.{form}"
        assert run(path, "--plot", str(target), "--csv", str(tmp_path / "a.csv")).exit_code == 0
        assert target.read_bytes().startswith(first)
    assert (tmp_path / "a.csv").exists()


def test_exit_codes_and_effects_that_are_chosen(tmp_path: Path) -> None:
    path = written(tmp_path, PAIR_FILE)
    chosen = run(path, "--accuracy", "1e-3")
    assert chosen.exit_code == 0
    assert "Tolerance 0.001: left out" in " ".join(chosen.stdout.split())
    overloaded = PAIR_FILE.replace("rigid_N", "spring_N").replace('"-x"', '"-x"\nsprung = true').replace("200", "-900")
    path = written(tmp_path, overloaded)
    lost = run(path, "--csv", str(tmp_path / "lost.csv"), "--plot", str(tmp_path / "lost.png"))
    assert lost.exit_code == 1
    assert "is more than the spring's 720 N" in " ".join(lost.stdout.split())
    assert not (tmp_path / "lost.csv").exists() and not (tmp_path / "lost.png").exists()
    shown: dict[str, Any] = json.loads(run(path, "--json").stdout)
    assert shown["status"] == "no_equilibrium" and shown["stiffness_SI"] is None
    assert shown["message"].startswith("No equilibrium: nothing supports the load in channel axial")
    other = CliRunner().invoke(cli, ["stiffness", str(path), "--vary", "speed_rpm=0,1"])
    assert other.exit_code == 1  # no point of the spring's set is solved
    with pytest.raises(qs.SceneFileError, match="makes a set"):
        qs.load_scene(path)
