"""Effects of a set chosen to a tolerance: leaving them out changes no number by more than the full model says."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

FULL = {
    "ball": ["centrifugal_force", "gyroscopic_moment"],
    "raceway_control": "per_ball",
    "hertz_angle": "actual",
    "orbit_radius": "displaced",
}
NAMES = ("7210C", "71914C", "7210C_hybrid", "B218")


def pair(seed: int) -> dict[str, Any]:
    """A random pair back to back."""
    random = np.random.default_rng(seed)
    return {
        "bearing": {"name": str(random.choice(NAMES))},
        "rows": [{"position_mm": sign * random.uniform(10, 150), "carries": "-+"[sign < 0] + "x"} for sign in (-1, 1)],
        "operation": {
            "speed_rpm": float(random.uniform(0, 9000)),
            "radial_load_y_N": float(random.uniform(0, 1500)),
            "axial_load_N": float(random.uniform(-300, 300)),
            "moment_z_Nm": 0.0,
        },
        "preload": {"rigid_N": float(random.uniform(200, 1500))},
    }


def deviation(chosen: Any, full: Any) -> float:
    """The largest part by which loads of the rows, pressures and stiffness differ."""
    pairs = [(chosen.axial_loads, full.axial_loads)]
    pairs += [(np.diagonal(chosen.stiffness)[:3], np.diagonal(full.stiffness)[:3])]
    for row, other in zip(chosen.rows, full.rows, strict=True):
        for side in ("inner", "outer"):
            pairs += [tuple(np.nanmax(getattr(each, side).max_pressure) for each in (row, other))]
    return max(float(np.max(np.abs(a - b)) / np.max(np.abs(b))) for a, b in pairs)


@pytest.mark.parametrize("seed", range(6))
def test_what_is_left_out_stays_within_the_tolerance(seed: int) -> None:
    tables = pair(seed)
    full = qs.solve_set(set_of(tables | {"effects": FULL}, ""))
    for tolerance in (0.005, 0.1):
        solution = qs.solve_set(set_of(tables | {"effects": "auto", "tolerance": tolerance}, ""))
        if not full.converged:
            assert solution.status == full.status
            continue
        assert deviation(solution, full) <= tolerance
        assert solution.choice.tolerance == tolerance
        assert all(float(each.estimated_error) <= tolerance for each in solution.choice.left_out)


def test_a_wide_tolerance_leaves_out_and_a_fine_one_keeps() -> None:
    of = set_of(pair(0), "")
    fine, wide = (qs.solve_set(of, effects="auto", accuracy=each) for each in (1e-12, 1.0))
    assert not fine.choice.left_out or max(float(each.estimated_error) for each in fine.choice.left_out) <= 1e-12
    assert {"centrifugal_force", "gyroscopic_moment"} <= set(fine.choice.added)
    assert {each.effect for each in wide.choice.left_out} >= {"centrifugal_force", "gyroscopic_moment"}
    assert not wide.set.ball_effects
    assert wide.choice.solves < 12


def test_every_door_takes_it() -> None:
    tables = pair(1) | {"effects": "auto", "tolerance": 0.02}
    of = set_of(tables, "")
    assert input_tables(of)["effects"] == "auto"
    assert set_of(input_tables(of), "") == of
    results = sweep(Study.of(tables, {"speed_rpm": [0.0, 9000.0]}, quantities=["row_1_inner_load_max"]))
    assert results["status"].values.tolist() == [0, 0]
    chosen = dataclasses.replace(of, tolerance=None, ball_effects=(qs.CentrifugalForce(),), raceway_control="outer")
    assert "centrifugal" in results.attrs["chosen_effects"].lower()
    assert qs.solve_set(chosen).choice is None
    with pytest.raises(ValueError, match="effects='auto'"):
        qs.solve_set(chosen, accuracy=0.01)
    with pytest.raises(qs.SceneError, match="tolerance = 2"):
        dataclasses.replace(of, tolerance=2.0)


def test_tolerance_is_residual_tolerance_by_its_old_name() -> None:
    of = set_of(pair(1) | {"effects": FULL}, "")
    loose = qs.solve_set(of, residual_tolerance=1e-6)
    with pytest.warns(DeprecationWarning, match="tolerance is called residual_tolerance") as said:
        by_old = qs.solve_set(of, tolerance=1e-6)
    assert said[0].filename == __file__
    assert by_old.residual == loose.residual > 1e-12 >= qs.solve_set(of).residual
    for asked in (1e-3, 1e-14):
        with pytest.raises(ValueError, match=f"residual_tolerance = {asked:g}: must lie between"):
            qs.solve_set(of, residual_tolerance=asked)
