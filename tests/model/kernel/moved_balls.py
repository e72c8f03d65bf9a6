"""One ball that friction moves, in plain Python: its records, started from a solution under outer control."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.kernel import traction_balance, traction_ball
from qsbearing.model.kernel.traction_ball import FY, LAW, MX, MY, MZ, WX
from qsbearing.model.kernel.traction_ring import MOTION
from qsbearing.model.solution.friction_motion import laws_of
from qsbearing.model.solution.solved_cases import solved_of
from tests.qsbearing.scenes import BOTH, OUTER


def law_record(law: int, friction: float, slip: float) -> Any:
    record = np.zeros(1, LAW)[0]
    record.law, record.friction_coefficient, record.slip_speed = law, friction, slip
    return record


def outer_control(
    bearing: qs.BallBearing, axial_load: float, revolutions: float, displaced: bool = False
) -> qs.Solution:
    scene = qs.Scene(bearing, qs.Operation(speed=revolutions * qs.rpm, axial_load=axial_load), BOTH, OUTER)
    return qs.solve(replace(scene, orbit_radius="displaced") if displaced else scene)


class Ball:
    """The ball of a bearing under thrust."""

    def __init__(self, solution: qs.Solution, traction: Traction, points: NDArray) -> None:
        solved = solved_of(solution)
        cases = solved.maker.make()
        self.case, self.law, self.points = cases[0], laws_of(cases, traction)[0], points
        self.grooves = np.zeros(2, traction_ball.GROOVE)
        self.motion, self.balls = np.zeros(1, MOTION)[0], np.zeros(1, traction_ball.MOVED_BALL)
        self.record = self.balls[0]
        for groove, side in zip(self.grooves, (-1.0, 1.0), strict=True):
            traction_balance.set_groove(self.case, self.law, groove, side)
        traction_balance.set_ring(self.case, self.motion, solved.results[0], True)
        traction_balance.place_balls(self.case, self.motion, self.balls, solved.positions[0])
        self.start = np.array(self.record.unknown)
        self.ring = (float(self.motion.displacement[0]), 0.0)

    def add_opposite_grooves(self, gap: float) -> None:
        """An arc for angles of the other sign on each ring, so far away where the ball touches the others."""
        self.grooves = np.concatenate([self.grooves, self.grooves])
        self.grooves["sine"][2:] *= -1.0
        self.grooves["gap1"][2:] = -gap, gap

    def put(self, unknown: NDArray, rates: NDArray, ring: Any) -> None:
        """Evaluate the ball where it is put."""
        self.record.unknown[:], self.record.rate[2:] = unknown, rates
        traction_ball.moved_ball(self.case, self.law, self.grooves, self.points, self.record, *map(float, ring))

    def read(self) -> NDArray:
        """(groove, quantity) of its contacts where it is."""
        found = np.zeros((self.grooves.size, traction_ball.CONTACT_QUANTITIES))
        ring = float(self.motion.displacement[0]), 0.0
        for groove, out in zip(self.grooves, found, strict=True):
            traction_ball.read_groove(self.case, self.law, groove, self.points, self.record, *ring, out)
        return found

    def friction(self, motion: NDArray) -> tuple[float, NDArray, NDArray]:
        """(dissipation, gradient, Hessian) by (wx, wy, wz, omega_m), the ball's place being that of the start."""
        grooves, parts = self.grooves, []
        for self.grooves in (grooves[:0], grooves):  # the ball's inertia alone, then all
            self.put(np.concatenate([self.start[:2], motion]), np.zeros(4), self.ring)
            rows = np.column_stack([self.record.residual, np.array(self.record.matrix)[:, WX:]])
            torque = rows[MX] - traction_ball.orbit_of(self.case, self.record) * rows[FY]
            parts.append(-np.array([rows[MX], rows[MY], rows[MZ], torque]))
        found = parts[1] - parts[0]
        return self.read()[:, traction_ball.DISSIPATION].sum(), found[:, 0], found[:, 1:]

    def balance(self) -> bool:
        arrays = self.points, np.zeros((5, 5)), np.zeros(5), np.zeros(1)
        return traction_balance.balance(self.case, self.law, self.grooves, arrays, self.motion, self.balls)
