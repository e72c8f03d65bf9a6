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
from math import nan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.entry import Reading, check_solution, simply
from qsbearing.readings.passes import filled, of_balls, of_cases
from qsbearing.remarks.kinds import NOTE, SEE_CHOICES, Kind
from qsbearing.remarks.remark import Remarked, Remarks, remark, remarks

AXIS = ("orbital_speed", "axial_rotation", "radial_rotation")
"""Arrays of the balls that their motion in the contacts follows from."""
NEEDS = ("load", "sine", "cosine", "semi_major_axis", "max_pressure"), AXIS

CONTROL_ASSUMED = Kind(
    "control_assumed", NOTE, SEE_CHOICES, "no raceway control is named: all spin is put on the inner raceway"
)


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
class BallMotion(Remarked):
    """How the balls of a solution move."""

    orbital_speed: NDArray
    """omega_m of each ball's centre; shape (*cases, ball) [rad/s]."""
    inner: RacewayMotion
    outer: RacewayMotion
    remarks: Remarks


def kinematics(solution: Solution) -> BallMotion:
    """Rolling, spin and sliding in every contact.

    Returns:
        Rolling, spin and sliding of every contact.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(f"{qs.readings.kinematics(solution).inner.spin_speed[0]:.0f} rad/s")
        -1658 rad/s
    """
    check_solution("kinematics", solution)
    solution.read_at_once(*NEEDS)
    motion = motion_arrays(solution)
    radius = of_cases(solution, 0.5 * BearingNumbers(solution.scene.operating_bearing).ball_diameter)[0]
    inner, outer = (
        RacewayMotion(*filled(solution, 6, _fill, motion, side, radius, *contact_arrays(contacts)))
        for side, contacts in ((INNER, solution.inner), (OUTER, solution.outer))
    )
    return BallMotion(orbital_speed(solution), inner, outer, control_remarks(solution))


def contact_arrays(contacts: RacewayContacts) -> list[NDArray]:
    """(load, sine, cosine, semi-major axis, pressure) of a raceway's contacts, as passes take them."""
    shape = contacts.semi_major_axis, contacts.max_pressure
    return of_balls(contacts.load, contacts.sine, contacts.cosine, *shape)


MOTION = (bool, *[array_of(float)] * 3, *[array_of(float, 2)] * 6)
"""The kinds of `motion_arrays`."""


def motion_arrays(solution: Solution) -> tuple[Any, ...]:
    """What passes take to find the motion in a contact: `contact_motion` knows it."""
    inner, outer = ring_speeds(solution)
    numbers = of_cases(solution, gamma(solution)[..., 0], inner[..., 0], outer[..., 0])
    cosines = of_balls(solution.inner.cosine, solution.outer.sine, solution.outer.cosine)
    of_axis = solution.orbital_speed, solution.axial_rotation, solution.radial_rotation
    axis = [np.empty((0, 0)) if each is None else of_balls(each)[0] for each in of_axis]
    return solution.orbital_speed is not None, *numbers, *cosines, *axis


def control_remarks(solution: Solution) -> Remarks:
    """That raceway control was assumed, where it was."""
    return remarks([(solution.scene.raceway_control is None, remark(CONTROL_ASSUMED))], ())


def ring_speeds(solution: Solution) -> tuple[NDArray, NDArray]:
    """Of the inner and of the outer ring about +x [rad/s], with a last axis for the balls."""
    operation = solution.scene.operation
    outer = 0.0 if operation.outer_speed is None else operation.outer_speed
    return np.asarray(operation.speed, float)[..., None], np.asarray(outer, float)[..., None]


def orbital_speed(solution: Solution) -> NDArray:
    """omega_m of each ball's centre [rad/s]; shape (*cases, ball)."""
    if solution.orbital_speed is not None:
        return solution.orbital_speed
    cosine = gamma(solution) * solution.inner.cosine
    return orbit_at_equal_angles(cosine, *ring_speeds(solution))


def gamma(solution: Solution) -> NDArray:
    """g = D/dm, with a last axis for the balls."""
    numbers = BearingNumbers(solution.scene.operating_bearing)
    return np.asarray(numbers.ball_diameter / numbers.pitch_diameter)[..., None]


def orbit_at_equal_angles(gamma_cosine: NDArray, inner_speed: NDArray, outer_speed: NDArray) -> NDArray:
    """omega_m = [omega_i (1 - g cos a) + omega_o (1 + g cos a)]/2, where both contact angles are a [rad/s]."""
    return 0.5 * (inner_speed * (1.0 - gamma_cosine) + outer_speed * (1.0 + gamma_cosine))


_orbit_at_equal_angles = kernel(orbit_at_equal_angles)


@kernel
def ball_orbit(motion: tuple[Any, ...], k: int, j: int) -> float:
    """omega_m of ball j of case k [rad/s]."""
    has_axis, gamma, inner_speed, outer_speed, inner_cosine, _, _, orbit, _, _ = motion
    if has_axis:
        return float(orbit[k, j])
    return float(_orbit_at_equal_angles(gamma[k] * inner_cosine[k, j], inner_speed[k], outer_speed[k]))


@kernel
def contact_motion(
    motion: tuple[Any, ...], side: float, sine: float, cosine: float, k: int, j: int
) -> tuple[float, float, float]:
    """(entrainment speed over the ball's radius, rolling speed, spin) in the contact of ball j of case k.

    g is D/dm or, of a ball on an orbit of its own, D over its diameter, as the absence of slip outside tells it.
    """
    has_axis, gamma, inner_speed, outer_speed, _, outer_sine, outer_cosine, _, axial, radial = motion
    g, inner, outer = gamma[k], inner_speed[k], outer_speed[k]
    centre = ball_orbit(motion, k, j)
    ring = (inner if side < 0 else outer) - centre
    if not has_axis:
        return abs(ring) * (1.0 / g + side * cosine), side * ring / g, (outer - inner) * sine if side < 0 else 0.0
    along, across = axial[k, j], radial[k, j]
    roll = (along - (outer - centre)) * outer_cosine[k, j] + across * outer_sine[k, j]
    inverse = roll / (outer - centre) if roll != 0.0 else 1.0 / g
    return abs(ring) * (inverse + side * cosine), side * ring * inverse, (along - ring) * sine - across * cosine


@entry(MOTION, float, array_of(float), *[array_of(float, 2)] * 5, int, int, array_of(float, 3))
def _fill(
    motion: tuple[Any, ...], side: float, radius: NDArray, load: NDArray, sine: NDArray, cosine: NDArray,
    semi_major_axis: NDArray, max_pressure: NDArray, begin: int, stop: int, out: NDArray,
) -> None:  # fmt: skip
    """The tables of a `RacewayMotion`."""
    for k in range(begin, stop):
        for j in range(load.shape[1]):
            if not load[k, j] > 0.0:
                for i in range(6):
                    out[i, k, j] = nan
                continue
            pace, roll, spin = contact_motion(motion, side, sine[k, j], cosine[k, j], k, j)
            sliding = abs(spin) * semi_major_axis[k, j]
            out[0, k, j] = pace * radius[k]
            out[1, k, j] = roll
            out[2, k, j] = spin
            out[3, k, j] = abs(spin / roll)
            out[4, k, j] = sliding
            out[5, k, j] = 0.5 * max_pressure[k, j] * sliding


ENTRY = Reading(
    name="kinematics",
    gives="entrainment, rolling, spin, spin-to-roll, sliding speed and p·v of spin in every contact",
    by="Jones",
    take=simply(kinematics),
    needs=NEEDS,
    of_contact=(
        Result("entrainment_speed", "m/s"),
        Result("rolling_speed", "rpm", is_signed=True),
        Result("spin_speed", "rpm", is_signed=True),
        Result("spin_to_roll"),
        Result("spin_sliding_speed", "m/s"),
        Result("spin_pressure_speed", "MPa m/s", "p v of spin"),
    ),
)
