"""Whether contact ellipses run over the edges of their grooves, and from which ball load on.

A groove of radius r, deep by h, ends at phi = arccos(1 - h/r) from its bottom, seen from its centre; a contact lies
there at its contact angle alpha, and its ellipse reaches r sin(phi' - alpha) = a to either side (geometry; Harris &
Kotzalas, *Essential Concepts of Bearing Technology*, put the ball's radius for r, which asks for slightly higher
shoulders). Semi-axes grow as Q^(1/3), so the edge is reached at Q (limit/a)^3.

Shoulders move with their rings: heat enlarges h and r alike, and a fit or rotation shifts groove and shoulder together,
so that phi is that of the bearing as it is drawn, and r that in operation.

Range: ellipses as of an endless groove. What the edge does to one that runs over it is in `cut_contact`: with less than
a tenth of the major axis beyond the edge, load and angle hold within 2 % and half a degree; with more, Hertz's contact
is the wrong one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from math import copysign, cos, nan, sin
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.hertz import STATIC_PRESSURE
from qsbearing.model.described import given_in
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import MPa, deg
from qsbearing.model.validation import LENGTH, ErrorDetail, Field, Sentence, first, numeric, within
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.cut_contact import edge_pressure, of_share
from qsbearing.readings.entry import Reading, ReadingTable, simply, with_arguments
from qsbearing.readings.passes import filled, of_balls, of_cases
from qsbearing.remarks.kinds import NOTE, WRONG, Kind, in_words
from qsbearing.remarks.remark import Holding, Remark, Remarked, Remarks, remark, remarks
from qsbearing.remarks.wording import Words

NEEDS = ("load", "sine", "cosine", "semi_major_axis", "semi_minor_axis", "max_pressure"), ()
SMALL, LARGE = 0.05, 0.1
"""Parts of the major axis beyond the edge: from the first on the remark has numbers, from the second on the contact is
another than Hertz's."""


@dataclass(frozen=True)
class RacewayOverrun:
    """Ellipses of one raceway against its groove's edges; arrays of shape (*cases, ball), NaN without load."""

    edge_angle: NDArray
    """Of the groove's edge from its bottom; shape (*cases) [rad]."""
    edge_distance: NDArray
    """From the ellipse's tip along the groove to its nearer edge; negative: cut off by so much [m]."""
    overrun_load: NDArray
    """Ball load at which the ellipse reaches the edge at this contact angle [N]; zero where its centre is past it."""
    share_beyond: NDArray
    """Part of the ellipse's major axis beyond the edge: 0 where it is not cut off, 1 where nothing is left [-]."""
    load_loss: NDArray
    """By what part the contact carries less than the solution's, at the same approach [-]; NaN where more than half of
    the axis is beyond the edge, as the next two."""
    load_turn: NDArray
    """Of the load, away from the edge, as its resultant moves along the groove [rad]."""
    edge_intensity: NDArray
    """K of the pressure near a sharp edge, K p0 sqrt(b/distance) [-]."""
    edge_pressure: NDArray | None
    """Largest pressure at an edge of the given radius [Pa]; `STATIC_PRESSURE` stands for all above it, where the edge
    yields. None: no radius is given, and at a sharp edge it is infinite."""


@dataclass(frozen=True)
class Overrun(Remarked):
    """Ellipses against groove edges; None for a raceway whose shoulder is not given."""

    inner: RacewayOverrun | None
    outer: RacewayOverrun | None
    remarks: Remarks


@dataclass(frozen=True, kw_only=True)
class OverrunArguments:
    """What `overrun` takes."""

    inner_shoulder_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", printed=True))
    outer_shoulder_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm", printed=True))
    inner_open_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm"))
    outer_open_diameter: ArrayLike | None = field(default=None, metadata=given_in("mm"))
    edge_radius: ArrayLike | None = field(default=None, metadata=given_in("mm"))

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """No shoulder at all, and those of the bearing that make no groove."""
        errors: list[ErrorDetail] = []
        if self.inner_shoulder_diameter is None and self.outer_shoulder_diameter is None:
            inner, outer = Field("inner_shoulder_diameter"), Field("outer_shoulder_diameter")
            cause = Sentence("Give {inner} or {outer}", inner=inner, outer=outer)
            errors.append(ErrorDetail(inner, "missing", cause=cause, detail="no shoulder is given"))
        if self.edge_radius is not None:
            errors += within("edge_radius", self.edge_radius, LENGTH, 1e-6, 0.1)
        for name, value in vars(self).items():
            if value is not None and bearing is not None and name.endswith("_diameter"):
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
        edge_radius: of the edges, tangent to the grooves where they end [m]; None: not known, no pressure at the edge.

    Returns:
        Distances of ellipse and edge; negative where it runs over.

    Raises:
        SceneError: no shoulder at all, or one that makes no groove; every error, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> shoulders = {"inner_shoulder_diameter": 116 * qs.mm, "outer_shoulder_diameter": 135 * qs.mm}
        >>> found = qs.readings.overrun(solution, **shoulders)
        >>> print(f"{found.inner.edge_distance[0] * 1e3:.2f} mm")
        0.93 mm
    """
    raceways: list[RacewayOverrun | None] = []
    said: list[Holding] = []
    for side, name, contacts, shoulder, other in (
        (INNER, "inner", solution.inner, given.inner_shoulder_diameter, given.inner_open_diameter),
        (OUTER, "outer", solution.outer, given.outer_shoulder_diameter, given.outer_open_diameter),
    ):
        if shoulder is None:
            raceways.append(None)
            continue
        raceway = _raceway(solution, contacts, side, shoulder, other, given.edge_radius)
        said += _remarks(name, raceway)
        raceways.append(raceway)
    return Overrun(raceways[0], raceways[1], remarks(said, solution.shape))


def _cut(fields: Mapping[str, Any], words: Words) -> str:
    """A contact cut by the edge, with as many of its numbers as there are."""
    said = f"the ellipse of {fields['raceways']:an} contact runs over the groove's edge"
    if "beyond_percent" not in fields:
        return f"{said}: pressure there exceeds Hertz's"
    written = lambda name: in_words(fields[name], ".2g")  # noqa: E731
    said += f", with {written('beyond_percent')} % of its major axis: "
    is_small = "turn_deg" not in fields
    if np.max(fields["beyond_percent"]) >= 10.0:
        said += "it is no longer Hertz's contact; " + "most of it is beyond the edge" * is_small
    elif is_small:
        return f"{said}load and angle hold, and the pressure rises at the edge"
    if not is_small:
        said += (
            f"at the same approach it carries {written('load_loss_percent')} % less load, which acts "
            f"{written('turn_deg')} deg farther from the edge; "
        )
        if "edge_pressure_MPa" not in fields:
            return f"{said}at a sharp edge the pressure has no limit"
        pressure = fields["edge_pressure_MPa"]
        above = "above " if np.max(pressure) >= fields["limit_MPa"] else ""
        said += f"the pressure at the edge is {above}{pressure:.0f} MPa"
    return said


ELLIPSE_CUT = Kind(
    "ellipse_cut", WRONG, "limits",
    "the ellipse of {raceways:an} contact runs over the groove's edge, with {beyond_percent:.2g} % of its major "
    "axis: it is no longer Hertz's contact; at the same approach it carries {load_loss_percent:.2g} % less load, "
    "which acts {turn_deg:.2g} deg farther from the edge; the pressure at the edge is {edge_pressure_MPa:.0f} MPa",
    say=_cut,
)  # fmt: skip
ELLIPSE_CUT_LITTLE = Kind(
    "ellipse_cut_little", NOTE, "limits",
    "the ellipse of {raceways:an} contact runs over the groove's edge, with {beyond_percent:.2g} % of its major "
    "axis: load and angle hold, and the pressure rises at the edge",
    say=_cut,
)  # fmt: skip


def _remarks(name: str, raceway: RacewayOverrun) -> list[Holding]:
    """One for each of the ranges, with the numbers of the case's most cut contact."""
    share = np.nan_to_num(raceway.share_beyond)
    worst = share.max(axis=-1)

    def cut(kind: Kind, has_numbers: bool, i: int) -> Remark:
        case = np.unravel_index(i, worst.shape)
        at = (*case, int(share[case].argmax()))
        numbers = _numbers(raceway, at) if has_numbers else {}
        return remark(kind, name, beyond_percent=100.0 * float(share[at]), **numbers)

    return [
        (np.where((worst >= low) & (worst < high), worst, 0.0), partial(cut, kind, low >= SMALL))
        for kind, low, high in (
            (ELLIPSE_CUT, LARGE, np.inf), (ELLIPSE_CUT_LITTLE, SMALL, LARGE), (ELLIPSE_CUT_LITTLE, 0.0, SMALL)
        )
    ]  # fmt: skip


def _numbers(raceway: RacewayOverrun, at: tuple[Any, ...]) -> dict[str, float]:
    """What the edge does to one contact, as far as it is computed, in the units of a remark."""
    numbers = {"load_loss_percent": 100.0 * raceway.load_loss[at], "turn_deg": raceway.load_turn[at] / deg}
    if raceway.edge_pressure is not None:
        numbers |= {"edge_pressure_MPa": raceway.edge_pressure[at] / MPa, "limit_MPa": STATIC_PRESSURE / MPa}
    return {key: float(value) for key, value in numbers.items() if np.isfinite(value)}


def groove_depth(bearing: BallBearing, shoulder_diameter: ArrayLike, side: float) -> NDArray:
    """h, from a shoulder to the bottom of its groove [m]; side: INNER or OUTER."""
    centre = bearing.inner_groove_centre_radius if side < 0 else bearing.outer_groove_centre_radius
    bottom = centre + side * BearingNumbers(bearing).groove_radius(side)
    return np.asarray(side * (bottom - 0.5 * np.asarray(shoulder_diameter, float)))


def edge_angles(
    drawn: BallBearing, shoulder_diameter: ArrayLike, open_diameter: ArrayLike | None, side: float
) -> tuple[NDArray, NDArray]:
    """Of a groove's edges from its bottom, at the shoulder and at the other one [rad].

    Args:
        drawn: at rest and cold, as its shoulders are.
        open_diameter: of the other shoulder [m]; None: as high as the first.
        side: INNER or OUTER.
    """
    r = BearingNumbers(drawn).groove_radius(side)
    other = shoulder_diameter if open_diameter is None else open_diameter
    edge, far = (np.arccos(1.0 - groove_depth(drawn, each, side) / r) for each in (shoulder_diameter, other))
    return edge, far


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
    solution: Solution,
    contacts: RacewayContacts,
    side: float,
    shoulder: ArrayLike,
    other: ArrayLike | None,
    edge_radius: ArrayLike | None,
) -> RacewayOverrun:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    r = numbers.groove_radius(side)
    edge, far = edge_angles(solution.scene.bearing, shoulder, other, side)
    solution.read_at_once(*NEEDS)
    arrays = of_balls(contacts.load, contacts.sine, contacts.cosine, contacts.semi_major_axis)
    distance, load = filled(solution, 2, _fill, *of_cases(solution, r, edge, far), *arrays)
    a, b = contacts.semi_major_axis, contacts.semi_minor_axis
    with np.errstate(divide="ignore", invalid="ignore"):
        share, k = np.clip(-0.5 * distance / a, 0.0, 1.0), a / b
    loss, centre, intensity = (of_share(name, share, k) for name in ("load_loss", "centre", "intensity"))
    pressure = None
    if edge_radius is not None:
        # Numbers of cases, over the balls of each.
        modulus, rho = (np.asarray(value, float)[..., None] for value in (0.5 * numbers.effective_modulus, edge_radius))
        with np.errstate(divide="ignore", invalid="ignore"):  # NaN of a ball without load
            pressure = np.minimum(edge_pressure(intensity, contacts.max_pressure, b, modulus, rho), STATIC_PRESSURE)
    ball_radius = 0.5 * np.asarray(numbers.ball_diameter, float)[..., None]
    edges = np.broadcast_to(edge, solution.shape)
    return RacewayOverrun(edges, distance, load, share, loss, centre * a / ball_radius, intensity, pressure)


@entry(*[array_of(float)] * 3, *[array_of(float, 2)] * 4, int, int, array_of(float, 3))
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
    table=ReadingTable(
        example="""\
inner_shoulder_diameter_mm = 112
outer_shoulder_diameter_mm = 139
# edge_radius_mm = 0.2  # of the edges between groove and shoulder, for the pressure there
""",
    ),
    needs=NEEDS,
    of_case=(
        Result("inner_edge_angle", "deg", path="inner.edge_angle"),
        Result("outer_edge_angle", "deg", path="outer.edge_angle"),
    ),
    of_contact=(
        Result("edge_distance", "mm", "distance of ellipse from groove edge"),
        Result("overrun_load", "N", "load at which it reaches the edge"),
        Result("beyond_edge_percent", words="part of the major axis beyond the edge", path="share_beyond", size=0.01),
        Result(
            "edge_load_loss_percent",
            words="load that it lacks there, at the same approach",
            path="load_loss",
            size=0.01,
        ),
        Result("edge_load_turn", "deg", "turn of its load away from the edge", path="load_turn"),
        Result("edge_intensity", words="K of the pressure K p0 sqrt(b/distance) near a sharp edge"),
        Result("edge_pressure", "MPa", "largest pressure at an edge of the given radius"),
    ),
)
