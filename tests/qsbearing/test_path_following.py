"""Paths through turning points: their start, their direction, and scenes whose balance only they reach."""

from __future__ import annotations

import numpy as np
import pytest
from numpy import ndarray
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.compiled import COMPILED, entry
from qsbearing.dead_forces import hold
from qsbearing.linear import solve_in_place
from qsbearing.newton import close_chains
from qsbearing.path_following import START, press, two_steps
from qsbearing.solver import prepare

from .mechanics import ring_load, vectors
from .one_case import one_case
from .scenes import BOTH, BOTH_HARRIS, INNER, OUTER, PER_BALL, lever, turning

BALANCED = 1e-10
"""Of the largest load: what counts as solved where rounding forbids better; these loads are light."""


def fast_balls() -> qs.Scene:
    """Eight soft balls, loads a thousandth of a newton, a shaft at 230 000 rpm."""
    bearing = qs.BallBearing(
        ball_count=8,
        ball_diameter=6.693 * qs.mm,
        pitch_diameter=18.42 * qs.mm,
        inner_groove_radius=3.554 * qs.mm,
        outer_groove_radius=3.554 * qs.mm,
        free_contact_angle=16.69 * qs.deg,
        ball_material=qs.Material(7.687e9, 0.1444, 1.616e4),
    )
    operation = qs.Operation(
        speed=-2.299e5 * qs.rpm,
        axial_load=0.0006983,
        radial_load_y=-0.001688,
        radial_displacement_z=0.0007639e-6,
        tilt_y=-1.402e-9,
        tilt_z=5.799e-9,
        first_ball_azimuth=-56.8 * qs.deg,
    )
    return qs.Scene(
        bearing, operation, BOTH_HARRIS, OUTER, hertz_angle=qs.HertzAngle.ACTUAL, tilt_lever=qs.TiltLever.GROOVE_CENTRE
    )


def held_aside() -> qs.Scene:
    """A deep groove all but one of whose channels are held, by a hundredth of a micrometre."""
    bearing = qs.BallBearing(
        ball_count=15,
        ball_diameter=4.766 * qs.mm,
        pitch_diameter=26.76 * qs.mm,
        inner_groove_radius=2.41 * qs.mm,
        outer_groove_radius=2.567 * qs.mm,
        free_contact_angle=2.448 * qs.deg,
        kind=qs.BearingKind.DEEP_GROOVE,
        ball_material=qs.Material(10.91e9, 0.02821, 1.805e4),
    )
    operation = qs.Operation(
        speed=6.65e4 * qs.rpm,
        axial_displacement=0.01026e-6,
        radial_displacement_y=0.001422e-6,
        radial_load_z=-0.004197,
        tilt_y=-0.0001731e-3,
        tilt_z=0.0003218e-3,
    )
    return qs.Scene(bearing, operation, BOTH_HARRIS, OUTER, tilt_lever=qs.TiltLever.GROOVE_CENTRE)


def pulled_down() -> qs.Scene:
    """Most balls unloaded by a radial load of 23 kN, the outer ring turning, each ball its own control."""
    bearing = qs.BallBearing(
        ball_count=19,
        ball_diameter=3.543 * qs.mm,
        pitch_diameter=27.23 * qs.mm,
        inner_groove_radius=1.957 * qs.mm,
        outer_groove_radius=1.917 * qs.mm,
        free_contact_angle=26.35 * qs.deg,
    )
    operation = qs.Operation(
        speed=0.0,
        outer_speed=7801.0 * qs.rpm,
        axial_displacement=2.676e-6,
        radial_load_y=-1.48e4,
        radial_load_z=-1.716e4,
        tilt_y=-0.1009e-3,
        moment_z=0.5888,
    )
    return qs.Scene(bearing, operation, BOTH_HARRIS, PER_BALL, tilt_lever=qs.TiltLever.GROOVE_CENTRE)


def light_at_speed() -> qs.Scene:
    """Six balls thrown by centrifugal force alone, a ring that hardly any load holds."""
    bearing = qs.BallBearing(
        ball_count=6,
        ball_diameter=20.92 * qs.mm,
        pitch_diameter=50.54 * qs.mm,
        inner_groove_radius=10.49 * qs.mm,
        outer_groove_radius=10.49 * qs.mm,
        free_contact_angle=6.418 * qs.deg,
        kind=qs.BearingKind.DEEP_GROOVE,
    )
    operation = qs.Operation(
        speed=9.248e4 * qs.rpm,
        axial_displacement=0.0003868e-6,
        radial_displacement_y=0.0004281e-6,
        radial_load_z=-0.0004358,
        moment_y=-8.972e-6,
        tilt_z=7.157e-9,
    )
    return qs.Scene(bearing, operation, (qs.CentrifugalForce(),), OUTER, tilt_lever=qs.TiltLever.GROOVE_CENTRE)


def rings_against_each_other() -> qs.Scene:
    """Light balls between rings that turn against each other: a ball's centre passes the inner groove's own."""
    bearing = qs.BallBearing(
        ball_count=25,
        ball_diameter=1.886 * qs.mm,
        pitch_diameter=15.65 * qs.mm,
        inner_groove_radius=0.9569 * qs.mm,
        outer_groove_radius=1.027 * qs.mm,
        free_contact_angle=36.76 * qs.deg,
        ball_material=qs.Material(79.57e9, 0.1053, 2934.0),
        ring_material=qs.Material(253.1e9, 0.05327, 1.693e4),
    )
    operation = qs.Operation(
        speed=31030.0 * qs.rpm,
        outer_speed=-23730.0 * qs.rpm,
        axial_load=0.0,
        radial_load_y=-0.0007574,
        radial_load_z=-1.613e-05,
        moment_y=0.0,
        moment_z=0.0,
    )
    return qs.Scene(
        bearing, operation, BOTH_HARRIS, INNER, hertz_angle=qs.HertzAngle.ACTUAL, tilt_lever=qs.TiltLever.GROOVE_CENTRE
    )


BEHIND_TURNING_POINTS = {
    "fast": fast_balls(),
    "held": held_aside(),
    "pulled": pulled_down(),
    "light": light_at_speed(),
    "against": rings_against_each_other(),
}


LONG = {"against"}
"""Whose many starts take plain Python a quarter of an hour."""


@pytest.mark.parametrize("name", [name for name in BEHIND_TURNING_POINTS if COMPILED or name not in LONG])
def test_a_balance_behind_a_turning_point_is_found(name: str) -> None:
    """Balances come to an end on the way up in speed, and relaxation finds no rest."""
    scene = BEHIND_TURNING_POINTS[name]
    solution = qs.solve(scene)
    assert solution.converged
    assert solution.residual <= 1e-10
    assert (solution.inner.load >= 0.0).all()
    assert (solution.outer.load >= 0.0).all()
    radius = lever(scene)
    unit = np.array([1.0, 1.0, 1.0, radius, radius]) * max(solution.inner.load.max(), solution.outer.load.max())
    assert ring_load(solution) / unit == pytest.approx(solution.load / unit, abs=BALANCED)
    v = vectors(solution)
    assert solution.centrifugal_force is not None
    left = v.inner_pull + v.outer_pull + solution.centrifugal_force[:, None] * v.radial
    assert np.abs(left).max() <= BALANCED * unit[0]


@entry
def start_of_path(
    cases: ndarray,
    rings: ndarray,
    balls: ndarray,
    displacement: ndarray,
    position: ndarray,
    control: ndarray,
    part: float,
    first: ndarray,
    rate: ndarray,
    found: ndarray,
) -> None:
    """Newton's step at this part from where a path starts, and what a whole of the part would move there."""
    case, ring = cases[0], rings[0]
    prepare(case, ring, balls, False, displacement, position, control)
    press(case, ring, balls)
    close_chains(case, ring, balls)
    force = hold(case, ring, balls)
    found[0], found[1], found[2] = two_steps(case, ring, balls, part, case.inner_speed, case.outer_speed, force)
    for i in range(5):
        first[i], rate[i] = ring.first[i], ring.step[i]
    for n in range(ring.balls):
        first[5 + n], rate[5 + n] = balls[n].first[0], balls[n].du1


def steps_at(scene: qs.Scene, part: float) -> tuple[NDArray, NDArray, NDArray]:
    """(Newton's step, the rate, (residual, own residual, sign)) at this part, where the scene's path starts."""
    given = one_case(scene)
    count = given[2].size
    first, rate, found = np.zeros(5 + count), np.zeros(5 + count), np.zeros(3)
    start_of_path(
        *given,
        part,
        first,
        rate,
        found,
    )
    return first, rate, found


@pytest.mark.parametrize("control", [OUTER, INNER])
def test_a_path_starts_in_balance_and_in_the_direction_that_differences_say(control: qs.RacewayControl) -> None:
    """Dead forces balance the contacts; a little of the part on, the step to balance is the rate times that little."""
    scene = turning(6_000.0, effects=BOTH, control=control, axial_load=2000.0, radial_load_y=900.0, moment_z=0.0)
    _, rate, (residual, _, sign) = steps_at(scene, START)
    assert residual <= 1e-12
    assert sign == 1.0  # of the derivatives of a convex energy
    little = 1e-6
    first, _, _ = steps_at(scene, little)
    assert np.abs(rate).max() > 0.0
    # Newton's step is right to second order: its error is of the part of the rate that it moves over.
    np.testing.assert_allclose(first / little, rate, rtol=1e-3, atol=1e-5 * np.abs(rate).max())


@entry
def solve_small(matrix: ndarray, right_side: ndarray, size: int, sign: ndarray) -> None:
    """The kernel's own solution of a small system."""
    sign[0] = solve_in_place(matrix, right_side, size)


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5])
def test_the_sign_of_a_determinant(size: int) -> None:
    """Beside numpy's, rows exchanged or not; none where the system is singular."""
    random = np.random.default_rng(size)
    seen = set()
    for _ in range(40):
        matrix, right_side, sign = random.normal(size=(5, 5)), random.normal(size=5), np.zeros(1)
        expected = np.linalg.solve(matrix[:size, :size], right_side[:size])
        determinant = np.linalg.det(matrix[:size, :size])
        solve_small(matrix, right_side, size, sign)
        np.testing.assert_allclose(right_side[:size], expected, rtol=1e-9)
        assert sign[0] == np.sign(determinant)
        seen.add(sign[0])
    assert seen == {-1.0, 1.0}
    sign = np.ones(1)
    solve_small(np.zeros((5, 5)), np.ones(5), size, sign)
    assert sign[0] == 0.0
