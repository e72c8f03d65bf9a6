"""What the balance of friction does not know yet of a scene, by its fields: nothing falls back to a hypothesis."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from qsbearing.model.effects.centrifugal_force import CentrifugalForce
from qsbearing.model.effects.gyroscopic_moment import GyroscopicMoment, MomentShares
from qsbearing.model.effects.hertz_angle import HertzAngle
from qsbearing.model.effects.orbit_radius import OrbitRadius
from qsbearing.model.effects.raceway_control import RacewayControl
from qsbearing.model.effects.traction import Traction
from qsbearing.model.validation import ErrorDetail, SceneError

BOTH = {CentrifugalForce.name, GyroscopicMoment.name}
"""The ball effects of which none can be left out of the balance."""


def friction_instead(scene: Any, *, without_bound: bool = False) -> dict[str, str]:
    """{"instead": what to write} where a scene may have friction move its balls, needs nothing else for it, and has it
    not yet.

    Args:
        without_bound: of a scene without the friction coefficient of its gyroscopic moment.
    """
    if scene.raceway_control is RacewayControl.FRICTION:
        return {}
    effects = scene.ball_effects
    if without_bound:
        effects = tuple(
            replace(each, friction_coefficient=None) if isinstance(each, GyroscopicMoment) else each for each in effects
        )
    try:
        replace(scene, ball_effects=effects, raceway_control=RacewayControl.FRICTION)
    except SceneError:
        return {}
    return {"instead": f'raceway_control = "{RacewayControl.FRICTION}"'}


def friction_errors(scene: Any) -> list[ErrorDetail]:
    """Errors of a scene with a law of friction or moved by one."""
    if scene.raceway_control is not RacewayControl.FRICTION:
        cause = 'Leave it out, or give raceway_control = "friction"'
        return [ErrorDetail("traction", "is given, but friction does not move the balls", cause=cause)]
    if scene.traction is not None and not isinstance(scene.traction, Traction):
        return [ErrorDetail("traction", "is not a law of friction", scene.traction, cause="Write qs.Traction(...)")]
    return [*_choice_errors(scene), *unknown_to_friction(scene)]


def _choice_errors(scene: Any) -> list[ErrorDetail]:
    """Of what is given beside friction, in whose place it stands."""
    errors, named = [], [getattr(each, "name", "") for each in scene.ball_effects]
    if named and set(named) != BOTH:
        cause = f"Ask for both, {' and '.join(sorted(BOTH))}"
        problem = "must have all of the balls' inertia where friction moves them"
        errors.append(ErrorDetail("ball_effects", problem, named, cause=cause))
    for moment in filter(lambda each: isinstance(each, GyroscopicMoment), scene.ball_effects):
        if moment.friction_coefficient is not None:
            cause = "Give it as the friction_coefficient of traction"
            problem = "bounds a hypothesis, and friction moves the balls"
            errors.append(ErrorDetail("friction_coefficient", problem, cause=cause))
        if moment.moment_shares is not MomentShares.CONTROLLING:
            problem = "is a hypothesis, and friction moves the balls"
            cause = "Leave it out: how contacts share the moment is a result"
            errors.append(ErrorDetail("moment_shares", problem, str(moment.moment_shares), cause=cause))
    given = scene.readings.get("friction", {}).get("friction_coefficient")
    mu = (scene.traction or Traction()).coefficient
    if given is not None and np.any(np.asarray(given) != np.asarray(mu)):
        cause = f"Give {mu:g} in both" if np.ndim(mu) == 0 else "Give one in both"
        problem = "is not that which moves the balls"
        errors.append(ErrorDetail("readings.friction.friction_coefficient", problem, cause=cause))
    return errors


def unknown_to_friction(scene: Any) -> list[ErrorDetail]:
    """What the balance has no equations for, whatever raceway control the scene has."""
    operation, errors = scene.operation, []
    outer = 0.0 if operation.outer_speed is None else operation.outer_speed
    inner, outer = np.asarray(operation.speed, float), np.asarray(outer, float)
    if np.any((inner == outer) & (inner != 0.0)):
        errors.append(ErrorDetail("operation.speed", "is the outer ring's too, so that nothing rolls", operation.speed))
    for effect in (scene.elastic_rings, scene.ball_diameter_deviations, scene.seats_out_of_round):
        if scene.ring_effects and effect is not None:
            cause = "Leave it out, or choose a hypothesis of raceway control"
            errors.append(ErrorDetail(effect.name, "is not known to balls that friction moves", cause=cause))
    if scene.hertz_angle is HertzAngle.ACTUAL:
        problem = "must be free or zero where friction moves the balls"
        errors.append(ErrorDetail("hertz_angle", problem, "actual"))
    return errors + _radial_errors(scene)


def _radial_errors(scene: Any) -> list[ErrorDetail]:
    operation = scene.operation
    is_radial = any(
        value is not None and np.any(np.asarray(value) != 0.0)
        for name in ("radial_load_y", "radial_load_z", "radial_displacement_y", "radial_displacement_z")
        for value in [getattr(operation, name)]
    )
    errors = []
    if is_radial and scene.orbit_radius is OrbitRadius.DISPLACED:  # whose change would accelerate balls
        problem, cause = "must be pitch_circle where friction moves balls under radial load", "Leave it out"
        errors.append(ErrorDetail("orbit_radius", problem, str(scene.orbit_radius), cause=cause))
    for axis in "yz":
        moment, tilt = getattr(operation, f"moment_{axis}"), getattr(operation, f"tilt_{axis}")
        is_free = tilt is None and (is_radial or np.any(np.asarray(0.0 if moment is None else moment) != 0.0))
        if is_free or (tilt is not None and np.any(np.asarray(tilt) != 0.0)):
            problem, cause = "must be held at 0 where friction moves the balls", "Give it as 0, and no moment"
            errors.append(ErrorDetail(f"operation.tilt_{axis}", problem, tilt, cause=cause))
    return errors
