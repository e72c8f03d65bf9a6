"""Balls of unequal diameters: each ball's deviation from the bearing's ball diameter.

Source        geometry; Harris & Kotzalas on contact deformation
Equation      D_j = D + deviation_j between grooves that stay where they are. Contact lines of a ball are ri - D_j/2 and
              ro - D_j/2 long, so that its two approaches together grow by the deviation; f = r/D_j, Hertz's constants,
              m ~ D_j^3, J = m D_j^2/10 and g = D_j/dm are those of its own diameter
Assumes       round balls, a deviation known for every one. The bearing's own lengths stay the nominal ones: the free
              contact angle at which curvatures may be taken, the pitch circle as the radius of orbits, the datum of the
              axial displacement. Readings other than the contacts (life, film, frequencies) take the nominal diameter,
              from which a micrometre on 22 mm is 5e-5
When not      a whole set that is larger or smaller alike: give the bearing that ball diameter
Parameters    deviations, of as many balls as the bearing has, the first at the first azimuth
Indicator     the largest change of a ball's approach, beyond what the ring's moving makes up for, over its approach
Example       BallDiameterDeviations(deviations=[0.5 * um] + 15 * [0.0])
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.described import given_in
from qsbearing.model.effects.entry import QUANTITIES, Entry, Errors, effect, error_in, given
from qsbearing.model.effects.operating_point import SMALLEST_ANGLE, OperatingPoint
from qsbearing.model.operation import Operation
from qsbearing.model.validation import LENGTH, ErrorDetail, Field, Sentence, first, numeric, raise_if_any, unit_mistake

LARGEST_DEVIATION = 0.01
"""Of the ball diameter: a hundred times the worst lot of balls; it catches mistakes of unit."""


@dataclass(frozen=True)
class BallDiameterDeviations:
    """Ask for balls of unequal diameters.

    Raises:
        SceneError: not numbers, one for each ball.
    """

    deviations: ArrayLike = field(metadata=given_in("um", is_list=True))
    """Each ball's diameter less the bearing's, cold, shape (*cases, ball) [m]."""
    name: ClassVar[str] = "unequal_balls"
    of_each_ball: ClassVar[tuple[str, ...]] = ("deviations",)

    def __post_init__(self) -> None:
        field = f"{self.name}.deviations"
        array, errors = numeric(field, self.deviations, LENGTH)
        if array is not None and array.ndim == 0:
            same = "One number for each ball; if all balls differ alike, change {diameter}"
            cause = Sentence(same, diameter=Field("bearing.ball_diameter"))
            errors.append(ErrorDetail(field, "is a single number", float(array), LENGTH, cause=cause))
        raise_if_any([_of_cases(error) for error in errors])

    @property
    def array(self) -> NDArray:
        """(*cases, ball) [m]."""
        return np.asarray(self.deviations, float)

    def errors(self, bearing: BallBearing) -> list[ErrorDetail]:
        """What does not suit this bearing: another number of balls, deviations too large, balls as wide as grooves."""
        field, array = f"{self.name}.deviations", self.array
        count = np.asarray(bearing.ball_count)
        others = count != array.shape[-1]
        if others.any():
            balls = " or ".join(f"{each:g}" for each in np.unique(count))
            problem = f"has {array.shape[-1]} numbers; the bearing has {balls} balls"
            cause = "Give one for each ball" if others.all() else "Ball counts that vary go without deviations"
            return [ErrorDetail(field, problem, cause=cause, where=others)]
        diameter = np.asarray(bearing.ball_diameter, float)[..., None]
        groove = np.minimum(bearing.inner_groove_radius, bearing.outer_groove_radius)
        widest = (2.0 * np.asarray(groove, float))[..., None] - diameter
        for size, limit, problem in (
            (np.abs(array), LARGEST_DEVIATION * diameter, f"is more than {LARGEST_DEVIATION:.0%} of the ball diameter"),
            (array, np.maximum(widest, 0.0), "makes a ball as wide as a groove"),
        ):
            beyond = size >= limit
            if beyond.any():
                worst, most = first(beyond, array, limit)
                cause = unit_mistake(worst, LENGTH, -most, most)
                return [
                    ErrorDetail(field, problem, worst, LENGTH, (-most, most), cause, np.asarray(beyond.any(axis=-1)))
                ]
        return []

    def at_rest(self, fitted: bool) -> BallDiameterDeviations:
        """What of it a bearing has at rest and cold, before or after fitting: all."""
        return self

    def reshape(self, bearing: BallBearing, operation: Operation) -> BallBearing:
        """The bearing as it is: its own lengths are the nominal ones."""
        return bearing


def _of_cases(error: ErrorDetail) -> ErrorDetail:
    """The error, told by case in place of by ball."""
    if error.where is None:
        return error
    where = np.asarray(error.where.any(axis=-1))
    return replace(error, where=where)


@kernel
def from_own_touching(a1: float, a2: float, excess: float, sin_free: float, cos_free: float) -> tuple[float, float]:
    """The inner groove centre's displacement from where a ball larger by `excess` touches at the free angle.

    Its contact lines are shorter by as much, so it touches with the groove centres that much closer along the line.
    """
    return a1 + excess * sin_free, a2 + excess * cos_free


def _deviations(point: OperatingPoint) -> NDArray | None:
    """Those asked for (*cases, ball); None without any."""
    deviations = [one for one in point.full_scene.ring_effects if isinstance(one, BallDiameterDeviations)]
    return np.broadcast_to(deviations[0].array, point.load.shape) if deviations else None


def _errors(point: OperatingPoint) -> Errors:
    """To first order: each ball's spring is compressed by its deviation, and the ring moves by its compliance until its
    free channels feel nothing of that; what is left changes approaches and loads.

    At rest the spring is k = 1.5 Q/delta over both approaches. Where the contact angles differ by phi, by inertia, more
    load also pushes the ball sideways, which the contacts resist by 2 k sin(phi/2)^2 and by turning, Q/l, l = BD/2.
    """
    deviations = _deviations(point)
    if deviations is None:
        return {name: np.zeros(point.solution.shape) for name in QUANTITIES}
    solution, load = point.solution, point.load
    distance = np.asarray(point.bearing.groove_centre_distance, float)[..., None]
    approach = np.where(load > 0.0, solution.inner.approach + solution.outer.approach, np.inf)
    half_turn = np.sin(0.5 * np.nan_to_num(solution.inner.angle - solution.outer.angle))
    spring = 1.5 * load / approach
    sideways = 2.0 * spring * half_turn**2 + 2.0 * load / distance + np.finfo(float).tiny
    softening = 2.0 * spring * half_turn**2 / sideways
    spring = spring / (1.0 + softening)
    along, across = _by_ring(point)
    force = (spring * deviations)[..., None] * along
    moved = -np.einsum("...pq,...q->...p", np.nan_to_num(solution.compliance), force.sum(axis=-2))
    change = spring * (deviations + np.einsum("...jp,...p->...j", along, moved))
    turn = np.abs(np.einsum("...jp,...p->...j", across, moved)) / distance
    turn += 2.0 * np.abs(change * half_turn) / sideways / distance
    lever = np.asarray(point.bearing.inner_groove_centre_radius, float)[..., None]
    lengths = np.concatenate([moved[..., :3], moved[..., 3:] * lever], axis=-1)
    size = np.maximum(point.at_largest_load(approach), np.abs(solution.displacement[..., :3]).max(axis=-1))
    largest = np.maximum(point.largest_load, np.finfo(float).tiny)
    own = point.over_load(np.ones_like(largest)) * change
    held = spring[..., None] * along**2
    stiffer = np.abs((own[..., None] * held).sum(axis=-2)) + ((np.abs(own) * softening)[..., None] * held).sum(axis=-2)
    stiffer = stiffer / 3.0 / np.maximum(held.sum(axis=-2), np.finfo(float).tiny)
    angle = np.maximum(np.abs(point.angle), SMALLEST_ANGLE)
    return {
        "contact_angle": np.where(point.is_heavy, turn, 0.0).max(axis=-1) / angle,
        "load": np.abs(change).max(axis=-1) / largest,
        "pressure": (np.abs(own) * np.cbrt(load / largest[..., None])).max(axis=-1) / 3.0,
        "displacement": np.abs(lengths).max(axis=-1) / size,
        "stiffness": stiffer.max(axis=-1),
    }


def _by_ring(point: OperatingPoint) -> tuple[NDArray, NDArray]:
    """How each channel of the ring lengthens each ball's contact line, and moves its end across (*cases, ball, 5)."""
    angle, azimuth = np.nan_to_num(point.solution.inner.angle), np.nan_to_num(point.solution.azimuth)
    lever = np.asarray(point.bearing.inner_groove_centre_radius, float)[..., None]
    zero, one = np.zeros_like(angle), np.ones_like(angle)
    axial = np.stack([one, zero, zero, lever * np.sin(azimuth), -lever * np.cos(azimuth)], axis=-1)  # (19.3)
    radial = np.stack([zero, np.cos(azimuth), np.sin(azimuth), zero, zero], axis=-1)  # (19.4)
    sine, cosine = np.sin(angle)[..., None], np.cos(angle)[..., None]
    return sine * axial + cosine * radial, cosine * axial - sine * radial


ENTRY = Entry(
    "unequal_balls",
    "the unequal diameters of the balls",
    effect("ring_effects", BallDiameterDeviations),
    indicator=error_in("pressure", _errors, 2.0),
    errors=_errors,
    needs=given(BallDiameterDeviations, ", a number for each ball"),
    goes_with_friction=False,
)
