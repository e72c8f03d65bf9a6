"""What a study file and `--vary` say, and how random keys are sampled."""

from __future__ import annotations

import tracemalloc
from itertools import combinations

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.studies import points
from qsbearing.studies.points import Points
from qsbearing.studies.study import Study
from qsbearing.studies.variables import MOST_VALUES, Axis, Distribution, variable_of


def test_ranges_and_lists() -> None:
    assert variable_of("speed_rpm", "0:100:5") == Axis("speed_rpm", (0.0, 25.0, 50.0, 75.0, 100.0))
    assert variable_of("speed_rpm", "10:1000:3:log") == Axis("speed_rpm", (10.0, 100.0, 1000.0))
    assert variable_of("axial_load_N", "3,1,2") == Axis("axial_load_N", (3.0, 1.0, 2.0))
    table = {"start": 10, "stop": 1000, "count": 3, "scale": "log"}
    assert variable_of("operation.speed_rpm", table) == variable_of("speed_rpm", "10:1000:3:log")
    assert variable_of("ball_material.density_kg_m3", [1.0]).key == "ball_material_density_kg_m3"


# A hundred thousand points: a mean is then known to 1/300, a standard deviation to 1/450; five times that is allowed.
@pytest.mark.parametrize("text", ["normal(5,0.1)", "uniform(4,6)", "triangular(1,2,6)", "triangular(1,1,2)"])
def test_distributions_have_their_moments(text: str) -> None:
    each = variable_of("speed_rpm", text)
    assert isinstance(each, Distribution)
    values = each.at(np.random.default_rng(1).random(100_000))
    a, *_, c = each.parameters
    if each.kind == "triangular":
        mean = sum(each.parameters) / 3.0
        deviation = np.sqrt(sum((p - q) ** 2 for p, q in combinations(each.parameters, 2)) / 36.0)
    else:
        mean, deviation = 5.0, 0.1 if each.kind == "normal" else (c - a) / np.sqrt(12.0)
    assert values.std() == pytest.approx(deviation, rel=5 / 450)
    assert values.mean() == pytest.approx(mean, abs=5 / 300 * deviation)
    if each.kind != "normal":
        assert each.parameters[0] <= values.min() < values.max() <= each.parameters[-1]


@pytest.mark.parametrize(
    ("key", "given", "said"),
    [
        ("speeed_rpm", "0:1:2", "Did you mean speed_rpm"),
        ("axial_load", "0:1:2", "Did you mean axial_load_N"),
        ("speed_rpm", "5:1:3", "reversed"),
        ("speed_rpm", "5:5:3", "empty"),
        ("speed_rpm", "0:5:3:log", "start above zero"),
        ("speed_rpm", "0:5:2.5", "whole number"),
        ("speed_rpm", "0:5:1000001", "1,000,001 values: .* from 1 to 1,000,000"),
        ("speed_rpm", np.arange(1_000_001), "1,000,001 values: .* from 1 to 1,000,000"),
        ("speed_rpm", "0:5", "not a range"),
        ("speed_rpm", "0:inf:3", "endless"),
        ("ball_count", "-1e308:1e308:3", "beyond any number"),
        ("inner_groove_radius_coefficient", "uniform(0,1e308)", "beyond any number"),
        ("ball_material.elastic_modulus_GPa", "1e308,1", "beyond any number"),
        ("speed_rpm", "1,x", "not a number"),
        ("speed_rpm", "1,1", "twice"),
        ("speed_rpm", [], "empty"),
        ("speed_rpm", [True], "not a number"),
        ("speed_rpm", {"start": 0, "stop": 1}, "lacks count"),
        ("speed_rpm", "gauss(1,2)", "not a distribution"),
        ("speed_rpm", "normal(1)", "takes 2 numbers"),
        ("speed_rpm", "normal(1,0)", "above zero"),
        ("speed_rpm", "triangular(3,2,1)", "must hold"),
    ],
)
def test_what_is_wrong_is_said(key: str, given: object, said: str) -> None:
    with pytest.raises(qs.SceneError, match=said):
        Study.of("b218", {key: given})


def test_an_axis_takes_no_more_memory_than_is_said() -> None:
    """One too long is refused before it is made; a value is a float and its place, 32 bytes, twice that at the peak."""
    tracemalloc.start()
    with pytest.raises(qs.SceneError, match="10,000,000 values"):
        Study.of("b218", {"speed_rpm": "0:15000:10_000_000"})
    assert tracemalloc.get_traced_memory()[1] < 1e6
    Study.of("b218", {"speed_rpm": f"0:15000:{MOST_VALUES // 10}"})
    assert tracemalloc.get_traced_memory()[1] < 64 * MOST_VALUES // 10
    tracemalloc.stop()


def test_all_errors_of_a_study_are_reported_at_once() -> None:
    document = {"bearing": {"name": "B218"}, "operation": {"axial_load_N": 1.0}}
    study = {"samples": 0, "sampling": "sobel", "sed": 1}
    with pytest.raises(qs.SceneError) as error:
        Study.of(document | {"vary": {"speed_rpm": "5:1:2", "x": 1}, "study": study})
    assert len(error.value.errors) == 5


def test_a_study_file_is_a_scene_file_with_more(tmp_path: pytest.TempPathFactory) -> None:
    path = tmp_path / "my.toml"  # type: ignore[operator]
    path.write_text(
        '[bearing]\nname = "B218"\n[operation]\naxial_load_N = 1\n[vary]\nspeed_rpm = [1, 2]\n'
        'ball_material.density_kg_m3 = { uniform = [3000, 8000] }\n[study]\nsamples = 8\nquantities = "inner_load"\n'
    )
    study = Study.of(path)
    assert [each.key for each in study.variables] == ["speed_rpm", "ball_material_density_kg_m3"]
    assert (study.samples, study.quantities) == (8, ("inner_load",))
    assert Study.of(path, {"speed_rpm": "1,2"}).fingerprint == study.fingerprint
    assert Study.of(path, {"speed_rpm": "1,3"}).fingerprint != study.fingerprint


GRID = {"speed_rpm": "0:9:4", "axial_load_N": [1, 2, 3], "ball_diameter_mm": "normal(22.2,0.01)", "moment_z_Nm": 0}


@pytest.mark.parametrize("size", [1, 3, 7, 20, 21, 60, 1000])
def test_chunks_cover_the_grid_once_with_the_same_values(size: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(points, "CHUNK", size)
    grid = Points(Study.of("b218", GRID, samples=20))
    assert grid.shape == (4, 3, 20)
    filled = {key: np.full(grid.shape, np.nan) for key in GRID}
    seen = np.zeros(grid.shape, int)
    for number in range(grid.chunk_count):
        chunk = grid.chunk(number)
        seen[chunk] += 1
        assert grid.size(number) == seen[chunk].size <= size
        for key, values in grid.values(chunk).items():
            filled[key][chunk] = values.reshape(seen[chunk].shape) if values.ndim else values
    assert (seen == 1).all()
    np.testing.assert_array_equal(filled["speed_rpm"][:, 0, 0], [0.0, 3.0, 6.0, 9.0])
    np.testing.assert_array_equal(filled["axial_load_N"][2, :, 5], [1.0, 2.0, 3.0])
    np.testing.assert_array_equal(filled["moment_z_Nm"], 0.0)
    same = filled["ball_diameter_mm"]
    assert np.unique(same[0, 0]).size == 20
    assert (same == same[0, 0]).all(), "every grid point has the same samples"
    np.testing.assert_array_equal(same[0, 0], grid.samples(slice(0, 20))["ball_diameter_mm"])


@pytest.mark.parametrize("sampling", ["random", "latin_hypercube", "sobol"])
def test_samples_do_not_depend_on_how_they_are_asked_for(sampling: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(points, "BLOCK", 64)
    points._quantiles.cache_clear()
    vary = {"ball_diameter_mm": "uniform(22,22.4)", "pitch_diameter_mm": "uniform(125,126)"}
    grid = Points(Study.of("b218", vary, samples=200, sampling=sampling, seed=3))
    whole = grid.samples(slice(0, 200))
    parts = [grid.samples(slice(a, b)) for a, b in ((0, 1), (1, 64), (64, 65), (65, 190), (190, 200))]
    for key, values in whole.items():
        np.testing.assert_array_equal(np.concatenate([part[key] for part in parts]), values)
        assert np.unique(values).size == 200
    other = Points(Study.of("b218", vary, samples=200, sampling=sampling, seed=4)).samples(slice(0, 200))
    assert (other["ball_diameter_mm"] != whole["ball_diameter_mm"]).all()
    points._quantiles.cache_clear()


def test_even_samples_are_even() -> None:
    """One point in each of 64 equal parts of every key's distribution, which random points never are."""
    for sampling, even in (("latin_hypercube", True), ("sobol", True), ("random", False)):
        vary = {"ball_diameter_mm": "uniform(22,22.4)", "pitch_diameter_mm": "uniform(125,126)"}
        grid = Points(Study.of("b218", vary, samples=64, sampling=sampling))
        for key, low, high in (("ball_diameter_mm", 22.0, 22.4), ("pitch_diameter_mm", 125.0, 126.0)):
            part = np.floor((grid.samples(slice(0, 64))[key] - low) / (high - low) * 64)
            assert (np.unique(part).size == 64) == even, sampling
