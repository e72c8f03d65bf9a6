"""The source paper's figures: numbers of independent solutions, and what it states, judged."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from qsbearing.studies.paper import figures
from qsbearing.studies.paper.statements import HERE, Claim, ClaimVerdict, both, falls, judge, rises

xarray = pytest.importorskip("xarray")
FIGURES = {figure.name: figure for figure in figures.FIGURES}


@pytest.fixture(scope="module")
def results() -> dict:
    return {name: figures.sweep(FIGURES[name].study) for name in FIGURES if name.startswith("figure")}


@pytest.fixture(scope="module")
def actual() -> dict:
    """The same with each ball's own contact angle in Hertz's curvatures, as the independent solutions take it."""
    found = {}
    for name in FIGURES:
        if name.startswith("figure"):
            study = FIGURES[name].study
            study.document["effects"]["hertz_angle"] = "actual"
            found[name] = figures.sweep(study)
    return found


def test_figure_19_4_at_the_free_angle_has_the_known_numbers(results: dict) -> None:
    """Half of the last digit that is printed."""
    point = results["figure_19_4"].sel(axial_load_N=17800, speed_rpm=10000).isel(ball=0)
    assert float(point["inner_angle"]) == pytest.approx(49.941413, abs=5e-7)
    assert float(point["outer_angle"]) == pytest.approx(31.336597, abs=5e-7)
    assert float(point["outer_load"]) == pytest.approx(1921.556, abs=5e-4)


@pytest.mark.parametrize(
    ("load", "speed", "inner", "outer", "inner_load", "outer_load"),
    [
        (2000, 6000, 56.5706, 13.9945, 149.779, 400.724),
        (2000, 15000, 59.9217, 2.0430, 144.452, 2526.534),
        (10000, 10000, 53.9996, 23.2540, 772.547, 1320.451),
        (17800, 0, 41.4932, 41.4932, 1679.168, 1679.168),
    ],
)
def test_figure_19_4_has_the_known_numbers(
    actual: dict, load: float, speed: float, inner: float, outer: float, inner_load: float, outer_load: float
) -> None:
    point = actual["figure_19_4"].sel(axial_load_N=load, speed_rpm=speed).isel(ball=0)
    assert float(point["inner_angle"]) == pytest.approx(inner, abs=5e-5)
    assert float(point["outer_angle"]) == pytest.approx(outer, abs=5e-5)
    assert float(point["inner_load"]) == pytest.approx(inner_load, abs=5e-4)
    assert float(point["outer_load"]) == pytest.approx(outer_load, abs=5e-4)


def test_figure_19_5_has_the_known_numbers(actual: dict) -> None:
    """8000 N axial, 4000 N radial, not tilting."""
    point = actual["figure_19_5"].sel(radial_load_y_N=4000)
    assert float(point["ring_displacement_axial"]) == pytest.approx(-93.198, abs=5e-4)
    assert float(point["ring_displacement_radial_y"]) == pytest.approx(94.789, abs=5e-4)
    assert float(point["inner_load"].max()) == pytest.approx(1808.43, abs=5e-3)
    assert float(point["inner_load"].min()) == pytest.approx(305.26, abs=5e-3)


def test_figures_19_6_and_19_7_have_the_known_numbers(actual: dict) -> None:
    few = actual["figure_19_6"].sel(ball_count=12).isel(ball=0)
    assert float(few["inner_angle"]) == pytest.approx(51.88, abs=0.005)
    assert float(few["outer_angle"]) == pytest.approx(27.68, abs=0.005)
    assert float(few["inner_load"]) == pytest.approx(1059, abs=0.5)
    status = actual["figure_19_6"]["status"]
    assert (status.sel(ball_count=slice(8, 17)) == 0).all()
    assert (status.sel(ball_count=slice(18, 20)) == 3).all()
    for f, angle, load, pressure in ((0.515, 54.69, 765.9, 1061), (0.54, 53.39, 778.6, 1305)):
        point = actual["figure_19_7"].sel(groove_radius_coefficient=f).isel(ball=0)
        assert float(point["inner_angle"]) == pytest.approx(angle, abs=0.005)
        assert float(point["inner_load"]) == pytest.approx(load, abs=0.05)
        assert float(point["inner_max_pressure"]) == pytest.approx(pressure, abs=0.5)


def test_what_the_paper_states_is_judged(results: dict) -> None:
    verdicts = {
        statement.sentence: judge(statement, results[name])
        for name in results
        for statement in FIGURES[name].statements
    }
    backwards = "With speed the outer contact angle rises and the inner one falls"
    assert verdicts[backwards].verdict is ClaimVerdict.DOES_NOT_HOLD, "its conclusion prints the trend backwards"
    stiffness = verdicts["With speed the axial stiffness falls"]
    assert stiffness.verdict is ClaimVerdict.HOLDS_IN_A_RANGE, "not monotone"
    assert "axial_load_N 2000: speed_rpm 0 to 5400" in "; ".join(stiffness.where)
    fit = verdicts["That many balls fit on the pitch circle"]
    assert fit.where == ("ball_count 8 to 17",)
    others = set(verdicts) - {backwards, stiffness.statement.sentence, fit.statement.sentence}
    assert {verdicts[sentence].verdict for sentence in others} == {ClaimVerdict.HOLDS}


@pytest.mark.parametrize("name", ["life_groove_radius", "life_ball_count"])
def test_lives_are_those_of_the_reading(name: str) -> None:
    """At one point of each, and what is stated of them holds."""
    results = figures.sweep(FIGURES[name].study)
    assert {judge(statement, results).verdict for statement in FIGURES[name].statements} == {ClaimVerdict.HOLDS}
    scene = qs.load_scene("b218")
    scene = replace(scene, operation=qs.Operation(speed=10_000 * qs.rpm, axial_load=10 * qs.kN))
    if name == "life_ball_count":
        bearing, point = replace(scene.bearing, ball_count=14), results.sel(ball_count=14)
    else:
        radius = 0.52 * scene.bearing.ball_diameter
        bearing = replace(scene.bearing, inner_groove_radius=radius, outer_groove_radius=radius)
        point = results.sel(groove_radius_coefficient=0.52, method="nearest")
    life = qs.readings.life(qs.solve(replace(scene, bearing=bearing)))
    assert float(point["life_inner_life"]) == pytest.approx(float(life.inner_life) / 1e6, rel=1e-9)


def test_verdicts_look_at_solved_points_only() -> None:
    x = np.arange(6.0)
    y = np.array([0.0, 1.0, 2.0, 1.5, 1.0, 0.0])
    status = np.array([0, 0, 0, 0, 1, 0])
    data = xarray.Dataset({"y": ("x", np.where(status, np.nan, y)), "status": ("x", status)}, {"x": x})
    up, down = Claim("", HERE, rises("y", "x")), Claim("", HERE, falls("y", "x"))
    assert (judge(up, data).verdict, judge(up, data).where) == (ClaimVerdict.HOLDS_IN_A_RANGE, ("x 0 to 2",))
    assert judge(down, data).where == ("x 2 to 3",)
    assert judge(Claim("", HERE, both(up.test, down.test)), data).verdict is ClaimVerdict.DOES_NOT_HOLD
    assert judge(up, data.isel(x=slice(0, 3))).verdict is ClaimVerdict.HOLDS
    assert judge(Claim("", HERE, lambda results: results["y"] < 1.8), data).where == ("x 0 to 1, 3 to 3, 5 to 5",)


def test_the_command_writes_pictures_results_and_study_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(figures, "FIGURES", (FIGURES["figure_19_6"],))
    done = CliRunner().invoke(cli, ["figures", "--out", str(tmp_path)])
    assert done.exit_code == 0, done.output
    assert {file.suffix for file in tmp_path.iterdir()} == {".png", ".nc", ".toml"}
    assert "holds" in done.stdout
    again = CliRunner().invoke(cli, ["sweep", str(tmp_path / "figure_19_6.toml")])
    assert again.exit_code == 0, again.output
    assert CliRunner().invoke(cli, ["figures", "--out", str(tmp_path / "none" / "here")]).exit_code == 2
