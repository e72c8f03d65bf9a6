"""The directions that the guide gives a ball's rotation: with them the ball rolls on both raceways without slip."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.raceway_control import HYPOTHESES
from tests.qsbearing.scenes import B218, UPRIGHT

AXIAL, OUTWARD = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
"""e_x and e_r of a ball; the third direction is that in which it goes round."""


def along(axial: NDArray, outward: NDArray) -> NDArray:
    return np.multiply.outer(axial, AXIAL) + np.multiply.outer(outward, OUTWARD)


@pytest.mark.parametrize("control", HYPOTHESES)
@pytest.mark.parametrize("speeds", [(9000.0, 0.0), (-9000.0, 0.0), (3000.0, -5000.0)])
def test_the_surfaces_of_ball_and_raceways_go_round_at_one_speed(
    control: qs.RacewayControl, speeds: tuple[float, float]
) -> None:
    inner, outer = (each * qs.rpm for each in speeds)
    load = qs.Operation(speed=inner, outer_speed=outer, axial_load=17.8e3, radial_load_y=3e3, **UPRIGHT)
    solution = qs.solve(qs.Scene(B218, load, ball_effects=(qs.CentrifugalForce(),), raceway_control=control))
    assert solution.converged and solution.attitude_angle is not None and solution.rotation_speed is not None
    turn, beta = solution.rotation_speed, solution.attitude_angle
    np.testing.assert_allclose(solution.axial_rotation, turn * np.cos(beta))
    np.testing.assert_allclose(solution.radial_rotation, turn * np.sin(beta))
    rotation = along(turn * np.cos(beta), -turn * np.sin(beta))
    for side, speed, sign in ((solution.inner, inner, -1.0), (solution.outer, outer, 1.0)):
        to_contact = 0.5 * B218.ball_diameter * sign * along(np.sin(side.angle), np.cos(side.angle))
        centre = along(np.zeros_like(side.angle), np.full_like(side.angle, 0.5 * B218.pitch_diameter))
        # Both seen by an observer who goes round with the ball.
        of_ball = np.cross(rotation, to_contact)
        of_raceway = np.cross(along(speed - solution.orbital_speed, np.zeros_like(side.angle)), centre + to_contact)
        size = np.abs(of_raceway[:, 2]).max()
        np.testing.assert_allclose(of_ball[:, 2], of_raceway[:, 2], atol=1e-12 * size)  # rounding
        mirrored = np.cross(along(turn * np.cos(beta), turn * np.sin(beta)), to_contact)
        assert np.abs(mirrored[:, 2] - of_raceway[:, 2]).min() > 0.01 * size, "or the test tells no direction"
