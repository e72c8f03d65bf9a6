"""Any number of a file varies by its path: a point is what the file with that number gives, in every study."""

from __future__ import annotations

import copy
import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files import paths
from qsbearing.files.result_names import find
from qsbearing.files.scene_tables import input_tables
from qsbearing.files.set_file import set_of
from qsbearing.reports.spectrum import point_of
from qsbearing.studies import keys
from qsbearing.studies.design.point_table import solve_table
from qsbearing.studies.results import known_results, read
from qsbearing.studies.scenes import scenes_of_points
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

pytest.importorskip("xarray")

SPINDLE = tomllib.loads(
    """
[bearing]
name = "7210C"
[[rows]]
position_mm = 0
carries = "+x"
housing_stiffness = {radial_stiffness_N_per_um = 1500}
[[rows]]
position_mm = 60
carries = "-x"
[shaft]
start_mm = -60
[[shaft.sections]]
length_mm = 160
outer_diameter_mm = 50
[[shaft.loads]]
position_mm = -55
radial_y_N = 600
[[shaft.supports]]
position_mm = 90
radial_y_stiffness_N_per_um = 5
[shaft.points]
tool_mm = -60
[housing]
temperature_C = 28
[[spacers]]
rows = [1, 2]
inner_length_mm = 40
outer_length_mm = 40.002
[preload]
rigid_N = 300
[operation]
speed_rpm = 3000
[effects]
ball = ["centrifugal_force"]
raceway_control = "outer"
"""
)
KEPT = ("tool_displacement_radial_y", "row_1_axial_load", "row_2_inner_load_max")


def at(table: Any, path: str, value: float) -> dict[str, Any]:
    """The tables with another number, written out by hand."""
    found = copy.deepcopy(table)
    *steps, last = (int(step) - 1 if step.isdigit() else step for step in path.split("."))
    within = found
    for step in steps:
        within = within[step]
    within[last] = value
    return found


@pytest.mark.parametrize(
    ("path", "values"),
    [
        ("shaft.loads.1.radial_y_N", (300, 900)),
        ("shaft.loads.1.position_mm", (-58, -30)),
        ("rows.2.position_mm", (50, 80)),
        ("rows.2.offset_um", (1, 3)),
        ("rows.1.housing_stiffness.radial_stiffness_N_per_um", (500, 3000)),
        ("shaft.sections.1.outer_diameter_mm", (40, 48)),
        ("shaft.supports.1.radial_y_stiffness_N_per_um", (1, 50)),
        ("shaft.points.tool_mm", (-60, 0)),
        ("spacers.1.outer_length_mm", (40.001, 40.003)),
        ("spacers.1.inner_temperature_C", (20, 30)),
        ("housing.temperature_C", (25, 30)),
        ("preload.rigid_N", (200, 500)),
    ],
)
def test_a_point_is_the_file_with_that_number(path: str, values: tuple[float, float]) -> None:
    results = sweep(Study.of(SPINDLE, {path: list(values)}, quantities=KEPT))
    (name,) = results["status"].dims
    assert keys.known(name).path == tuple(path.split("."))
    for number, value in enumerate(values):
        solution = qs.solve_set(set_of(at(SPINDLE, path, value), ""))
        known = known_results(solution)
        for kept, alone in read(solution, [known[each] for each in KEPT]).items():
            np.testing.assert_allclose(results[kept][number], alone, rtol=1e-9, err_msg=kept)


def test_what_a_file_leaves_to_names_is_copied() -> None:
    own = "rows.2.bearing.ball_diameter_mm", "shaft.sections.1.material.elastic_modulus_GPa"
    results = sweep(Study.of(SPINDLE, {own[0]: [12.7], own[1]: [100.0, 206.0]}, quantities=KEPT))
    explicit = copy.deepcopy(SPINDLE)
    explicit["rows"][1]["bearing"] = {"name": "7210C", "ball_diameter_mm": 12.7}
    steel = {"elastic_modulus_GPa": 206.0, "poisson_ratio": 0.3, "density_kg_m3": 7800.0}
    for number, modulus in enumerate((100.0, 206.0)):
        explicit["shaft"]["sections"][0]["material"] = {**steel, "elastic_modulus_GPa": modulus}
        found = qs.solve_set(set_of(explicit, "")).points["tool"].displacement[1] / qs.um
        np.testing.assert_allclose(results["tool_displacement_radial_y"][number], found, rtol=1e-9)


def test_numbers_of_heat_vary() -> None:
    tables = tomllib.loads(
        """
[bearing]
name = "7210C"
[operation]
speed_rpm = 12000
axial_load_N = 500
[effects]
ball = ["centrifugal_force", "gyroscopic_moment"]
raceway_control = "outer"
[thermal]
friction = "skf"
fixed = {ambient_C = 20}
[[thermal.conductances]]
between = ["inner_ring", "balls"]
W_per_K = 2
[[thermal.conductances]]
between = ["balls", "outer_ring"]
W_per_K = 2
[[thermal.conductances]]
between = ["outer_ring", "ambient"]
W_per_K = 5
[readings.lubricant]
iso_viscosity_grade = 32
oil_temperature_C = 40
[readings.friction_estimate]
bore_diameter_mm = 50
outside_diameter_mm = 90
"""
    )
    path = "thermal.conductances.3.W_per_K"
    parts = scenes_of_points(Study.of(tables, {path: [3.0, 8.0]}), {path: np.array([3.0, 8.0])}, 2).parts
    assert [part.scene.thermal.conductances[2].conductance for part in parts] == [3.0, 8.0]
    assert [part.points.tolist() for part in parts] == [[0], [1]]


def test_impossible_values_are_points_with_their_reason() -> None:
    results = sweep(Study.of(SPINDLE, {"shaft.sections.1.outer_diameter_mm": [-5, 45]}, quantities=KEPT))
    assert results["status"].values.tolist() == [3, 0]
    assert "outer_diameter_mm" in results["reason"].attrs["flag_meanings"]
    with pytest.raises(qs.SceneError, match="spacers"):
        sweep(Study.of(SPINDLE | {"spacers": 3}, {"shaft.sections.1.outer_diameter_mm": [40, 45]}))


def test_every_study_takes_paths() -> None:
    path = "shaft.loads.1.radial_y_N"
    nested = tomllib.loads("[vary]\nshaft.loads.1.radial_y_N = {start = 100, stop = 900, count = 2}")
    curve = sweep(Study.of(SPINDLE | nested, quantities=KEPT))["tool_displacement_radial_y"]
    assert curve.dims == (path,)
    rows = solve_table(SPINDLE, {path: ["100", "900"]})
    np.testing.assert_allclose(rows["tool_displacement_radial_y_um"], curve, rtol=1e-12)
    found = qs.find(SPINDLE, {path: "100,500,900"}, maximise="tool_displacement_radial_y", points=4)
    assert found.values == {path: 900.0}
    assert found.results["tool_displacement_radial_y"] == pytest.approx(float(curve[1]), rel=1e-9)
    varied = {path: "normal(500,50)", "shaft.sections.1.outer_diameter_mm": "uniform(49,50)"}
    drawn = sweep(Study.of(SPINDLE, varied, samples=4, quantities=KEPT))["tool_displacement_radial_y"]
    assert np.unique(drawn).size == 4


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("position_mm", "Did you mean rows.1.position_mm, rows.2.position_mm or shaft.loads.1.position_mm, of 4 "),
        ("radial_y_N", r"Did you mean shaft\.loads\.1\.radial_y_N\?"),
        ("shaft.load.1.radial_y_N", r"Did you mean shaft\.loads\.1\.radial_y_N\?"),
        ("rows.2.positon_mm", r"Did you mean rows\.2\.position_mm\?"),
        ("rows.5.position_mm", "is not in the file: there are 2 rows. Did you mean rows.1.position_mm or"),
        ("spacers.3.inner_length_mm", r"there is 1 spacers(?s:.)*spacers\.1\.inner_length_mm\?"),
        ("sped_rpm", r"Did you mean speed_rpm\?"),
    ],
)
def test_a_path_that_is_none_names_those_of_the_file(name: str, said: str) -> None:
    with pytest.raises(qs.SceneError, match=said):
        Study.of(SPINDLE, {name: [1, 2]})
    with pytest.raises(qs.SceneError, match=said.partition("of 4")[0]):
        qs.find(SPINDLE, {name: "1:2"}, minimise="row_1_axial_load")
    with pytest.raises(qs.SceneError, match=said.partition(". Did")[0].partition("of 4")[0]):
        solve_table(SPINDLE, {name: ["1"]})


POINTS = ({"speed_rpm": 3000.0, "load": 900.0, "hours": 300.0}, {"speed_rpm": 8000.0, "load": 300.0, "hours": 700.0})


def test_a_spectrum_takes_paths_inline_and_from_a_table(tmp_path: Path) -> None:
    path = "shaft.loads.1.radial_y_N"
    inline = [{"hours": p["hours"], "speed_rpm": p["speed_rpm"], path: p["load"]} for p in POINTS]
    tables = SPINDLE | {"readings": {"life": {}}, "spectrum": inline}
    of = set_of(tables, "")
    solution = qs.solve_set(of)
    np.testing.assert_allclose(of.readings["spectrum"]["time_share"], [0.3, 0.7])
    for k, point in enumerate(POINTS):
        alone = at(at(SPINDLE, path, point["load"]), "operation.speed_rpm", point["speed_rpm"])
        loads = qs.solve_set(set_of(alone, "")).row_loads
        np.testing.assert_allclose(solution.row_loads[k], loads, rtol=1e-9, atol=1e-6)
    again = input_tables(of)
    assert again["spectrum"][1][path] == 300.0
    assert "radial_y_N" not in again["shaft"]["loads"][0]
    np.testing.assert_array_equal(qs.solve_set(set_of(again, "")).row_loads, solution.row_loads)
    alone = point_of(of, 0)
    assert float(alone.shaft.loads[0].radial_y) == 900.0
    assert alone.operation.speed == of.operation.speed[0]
    lines = [f"point,hours,speed_rpm,{path}", "cut,300,3000,900", "rest,700,8000,300"]
    (tmp_path / "duty.csv").write_text("\n".join(lines))
    whole = SPINDLE | {"readings": {"life": {}}, "spectrum": {"file": "duty.csv"}}
    (tmp_path / "duty.toml").write_text(as_toml(whole))
    np.testing.assert_array_equal(qs.solve_set(qs.load_set(tmp_path / "duty.toml")).row_loads, solution.row_loads)


def as_toml(tables: dict[str, Any]) -> str:
    """As inline tables, which JSON nearly is."""

    def inline(value: Any) -> str:
        if isinstance(value, dict):
            return "{" + ", ".join(f'"{key}" = {inline(each)}' for key, each in value.items()) + "}"
        return f"[{', '.join(map(inline, value))}]" if isinstance(value, list) else json.dumps(value)

    return "\n".join(f"{key} = {inline(value)}" for key, value in tables.items())


@pytest.mark.parametrize(
    ("points", "said"),
    [
        (
            [{"share": 1, "shaft.loads.2.radial_y_N": 3}],
            r"there is 1 shaft\.loads\s+Did you mean shaft\.loads\.1\.radi",
        ),
        ([{"share": 1, "shaft.sections.1.length_mm": 3}], "must be the same at all points"),
        ([{"hours": 1, "share": 1}], "a share as well as hours"),
        ([{"hours": 1}, {"speed_rpm": 1}], r"point 2\.hours: missing"),
        ([{"hours": -1}, {"hours": 2}], "hours = -1 h: is negative"),
        ([{"share": 0.5, "rows.1.offset_um": 1}, {"share": 0.5}], r"point 2\.rows\.1\.offset_um: missing"),
        ({"file": "none.csv"}, "no such file"),
        ({"path": "none.csv"}, "nor the name of a file"),
    ],
)
def test_what_is_wrong_with_a_spectrum_is_told(points: Any, said: str, tmp_path: Path) -> None:
    (tmp_path / "duty.toml").write_text(as_toml(SPINDLE | {"readings": {"life": {}}, "spectrum": points}))
    with pytest.raises(qs.SceneError, match=said):
        qs.load_set(tmp_path / "duty.toml")


def test_a_result_has_one_name_everywhere() -> None:
    tables = SPINDLE | {"readings": {"life": {}}}
    known = known_results(qs.solve_set(set_of(tables, "")))
    same = {
        "shaft_effective_stiffness_axial": ("effective_stiffness_axial", "effective_stiffness.axial_N_per_um"),
        "system_life_duration": ("life_duration", "life.duration_h"),
        "row_2_life_duration": ("row_2.life.duration_h",),
    }
    for name, others in same.items():
        assert {find(each, known) for each in (name, known[name].column, *others)} == {known[name]}, name
    rows = [
        float(read(qs.solve_set(set_of(tables, "")), [known[f"row_{i}_life_duration"]]).popitem()[1]) for i in (1, 2)
    ]
    found = sweep(
        Study.of(SPINDLE, {"speed_rpm": [3000]}, quantities=["life.duration_h"])
    )  # which asks for the reading
    assert float(found["system_life_duration"]) == pytest.approx(float(qs.system_life(rows)))
    bearing = known_results(qs.solve(qs.load_scene("b218")))
    assert find("inner.max_pressure_max_MPa", bearing) == find("inner_max_pressure_max", bearing)
    assert find("inner_load_axial", bearing) is None
    with pytest.raises(qs.SceneError, match="system_life_duration_h"):
        qs.find(tables, {"preload.rigid_N": "100:200"}, goals=["life.duration_min=1"])
    for name, said in (
        ("life.duration_min", "system_life_duration_h"),
        ("inner_load_max", "Such as row_1_inner_load_max"),
    ):
        with pytest.raises(qs.SceneError, match=said):
            sweep(Study.of(tables, {"preload.rigid_N": [100, 200]}, quantities=[name]))


def test_rings_that_expand_are_looked_for_in_their_tables() -> None:
    """Not in words: a title is no table."""
    position = ("rows", "2", "position_mm")
    assert paths.spans_cases(position, {"report": {"title": "ring_expansion"}, "rows": [{"carries": "+x"}]})
    assert not paths.spans_cases(position, {"effects": {"ring_expansion": {}}, "rows": [{}]})
    assert not paths.spans_cases(position, {"effects": "auto", "rows": [{}, {"ring_expansion": {}}]})
