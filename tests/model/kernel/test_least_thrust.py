"""The least thrust under inner raceway control: an independent equation for it, its limits, and the full search."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import acos, cos, sin
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq

import qsbearing as qs
from qsbearing.model.compiler.compiled import has_fast_code
from qsbearing.model.kernel.admissibility import CONVERGED, FRICTION_WITHOUT_LOAD, NO_EQUILIBRIUM
from qsbearing.model.kernel.case import RESULT
from qsbearing.model.kernel.fallback import solve_unfinished
from qsbearing.model.kernel.least_thrust import MARGIN, least_thrust, thrust_bound
from qsbearing.model.kernel.solve_case import BUDGET, UNFINISHED, solve_cases
from qsbearing.model.kernel.workspace import working_memory
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.flatten import CaseMaker
from tests.qsbearing.scenes import B218, BOTH, BOTH_HARRIS, DEEP_GROOVE, INNER, OUTER, SPINDLE, turning
from tests.verification.campaign.checks import findings
from tests.verification.campaign.envelope import chunk_groups
from tests.verification.campaign.realistic import AXIAL_RATING, SPEED_PARAMETER, draw_bearing

BEARINGS = {"B218": B218, "spindle": SPINDLE, "deep groove": DEEP_GROOVE}
OF_FALLBACK = 500
"""Iterations: the search from closed forms and from rest takes 10 to 200, the fallback another 2,000."""
SHARES = {"controlling": BOTH, "harris": BOTH_HARRIS}


def least_of(case: Any) -> float:
    """Of a ball, in the case's units."""
    work: Any = SimpleNamespace(speed_factor=1.0)
    ball: Any = SimpleNamespace(diameter=1.0)
    return float(least_thrust(case, work, ball))


def least(scene: qs.Scene) -> float:
    """Of the whole bearing [N]."""
    case = CaseMaker(scene).make()[0]
    return float(least_of(case) * case.ball_count * case.force)


def thrust(axial: Any, rpm: float = 10e3, bearing: qs.BallBearing = B218, effects: Any = BOTH, **more: Any) -> qs.Scene:
    return turning(rpm, bearing, effects=effects, **{"control": INNER, **more}, axial_load=axial)


def rigid_least(bearing: qs.BallBearing, omega: float) -> float:
    """With all friction on the inner raceway and no approach, from the forces on a ball without inner load: its
    centrifugal force along the outer raceway is as large as the inner friction's part there."""
    numbers = bearing.ball_diameter, bearing.pitch_diameter, bearing.free_contact_angle
    d, dm, alpha = (float(np.asarray(each)) for each in numbers)
    inner, outer = (
        float(np.asarray(radius)) - d / 2.0 for radius in (bearing.inner_groove_radius, bearing.outer_groove_radius)
    )
    mass, g = float(np.asarray(bearing.ball_material.density)) * np.pi * d**3 / 6.0, d / dm

    def forces(ao: float) -> tuple[float, float, float]:
        ai = acos(((inner + outer) * cos(alpha) - outer * cos(ao)) / inner)
        orbit = omega * (cos(ai - ao) - g * cos(ao)) / (1.0 + cos(ai - ao))
        rotation = omega * (1.0 + g * cos(ao)) * sin(ai) / (g * (1.0 + cos(ai - ao)))  # omega_R sin(beta)
        return ai, 0.5 * mass * dm * orbit**2, 2.0 * mass * d / 10.0 * rotation * orbit

    def along_outer(ao: float) -> float:
        ai, fc, friction = forces(ao)
        return fc * sin(ao) - friction * cos(ai - ao)

    ai, _, friction = forces(brentq(along_outer, 0.0, alpha * (1.0 - 1e-12), xtol=1e-14))
    return float(np.asarray(bearing.ball_count)) * friction * cos(ai)


@pytest.mark.parametrize("bearing", [B218, SPINDLE], ids=["B218", "spindle"])
def test_slow_bearings_have_that_of_rigid_contacts(bearing: qs.BallBearing) -> None:
    """Approaches are as omega^(4/3): at a tenth of the speed the difference is 1/21.5 of what it was."""
    differences = []
    for rpm in (1000.0, 100.0, 10.0):
        rigid = rigid_least(bearing, rpm * qs.rpm)
        differences.append(least(thrust(1.0, rpm, bearing)) / rigid - 1.0)
    assert abs(differences[-1]) < 1e-4
    for fast, slow in pairwise(differences):
        assert fast / slow == pytest.approx(10.0 ** (4.0 / 3.0), rel=0.05)


@pytest.mark.parametrize("effects", SHARES.values(), ids=SHARES)
@pytest.mark.parametrize("bearing", BEARINGS.values(), ids=BEARINGS)
def test_just_above_it_there_is_an_equilibrium_of_friction_and_below_it_none(
    bearing: qs.BallBearing, effects: Any
) -> None:
    limit = least(thrust(1.0, 10e3, bearing, effects))
    assert limit > 0.0
    above = qs.solve(thrust(1.001 * limit, 10e3, bearing, effects))
    assert above.converged
    asked = [np.asarray(side.required_friction)[0] for side in (above.inner, above.outer)]
    assert max(asked) > 30.0
    below = qs.solve(thrust(0.999 * limit, 10e3, bearing, effects))
    assert below.status is qs.Status.NO_EQUILIBRIUM
    assert below.reason == qs.Reason.FRICTION_WITHOUT_LOAD
    assert below.iterations < OF_FALLBACK
    assert np.isnan(below.displacement).all()
    assert "the ball slips" in qs.message(below)


def test_at_forty_degrees_half_of_the_friction_on_each_raceway_unloads_the_outer_contact() -> None:
    scene = thrust(1.0, 10e3, B218, BOTH_HARRIS)
    solution = qs.solve(thrust(1.001 * least(scene), 10e3, B218, BOTH_HARRIS))
    assert solution.outer.load[0] < 0.05 * solution.inner.load[0]


UNKNOWN: dict[str, dict[str, Any]] = {
    "another control": {"control": OUTER},
    "no gyroscopic moment": {"effects": (qs.CentrifugalForce(),)},
    "no centrifugal force": {"effects": (qs.GyroscopicMoment(),)},
    "bounded friction": {"effects": (qs.CentrifugalForce(), qs.GyroscopicMoment(friction_coefficient=0.07))},
    "both rings turn": {"outer_rpm": 9e3},
}


@pytest.mark.parametrize("change", UNKNOWN.values(), ids=UNKNOWN)
def test_other_cases_are_solved_below_it(change: dict[str, Any]) -> None:
    limit = least(thrust(1.0))
    solution = qs.solve(thrust(0.5 * limit, **change))
    assert solution.converged
    assert solution.iterations > 0


def test_no_thrust_is_no_light_thrust() -> None:
    """Balls on the outer raceway alone; a thrust of rounding's size is none."""
    for axial in (0.0, 1e-13 * least(thrust(1.0))):
        assert qs.solve(thrust(axial)).converged


def test_a_deep_groove_bearing_carries_as_little_either_way() -> None:
    limit = least(thrust(1.0, 10e3, DEEP_GROOVE))
    for sign in (-1.0, 1.0):
        assert qs.solve(thrust(sign * 1.01 * limit, 10e3, DEEP_GROOVE)).converged
        assert qs.solve(thrust(sign * 0.99 * limit, 10e3, DEEP_GROOVE)).iterations < OF_FALLBACK


def test_a_start_does_not_change_it() -> None:
    limit = least(thrust(1.0))
    start = qs.solve(thrust(2.0 * limit))
    below = qs.solve(thrust(0.9 * limit), start=start)
    assert below.reason == qs.Reason.FRICTION_WITHOUT_LOAD
    assert below.iterations < OF_FALLBACK


# Over random scenes ---------------------------------------------------------------------------------------------------


def random_thrust(seed: int, count: int, shares: str, kind: qs.BearingKind, angle: str) -> qs.Scene:
    """Bearings of the realistic envelope, and thrust from a hundredth of a light preload to the static rating."""
    rng = np.random.default_rng([seed, len(shares)])
    drawn, _ = draw_bearing(rng, count)
    names = ("ball_count", "ball_diameter_mm", "pitch_diameter_mm", "inner_groove_radius_mm", "outer_groove_radius_mm")
    balls, diameter, pitch, inner, outer = (drawn[name] for name in names)
    alpha = np.radians(drawn["free_contact_angle_deg"])
    if kind is qs.BearingKind.DEEP_GROOVE:
        alpha = rng.uniform(0.0, 0.4, count)
    bearing = qs.BallBearing(
        balls.astype(int), diameter * qs.mm, pitch * qs.mm, inner * qs.mm, outer * qs.mm, alpha, kind=kind
    )
    rpm = np.where(rng.random(count) < 0.6, rng.uniform(0.0, 1.0, count), 10.0 ** rng.uniform(-3.4, 0.0, count))
    load = AXIAL_RATING * balls * diameter**2 * np.sin(alpha + 0.1) * 10.0 ** rng.uniform(-5.0, 0.0, count)
    return turning(
        rpm * SPEED_PARAMETER / pitch,
        bearing,
        effects=SHARES[shares],
        control=INNER,
        hertz_angle=angle,
        axial_load=load,
    )


def searched(scene: qs.Scene) -> tuple[NDArray, NDArray, NDArray]:
    """(status, notes, the fallback's status) of each case; the fallback knows nothing of the least thrust."""
    maker = CaseMaker(scene)
    cases, shape = maker.make(0, maker.count), (maker.count, maker.ball_axis)
    given = cases, *working_memory(maker.ball_axis), maker.own_balls(cases), 1e-12
    found = np.zeros(maker.count, RESULT), np.zeros((*shape, maker.position_size)), np.zeros(shape, np.int8)
    solve_cases(*given, BUDGET, False, *found)
    status, notes = found[0]["status"].copy(), found[0]["notes"].copy()
    solve_unfinished(np.flatnonzero(status != CONVERGED), *given, BUDGET, False, *found)
    return status, notes, found[0]["status"]


def assert_exact(scene: qs.Scene, most_missed: int) -> int:
    """What is refused has no equilibrium by the full search either, and of the others all but `most_missed` have one;
    how many were refused."""
    status, notes, of_search = searched(scene)
    refused = status == NO_EQUILIBRIUM
    assert (notes[refused] == FRICTION_WITHOUT_LOAD).all()
    assert (of_search[refused] == NO_EQUILIBRIUM).all()
    assert (status[~refused & (status != CONVERGED)] == UNFINISHED).all()
    missed = ~refused & (of_search != CONVERGED)
    assert missed.sum() <= most_missed
    return int(refused.sum())


KINDS = qs.BearingKind.ANGULAR_CONTACT, qs.BearingKind.DEEP_GROOVE


@pytest.mark.skipif(not has_fast_code(), reason="thousands of iterations of plain Python")
@pytest.mark.parametrize("angle", ["free", "actual"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("shares", SHARES)
def test_the_full_search_agrees(shares: str, kind: qs.BearingKind, angle: str) -> None:
    assert assert_exact(random_thrust(1, 150, shares, kind, angle), 1) > 20


@pytest.mark.heavy
@pytest.mark.skipif(not has_fast_code(), reason="thousands of iterations of plain Python")
@pytest.mark.parametrize("angle", ["free", "actual"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("shares", SHARES)
def test_the_full_search_agrees_over_many_scenes(shares: str, kind: qs.BearingKind, angle: str) -> None:
    """States apart from the others, which Harris's shares give some bearings, leave a few to the search."""
    assert assert_exact(random_thrust(2, 3000, shares, kind, angle), 6) > 500


def wild_scene(chunk: int, number: int, index: int, factor: float) -> qs.Scene:
    """A bearing of the wild campaign under inner control, turning alone, its thrust `factor` times what the ends of its
    contacts say is least."""
    group = chunk_groups(1, chunk)[number].part([index])
    given = group.scene()
    free = [channel for channel in CHANNELS[1:] if getattr(given.operation, channel.displacement) is None]
    held = [channel for channel in CHANNELS[1:] if channel not in free]
    none = {channel.load: 0.0 for channel in free} | {channel.displacement: 0.0 for channel in held}
    operation = replace(given.operation, outer_speed=0.0, axial_load=1.0, **none)
    limit = least(replace(given, operation=operation))
    return replace(given, operation=replace(operation, axial_load=factor * limit))


@pytest.mark.skipif(not has_fast_code(), reason="thousands of iterations of plain Python")
@pytest.mark.parametrize(
    ("chunk", "number", "index", "factor"),
    [(20, 5, 10, 0.7), (110, 17, 11, 0.9), (90, 16, 3, 0.5), (7, 16, 15, 0.999), (8, 1, 2, 0.9998)],
    ids=["wide outer groove", "tight grooves", "half of the thrust", "soft balls", "tight and soft"],
)
def test_unusual_bearings_have_equilibria_below_it(chunk: int, number: int, index: int, factor: float) -> None:
    """The search comes first: what it finds stands, whatever the ends of contacts say."""
    solution = qs.solve(wild_scene(chunk, number, index, factor))
    assert solution.converged.all()
    assert not any(bad.any() for bad in findings(solution.scene, solution).failed().values())


@pytest.mark.skipif(not has_fast_code(), reason="thousands of iterations of plain Python")
@pytest.mark.parametrize("shares", SHARES)
def test_close_to_it_nothing_is_refused_that_is_solved(shares: str) -> None:
    """Where the contact that ends comes to bear, the thrust may fall a little at first: within MARGIN."""
    scene = random_thrust(3, 150, shares, qs.BearingKind.ANGULAR_CONTACT, "free")
    maker = CaseMaker(scene)
    cases = maker.make(0, maker.count)
    limits = np.array([least_of(case) for case in cases])
    assert (limits > 0.0).all()
    assert (limits <= [thrust_bound(case) for case in cases]).all()
    near = limits * (1.0 + 3.0 * MARGIN * np.random.default_rng(4).uniform(-1.0, 1.0, limits.size))
    load = near * cases["ball_count"] * cases["force"]
    status, _, of_search = searched(replace(scene, operation=replace(scene.operation, axial_load=load)))
    refused = status == NO_EQUILIBRIUM
    assert refused.sum() > 20
    assert (of_search[refused] == NO_EQUILIBRIUM).all()
    assert (of_search[near > 1.00001 * limits] == CONVERGED).mean() > 0.98
