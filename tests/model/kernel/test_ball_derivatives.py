"""A ball's exact derivatives against differences, wherever it lies: they are what Newton's method lives on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy import ndarray, recarray
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.effects.gyroscopic_moment import NO_BOUND
from qsbearing.model.kernel.admissibility import LOAD_BOUND
from qsbearing.model.kernel.ball import moving_ball
from qsbearing.model.kernel.contact_line import direction
from qsbearing.model.kernel.loop_closure import inner_length, outer_length, set_inner_line, set_outer_line
from qsbearing.model.kernel.raceway_stiffness import set_spin_constants
from qsbearing.model.kernel.workspace import GIVEN, working_memory
from qsbearing.model.solution.flatten import CaseMaker
from tests.qsbearing.scenes import BOTH_HARRIS, INNER, OUTER, turning

STEP = 1e-7
"""Of the differences, in units of the inner line's free length: 5e-4 of the approaches, so that central ones err by
some 1e-8 of a slope."""

ROUNDING = 16.0 * np.finfo(float).eps
"""Of forces."""

POSITIONS = {
    "pressed": (0.5, 3e-4, 0.6, 2e-4),
    "over the shoulder": (0.1, 2e-4, 2.3, 1e-4),
    "just off the inner groove": (0.1, 2e-4, 0.9, -6e-3),
    "just off, seen from further round": (0.1, 2e-4, 2.3, -0.012),
    "gone with the others": (0.1, 2e-4, 0.9, -0.3),
    "near the inner groove's centre": (0.2, 2e-4, 1.1, -0.8),
}
"""Outer angle, outer approach, inner angle, inner approach; approaches in units of the lines' free lengths."""


@entry(*GIVEN[:3], array_of(float), array_of(float), float, float, array_of(float), array_of(float, 2))
def ball_between(
    cases: ndarray,
    workspaces: ndarray,
    balls: ndarray,
    x: ndarray,
    w: ndarray,
    diameter: float,
    friction_bound: float,
    forces: ndarray,
    eliminated: ndarray,
) -> None:
    """A ball with lines x and w: its imbalance and its force on the ring; and what its elimination leaves.

    eliminated: rows y (2) and condensed force (3); columns their values, and their parts by the ring's displacement.
    """
    case: recarray = cases[0]
    work, ball = workspaces[0], balls[0]
    ball.diameter = diameter
    set_spin_constants(case, 1, balls)
    work.speed_factor, work.regularisation, work.friction_bound = 1.0, 0.0, friction_bound
    ball.control = case.control
    s, c = case.sin_free, case.cos_free
    li, lo = inner_length(case, ball), outer_length(case, ball)
    approach, n1, n2, _ = direction(lo, s, c, x[0] - lo * s, x[1] - lo * c)
    set_outer_line(ball, n1, n2, approach)
    approach, n1, n2, _ = direction(li, s, c, w[0] - li * s, w[1] - li * c)
    set_inner_line(ball, n1, n2, approach)
    moving_ball(case, work, ball, x[0] + w[0] - (li + lo) * s, x[1] + w[1] - (li + lo) * c)
    forces[0], forces[1] = ball.imbalance[0], ball.imbalance[1]
    eliminated[0, 0], eliminated[0, 1], eliminated[0, 2] = ball.y1, ball.y11, ball.y12
    eliminated[1, 0], eliminated[1, 1], eliminated[1, 2] = ball.y2, ball.y21, ball.y22
    for row in range(3):
        forces[2 + row] = ball.force[row]
        eliminated[2 + row, 0] = ball.condensed[row]
        eliminated[2 + row, 1], eliminated[2 + row, 2] = ball.stiffness[row, 0], ball.stiffness[row, 1]


def forces_and_elimination(
    cases: NDArray, x: NDArray, w: NDArray, diameter: float, friction_bound: float
) -> tuple[NDArray, NDArray]:
    """(five forces; what the ball's elimination leaves) of the ball with these two lines."""
    forces, eliminated = np.zeros(5), np.zeros((5, 3))
    ball_between(cases, *working_memory(1), x, w, diameter, friction_bound, forces, eliminated)
    return forces, eliminated


def line(angle: float, length: float) -> NDArray:
    return length * np.array([np.sin(angle), np.cos(angle)])


@pytest.mark.parametrize("bound", [NO_BOUND, LOAD_BOUND], ids=["friction whatever the load", "no more than load"])
@pytest.mark.parametrize("orbit", list(qs.OrbitRadius))
@pytest.mark.parametrize("diameter", [1.0, 1.004], ids=["of the bearing's diameter", "larger"])
@pytest.mark.parametrize("control", [OUTER, INNER, qs.RacewayControl.MINIMUM_DISSIPATION])
@pytest.mark.parametrize("position", POSITIONS.values(), ids=POSITIONS.keys())
def test_elimination_is_what_differences_say(
    position: tuple[float, float, float, float],
    control: qs.RacewayControl,
    diameter: float,
    orbit: qs.OrbitRadius,
    bound: float,
) -> None:
    """Imbalance r and force h by the inner groove centre's displacement A and by the ball's own X, by differences;
    then y = rx^-1 r, Y = rx^-1 ra, the condensed force h - hx y and its stiffness ha - hx Y."""
    scene = turning(9_000.0, effects=BOTH_HARRIS, control=control, hertz_angle=qs.HertzAngle.ACTUAL, axial_load=900.0)
    cases = CaseMaker(replace(scene, orbit_radius=orbit)).make()
    li, lo = (float(cases[0][f"{race}_coefficient"]) - 0.5 * diameter for race in ("inner", "outer"))
    x, w = line(position[0], lo * (1.0 + position[1])), line(position[2], li * (1.0 + position[3]))
    forces, eliminated = forces_and_elimination(cases, x, w, diameter, bound)
    step = STEP * li
    assert np.abs(forces[:2]).max() > 0.0
    slopes = np.empty((5, 4))
    for column in range(4):
        change = np.zeros(2)
        change[column % 2] = step
        # The inner groove's centre moves the inner line; the ball lengthens one line by what it takes from the other.
        dx, dw = (np.zeros(2), change) if column < 2 else (change, -change)
        after, _ = forces_and_elimination(cases, x + dx, w + dw, diameter, bound)
        before, _ = forces_and_elimination(cases, x - dx, w - dw, diameter, bound)
        slopes[:, column] = (after - before) / (2.0 * step)
    by_ring, by_own = slopes[:, :2], slopes[:, 2:]
    expected = np.empty((5, 3))
    expected[:2] = np.linalg.solve(by_own[:2], np.column_stack([forces[:2], by_ring[:2]]))
    expected[2:] = np.column_stack([forces[2:], by_ring[2:]]) - by_own[2:] @ expected[:2]
    # Differences err by their rounding and by 1e-7 of the largest slope, which the solution of the block amplifies.
    error = max(ROUNDING * np.abs(forces).max() / step, 1e-7 * np.abs(slopes).max())
    amplified = error * np.linalg.norm(np.linalg.inv(by_own[:2]), 2) * (1.0 + np.linalg.norm(by_own, 2))
    for column in range(3):
        size = np.abs(expected[:2, column]).max() + (column > 0)
        np.testing.assert_allclose(
            eliminated[:2, column], expected[:2, column], rtol=1e-6, atol=size * error / np.abs(by_own[:2]).max() * 50
        )
        np.testing.assert_allclose(
            eliminated[2:, column], expected[2:, column], rtol=1e-6, atol=max(amplified * size, error)
        )
