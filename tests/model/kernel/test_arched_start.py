"""Balls between four arcs under frozen loads: one least energy from any start; and the motion that rolls best there."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from qsbearing.model.effects.traction import Traction
from qsbearing.model.kernel import arched_start, traction_balance, traction_ball
from qsbearing.model.kernel.traction_ball import FX, FZ, GROOVE, MOVED_BALL, ORBIT, WX, WZ, X1
from qsbearing.model.kernel.traction_ring import MOTION
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.friction_motion import laws_of
from tests.qsbearing.scenes import UPRIGHT, rubbing

STARTS = 5


class Arched:
    """A bearing's ring and balls before they are placed."""

    def __init__(self, rpm: float, **operation: Any) -> None:
        maker = CaseMaker(rubbing(rpm, **operation))
        cases = maker.make()
        self.case, self.law = cases[0], laws_of(cases, Traction())[0]
        self.grooves, self.motion = np.zeros(4, GROOVE), np.zeros(1, MOTION)[0]
        self.balls = np.zeros(maker.ball_axis, MOVED_BALL)
        self.arrays = np.zeros((1, 3)), np.zeros((8, 8)), np.zeros(8), np.zeros(maker.ball_axis)
        traction_balance.set_grooves(self.case, self.law, maker.shims()[0], self.grooves)
        result = type("Result", (), {"displacement": np.zeros(5)})
        traction_balance.set_ring(self.case, self.motion, result, False)
        for j in range(self.motion.ball_count):
            traction_balance.put_at_azimuth(self.case, self.balls[j], j)
        arched_start.set_frozen_orbits(self.case, self.motion, self.balls)

    def settle(self) -> bool:
        return arched_start.settle(self.case, self.grooves, self.arrays, self.motion, self.balls)

    def press(self, place: NDArray) -> float:
        """Pi of the ring's channels and the balls' places."""
        count = self.motion.channel_count
        for c in range(count):
            self.motion.displacement[self.motion.channel[c]] = place[c]
        for j in range(self.motion.ball_count):
            self.balls[j].unknown[X1 : X1 + 2] = place[count + 2 * j : count + 2 * j + 2]
        return arched_start.press(self.case, self.grooves, self.motion, self.balls, 0.0)


@pytest.mark.parametrize(
    ("rpm", "operation"),
    [(0.0, {"axial_load": 5e3}), (1e4, {"axial_load": 5e3}), (1e4, {"axial_load": 500.0}), (1e4, {"axial_load": -3e3})],
)
def test_balls_lie_in_one_place_wherever_they_begin(rpm: float, operation: dict[str, float]) -> None:
    rng, found = np.random.default_rng(7), []
    for _ in range(STARTS):
        of = Arched(rpm, **operation)
        of.motion.displacement[0] = rng.uniform(-6e-3, 1e-3)
        of.balls[0].unknown[X1 : X1 + 2] = rng.uniform(-3e-3, 3e-3, 2)
        assert of.settle()
        found.append([of.motion.displacement[0], *of.balls[0].unknown[X1 : X1 + 2]])
    np.testing.assert_allclose(found, np.broadcast_to(found[0], (STARTS, 3)), atol=1e-13)


def test_forces_are_the_slopes_of_the_energy_and_it_is_convex() -> None:
    """By differences, at places where two, three and four arcs carry; midpoints lie below the mean of both ends."""
    of, rng = Arched(1e4, axial_load=2e3), np.random.default_rng(3)
    below = 0
    for _ in range(60):
        ends = [np.array([-2.7e-3, -1.4e-3, 0.0]) + rng.uniform(-3e-3, 3e-3, 3) for _ in range(2)]
        mean, middle = np.mean([of.press(each) for each in ends]), of.press(np.mean(ends, axis=0))
        assert middle <= mean + 1e-18
        below += middle < mean
        of.press(ends[0])
        ball = of.balls[0]
        forces = np.array([16.0 * ball.residual[FX], 16.0 * ball.residual[FZ]])
        step = 1e-8
        slopes = []
        for k in (1, 2):
            moved = np.eye(3)[k] * step
            slopes.append((of.press(ends[0] + moved) - of.press(ends[0] - moved)) / (2.0 * step))
        np.testing.assert_allclose(forces, np.negative(slopes), atol=1e-5 * np.abs(forces).max() + 1e-12)
    assert below == 60


def test_many_balls_settle_under_combined_load() -> None:
    of = Arched(0.0, axial_load=2e3, radial_load_y=5e3, **UPRIGHT)
    assert of.settle()
    total = [0.0, 0.0]
    for j in range(16):
        total[0] += of.balls[j].ring_force[0]
        total[1] += of.balls[j].ring_force[1] * of.balls[j].cosine
    np.testing.assert_allclose(total, -of.case.prescribed[:2], rtol=1e-9)


def test_it_rolls_with_least_weighted_slip() -> None:
    """Against a search over all motions of the sum that the linear law dissipates."""
    of = Arched(1e4, axial_load=5e3)
    assert of.settle() and arched_start.set_rolling(of.case, of.grooves, of.arrays, of.motion, of.balls)
    ball, ring = of.balls[0], (float(of.motion.displacement[0]), 0.0)
    half = 0.5 * of.case.pitch_diameter

    def dissipated(w: NDArray) -> float:
        total = 0.0
        for groove in of.grooves:
            approach, n1, n2, _ = traction_ball.line_to(groove, *map(float, ball.unknown[:2]), *ring)
            if approach > 0.0:
                load = groove.stiffness * approach**1.5
                size = (groove.semi_major**2 + groove.semi_minor**2) * load ** (2.0 / 3.0)
                turn = groove.speed - w[2]
                along = turn * half - 0.5 * ((w[0] - turn) * n2 - w[1] * n1)
                total += load * (along**2 + 0.2 * size * ((w[0] - turn) * n1 + w[1] * n2) ** 2)
        return total

    found = np.array([ball.unknown[WX], ball.unknown[WZ], ball.unknown[ORBIT]])
    least = dissipated(found)
    for k in range(3):
        for sign in (1.0, -1.0):
            moved = found + sign * 1e-4 * abs(found).max() * np.eye(3)[k]
            assert dissipated(moved) > least
