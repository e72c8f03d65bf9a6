"""Where free balls are begun: in the balance of a ball under raceway control, as this package has it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fem_check.independent import quasi_static
from fem_check.independent.contact_problem import Array
from fem_check.independent.equilibrium import BalanceTerms, BallRow
from fem_check.independent.free_ball import FreeBallCase, FreeBalls
from fem_check.independent.quasi_static import Equilibrium


def controlled(case: FreeBallCase, control: str, thrust: float | None = None, gyroscopic: bool = True) -> Equilibrium:
    """The balance of one ball under raceway control, on the circle where it is pressed.

    Args:
        control: "outer" or "inner".
        thrust: in place of the case's [N].
        gyroscopic: whether its gyroscopic moment acts.
    """
    model = BalanceTerms(True, gyroscopic, control, displaced_orbit=True)
    offset = case.drawing.touching_offset
    row = BallRow(case.drawing, model, np.zeros(1), inner_speed=case.speed, touching_offset=offset)
    load = np.eye(6)[0] * ((case.thrust or 0.0) if thrust is None else thrust)
    problem = quasi_static.BalanceProblem(
        (quasi_static.Placed(row, quasi_static.alone()),), load, ~np.eye(6, dtype=bool)[0], np.zeros(6)
    )
    return quasi_static.at_speed(problem, [np.array([control])])


def begun(balls: FreeBalls, balances: Sequence[Equilibrium]) -> Array:
    """The state of balls as these balances have them."""
    states = [each.states[0] for each in balances]
    places = [
        complex(*each.positions[0][0]) + 1j * each.problem.rows[0].row.drawing.outer_groove_centre_radius
        for each in balances
    ]
    rotations = np.array([complex(*each.rotation[0]) for each in states])
    orbits = np.array([each.orbit[0] for each in states])
    return balls.start(np.array(places), orbits, rotations, np.array([each.shaft[0] for each in balances]))
