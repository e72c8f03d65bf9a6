"""The library of hard cases: each ends as it must, and where there is a number, at that number."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np
import pytest
from mpmath import mp

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.remarks.of_solution import message, warnings
from tests.qsbearing.scenes import INNER, turning
from tests.verification.hard_cases import generate
from tests.verification.hard_cases.cases import CASES, CONVERGED, NO_EQUILIBRIUM
from tests.verification.hard_cases.generate import load_reference
from tests.verification.hard_cases.scenes import BY_NAME, exact_case, scene_of
from tests.verification.hard_cases.table import DATA, ROUNDING, TABLE, errors, markdown, verdict

REFERENCE = {entry["case"]["name"]: entry for entry in load_reference()}
SOLVED = [case["name"] for case in CASES if case["expected"] == CONVERGED]
REFUSED = [case["name"] for case in CASES if case["expected"] == NO_EQUILIBRIUM]
SLOW = {"sixty_balls", "inner_control_beyond_its_end"}
"""In plain Python these take minutes."""

quick = [name for name in SOLVED if has_fast_code() or name not in SLOW]


@cache
def solution_of(name: str) -> qs.Solution:
    return qs.solve(scene_of(name))


# What is in the library ---------------------------------------------------------------------------------------------


def test_what_a_name_promises_is_so() -> None:
    """Cases named after a state are in it, by the reference: one ball of nine loaded, 5 mrad, k = 1000, yield, ..."""

    def loads(name: str, race: str = "inner") -> list[float]:
        return [float(ball[race]["load"]) for ball in REFERENCE[name]["result"]["balls"]]

    def tilt(name: str) -> float:
        return float(np.hypot(*map(float, REFERENCE[name]["result"]["displacement"][3:])))

    def pressure(name: str) -> float:
        return max(float(ball["inner"]["max_pressure"] or 0.0) for ball in REFERENCE[name]["result"]["balls"])

    assert sum(load > 0.0 for load in loads("single_ball_carries")) == 1
    for name in ("most_balls_unloaded_at_rest", "most_balls_unloaded_at_speed"):
        assert 0 < sum(load > 0.0 for load in loads(name)) < 5
    assert all(load > 0.0 for load in loads("most_balls_unloaded_at_speed", "outer"))
    straddling = np.array(loads("straddling_the_load"))
    assert set(np.argsort(straddling)[-2:]) == {0, 8}
    assert straddling[0] == pytest.approx(straddling[8], rel=1e-12)
    assert not any(loads("huge_clearance"))
    assert 4.5e-3 < tilt("tilted_by_5_mrad") < 6.5e-3
    assert 4.0e9 < pressure("yield_limit") < 4.4e9 < 8e9 < pressure("far_past_yield")
    for ball in REFERENCE["slender_ellipses"]["result"]["balls"]:
        assert float(ball["inner"]["semi_major_axis"]) > 900.0 * float(ball["inner"]["semi_minor_axis"])
    friction = REFERENCE["inner_control_at_its_end"]["result"]["balls"][0]["inner"]["required_friction"]
    assert float(friction) > 1000.0
    for side, above in (("outer", True), ("inner", False)):
        ratio = float(REFERENCE[f"control_switches_{side}_side"]["result"]["balls"][0]["control_ratio"])
        assert (ratio > 1.0) == above
        assert ratio == pytest.approx(1.0, abs=1e-4)
    controls = {ball["control"] for ball in REFERENCE["mixed_control"]["result"]["balls"]}
    assert controls == {"outer", "inner"}


# Ends as it must ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", quick)
def test_it_comes_to_fifty_digits_or_its_condition_says_why_not(name: str) -> None:
    """Loads each by itself, angles, displacements: within 1e-9, or within what the condition explains."""
    solution = solution_of(name)
    assert solution.status is qs.Status.CONVERGED, message(solution)
    result = REFERENCE[name]["result"]
    found = errors(solution, result)
    assert verdict(max(found.values()), result["condition"]) != "UNEXPLAINED", (found, result["condition"])


@pytest.mark.parametrize("name", [name for name in REFUSED if has_fast_code() or name not in SLOW])
def test_there_is_none_and_it_is_said(name: str) -> None:
    """No equilibrium, no number anywhere, and a sentence."""
    solution = solution_of(name)
    assert solution.status is qs.Status.NO_EQUILIBRIUM
    assert np.isnan(solution.displacement).all()
    assert np.isnan(solution.inner.load).all()
    assert message(solution).startswith("No equilibrium")


def test_why_there_is_none() -> None:
    """Normal loads push the ring of an angular-contact bearing along its axis only, at the circle of groove centres:
    thrust is never negative, and moments are no larger than the thrust times that circle's radius. One ball's thrust
    makes a moment of that size, and one that friction alone must hold has the end that the next test looks for."""
    beyond = {"one_ball_free", "inner_control_beyond_its_end"}
    for name in set(REFUSED) - beyond:
        scene = scene_of(name)
        axial, tilt_y, tilt_z = (float(getattr(scene.operation, key)) for key in ("axial_load", "moment_y", "moment_z"))
        assert axial < 0.0 or np.hypot(tilt_y, tilt_z) > axial * float(scene.bearing.inner_groove_centre_radius), name
    channels = BY_NAME["one_ball_free"]["channels"]
    assert channels["x"] == ["load", "500"]
    assert channels["tilt_z"] == ["load", "0"]


def test_inner_control_ends_where_the_inner_raceway_loses_its_load() -> None:
    """It falls evenly to nothing at 9338.72 rpm; above, friction would have nothing to press on."""
    rpm = np.array([9200.0, 9300.0, 9338.7, 9338.71, 9338.73, 9400.0])
    solution = qs.solve(turning(rpm, control=INNER, axial_load=2000.0))
    assert [str(status) for status in solution.status] == ["converged"] * 4 + ["no_equilibrium"] * 2
    load = solution.inner.load[:4, 0]
    assert (np.diff(load) < 0.0).all()
    end = rpm[3] + load[3] * (rpm[3] - rpm[2]) / (load[2] - load[3])
    assert end == pytest.approx(9338.72, abs=0.005)  # as far as that speed is printed


def test_exactly_touching_at_rest() -> None:
    """All approaches and loads are zero, bit for bit; nothing is loaded, and it says so."""
    solution = solution_of("exactly_touching_at_rest")
    for contacts in (solution.inner, solution.outer):
        assert not contacts.load.any()
        assert not contacts.max_pressure.any()
    assert not solution.load.any()
    assert any("carry no load" in words for words in warnings(solution))


def test_control_between_is_one_of_the_two_and_says_so() -> None:
    """The equilibrium under outer or inner control, to the reference's digits, with a warning."""
    solution = solution_of("control_between")
    assert solution.converged
    assert any("No consistent raceway control" in words for words in warnings(solution))
    assert solution.raceway_control is not None
    (control,) = set(solution.raceway_control)
    case = exact_case(BY_NAME["control_between"]) | {"control": str(control)}
    case |= {"ball_count": 1, "channels": {**case["channels"], "x": ["load", "1112.5"]}}
    for channel in ("y", "z", "tilt_y", "tilt_z"):
        case["channels"][channel] = ["displacement", "0"]
    ball = generate.jh.solve(case, 30)["balls"][0]
    assert solution.inner.load == pytest.approx(np.full(16, float(ball["inner"]["load"])), rel=1e-9)
    assert solution.outer.angle == pytest.approx(np.full(16, float(ball["outer"]["angle"])), rel=1e-9)


# The references and the table ---------------------------------------------------------------------------------------


def test_every_solved_case_has_its_reference() -> None:
    """And the reference is that of the case as it stands."""
    assert list(REFERENCE) == SOLVED
    for name in SOLVED:
        assert REFERENCE[name]["case"] == BY_NAME[name], name


@pytest.mark.parametrize(
    "name",
    [
        "single_ball_carries",
        pytest.param("touching_at_the_sides", marks=pytest.mark.heavy),
        pytest.param("tilted_by_5_mrad", marks=pytest.mark.heavy),
    ],
)
def test_the_stored_reference_is_what_its_generator_makes(name: str) -> None:
    live, stored = generate.solve(BY_NAME[name]), REFERENCE[name]["result"]
    with mp.workdps(40):
        for one, other in zip(live["balls"], stored["balls"], strict=True):
            for race in ("inner", "outer"):
                load, expected = mp.mpf(one[race]["load"]), mp.mpf(other[race]["load"])
                assert abs(load - expected) <= mp.mpf("1e-22") * max(abs(expected), mp.mpf("1e-30"))
    assert live["condition"] == pytest.approx(stored["condition"], rel=1e-2)


def test_the_reference_solves_the_package_s_own_numbers() -> None:
    """Every float in decimal, exactly: the two solve one problem, to the last bit."""
    exact = exact_case(BY_NAME["three_balls"])
    with mp.workdps(120):
        assert mp.mpf(exact["ball_diameter"]) == mp.mpf(0.022225)
        angle = mp.mpf(exact["free_contact_angle_deg"]) * mp.pi / 180
        assert abs(angle - mp.mpf(40.0 * qs.deg)) < mp.mpf("1e-95")


def test_the_condition_number_is_one_of_a_matrix() -> None:
    """Scaling rows and columns does not change it; a nearly singular system has a large one."""
    rng = np.random.default_rng(1)
    matrix = rng.normal(size=(6, 6))
    rows, columns = 10.0 ** rng.uniform(-8, 8, 6), 10.0 ** rng.uniform(-8, 8, 6)

    def condition(of: Any) -> float:
        as_mpf = np.array([[mp.mpf(float(value)) for value in row] for row in of], dtype=object)
        return float(np.linalg.cond(generate.equilibrated(as_mpf)))

    assert condition(rows[:, None] * matrix * columns) == pytest.approx(condition(matrix), rel=0.2)
    nearly = matrix.copy()
    nearly[5] = nearly[4] * (1.0 + 1e-9)
    nearly[5, 0] *= 1.0 + 1e-9
    assert condition(nearly) > 1e7


def test_the_verdict_is_honest() -> None:
    assert verdict(1e-10, 1.0) == "within 1e-9"
    assert verdict(1e-8, 1e8) == "explained by its condition"
    assert verdict(1e-8, 0.9e-8 / ROUNDING) == "UNEXPLAINED"
    assert verdict(float("inf"), 1e20) == "UNEXPLAINED"


def test_an_error_is_an_error() -> None:
    """A load off by 1e-8, and a contact lost, are seen."""
    name = "one_ball_held"
    solution, result = qs.solve(scene_of(name)), REFERENCE[name]["result"]
    assert max(errors(solution, result).values()) < 1e-12
    solution.inner.load[0] *= 1.0 + 1e-8
    assert errors(solution, result)["loads"] == pytest.approx(1e-8, rel=1e-3)
    solution.inner.load[0] = 0.0
    assert errors(solution, result)["loads"] == float("inf")


def test_the_table_is_made_from_its_data() -> None:
    table = json.loads(DATA.read_text(encoding="utf-8"))["cases"]
    assert TABLE.read_text(encoding="utf-8") == markdown(table)
    assert [row["case"] for row in table] == [case["name"] for case in CASES]
