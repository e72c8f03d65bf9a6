"""Balls that are carried round with their inertia: another program's numbers, momentum, energy and limits."""

from __future__ import annotations

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import FrictionMotion, friction_motion
from qsbearing.readings.ball_advance import _of_cases as advance_of
from tests.model.solution.test_friction_motion import (
    B218,
    LINEAR,
    MIDDLE,
    SMALL,
    SPEED,
    balanced,
    bearing,
    outward,
    scene,
)

QUARTERS = np.array([0, 4, 8, 12])


def carried(found: FrictionMotion, speed: float = SPEED) -> FrictionMotion:
    """After a check that both rings carry the same."""
    balanced(found, speed)
    load = found.load[:3]
    np.testing.assert_allclose(outward(found), -load, atol=1e-9 * np.abs(load).max())
    return found


def test_heavy_thrust_with_radial_load() -> None:
    found = carried(friction_motion(scene(B218, 17.8e3, 10_000, 3e3), Traction(), **MIDDLE))
    np.testing.assert_allclose(found.displacement[:3] * 1e6, (17.6892, 13.5025, 0.2461), atol=2e-4)
    np.testing.assert_allclose(found.inner.load[QUARTERS], (1974.96, 1385.49, 1026.73, 1397.21), atol=2e-2)
    np.testing.assert_allclose(np.degrees(found.attitude_angle[QUARTERS]), (31.265, 31.990, 31.464, 30.524), atol=1e-3)
    np.testing.assert_allclose(
        found.orbital_speed[QUARTERS] / SPEED, (0.441464, 0.444415, 0.450439, 0.448085), atol=3e-6
    )
    assert found.heat == pytest.approx(2719.4, abs=0.2)


def test_light_thrust_with_radial_load() -> None:
    found = carried(friction_motion(scene(B218, 8e3, 10_000, 4e3), Traction(), **MIDDLE))
    np.testing.assert_allclose(found.displacement[:3] * 1e6, (-78.582, 85.605, 4.113), atol=6e-4)
    np.testing.assert_allclose(found.inner.load[QUARTERS], (1721.1, 437.96, 257.66, 455.59), rtol=1e-4)
    np.testing.assert_allclose(
        found.orbital_speed[QUARTERS] / SPEED, (0.459509, 0.485689, 0.509677, 0.524514), atol=3e-6
    )
    assert found.heat == pytest.approx(3951, abs=1)


def test_a_spindle_bearing() -> None:
    of = bearing(20, 11.1125, 90.0, 0.53, 0.52, 15.0)
    found = carried(friction_motion(scene(of, 600, 18_000, 300), Traction(), **MIDDLE), 18_000 * qs.rpm)
    quarters = np.array([0, 5, 10, 15])
    np.testing.assert_allclose(found.displacement[:3] * 1e6, (1.0050, 3.0268, -0.0447), atol=2e-4)
    np.testing.assert_allclose(np.degrees(found.attitude_angle[quarters]), (5.072, 5.407, 5.114, 4.767), atol=1e-3)
    np.testing.assert_allclose(
        found.orbital_speed[quarters] / (18_000 * qs.rpm), (0.449272, 0.450196, 0.452523, 0.451976), atol=2e-6
    )


def test_linear_friction() -> None:
    found = carried(friction_motion(scene(B218, 17.8e3, 10_000, 3e3), LINEAR, radii=2, angles=8))
    np.testing.assert_allclose(found.displacement[:3] * 1e6, (20.9107, 13.4656, 0.0046), atol=6e-5)
    np.testing.assert_allclose(found.inner.load[QUARTERS], (1986.576, 1361.889, 1020.159, 1361.873), atol=6e-4)
    np.testing.assert_allclose(
        np.degrees(found.attitude_angle[QUARTERS]), (40.2984, 39.9007, 39.1074, 39.7829), atol=6e-5
    )


def test_slow_balls_have_all_the_time_they_need() -> None:
    """The slower, the nearer their axes to the balance at each azimuth; the ring still feels some for longer."""
    gaps = []
    for revolutions in (1500, 750, 375):
        slow = scene(B218, 17.8e3, revolutions, 8e3)
        round_it, still = (friction_motion(slow, Traction(), carried=each) for each in (True, False))
        carried(round_it, revolutions * qs.rpm)
        assert np.abs(round_it.displacement - still.displacement).max() < 25e-9
        gaps.append(np.abs(round_it.attitude_angle - still.attitude_angle).max())
    assert gaps[0] < 3e-3
    assert gaps[1] < 0.55 * gaps[0]
    assert gaps[2] < 0.55 * gaps[1]


@pytest.mark.parametrize(("axial", "radial", "expected"), [(17.8e3, 3e3, 1.4), (17.8e3, 8e3, 4.7), (8e3, 4e3, 8.05)])
def test_balls_run_ahead_and_behind_as_another_program_has_it(axial: float, radial: float, expected: float) -> None:
    """Their excursion [mm], from their orbits by the reading of ball advance."""
    found = friction_motion(scene(B218, axial, 10_000, radial), Traction())
    mean, lead, lag, _ = advance_of(found.orbital_speed[None], np.array([16]))
    assert (lead + lag)[0] * 0.5 * B218.pitch_diameter / qs.mm == pytest.approx(expected, abs=0.05)
    assert mean[0] == pytest.approx(float(found.cage_speed), rel=1e-9)


def test_balls_that_leave_the_inner_ring_go_round_with_the_others() -> None:
    """Balanced each at its azimuth they are stopped, or have no balance."""
    found = carried(friction_motion(scene(B218, 2e3, 10_000, 2e3), Traction()))
    assert found.inner.load.min() == 0.0
    assert found.orbital_speed.min() > 0.44 * SPEED
    assert found.orbital_speed.max() < 0.48 * SPEED


def test_under_thrust_one_ball_stands_for_all() -> None:
    """A radial load of nothing, in effect, has all balls solved, and gives the same."""
    one = friction_motion(scene(SMALL, 600, 18_000), Traction(0.05))
    all_of_them = carried(friction_motion(scene(SMALL, 600, 18_000, 1e-6), Traction(0.05)), 18_000 * qs.rpm)
    np.testing.assert_allclose(all_of_them.displacement[0], one.displacement[0], rtol=1e-8)
    np.testing.assert_allclose(all_of_them.inner.heat, one.inner.heat, rtol=1e-6)


def test_more_balls_at_as_many_azimuths_change_little() -> None:
    """N against 2 N azimuths: the same bearing in effect has twice the balls and twice the load."""
    twice = bearing(40, 11.1125, 220.0, 0.53, 0.52, 15.0)
    once = bearing(20, 11.1125, 220.0, 0.53, 0.52, 15.0)
    few, many = (friction_motion(scene(of, 600 * k, 8_000, 300 * k), Traction()) for of, k in ((once, 1), (twice, 2)))
    np.testing.assert_allclose(many.displacement[:3], few.displacement[:3], atol=2e-10)


def test_backwards_and_turned_round() -> None:
    """A mirror image in the plane of the load, and the same load along z."""
    forth, back = (friction_motion(scene(B218, 17.8e3, n, 3e3), Traction()) for n in (10_000, -10_000))
    np.testing.assert_allclose(back.displacement[:3], forth.displacement[:3] * (1.0, 1.0, -1.0), rtol=1e-7)
    np.testing.assert_allclose(back.inner.load[[0, 4, 12]], forth.inner.load[[0, 12, 4]], rtol=1e-8)
    operation = qs.Operation(speed=SPEED, axial_load=17.8e3, radial_load_z=3e3, tilt_y=0.0, tilt_z=0.0)
    upward = friction_motion(qs.Scene(B218, operation), Traction())
    np.testing.assert_allclose(upward.displacement[1:3], (-forth.displacement[2], forth.displacement[1]), rtol=1e-7)
