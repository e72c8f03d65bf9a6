"""Gyroscopic moment of the balls, carried by friction at the contacts.

Source        Jones 1960; Harris & Kotzalas; Wang et al. (19.12)
Equation      Mg = J omega_R omega_m sin(beta), J = m D^2/10 (missing in the source). omega_R is signed: the ball
              rolls backwards, Mg is negative, and only then do (19.9) and (19.10) hold as printed. Each raceway
              carries its share lambda_i, lambda_o of the friction force 2 Mg/D: T = lambda Mg/D along the contact.
Assumes       without a friction coefficient no gyroscopic slip: friction can carry the force. What it would take,
              lambda |Mg|/(D Q), is part of every result; above what the contact offers (0.06 to 0.1 is typical) the
              ball slips. With one, mu, a contact carries |T| <= mu Q; the rest of Mg turns the ball about the tangent
              of its orbit, which the kinematics do not follow: orbit and attitude stay those of raceway control
When not      at rest or in radial-only contact (sin(beta) = 0) there is none, nor where a ball touches neither
              raceway and so is rolled by neither; far into slip raceway control is no hypothesis to rest on
Parameters    moment_shares: which raceway carries the friction; friction_coefficient: mu, 0 < mu <= 1, or None
Indicator     y = 2 |Mg|/(D Q) at the least load that counts: the contact angles part by y
Example       GyroscopicMoment(MomentShares.HARRIS, friction_coefficient=0.07)
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.compiler.compiled import inlined
from qsbearing.model.described import given_in
from qsbearing.model.effects.angle_difference import difference_errors
from qsbearing.model.effects.entry import Entry, Errors, effect, for_arrays, largest
from qsbearing.model.effects.operating_point import OperatingPoint
from qsbearing.model.validation import RATIO, choose, raise_if_any, within

LEAST_FRICTION = 1e-6
"""Of a coefficient: less is no contact, and zero would be no moment at all (then leave the effect out)."""


class MomentShares(StrEnum):
    """How the raceways share the gyroscopic moment, as (lambda_i, lambda_o)."""

    CONTROLLING = "controlling"
    """All on the controlling raceway: (0, 2) under outer control, (2, 0) under inner control."""
    HARRIS = "harris"
    """(0, 2) under outer control, (1, 1) otherwise."""


SHARES_CODES = {shares: code for code, shares in enumerate(MomentShares)}
_HARRIS = 1

# No bound on the friction that a contact carries: the equations as they stand.
NO_BOUND = 0.0


@dataclass(frozen=True)
class GyroscopicMoment:
    """Ask for the gyroscopic moment of the balls."""

    moment_shares: MomentShares = MomentShares.CONTROLLING
    friction_coefficient: ArrayLike | None = field(default=None, metadata=given_in())
    """The most friction that a contact carries, over its load [-]; it may span cases. None: whatever is asked."""
    name: ClassVar[str] = "gyroscopic_moment"

    def __post_init__(self) -> None:
        shares, errors = choose("moment_shares", self.moment_shares, MomentShares)
        object.__setattr__(self, "moment_shares", shares)
        if self.friction_coefficient is not None:
            meaning = "is outside its range; if it is left out, friction has no bound"
            errors += within("friction_coefficient", self.friction_coefficient, RATIO, LEAST_FRICTION, 1.0, meaning)
        raise_if_any(errors)


@inlined
def moment_shares(convention: int, inner_control: bool) -> tuple[float, float]:
    """(lambda_i, lambda_o)."""
    if not inner_control:
        return 0.0, 2.0
    return (1.0, 1.0) if convention == _HARRIS else (2.0, 0.0)


@inlined
def carried_friction(share: float, mg: float, load: float, bound: float) -> tuple[float, float, float, float]:
    """T, the friction at a contact that carries its share of the moment, as far as the bound on T/Q allows.

    Returns:
        (T, dT/dMg, dT/d share, dT/dQ).
    """
    friction = share * mg
    if bound == NO_BOUND or abs(friction) <= bound * load:
        return friction, share, mg, 0.0
    slope = bound if friction > 0.0 else -bound
    return slope * load, 0.0, 0.0, slope


@inlined
def gyroscopic_moment(
    inertia: float,
    orbit: tuple[float, float, float],
    rotation: tuple[float, float, float],
    axis: tuple[float, ...],
) -> tuple[float, float, float]:
    """Mg and its derivatives by ai and ao; rotation is omega_R/|(p, q)|, axis (p, q, p_i, q_i, p_o, q_o)."""
    speed, speed_i, speed_o = orbit
    per_length, per_length_i, per_length_o = rotation
    p, _, p_i, _, p_o, _ = axis
    across = per_length * p  # omega_R sin(beta)
    across_i = per_length_i * p + per_length * p_i
    across_o = per_length_o * p + per_length * p_o
    return (
        inertia * across * speed,
        inertia * (across_i * speed + across * speed_i),
        inertia * (across_o * speed + across * speed_o),
    )


def _over_load(point: OperatingPoint) -> NDArray:
    bearing, (rotation, attitude) = point.bearing, point.rotation
    axis = (np.sin(attitude), np.cos(attitude), 0.0, 0.0, 0.0, 0.0)
    orbit = (point.orbital_speed, 0.0, 0.0)
    moment, _, _ = for_arrays(gyroscopic_moment)(bearing.ball_inertia, orbit, (rotation, 0.0, 0.0), axis)
    return point.over_load(2.0 * np.abs(moment) / np.asarray(bearing.ball_diameter, float))


def _errors(point: OperatingPoint) -> Errors:
    is_in = any(isinstance(one, GyroscopicMoment) for one in point.scene.ball_effects)
    return difference_errors(point, np.arctan(_over_load(point)), is_in)


ENTRY = Entry(
    "gyroscopic_moment",
    "the gyroscopic moment of the balls",
    effect("ball_effects", GyroscopicMoment, GyroscopicMoment),
    indicator=largest(_over_load),
    errors=_errors,
)
