"""The size of each ball: its diameter in the case's unit, the bearing's ball diameter, and what follows from it.

Beside it stands the lobe of grooves out of round.
"""

from __future__ import annotations

from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import inlined, kernel
from qsbearing.model.kernel.case import BALL_INERTIA, BALL_MASS


@inlined
def are_uneven(case: recarray) -> bool:
    """Whether balls are unequal, or stand between grooves out of round: none has a mirror image then."""
    return case.unequal_balls or case.out_of_round


@kernel
def set_sizes(case: recarray, count: int, balls: ndarray, own: ndarray) -> None:
    """Give every ball its diameter, unequal ones their contacts' stiffness; the lobe of grooves out of round."""
    for n in range(count):
        ball = balls[n]
        ball.diameter = 1.0
        if case.unequal_balls:
            ball.diameter = own[n].diameter
            ball.inner_stiffness, ball.outer_stiffness = own[n].inner_stiffness, own[n].outer_stiffness
        if case.out_of_round:
            ball.lobe = own[n].lobe


@inlined
def ball_mass(diameter: float) -> float:
    """m, as the cube of the diameter."""
    return BALL_MASS * diameter * diameter * diameter


@inlined
def ball_inertia(diameter: float) -> float:
    """J = m D^2/10."""
    return BALL_INERTIA * diameter * diameter * diameter * diameter * diameter
