"""Stiffness over the frequency of a load, against a ball that only Newton's and Euler's laws move while the inner
ring's axis goes round in a small circle.

The ring is held off its centre by +-e, which turns at nu; what a ball gives it, averaged over many meetings of ball and
displacement, is a part of the stiffness, and Z balls make all of it.
"""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

import qsbearing as qs
from fem_check.independent.free_ball import RING, FreeBallCase, FreeBalls
from fem_check.independent.slip_friction import over_ellipse
from qsbearing.model.effects.traction import Traction
from qsbearing.model.solution.friction_motion import friction_motion
from qsbearing.model.solution.motion_stiffness import turning_stiffness
from tests.fem_check.test_free_ball import RPM, begun, controlled, drawing, on_pitch_circle, rubbing

SPEED, COUNT, THRUST = 18_000 * RPM, 20, 600.0
FREQUENCIES = np.array([0.0, 0.7, 1.0, -1.0]) * SPEED
OFF = 0.5e-6
STEP, SETTLING, MEASURED = 5e-6, 0.03, 0.05
"""[s]. The axis decays by some 100 1/s, and starts 5e-7 of a radian away, or as far as another drawing puts it."""
SHARE = (6, 16)
"""Points of a contact, for both."""


def turning_ring_stiffness(ring: float, angle: float, load: float) -> np.ndarray:
    """By steps in time [N/m]; a small contact damping, for it works on the ring too."""
    of = on_pitch_circle(drawing("25 deg", 11.1125, 90.0, 0.53, 0.52, 25.0), np.degrees(angle), load)
    case, count = FreeBallCase(of, SPEED, None), 2 * len(FREQUENCIES)
    balls = FreeBalls([case] * count, rubbing(*[0.07] * count), over_ellipse(*SHARE), damping=50.0)
    state = begun(balls, [controlled(case, "outer", THRUST / COUNT)] * count)
    state[RING] = ring
    along, _ = balls._centres
    nu, off = np.tile(FREQUENCIES, 2), np.repeat([OFF, -OFF], len(FREQUENCIES))

    def rates(state: np.ndarray, time: float) -> np.ndarray:
        at = off * np.exp(1j * nu * time)
        vars(balls)["_centres"] = along, np.stack([at, 0.0 * at])
        return balls.rates(state)

    time, total, weights = 0.0, np.zeros(count, complex), 0.0
    for _ in range(round((SETTLING + MEASURED) / STEP)):
        first = rates(state, time)
        if time >= SETTLING:  # with weights that begin and end at nothing, so that no part of a meeting counts
            weight = np.sin(pi * (time - SETTLING) / MEASURED) ** 2
            total += weight * balls.contacts(state).on_rings[1][0] * np.exp(-1j * nu * time)
            weights += weight
        second = rates(state + 0.5 * STEP * first, time + 0.5 * STEP)
        third = rates(state + 0.5 * STEP * second, time + 0.5 * STEP)
        fourth = rates(state + STEP * third, time + STEP)
        state = state + STEP / 6.0 * (first + 2.0 * (second + third) + fourth)
        time += STEP
    ahead, behind = np.split(total / weights, 2)
    return -COUNT * (ahead - behind).real / (2.0 * OFF)


@pytest.mark.heavy
def test_stiffness_over_frequency_is_that_of_a_ring_whose_axis_goes_round() -> None:
    """Both miss what the other has: the ball is pressed to where the drawing has it, 0.6 % of its inner load apart, and
    here it slips on its way in and out of the groove. That grows with how often a ball meets the displacement, most
    against the shaft's turning. From 0 to the speed of the shaft stiffness rises by 5.1 %."""
    of = qs.BallBearing(COUNT, 11.1125e-3, 90e-3, 0.53 * 11.1125e-3, 0.52 * 11.1125e-3, 25 * qs.deg)
    motion = friction_motion(
        qs.Scene(of, qs.Operation(speed=SPEED, axial_load=THRUST)), Traction(0.07), radii=SHARE[0], angles=SHARE[1]
    )
    product = turning_stiffness(motion, FREQUENCIES).radial
    in_time = turning_ring_stiffness(float(motion.displacement[0]), motion.outer.angle[0], motion.outer.load[0])
    np.testing.assert_allclose(in_time[:3], product[:3], rtol=0.01)
    np.testing.assert_allclose(in_time[3], product[3], rtol=0.05)
    rise = product[2] / product[0]
    assert rise > 1.05
    assert in_time[2] / in_time[0] == pytest.approx(rise, abs=2e-3)
