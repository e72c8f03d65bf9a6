"""`qsbearing compare`: several bearings at the same job."""

from __future__ import annotations

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.studies.design.compare import Compared
from tests.cli.command import call
from tests.systems.sets.arrangements import PAIR_FILE

JOB = (
    '[bearing]\nname = "Turbopump25"\n[operation]\nspeed_rpm = 9000\naxial_load_N = 3000\n[readings.life]\n'
    '[effects]\nball = ["centrifugal_force"]\nraceway_control = "outer"\n'
)


@pytest.fixture
def job(tmp_path: Path) -> Path:
    path = tmp_path / "job.toml"
    path.write_text(JOB)
    return path


SETS = """
bearing.name = "7210C"
rows = [{position_mm = 0, carries = "+x"}, {position_mm = 60, carries = "-x"}]
operation = {speed_rpm = 3000, radial_load_y_N = 500, moment_z_Nm = 0}
preload.rigid_N = 300
"""


def test_sets_are_compared_as_they_are(tmp_path: Path) -> None:
    """Each with its own rows and preload, under the first one's operation."""
    other = SETS.replace("= 60", "= 90").replace("rigid_N = 300", "rigid_N = 400").replace("= 3000", "= 9000")
    for name, text in (("short", SETS), ("long", other)):
        (tmp_path / f"{name}.toml").write_text(text)
    found = qs.compare([tmp_path / "short.toml", tmp_path / "long.toml"])
    assert found.labels == ("short", "long")
    assert {line.name: line.values for line in found.inputs} == {
        "rows.2.position_mm": (60.0, 90.0),
        "preload.rigid_N": (300.0, 400.0),
    }
    alone = qs.solve_set(qs.load_set(tmp_path / "long.toml"))
    assert float(alone.set.operation.speed) == pytest.approx(9000 * qs.rpm)
    (tmp_path / "slow.toml").write_text(other.replace("= 9000", "= 3000"))
    alone = qs.solve_set(qs.load_set(tmp_path / "slow.toml"))
    loads = {line.name: line.values[1] for line in found.results}
    assert loads["row_1_axial_load"] == pytest.approx(alone.axial_loads[0], rel=1e-9)
    assert "rows.2.position_mm" in call("compare", tmp_path / "short.toml", tmp_path / "long.toml").stdout


def test_each_bearing_does_the_same_job(job: Path) -> None:
    found = qs.compare(["b218", "7210C", "7210C_hybrid"], job)
    assert found.labels == ("B218", "7210C", "7210C_hybrid")
    assert found.all_solved
    lines = {line.name: line for line in found.results}
    base = qs.load_scene(job)
    for i, name in enumerate(("b218", "7210C", "7210C_hybrid")):
        solution = qs.solve(dataclasses.replace(base, bearing=qs.load_scene(name).bearing))
        assert lines["inner_load_max"].values[i] == pytest.approx(solution.inner.load.max(), rel=1e-12)
        printed = qs.catalogue_numbers(solution.scene.bearing).get("dynamic_load_rating")
        life = qs.readings.life(solution, dynamic_load_rating=printed).basic_duration / 3600.0
        assert lines["life_basic_duration"].values[i] == pytest.approx(life, rel=1e-12)
    inputs = {line.name: line for line in found.inputs}
    assert inputs["ball_diameter_mm"].values == (22.225, 12.7, 12.7)
    assert inputs["ball_diameter_mm"].difference(1) == pytest.approx(12.7 / 22.225 - 1.0)
    assert "ring_material.elastic_modulus_GPa" not in inputs, "they do not differ in it"


def test_without_a_job_it_is_the_first_s() -> None:
    found = qs.compare(["7210C", "7210C_hybrid"])
    lines = {line.name: line for line in found.results}
    assert lines["inner_load_max"].values[0] == pytest.approx(qs.solve(qs.load_scene("7210C")).inner.load.max())


def test_a_bearing_with_itself_differs_in_nothing(job: Path) -> None:
    found = qs.compare(["b218", "b218"], job)
    assert found.labels == ("B218 (B218) #1", "B218 (B218) #2")
    assert found.inputs == ()
    assert all(line.difference(1) == 0.0 for line in found.results)


def test_a_set_s_rows_take_each_bearing(tmp_path: Path) -> None:
    (tmp_path / "pair.toml").write_text(PAIR_FILE)
    found = qs.compare(["7210C", "7210C_hybrid"], tmp_path / "pair.toml")
    assert found.all_solved
    assert any(line.name == "row_1_axial_load" for line in found.results)


def test_the_job_is_shown_and_what_changes_its_sign_has_no_percentage(job: Path) -> None:
    found = qs.compare(["7210C", "71914C"], job)
    assert found.conditions == (("speed_rpm", 9000.0, "rpm"), ("axial_load_N", 3000.0, "N"))
    line = Compared("x", "um", (-2.0, 4.18, -8.36, 0.0, np.nan))
    assert [line.difference(number) for number in range(5)] == [0.0, 0.0, pytest.approx(3.18), 0.0, 0.0]
    shown = CliRunner().invoke(cli, ["compare", "7210C", "71914C", "--at", str(job)]).stdout
    assert "speed_rpm" in shown and "axial_load_N" in shown


def test_the_command_shows_draws_and_writes(job: Path, tmp_path: Path, drawn: None) -> None:
    picture, table = tmp_path / "a.svg", tmp_path / "a.csv"
    names = ("b218", "7210C", "7210C_hybrid", "turbopump25")
    result = call("compare", *names, "--at", job, "--plot", picture, "--csv", table)
    assert result.exit_code == 0, result.output
    found = qs.compare(names, job)
    lines = {line.name: line for line in found.results}
    value, difference = lines["inner_load_max"].values[3], lines["inner_load_max"].difference(3)
    assert f"{value:.5g} ({100 * difference:+.0f} %)" in result.stdout
    rows = {row["quantity"]: row for row in csv.DictReader(table.read_text().splitlines())}
    assert float(rows["inner_load_max"]["Turbopump25"]) == pytest.approx(value)
    assert "7210C_hybrid" in picture.read_text()


def test_a_bearing_without_equilibrium_stays_in_the_table(job: Path) -> None:
    job.write_text(JOB.replace("3000", "-3000"))
    result = call("compare", "b218", "iso16281_7ball", "--at", job)
    assert result.exit_code == 1
    assert "no_equilibrium" in result.stdout and "converged" in result.stdout


def test_all_that_is_wrong_is_said_at_once(job: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text('[bearing]\nname = "B218"\nball_count = 40\n')
    result = call("compare", "b218", "no_such", bad, tmp_path / "nix.toml", "--at", job, "--plot", "a.txt")
    assert result.exit_code == 2
    for words in ("no_such", "nix.toml", "a.txt"):
        assert words in result.output
    result = call("compare", "b218", bad, "--at", job)
    assert result.exit_code == 2 and "bad.toml: bearing" in result.output
    assert call("compare", "b218").exit_code == 2
