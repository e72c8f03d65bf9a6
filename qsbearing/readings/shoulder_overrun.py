"""Whether contact ellipses run over the edges of their grooves, and from which ball load on.

A groove of radius r, deep by h, ends at phi = arccos(1 - h/r) from its bottom, seen from its centre; a contact lies
there at its contact angle alpha, and its ellipse reaches r sin(phi' - alpha) = a to either side (geometry; Harris &
Kotzalas, *Essential Concepts of Bearing Technology*, put the ball's radius for r, which asks for slightly higher
shoulders). Semi-axes grow as Q^(1/3), so the edge is reached at Q (limit/a)^3.

Range: ellipses as of an endless groove; beyond the limit the pressure at the edge rises above Hertz's.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.raceway_contacts import RacewayContacts
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.remarks import Remarks, remarks
from qsbearing.scene.bearing import BallBearing
from qsbearing.solution import Solution
from qsbearing.validation import LENGTH, ErrorDetail, first, numeric, raise_if_any


@dataclass(frozen=True)
class RacewayOverrun:
    """Ellipses of one raceway against its groove's edges; arrays of shape (*cases, ball), NaN without load."""

    edge_angle: NDArray
    """Of the groove's edge from its bottom; shape (*cases) [rad]."""
    edge_distance: NDArray
    """From the ellipse's tip along the groove to its nearer edge; negative: cut off by so much [m]."""
    overrun_load: NDArray
    """Ball load at which the ellipse reaches the edge at this contact angle [N]; zero where its centre is past it."""


@dataclass(frozen=True)
class Overrun:
    """Ellipses against groove edges; None for a raceway whose shoulder is not given."""

    inner: RacewayOverrun | None
    outer: RacewayOverrun | None
    warnings: Remarks


def overrun(
    solution: Solution,
    *,
    inner_shoulder_diameter: ArrayLike | None = None,
    outer_shoulder_diameter: ArrayLike | None = None,
    inner_open_diameter: ArrayLike | None = None,
    outer_open_diameter: ArrayLike | None = None,
) -> Overrun:
    """Distance of every ellipse from the edges of its groove.

    Args:
        inner_shoulder_diameter, outer_shoulder_diameter: of the shoulders on the side that contact angles above zero
            lean to [m]; one of them at least.
        inner_open_diameter, outer_open_diameter: of the other shoulders, lower in an angular-contact bearing [m];
            None: as high as the first.

    Raises:
        SceneError: no shoulder at all, or one that makes no groove; every error, at once.
    """
    bearing = solution.scene.operating_bearing
    given = (
        (INNER, "inner", inner_shoulder_diameter, inner_open_diameter),
        (OUTER, "outer", outer_shoulder_diameter, outer_open_diameter),
    )
    arguments = {
        f"{name}_{which}_diameter": value
        for _, name, shoulder, other in given
        for which, value in (("shoulder", shoulder), ("open", other))
    }
    raise_if_any(overrun_errors(bearing, **arguments))
    found: list[RacewayOverrun | None] = []
    said = []
    for side, name, shoulder, other in given:
        if shoulder is None:
            found.append(None)
            continue
        contacts = solution.inner if side < 0 else solution.outer
        raceway = _raceway(solution, contacts, side, shoulder, shoulder if other is None else other)
        cut = (np.nan_to_num(raceway.edge_distance, nan=np.inf) < 0.0).any(axis=-1)
        said.append((cut, f"an {name} contact's ellipse runs over the groove's edge: pressure there exceeds Hertz's"))
        found.append(raceway)
    return Overrun(found[0], found[1], remarks(said, solution.shape))


def overrun_errors(
    bearing: BallBearing | None,
    *,
    inner_shoulder_diameter: ArrayLike | None = None,
    outer_shoulder_diameter: ArrayLike | None = None,
    inner_open_diameter: ArrayLike | None = None,
    outer_open_diameter: ArrayLike | None = None,
) -> list[ErrorDetail]:
    """Every error of the arguments of `overrun`; of the bearing's shoulders, where there is a bearing."""
    errors: list[ErrorDetail] = []
    if inner_shoulder_diameter is None and outer_shoulder_diameter is None:
        cause = "Give inner_shoulder_diameter or outer_shoulder_diameter"
        errors.append(ErrorDetail("inner_shoulder_diameter", "missing: no shoulder is given", cause=cause))
    for side, field, value in (
        (INNER, "inner_shoulder_diameter", inner_shoulder_diameter),
        (INNER, "inner_open_diameter", inner_open_diameter),
        (OUTER, "outer_shoulder_diameter", outer_shoulder_diameter),
        (OUTER, "outer_open_diameter", outer_open_diameter),
    ):
        if value is not None and bearing is not None:
            errors += _shoulder_errors(bearing, side, field, value)
    return errors


def groove_depth(bearing: BallBearing, shoulder_diameter: ArrayLike, side: float) -> NDArray:
    """h, from a shoulder to the bottom of its groove [m]; side: INNER or OUTER."""
    numbers = BearingNumbers(bearing)
    r = numbers.inner_groove_radius if side < 0 else numbers.outer_groove_radius
    offset = (r - 0.5 * numbers.ball_diameter) * np.cos(numbers.free_contact_angle)
    bottom = 0.5 * numbers.pitch_diameter - side * (offset - r)
    return np.asarray(side * (bottom - 0.5 * np.asarray(shoulder_diameter, float)))


def _shoulder_errors(bearing: BallBearing, side: float, field: str, diameter: ArrayLike) -> list[ErrorDetail]:
    array, errors = numeric(field, diameter, LENGTH)
    if array is None:
        return errors
    numbers = BearingNumbers(bearing)
    r = numbers.inner_groove_radius if side < 0 else numbers.outer_groove_radius
    depth = groove_depth(bearing, array, side)
    bad = (depth <= 0.0) | (depth > r)
    if not bad.any():
        return []
    value, shallow, radius = first(bad, np.broadcast_to(array, depth.shape), depth, np.broadcast_to(r, depth.shape))
    bottom = value + 2.0 * side * shallow
    limits = sorted((bottom, bottom - 2.0 * side * radius))
    problem = "makes no groove: a shoulder lies between the groove's bottom and its centre circle"
    return [ErrorDetail(field, problem, value, LENGTH, (limits[0], limits[1]))]


def _raceway(
    solution: Solution, contacts: RacewayContacts, side: float, shoulder: ArrayLike, other: ArrayLike
) -> RacewayOverrun:
    bearing = solution.scene.operating_bearing
    numbers = BearingNumbers(bearing)
    r = numbers.inner_groove_radius if side < 0 else numbers.outer_groove_radius
    edge, far = (np.arccos(1.0 - groove_depth(bearing, diameter, side) / r) for diameter in (shoulder, other))
    angle = np.where(contacts.load > 0.0, contacts.angle, np.nan)
    nearer = np.minimum(edge[..., None] - angle, far[..., None] + angle)
    limit = r[..., None] * np.sin(np.clip(nearer, -0.5 * np.pi, 0.5 * np.pi))
    with np.errstate(invalid="ignore", divide="ignore"):
        load = contacts.load * (np.maximum(limit, 0.0) / contacts.semi_major_axis) ** 3
    distance = limit - np.where(np.isnan(angle), np.nan, contacts.semi_major_axis)
    return RacewayOverrun(np.broadcast_to(edge, solution.shape), distance, load)
