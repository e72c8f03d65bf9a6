"""Studies of balls whose diameters vary at random, each on its own, or one alone along an axis."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.file_errors import SceneFileError
from qsbearing.files.scene_file import scene_of

pytest.importorskip("xarray")

KEY = "ball_diameter_deviation_um"


def document(**effects: Any) -> dict[str, Any]:
    return {
        "bearing": {"name": "B218"},
        "operation": {"axial_load_N": 8000, "speed_rpm": 9000, "tilt_z_mrad": 0, "tilt_y_mrad": 0},
        "effects": {"ball": ["centrifugal_force"], "raceway_control": "outer", **effects},
    }


def sampled(count: int = 512, **options: Any) -> Any:
    vary = {KEY: {"normal": [0.0, 0.1]}, "axial_load_N": "uniform(7000, 9000)"}
    study = qs.Study.of(
        document(), vary, samples=count, quantities=["inner_load", "ball_diameter_deviation"], **options
    )
    return qs.sweep(study)


@pytest.mark.parametrize("sampling", ["random", "latin_hypercube", "sobol"])
def test_every_ball_draws_its_own(sampling: str) -> None:
    """Sixteen columns of samples, spread as asked and without correlation: those of 512 points err by 1/sqrt(512)."""
    results = sampled(sampling=sampling)
    drawn = np.stack([results[f"{KEY}_{ball}"] for ball in range(16)], axis=-1)
    np.testing.assert_allclose(results["ball_diameter_deviation"], drawn, atol=1e-12)
    assert drawn.std(axis=0) == pytest.approx(np.full(16, 0.1), rel=0.15)
    assert np.abs(np.corrcoef(drawn.T) - np.eye(16)).max() < 5.0 / np.sqrt(512)
    assert results["ball_diameter_deviation"].dims == ("sample", "ball")
    assert results[f"{KEY}_3"].attrs["units"] == "um"


def test_points_are_their_single_solves() -> None:
    results = sampled(64)
    for k in (0, 17, 63):
        balls = results["ball_diameter_deviation"].values[k].tolist()
        single = document(ball_diameter_deviations_um=balls)
        single["operation"]["axial_load_N"] = float(results["axial_load_N"][k])
        alone = qs.solve(scene_of(single, ""))
        np.testing.assert_allclose(results["inner_load"][k], alone.inner.load, rtol=1e-9)


def test_loads_spread_by_the_springs_of_the_balls() -> None:
    """At rest under thrust, tilts held, the load of a ball has the standard deviation 1.5 Q/delta sigma sqrt(1 - 3/Z):
    what the ring's moving leaves of independent deviations. 2,000 points know it to 1.6 %."""
    still = document()
    still["operation"] |= {"speed_rpm": 0, "axial_load_N": 17800}
    results = qs.sweep(qs.Study.of(still, {KEY: "normal(0, 0.05)"}, samples=2048, quantities=["inner_load"]))
    equal = qs.solve(scene_of(still, ""))
    spring = 1.5 * equal.inner.load[0] / (equal.inner.approach[0] + equal.outer.approach[0])
    expected = spring * 0.05 * qs.um * np.sqrt(1.0 - 3.0 / 16.0)
    assert float(results["inner_load"].std("sample").mean()) == pytest.approx(expected, rel=0.03)


def test_one_ball_along_an_axis() -> None:
    """Beside the others that the file gives."""
    given = document(ball_diameter_deviations_um=[1.0, *([0.0] * 15)])
    results = qs.sweep(qs.Study.of(given, {f"{KEY}_2": [-1.0, 0.0, 1.0]}, quantities=["inner_load"]))
    assert results["inner_load"].dims == (f"{KEY}_2", "ball")
    single = document(ball_diameter_deviations_um=[1.0, 0.0, -1.0, *([0.0] * 13)])
    alone = qs.solve(scene_of(single, ""))
    np.testing.assert_allclose(results["inner_load"][0], alone.inner.load, rtol=1e-9)
    assert (np.diff(results["inner_load"][:, 2]) > 0.0).all()


def test_impossible_sets_of_balls_stay_with_their_reason() -> None:
    results = qs.sweep(qs.Study.of(document(), {f"{KEY}_2": [0.0, 300.0]}, quantities=["inner_load"]))
    assert results["status"].values.tolist() == [0, 3]
    assert "more_than_1%" in results["reason"].attrs["flag_meanings"]


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({KEY: [0.1, 0.2]}, "give a distribution"),
        ({KEY: "0.5"}, "give a distribution"),
        ({KEY: "normal(0, 0.1)", f"{KEY}_3": [0.0, 1.0]}, "is varied twice"),
        ({KEY: "normal(0, 200)"}, "leaves the possible"),
        ({f"{KEY}_40": [0.0, 1.0]}, "has 41 numbers; the bearing has 16 balls"),
        ({KEY: "normal(0, 0.1)", "ball_count": [15, 16]}, "ball_count: cannot vary together with deviations"),
        ({"ball_diameter_deviation_mm": "normal(0, 0.1)"}, f"Did you mean {KEY}"),
    ],
)
def test_what_is_refused(vary: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneFileError, match=words):
        qs.sweep(qs.Study.of(document(), vary, samples=16, quantities=["inner_load"]))


def test_a_bearing_without_a_ball_count_is_refused() -> None:
    bare = document()
    bare["bearing"] = {"ball_diameter_mm": 22.225}
    with pytest.raises(SceneFileError, match="needs the bearing's ball_count"):
        qs.Study.of(bare, {KEY: "normal(0, 0.1)"})
