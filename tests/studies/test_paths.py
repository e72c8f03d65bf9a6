"""Any number of a file varies by its path: a point is what the file with that number gives, in every study."""

from __future__ import annotations

import copy
import tomllib
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.files.scene_file import scene_of
from qsbearing.files.set_file import set_of
from qsbearing.studies import keys
from qsbearing.studies.design.point_table import solve_table
from qsbearing.studies.results import known_results, read
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
    results = sweep(Study.of(tables, {path: [3.0, 8.0]}))
    for number, value in enumerate((3.0, 8.0)):
        alone = qs.solve(scene_of(at(tables, path, value), ""))
        np.testing.assert_allclose(results["ring_displacement_axial"][number], alone.displacement[0] / qs.um, rtol=1e-9)
    assert results["ring_displacement_axial"][0] != results["ring_displacement_axial"][1]


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
    goal = float(curve.sum()) / 2.0
    found = qs.find(SPINDLE, {path: "100:900"}, goals=[f"tool_displacement_radial_y={goal}"], points=16)
    again = sweep(Study.of(SPINDLE, {path: [found.values[path]]}, quantities=KEPT))
    assert found.is_feasible
    assert float(again["tool_displacement_radial_y"]) == pytest.approx(goal, rel=2e-6)  # what a goal is met to
    varied = {path: "normal(500,50)", "shaft.sections.1.outer_diameter_mm": "uniform(49,50)"}
    drawn = sweep(Study.of(SPINDLE, varied, samples=4, quantities=KEPT))["tool_displacement_radial_y"]
    assert np.unique(drawn).size == 4


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("position_mm", "Did you mean rows.1.position_mm or rows.2.position_mm or shaft.loads.1.position_mm, of 4 "),
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
