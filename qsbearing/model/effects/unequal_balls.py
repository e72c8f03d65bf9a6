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
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.effects.uneven_balls import uneven_entry
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


def _nearer(point: OperatingPoint, asked: BallDiameterDeviations) -> tuple[NDArray, NDArray]:
    deviations = np.broadcast_to(asked.array, point.load.shape)
    return deviations, np.zeros_like(deviations)


ENTRY = uneven_entry(
    "unequal_balls",
    "the unequal diameters of the balls",
    BallDiameterDeviations,
    ", a number for each ball",
    _nearer,
)
