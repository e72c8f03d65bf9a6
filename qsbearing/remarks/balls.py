"""Remarks about balls: without load, slipping, asking for more friction than contacts offer, or for other orbits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects.traction import FRICTION_COEFFICIENT
from qsbearing.model.scene.moved_by_friction import friction_instead
from qsbearing.model.solution.of_cases import may_solve_alike
from qsbearing.model.solution.ring_forces import radial_forces
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.case_range import CaseRange, Subject
from qsbearing.remarks.kinds import CHECK, INCOMPLETE, NOTE, SEE_AXIS, SEE_HYPOTHESES, WRONG, Kind
from qsbearing.remarks.remark import Holding, Remark, remark
from qsbearing.remarks.wording import Words

BALLS = Subject()
SOLVED = "With {instead}, how balls turn and slip is a result"

LEAST_TYPICAL = 0.06
MOST_TYPICAL = 0.1
"""Coefficients that lubricated steel contacts typically offer lie between these."""
FRICTION_OF_LOAD = 1.0
"""Above it friction is larger than the load that presses the contact."""
NO_FORCE = 1e-12
"""Of a case's largest contact load: less is what rounding leaves, and no load."""
LARGE_GAP = 0.03
"""Of the radial load (chosen: in a trial with inertia along the orbit, radial stiffness was 4 % off in the median where
the gap is below 0.01, and 8 to 15 % above)."""
HALF = 0.5
"""Of the friction that there is: outer control is right to about 1 % in stiffness below it (158 thrust cases); the
transition to skidding takes a factor of 2 in load."""
NOTICEABLE = 1e-3
"""Of the axial load: a gap below it changes no digit that matters, however small the radial load."""


def instead_of_slip(solution: Solution, *, without_bound: bool = False) -> dict[str, str]:
    """What to write so that slip is solved for, as a value of a remark; nothing for a row of a set."""
    return friction_instead(solution.scene, without_bound=without_bound) if may_solve_alike(solution) else {}


def by_friction(values: Mapping[str, Any], words: Words) -> list[str]:
    """The same as a line to paste, where it is accepted as the scene stands."""
    return ["effects.raceway_control=friction"] if "instead" in values else []


CONTROL_INCONSISTENT = Kind(
    "control_inconsistent", WRONG, SEE_HYPOTHESES,
    "No consistent raceway control: for some ball, whichever raceway is assumed to control it, the loads point "
    "to the other one. The last choice tried is reported.",
    setting=by_friction,
)  # fmt: skip


@BALLS.tells
def _inconsistent(of: CaseRange) -> Iterator[Holding]:
    is_consistent = of.cases(of.solution.control_is_consistent, bool)
    instead = {} if is_consistent.all() else instead_of_slip(of.solution)
    yield ~is_consistent, remark(CONTROL_INCONSISTENT, **instead)


BALLS_UNLOADED = Kind("balls_unloaded", NOTE, "limits", "{balls:carries/carry} no load.")
BALLS_OFF_INNER = Kind(
    "balls_off_inner", NOTE, "limits",
    "{balls:has/have} left the inner raceway: only the outer raceway carries load there.",
)  # fmt: skip


@BALLS.tells
def _without_load(of: CaseRange) -> Iterator[Holding]:
    solution = of.solution
    exists = np.isfinite(solution.azimuth.reshape(-1, solution.azimuth.shape[-1])[of.part])
    inner, outer = of.rows(solution.inner_load), of.rows(solution.outer.load)
    if solution.opposite is not None and solution.opposite.outer is not None:
        outer = np.maximum(outer, of.rows(solution.opposite.outer.load))
    least = NO_FORCE * np.maximum(inner, outer).max(axis=-1, keepdims=True)
    off_inner, off_outer = exists & (inner <= least), outer <= least
    unloaded, off = off_inner & off_outer, off_inner & ~off_outer
    yield unloaded.any(axis=-1), lambda i: remark(BALLS_UNLOADED, balls=unloaded[i])
    yield off.any(axis=-1), lambda i: remark(BALLS_OFF_INNER, balls=off[i])


BALLS_SLIP = Kind(
    "balls_slip", WRONG, SEE_HYPOTHESES,
    "{balls:slips/slip}: the gyroscopic moment requires a friction coefficient of {required:.3g}, and the "
    "contacts have {given:.3g}. The ball speeds reported are those without slip.",
    " In place of friction_coefficient, {instead} solves for them.",
)  # fmt: skip


@BALLS.tells
def _slip(of: CaseRange) -> Iterator[Holding]:
    solution, moment = of.solution, of.solution.scene.gyroscopic_moment
    if solution.slips is None or moment is None or _is_moved(of):
        return
    slips = solution.slips.reshape(-1, solution.slips.shape[-1])[of.part]
    given = of.cases(moment.friction_coefficient)
    sides = (solution.inner.required_friction, solution.outer.required_friction)
    requested = np.maximum(*(of.rows(side) for side in sides if side is not None))
    instead = instead_of_slip(solution, without_bound=True) if slips.any() else {}
    yield (
        slips.any(axis=-1),
        lambda i: remark(BALLS_SLIP, balls=slips[i], required=requested[i].max(), given=given[i], **instead),
    )


def _is_moved(of: CaseRange) -> bool:
    """Whether friction moves the balls, so that the moment is no question of a hypothesis."""
    return bool(of.solution.scene.raceway_control == "friction")


_REQUIRES = (
    "The gyroscopic moment requires a friction coefficient of {required:.2f} at {raceways:the} raceway of {balls}: "
)
_TYPICAL = " (typical: {typical_least:g} to {typical_most:g})."
FRICTION_DOUBTFUL = Kind(
    "friction_doubtful",
    NOTE,
    SEE_HYPOTHESES,
    f"{_REQUIRES}slip may begin{_TYPICAL}",
    setting=by_friction,
)
FRICTION_BEYOND = Kind(
    "friction_beyond",
    WRONG,
    SEE_HYPOTHESES,
    f"{_REQUIRES}expect slip{_TYPICAL}",
    more=f" {SOLVED}.",
    setting=by_friction,
)
FRICTION_ABOVE_LOAD = Kind(
    "friction_above_load", WRONG, SEE_HYPOTHESES,
    f"{_REQUIRES}friction, not the contact, carries the load there, so that the ball slips{_TYPICAL}",
    more=f" {SOLVED}.",
    setting=by_friction,
)  # fmt: skip
FRICTIONS = (
    (FRICTION_DOUBTFUL, LEAST_TYPICAL, MOST_TYPICAL),
    (FRICTION_BEYOND, MOST_TYPICAL, FRICTION_OF_LOAD),
    (FRICTION_ABOVE_LOAD, FRICTION_OF_LOAD, inf),
)
"""What is said of coefficients above the first number and up to the second."""


@BALLS.tells
def _friction(of: CaseRange) -> Iterator[Holding]:
    """Where no coefficient is given, which says what contacts offer."""
    solution = of.solution
    if solution.slips is not None or _is_moved(of):
        return
    for name, side in (("inner", solution.inner), ("outer", solution.outer)):
        if side.required_friction is None:
            continue
        friction = of.rows(side.required_friction)
        largest = friction.max(axis=-1)
        instead = instead_of_slip(solution) if (friction > LEAST_TYPICAL).any() else {}
        for kind, least, most in FRICTIONS:

            def requested(
                i: int, kind: Kind = kind, name: str = name, friction: NDArray = friction, instead: Any = instead
            ) -> Remark:
                typical = {"typical_least": LEAST_TYPICAL, "typical_most": MOST_TYPICAL} | instead
                return remark(kind, name, friction[i] > LEAST_TYPICAL, required=friction[i].max(), **typical)

            yield (largest > least) & (largest <= most), requested


FRICTION_ASSUMED = Kind(
    "friction_assumed",
    NOTE,
    SEE_AXIS,
    "The friction coefficient of {assumed:g} that moves the balls is assumed.",
    setting="effects.traction.friction_coefficient={assumed:g}",
)


@BALLS.tells
def _assumed(of: CaseRange) -> Iterator[Holding]:
    motion, law = of.solution.friction, of.solution.scene.traction
    if motion is not None and (law is None or law.is_assumed):
        assumed = remark(FRICTION_ASSUMED, assumed=FRICTION_COEFFICIENT)
        yield np.isfinite(of.cases(motion.displacement[..., 0])), assumed


AXIS_CREEPS = Kind(
    "axis_creeps", NOTE, SEE_AXIS,
    "Outer control would ask for {asked_percent:.0f} % of the contacts' friction: above 50 % balls creep, above "
    "100 % they slip, and hypotheses of raceway control err.",
)  # fmt: skip
BALLS_NEAR_SKIDDING = Kind(
    "balls_near_skidding", CHECK, SEE_AXIS,
    "Drag is {used_percent:.0f} % of what drives the balls: at half the load they may skid.",
)  # fmt: skip


@BALLS.tells
def _moved(of: CaseRange) -> Iterator[Holding]:
    """Of balls that friction moves: how far from a hypothesis, and from skidding."""
    motion = of.solution.friction
    if motion is None:
        return
    margins = [each for each in (motion.least_gyroscopic_margin, motion.least_skid_margin) if each is not None]
    if not margins:  # between arched rings there is neither
        return
    gyroscopic, skid = (np.nan_to_num(1.0 / of.cases(margin)) for margin in margins)
    yield gyroscopic > HALF, lambda i: remark(AXIS_CREEPS, asked_percent=100.0 * gyroscopic[i])
    yield skid > HALF, lambda i: remark(BALLS_NEAR_SKIDDING, used_percent=100.0 * skid[i])


MOMENTUM_GAP = Kind(
    "momentum_gap", INCOMPLETE, "limits#balls-that-cannot-follow-the-azimuth",
    "The outer ring takes {outer_N:.4g} N for a radial load of {inner_N:.4g} N on the inner ring: balls cannot "
    "follow the azimuth. Radial stiffness is that against a load that turns with the cage.",
    setting=by_friction,
)  # fmt: skip


@BALLS.tells
def _momentum(of: CaseRange) -> Iterator[Holding]:
    """Rings that do not carry the same, since each azimuth is balanced for itself."""
    forces = radial_forces(of.solution, of.part)
    if forces is None:
        return
    axial = np.abs(of.cases(of.solution.load[..., 0]))
    is_open = (forces.momentum_gap > LARGE_GAP) & (forces.gap > NOTICEABLE * axial)
    instead = instead_of_slip(of.solution) if is_open.any() else {}
    yield (
        is_open,
        lambda i: remark(MOMENTUM_GAP, outer_N=forces.on_outer[i], inner_N=forces.on_inner[i], **instead),
    )
