"""The motion of balls that friction moves, of a scene under any raceway control: for those who compare. `solve` gives
it with everything else of a solution, for raceway_control = "friction"."""

from __future__ import annotations

from dataclasses import replace

from qsbearing.model.effects import CentrifugalForce, GyroscopicMoment
from qsbearing.model.effects.hypotheses import under_control
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.traction import ANGLES, RADII, Traction
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.flatten import CaseMaker
from qsbearing.model.solution.friction_balance import FrictionMotion, balanced, laws_of, read
from qsbearing.model.solution.solved_cases import solved_of
from qsbearing.model.solution.solver import solve

__all__ = ["FrictionMotion", "friction_motion", "laws_of"]


def friction_motion(
    scene: Scene, traction: Traction, *, radii: int = RADII, angles: int = ANGLES, carried: bool = True
) -> FrictionMotion:
    """Solve a scene with balls that friction moves.

    Args:
        scene: bearing, operation and constant Hertz stiffness; its ball effects and raceway control do not count, for
            the balance has all of the balls' inertia.
        traction: the law of friction; its arrays broadcast with the scene's to the case axes, so that one scene takes a
            band of friction coefficients.
        radii, angles: points of each contact, see `contact_points`.
        carried: balls are carried round with their inertia under radial load; False: each is balanced at its azimuth
            as if it stayed there.

    Returns:
        FrictionMotion: raises nothing for a physical outcome; `status` says what happened.

    Raises:
        SceneError: what this balance does not know yet.
    """
    moved = replace(
        scene,
        ball_effects=(CentrifugalForce(), GyroscopicMoment()),
        raceway_control=RacewayControl.FRICTION,
        traction=traction,
    )
    if moved.bearing.is_arched:
        return read(balanced(None, CaseMaker(moved), traction, radii, angles, carried=carried))
    start = solve(under_control(moved, RacewayControl.OUTER))
    return read(
        balanced(start, CaseMaker(moved, solved_of(start).maker.axial), traction, radii, angles, carried=carried)
    )
