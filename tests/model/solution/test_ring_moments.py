"""Moments on the ring of balls that friction moves: by cross products in space, at rest, against the outer ring's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import FrictionMotion, friction_motion
from tests.model.solution.test_friction_motion import B218, SMALL, THRUST, scene
from tests.qsbearing.scenes import UPRIGHT

E_X = np.array([1.0, 0.0, 0.0])


def of_ring(found: FrictionMotion, side: str) -> NDArray:
    """Of the balls on a ring about the middle of the inner groove centres, by r x F and moments of each ball."""
    bearing, inner, of = found.start.scene.bearing, found.inner, getattr(found, side)
    sign = -1.0 if side == "inner" else 1.0
    length = bearing.inner_groove_radius - 0.5 * bearing.ball_diameter + inner.approach
    total = np.zeros(3)
    for j, psi in enumerate(2.0 * np.pi * np.arange(found.weight.size) / found.weight.size):
        outward = np.array([0.0, np.cos(psi), np.sin(psi)])
        against = np.cross(outward, E_X)
        to_inner = -np.sin(inner.angle[j]) * E_X - np.cos(inner.angle[j]) * outward
        place = bearing.inner_groove_centre_radius * outward + length[j] * to_inner
        normal = sign * (np.sin(of.angle[j]) * E_X + np.cos(of.angle[j]) * outward)
        across = np.cross(against, normal)
        force = -of.load[j] * normal + of.traction[j] * across + of.sideways[j] * against
        moment = of.spin_moment[j] * normal + of.roll_moment[j] * across + of.turn_moment[j] * against
        total -= found.weight[j] * (np.cross(place, force) + moment)
    return total


CASES = {
    "heavy": scene(B218, 17.8e3, 10_000, 3e3),
    "light": scene(B218, 8e3, 10_000, 4e3),
    "small": scene(SMALL, 600, 18_000, 300),
    "across": qs.Scene(B218, qs.Operation(speed=-6e3 * qs.rpm, axial_load=17.8e3, radial_load_z=-8e3, **UPRIGHT)),
}


@pytest.mark.parametrize("name", CASES)
def test_moments_are_those_of_forces_in_space(name: str) -> None:
    found = friction_motion(CASES[name], Traction())
    moments = of_ring(found, "inner")[1:]
    np.testing.assert_allclose(found.load[3:], -moments, rtol=1e-9, atol=1e-9 * np.abs(moments).max())
    # Balls gain no angular momentum on their way round: the outer ring takes what the inner one has. Left out are the
    # places of balls off the pitch circle, and their axial inertia, which the centrifugal force at those places needs.
    off = np.abs(found.displacement[:3]).max() / (0.5 * CASES[name].bearing.pitch_diameter)
    axial = found.inside.places[0, :, 0] * found.inside.cases["length"][0]
    left_out = (found.centrifugal_force * np.abs(axial - axial.mean())).sum()
    largest = np.abs(moments).max()
    assert left_out < 5e-3 * largest
    np.testing.assert_allclose(of_ring(found, "outer")[1:], -moments, atol=2.0 * off * largest + left_out)


def test_slow_balls_have_the_static_moments() -> None:
    slow = friction_motion(scene(B218, 17.8e3, 1, 3e3), Traction(slip_speed=1e-3))
    static = qs.solve(scene(B218, 17.8e3, 0, 3e3))
    np.testing.assert_allclose(slow.load[3:], static.load[3:], rtol=1e-5, atol=2e-3 * abs(static.load[4]))


def test_a_solution_has_them_and_free_tilts_have_none() -> None:
    of = replace(
        CASES["heavy"], raceway_control="friction", ball_effects=(qs.CentrifugalForce(), qs.GyroscopicMoment())
    )
    solution = qs.solve(of)
    np.testing.assert_allclose(solution.load[3:], friction_motion(CASES["heavy"], Traction()).load[3:], rtol=1e-9)
    assert np.isfinite(solution.load).all() and abs(solution.load[4]) > 100.0
    assert np.isnan(solution.stiffness[3:]).all() and np.isnan(solution.stiffness[:, 3:]).all()
    assert (friction_motion(THRUST, Traction()).load[3:] == 0.0).all()
    held = replace(THRUST, operation=replace(THRUST.operation, **UPRIGHT))
    thrust = friction_motion(held, Traction())
    np.testing.assert_allclose(thrust.load[3:], 0.0, atol=1e-9 * 17.8e3 * 0.06)
