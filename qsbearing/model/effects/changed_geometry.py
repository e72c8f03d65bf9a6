"""What follows when grooves move or balls grow: errors of leaving out what changes the bearing before it is loaded.

Between the groove centres, A1 apart axially and A2 radially, lies the contact line of length BD + delta, at the angle
alpha. At an unchanged axial load delta stays and the line turns:

    dalpha = (dA2 - cos(alpha) dBD)/(BD sin(alpha)),   dA1 = (dBD - cos(alpha) dA2)/sin(alpha)

loads change by dalpha cot(alpha), axial stiffness by twice that, and the ring moves by dA1. At an unchanged axial
position, and at small contact angles, where the axial way out is long, delta changes by cos(alpha) dA2 - dBD and loads
follow its power 3/2; at speed the two contact angles, which the centrifugal force parts the further the lighter the
load, close by their loads' part of their distance, half of it each, and axial stiffness changes by that as well.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import Entry, Errors
from qsbearing.model.effects.operating_point import SMALLEST_ANGLE, OperatingPoint

SMALLEST_SINE = 0.05
"""Of contact angles: below it nothing carries an axial load."""
SMALL_ANGLE = np.radians(12.0)
"""Between deep-groove and angular-contact bearings (chosen)."""


class GeometryChange(NamedTuple):
    """What an effect changes of a bearing; shape (*cases) [m]."""

    radial: Any
    """dA2, of the radial distance between the groove centres of inner and outer ring."""
    distance: Any
    """dBD, BD = ri + ro - D."""


def geometry_errors(point: OperatingPoint, change: GeometryChange) -> Errors:
    """Errors of leaving out a change of the bearing."""
    solution, held = point.solution, point.axial_is_held
    sine, cosine = np.maximum(np.abs(np.sin(point.angle)), SMALLEST_SINE), np.cos(point.angle)
    angle = np.maximum(np.abs(point.angle), SMALLEST_ANGLE)
    approach = point.at_largest_load(solution.inner.approach + solution.outer.approach)
    size = np.maximum(approach, np.abs(solution.displacement[..., :3]).max(axis=-1))
    nearer = np.abs(cosine * change.radial - change.distance)
    with np.errstate(divide="ignore", invalid="ignore"):
        if held:
            turn, moved = np.abs(change.radial) * sine / point.bearing.groove_centre_distance, 0.0 * nearer
        else:
            turn = np.abs(change.radial - cosine * change.distance) / (point.bearing.groove_centre_distance * sine)
            moved = nearer / sine / size
        tighter = np.where(held | (angle < SMALL_ANGLE), 1.5 * nearer / approach, 0.0)
    if held:
        difference = np.abs(solution.inner.angle - solution.outer.angle)
        turn = turn + 0.5 * point.at_largest_load(difference) * np.minimum(tighter, 1.0)
    turned = (0.0 if held else 1.0) * turn * cosine / sine
    load = np.maximum(turned, tighter)
    errors = {
        "contact_angle": turn / angle,
        "load": load,
        "pressure": load / 3.0,
        "displacement": np.maximum(moved, np.where(angle < SMALL_ANGLE, tighter, 0.0)),
        "stiffness": load / 3.0 + 2.0 * turn / angle if held else np.maximum(load / 3.0, 2.0 * turned),
    }
    return {name: np.broadcast_to(error, solution.shape) for name, error in errors.items()}


def change_by(entry: Entry, point: OperatingPoint) -> GeometryChange:
    """What an effect changes of the bearing of the point's full scene."""
    now, then = point.full_scene.operating_bearing, entry.coarser(point.full_scene).operating_bearing
    return GeometryChange(_radial(now) - _radial(then), now.groove_centre_distance - then.groove_centre_distance)


def _radial(bearing: Any) -> NDArray:
    return np.asarray(bearing.inner_groove_centre_radius - bearing.outer_groove_centre_radius)
