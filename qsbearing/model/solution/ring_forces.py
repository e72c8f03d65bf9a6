"""Radial force that the outer ring takes: not all that loads the inner one, where each azimuth is balanced for itself.

Balls are in equilibrium with their centrifugal forces Fc, e the radial direction at their azimuths, so that

    force on the outer ring = load on the inner one - G,    G = -sum of Fc e,

and under loads that stand still balls do not accelerate on average: G should be zero, and is not, since a balance at
each azimuth gives each ball an orbital speed that its inertia does not let it take on. Momentum alone says so, without
a law of friction.

Balls that friction moves are carried round with their inertia: there the force is that of their contacts, and no gap is
left.

Range: balls of one diameter; unlike ones are an unbalance that goes round, and have a sum of their own.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.friction_balance import ContactFriction, FrictionMotion
from qsbearing.model.solution.rounding import rounding_of_load, without_rounding
from qsbearing.model.solution.solution import Solution


def _on_outer(motion: FrictionMotion, azimuth: NDArray, part: slice) -> NDArray:
    """What the contacts of balls that friction moves press the outer ring with, along y and z (case, 2)."""
    both = [_on_ring(each, motion, azimuth, part) for each in motion.on_outer]
    return np.asarray(sum(both))


def _on_ring(contacts: ContactFriction, motion: FrictionMotion, azimuth: NDArray, part: slice) -> NDArray:
    """Of the contacts of one arc."""
    of_balls = contacts.load, contacts.traction, contacts.sideways, contacts.angle, motion.weight
    load, across, along, angle, weight = (each.reshape(-1, each.shape[-1])[part] for each in of_balls)
    outward, ahead = weight * (load * np.cos(angle) + across * np.sin(angle)), weight * along
    c, s = np.cos(azimuth), np.sin(azimuth)
    return np.stack([np.nansum(each, axis=-1) for each in (outward * c - ahead * s, outward * s + ahead * c)], axis=-1)


class RadialForces(NamedTuple):
    """Of flattened cases, in N; NaN where not solved."""

    on_inner: NDArray
    """The radial load."""
    on_outer: NDArray
    """What the outer ring takes of it."""
    gap: NDArray
    """|G|."""
    momentum_gap: NDArray
    """|G| over the radial load; NaN where that is none beside the axial one."""


def radial_forces(solution: Solution, part: slice = slice(None)) -> RadialForces | None:
    """On both rings, of a stretch of cases; None without centrifugal force, and for balls of unlike diameters."""
    centrifugal = solution.centrifugal_force
    if centrifugal is None or solution.ball_diameter_deviation is not None:
        return None
    force, azimuth = (each.reshape(-1, each.shape[-1])[part] for each in (centrifugal, solution.azimuth))
    gap = -np.stack([np.nansum(force * along(azimuth), axis=-1) for along in (np.cos, np.sin)], axis=-1)
    load = solution.load.reshape(-1, 5)[part, 1:3]
    if solution.friction is not None:
        gap = load - _on_outer(solution.friction, azimuth, part)
    rounding = rounding_of_load(solution.load, solution.scene.bearing)
    rounding = np.broadcast_to(rounding, solution.shape).reshape(-1)[part]
    on_inner, on_outer, size = (without_rounding(np.hypot(*each.T), rounding) for each in (load, load - gap, gap))
    share = np.divide(size, on_inner, out=np.full_like(size, np.nan), where=on_inner > 0.0)
    return RadialForces(on_inner, on_outer, size, share)
