"""Batches in lanes: the digits of the scalar kernel, whatever stands in the other lanes, and loops that are packed."""

from __future__ import annotations

import platform
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import HAS_NUMBA, functions, has_fast_code
from qsbearing.model.effects.raceway_control import INNER, MINIMUM_DISSIPATION, OUTER
from qsbearing.model.kernel import lanes
from qsbearing.model.kernel.admissibility import CONVERGED, NO_EQUILIBRIUM
from qsbearing.model.kernel.case import RESULT
from qsbearing.model.kernel.lane_assembly import evaluate_ball_lanes
from qsbearing.model.kernel.lane_linear import solve_lanes
from qsbearing.model.kernel.lane_state import BALL_LANES, LANES, RING_LANES, lane_memory
from qsbearing.model.kernel.lanes import propose_lanes, step_ball_lanes
from qsbearing.model.kernel.solve_case import BUDGET, UNFINISHED, solve_cases
from qsbearing.model.kernel.workspace import working_memory
from qsbearing.model.solution import solver
from qsbearing.model.solution.flatten import CaseMaker
from tests.verification.benchmarks import scenes
from tests.verification.campaign.envelope import chunk_groups

BOTH_HARRIS = (qs.CentrifugalForce(), qs.GyroscopicMoment(qs.MomentShares.HARRIS))

pytestmark = pytest.mark.skipif(not has_fast_code(), reason="plain Python solves no batches in lanes")

Found = tuple[NDArray, NDArray, NDArray]


def solved_by(solve: Any, maker: CaseMaker, cases: NDArray) -> Found:
    """Results, positions and controls."""
    shape = (cases.size, maker.ball_axis)
    found = np.zeros(cases.size, RESULT), np.zeros((*shape, maker.position_size)), np.zeros(shape, np.int8)
    solve(cases, *working_memory(maker.ball_axis), maker.own_balls(cases), solver.TOLERANCE, BUDGET, False, *found)
    return found


def in_lanes_alone(cases: NDArray, memory: NDArray, balls: NDArray, own: NDArray, *rest: Any) -> None:
    """As `solve_batch`, without what is left to the scalar kernel."""
    tolerance, _, _, *found = rest
    found[0]["status"] = lanes.WAITING
    lanes.solve_in_lanes(cases, memory, balls, own, *lane_memory(balls.size), tolerance, *found)


def made(scene: qs.Scene) -> tuple[CaseMaker, NDArray]:
    maker = CaseMaker(scene)
    return maker, maker.make(0, maker.count)


def assert_same(found: Found, expected: Found, which: Any = ...) -> None:
    """The same digits; of cases that did not converge, the same status and iterations."""
    for name in ("status", "iterations"):
        assert np.array_equal(found[0][name][which], expected[0][name][which]), name
    there = np.zeros(expected[0].size, bool)
    there[which] = expected[0]["status"][which] == CONVERGED
    for name in ("displacement", "load", "residual", "reached", "notes"):
        assert np.array_equal(found[0][name][there], expected[0][name][there]), name
    for one, other in zip(found[1:], expected[1:], strict=True):
        assert np.array_equal(one[there], other[there])


def mixed(count: int) -> qs.Scene:
    """Cases of other kinds among usual ones: without radial load, at rest, pulled, other ball counts; and some that end
    with contacts on the open side, which no equilibrium has."""
    rng = np.random.default_rng(5)
    scene = scenes.random_points(count)
    axial, radial = np.array(scene.operation.axial_load), np.array(scene.operation.radial_load_y)
    speed = np.array(scene.operation.speed)
    radial[rng.random(count) < 0.2] = 0.0
    speed[rng.random(count) < 0.1] = 0.0
    axial[rng.random(count) < 0.1] *= -1.0
    radial[::20] = 2.5 * np.abs(axial[::20])
    bearing = replace(scene.bearing, ball_count=rng.choice([16, 16, 15], count))
    operation = qs.Operation(speed=speed, axial_load=axial, radial_load_y=radial, moment_z=0.0)
    return qs.Scene(bearing, operation, scenes.BOTH, qs.RacewayControl.OUTER)


def held(count: int) -> qs.Scene:
    """Upright rings: prescribed displacements, whose reactions are part of the result."""
    operation = scenes.random_points(count).operation
    upright = {"tilt_y": 0.0, "tilt_z": 0.0}
    loads = {name: getattr(operation, name) for name in ("speed", "axial_load", "radial_load_y")}
    return scenes.at_speed(qs.Operation(**loads, **upright))


def without_moment(count: int) -> qs.Scene:
    """Centrifugal force alone."""
    return replace(scenes.random_general_points(count), ball_effects=scenes.BOTH[:1])


def per_ball(count: int) -> qs.Scene:
    """Jones's criterion: the outer raceway controls nearly all balls of nearly all cases."""
    return replace(scenes.random_general_points(count), raceway_control=qs.RacewayControl.PER_BALL)


def per_ball_without_moment(count: int) -> qs.Scene:
    return replace(per_ball(count), ball_effects=scenes.BOTH[:1])


def other_bearings(scene: qs.Scene) -> qs.Scene:
    """Bearings of several diameters, curvatures and angles: what belongs to a bearing belongs to its lane."""
    rng, count = np.random.default_rng(6), np.asarray(scene.operation.speed).size
    diameter = np.asarray(scene.bearing.ball_diameter) * rng.uniform(0.8, 1.0, count)
    grown: dict[str, Any] = {
        "ball_diameter": diameter,
        "inner_groove_radius": diameter * rng.uniform(0.515, 0.53, count),
        "outer_groove_radius": diameter * rng.uniform(0.515, 0.53, count),
        "free_contact_angle": rng.uniform(0.4, 0.7, count),
    }
    return replace(scene, bearing=replace(scene.bearing, **grown))


def least_dissipation(count: int) -> qs.Scene:
    """Axes and shares of the moment that follow the loads."""
    scene = replace(scenes.random_general_points(count), raceway_control=qs.RacewayControl.MINIMUM_DISSIPATION)
    return other_bearings(scene)


def least_dissipation_by_halves(count: int) -> qs.Scene:
    return replace(least_dissipation(count), ball_effects=BOTH_HARRIS)


def least_dissipation_without_moment(count: int) -> qs.Scene:
    return replace(least_dissipation(count), ball_effects=scenes.BOTH[:1])


def inner(count: int) -> qs.Scene:
    """Inner control, where one case in five has no equilibrium."""
    return other_bearings(replace(scenes.random_points(count), raceway_control=qs.RacewayControl.INNER))


def inner_by_halves(count: int) -> qs.Scene:
    return replace(inner(count), ball_effects=BOTH_HARRIS)


def inner_without_moment(count: int) -> qs.Scene:
    return replace(inner(count), ball_effects=scenes.BOTH[:1])


def inner_thrust(count: int) -> qs.Scene:
    """Thrust alone, of which lanes refuse what is below the least, as the scalar kernel does."""
    scene = inner(count)
    operation = replace(scene.operation, radial_load_y=0.0, axial_load=0.3 * np.asarray(scene.operation.axial_load))
    return replace(scene, operation=operation)


@pytest.mark.parametrize(
    ("make", "least"),
    [
        (least_dissipation, 0.95),
        (least_dissipation_by_halves, 0.95),
        (least_dissipation_without_moment, 0.95),
        (inner, 0.6),
        (inner_by_halves, 0.9),
        (inner_without_moment, 0.95),
        (inner_thrust, 0.6),
        (without_moment, 0.99),
        (per_ball, 0.7),
        (per_ball_without_moment, 0.7),
        (scenes.random_points, 0.99),
        (scenes.random_general_points, 0.99),
        (held, 0.99),
        (mixed, 0.75),
    ],
)
def test_lanes_give_the_digits_of_the_scalar_kernel(make: Any, least: float) -> None:
    """`least`: the part of the cases that lanes solve without it."""
    maker, cases = made(make(300))
    assert lanes.lanes_know(cases).all()
    expected = solved_by(solve_cases, maker, cases)
    assert_same(solved_by(lanes.solve_batch, maker, cases), expected)
    alone = solved_by(in_lanes_alone, maker, cases)[0]["status"]
    assert np.mean(alone == CONVERGED) >= least
    assert set(alone) <= {CONVERGED, UNFINISHED, *([NO_EQUILIBRIUM] if make is inner_thrust else [])}


def test_a_lane_that_is_not_a_number_leaves_the_others_their_digits() -> None:
    maker, cases = made(scenes.random_general_points(200))
    expected = solved_by(solve_cases, maker, cases)
    broken = np.arange(200) % 7 == 3
    for name in ("tilt_lever", "inner_speed"):
        spoilt = cases.copy()
        spoilt[name][broken] = np.nan
        found = solved_by(in_lanes_alone, maker, spoilt)
        assert (found[0]["status"][broken] == UNFINISHED).all()
        assert_same(found, expected, np.flatnonzero(~broken & (found[0]["status"] == CONVERGED)))
        assert np.mean(found[0]["status"][~broken] == CONVERGED) > 0.95


def test_only_batches_from_no_start_are_solved_in_lanes(monkeypatch: pytest.MonkeyPatch) -> None:
    counts: list[int] = []

    def watched(cases: NDArray, *rest: Any) -> int:
        counts.append(cases.size)
        return solve_cases(cases, *rest)

    monkeypatch.setattr(lanes, "solve_batch", watched)
    few, many = scenes.random_points(solver.LEAST_BATCH - 1), scenes.random_points(solver.LEAST_BATCH)
    start = qs.solve(few)
    qs.solve(few)
    assert counts == []
    batch = qs.solve(many)
    assert counts == [solver.LEAST_BATCH]
    qs.solve(many, start=batch)
    assert counts == [solver.LEAST_BATCH]
    assert start.converged.all()


@pytest.mark.parametrize(
    "change",
    [
        {"ball_effects": (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.07))},
        {"ball_effects": (qs.GyroscopicMoment(),)},
        {"hertz_angle": qs.HertzAngle.ACTUAL},
        {"orbit_radius": qs.OrbitRadius.DISPLACED},
    ],
)
def test_lanes_know_what_they_do_not_know(change: dict[str, Any]) -> None:
    scene = scenes.combined()
    assert lanes.lanes_know(made(scene)[1]).all()
    assert not lanes.lanes_know(made(replace(scene, **change))[1]).any()


def test_lanes_are_left_out_where_they_know_no_case(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lanes, "solve_in_lanes", None)
    maker, cases = made(replace(scenes.random_points(20), hertz_angle=qs.HertzAngle.ACTUAL))
    assert_same(solved_by(lanes.solve_batch, maker, cases), solved_by(solve_cases, maker, cases))


PACKED = {
    "x86_64": r"\bv?mulpd\b",
    "aarch64": r"\bfmul\s+v\d+\.2d",
}
"""Multiplications of several numbers at once, by processor."""


@pytest.mark.heavy
@pytest.mark.skipif(platform.machine() not in PACKED, reason="no instruction known of this processor")
@pytest.mark.skipif(not HAS_NUMBA, reason="numba is not installed, or switched off")
def test_loops_over_lanes_are_packed() -> None:
    """A compiler that packs none makes lanes slower than one case at a time."""
    from qsbearing.model.compiler import numba_kernel

    def evaluate(rings: NDArray, balls: NDArray) -> None:
        evaluate_ball_lanes(rings[0], balls[0], True, OUTER, 0)

    def evaluate_without_moment(rings: NDArray, balls: NDArray) -> None:
        evaluate_ball_lanes(rings[0], balls[0], False, OUTER, 0)

    def evaluate_inner(rings: NDArray, balls: NDArray) -> None:
        evaluate_ball_lanes(rings[0], balls[0], True, INNER, 1)

    def evaluate_least_dissipation(rings: NDArray, balls: NDArray) -> None:
        evaluate_ball_lanes(rings[0], balls[0], True, MINIMUM_DISSIPATION, 1)

    def step(rings: NDArray, balls: NDArray) -> None:
        step_ball_lanes(rings[0], balls[0])

    def propose(rings: NDArray, balls: NDArray) -> None:
        propose_lanes(rings[0], balls, 1)

    def solve(rings: NDArray, balls: NDArray) -> None:
        solve_lanes(rings[0])

    least_of = {
        evaluate: 200,
        evaluate_without_moment: 100,
        evaluate_inner: 200,
        evaluate_least_dissipation: 200,
        step: 50,
        propose: 10,
        solve: 40,
    }
    for function, least in least_of.items():
        compiled = numba_kernel.njit(**numba_kernel.OPTIONS)(numba_kernel.Dispatchers(functions).filled(function))
        compiled(np.ones(1, RING_LANES), np.ones(1, BALL_LANES))
        (text,) = compiled.inspect_asm().values()
        found = len(re.findall(PACKED[platform.machine()], text))
        assert found >= least, f"{function.__name__}: {found} packed multiplications in lanes of {LANES}"


@pytest.mark.heavy
@pytest.mark.parametrize(("envelope", "chunks"), [("realistic", 40), ("wild", 200)])
def test_lanes_give_the_digits_of_the_scalar_kernel_over_campaigns(envelope: str, chunks: int) -> None:
    solved = 0
    for chunk in range(chunks):
        for group in chunk_groups(1, chunk, envelope=envelope):
            maker, cases = made(group.scene())
            if lanes.lanes_know(cases).all():
                assert_same(solved_by(lanes.solve_batch, maker, cases), solved_by(solve_cases, maker, cases))
                solved += int((solved_by(in_lanes_alone, maker, cases)[0]["status"] == CONVERGED).sum())
    assert solved > 500
