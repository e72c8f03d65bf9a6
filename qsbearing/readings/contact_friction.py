"""Friction power of every contact and the bearing's torque: sliding in the ellipses, hysteresis, drag on the balls.

Each part is computed only if its coefficient is given. What is not here: viscous rolling in the films' inlets, cage and
seals, and the slip of a gyroscopic moment that friction cannot hold; `friction_estimate` has catalogue estimates that
include most of these.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ellipe

from qsbearing.raceway_contacts import RacewayContacts
from qsbearing.readings.ball_motion import BallMotion, RacewayMotion, kinematics, ring_speeds
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.ellipse_sliding import deformed_radius, tabulated_sliding_speed
from qsbearing.readings.remarks import Remarks, remarks
from qsbearing.solution import Solution
from qsbearing.validation import DENSITY, RATIO, ErrorDetail, raise_if_any, within


@dataclass(frozen=True)
class RacewayFriction:
    """Friction in the contacts of one raceway; arrays of shape (*cases, ball); zero without load."""

    sliding_power: NDArray
    """Of spin and differential sliding [W]."""
    spin_moment: NDArray
    """3 mu Q a E/8, what resists spin if nothing else slides (E: elliptic integral of the second kind) [N m]."""
    hysteresis_power: NDArray | None
    """Of elastic hysteresis in rolling [W]; None without its loss factor."""

    @property
    def power(self) -> NDArray:
        """All of it [W]: the heat that this contact makes."""
        return self.sliding_power if self.hysteresis_power is None else self.sliding_power + self.hysteresis_power


@dataclass(frozen=True)
class Friction:
    """Friction of a solution."""

    inner: RacewayFriction
    outer: RacewayFriction
    drag_power: NDArray | None
    """Of each ball through the mixture of oil and air; shape (*cases, ball) [W]; None without its coefficients."""
    power: NDArray
    """All that is computed; shape (*cases) [W]."""
    torque: NDArray
    """power over the speed of one ring against the other; shape (*cases) [N m]; NaN at rest."""
    warnings: Remarks


def friction(
    solution: Solution,
    friction_coefficient: ArrayLike,
    *,
    hysteresis_loss: ArrayLike | None = None,
    drag_coefficient: ArrayLike | None = None,
    fluid_density: ArrayLike | None = None,
) -> Friction:
    """Friction of every case with raceway control's motion.

        hysteresis  loss (3/16) Q b |roll|                    K. L. Johnson, Contact Mechanics, 9.3
        drag        cd rho (pi D^2/8) |omega_m dm/2|^3        a ball as wide as its disc, at its orbital speed

    Args:
        friction_coefficient: mu of Coulomb's law in all contacts; 0.03 to 0.08 with oil films, up to 0.15 without.
        hysteresis_loss: part of the elastic work that rolling loses, some per cent of it for bearing steel.
        drag_coefficient: cd of a ball between its neighbours, and
        fluid_density: rho of the mixture of oil and air [kg/m^3], both or neither.

    Raises:
        SceneError: coefficients out of range; every error, at once.
    """
    arguments = {
        "friction_coefficient": friction_coefficient,
        "hysteresis_loss": hysteresis_loss,
        "drag_coefficient": drag_coefficient,
        "fluid_density": fluid_density,
    }
    raise_if_any(friction_errors(**arguments))
    motion = kinematics(solution)
    inner, outer = (
        _raceway(solution, contacts, moving, side, friction_coefficient, hysteresis_loss)
        for side, contacts, moving in ((INNER, solution.inner, motion.inner), (OUTER, solution.outer, motion.outer))
    )
    drag_power = None
    total = (inner.power + outer.power).sum(axis=-1)
    if drag_coefficient is not None and fluid_density is not None:
        drag_power = _drag(solution, motion, np.asarray(drag_coefficient), np.asarray(fluid_density))
        total = total + np.nansum(drag_power, axis=-1)
    total = np.where(np.asarray(solution.converged), total, np.nan)
    of_inner, of_outer = ring_speeds(solution)
    speed = np.abs(of_inner - of_outer)[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        torque = np.where(speed > 0.0, total / speed, np.nan)
    return Friction(
        inner,
        outer,
        drag_power,
        total,
        torque,
        motion.warnings + remarks(_found(solution, friction_coefficient), total.shape),
    )


def friction_errors(
    *,
    friction_coefficient: ArrayLike | None = None,
    hysteresis_loss: ArrayLike | None = None,
    drag_coefficient: ArrayLike | None = None,
    fluid_density: ArrayLike | None = None,
) -> list[ErrorDetail]:
    """Every error of the arguments of `friction`."""
    errors = within("friction_coefficient", friction_coefficient, RATIO, 0.0, 1.0)
    if hysteresis_loss is not None:
        errors += within("hysteresis_loss", hysteresis_loss, RATIO, 0.0, 1.0)
    drag = {"drag_coefficient": drag_coefficient, "fluid_density": fluid_density}
    for name, value in drag.items():
        if value is not None:
            most = 10.0 if name == "drag_coefficient" else 2e3
            errors += within(name, value, RATIO if name == "drag_coefficient" else DENSITY, 0.0, most)
        elif any(each is not None for each in drag.values()):
            errors.append(ErrorDetail(name, "missing", cause="Drag needs both; leave both out for none"))
    return errors


def _raceway(
    solution: Solution,
    contacts: RacewayContacts,
    moving: RacewayMotion,
    side: float,
    mu: ArrayLike,
    loss: ArrayLike | None,
) -> RacewayFriction:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    groove = numbers.inner_groove_radius if side < 0 else numbers.outer_groove_radius
    R = deformed_radius(numbers.ball_diameter, groove)[..., None]
    a, b = contacts.semi_major_axis, contacts.semi_minor_axis
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = b / a
    mean = tabulated_sliding_speed(moving.rolling_speed * a**2 / (2.0 * R), moving.spin_speed * a, ratio)
    force = np.asarray(mu, float)[..., None] * contacts.load
    sliding = np.nan_to_num(force * mean, nan=0.0)
    moment = np.nan_to_num(0.375 * force * a * ellipe(1.0 - ratio**2), nan=0.0)
    hysteresis = None
    if loss is not None:
        share = 3.0 / 16.0 * np.asarray(loss, float)[..., None]
        hysteresis = np.nan_to_num(share * contacts.load * b * np.abs(moving.rolling_speed), nan=0.0)
    return RacewayFriction(sliding, moment, hysteresis)


def _drag(solution: Solution, motion: BallMotion, coefficient: NDArray, density: NDArray) -> NDArray:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    speed = np.abs(motion.orbital_speed) * 0.5 * numbers.pitch_diameter[..., None]
    disc = 0.25 * pi * numbers.ball_diameter[..., None] ** 2
    return np.asarray(0.5 * coefficient[..., None] * density[..., None] * disc * speed**3)


def _found(solution: Solution, mu: ArrayLike) -> list[tuple[NDArray, str]]:
    found = []
    for name, side in (("inner", solution.inner), ("outer", solution.outer)):
        if side.required_friction is not None:
            slips = (np.nan_to_num(side.required_friction) > np.asarray(mu, float)[..., None]).any(axis=-1)
            more = f"the gyroscopic moment asks more friction of an {name} contact than the coefficient given"
            found.append((slips, f"{more}: that ball slips, which is not counted"))
    return found
