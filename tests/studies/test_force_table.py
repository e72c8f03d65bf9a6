"""Tables of forces: what stands in them, and by how much they err, measured here by other means."""

from __future__ import annotations

import dataclasses
import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.model.solution import solver
from qsbearing.results.remarks import blocks, every_remark
from qsbearing.studies.force_table.refined_grid import GridPoints, RefinedGrid
from qsbearing.studies.force_table.spline import Interpolation, interpolated

xarray = pytest.importorskip("xarray")
pytest.importorskip("h5netcdf")

AXES = {"axial_displacement": (-5 * qs.um, 30 * qs.um), "radial_displacement_y": (-8 * qs.um, 8 * qs.um)}


@pytest.fixture(scope="module")
def scene() -> qs.Scene:
    """7210C at 12,000 rpm under combined load, on a shaft that does not tilt."""
    point = qs.Operation(
        speed=12_000 * qs.rpm, axial_load=1000.0, radial_load_y=300.0, radial_load_z=0.0, tilt_y=0.0, tilt_z=0.0
    )
    return dataclasses.replace(qs.load_scene("7210c"), operation=point)


def at(scene: qs.Scene, speed: NDArray, x: NDArray, y: NDArray) -> qs.Solution:
    """GridPoints without anything of tables; z carries no load, as in the scene."""
    point = qs.Operation(
        speed=speed, axial_displacement=x, radial_displacement_y=y, radial_load_z=0.0, tilt_y=0.0, tilt_z=0.0
    )
    return qs.solve(dataclasses.replace(scene, operation=point))


@pytest.mark.parametrize(("how", "method"), [("linear", "linear"), ("cubic", "cubic")])
def test_errors_are_those_of_a_reader_elsewhere(scene: qs.Scene, how: str, method: str) -> None:
    """Other points, scipy's own interpolator, solutions of `qs.solve`: as much as the table says, over a fifth."""
    table = qs.force_table(scene, AXES, interpolation=how, wished_error=0.02)
    told = [table[name].attrs for name in ("axial_load_N", "radial_load_y_N")]
    drawn = np.random.default_rng(77).random((4000, 3))
    grid = [each.values for each in table.coords.values()]
    ends = np.array([(each[0], each[-1]) for each in grid])
    places = ends[:, 0] + drawn * (ends[:, 1] - ends[:, 0])
    solved = at(scene, *(places * [qs.rpm, qs.um, qs.um]).T)
    for number, (name, said) in enumerate(zip(("axial_load_N", "radial_load_y_N"), told, strict=True)):
        read = RegularGridInterpolator(grid, table[name].values, method=method)(places)
        errors = np.abs(read - solved.load[:, number])
        assert np.quantile(errors, 0.95) == pytest.approx(said["error_95"], rel=0.2)
        assert errors.max() == pytest.approx(said["error_largest"], rel=0.5)
        size = float(np.linalg.norm(qs.solve(scene).load[:3]))
        assert said["error_largest_percent"] == pytest.approx(100.0 * said["error_largest"] / size, rel=1e-9)
        assert said["error_largest_percent"] <= 2.0
    assert table.attrs["wish_is_met"] == 1


def test_on_the_grid_it_is_the_solution(scene: qs.Scene) -> None:
    table = qs.force_table(scene, AXES, wished_error=0.05)
    assert list(table.coords) == ["speed_rpm", "axial_displacement_um", "radial_displacement_y_um"]
    assert [table[each].attrs["range"] for each in table.coords] == ["assumed", "given", "given"]
    speed, x, y = np.meshgrid(*(each.values for each in table.coords.values()), indexing="ij")
    solved = at(scene, speed * qs.rpm, x * qs.um, y * qs.um)
    assert table["stiffness_SI"].shape == solved.stiffness.shape
    for number, name in enumerate(("axial_load_N", "radial_load_y_N", "radial_load_z_N", "moment_y_Nm", "moment_z_Nm")):
        np.testing.assert_allclose(table[name], solved.load[..., number], rtol=1e-7, atol=1e-7)
    np.testing.assert_allclose(table["stiffness_SI"], solved.stiffness, rtol=1e-6, atol=1.0)
    balls = (solved.inner.load > 0.0).sum(axis=-1)
    assert np.array_equal(table["loaded_balls"], balls)
    assert table.attrs["points_with_some_unloaded_balls"] == ((balls > 0) & (balls < 15)).sum() > 0
    assert table.attrs["points_without_loaded_balls"] == (balls == 0).sum() > 0


def test_finer_is_better_and_the_bound_holds(scene: qs.Scene) -> None:
    coarse, fine = (qs.force_table(scene, AXES, wished_error=each) for each in (0.05, 0.01))
    assert coarse.attrs["points"] < fine.attrs["points"]
    assert coarse["axial_load_N"].attrs["error_largest_percent"] > fine["axial_load_N"].attrs["error_largest_percent"]
    bound = qs.force_table(scene, AXES, wished_error=0.001, most_points=2000)
    assert 1000 < bound.attrs["points"] <= 2000
    assert bound.attrs["wish_is_met"] == 0
    worst = max(bound[name].attrs["error_largest_percent"] for name in ("axial_load_N", "radial_load_y_N"))
    assert worst > 0.1


def test_ranges_that_are_not_given_follow_from_the_load(scene: qs.Scene) -> None:
    table = qs.force_table(
        scene, {"axial_displacement": None, "tilt_y": None, "speed": (1000.0, 1000.0)}, most_points=900
    )
    both = dataclasses.replace(scene.operation, speed=[0.0, scene.operation.speed])
    moved = qs.solve(dataclasses.replace(scene, operation=both)).displacement[:, 0]
    axial = table["axial_displacement_um"].values * qs.um
    assert axial[-1] == pytest.approx(2.0 * max(moved), rel=0.1)
    assert axial[0] == pytest.approx(-0.25 * 2.0 * max(moved), rel=0.1)
    tilts = table["tilt_y_mrad"].values
    assert tilts[0] == -tilts[-1]
    assert tilts[-1] * qs.mrad == pytest.approx(axial[-1] / 0.035, rel=0.15), "half the pitch diameter is 35 mm"
    assert "speed_rpm" not in table.coords


def test_a_two_sided_bearing_spans_both_its_sides() -> None:
    bearing = dataclasses.replace(qs.load_scene("iso16281_7ball").bearing)
    point = qs.Operation(axial_load=200.0, radial_load_y=500.0, tilt_y=0.0, tilt_z=0.0)
    table = qs.force_table(qs.Scene(bearing, point), most_points=3000, wished_error=0.05)
    assert bearing.kind == qs.BearingKind.DEEP_GROOVE
    loads = table["axial_load_N"].values[[0, -1]]
    assert loads.min(axis=1)[0] < -500.0 < 500.0 < loads.max(axis=1)[1]


def power(places: NDArray) -> GridPoints:
    """x to the power of 1.5 where x is positive, times 1 + y; nothing above y = 0.9."""
    x, y = places.T
    load = np.zeros((len(x), 5))
    load[:, 0] = np.maximum(x, 0.0) ** 1.5 * (1.0 + y)
    lost = y > 0.9
    load[lost] = np.nan
    return GridPoints(load, np.zeros((len(x), 5, 5)), lost.astype(np.int8), np.zeros(len(x), np.int16))


def test_places_are_where_the_force_bends() -> None:
    grid = RefinedGrid([(-1.0, 1.0), (0.0, 0.8)], power, Interpolation.LINEAR, 0)
    errors = grid.refine(2e-3, np.ones(5), 10_000, 2000)
    x, y = grid.axes
    assert errors.unjudged == 0
    assert 1e-4 < errors.largest[0] <= 2e-3
    assert (np.sum(x < -0.01), len(y)) == (2, 5), "nothing bends below zero, nor along y"
    steps = np.diff(x[x >= 0.0])
    assert steps[0] <= 0.5 * steps[-1], "and most near zero"
    known = power(np.stack(np.meshgrid(x, y, indexing="ij"), -1).reshape(-1, 2)).load[:, 0]
    assert np.array_equal(grid.solved.load[..., 0].ravel(), known), "each number in its place after all insertions"


@pytest.mark.parametrize("how", Interpolation)
def test_beside_points_without_equilibrium_nothing_is_judged(how: Interpolation) -> None:
    """And no spline goes through them."""
    grid = RefinedGrid([(-1.0, 1.0), (0.0, 1.0)], power, how, 0)
    errors = grid.refine(2e-3, np.ones(5), 10_000, 2000)
    assert grid.interpolation is Interpolation.LINEAR
    below = grid.axes[1][grid.axes[1] <= 0.9].max()
    assert errors.unjudged == pytest.approx(2000 * (1.0 - below), rel=0.2)
    assert errors.largest[0] <= 2e-3
    assert np.isnan(grid.solved.load[:, grid.axes[1] > 0.9]).all()


def test_a_spline_is_that_of_scipy() -> None:
    axes = [np.sort(np.random.default_rng(1).random(n)) for n in (6, 7)]
    values = np.random.default_rng(2).random((6, 7, 2))
    places = np.random.default_rng(3).uniform(0.4, 0.6, (50, 2))
    for degree, method in ((1, "linear"), (3, "cubic")):
        # The tensor product, one axis after the other.
        found = interpolated(axes, values, places, degree)
        for k in range(2):
            other = RegularGridInterpolator(axes, values[..., k], method=method)(places)
            np.testing.assert_allclose(found[:, k], other, rtol=1e-5, atol=1e-6)


def test_all_that_is_wrong_is_told_at_once(scene: qs.Scene) -> None:
    with pytest.raises(qs.SceneError) as caught:
        qs.force_table(
            dataclasses.replace(scene, operation=dataclasses.replace(scene.operation, axial_load=[1.0, 2.0])),
            {"axial_displacment": None, "tilt_y": (3e-3, 1e-3), "speed": 5.0, "radial_displacement_y": (0.0, 1.0)},  # type: ignore[dict-item]
            wished_error=0.0,
            most_points=1,
            interpolation="spline",
        )
    fields = [each.field for each in caught.value.errors]
    assert fields == [
        "operation", "over.axial_displacment", "over.tilt_y", "over.speed", "over.radial_displacement_y",
        "wished_error", "most_points", "interpolation",
    ]  # fmt: skip
    still = dataclasses.replace(scene, operation=qs.Operation(axial_load=0.0))
    with pytest.raises(qs.SceneError, match="no channel of the scene carries a load"):
        qs.force_table(still)
    with pytest.raises(qs.SceneError, match="no load moves its ring"):
        qs.force_table(still, {"axial_displacement": None})
    with pytest.raises(qs.SceneError, match="too small for 2 axes"):
        qs.force_table(scene, {"axial_displacement": None}, most_points=24)


def run(*words: str) -> tuple[int, str, str]:
    done = CliRunner().invoke(cli, ["table", *words])
    return done.exit_code, done.stdout, done.stderr


def test_the_command_writes_what_python_returns(scene: qs.Scene, tmp_path: Path) -> None:
    out, csv = tmp_path / "table.nc", tmp_path / "table.csv"
    words = ["7210c", "--over", "axial_displacement_um=-5:30", "--over", "speed_rpm=0:12000", "--error", "2"]
    code, shown, _ = run(*words, "--out", str(out), "--csv", str(csv))
    assert code == 0
    assert "axial_displacement_um" in shown and "as wished" in shown
    made = qs.force_table(
        qs.load_scene("7210c"),
        {"axial_displacement": (-5 * qs.um, 30 * qs.um), "speed": (0.0, 12_000 * qs.rpm)},
        wished_error=0.02,
    )
    with xarray.open_dataset(out, engine="h5netcdf") as read:
        xarray.testing.assert_equal(read.load(), made)
        assert read["axial_load_N"].attrs["units"] == "N"
        assert read.attrs["points"] == made["status"].size
    assert "hypotheses_differ" in [each["code"] for each in json.loads(made.attrs["remarks"])]
    heading, *rows = csv.read_text().splitlines()
    assert len(rows) == made["status"].size
    names, last = heading.split(","), rows[-1].split(",")
    assert float(last[names.index("axial_load_N")]) == made["axial_load_N"].values[-1, -1]
    assert float(last[names.index("k_x_tilt_z_SI")]) == made["stiffness_SI"].values[-1, -1, 0, 4]
    assert last[names.index("status")] == "converged"


def test_the_command_solves_the_scene_once_and_says_its_remarks(monkeypatch: pytest.MonkeyPatch) -> None:
    given, solve = qs.load_scene("7210c"), solver.solve
    own = []

    def counted(scene: qs.Scene, **how: Any) -> qs.Solution:
        own.extend([scene] if solver._is_equal(scene, given) else [])
        return solve(scene, **how)

    monkeypatch.setattr(solver, "solve", counted)
    held = ["--over", "axial_displacement_um=10:20", "--over", "speed_rpm=0:12000"]
    code, _, said = run("7210c", *held, "--error", "10")
    assert code == 0
    assert len(own) == 1
    remarks = blocks(every_remark(qs.solve(given)))
    assert remarks and all(each.said in said for each in remarks)


def test_exit_codes(tmp_path: Path) -> None:
    held = ["--over", "axial_displacement_um=10:20", "--over", "speed_rpm=10000"]
    code, shown, said = run("b218", *held, "--error", "0.001", "--points", "5", "--csv", str(tmp_path / "b.csv"))
    assert code == 3 and "not the 0.001 % that is wished" in " ".join(shown.split()) and "--error 0.001" in said
    assert (tmp_path / "b.csv").exists()
    away = [
        "--set",
        "effects.raceway_control=inner",
        "--over",
        "axial_displacement_um=-20:-10",
        "--over",
        "speed_rpm=24500",
    ]
    code, _, said = run("7210c", *away, "--csv", str(tmp_path / "none.csv"))
    assert code == 1 and "no point is solved" in said
    assert not (tmp_path / "none.csv").exists()
    wrong = [
        "--over",
        "foo",
        "--over",
        "tilt_y_mrad=1:x",
        "--over",
        "axial_displacement_um=9:1",
        "--error",
        "0",
        "--seed",
        "-1",
    ]
    wrong += ["--points", "1", "--interpolation", "cubik", "--out", "t.csv", "--csv", str(tmp_path / "no" / "t.csv")]
    code, _, said = run("b218", *wrong)
    assert code == 2
    told = [line for line in said.splitlines() if line.startswith("qsbearing: ")]
    assert len(told) == 9, said
    assert "--over axial_displacement_um = 9 µm: is reversed" in said
    assert "speed_rpm, axial_displacement_um" in said
    code, _, said = run("nosuch", "--error", "0")
    assert code == 2 and "nosuch" in said and "--error = 0" in said


def test_a_set_has_no_table(tmp_path: Path) -> None:
    text = CliRunner().invoke(cli, ["init", "--set"]).stdout
    (tmp_path / "pair.toml").write_text(text)
    code, _, said = run(str(tmp_path / "pair.toml"))
    assert code == 2 and "a table is of one bearing" in said


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_interrupted_it_leaves_no_file(tmp_path: Path) -> None:
    free = "axial_displacement_um", "radial_displacement_y_um", "radial_displacement_z_um"
    words = ["7210c", "--set", "operation.tilt_y_mrad=0", "--set", "operation.tilt_z_mrad=0", "--points", "10000000"]
    words += [word for each in free for word in ("--over", each)]
    words += ["--error", "0.0001", "--out", "t.nc", "--csv", "t.csv"]
    program = [sys.executable, "-m", "qsbearing", "table", *words]
    with subprocess.Popen(program, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as running:
        end = time.monotonic() + 60.0
        while len(list(tmp_path.iterdir())) < 2 and time.monotonic() < end:
            time.sleep(0.05)
        assert len(list(tmp_path.glob(".t.*.part"))) == 2, "both files are claimed before the work begins"
        time.sleep(1.0)
        running.send_signal(signal.SIGINT)
        _, said = running.communicate(timeout=60)
    assert running.returncode == 130
    assert "interrupted" in said
    assert list(tmp_path.iterdir()) == []
