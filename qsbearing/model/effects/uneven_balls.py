"""What follows where rings come nearer at some balls than at others: errors of leaving it out, to first order.

Of unequal balls and of grooves out of round. Derived here: each ball's spring is compressed by what comes nearer, and
the ring moves by its compliance until its free channels feel nothing of that; what is left changes approaches and
loads.

At rest the spring is k = 1.5 Q/delta over both approaches. Where the contact angles differ by phi, by inertia, more
load also pushes the ball sideways, which the contacts resist by 2 k sin(phi/2)^2 and by turning, Q/l, l = BD/2.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.entry import QUANTITIES, Entry, Errors, effect, error_in, given
from qsbearing.model.effects.operating_point import SMALLEST_ANGLE, OperatingPoint

T = TypeVar("T")


def uneven_entry(
    name: str, words: str, of: type[T], needs: str, nearer: Callable[[OperatingPoint, T], tuple[NDArray, NDArray]]
) -> Entry:
    """Of an effect that brings rings nearer at some balls.

    Args:
        of: the effect among a scene's ring effects.
        needs: what it must be given, in words that follow its name.
        nearer: by how much it does, and moves aside, as `_errors` takes them.
    """

    def errors(point: OperatingPoint) -> Errors:
        there = next((one for one in point.full_scene.ring_effects if isinstance(one, of)), None)
        if there is None:
            return {name: np.zeros(point.solution.shape) for name in QUANTITIES}
        return _errors(point, *nearer(point, there))

    return Entry(
        name,
        words,
        effect("ring_effects", of),
        indicator=error_in("pressure", errors, 2.0),
        errors=errors,
        needs=given(of, needs),
        goes_with_friction=False,
    )


def _errors(point: OperatingPoint, nearer: NDArray, aside: NDArray) -> Errors:
    """Errors of leaving out what brings rings nearer at some balls.

    Args:
        nearer: by how much along the contact line of each ball, and
        aside: by how much the inner groove moves across it, axially in the main (*cases, ball) [m].
    """
    solution, load = point.solution, point.load
    distance = np.asarray(point.bearing.groove_centre_distance, float)[..., None]
    approach = np.where(load > 0.0, solution.inner.approach + solution.outer.approach, np.inf)
    half_turn = np.sin(0.5 * np.nan_to_num(solution.inner.angle - solution.outer.angle))
    spring = 1.5 * load / approach
    sideways = 2.0 * spring * half_turn**2 + 2.0 * load / distance + np.finfo(float).tiny
    softening = 2.0 * spring * half_turn**2 / sideways
    spring = spring / (1.0 + softening)
    along, across = _by_ring(point)
    force = (spring * nearer)[..., None] * along
    moved = -np.einsum("...pq,...q->...p", np.nan_to_num(solution.compliance), force.sum(axis=-2))
    change = spring * (nearer + np.einsum("...jp,...p->...j", along, moved))
    turn = np.abs(aside + np.einsum("...jp,...p->...j", across, moved)) / distance
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
