"""The fallback, layer by layer: scenes that Newton's method from two starts does not solve, and what solves each.

Each scene that must converge was chosen because it no longer does when the layer that the test names is left out.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.kernel.case import RESULT
from qsbearing.model.kernel.solve_case import BUDGET, UNFINISHED, solve_cases
from qsbearing.model.kernel.workspace import working_memory
from qsbearing.model.solution import solve_records
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.solved_cases import solved_of
from tests.qsbearing.mechanics import ring_load
from tests.qsbearing.scenes import (
    B218,
    BOTH,
    BOTH_HARRIS,
    CENTRIFUGAL,
    INNER,
    MINIMUM_DISSIPATION,
    OUTER,
    PER_BALL,
    UPRIGHT,
    resting,
    turning,
)
from tests.verification.campaign.checks import findings
from tests.verification.campaign.envelope import chunk_groups

STEEP = replace(B218, free_contact_angle=65 * qs.deg, ball_count=14)
"""A bearing for thrust: at speed its balls leave the inner ring almost over the shoulder."""


def free_to_tilt(axial: Any, aside: Any, across: Any) -> dict[str, Any]:
    return {"axial_load": axial, "radial_load_y": aside, "radial_load_z": across, "moment_y": 0.0, "moment_z": 0.0}


def upright(axial: float, aside: float) -> dict[str, float]:
    return {"axial_load": axial, "radial_load_y": aside, **UPRIGHT}


CENTRIFUGAL_INNER = {"effects": CENTRIFUGAL, "control": INNER}
BOTH_INNER = {"effects": BOTH, "control": INNER}
EACH = {"effects": BOTH, "control": PER_BALL}

SCENES: dict[str, dict[str, qs.Scene]] = {
    "continuation from heavier loads": {
        "loads a millionth of inertia": turning(
            20e3, effects=CENTRIFUGAL, control=OUTER, **free_to_tilt(0.025, 0.032, 0.0128)
        ),
        "light balls between upright rings": turning(
            10e3, effects=BOTH_HARRIS, control=INNER, **upright(0.56, 0.071), radial_load_z=0.0284
        ),
    },
    "continuation in speed": {
        "every raceway a little": turning(
            15e3, effects=CENTRIFUGAL, control=MINIMUM_DISSIPATION, **free_to_tilt(6.4, 17.0, 6.8)
        ),
    },
    "friction no more than load": {
        "light balls": turning(5e3, **BOTH_INNER, **upright(12.0, 1.6), radial_load_z=0.64),
    },
    "pseudo-time steps at speed": {
        "balls far below inertia": turning(30e3, **BOTH_INNER, **upright(550.0, 210.0), radial_load_z=84.0),
    },
    "release of the bound": {
        "few loaded balls": turning(10e3, effects=BOTH_HARRIS, control=INNER, **free_to_tilt(900.0, 5900.0, 0.0)),
    },
    "the inner raceway in control first": {
        "few loaded balls, fast": turning(
            20e3, effects=BOTH_HARRIS, control=PER_BALL, **free_to_tilt(3100.0, 9500.0, 0.0)
        ),
    },
}


@pytest.mark.parametrize(
    ("layer", "scene"),
    [(layer, scene) for layer, scenes in SCENES.items() for scene in scenes],
    ids=[f"{layer}: {scene}" for layer, scenes in SCENES.items() for scene in scenes],
)
def test_each_layer_finds_an_equilibrium(layer: str, scene: str) -> None:
    """Newton's method from two starts does not; the equilibrium found is one by the loads read from it, and its balls
    go round."""
    asked = SCENES[layer][scene]
    assert direct_code(asked) == UNFINISHED
    solution = qs.solve(asked)
    assert solution.converged, (solution.status, solution.reason, solution.iterations)
    assert solution.residual <= 1e-10
    operation = asked.operation
    wanted = np.array([operation.axial_load, operation.radial_load_y, operation.radial_load_z or 0.0], float)
    largest = max(np.abs(wanted).max(), solution.centrifugal_force.max())
    assert ring_load(solution)[:3] == pytest.approx(wanted, abs=1e-9 * largest)
    assert solution.orbital_speed.min() > 0.02 * operation.speed


@pytest.mark.skipif(not has_fast_code(), reason="thousands of iterations of plain Python")
def test_friction_no_more_than_a_tenth_of_the_load_finds_an_equilibrium() -> None:
    """The only one of 22,000 random scenes that is lost without this bound: campaign scene wild/1/11/39."""
    scene = chunk_groups(1, 11, envelope="wild")[1].part([14]).scene()
    assert direct_code(scene) == UNFINISHED
    solution = qs.solve(scene)
    assert solution.converged.all()
    assert not any(bad.any() for bad in findings(scene, solution).failed().values())


def direct_code(scene: qs.Scene) -> int:
    """How the direct stage ends."""
    maker = CaseMaker(scene)
    balls = maker.ball_axis
    results, positions, controls = np.empty(1, RESULT), np.empty((1, balls, 3)), np.zeros((1, balls), np.int8)
    cases = maker.make()
    memory = working_memory(balls)
    solve_cases(cases, *memory, maker.own_balls(cases), 1e-12, BUDGET, False, results, positions, controls)
    return int(results["status"][0])


# At rest --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("axial", [1e-6, 1e-3, 1.0])
def test_at_rest_light_loads_near_the_limit_of_support(axial: float) -> None:
    """A moment that lifts all balls but those on one side, under next to no load: one minimum, and it is found."""
    bearing = replace(B218, kind=qs.BearingKind.DEEP_GROOVE, free_contact_angle=65 * qs.deg, ball_count=14)
    scene = resting(bearing, axial_load=axial, moment_z=0.1 * axial)
    assert direct_code(scene) == UNFINISHED or qs.solve(scene).converged
    solution = qs.solve(scene)
    assert solution.converged
    assert ring_load(solution) == pytest.approx([axial, 0.0, 0.0, 0.0, 0.1 * axial], abs=1e-9 * axial)


@pytest.mark.parametrize("load", [0.01, 1.0, 100.0])
def test_at_rest_pseudo_time_steps_find_a_ring_between_few_balls(load: float) -> None:
    """A radial load between two of six balls: the ring slides along until others touch, further than Newton's method
    and continuation from heavier loads lead it."""
    bearing = replace(B218, kind=qs.BearingKind.DEEP_GROOVE, ball_count=6)
    aside, across = load * np.cos(0.2), load * np.sin(0.2)
    solution = qs.solve(resting(bearing, **free_to_tilt(0.0, aside, across)))
    assert solution.converged
    assert ring_load(solution) == pytest.approx([0.0, aside, across, 0.0, 0.0], abs=1e-9 * load)


def test_at_rest_nothing_supports_the_load() -> None:
    """A ring on one ball, free to move and to tilt, moves without end: the answer, not a failure to converge."""
    solution = qs.solve(resting(replace(B218, ball_count=1), **free_to_tilt(500.0, 100.0, 0.0)))
    assert solution.status is qs.Status.NO_EQUILIBRIUM
    assert solution.reason == qs.Reason.UNSUPPORTED
    assert solution.speed_reached == 1.0


# The direct stage -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "scene",
    [
        turning(10e3, **CENTRIFUGAL_INNER, **upright(1e3, 3e3)),
        turning(5e3, **EACH, **free_to_tilt(0.01, 0.01, 0.004)),
    ],
    ids=["radial load three times the axial", "loads far below inertia"],
)
def test_a_second_start_spares_the_fallback(scene: qs.Scene) -> None:
    """Newton's method from the likelier start alone leaves these to the fallback, ten times as dear."""
    assert direct_code(scene) == CONVERGED


# Refusals and limits --------------------------------------------------------------------------------------------------


def test_a_case_is_left_as_it_was() -> None:
    """What continuation varies stands in the workspace: records of cases that it solved are those that were made."""
    scene = turning(20e3, STEEP, **EACH, **upright(1e3, 500.0))
    solution = qs.solve(scene)
    assert solution.iterations > 100
    left, made = solved_of(solution)._cases, CaseMaker(scene).make()
    assert left is not None
    for name in made.dtype.names:
        assert np.array_equal(left[name], made[name]), name


def test_a_case_may_be_left_in_an_equilibrium_below_its_speed() -> None:
    """The way up in speed ends where a contact leaves its groove; the case is refused for the part that is told."""
    scene = turning(5e3, STEEP, **BOTH_INNER, **upright(100.0, 20.0))
    solution = qs.solve(scene)
    assert solution.status is qs.Status.NO_EQUILIBRIUM
    assert 0.0 < float(solution.speed_reached) < 1.0
    assert f"{100 * float(solution.speed_reached):.3g} % of the speed" in qs.message(solution)


@pytest.mark.parametrize(
    ("moment", "is_refused"),
    [(0.0, True), (-2e-6, False)],
    ids=["balls over the shoulder at rest", "balls that only rounding presses over the shoulder"],
)
def test_a_case_for_which_nothing_is_found_is_refused_if_the_bearing_at_rest_is(
    moment: float, is_refused: bool
) -> None:
    """Rings turn against each other, so that balls hardly orbit: the equilibrium at rest is unique and the evidence."""
    loads = {"axial_load": 1e-4, "radial_load_y": 1e-4, "radial_load_z": 0.0, "moment_y": 0.0, "moment_z": moment}
    solution = qs.solve(turning(10.0, STEEP, outer_rpm=-8.3, effects=CENTRIFUGAL, control=OUTER, **loads))
    at_rest = qs.solve(resting(STEEP, **loads))
    assert (at_rest.status is qs.Status.NO_EQUILIBRIUM) == is_refused
    if is_refused:
        assert solution.status is qs.Status.NO_EQUILIBRIUM
        assert solution.reason == at_rest.reason == qs.Reason.OVER_SHOULDER
        assert solution.speed_reached == 0.0
    else:
        assert solution.status is not qs.Status.NO_EQUILIBRIUM


def test_no_step_is_taken_beyond_the_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a budget of 25 iterations, fewer than one call of Newton's method may use: neither it nor the pseudo-time
    steps go on."""
    monkeypatch.setattr(solve_records, "BUDGET", 25)
    for layer in ("continuation from heavier loads", "pseudo-time steps at speed"):
        solution = qs.solve(next(iter(SCENES[layer].values())))
        assert str(solution.status) in ("not_converged", "no_equilibrium")
        assert solution.iterations <= 2 * 25  # direct stage and fallback, each its own


@pytest.mark.skipif(not has_fast_code(), reason="thousands of iterations of plain Python")
def test_what_does_not_converge_says_so() -> None:
    """Loads a ten-millionth of inertia, which opposes them."""
    scene = turning(40e3, **CENTRIFUGAL_INNER, **free_to_tilt(0.01, 0.002, 0.0008))
    solution = qs.solve(scene)
    assert solution.status is qs.Status.NOT_CONVERGED
    assert solution.iterations <= BUDGET + 100
    assert "does not prove" in qs.message(solution)


def test_one_case_sees_nothing_of_another() -> None:
    """Hard cases in one batch, in either order: what each comes to is what it comes to alone."""
    axial, aside, across = np.array([[0.26, 0.57], [0.028, 0.13], [0.0, 0.052]])
    one, other = (turning(40e3, **CENTRIFUGAL_INNER, **free_to_tilt(axial[k], aside[k], across[k])) for k in range(2))
    both = turning(40e3, **CENTRIFUGAL_INNER, **free_to_tilt(axial, aside, across))
    batch = qs.solve(both)
    for k, scene in enumerate((one, other)):
        assert batch.converged[k]
        assert np.array_equal(batch.displacement[k], qs.solve(scene).displacement)
