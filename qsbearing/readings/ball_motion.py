"""How balls roll, spin and slide on their raceways at the solved contact angles.

In the frame that goes round with a ball's centre (at omega_m) the ball turns at omega_R about an axis at the attitude
angle beta, and each ring at omega - omega_m about the bearing axis. Of the ball's rotation relative to the ring, the
part along the contact's normal is spin, the part along its tangent in the ball's plane is rolling (Jones 1959; Harris &
Kotzalas, *Advanced Concepts of Bearing Technology*, 2.2), for either raceway:

    spin = omega_R sin(alpha - beta) - (omega - omega_m) sin(alpha)
    roll = omega_R cos(alpha - beta) - (omega - omega_m) cos(alpha) = +/-(omega - omega_m)/g,    g = D/dm, + outside

the latter since nothing slips at the contacts' centres. A scene without ball effects names no raceway control; its
contact angles are equal, and whatever the control, the two spins then differ by (omega_i - omega_o) sin(alpha): outer
control, which puts it all on the inner raceway, is assumed and said.

No slip at the contact's centre, so the surfaces of ball and ring pass the contact at one speed, the entrainment speed

    u = |omega - omega_m| (dm/2)(1 -/+ g cos alpha),   upper sign inside.

Range: as raceway control, which supplies beta; no skidding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from qsbearing.raceway_contacts import RacewayContacts
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.remarks import Remarks, remarks
from qsbearing.solution import Solution


@dataclass(frozen=True)
class RacewayMotion:
    """Motion in the contacts of one raceway; arrays of shape (*cases, ball), NaN where a ball does not touch it."""

    entrainment_speed: NDArray
    """u, of the surfaces through the contact [m/s]."""
    rolling_speed: NDArray
    """Of the ball on the raceway, about the contact's tangent [rad/s]."""
    spin_speed: NDArray
    """Of the ball on the raceway, about the contact's normal, positive from ball to ring outside and from ring to ball
    inside [rad/s]."""
    spin_to_roll: NDArray
    """|spin/roll| [-]."""
    spin_sliding_speed: NDArray
    """|spin| a: of spin at the tips of the ellipse [m/s]."""
    spin_pressure_speed: NDArray
    """The largest product of pressure and spin's sliding speed, p0 |spin| a/2 [Pa m/s].

    On the major axis p v = p0 sqrt(1 - x^2/a^2) |spin| x is largest at x = a/sqrt(2)."""


@dataclass(frozen=True)
class BallMotion:
    """How the balls of a solution move."""

    orbital_speed: NDArray
    """omega_m of each ball's centre; shape (*cases, ball) [rad/s]."""
    inner: RacewayMotion
    outer: RacewayMotion
    warnings: Remarks


def kinematics(solution: Solution) -> BallMotion:
    """Rolling, spin and sliding in every contact."""
    orbit = orbital_speed(solution)
    inner, outer = (_raceway(solution, orbit, *side) for side in ((INNER, solution.inner), (OUTER, solution.outer)))
    return BallMotion(orbit, inner, outer, control_remarks(solution))


def control_remarks(solution: Solution) -> Remarks:
    """That raceway control was assumed, where it was."""
    assumed = solution.scene.raceway_control is None
    return remarks([(assumed, "no raceway control is named: all spin is put on the inner raceway")], ())


def ring_speeds(solution: Solution) -> tuple[NDArray, NDArray]:
    """Of the inner and of the outer ring about +x [rad/s], with a last axis for the balls."""
    operation = solution.scene.operation
    outer = 0.0 if operation.outer_speed is None else operation.outer_speed
    return np.asarray(operation.speed, float)[..., None], np.asarray(outer, float)[..., None]


def orbital_speed(solution: Solution) -> NDArray:
    """omega_m of each ball's centre [rad/s]; shape (*cases, ball)."""
    if solution.orbital_speed is not None:
        return solution.orbital_speed
    cosine = gamma(solution) * np.cos(solution.inner.angle)
    return orbit_at_equal_angles(cosine, *ring_speeds(solution))


def gamma(solution: Solution) -> NDArray:
    """g = D/dm, with a last axis for the balls."""
    numbers = BearingNumbers(solution.scene.operating_bearing)
    return np.asarray(numbers.ball_diameter / numbers.pitch_diameter)[..., None]


def orbit_at_equal_angles(gamma_cosine: NDArray, inner_speed: NDArray, outer_speed: NDArray) -> NDArray:
    """omega_m = [omega_i (1 - g cos a) + omega_o (1 + g cos a)]/2, where both contact angles are a [rad/s]."""
    return np.asarray(0.5 * (inner_speed * (1.0 - gamma_cosine) + outer_speed * (1.0 + gamma_cosine)))


def _raceway(solution: Solution, orbit: NDArray, side: float, contacts: RacewayContacts) -> RacewayMotion:
    inner_speed, outer_speed = ring_speeds(solution)
    ring = (inner_speed if side < 0 else outer_speed) - orbit
    touches = np.where(contacts.load > 0.0, 1.0, np.nan)
    g = _gamma_of_orbit(solution, outer_speed - orbit)
    radius = 0.5 * BearingNumbers(solution.scene.operating_bearing).ball_diameter[..., None]
    entrainment = np.abs(ring) * radius * (1.0 / g + side * np.cos(contacts.angle)) * touches
    roll = side * ring / g * touches
    beta, rotation = solution.attitude_angle, solution.rotation_speed
    if beta is None or rotation is None:
        spin = (outer_speed - inner_speed) * np.sin(contacts.angle) * (1.0 if side < 0 else 0.0) * touches
    else:
        spin = (rotation * np.sin(contacts.angle - beta) - ring * np.sin(contacts.angle)) * touches
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.abs(spin / roll)
    sliding = np.abs(spin) * contacts.semi_major_axis
    return RacewayMotion(entrainment, roll, spin, ratio, sliding, 0.5 * contacts.max_pressure * sliding)


def _gamma_of_orbit(solution: Solution, outer_ring: NDArray) -> NDArray:
    """g of each ball: D/dm, or D over its own orbit's diameter, as the absence of slip outside tells it."""
    nominal = gamma(solution)
    beta, rotation = solution.attitude_angle, solution.rotation_speed
    if beta is None or rotation is None:
        return nominal
    angle = solution.outer.angle
    roll = rotation * np.cos(angle - beta) - outer_ring * np.cos(angle)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(roll != 0.0, outer_ring / roll, nominal)
