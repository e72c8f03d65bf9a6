"""Between rings that turn against each other no ball without load stands still where inertia would carry it round."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import qsbearing as qs
from qsbearing.model.effects.raceway_control import HYPOTHESES, RacewayControl

EFFECTS = {
    "force": (qs.CentrifugalForce(),),
    "force and moment": (qs.CentrifugalForce(), qs.GyroscopicMoment()),
}
LEAST = 1e-3
"""Of the orbital speed at the groove's bottom: what stands has less (measured: 1e-5 and below), what goes round has
tenths."""


def random_scene(seed: int, count: int) -> qs.Scene:
    """Light loads, and speeds at which balls of some contact angle between 20 and 60 degrees stand."""
    rng = np.random.default_rng(seed)
    ball = rng.uniform(3.0, 12.0, count) * qs.mm
    pitch, angle = ball * rng.uniform(5.0, 13.0, count), rng.uniform(15.0, 45.0, count) * qs.deg
    grooves = [rng.uniform(0.51, 0.56, count) * ball for _ in range(2)]
    bearing = qs.BallBearing(13, ball, pitch, *grooves, angle)
    inner = rng.uniform(500.0, 4000.0, count) * qs.rpm
    standing = ball / pitch * np.cos(rng.uniform(20.0, 60.0, count) * qs.deg)
    outer = -inner * (1.0 - standing) / (1.0 + standing)
    thrust, turned = rng.uniform(0.2, 2.0, count), rng.uniform(0.0, 2.0 * np.pi, count)
    side = rng.uniform(0.5, 1.5, count) * thrust
    loads = {"axial_load": thrust, "radial_load_y": side * np.cos(turned), "radial_load_z": side * np.sin(turned)}
    return qs.Scene(bearing, qs.Operation(inner, outer, tilt_y=0.0, tilt_z=0.0, **loads))


def standing_balls(solution: qs.Solution) -> np.ndarray:
    """Which converged cases have a ball off the inner raceway that stands; shape (*cases)."""
    bearing, operation = solution.scene.bearing, solution.scene.operation
    ratio = np.asarray(bearing.ball_diameter) / np.asarray(bearing.pitch_diameter)
    at_bottom = 0.5 * ((1.0 - ratio) * operation.speed + (1.0 + ratio) * operation.outer_speed)
    stands = np.abs(solution.orbital_speed) < LEAST * np.abs(at_bottom)[..., None]
    return np.asarray((stands & (solution.inner.load == 0.0)).any(axis=-1) & solution.converged)


@pytest.mark.parametrize("control", HYPOTHESES)
@pytest.mark.parametrize("effects", EFFECTS)
def test_no_ball_without_load_stands(effects: str, control: RacewayControl) -> None:
    scene = replace(random_scene(7, 200), ball_effects=EFFECTS[effects], raceway_control=control)
    solution = qs.solve(scene)
    assert np.mean(solution.converged) > 0.3, "or there is little to judge"
    assert not standing_balls(solution).any()
