"""How near balls are to slipping: under the gyroscopic moment, and behind the drag of the oil that they go through.

Closed forms at the solved loads and angles, with one friction coefficient mu in all contacts (derived here):

    friction used     T/(mu Q), T the friction that the gyroscopic moment Mg asks for at a contact
    axis moment used  |Mg|/(mu (Qi + Qo) D/2): at 1 both contacts together hold no more
    drag used         sum of Fd over sum of mu Qi (1 + cos(ai - ao))
    least axial load  sum of sin(ai) Fd/(mu (1 + cos(ai - ao))), of balls on both raceways, at these angles

A ball that rolls passes Y cos(ai - ao) of the traction Y of its inner contact on to the outer one, so both together
hold Y (1 + cos(ai - ao)) against drag. The cage carries its balls along together: so the sums. Drag is that of the
reading `friction`, Fd = cd rho (pi D^2/8) (omega_m dm/2)^2, in oil and air: rho is the oil's density times its share of
the space, which is known as a band at best; beside it stands a maker's least axial load, A (n/1000 rpm)^2.

Range: friction used below 1/2 confirms the loads and angles of outer control, and stiffness to some 1 % (a friction
balance with Coulomb's law, 158 thrust cases: 1 % in the median, 17 % at worst); above it balls creep, and above 1 they
slip. The transition to skidding takes a factor of 2 in load, and the share of oil is an estimate.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import KW_ONLY, dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import given_in
from qsbearing.model.effects.traction import most_drag
from qsbearing.model.solution.raceway_contacts import RacewayContacts
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import rpm
from qsbearing.model.validation import DENSITY, FORCE, RATIO, ErrorDetail, within
from qsbearing.readings.ball_drag import DRAG_COEFFICIENTS, drag_force
from qsbearing.readings.ball_motion import AXIS, ring_speeds
from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.readings.entry import Reading, ReadingTable, both_or_neither, simply, with_arguments
from qsbearing.readings.lubricant import OIL_DENSITY, RANGES, OilState
from qsbearing.remarks.balls import SOLVED, by_friction, instead_of_slip
from qsbearing.remarks.kinds import CHECK, INCOMPLETE, SEE_HYPOTHESES, WRONG, Kind
from qsbearing.remarks.remark import Holding, Remarked, Remarks, remark, remarks

NEEDS = ("load", "sine", "cosine", "required_friction"), (*AXIS, "gyroscopic_moment")
COEFFICIENTS = (1e-3, 1.0)
SHARES = (0.0, 1.0)
FACTORS = (1e-6, 1e9)
"""Of makers' least loads [N]."""

AXIS_NOT_HELD = Kind(
    "axis_not_held", WRONG, SEE_HYPOTHESES,
    "the gyroscopic moment is larger than what the friction of both contacts of a ball holds with the coefficient "
    "given: balls slip, and do not turn as raceway control has it",
    more=f". {SOLVED}",
    setting=by_friction,
)  # fmt: skip
BALLS_SKID = Kind(
    "balls_skid", WRONG, SEE_HYPOTHESES,
    "with the least share of oil given, drag is larger than the friction that drives the balls: they skid",
)  # fmt: skip
BALLS_MAY_SKID = Kind(
    "balls_may_skid", INCOMPLETE, SEE_HYPOTHESES,
    "with the most oil given, though not with the least, drag is larger than the friction that drives the balls: "
    "they may skid",
)  # fmt: skip
LEAST_LOAD_MISSED = Kind(
    "least_load_missed", CHECK, SEE_HYPOTHESES,
    "the axial load is below the least one by the maker's factor: balls may skid",
)  # fmt: skip


@dataclass(frozen=True)
class RacewaySlip:
    """At the contacts of one raceway."""

    friction_used: NDArray | None
    """Friction for the gyroscopic moment over mu Q [-]; shape (*cases, ball); None without the moment."""


@dataclass(frozen=True)
class BallSlip(Remarked):
    """What of the contacts' friction is used; arrays of shape (*cases). 1: all."""

    inner: RacewaySlip
    outer: RacewaySlip
    axis_moment_used: NDArray | None
    """Of the ball that uses most [-]; None without the gyroscopic moment."""
    least_drag_used: NDArray | None
    """By the least share of oil [-]; None without shares, NaN where no ball touches the inner ring."""
    most_drag_used: NDArray | None
    """By the most [-]."""
    least_axial_load: NDArray | None
    """Against drag by the most oil [N]."""
    maker_axial_load: NDArray | None
    """A (n/1000 rpm)^2 [N]; None where A is not given."""
    maker_load_used: NDArray | None
    """That over the axial load on the ring [-]."""
    friction_coefficient: NDArray
    """mu, as given [-]."""
    remarks: Remarks


@dataclass(frozen=True)
class SlipArguments:
    """What `ball_slip` takes."""

    friction_coefficient: ArrayLike = field(metadata=given_in(range=COEFFICIENTS))
    _: KW_ONLY
    drag_coefficient: ArrayLike | None = field(default=None, metadata=given_in())
    least_oil_share: ArrayLike | None = field(default=None, metadata=given_in(range=SHARES))
    most_oil_share: ArrayLike | None = field(default=None, metadata=given_in(range=SHARES))
    oil_density: ArrayLike | None = field(default=None, metadata=given_in("kg/m3", RANGES["density"]))
    minimum_load_factor: ArrayLike | None = field(default=None, metadata=given_in("N", FACTORS))
    oil: OilState | None = None

    @property
    def density(self) -> ArrayLike:
        """Of the oil: as given here, else of the lubricant, else of an oil of which nothing is said [kg/m^3]."""
        if self.oil_density is None:
            return OIL_DENSITY if self.oil is None or self.oil.density is None else self.oil.density
        return self.oil_density

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything out of range, and what drag needs besides."""
        errors = within("friction_coefficient", self.friction_coefficient, RATIO, *COEFFICIENTS)
        errors += both_or_neither(
            {
                "drag_coefficient": (self.drag_coefficient, RATIO, *DRAG_COEFFICIENTS),
                "least_oil_share": (self.least_oil_share, RATIO, *SHARES),
                "most_oil_share": (self.most_oil_share, RATIO, *SHARES),
            },
            "Drag needs all three; leave all out for none",
        )
        errors += within("oil_density", self.density, DENSITY, *RANGES["density"])
        least, most = self.least_oil_share, self.most_oil_share
        if not errors and least is not None and most is not None and np.any(np.asarray(least) > np.asarray(most)):
            errors.append(ErrorDetail("least_oil_share", "is above most_oil_share", cause="Swap the two"))
        if self.minimum_load_factor is not None:
            errors += within("minimum_load_factor", self.minimum_load_factor, FORCE, *FACTORS)
        return errors


@with_arguments(SlipArguments)
def ball_slip(solution: Solution, given: SlipArguments) -> BallSlip:
    """What of the contacts' friction the gyroscopic moment and drag use.

    Args:
        friction_coefficient: mu of all contacts; 0.03 to 0.1 is usual.
        drag_coefficient: cd of a ball between its neighbours, with
        least_oil_share: of the space that the balls go through, and
        most_oil_share: all three, or none.
        oil_density: [kg/m^3]; None: that of
        oil: the lubricant at its temperature; without one 870 kg/m^3.
        minimum_load_factor: a maker's A, the least axial load at 1000 rpm [N].

    Returns:
        What each contact is asked for, over what it can carry.

    Raises:
        SceneError: numbers out of range; every error, at once.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> slip = qs.readings.ball_slip(solution, 0.07)
        >>> print(f"{slip.inner.friction_used[0]:.2f}")
        0.00
    """
    solution.read_at_once(*NEEDS)
    mu = np.asarray(given.friction_coefficient, float)
    inner, outer = (RacewaySlip(_used(side, mu)) for side in (solution.inner, solution.outer))
    moment = _axis_moment(solution, mu)
    least, most, least_load = _drag(solution, given, mu)
    maker = None if given.minimum_load_factor is None else _maker_load(solution, np.asarray(given.minimum_load_factor))
    with np.errstate(divide="ignore", invalid="ignore"):
        of_load = None if maker is None else np.asarray(maker / np.abs(solution.load[..., 0]))
    said = remarks(_found(solution, moment, least, most, of_load), solution.shape)
    return BallSlip(inner, outer, moment, least, most, least_load, maker, of_load, mu, said)


def _used(contacts: RacewayContacts, mu: NDArray) -> NDArray | None:
    required = contacts.required_friction
    return None if required is None else np.asarray(required / mu[..., None])


def _axis_moment(solution: Solution, mu: NDArray) -> NDArray | None:
    """|Mg| over what friction holds, of the ball that uses most."""
    if solution.gyroscopic_moment is None:
        return None
    radius = 0.5 * np.asarray(BearingNumbers(solution.scene.operating_bearing).ball_diameter)
    held = (mu * radius)[..., None] * (solution.inner.load + solution.outer.load)
    return np.asarray(np.fmax.reduce(_ratio(np.abs(solution.gyroscopic_moment), held), axis=-1))


def _drag(
    solution: Solution, given: SlipArguments, mu: NDArray
) -> tuple[NDArray, NDArray, NDArray] | tuple[None, None, None]:
    """Drag used by the least and the most oil, and the least axial load by the most."""
    cd, low, high = given.drag_coefficient, given.least_oil_share, given.most_oil_share
    if cd is None or low is None or high is None:
        return None, None, None
    inner, outer = solution.inner, solution.outer
    touches, parallel = inner.load > 0.0, inner.cosine * outer.cosine + inner.sine * outer.sine
    at_load = most_drag(mu[..., None], 1.0, parallel)
    held = np.where(touches, at_load * inner.load, 0.0).sum(axis=-1)
    # Of oil alone; its share is a factor.
    drag = drag_force(solution, np.asarray(cd, float), np.asarray(given.density, float))
    used = _ratio(np.nansum(drag, axis=-1), held)
    load = np.where(touches, np.abs(inner.sine * drag) / at_load, 0.0).sum(axis=-1)
    solved = np.where(np.asarray(solution.converged), 1.0, np.nan)
    least, most = (solved * np.asarray(share, float) for share in (low, high))
    return np.asarray(least * used), np.asarray(most * used), np.asarray(most * load)


def _maker_load(solution: Solution, factor: NDArray) -> NDArray:
    inner, outer = ring_speeds(solution)
    return np.broadcast_to(factor * ((inner - outer)[..., 0] / (1000.0 * rpm)) ** 2, solution.shape)


def _ratio(used: NDArray, held: NDArray) -> NDArray:
    """NaN where nothing holds."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(held > 0.0, used / held, np.nan))


def _found(
    solution: Solution, moment: NDArray | None, least: NDArray | None, most: NDArray | None, of_load: NDArray | None
) -> Iterator[Holding]:
    if moment is not None:
        yield moment > 1.0, lambda i: remark(AXIS_NOT_HELD, **instead_of_slip(solution))
    if least is not None and most is not None:
        yield least > 1.0, remark(BALLS_SKID)
        yield (least <= 1.0) & (most > 1.0), remark(BALLS_MAY_SKID)
    if of_load is not None:
        yield of_load > 1.0, remark(LEAST_LOAD_MISSED)


ENTRY = Reading(
    name="ball_slip",
    gives="what of the contacts' friction the gyroscopic moment and drag use; least axial load against skidding",
    by="closed forms, derived in its file",
    take=simply(ball_slip),
    record=SlipArguments,
    table=ReadingTable(example="friction_coefficient = 0.05\n"),
    needs=NEEDS,
    of_case=(
        Result("axis_moment_used", words="gyroscopic moment over what friction holds"),
        Result("least_drag_used", words="drag over the friction that drives balls, least oil"),
        Result("most_drag_used", words="drag over the friction that drives balls, most oil"),
        Result("least_axial_load", "N", "least axial load against skidding, most oil"),
        Result("maker_axial_load", "N", "least axial load by the maker's factor"),
        Result("maker_load_used", words="maker's least axial load over the axial load"),
    ),
    of_contact=(Result("friction_used", words="friction for the gyroscopic moment over mu Q"),),
    scope="Balls roll as raceway control has them: a balance of friction itself is not computed. Oil of "
    f"{OIL_DENSITY:g} kg/m³ is assumed where neither this reading nor the lubricant has a density.",
)
