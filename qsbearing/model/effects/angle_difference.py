"""What follows when the two contact angles of a ball differ: errors of leaving out a force that turns them.

At rest both contacts of a ball lie in one line at the angle alpha. A force across that line turns them apart by phi =
alpha_i - alpha_o, half each, while the inner ring keeps its radial place and its axial load:

    angles          phi/2, relative to alpha
    loads           Q sin(alpha) stays: phi/2 cot(alpha); pressures the third of it
    displacement    cos(alpha_i) + cos(alpha_o) stays, which moves the ring axially by BD phi^2/(8 sin(alpha)); over the
                    approach delta of both raceways
    stiffness       the ball moves sideways too, where only the turning contact lines hold it: softer by a part that
                    goes with BD/delta phi^2, averaged over the balls by their stiffness, Q^(1/3)

The powers are those of this thrust-loaded ball; the factors were fitted to 7,500 random scenes of every loading: for
errors between 0.1 % and 10 % medians of the centrifugal force within 30 % but for the displacement, and of the
gyroscopic moment within a factor of two.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import Errors
from qsbearing.model.effects.operating_point import SMALLEST_ANGLE, OperatingPoint

ANGLE, LOAD, PRESSURE, DISPLACEMENT, STIFFNESS = 0.58, 0.58, 0.35, 1.0 / 10.0, 0.4
OF_LOAD = 0.1
"""Part of the error of loads in displacement and stiffness: one contact of a ball gains what the other loses."""


def difference_errors(point: OperatingPoint, own: NDArray, is_in: bool) -> Errors:
    """Errors of leaving out what makes contact angles differ by `own` (*cases, ball) [rad]; in the scene or not."""
    solution, heavy = point.solution, point.is_heavy
    inner = np.where(heavy, np.abs(solution.inner.angle), 0.0)
    now = np.where(heavy, np.abs(solution.inner.angle - solution.outer.angle), 0.0)
    others = np.maximum(now - own, 0.0) if is_in else now
    turned = own.max(axis=-1)
    angle = np.maximum(inner.max(axis=-1) + 0.5 * turned, SMALLEST_ANGLE)
    change = own / np.maximum(np.tan(inner), 0.05)  # near alpha = 0 nothing carries the axial load that this rests on
    share = point.load / np.maximum(point.largest_load, np.finfo(float).tiny)[..., None]
    load = _bounded(LOAD * (change * share).max(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        slenderness = np.asarray(point.bearing.groove_centre_distance)[..., None] / (
            solution.inner.approach + solution.outer.approach
        )
        weight = np.where(heavy, np.cbrt(point.load), 0.0)
        softer, before = (
            np.nansum(np.where(heavy, slenderness * square * weight, 0.0), axis=-1) / weight.sum(axis=-1)
            for square in ((own + others) ** 2 - others**2, others**2)
        )
    return {
        "contact_angle": ANGLE * turned / angle,
        "load": load,
        "pressure": _bounded(PRESSURE * change.max(axis=-1) / 2.0),
        "displacement": OF_LOAD * load + DISPLACEMENT * softer,
        "stiffness": OF_LOAD * load + STIFFNESS * softer / (1.0 + STIFFNESS * before),
    }


def _bounded(change: NDArray) -> NDArray:
    """The error against the full result of a result that lacks such a part of it."""
    return np.asarray(change / (1.0 + change))


def by_friction(friction: Callable[[OperatingPoint], NDArray]) -> Callable[[OperatingPoint], Errors]:
    """Errors of friction over the load (*cases, ball) that the other raceway carries, or none.

    The contact angles then differ by more than they do already; the linear factors are medians of 2,000 random
    scenes in which Jones's criterion changes the raceway.
    """

    def errors(point: OperatingPoint) -> Errors:
        requested = friction(point)
        angle, most = np.maximum(np.abs(point.angle), SMALLEST_ANGLE), requested.max(axis=-1)
        factors = {"contact_angle": 1.0 / angle, "load": 0.25, "pressure": 0.125, "displacement": 0.2, "stiffness": 0.5}
        errors_of_angle = difference_errors(point, requested, is_in=False)
        return {name: np.maximum(factor * most, errors_of_angle[name]) for name, factor in factors.items()}

    return errors
