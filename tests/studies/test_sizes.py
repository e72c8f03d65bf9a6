"""The largest of results whose sign is a direction: every one of them has `_size`, which is the largest magnitude."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from qsbearing.files.result_names import find
from qsbearing.files.scene_or_set import scene_or_set_of
from qsbearing.model.solution.groups import GROUPS
from qsbearing.model.solution.result_keys import BALL, Place, spelled
from qsbearing.pictures.study.labels import label_of
from qsbearing.readings.asked import READINGS
from qsbearing.studies.chooser.choose_set import solve_any
from qsbearing.studies.design.find import find as search
from qsbearing.studies.design.shown import record
from qsbearing.studies.results import known_results, read
from qsbearing.studies.sobol import sobol_indices
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep

MEANS_SOMETHING_ELSE = {
    "approach": "a gap, where it is negative",
    "edge_distance": "beyond the edge, where it is negative",
    "azimuth": "a place",
    "apex_margin": "beyond the apex, where it is negative",
}
"""Results with a sign that is no direction."""
READ = {
    "kinematics": {},
    "friction": {
        "friction_coefficient": 0.06,
        "hysteresis_loss": 0.01,
        "drag_coefficient": 1.0,
        "fluid_density_kg_m3": 50,
    },
    "film": {"ball_roughness_um": 0.02, "raceway_roughness_um": 0.05},
    "lubricant": {"iso_viscosity_grade": 32, "oil_temperature_C": 60},
    "overrun": {"inner_shoulder_diameter_mm": 66, "outer_shoulder_diameter_mm": 74, "edge_radius_mm": 0.3},
    "stress": {},
    "ball_advance": {},
    "pivot_points": {},
    "ball_slip": {"friction_coefficient": 0.06, "drag_coefficient": 1.0, "least_oil_share": 0.1, "most_oil_share": 0.2},
}
BLUNT = {"overrun": {"inner_shoulder_diameter_mm": 66, "outer_shoulder_diameter_mm": 74}}
FREE_RINGS = {"inner": {"width_mm": 20, "shaft": "free"}, "outer": {"width_mm": 20, "housing": "free"}}
TURNING: dict[str, Any] = {
    "bearing": {"name": "7210C"},
    "operation": {"speed_rpm": 9000, "axial_load_N": 500, "radial_load_y_N": 400, "tilt_y_mrad": 0, "tilt_z_mrad": 0},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
    "readings": READ,
}


def other(**tables: Any) -> dict[str, Any]:
    return {name: table | tables.get(name, {}) for name, table in TURNING.items()}


MOVED = {
    "bearing": {"name": "7210C"},
    "operation": TURNING["operation"],
    "effects": {
        "ball": ["centrifugal_force", "gyroscopic_moment"],
        "raceway_control": "friction",
        "traction": {"cage_drag_N": 1.0},
    },
}
"""By friction."""
DEEP_GROOVE = {
    "bearing": {
        "kind": "deep_groove", "ball_material": "steel", "ring_material": "steel",
        "ball_count": 9, "ball_diameter_mm": 7.94, "pitch_diameter_mm": 39.04,
        "groove_radius_coefficient": 0.52, "diametral_clearance_mm": 0.02,
    },
    "operation": {"speed_rpm": 3000, "axial_load_N": -400},
    "effects": {"ball": ["centrifugal_force", "gyroscopic_moment"], "raceway_control": "outer"},
}  # fmt: skip
"""Pushed the other way."""
FOUR_POINT = {
    "bearing": {
        "kind": "four_point", "ball_material": "steel", "ring_material": "steel",
        "ball_count": 14, "ball_diameter_mm": 12.7, "pitch_diameter_mm": 70,
        "groove_radius_coefficient": 0.52, "free_contact_angle_deg": 35, "axial_clearance_mm": 0.05,
    },
    "operation": TURNING["operation"] | {"axial_load_N": -900},
    "effects": MOVED["effects"],
}  # fmt: skip
"""Pushed the other way, so that its opposite arcs carry."""
SCENES = (
    TURNING,
    other(effects={"raceway_control": "inner"}),
    MOVED,
    MOVED | {"operation": TURNING["operation"] | {"speed_rpm": -9000, "radial_load_y_N": -400}},
    other(operation={"speed_rpm": -9000}, effects={"raceway_control": "minimum_dissipation"}),
    other(operation={"speed_rpm": 3000, "radial_load_y_N": 900}, readings=BLUNT),
    other(effects={"ball_diameter_deviations_um": [1, -3] + [0] * 13}),
    other(
        operation={"radial_load_y_N": 3000},
        readings=BLUNT,
        effects={"elastic_rings": FREE_RINGS},
    ),
    DEEP_GROOVE,
    DEEP_GROOVE | {"effects": MOVED["effects"]},
    FOUR_POINT,
    FOUR_POINT | {"operation": FOUR_POINT["operation"] | {"speed_rpm": 0, "outer_speed_rpm": 9000}},
    FOUR_POINT
    | {"operation": MOVED["operation"] | {"speed_rpm": -9000, "radial_load_y_N": -400, "axial_load_N": -900}},
)


@cache
def solved() -> list[tuple[dict[str, Place], dict[str, Any]]]:
    """Results, of each its values and those of each of its endings."""
    found = []
    for tables in SCENES:
        solution = solve_any(scene_or_set_of(tables, "", ""))
        assert solution.converged
        known = known_results(solution)
        found.append(
            (known, read(solution, [*known.values(), *(one for each in known.values() for one in each.overs)]))
        )
    return found


def per_ball() -> dict[str, Place]:
    return {name: each for known, _ in solved() for name, each in known.items() if each.is_per_ball}


def test_every_result_of_each_ball_that_has_both_signs_is_described_as_signed_and_no_other() -> None:
    asked = {each.group.reading: each for each in per_ball().values()}
    for name, reading in READINGS.items():
        assert name in asked or not (*reading.of_contact, *reading.of_ball), f"{name}: no scene here asks for it"
    ever = {name for _, values in solved() for name, found in values.items() if (found < -1e-9).any()}
    for name, each in per_ball().items():
        means = any(name.endswith(end) for end in MEANS_SOMETHING_ELSE)
        assert each.result.is_signed == (name in ever and not means), name


SIGNED = [Place(group, each) for group in GROUPS if group.axis == BALL for each in group.results if each.is_signed]


@pytest.mark.parametrize("name", [*map(spelled, SIGNED)])
def test_every_signed_result_of_a_solution_has_a_size(name: str) -> None:
    seen = [(known, values) for known, values in solved() if name in known]
    assert seen
    for known, values in seen:
        size = find(f"{name}_size", known)
        assert size is not None and find(f"{size.column}", known) == size
        said = size.attributes["long_name"], label_of(size.name).shared
        assert all(each.endswith(", largest size") for each in said)
        assert [each.over for each in known[name].overs] == ["max", "min", "size"]
        assert np.nanmax(np.abs(values[name])) >= np.nanmax(values[name])


def test_sizes_are_the_largest_magnitudes_and_the_other_extremes_stay_algebraic() -> None:
    for known, values in solved():
        for name, each in known.items():
            for one in each.overs:
                ending = one.over
                assert find(f"{name}_{ending}", known) == one
                own, every = values[one.name], values[name]
                expected = {
                    "max": np.fmax.reduce(every),
                    "min": np.fmin.reduce(every),
                    "size": np.fmax.reduce(np.abs(every)),
                }[ending]
                assert own == expected or (np.isnan(own) and np.isnan(expected)), one.name
            if each.is_per_ball and not each.result.is_signed:
                assert find(f"{name}_size", known) is None


def test_rows_of_sets_have_sizes_of_what_is_signed() -> None:
    row = {"bearing": {"name": "7210C"}, "position_mm": 10, "carries": "-x"}
    of = {
        "operation": {"axial_load_N": 100},
        "preload": {"rigid_N": 300},
        "rows": [row | {"position_mm": -10, "carries": "+x"}, row],
    }
    solution = solve_any(scene_or_set_of(of, "", ""))
    known = known_results(solution)
    extremes = [each for each in known.values() if each.over == "max"]
    assert extremes
    for each in extremes:
        size = spelled(each._replace(over="size"))
        assert (size in known) == each.result.is_signed, size
        if size in known:
            every = np.abs(each._replace(row=0, over="").of(solution.rows[each.row - 1]))
            assert read(solution, [known[size]])[size] == np.nanmax(every)


def test_a_limit_and_an_objective_without_an_ending_are_of_the_size_and_say_so() -> None:
    vary = {"speed_rpm": (3000.0, 12000.0)}
    known, values = solved()[0]
    for name in ("gyroscopic_moment", "inner_kinematics_spin_speed"):
        full = find(name, known)
        assert full is not None and full.result.is_signed
        there = float(np.nanmax(np.abs(values[full.name])))
        found = search(TURNING, vary, limits=[f"{full.name}<={there:.9g}"], maximise="centrifugal_force", points=64)
        assert found.is_feasible and found.values["speed_rpm"] == pytest.approx(9000, rel=0.01), name
        assert found.results[f"{full.name}_size"] == pytest.approx(there, rel=1e-3)
        assert record(found)["sizes"] == [f"{full.name}_size: the size of {full.name}, of the ball where it is largest"]
    least = search(TURNING, vary, minimise="gyroscopic_moment", points=64)
    assert least.values["speed_rpm"] == pytest.approx(3000, rel=0.01)
    assert least.results["gyroscopic_moment_size"] > 0.0


def test_a_sweep_keeps_it_and_sobol_indices_are_of_it() -> None:
    names = ["gyroscopic_moment_size", "gyroscopic_moment_max", "gyroscopic_moment_min"]
    results = sweep(Study.of(TURNING, {"speed_rpm": [3000, 9000]}, quantities=names))
    size, most, least = (results[name].values for name in names)
    assert (size == -least).all() and (size > np.abs(most)).all()
    study = Study.of(TURNING, {"radial_load_y_N": "normal(400,40)"}, quantities=["gyroscopic_moment", "inner_load"])
    indices = sobol_indices(study, 64)
    by_size = Study.of(
        TURNING, {"radial_load_y_N": "normal(400,40)"}, quantities=["gyroscopic_moment_size", "inner_load_max"]
    )
    np.testing.assert_array_equal(indices["total"].values, sobol_indices(by_size, 64)["total"].values)
