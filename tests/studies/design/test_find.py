"""`qs.find` against an independent optimiser and a published benchmark, and what it says of ranges and bad input."""

from __future__ import annotations

import copy
import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import differential_evolution

import qsbearing as qs
from fem_check.book.cases.bearing_design import LIMITS, PRINTED, PRINTED_CAPACITY, PROBLEM, capacity
from qsbearing.documents.model import Paragraph
from qsbearing.pictures.feasible_region import Along, Bounded, draw_region
from qsbearing.studies.design.find import Found
from qsbearing.studies.design.optimum import search
from qsbearing.studies.design.problem import Variable, problem_of
from qsbearing.studies.design.shown import heading, picture, record, tables
from tests.cli.command import call
from tests.studies.design.problems import BALLS, PRESSURE, PROBLEMS, RIGID, SPINDLE, STIFF, Problem, stiffness

CLOSE = 1e-3
"""Of the optimum, between the two optimisers: a drawing's tolerance is wider."""
PENALTY = 1e3
"""Of the violation against the cost, exact for any multiplier below it (costs are scaled to one)."""


@cache
def of_spindle(name: str) -> Found:
    problem = PROBLEMS[name]
    return qs.find(copy.deepcopy(SPINDLE), problem.vary, **problem.words)


def by_evolution(problem: Problem, scale: float) -> tuple[NDArray, qs.Solution]:
    """The optimum by differential evolution on `qs.solve`."""
    bounds, whole, choices = [], [], []
    for given in problem.vary.values():
        listed = isinstance(given, list)
        ends = (0.0, len(given) - 1.0) if listed else tuple(map(float, given.split(":")[:2]))
        bounds.append(ends)
        choices.append(np.array(given) if listed else None)
        whole.append(listed)
    whole = [each or key == "ball_count" for each, key in zip(whole, problem.vary, strict=True)]

    def values(x: NDArray) -> NDArray:
        rows = [row if of is None else of[row.astype(int)] for row, of in zip(x, choices, strict=True)]
        return np.array(rows)

    def penalised(x: NDArray) -> NDArray:
        found = np.full(x.shape[1], 1e9)
        at = values(x)
        fits = np.ones(x.shape[1], bool)
        if "balls" in problem.arguments:  # so many of them do not fit: no bearing
            fits = at[problem.arguments.index("balls")] * 12.7 < np.pi * 70.0 * 0.99
        if fits.any():
            solution = problem.solved(at[:, fits])
            cost = problem.cost(solution) / scale + PENALTY * problem.violation(solution)
            found[fits] = np.where(solution.converged, cost, 1e9)
        return found

    best = differential_evolution(
        penalised, bounds, integrality=whole, vectorized=True, updating="deferred", popsize=24, maxiter=250, tol=1e-10,
        atol=0.0, rng=1, polish=False,
    )  # fmt: skip
    at = values(best.x[:, None])[:, 0]
    return at, problem.solved(at)


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.heavy
def test_it_meets_differential_evolution(name: str) -> None:
    problem, found = PROBLEMS[name], of_spindle(name)
    assert found.is_feasible == problem.is_feasible
    ours = problem.solved(np.array(list(found.values.values())))
    scale = float(np.abs(problem.cost(ours))) or 1.0
    _, theirs = by_evolution(problem, scale)
    if not problem.is_feasible:
        assert problem.violation(ours) == pytest.approx(problem.violation(theirs), rel=CLOSE)
        return
    assert problem.violation(ours) <= 2e-6
    assert problem.violation(theirs) <= CLOSE
    assert problem.cost(ours) == pytest.approx(problem.cost(theirs), rel=CLOSE, abs=1e-12)


def test_a_goal_is_met_by_the_solver_itself() -> None:
    name = "stiffness by preload"
    problem, found = PROBLEMS[name], of_spindle(name)
    assert problem.violation(problem.solved(np.array(list(found.values.values())))) <= 2e-6
    assert found.is_feasible and found.failed == ()
    assert qs.solve(found.scene).effective_stiffness[1] / 1e6 == pytest.approx(200.0, rel=1e-6)


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_head_says_that_goals_are_met_or_that_no_point_meets_them(name: str) -> None:
    """Of a point between the sampled ones in one sentence."""
    found = of_spindle(name)
    for share in {found.feasible_share, 0.0}:
        said = heading(replace(found, feasible_share=share))
        assert ("No point" in said) == (not found.is_feasible), said
        if found.is_feasible:
            assert ("met at one point, between those sampled" in said) == (share == 0.0), said
            assert ("sampled points meet all" in said) == (share > 0.0), said
            assert share > 0.0 or said.count(".") == 1, said


def test_the_benchmark_of_bearing_design_is_met() -> None:
    """Ten variables, seven limits, one whole number; the printed design is reached, and its assembly limit and wall."""
    printed = capacity(np.array([[PRINTED[each.key] for each in PROBLEM.variables]]))
    assert printed[0, -1] == pytest.approx(PRINTED_CAPACITY, abs=0.05), "the printed value is the function's"
    best = search(PROBLEM, capacity, 1 << 14)
    assert best.is_feasible
    assert best.results[-1] == pytest.approx(PRINTED_CAPACITY, rel=2e-5)
    values = dict(zip((each.key for each in PROBLEM.variables), best.values, strict=True))
    assert values["Z"] == PRINTED["Z"]
    assert values["Db"] == pytest.approx(PRINTED["Db"], rel=1e-4)
    active = dict(zip(LIMITS, np.abs(best.results[:-1]) < 1e-3, strict=True))
    assert active["assembly"] and active["wall"]


def test_limits_bind_and_ranges_hold_what_they_say() -> None:
    name = "stiffest at any speed"
    problem, found = PROBLEMS[name], of_spindle(name)
    assert "inner_max_pressure_max <= 1400" in found.binding
    best = np.array(list(found.values.values()))
    top = stiffness(problem.solved(best))
    for i, key in enumerate(problem.vary):
        low, high = found.ranges[key]
        assert low <= best[i] <= high
        for end, beyond in ((low, low - 0.01 * best[i]), (high, high + 0.01 * best[i])):
            inside, outside = (problem.solved(np.where(np.arange(best.size) == i, x, best)) for x in (end, beyond))
            assert problem.violation(inside) <= 2e-3
            assert stiffness(inside) == pytest.approx(top, rel=1.05e-2)
            within_bounds = 1000.0 <= beyond <= 30000.0 if key == "speed_rpm" else 10.0 <= beyond <= 2500.0
            if within_bounds:
                assert problem.violation(outside) > 1e-5 or abs(stiffness(outside) / top - 1.0) > 0.95e-2


def test_values_of_a_list_and_whole_numbers_stay_such() -> None:
    found = qs.find(
        copy.deepcopy(SPINDLE), {"ball_diameter_mm": BALLS, "ball_count": (10.5, 16.0)},
        limits=["inner.max_pressure_MPa<=1600"], maximise="effective_stiffness_radial_y", points=512,
    )  # fmt: skip
    assert found.values["ball_diameter_mm"] in BALLS
    assert found.values["ball_count"] in range(11, 17)


def test_what_does_not_fit_is_no_candidate() -> None:
    """A wall of points that describe no bearing: the stiffest is the ball that just fits into its grooves."""
    found = qs.find(
        copy.deepcopy(SPINDLE), {"ball_diameter_mm": "11:16"}, maximise="effective_stiffness_radial_y", points=256
    )
    largest = found.values["ball_diameter_mm"]
    tables = copy.deepcopy(SPINDLE)
    tables["bearing"] |= {"ball_diameter_mm": largest * 1.001}
    with pytest.raises(qs.SceneError, match="smaller than the ball"):
        qs.find(tables, {"rigid_N": "10:20"}, minimise="inner.max_pressure_MPa", points=16)


def test_no_feasible_point_is_the_nearest_and_says_what_fails() -> None:
    found = qs.find(copy.deepcopy(SPINDLE), RIGID, goals=[f"{STIFF}=600"], limits=[f"{PRESSURE}<=1500"], points=256)
    assert not found.is_feasible and not found.ranges
    assert len(found.failed) == 2 and "off by" in found.failed[0]


def test_a_set_is_searched_too() -> None:
    tables = {key: value for key, value in SPINDLE.items() if key != "operation"}
    tables |= {"rows": [{"position_mm": 0.0, "carries": "+x"}, {"position_mm": 20.0, "carries": "-x"}]}
    tables |= {"operation": {"speed_rpm": 12000.0}}
    found = qs.find(tables, {"rigid_N": "100:2000"}, goals=["effective_stiffness_axial=150"], points=64)
    assert found.results["shaft_effective_stiffness_axial"] == pytest.approx(150.0, rel=1e-5)


@pytest.mark.parametrize(
    ("vary", "asked", "said"),
    [
        ({"rigid_M": "1:2", "speed_rpm": "2:1"}, {"goals": ["x"], "limits": ["y=1"]}, ["rigid_N", "below", "form"]),
        ({}, {}, ["no variables", "nothing is asked for"]),
        ({"rigid_N": "1:2:3"}, {"minimise": "a", "maximise": "b"}, ["chooses its points", "together with minimise"]),
        ({"speed_rpm": "0:1:log"}, {"limits": ["a<=nan"]}, ["above zero", "finite"]),
        (RIGID, {"limits": ["inner.max_pressure_GPa<=1.7"], "minimise": "contact_angel"}, ["in MPa", "not a result"]),
        (RIGID, {"limits": ["outer_max_presure_MPa<=1500"]}, ["Did you mean outer_max_pressure_MPa?"]),
        ({"rpm": "1:2"}, {"limits": ["outer_load<=1500,5"]}, ["mean speed_rpm?", "Decimals take a point: 1500.5"]),
        ({"rigid_N": "-5:-1"}, {"minimise": STIFF}, ["no point describes a bearing"]),
        (RIGID, {"minimise": "effective_stiffness_axial", "goals": [f"{STIFF}=1"]}, ["axial: has no value", "held"]),
        (dict.fromkeys(["a", "b", "c", "d", "e", "f", "g"], "1:2"), {"minimise": STIFF}, ["7 variables"]),
    ],
)  # fmt: skip
def test_bad_input_is_said_at_once(vary: dict[str, str], asked: dict[str, list[str]], said: list[str]) -> None:
    with pytest.raises(qs.SceneError) as error:
        qs.find(copy.deepcopy(SPINDLE), vary, **asked, points=64)
    for words in said:
        assert words in str(error.value)


def test_grey_begins_where_the_limit_is_met() -> None:
    """Between the points of the curve too, and under the star; single values keep half of the way to the next ones."""

    def spans(figure: Any) -> list[Any]:
        return [(each.get_x(), each.get_x() + each.get_width()) for each in figure.axes[0].patches]

    x = np.linspace(0.0, 40.0, 41)
    middle = Bounded("a", "N", np.abs(x - 20.25), [("<=", 5.1)])
    beyond = Bounded("b", "N", np.where(x > 35.0, np.nan, x), [(">=", 3.3)])
    drawn = draw_region(Along("speed_rpm", "rpm", x, 20.0), None, [middle, beyond], "", "", "best")
    assert [bool(each.get_xlabel()) for each in drawn.axes] == [False, True]
    found = spans(drawn)
    assert found == [pytest.approx((0.0, 15.15)), pytest.approx((25.35, 40.0))]
    few = Along("ball_count", "", np.arange(12.0, 17.0), 14.0)
    listed = spans(draw_region(few, None, [Bounded("a", "N", few.values, [("<=", 14.0)])], "", "", "best"))
    assert listed == [pytest.approx((14.5, 16.0))]


def test_what_is_shown_of_a_search_is_what_it_did() -> None:
    """Grey begins under the star; points over the ranges and near the best ones are counted apart."""
    stiff = qs.find(copy.deepcopy(SPINDLE), RIGID, limits=[f"{PRESSURE}<=1500"], maximise=STIFF, points=200)
    (grey,) = picture(stiff).axes[0].patches
    assert grey.get_x() == pytest.approx(stiff.values["rigid_N"], rel=1e-5)  # limits are met to 1e-6
    assert record(stiff)["sampled"] == 200 < record(stiff)["evaluations"]
    assert f"{100.0 * stiff.feasible_share:.3g} % of the sampled points meet" in record(stiff)["message"]
    said = [each.text for each in tables(stiff) if isinstance(each, Paragraph)]
    assert said[-1].startswith(f"200 points over all ranges and {stiff.evaluations - 200:,} near the best ones")


def test_a_logarithmic_range_is_spread_evenly_over_its_logarithm() -> None:
    (variable,) = problem_of({"rigid_N": "1:100:log"}, [], [], STIFF, None, "").variables
    assert variable.at(np.array([0.0, 0.5, 1.0])) == pytest.approx([1.0, 10.0, 100.0])
    assert Variable("speed_rpm", 0.0, 1.0).at(np.array([1.5])) == 1.0


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "spindle.toml"
    path.write_text(
        '[bearing]\nname = "7210C_hybrid"\n[operation]\nspeed_rpm = 18000\nradial_load_y_N = 300\ntilt_z_mrad = 0\n'
        '[preload]\nrigid_N = 300\n[effects]\nball = ["centrifugal_force", "gyroscopic_moment"]\n'
        'raceway_control = "outer"\n'
    )  # fmt: skip
    return path


def test_its_json_is_a_scene_that_runs(file: Path, tmp_path: Path) -> None:
    result = call("find", file, "--vary", "rigid_N=10:2000", "--goal", f"{STIFF}=200", "--points", "128", "--json")
    assert result.exit_code == 0
    (tmp_path / "found.json").write_text(result.stdout)
    again = json.loads(call("run", tmp_path / "found.json", "--json").stdout)
    found = json.loads(result.stdout)["results"]["ring_effective_stiffness_radial_y"]
    assert qs.solve(qs.load_scene(tmp_path / "found.json")).effective_stiffness[1] / 1e6 == pytest.approx(found)
    assert again["input"]["preload"]["rigid_N"] == json.loads(result.stdout)["values"]["rigid_N"]
    assert json.loads(result.stdout)["warnings"] == again["warnings"] != []


@pytest.mark.parametrize(
    ("is_set", "goal"), [(False, "inner_max_pressure=1000"), (True, "effective_stiffness_axial=150")]
)
def test_it_prints_the_remarks_that_run_gives_of_what_is_found(tmp_path: Path, is_set: bool, goal: str) -> None:
    """Without effects, whose lack changes the loads of a spindle; the last that both print."""
    text = '[bearing]\nname = "7210C"\n[operation]\nspeed_rpm = 12000\n[preload]\nrigid_N = 300\n'
    rows = ('[[rows]]\nposition_mm = 0\ncarries = "+x"\n', '[[rows]]\nposition_mm = 20\ncarries = "-x"\n')
    (tmp_path / "any.toml").write_text(text + "".join(rows) * is_set)
    asked = ("--vary", "rigid_N=100:2000", "--goal", goal, "--points", "64")
    printed = call("find", tmp_path / "any.toml", *asked).stdout
    (tmp_path / "found.json").write_text(call("find", tmp_path / "any.toml", *asked, "--json").stdout)
    again = call("run", tmp_path / "found.json").stdout
    (found, shown) = (" ".join(each.split()).partition("Incomplete model: ")[2] for each in (printed, again))
    shown = shown.partition(" Converged in ")[0]
    assert "centrifugal force" in found
    assert found == shown.partition(" Converged in ")[0]


@pytest.mark.parametrize(
    "vary", [["rigid_N=10:2000"], ["rigid_N=10:2000:log", "speed_rpm=1000:20000"], ["ball_count=12:14"]]
)
def test_the_command_draws_and_ends_as_it_says(file: Path, tmp_path: Path, vary: list[str], drawn: None) -> None:
    options = [word for each in vary for word in ("--vary", each)]
    picture = tmp_path / "region.svg"
    limits = ("--limit", f"{PRESSURE}<=1500", "--maximise", STIFF, "--points", "64")
    result = call("find", file, *options, *limits, "--plot", picture)
    assert result.exit_code == 0 and "Largest" in result.stdout
    assert "1500" in picture.read_text()
    result = call("find", file, *options, "--limit", f"{PRESSURE}<=100", "--points", "64")
    assert result.exit_code == 1 and "Not met: inner_max_pressure_max <= 100" in result.stdout
    result = call("find", file, *options, "--limit", f"{PRESSURE}", "--plot", tmp_path / "no" / "a.png")
    assert result.exit_code == 2 and "no folder" in result.output and "form" in result.output
