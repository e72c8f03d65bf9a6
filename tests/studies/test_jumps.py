"""Jumps between neighbours are found, each with its cause; curves that only bend have none."""

from __future__ import annotations

import numpy as np
import pytest

from qsbearing.pictures.study import picture
from qsbearing.pictures.study.jumps import Cause, jumps
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

xarray = pytest.importorskip("xarray")

OPERATION = {"axial_load_N": 1000, "speed_rpm": 9000, "radial_load_y_N": 2500, "tilt_z_mrad": 0, "tilt_y_mrad": 0}


def study_of(control: str, speeds: str) -> Study:
    effects = {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": control}
    document = {"bearing": {"name": "B218"}, "operation": dict(OPERATION), "effects": effects}
    return Study.of(document, {"speed_rpm": speeds})


def made(angle: list[float], **others: list[float]) -> object:
    x = np.arange(float(len(angle)))
    status = np.where(np.isnan(angle), 1, 0)
    variables = {"status": ("x", status), "inner_angle": (("x", "ball"), np.array(angle, float)[:, None])}
    for name, values in others.items():
        dims = ("x", "ball") if name == "inner_raceway_controls" else ("x",)
        variables[name] = (dims, np.array(values, float).reshape(-1, *(1,) * (len(dims) - 1)))
    return xarray.Dataset(variables, {"x": x})


def test_each_cause_is_named() -> None:
    nan = np.nan
    assert jumps(made([1, 2, 19, 20, 21]), "x").values.tolist() == [0, Cause.UNKNOWN, 0, 0]
    lost = made([1, 2, 19, 20, 21], balls_off_inner=[0, 0, 1, 1, 1])
    assert jumps(lost, "x").values.tolist() == [0, Cause.CONTACT_IS_LOST, 0, 0]
    assert jumps(made([1, 2, nan, 4, 5]), "x").values.tolist() == [0, Cause.BRANCH_ENDS, Cause.BRANCH_ENDS, 0]
    switched = made([1, 2, 3, 4], inner_raceway_controls=[0, 0, 1, 1])
    assert jumps(switched, "x").values.tolist() == [0, Cause.CONTROL_SWITCHES, 0]


def test_a_bend_is_no_jump() -> None:
    x = np.linspace(0.0, 1.0, 30)
    for curve in (np.maximum(0.0, x - 0.5) * 90, 90 * np.sqrt(x), 40 + 20 * np.tanh(8 * (x - 0.4))):
        lost = made(list(curve), balls_off_inner=list((x > 0.5).astype(float)))
        assert not jumps(lost, "x").values.any()


def test_the_first_and_last_of_a_few_points_are_no_jumps() -> None:
    assert not jumps(made([55.0, 56.5, 56.8, 56.7, 54.0]), "x").values.any(), "one neighbour alone tells nothing"


def test_control_switches_of_a_sweep_are_marked() -> None:
    results = sweep(study_of("per_ball", "0:20000:81"))
    found = jumps(results, "speed_rpm")
    control = results["inner_raceway_controls"].values
    switched = (control[1:] != control[:-1]).any(axis=1)
    assert switched.any()
    np.testing.assert_array_equal(found.values == Cause.CONTROL_SWITCHES, switched)
    figure = picture(results, y=["inner_angle"])
    assert "raceway control switches" in [text.get_text() for text in figure.legends[0].get_texts()]


def test_the_end_of_a_branch_is_marked() -> None:
    results = sweep(study_of("inner", "0:12000:25"))
    found = jumps(results, "speed_rpm").values
    solved = results["status"].values == 0
    assert 0 < solved.sum() < solved.size
    np.testing.assert_array_equal(found == Cause.BRANCH_ENDS, solved[1:] != solved[:-1])
