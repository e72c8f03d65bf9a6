"""The table of stiffness over speed and load, from Python and from the command line."""

from __future__ import annotations

import csv
import dataclasses
import io
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.systems.rotor_dynamics import in_rotor_axes, stiffness_columns
from qsbearing.systems.rotor_dynamics.table import matrix_columns

SPEEDS = np.array([0.0, 9_000.0, 18_000.0]) * qs.rpm
LOADS = np.array([[300.0], [900.0], [-50.0]])
VARY = ["--vary", "axial_load_N=300,900,-50", "--vary", "speed_rpm=0,9000,18000"]


def solution() -> qs.Solution:
    scene = qs.load_scene("7210c")
    return qs.solve(dataclasses.replace(scene, operation=qs.Operation(speed=SPEEDS, axial_load=LOADS)))


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_the_columns_are_the_matrix_in_the_rotors_axes() -> None:
    many = solution()
    columns = stiffness_columns(many)
    wanted = in_rotor_axes(many.stiffness).reshape(9, 25)
    names = [name for name in columns if name.startswith("k")]
    assert len(names) == 25
    assert names[:5] == ["kxx_N_per_m", "kxy_N_per_m", "kxz_N_per_m", "kxalpha_N_per_rad", "kxbeta_N_per_rad"]
    assert names[-1] == "kbetabeta_Nm_per_rad"
    np.testing.assert_array_equal(np.stack([columns[name] for name in names], axis=1), wanted)
    np.testing.assert_array_equal(columns["speed_rad_s"], np.tile(SPEEDS, 3))
    np.testing.assert_array_equal(columns["kzz_N_per_m"], many.stiffness[..., 0, 0].ravel())
    turned = stiffness_columns(many, mirrored=True)
    np.testing.assert_array_equal(turned["load_centre_x_mm"], -columns["load_centre_x_mm"])
    for mirrored, whole in ((False, columns), (True, turned)):
        alone = matrix_columns(many, mirrored=mirrored)
        assert list(alone) == names
        for name, values in alone.items():
            np.testing.assert_array_equal(values, whole[name])


def test_the_frame_says_what_varies_and_keeps_what_is_not_solved() -> None:
    pytest.importorskip("pandas")
    frame = qs.stiffness_table(solution())
    assert list(frame.columns[:4]) == ["speed_rpm", "axial_load_N", "speed_rad_s", "status"]
    assert list(frame["status"]) == ["converged"] * 6 + ["no_equilibrium"] * 3
    assert frame["kxx_N_per_m"].notna().tolist() == [True] * 6 + [False] * 3
    assert list(frame["reason"][6:]) == ["open_side"] * 3


def test_a_bearing_that_nothing_loads_has_no_load_centre() -> None:
    """No warning of Python either: those are errors here."""
    scene = qs.load_scene("7210c")
    idle = qs.solve(dataclasses.replace(scene, operation=qs.Operation(axial_load=0.0)))
    columns = stiffness_columns(idle)
    assert columns["kxx_N_per_m"].tolist() == [0.0]
    assert np.isnan(columns["load_centre_x_mm"]).all()


def test_the_command_prints_the_same(tmp_path: Path) -> None:
    printed = CliRunner().invoke(cli, ["stiffness", "7210c", *VARY])
    assert printed.exit_code == 0, printed.output
    found = rows(printed.stdout)
    columns = stiffness_columns(solution())
    for name in ("kxx_N_per_m", "kybeta_N_per_rad", "load_centre_y_mm"):
        assert [float(row[name] or "nan") for row in found] == pytest.approx(list(columns[name]), nan_ok=True)
    assert [float(row["axial_load_N"]) for row in found] == list(np.repeat(LOADS, 3))
    out = tmp_path / "table.csv"
    assert CliRunner().invoke(cli, ["stiffness", "7210c", *VARY, "--out", str(out)]).stdout == ""
    assert out.read_text(encoding="utf-8") == printed.stdout


def test_points_that_describe_no_bearing_keep_their_rows() -> None:
    vary = ["--vary", "inner_groove_radius_mm=6.2,6.58", "--vary", "axial_load_N=500,-500"]
    found = rows(CliRunner().invoke(cli, ["stiffness", "7210c", *vary]).stdout)
    assert [row["status"] for row in found] == ["impossible", "impossible", "converged", "no_equilibrium"]
    assert found[0]["reason"].startswith("bearing.inner_groove_radius_mm")
    assert found[0]["kxx_N_per_m"] == ""


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        (["--vary", "axial_load_N=-1,-2"], 1, "open_side"),
        ([], 2, "nothing varies"),
        (["--vary", "speeed_rpm=1,2"], 2, "speed_rpm"),
        (["--vary", "speed_rpm=1,2", "--out", "/nowhere/x.csv"], 2, "no folder /nowhere"),
    ],
)
def test_exit_codes(arguments: list[str], code: int, said: str) -> None:
    done = CliRunner().invoke(cli, ["stiffness", "7210c", *arguments])
    assert done.exit_code == code
    assert said in done.output


def test_every_chunk_of_a_long_study_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("qsbearing.studies.points.CHUNK", 2)
    found = rows(CliRunner().invoke(cli, ["stiffness", "7210c", *VARY]).stdout)
    assert [row["status"] for row in found] == ["converged"] * 6 + ["no_equilibrium"] * 3
