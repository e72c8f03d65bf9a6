"""Stiffness with balls that friction moves: another program's numbers, differences of solutions, and its own limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import friction_motion
from qsbearing.model.solution.motion_stiffness import motion_rates, motion_stiffness, turning_stiffness
from tests.model.solution.test_friction_motion import (
    B218,
    LINEAR,
    MIDDLE,
    SMALL,
    SPEED,
    THRUST,
    bearing,
    scene,
)

N_UM = 1e6


def test_radial_loads_have_the_stiffness_of_another_program() -> None:
    cases = [
        (scene(B218, 17.8e3, 10_000, 3e3), Traction(), MIDDLE, (328.81, 233.29, 222.11), 6e-3),
        (scene(SMALL, 600, 18_000, 300), Traction(), MIDDLE, (33.241, 104.632, 99.097), 1e-3),
        (scene(B218, 17.8e3, 10_000, 3e3), LINEAR, {"radii": 2, "angles": 8}, (370.337, 239.619, 222.790), 1e-3),
    ]
    for of, traction, points, expected, digits in cases:
        found = motion_stiffness(friction_motion(of, traction, **points)) / N_UM
        np.testing.assert_allclose(np.diag(found), expected, atol=digits)
        if of is cases[0][0] and traction is not LINEAR:
            np.testing.assert_allclose((found[1, 2], found[2, 1]), (4.25, -3.91), atol=6e-3)


@pytest.mark.parametrize(("friction", "expected"), [(0.10, 307), (0.07, 336), (0.05, 341), (0.03, 327)])
def test_thrust_has_the_stiffness_of_another_program(friction: float, expected: float) -> None:
    found = motion_stiffness(friction_motion(THRUST, Traction(friction, 0.01), **MIDDLE))
    assert found[0, 0] / N_UM == pytest.approx(expected, abs=0.6)


@pytest.mark.parametrize("carried", [True, False])
def test_it_is_the_slope_of_the_loads(carried: bool) -> None:
    """By differences of held displacements, in every direction."""
    loaded = friction_motion(scene(B218, 17.8e3, 10_000, 3e3), Traction(), carried=carried)
    slopes = np.empty((3, 3))
    for k in range(3):
        forces = []
        for step in (-1e-8, 1e-8):
            x, y, z = loaded.displacement[:3] + step * np.eye(3)[k]
            held = {"axial_displacement": x, "radial_displacement_y": y, "radial_displacement_z": z}
            operation = qs.Operation(speed=SPEED, tilt_y=0.0, tilt_z=0.0, **held)
            forces.append(friction_motion(qs.Scene(B218, operation), Traction(), carried=carried).load[:3])
        slopes[:, k] = (forces[1] - forces[0]) / 2e-8
    found = motion_stiffness(loaded)
    np.testing.assert_allclose(found, slopes, rtol=1e-5, atol=1e-6 * found.max())


def test_a_static_load_turns_at_nothing() -> None:
    """The response at nu = 0 is the periodic balance's own; the force across it is along +z for +y."""
    found = friction_motion(THRUST, Traction())
    turning, static = turning_stiffness(found, 0.0), motion_stiffness(found)
    assert turning.radial[0] == pytest.approx(static[1, 1], rel=1e-9)
    assert turning.whirl[0] == pytest.approx(-static[2, 1], rel=1e-8)
    assert turning.axial[0] == pytest.approx(static[0, 0], rel=1e-9)
    still = motion_stiffness(friction_motion(THRUST, Traction(), carried=False))
    assert abs(still[1, 1] / static[1, 1] - 1.0) > 0.02


def test_a_spindle_bearing_over_the_frequency_of_its_load() -> None:
    of = bearing(20, 11.1125, 90.0, 0.53, 0.52, 25.0)
    speed = 18_000 * qs.rpm
    found = friction_motion(scene(of, 600, 18_000), Traction())
    turning = turning_stiffness(found, (0.0, found.orbital_speed[0], speed))
    np.testing.assert_allclose(turning.radial[[0, 2]] / N_UM, (32.2, 34.3), atol=0.06)
    np.testing.assert_allclose(turning.axial[[0, 2]] / N_UM, (32.4, 26.3), atol=0.06)
    assert np.isnan(turning.radial[1])
    with_cage = motion_stiffness(friction_motion(scene(of, 600, 18_000), Traction(), carried=False))
    assert with_cage[1, 1] / N_UM == pytest.approx(39.6, abs=0.06)


def test_what_has_no_equilibrium_has_no_stiffness() -> None:
    found = friction_motion(scene(B218, np.array([-5e3, 17.8e3]), 10_000), Traction())
    stiffness = motion_stiffness(found)
    assert stiffness.shape == (2, 3, 3)
    assert np.isnan(stiffness[0]).all()
    np.testing.assert_allclose(stiffness[1], motion_stiffness(friction_motion(THRUST, Traction())), rtol=1e-12)
    assert np.isnan(turning_stiffness(found, 0.0).axial[0, 0])


def test_unlike_balls_are_refused() -> None:
    loaded = friction_motion(scene(B218, 17.8e3, 10_000, 3e3), Traction())
    with pytest.raises(ValueError, match="thrust alone"):
        turning_stiffness(loaded, 0.0)


def test_held_and_loaded_alike() -> None:
    loaded = friction_motion(THRUST, Traction())
    held = replace(THRUST, operation=qs.Operation(speed=SPEED, axial_displacement=float(loaded.displacement[0])))
    np.testing.assert_allclose(
        motion_stiffness(friction_motion(held, Traction())), motion_stiffness(loaded), rtol=1e-9, atol=1.0
    )


def test_axes_are_slow_and_stable() -> None:
    """Slower than the orbit at 10,000 rpm, so that they do not follow an azimuth; faster at 3000."""
    for of, speed in ((THRUST, SPEED), (scene(SMALL, 600, 18_000), 18_000 * qs.rpm)):
        found = friction_motion(of, Traction())
        rates = motion_rates(found)
        assert rates.shape[-1] == 4
        assert rates.real.max() < 0.0
        assert 49.0 < -rates[0, 0].real < 317.0
        assert -rates[0, 0].real < found.orbital_speed[0] < 0.5 * speed
    slow = friction_motion(scene(B218, 17.8e3, 3000), Traction())
    assert -motion_rates(slow)[0, 0].real > slow.orbital_speed[0]
