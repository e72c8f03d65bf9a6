"""Sobol indices: those of a sum are the parts of its variance, and together they are one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.pictures.study import picture
from qsbearing.studies.sobol import sobol_indices
from qsbearing.studies.study import Study

pytest.importorskip("xarray")


def test_a_linear_result_is_shared_out_by_its_variances() -> None:
    """The axial load of a held displacement: to first order a sum, so that parts follow from two derivatives."""
    document = {
        "bearing": {"name": "B218"},
        "operation": {"axial_displacement_um": 30.0, "radial_load_y_N": 0, "tilt_y_mrad": 0, "tilt_z_mrad": 0},
    }
    vary = {"axial_displacement_um": "normal(30,0.1)", "ball_material.elastic_modulus_GPa": "normal(208,1)"}
    study = Study.of(document, vary, quantities=["ring_load_axial"])
    indices = sobol_indices(study, 1024)
    steps = {"axial_displacement_um": [29.9, 30.1], "ball_material.elastic_modulus_GPa": [207, 209]}
    slopes = [
        np.ptp(qs.sweep(Study.of(document, {key: both}))["ring_load_axial"].values) for key, both in steps.items()
    ]
    expected = np.square(slopes) / np.square(slopes).sum()
    # 1024 base samples: the estimators' own error is about two hundredths.
    np.testing.assert_allclose(indices["first_order"].sel(result="ring_load_axial"), expected, atol=0.04)
    np.testing.assert_allclose(indices["total"].sel(result="ring_load_axial"), expected, atol=0.04)
    assert indices.attrs["points"] == 4096
    assert indices.attrs["unsolved"] == 0
    # What they say of their own error covers how far off they are, and is about as large as promised.
    for name in ("first_order", "total"):
        error = indices[f"{name}_error"].sel(result="ring_load_axial").values
        off = np.abs(indices[name].sel(result="ring_load_axial").values - expected)
        assert (off < error + 1e-3).all()
        assert (error < 0.15).all()


def test_one_result_of_one_key_hangs_on_that_key_alone() -> None:
    study = Study.of("b218", {"axial_load_N": "uniform(1e3,2e3)"}, quantities=["ring_load_axial"])
    indices = sobol_indices(study, 64)
    # Saltelli's estimators at 64 base samples: a few hundredths.
    np.testing.assert_allclose([indices["first_order"].item(), indices["total"].item()], 1.0, atol=0.05)


def test_what_has_no_indices_is_refused() -> None:
    with pytest.raises(qs.SceneError, match="random keys only"):
        sobol_indices(Study.of("b218", {"speed_rpm": [1, 2]}))
    with pytest.raises(qs.SceneError, match="random keys only"):
        sobol_indices(Study.of("b218", {"speed_rpm": [1, 2], "axial_load_N": "normal(1e4,1)"}))
    with pytest.raises(qs.SceneError, match="power of two"):
        sobol_indices(Study.of("b218", {"axial_load_N": "normal(1e4,1)"}), 100)


def test_several_errors_are_reported_at_once() -> None:
    with pytest.raises(qs.SceneError) as error:
        sobol_indices(Study.of("b218", {"speed_rpm": [1, 2]}, quantities=["inner_lod"]), 100)
    assert len(error.value.errors) == 3


def test_a_result_without_variance_has_none() -> None:
    study = Study.of("b218", {"axial_load_N": "normal(8e3,1e2)"})
    indices = sobol_indices(study, 256).sel(key="axial_load_N")
    assert np.isnan(indices["total"].sel(result="ring_displacement_radial_y"))
    alone = indices.sel(result="inner_load_max")
    assert float(alone["total"]) == pytest.approx(1.0, abs=float(alone["total_error"]))


def test_points_without_a_solution_are_counted() -> None:
    """Half of the axial loads pull the bearing open."""
    indices = sobol_indices(Study.of("b218", {"axial_load_N": "uniform(-1e3,1e3)"}), 64)
    assert indices.attrs["unsolved"] == 3 * 64 / 2
    assert np.isnan(indices["total"]).all()


VARY = ["--vary", "axial_load_N=normal(8000,100)", "--vary", "free_contact_angle_deg=normal(40,0.3)"]


def test_the_command_prints_writes_and_draws_them(tmp_path: Path, drawn: None) -> None:
    given = ["sweep", "b218", *VARY, "--sobol", "64"]
    done = CliRunner().invoke(cli, [*given, "--out", str(tmp_path / "a.nc"), "--plot", str(tmp_path / "a.png")])
    assert done.exit_code == 0, done.output
    vary = {key: values for key, _, values in (text.partition("=") for text in VARY[1::2])}
    indices = sobol_indices(Study.of("b218", vary), 64)
    row = next(line.split() for line in done.stdout.splitlines() if line.startswith("inner_load_max"))
    of_load = indices.sel(result="inner_load_max", key="axial_load_N")
    assert row[1:3] == ["axial_load_N", f"{float(of_load['first_order']):.2f}"]
    with qs.open_results(tmp_path / "a.nc") as kept:
        np.testing.assert_array_equal(kept["total"], indices["total"])
    for form in ("csv", "parquet"):
        assert CliRunner().invoke(cli, [*given, "--out", str(tmp_path / f"a.{form}")]).exit_code == 0
    table = pandas.read_csv(tmp_path / "a.csv")
    parquet = pandas.read_parquet(tmp_path / "a.parquet")
    assert table["total"].tolist() == pytest.approx(indices["total"].values.ravel().tolist(), nan_ok=True)
    assert parquet["total"].tolist() == pytest.approx(table["total"].tolist(), nan_ok=True)
    again = CliRunner().invoke(cli, ["plot", str(tmp_path / "a.nc"), "--out", str(tmp_path / "b.png")])
    assert again.exit_code == 0, again.output
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    wrong = CliRunner().invoke(cli, ["plot", str(tmp_path / "a.nc"), "-y", "inner_lod"])
    assert (wrong.exit_code, "no indices" in wrong.stderr) == (2, True)


def test_what_the_command_cannot_do_is_said_at_once(tmp_path: Path) -> None:
    given = ["sweep", "b218", "--vary", "speed_rpm=1,2", "--vary", "sped=1", "--sobol", "100", "--samples", "5"]
    done = CliRunner().invoke(cli, [*given, "--out", str(tmp_path / "a.txt")])
    assert done.exit_code == 2
    for said in ("power of two", "--samples cannot be used with", "must end in", "sped"):
        assert said in done.stderr
    assert not list(tmp_path.iterdir())


def test_bars_are_the_indices() -> None:
    pytest.importorskip("matplotlib")
    vary = {key: values for key, _, values in (text.partition("=") for text in VARY[1::2])}
    indices = sobol_indices(Study.of("b218", vary), 64)
    (axes,) = picture(indices, y=["inner_load_max"]).axes
    widths = [bar.get_width() for bar in axes.patches]
    of_load = indices.sel(result="inner_load_max")
    np.testing.assert_allclose(widths, [*of_load["total"].values, *np.maximum(of_load["first_order"].values, 0.0)])
