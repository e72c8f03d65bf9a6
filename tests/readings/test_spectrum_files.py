"""Load spectra in scene files: the numbers of Python in tables and JSON; every fault at once, by its point."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_file import scene_of
from qsbearing.files.set_file import set_of
from qsbearing.results.tables import digits_of

GUIDE = (Path(qs.__file__).parent / "guide" / "readings.md").read_text(encoding="utf-8")


def guide_s_file() -> str:
    """The file of the guide's section."""
    return re.findall(r"```toml\n(.*?)```", GUIDE[GUIDE.index("## Load spectra") :], flags=re.DOTALL)[0]


def document(**changes: Any) -> dict[str, Any]:
    return tomllib.loads(guide_s_file()) | changes


def faults(given: dict[str, Any]) -> dict[str, str]:
    with pytest.raises(SceneFileError) as caught:
        scene_of(given, "test")
    return {error.key: str(error) for error in caught.value.errors}  # type: ignore[attr-defined]


def test_a_spectrum_is_its_points() -> None:
    """Each as a file of its own, and Palmgren's sum of what they do."""
    solution = qs.solve(scene_of(document(), "test"))
    assert solution.shape == (2,)
    rate = []
    for k, point in enumerate(document()["spectrum"]):
        operation = document()["operation"] | {key: value for key, value in point.items() if key != "share"}
        alone = document(operation=operation)
        del alone["spectrum"]
        one = qs.solve(scene_of(alone, "test"))
        assert solution.inner.load[k] == pytest.approx(one.inner.load, rel=1e-12)
        rate.append(point["share"] * point["speed_rpm"] / 60.0 / qs.readings.life(one).basic_reference_rating_life)
    found = qs.readings.take_asked(solution)["spectrum"]
    assert found.duration == pytest.approx(1.0 / sum(rate))
    assert found.damage_share == pytest.approx(np.array(rate) / sum(rate))


def test_run_shows_it(tmp_path: Path) -> None:
    file, csv = tmp_path / "my.toml", tmp_path / "my.csv"
    file.write_text(guide_s_file(), encoding="utf-8")
    found = qs.readings.take_asked(qs.solve(qs.load_scene(file)))["spectrum"]
    shown = CliRunner().invoke(cli, ["run", str(file), "--csv", str(csv)])
    assert shown.exit_code == 0, shown.output
    for words in (
        "2 operating points",
        "Life under the whole spectrum",
        "damage",
        f"{digits_of(found.duration / 3600)} h",
    ):
        assert words in shown.output, words
    assert len(csv.read_text(encoding="utf-8").splitlines()) == 33
    printed = CliRunner().invoke(cli, ["run", str(file), "--json"])
    assert printed.exit_code == 0, printed.output
    record = json.loads(printed.stdout)
    assert record["duration_h"] == pytest.approx(found.duration / 3600)
    assert record["life_Mrev"] == pytest.approx(found.life / 1e6)
    assert [point["share"] for point in record["points"]] == [0.9, 0.1]
    assert sum(point["damage_share"] for point in record["points"]) == pytest.approx(1.0)
    assert record["points"][1]["load"]["radial_y_N"] == pytest.approx(4000)
    for command in (["explain", str(file)], ["run", str(file), "--plot", str(tmp_path / "my.png")]):
        refused = CliRunner().invoke(cli, command)
        assert refused.exit_code == 2
    assert "[[spectrum]]" in str(faults_of_study(document())[0])


PAIR = """
[bearing]
name = "7210C"
[[rows]]
position_mm = -20
carries = "+x"
[[rows]]
position_mm = 20
carries = "-x"
{own}
[operation]
moment_z_Nm = 0
[preload]
rigid_N = 300
[[spectrum]]
share = 0.7
speed_rpm = 9000
radial_load_y_N = 500
[[spectrum]]
share = 0.3
speed_rpm = 3000
radial_load_y_N = 2500
axial_load_N = 400
[readings.life]
"""


def pair(own: str = "") -> dict[str, Any]:
    given = tomllib.loads(PAIR.format(own=own))
    given["operation"]["axial_load_N"] = 0.0
    return given


@pytest.mark.parametrize("own", ["", "[rows.readings.life]\nreliability = 0.95\n"], ids=["alike", "a row of its own"])
def test_a_set_has_a_life_for_each_row_and_for_all(own: str, tmp_path: Path) -> None:
    """Each point as a file of its own, Palmgren's sum for each row, and rows that fail independently."""
    rates = np.zeros(2)
    for point in pair(own)["spectrum"]:
        alone = pair(own)
        del alone["spectrum"]
        alone["operation"] |= {key: value for key, value in point.items() if key != "share"}
        solution = qs.solve_set(set_of(alone, "test"))
        for i, row in enumerate(solution.rows):
            rates[i] += point["share"] / float(qs.readings.take_asked(row)["life"].duration)
    hours = 1.0 / rates / 3600.0
    file, csv = tmp_path / "pair.toml", tmp_path / "pair.csv"
    file.write_text(PAIR.format(own=own).replace("[operation]", "[operation]\naxial_load_N = 0"), encoding="utf-8")
    printed = CliRunner().invoke(cli, ["run", str(file), "--json", "--csv", str(csv)])
    assert printed.exit_code == 0, printed.output
    record = json.loads(printed.stdout)
    assert [row["duration_h"] for row in record["rows"]] == pytest.approx(hours, rel=1e-9)
    assert record["system_life_h"] == pytest.approx((hours ** (-10 / 9)).sum() ** (-9 / 10), rel=1e-9)
    for i in range(2):
        assert sum(point["rows"][i]["damage_share"] for point in record["points"]) == pytest.approx(1.0)
    assert len(csv.read_text(encoding="utf-8").splitlines()) == 1 + 2 * 2 * int(
        qs.load_scene("7210C").bearing.ball_count
    )
    (tmp_path / "again.json").write_text(printed.stdout, encoding="utf-8")
    again = CliRunner().invoke(cli, ["run", str(tmp_path / "again.json"), "--json"])
    assert json.loads(again.stdout)["system_life_h"] == pytest.approx(record["system_life_h"], rel=1e-12)
    shown = CliRunner().invoke(cli, ["run", str(file)])
    assert digits_of(record["system_life_h"]) in shown.output


def test_every_row_needs_a_life_and_every_point_its_keys() -> None:
    wrong = pair("[rows.readings.static]\n")
    wrong["spectrum"][0]["share"] = 0.2
    del wrong["spectrum"][1]["speed_rpm"]
    with pytest.raises(SceneFileError) as caught:
        set_of(wrong, "test")
    assert {error.key for error in caught.value.errors} >= {"row 2.readings.life", "spectrum.share"}  # type: ignore[attr-defined]


def faults_of_study(given: dict[str, Any]) -> list[Any]:
    with pytest.raises(SceneFileError) as caught:
        qs.Study.of(given, {"speed_rpm": [1.0, 2.0]})
    return list(caught.value.errors)


def test_a_point_that_is_not_solved(tmp_path: Path) -> None:
    """The spectrum then has no life, and says which point fails."""
    file = tmp_path / "my.toml"
    file.write_text(guide_s_file().replace("axial_load_N = 15000", "axial_load_N = -15000"), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", str(file), "--json"])
    assert done.exit_code == 1
    record = json.loads(done.stdout)
    assert record["duration_h"] is None
    assert [point["status"] for point in record["points"]] == ["converged", "no_equilibrium"]
    assert record["status"] == "no_equilibrium"
    assert "Life under all" not in CliRunner().invoke(cli, ["run", str(file)]).output


def test_every_fault_at_once() -> None:
    first, second = document()["spectrum"]
    found = faults(
        document(
            bearing={"name": "B218", "ball_count": -4},
            spectrum=[first | {"share": 90}, {"speed_rpm": "fast", "axial_load_kN": 3, "radial_load_y_N": 1}],
            readings={"stress": True},
        )
    )
    assert set(found) == {
        "spectrum point 1.share", "spectrum point 2.share", "spectrum point 2.speed_rpm",
        "spectrum point 2.axial_load_kN", "bearing.ball_count", "readings.life",
    }  # fmt: skip
    assert "90 % = 0.9" in found["spectrum point 1.share"]
    assert "axial_load_N = 3000" in found["spectrum point 2.axial_load_kN"]
    assert "adds up to 0.95" in faults(document(spectrum=[first, second | {"share": 0.05}]))["spectrum.share"]
    fast = faults(document(spectrum=[first, second | {"speed_rpm": 1e12}]))
    assert set(fast) == {"spectrum point 2.speed_rpm"}
    assert "rpm" in fast["spectrum point 2.speed_rpm"]
    common = document(operation=document()["operation"] | {"outer_speed_rpm": 1e12})
    assert set(faults(common)) == {"operation.outer_speed_rpm"}
    assert set(faults(document(readings=True))) == {"readings"}
    for wrong in ([], {"share": 1.0}, 3):
        assert set(faults(document(spectrum=wrong))) == {"[[spectrum]]"}


def test_points_give_the_same_channels() -> None:
    first, second = document()["spectrum"]
    moved = {key: value for key, value in second.items() if key != "axial_load_N"} | {"axial_displacement_um": 20}
    found = faults(document(spectrum=[first, moved]))
    assert set(found) == {"spectrum point 2.axial_load_N", "spectrum point 1.axial_displacement_um"}
