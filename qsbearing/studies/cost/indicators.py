"""How much an effect matters, judged from a solution without it: dimensionless numbers that the error follows.

With Q the load of a contact, alpha its angle, delta the approach across the ball, BD the distance of the groove
centres and g = D/dm:

    centrifugal_force    x = Fc/Q: the two contact angles of a ball part by about x cos(alpha)
    gyroscopic_moment    y = 2 |Mg|/(D Q): the contact forces turn by about y
        for both, a turn of the contacts moves the ring by its square, enlarged by BD/delta, and the more so where a
        ball carries little: x (1 + BD/delta x), y (1 + BD/delta (x + y))
    actual_angle         g sin(alpha)/(1 - g cos(alpha0)) for each radian by which angles leave alpha0: the change of
                         the curvature in the rolling direction
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.scene.scene import HertzAngle, Scene
from qsbearing.solution import Solution
from qsbearing.studies.cost.results import LIGHT

OMISSIONS = {
    "centrifugal_force": "the centrifugal force",
    "gyroscopic_moment": "the gyroscopic moment",
    "actual_angle": "the actual angle in Hertz (the free one instead)",
}
"""Everything that some model level does without; each error follows its own indicator, errors of several add up."""

NEARLY_UNLOADED = 0.02
"""A ball with less than this part of the largest load is about to lose its raceway. Chosen by measurement: below it
errors grow out of proportion to the indicators, since stiffness starts with an infinite slope there."""


def omissions(simple: Scene, full: Scene) -> tuple[str, ...]:
    """What a simpler scene does without."""
    is_omitted = {
        "centrifugal_force": full.centrifugal_force is not None and simple.centrifugal_force is None,
        "gyroscopic_moment": full.gyroscopic_moment is not None and simple.gyroscopic_moment is None,
        "actual_angle": full.hertz_angle is HertzAngle.ACTUAL and simple.hertz_angle is not full.hertz_angle,
    }
    return tuple(name for name in OMISSIONS if is_omitted[name])


def indicators(full: Scene, solution: Solution) -> tuple[dict[str, NDArray], NDArray]:
    """(indicator of each omission, whether some ball is nearly unloaded), arrays (*cases), by the contacts of a
    solution at whatever model level, under the inertia forces of the full scene."""
    inner, outer, bearing = solution.inner, solution.outer, full.bearing
    diameter, free = np.asarray(bearing.ball_diameter, float), np.asarray(bearing.free_contact_angle, float)
    gamma = diameter / np.asarray(bearing.pitch_diameter, float)
    load = np.nan_to_num(inner.load)
    most = load.max(axis=-1)
    heavy = load > LIGHT * most[..., None]
    least = np.where(heavy, load, np.inf).min(axis=-1)
    top = np.argmax(load, axis=-1)[..., None]
    angle = np.take_along_axis(inner.angle, top, axis=-1)[..., 0]
    approach = np.take_along_axis(inner.approach + outer.approach, top, axis=-1)[..., 0]
    turns = [np.where(heavy, np.abs(side.angle - free[..., None]), 0.0).max(axis=-1) for side in (inner, outer)]
    force, moment = inertia(full, angle)
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y, slenderness = force / least, 2.0 * moment / (diameter * least), bearing.groove_centre_distance / approach
        found = {
            "centrifugal_force": x * (1.0 + slenderness * x),
            "gyroscopic_moment": y * (1.0 + slenderness * (x + y)),
            "actual_angle": gamma * np.sin(angle) / (1.0 - gamma * np.cos(free)) * np.maximum(*turns),
        }
    is_there = np.isfinite(solution.azimuth)
    return found, (is_there & (load < NEARLY_UNLOADED * most[..., None])).any(axis=-1)


def inertia(scene: Scene, angle: Any) -> tuple[Any, Any]:
    """(Fc [N], |Mg| [N m]) of a ball with both contact angles alike, by outer control; 0 for what the scene does not
    name. Harris & Kotzalas; the equations of `qsbearing.kernel.kinematics` at equal angles."""
    bearing, operation = scene.bearing, scene.operation
    pitch = np.asarray(bearing.pitch_diameter, float)
    gamma = np.asarray(bearing.ball_diameter, float) / pitch
    inner = np.asarray(operation.speed, float)
    outer = np.asarray(0.0 if operation.outer_speed is None else operation.outer_speed, float)
    g = gamma * np.cos(angle)
    orbit = 0.5 * (inner * (1.0 - g) + outer * (1.0 + g))
    rotation = 0.5 * (outer - inner) / gamma * (1.0 - g * g)
    attitude = np.arctan2(np.sin(angle), np.cos(angle) + gamma)
    # Along the contact line itself the speed is the rolling one; about the axis tilted from it, 1/cos of it.
    across = rotation * np.sin(attitude) / np.cos(attitude - angle)
    force = 0.0 * orbit if scene.centrifugal_force is None else 0.5 * bearing.ball_mass * pitch * orbit**2
    moment = 0.0 * orbit if scene.gyroscopic_moment is None else bearing.ball_inertia * np.abs(across * orbit)
    return force, moment
