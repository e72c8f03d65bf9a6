"""A ball's exact derivatives against differences, wherever it lies: they are what Newton's method and paths live on."""

from __future__ import annotations

import numpy as np
import pytest
from numpy import ndarray, recarray
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.ball import FULL_GRIP, UNLIMITED, moving_ball, set_inner, set_outer
from qsbearing.case import CaseMaker
from qsbearing.compiled import entry
from qsbearing.contact import direction
from qsbearing.state import working_memory

from .scenes import BOTH_HARRIS, INNER, OUTER, turning

STEP = 1e-7
"""Of the differences, in units of the inner line's free length: 5e-4 of the approaches, so that central ones err by
some 1e-8 of a slope."""

ROUNDING = 16.0 * np.finfo(float).eps
"""Of forces."""

PLACES = {
    "pressed": (0.5, 3e-4, 0.6, 2e-4),
    "off the inner groove": (0.1, 2e-4, 0.9, -0.3),
    "seen from further round": (0.1, 2e-4, 2.3, -0.1),
    "near the inner groove's centre": (0.2, 2e-4, 1.1, -0.8),
    "nearer, from further round": (0.2, 2e-4, -2.5, -0.95),
}
"""Outer angle, outer approach, inner angle, inner approach; approaches in units of the lines' free lengths."""


@entry
def ball_between(
    cases: ndarray,
    balls: ndarray,
    x: ndarray,
    w: ndarray,
    grip: float,
    forces: ndarray,
    slopes: ndarray,
) -> None:
    """A ball with lines x and w: its imbalance and its force on the ring; and these by the inner groove centre's place
    (two columns) and by the ball's own (two more)."""
    case: recarray = cases[0]
    ball = balls[0]
    ball.control = case.control
    s, c = case.sin_free, case.cos_free
    li, lo = case.inner_coefficient - 0.5, case.outer_coefficient - 0.5
    approach, n1, n2, _ = direction(lo, s, c, x[0] - lo * s, x[1] - lo * c)
    set_outer(ball, n1, n2, approach)
    approach, n1, n2, _ = direction(li, s, c, w[0] - li * s, w[1] - li * c)
    set_inner(ball, n1, n2, approach)
    a1, a2 = x[0] + w[0] - (li + lo) * s, x[1] + w[1] - (li + lo) * c
    moving_ball(case, ball, a1, a2, 0.0, grip)
    # y = own^-1 r and Y = own^-1 dr/dA; what is condensed has the ball's own step taken out.
    forces[0] = ball.own11 * ball.y1 + ball.own12 * ball.y2
    forces[1] = ball.own21 * ball.y1 + ball.own22 * ball.y2
    slopes[0, 0] = ball.own11 * ball.y11 + ball.own12 * ball.y21
    slopes[0, 1] = ball.own11 * ball.y12 + ball.own12 * ball.y22
    slopes[1, 0] = ball.own21 * ball.y11 + ball.own22 * ball.y21
    slopes[1, 1] = ball.own21 * ball.y12 + ball.own22 * ball.y22
    slopes[0, 2], slopes[0, 3], slopes[1, 2], slopes[1, 3] = ball.own11, ball.own12, ball.own21, ball.own22
    for row in range(3):
        by_x1, by_x2 = ball.by_own[row, 0], ball.by_own[row, 1]
        forces[2 + row] = ball.force[row]
        slopes[2 + row, 0] = ball.stiffness[row, 0] + by_x1 * ball.y11 + by_x2 * ball.y21
        slopes[2 + row, 1] = ball.stiffness[row, 1] + by_x1 * ball.y12 + by_x2 * ball.y22
        slopes[2 + row, 2], slopes[2 + row, 3] = by_x1, by_x2


def forces_and_slopes(cases: NDArray, x: NDArray, w: NDArray, grip: float) -> tuple[NDArray, NDArray]:
    """(five forces, their four derivatives each) of the ball with these two lines."""
    forces, slopes = np.zeros(5), np.zeros((5, 4))
    ball_between(cases, working_memory(1)[1], x, w, grip, forces, slopes)
    return forces, slopes


def line(angle: float, length: float) -> NDArray:
    return length * np.array([np.sin(angle), np.cos(angle)])


@pytest.mark.parametrize("grip", [UNLIMITED, FULL_GRIP], ids=["friction whatever the load", "no more than load"])
@pytest.mark.parametrize("control", [OUTER, INNER])
@pytest.mark.parametrize("place", PLACES.values(), ids=PLACES.keys())
def test_derivatives_are_what_differences_say(
    place: tuple[float, float, float, float], control: qs.RacewayControl, grip: float
) -> None:
    """Of a ball's imbalance and of its force on the ring, by the inner groove centre's place and by its own."""
    scene = turning(9_000.0, effects=BOTH_HARRIS, control=control, hertz_angle=qs.HertzAngle.ACTUAL, axial_load=900.0)
    cases = CaseMaker(scene).make()
    li, lo = (float(cases[0][f"{race}_coefficient"]) - 0.5 for race in ("inner", "outer"))
    x, w = line(place[0], lo * (1.0 + place[1])), line(place[2], li * (1.0 + place[3]))
    forces, slopes = forces_and_slopes(cases, x, w, grip)
    step = STEP * li
    rounding = ROUNDING * np.abs(forces).max() / step
    assert np.abs(forces[:2]).max() > 0.0
    for column in range(4):
        change = np.zeros(2)
        change[column % 2] = step
        # The inner groove's centre moves the inner line; the ball lengthens one line by what it takes from the other.
        dx, dw = (np.zeros(2), change) if column < 2 else (change, -change)
        after, _ = forces_and_slopes(cases, x + dx, w + dw, grip)
        before, _ = forces_and_slopes(cases, x - dx, w - dw, grip)
        difference = (after - before) / (2.0 * step)
        np.testing.assert_allclose(
            slopes[:, column], difference, rtol=1e-6, atol=max(rounding, 1e-7 * np.abs(slopes[:, column]).max())
        )


@pytest.mark.parametrize("control", [OUTER, INNER])
def test_forces_are_the_same_from_whatever_side_a_ball_comes_to_the_inner_groove_s_centre(
    control: qs.RacewayControl,
) -> None:
    """Where the inner line has no direction it is the outer one that rolling sees."""
    scene = turning(9_000.0, effects=BOTH_HARRIS, control=control, axial_load=900.0)
    cases = CaseMaker(scene).make()
    li, lo = (float(cases[0][f"{race}_coefficient"]) - 0.5 for race in ("inner", "outer"))
    x = line(0.2, lo * (1.0 + 2e-4))
    near, nearer = (
        [forces_and_slopes(cases, x, line(angle, distance * li), FULL_GRIP)[0] for angle in np.linspace(-3.0, 3.0, 13)]
        for distance in (1e-3, 1e-6)
    )
    scale = np.abs(near).max()
    assert np.ptp(near, axis=0).max() / scale > 1e-5  # it does turn, on the way there
    assert np.ptp(nearer, axis=0).max() / scale < 1e-4
