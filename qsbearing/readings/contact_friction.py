"""Friction power of every contact and the bearing's torque: sliding in the ellipses, hysteresis, drag on the balls.

Each part is computed only if its coefficient is given. What is in it, and what is not: `friction_models`;
`friction_estimate` has catalogue estimates that include most of the rest.
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.contact.elliptic import second_kind
from qsbearing.model.described import given_in
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import DENSITY, RATIO, ErrorDetail, within
from qsbearing.readings.ball_drag import DRAG_COEFFICIENTS, drag_power
from qsbearing.readings.ball_motion import (
    AXIS,
    MOTION,
    contact_motion,
    control_remarks,
    motion_arrays,
    ring_speeds,
)
from qsbearing.readings.bearing_numbers import INNER, OUTER, BearingNumbers
from qsbearing.readings.ellipse_sliding import (
    deformed_radius,
    place_of_ellipse,
    sliding_table,
    tabulated_sliding_speed,
)
from qsbearing.readings.entry import Reading, ReadingTable, both_or_neither, simply, with_arguments
from qsbearing.readings.friction_models import CONTACTS, MOVED, FrictionModel
from qsbearing.readings.passes import SAME_SHAPE, filled, of_balls, of_cases
from qsbearing.remarks.balls import SOLVED, by_friction, instead_of_slip
from qsbearing.remarks.kinds import INCOMPLETE, SEE_HYPOTHESES, WRONG, Kind
from qsbearing.remarks.remark import Holding, Remarked, Remarks, remark, remarks

NEEDS = ("load", "sine", "cosine", "semi_major_axis", "semi_minor_axis", "required_friction"), AXIS


CREEP = 0.5
"""Part of the friction coefficient above which the gyroscopic moment makes balls creep; their remark says half."""
MOST_HEAT = 2.8
"""Heat by a balance of friction over that by raceway control: the most in a trial of both; no bound is known."""
PARTS = (0.0, 1.0)
"""Of a load, or of what is stored."""

FRICTION_GIVEN_EXCEEDED = Kind(
    "friction_given_exceeded", WRONG, SEE_HYPOTHESES,
    "at {raceways:an} contact the gyroscopic moment requires more friction than the coefficient given: the ball "
    "slips, and the heat of this slip is not included",
    more=f". {SOLVED}",
    setting=by_friction,
)  # fmt: skip
FRICTION_MAY_BE_LOW = Kind(
    "friction_may_be_low", INCOMPLETE, SEE_HYPOTHESES,
    "at {raceways:an} contact the gyroscopic moment requires more than half of the friction coefficient given: "
    "balls creep, and the friction may be too low, up to {times:g} times",
    more=f". {SOLVED}",
    setting=by_friction,
)  # fmt: skip


@dataclass(frozen=True)
class RacewayFriction:
    """Friction in the contacts of one raceway; arrays of shape (*cases, ball); zero without load."""

    sliding_power: NDArray
    """Of spin and differential sliding [W]."""
    spin_moment: NDArray
    """3 mu Q a E/8, what resists spin if nothing else slides (E: elliptic integral of the second kind); where friction
    moves the balls, its moment about the normal [N m]."""
    hysteresis_power: NDArray | None
    """Of elastic hysteresis in rolling [W]; None without its loss factor."""

    @property
    def power(self) -> NDArray:
        """All of it [W]: the heat that this contact makes."""
        return self.sliding_power if self.hysteresis_power is None else self.sliding_power + self.hysteresis_power


@dataclass(frozen=True)
class Friction(Remarked):
    """Friction of a solution."""

    inner: RacewayFriction
    outer: RacewayFriction
    drag_power: NDArray | None
    """Of each ball through the mixture of oil and air; shape (*cases, ball) [W]; None without its coefficients."""
    power: NDArray
    """All that is computed; shape (*cases) [W]."""
    torque: NDArray
    """power over the speed of one ring against the other; shape (*cases) [N m]; NaN at rest."""
    remarks: Remarks
    models: tuple[FrictionModel, ...] = (CONTACTS,)
    """What it contains, its range, and its use."""


@dataclass(frozen=True)
class FrictionArguments:
    """What `friction` takes."""

    friction_coefficient: ArrayLike = field(metadata=given_in(range=PARTS))
    _: KW_ONLY
    hysteresis_loss: ArrayLike | None = field(default=None, metadata=given_in(range=PARTS))
    drag_coefficient: ArrayLike | None = field(default=None, metadata=given_in())
    fluid_density: ArrayLike | None = field(default=None, metadata=given_in("kg/m3"))

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything out of range, and what drag needs besides."""
        errors = within("friction_coefficient", self.friction_coefficient, RATIO, *PARTS)
        if self.hysteresis_loss is not None:
            errors += within("hysteresis_loss", self.hysteresis_loss, RATIO, *PARTS)
        return errors + both_or_neither(
            {
                "drag_coefficient": (self.drag_coefficient, RATIO, *DRAG_COEFFICIENTS),
                "fluid_density": (self.fluid_density, DENSITY, 0.0, 2e3),
            },
            "Drag needs both; leave both out for none",
        )


@with_arguments(FrictionArguments)
def friction(solution: Solution, given: FrictionArguments) -> Friction:
    """Friction of every case with raceway control's motion; where friction moves the balls, that of their balance.

        hysteresis  loss (3/16) Q b |roll|                    K. L. Johnson, Contact Mechanics, 9.3
        drag        cd rho (pi D^2/8) |omega_m dm/2|^3        a ball as wide as its disc, at its orbital speed

    Args:
        friction_coefficient: mu of Coulomb's law in all contacts; 0.03 to 0.08 with oil films, up to 0.15 without.
        hysteresis_loss: part of the elastic work that rolling loses, some per cent of it for bearing steel.
        drag_coefficient: cd of a ball between its neighbours, and
        fluid_density: rho of the mixture of oil and air [kg/m^3], both or neither.

    Returns:
        Heat and torque of all contacts.

    Raises:
        SceneError: coefficients out of range; every error, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(f"{qs.readings.friction(solution, 0.07).power:.0f} W")
        2221 W
    """
    solution.read_at_once(*NEEDS)
    inner, outer = (
        _raceway(solution, contacts, side, given.friction_coefficient, given.hysteresis_loss)
        for side, contacts in ((INNER, solution.inner), (OUTER, solution.outer))
    )
    drag = None
    of_balls, models = inner.power + outer.power, CONTACTS
    if solution.friction is not None:  # balls that are slow somewhere are there for longer
        of_balls, models = np.nan_to_num(solution.friction.weight, nan=1.0) * of_balls, MOVED
    total = of_balls.sum(axis=-1)
    if given.drag_coefficient is not None and given.fluid_density is not None:
        drag = drag_power(solution, np.asarray(given.drag_coefficient), np.asarray(given.fluid_density))
        total = total + np.nansum(drag, axis=-1)
    total = np.where(np.asarray(solution.converged), total, np.nan)
    of_inner, of_outer = ring_speeds(solution)
    speed = np.abs(of_inner - of_outer)[..., 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        torque = np.where(speed > 0.0, total / speed, np.nan)
    said = control_remarks(solution) + remarks(_found(solution, given.friction_coefficient), total.shape)
    return Friction(inner, outer, drag, total, torque, said, (models,))


def _raceway(
    solution: Solution, contacts: RacewayContacts, side: float, mu: ArrayLike, loss: ArrayLike | None
) -> RacewayFriction:
    numbers = BearingNumbers(solution.scene.operating_bearing)
    R = deformed_radius(numbers.ball_diameter, numbers.groove_radius(side))
    given = of_cases(solution, R, mu, 0.0 if loss is None else loss)
    shape = contacts.semi_major_axis, contacts.semi_minor_axis
    arrays = of_balls(contacts.load, contacts.sine, contacts.cosine, *shape)
    tables = 2 if loss is None else 3
    values = filled(solution, tables, _fill, motion_arrays(solution), sliding_table(), side, *given, *arrays)
    hysteresis = None if loss is None else values[2]
    if solution.friction is None:
        return RacewayFriction(values[0], values[1], hysteresis)
    own = solution.friction.inner if side == INNER else solution.friction.outer
    heat = np.full_like(own.heat, np.nan) if own.told_heat is None else own.told_heat
    is_loaded = contacts.load > 0.0
    return RacewayFriction(
        np.where(is_loaded, heat, 0.0), np.where(is_loaded, np.abs(own.spin_moment), 0.0), hysteresis
    )


@entry(
    MOTION, array_of(float, 4), float, *[array_of(float)] * 3, *[array_of(float, 2)] * 5, int, int, array_of(float, 3)
)  # fmt: skip
def _fill(
    motion: tuple[Any, ...], table: NDArray, side: float, radius: NDArray, mu: NDArray, loss: NDArray, load: NDArray,
    sine: NDArray, cosine: NDArray, semi_major_axis: NDArray, semi_minor_axis: NDArray,
    begin: int, stop: int, out: NDArray,
) -> None:  # fmt: skip
    """The tables of a `RacewayFriction`, hysteresis where they are three."""
    ratio_before, E, place, interval = 0.0, 0.0, 0.0, 0
    for k in range(begin, stop):
        for j in range(load.shape[1]):
            Q = load[k, j]
            if not Q > 0.0:
                for i in range(out.shape[0]):
                    out[i, k, j] = 0.0
                continue
            a, b = semi_major_axis[k, j], semi_minor_axis[k, j]
            ratio = b / a
            if abs(ratio - ratio_before) > SAME_SHAPE * ratio:
                ratio_before, E = ratio, second_kind(ratio)
                place, interval = place_of_ellipse(ratio)
            _, roll, spin = contact_motion(motion, side, sine[k, j], cosine[k, j], k, j)
            force = mu[k] * Q
            mean = tabulated_sliding_speed(table, roll * a * a / (2.0 * radius[k]), spin * a, place, interval)
            out[0, k, j] = force * mean
            out[1, k, j] = 0.375 * force * a * E
            if out.shape[0] > 2:
                out[2, k, j] = 3.0 / 16.0 * loss[k] * Q * b * abs(roll)


def _found(solution: Solution, mu: ArrayLike) -> list[Holding]:
    holding: list[Holding] = []
    if solution.friction is not None:  # which has carried the moment
        return holding
    for name, side in (("inner", solution.inner), ("outer", solution.outer)):
        if side.required_friction is not None:
            available = np.asarray(mu, float)[..., None]
            slips = (side.required_friction > available).any(axis=-1)
            creeps = (side.required_friction > CREEP * available).any(axis=-1)
            instead = instead_of_slip(solution) if creeps.any() else {}
            holding.append((slips, remark(FRICTION_GIVEN_EXCEEDED, name, **instead)))
            holding.append((creeps & ~slips, remark(FRICTION_MAY_BE_LOW, name, times=MOST_HEAT, **instead)))
    return holding


ENTRY = Reading(
    name="friction",
    gives="spin and differential sliding integrated over every ellipse; hysteresis, drag; torque, heat",
    by="Heathcote, Jones, Johnson",
    take=simply(friction),
    record=FrictionArguments,
    table=ReadingTable(
        example="friction_coefficient = 0.05\n",
    ),
    needs=NEEDS,
    of_case=(
        Result("power", "W", "power of the contacts only"),
        Result("torque", "N mm", "torque of the contacts only"),
    ),
    of_contact=(
        Result("sliding_power", "W"),
        Result("spin_moment", "N mm"),
        Result("hysteresis_power", "W"),
    ),
    of_ball=(Result("drag_power", "W"),),
)
