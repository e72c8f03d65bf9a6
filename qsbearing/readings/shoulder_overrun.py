"""Whether contact ellipses run over the edges of their grooves, and from which ball load on.

A groove of radius r, deep by h, ends at phi = arccos(1 - h/r) from its bottom, seen from its centre; a contact lies
there at its contact angle alpha, and its ellipse reaches r sin(phi' - alpha) = a to either side (geometry; Harris &
Kotzalas, *Essential Concepts of Bearing Technology*, put the ball's radius for r, which asks for slightly higher
shoulders). Semi-axes grow as Q^(1/3), so the edge is reached at Q (limit/a)^3.

Shoulders move with their rings: heat enlarges h and r alike, and a fit or rotation shifts groove and shoulder together,
so that phi is that of the bearing as it is drawn, and r that in operation.

Range: ellipses as of an endless groove; beyond the limit the pressure at the edge rises above Hertz's.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from math import copysign, cos, nan, sin

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.scene.keys import Key
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Shown
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import deg, mm
from qsbearing.model.validation import LENGTH, ErrorDetail, Field, Sentence, first, numeric
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.entry import Reading, Table, simply, with_arguments
from qsbearing.readings.passes import filled, of_balls, of_cases
from qsbearing.remarks.remark import Remarked, Remarks, remark, remarks

NEEDS = ("load", "sine", "cosine", "semi_major_axis"), ()


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
class Overrun(Remarked):
    """Ellipses against groove edges; None for a raceway whose shoulder is not given."""

    inner: RacewayOverrun | None
    outer: RacewayOverrun | None
    remarks: Remarks


@dataclass(frozen=True, kw_only=True)
class OverrunArguments:
    """What `overrun` takes."""

    inner_shoulder_diameter: ArrayLike | None = None
    outer_shoulder_diameter: ArrayLike | None = None
    inner_open_diameter: ArrayLike | None = None
    outer_open_diameter: ArrayLike | None = None

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """No shoulder at all, and those of the bearing that make no groove."""
        errors: list[ErrorDetail] = []
        if self.inner_shoulder_diameter is None and self.outer_shoulder_diameter is None:
            inner, outer = Field("inner_shoulder_diameter"), Field("outer_shoulder_diameter")
            cause = Sentence("Give {inner} or {outer}", inner=inner, outer=outer)
            errors.append(ErrorDetail(inner, "missing", cause=cause, detail="no shoulder is given"))
        for name, value in vars(self).items():
            if value is not None and bearing is not None:
                errors += _shoulder_errors(bearing, INNER if name.startswith("inner") else OUTER, name, value)
        return errors


@with_arguments(OverrunArguments)
def overrun(solution: Solution, given: OverrunArguments) -> Overrun:
    """Distance of every ellipse from the edges of its groove.

    Args:
        inner_shoulder_diameter, outer_shoulder_diameter: of the shoulders on the side that contact angles above zero
            lean to, at rest and cold as the bearing's own lengths [m]; one of them at least.
        inner_open_diameter, outer_open_diameter: of the other shoulders, lower in an angular-contact bearing [m];
            None: as high as the first.

    Raises:
        SceneError: no shoulder at all, or one that makes no groove; every error, at once.
    """
    found: list[RacewayOverrun | None] = []
    said = []
    for side, name, contacts, shoulder, other in (
        (INNER, "inner", solution.inner, given.inner_shoulder_diameter, given.inner_open_diameter),
        (OUTER, "outer", solution.outer, given.outer_shoulder_diameter, given.outer_open_diameter),
    ):
        if shoulder is None:
            found.append(None)
            continue
        raceway = _raceway(solution, contacts, side, shoulder, shoulder if other is None else other)
        said.append(((raceway.edge_distance < 0.0).any(axis=-1), remark("ellipse_cut", name)))
        found.append(raceway)
    return Overrun(found[0], found[1], remarks(said, solution.shape))


def groove_depth(bearing: BallBearing, shoulder_diameter: ArrayLike, side: float) -> NDArray:
    """h, from a shoulder to the bottom of its groove [m]; side: INNER or OUTER."""
    centre = bearing.inner_groove_centre_radius if side < 0 else bearing.outer_groove_centre_radius
    bottom = centre + side * BearingNumbers(bearing).groove_radius(side)
    return np.asarray(side * (bottom - 0.5 * np.asarray(shoulder_diameter, float)))


def _shoulder_errors(bearing: BallBearing, side: float, field: str, diameter: ArrayLike) -> list[ErrorDetail]:
    array, errors = numeric(field, diameter, LENGTH)
    if array is None:
        return errors
    r, depth = BearingNumbers(bearing).groove_radius(side), groove_depth(bearing, array, side)
    bad = (depth <= 0.0) | (depth > r)
    if not bad.any():
        return []
    value, shallow, radius = first(bad, np.broadcast_to(array, depth.shape), depth, np.broadcast_to(r, depth.shape))
    bottom = value + 2.0 * side * shallow
    limits = sorted((bottom, bottom - 2.0 * side * radius))
    problem = "makes no groove: a shoulder lies between the groove's bottom and its centre circle"
    return [ErrorDetail(field, problem, value, LENGTH, (limits[0], limits[1]), where=bad)]


def _raceway(
    solution: Solution, contacts: RacewayContacts, side: float, shoulder: ArrayLike, other: ArrayLike
) -> RacewayOverrun:
    drawn, r = solution.scene.bearing, BearingNumbers(solution.scene.operating_bearing).groove_radius(side)
    depths = (groove_depth(drawn, diameter, side) for diameter in (shoulder, other))
    edge, far = (np.arccos(1.0 - depth / BearingNumbers(drawn).groove_radius(side)) for depth in depths)
    solution.read_at_once(*NEEDS)
    arrays = of_balls(contacts.load, contacts.sine, contacts.cosine, contacts.semi_major_axis)
    distance, load = filled(solution, 2, _fill, *of_cases(solution, r, edge, far), *arrays)
    return RacewayOverrun(np.broadcast_to(edge, solution.shape), distance, load)


@entry
def _fill(
    radius: NDArray, edge: NDArray, far: NDArray, load: NDArray, sine: NDArray, cosine: NDArray,
    semi_major_axis: NDArray, begin: int, stop: int, out: NDArray,
) -> None:  # fmt: skip
    """Distance of each ellipse from its nearer edge, and the load that closes it."""
    for k in range(begin, stop):
        r, middle = radius[k], 0.5 * (edge[k] - far[k])
        edge_s, edge_c, far_s, far_c = sin(edge[k]), cos(edge[k]), sin(far[k]), cos(far[k])
        middle_s, middle_c = sin(middle), cos(middle)
        for j in range(load.shape[1]):
            Q = load[k, j]
            if not Q > 0.0:
                out[0, k, j], out[1, k, j] = nan, nan
                continue
            s, c, a = sine[k, j], cosine[k, j], semi_major_axis[k, j]
            # Sine and cosine of the angle to the nearer edge; more than a right angle away is as far as can be.
            if s * middle_c >= c * middle_s:
                to_s, to_c = edge_s * c - edge_c * s, edge_c * c + edge_s * s
            else:
                to_s, to_c = far_s * c + far_c * s, far_c * c - far_s * s
            limit = r * (to_s if to_c >= 0.0 else copysign(1.0, to_s))
            out[0, k, j] = limit - a
            relative = max(limit, 0.0) / a
            out[1, k, j] = Q * relative * relative * relative


ENTRY = Reading(
    name="overrun",
    gives="distance of every ellipse from the edges of its groove, and the load that closes it",
    by="geometry",
    take=simply(overrun),
    record=OverrunArguments,
    table=Table(
        keys=tuple(Key(f"{each.name}_mm", each.name, "mm", mm, LENGTH) for each in fields(OverrunArguments)),
        example="""\
inner_shoulder_diameter_mm = 112
outer_shoulder_diameter_mm = 139
""",
    ),
    needs=NEEDS,
    of_case=(
        Shown("inner_edge_angle_deg", "inner.edge_angle", deg),
        Shown("outer_edge_angle_deg", "outer.edge_angle", deg),
    ),
    of_contact=(
        Shown("edge_distance_mm", "edge_distance", mm, "distance of ellipse from groove edge"),
        Shown("overrun_load_N", "overrun_load", 1.0, "load at which it reaches the edge"),
    ),
)
