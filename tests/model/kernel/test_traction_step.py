"""Newton's step on ring and balls that friction moves: along it everything that is out of balance falls as one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import qsbearing as qs
from qsbearing.model.effects.traction import Traction
from qsbearing.model.kernel import traction_balance as balance
from qsbearing.model.kernel.traction import contact_points
from qsbearing.model.kernel.traction_ball import GROOVE, MOVED_BALL
from qsbearing.model.kernel.traction_ring import MOTION, evaluate
from qsbearing.model.kernel.traction_step import keep_state, move, step_of_motion
from qsbearing.model.solution.friction_motion import laws_of
from qsbearing.model.solution.solved_cases import solved_of
from tests.qsbearing.scenes import BOTH, OUTER, SPINDLE, UPRIGHT


@pytest.mark.parametrize("balls", [7, 8])
@pytest.mark.parametrize("is_carried", [True, False])
@pytest.mark.parametrize("channels", ["all", "x held"])
def test_along_the_step_all_imbalance_falls_as_one(balls: int, is_carried: bool, channels: str) -> None:
    """f(x + e s) = (1 - e) f(x) + O(e^2), of the balls' equations and of the ring's."""
    axial = {"axial_load": 200.0} if channels == "all" else {"axial_displacement": 5e-6}
    operation = qs.Operation(speed=20_000 * qs.rpm, radial_load_y=60.0, radial_load_z=20.0, **axial, **UPRIGHT)
    start = solved_of(qs.solve(qs.Scene(replace(SPINDLE, ball_count=balls), operation, BOTH, OUTER)))
    cases = start.maker.make()
    case, law = cases[0], laws_of(cases, Traction())[0]
    grooves, motion, moved = np.zeros(2, GROOVE), np.zeros(1, MOTION)[0], np.zeros(balls, MOVED_BALL)
    arrays = contact_points(3, 8), np.zeros((4 * balls + 3,) * 2), np.zeros(4 * balls + 3), np.zeros(balls)
    for groove, side in zip(grooves, (-1.0, 1.0), strict=True):
        balance.set_groove(case, law, groove, side)
    balance.set_ring(case, motion, start.results[0], is_carried)
    balance.set_derivative(arrays[3], balls)
    balance.place_balls(case, motion, moved, start.positions[0])
    moved["unknown"][:, 3] = 1e-5 * np.sin(np.arange(balls))

    def imbalance(fraction: float) -> NDArray:
        move(motion, moved, fraction)
        evaluate(case, law, grooves, arrays, motion, moved)
        return np.concatenate([moved["residual"].ravel(), motion.imbalance[: motion.channel_count]])

    evaluate(case, law, grooves, arrays, motion, moved)
    assert motion.channel_count == (3 if channels == "all" else 2)
    assert step_of_motion(case, arrays, motion, moved)
    keep_state(motion, moved)
    little = 1e-4
    slope = (imbalance(little) - imbalance(-little)) / (2.0 * little)
    here = imbalance(0.0)
    np.testing.assert_allclose(slope, -here, rtol=1e-4, atol=1e-5 * np.abs(here).max())
    assert np.abs(motion.imbalance[: motion.channel_count]).min() > 1e-3 * np.abs(here).max()
