"""Sweeps of a set: the keys of its file over ranges, to the numbers that Python finds."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import qsbearing as qs
from qsbearing.cli import cli
from tests.systems.sets.arrangements import PAIR_FILE
from tests.systems.sets.test_files import written

pytest.importorskip("xarray")

SINGLE = '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 0\n[preload]\nrigid_N = 500\n'


def test_a_sweep_finds_what_python_does(tmp_path: Path) -> None:
    """Preload, load and speed; a preload that varies leaves the shaft its axial load."""
    path = written(tmp_path, PAIR_FILE + "[readings.life]\n")
    vary = {"speed_rpm": [0, 5000, 12000], "rigid_N": [240, 720], "axial_load_N": [0, 200]}
    found = qs.sweep(qs.Study.of(path, vary))
    assert dict(found.sizes) == {"speed_rpm": 3, "rigid_N": 2, "axial_load_N": 2}
    assert (found["status"] == 0).all()
    speed = np.array([0.0, 5000.0, 12000.0])[:, None, None] * qs.rpm
    base = qs.load_set(path)
    operation = replace(base.operation, speed=speed, axial_load=np.array([0.0, 200.0]))
    by_hand = qs.solve_set(replace(base, operation=operation, preload=qs.Preload(rigid=np.array([[240.0], [720.0]]))))
    life = qs.readings.life(by_hand.rows[1], **base.readings["life"]).basic_reference_rating_life  # C of the catalogue
    for name, values in {
        "row_1_axial_load": by_hand.axial_loads[..., 0],
        "row_2_preload_at_rest": by_hand.preload_at_rest[..., 1],  # type: ignore[index]
        "row_2_preload_in_operation": by_hand.preload_in_operation[..., 1],  # type: ignore[index]
        "row_2_inner_load_max": by_hand.rows[1].inner.load.max(axis=-1),
        "shaft_displacement_axial": by_hand.displacement[..., 0] / qs.um,
        "shaft_effective_stiffness_axial": by_hand.effective_stiffness[..., 0] * qs.um,
        "row_2_life_basic_reference_rating_life": life / 1e6,
    }.items():
        np.testing.assert_allclose(found[name], values, rtol=1e-9, atol=1e-12, err_msg=name)
    assert found["row_1_axial_load"].attrs["units"] == "N"


def test_a_mounted_preload_varies_as_one_before_fitting_does(tmp_path: Path) -> None:
    fit = "[effects.ring_expansion]\nbore_diameter_mm = 50\noutside_diameter_mm = 90\nshaft_interference_um = 8\n"
    for text, result in ((PAIR_FILE + fit, "row_1_preload_mounted"), (SINGLE + fit, "ring_load_axial")):
        found = qs.sweep(qs.Study.of(written(tmp_path, text), {"preload.mounted_N": [300, 900]}))
        assert (found["status"] == 0).all()
        np.testing.assert_allclose(found[result], [300.0, 900.0], rtol=1e-9)


def test_points_without_equilibrium_stay(tmp_path: Path) -> None:
    sprung = PAIR_FILE.replace("rigid_N", "spring_N").replace('"-x"', '"-x"\nsprung = true')
    study = qs.Study.of(written(tmp_path, sprung), {"axial_load_N": [-900, 0], "ball_diameter_mm": [12.7, 40.0]})
    found = qs.sweep(study)
    meanings = found["status"].attrs["flag_meanings"].split()
    words = [[meanings[int(code)] for code in row] for row in found["status"].values]
    assert words == [["no_equilibrium", "impossible"], ["converged", "impossible"]]
    reasons = found["reason"].attrs["flag_meanings"].split()
    assert reasons[int(found["reason"][0, 0])] == "unsupported"
    assert np.isnan(found["row_1_axial_load"][0]).all()


def test_the_command_sweeps_a_set(tmp_path: Path, drawn: None) -> None:
    pytest.importorskip("matplotlib")
    path, out, picture = written(tmp_path, PAIR_FILE), tmp_path / "out.nc", tmp_path / "out.png"
    options = ["--vary", "speed_rpm=0:12000:4", "--vary", "rigid_N=240,720", "--out", str(out), "--plot", str(picture)]
    done = CliRunner().invoke(cli, ["sweep", str(path), *options], catch_exceptions=False)
    assert done.exit_code == 0
    assert "row_1_axial_load" in done.stdout
    assert picture.stat().st_size > 10_000
    assert qs.open_results(out)["shaft_load_axial"].values == pytest.approx(200.0, rel=1e-15)
    wrong = CliRunner().invoke(cli, ["sweep", str(path), "--vary", "spring_N=1,2"])
    assert wrong.exit_code == 2 and "Give sprung = true to each row" in wrong.stderr


def test_rows_share_a_panel_and_the_title_names_bearing_and_preload(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    from qsbearing.pictures.study import picture

    found = qs.sweep(qs.Study.of(written(tmp_path, PAIR_FILE), {"speed_rpm": [0, 6000, 12000]}))
    figure = picture(found)
    rows = {axes.get_title("left").partition(",")[0]: len(axes.lines) for axes in figure.axes}
    assert rows["axial load"] == rows["inner contact load"] == 2  # one panel, so one scale
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()][:2] == ["row 1", "row 2"]
    title = figure.get_suptitle().replace("\n", " ")
    assert "2 rows 7210C" in title
    assert "rigid preload" in title
