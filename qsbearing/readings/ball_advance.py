"""How far balls run ahead of and behind a cage that turns evenly: what its pockets must leave free.

At the solved contact angles each ball passes an azimuth psi at an orbital speed omega(psi), which the balls' own speeds
give at their azimuths and a trigonometric polynomial of 1/omega in between. A turn takes T = integral of dpsi/omega; a
cage that keeps up turns at 2 pi/T, the harmonic mean, and a ball is ahead of its mean place in the cage by

    advance(psi) = psi - (2 pi/T) integral of dpsi/omega + constant,    on the arc of the pitch circle times dm/2,

the constant such that its mean vanishes: over the azimuth, and so over time, since (2 pi/T)/omega is 1 less its slope,
and a periodic function times its slope has no mean. All balls go through the same, one after another, so that from the
largest lag to the largest lead each needs the same freedom: the excursion. More than the pockets' clearance, and the
cage holds balls back and pulls others along.

Balls have inertia, and at speed do not take on the orbital speed that each azimuth asks for: this excursion is then 2
to 6 times too large (a trial with friction and inertia). How far balls are from it, momentum alone tells: the outer
ring does not take the radial load of the inner one (`ring_forces`).

For omega = m (1 + e cos psi) the mean is m sqrt(1 - e^2), and time and azimuth are related as in Kepler's equation.

The name, and the limit by the pocket's clearance, are as in the manual of MESYS ("circumferential ball advance", which
takes a constant speed between balls); makers call it ball excursion. Orbital speeds are Jones's.

Range: loads and tilts that stand still in space, balls of one diameter (else NaN), and no slip: the speeds of balls
that no cage touches. It is no force: how hard a cage pushes takes friction and time. Where balls leave the inner
raceway the speed has a kink, and eight balls tell the excursion to some per cent only.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import given_in
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.ring_forces import radial_forces
from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import mm
from qsbearing.model.validation import LENGTH, ErrorDetail, within
from qsbearing.readings.ball_motion import AXIS, orbital_speed
from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.readings.entry import Reading, ReadingTable, simply, with_arguments
from qsbearing.remarks.kinds import CHECK, Kind
from qsbearing.remarks.remark import Remark, Remarked, Remarks, remark, remarks

CLEARANCES = (1e-6, 0.1)
"""Of a pocket [m]."""
POINTS = 360
"""Around the turn, between which extremes are not looked for: of a wave once round, an excursion lacks 4e-5 at most."""
ROUNDING = 1e-12
"""Radians: less is nothing."""
AT_ONCE = 4096
"""Cases, so that a million of them take little memory."""

BALLS_PRESS_CAGE = Kind(
    "balls_press_cage", CHECK, "cage_and_grease#balls-and-their-pockets",
    "from lag to lead the balls need {excursion_mm:.3g} mm of freedom in the cage, whose pockets have "
    "{clearance_mm:.3g} mm: the cage holds balls back and pulls others along, by forces that are not computed",
)  # fmt: skip


@dataclass(frozen=True)
class BallAdvance(Remarked):
    """Arrays of shape (*cases); NaN where a ball stands, or runs against the others."""

    mean_orbital_speed: NDArray
    """Of a cage that turns evenly with the balls [rad/s]."""
    lead: NDArray
    """Largest advance, on the arc of the pitch circle [m]."""
    lag: NDArray
    """Largest lag behind the mean place, on the arc of the pitch circle [m]."""
    excursion: NDArray
    """Lead and lag together [m]."""
    advance: NDArray
    """Of the balls where they are [m]; shape (*cases, ball)."""
    pocket_use: NDArray | None
    """Excursion over the pockets' clearance [-]; None where it is not given."""
    momentum_gap: NDArray | None
    """Radial force that loads only one ring, over the radial load [-]; NaN without one; None without centrifugal
    force, or with balls of unlike diameters."""
    outer_radial_load: NDArray | None
    """What the outer ring takes [N]; None where `momentum_gap` is."""
    remarks: Remarks


@dataclass(frozen=True, kw_only=True)
class PocketClearance:
    """What `ball_advance` takes."""

    pocket_clearance: ArrayLike | None = field(default=None, metadata=given_in("mm", CLEARANCES))

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Of a clearance that there cannot be."""
        given = self.pocket_clearance
        return [] if given is None else within("pocket_clearance", given, LENGTH, *CLEARANCES)


def _pressing(excursion: NDArray, clearance: NDArray, i: int) -> Remark:
    """On balls of a case, counted along the flattened axes."""
    needed, room = (float(np.broadcast_to(each, excursion.shape).flat[i]) / mm for each in (excursion, clearance))
    return remark(BALLS_PRESS_CAGE, excursion_mm=needed, clearance_mm=room)


@with_arguments(PocketClearance)
def ball_advance(solution: Solution, given: PocketClearance) -> BallAdvance:
    """How far the balls run ahead of and behind a cage that turns evenly.

    Args:
        pocket_clearance: of the cage's pockets along the pitch circle, by how much longer they are than a ball's
            diameter [m]; None: not compared.

    Returns:
        Excursion, lead and lag of the balls.

    Raises:
        SceneError: a clearance that is none.

    Examples:
        >>> scene = qs.load_scene("b218")
        >>> operation = dataclasses.replace(scene.operation, radial_load_y=8e3, tilt_z=0.0)
        >>> solution = qs.solve(dataclasses.replace(scene, operation=operation))
        >>> print(f"{qs.readings.ball_advance(solution).excursion * 1e3:.2f} mm")
        11.13 mm
    """
    numbers = BearingNumbers(solution.scene.operating_bearing)
    radius = np.asarray(0.5 * numbers.pitch_diameter)
    speeds = np.broadcast_to(orbital_speed(solution), solution.azimuth.shape)
    mean, lead, lag, own = _of_cases(speeds, np.broadcast_to(numbers.ball_count, solution.shape))
    if solution.scene.ball_diameter_deviations is not None:  # a ball has a speed of its own
        mean, lead, lag, own = (np.full_like(each, np.nan) for each in (mean, lead, lag, own))
    lead, lag = radius * lead, radius * lag
    excursion, use = lead + lag, None
    said: Remarks = ()
    if given.pocket_clearance is not None:
        clearance = np.asarray(given.pocket_clearance, float)
        use = np.asarray(excursion / clearance)
        said = remarks([(np.where(use > 1.0, use, 0.0), partial(_pressing, excursion, clearance))], solution.shape)
    advance = radius[..., None] * own
    gap, on_outer = _of_momentum(solution)
    return BallAdvance(mean, lead, lag, excursion, advance, use, gap, on_outer, said)


def _of_momentum(solution: Solution) -> tuple[NDArray, NDArray] | tuple[None, None]:
    """Momentum gap and what the outer ring takes."""
    forces = radial_forces(solution)
    if forces is None:
        return None, None
    return forces.momentum_gap.reshape(solution.shape), forces.on_outer.reshape(solution.shape)


def _of_cases(speeds: NDArray, balls: NDArray) -> tuple[NDArray, NDArray, NDArray, NDArray]:
    """(mean orbital speed, lead, lag; advance of each ball) in radians, of cases with so many balls."""
    flat, counts = speeds.reshape(-1, speeds.shape[-1]), balls.reshape(-1)
    of_case, of_ball = np.full((3, counts.size), np.nan), np.full(flat.shape, np.nan)
    turn = 2.0 * np.pi * np.arange(POINTS) / POINTS
    for count in np.unique(counts).astype(int):
        own = flat[:, :count]
        goes_on = np.isfinite(own).all(axis=-1) & ((own > 0.0).all(axis=-1) | (own < 0.0).all(axis=-1))
        cases = np.flatnonzero((counts == count) & goes_on)
        for begin in range(0, cases.size, AT_ONCE):
            some = cases[begin : begin + AT_ONCE]
            mean, *advances = advance_over_a_turn(own[some], turn)
            along, advance = (np.where(np.abs(each) < ROUNDING, 0.0, each) for each in advances)
            of_case[:, some] = mean, along.max(axis=-1), -along.min(axis=-1)
            of_ball[some, :count] = advance
    mean, lead, lag = of_case.reshape(3, *balls.shape)
    return mean, lead, lag, of_ball.reshape(speeds.shape)


def advance_over_a_turn(speeds: NDArray, turn: NDArray) -> tuple[NDArray, NDArray, NDArray]:
    """(mean orbital speed; advance at azimuths; advance of each ball) in radians.

    Args:
        speeds: of balls evenly around the bearing; shape (..., ball) [rad/s].
        turn: azimuths from the first ball on, evenly over the turn [rad].
    """
    count = speeds.shape[-1]
    wave = np.arange(1, (count - 1) // 2 + 1)
    mean = 1.0 / (1.0 / speeds).mean(axis=-1)
    harmonics = np.fft.rfft(mean[..., None] / speeds)[..., 1 : wave.size + 1] * (2.0 / count)
    at_balls = 2.0 * np.pi * np.arange(count) / count
    along, own = ((1j / wave * harmonics @ np.exp(1j * np.outer(wave, at))).real for at in (turn, at_balls))
    return mean, along, own


ENTRY = Reading(
    name="ball_advance",
    gives="how far balls run ahead of and behind the cage, against the clearance of its pockets",
    by="Jones's orbital speeds",
    take=simply(ball_advance),
    record=PocketClearance,
    table=ReadingTable(
        example="pocket_clearance_mm = 0.3  # of the cage, along the pitch circle; left out: not compared\n",
    ),
    needs=(("load", "sine", "cosine"), (*AXIS, "centrifugal_force")),
    of_case=(
        Result("mean_orbital_speed", "rpm", "speed of a cage that keeps up with the balls"),
        Result("lead", "mm", "largest advance of a ball in front of its mean place in the cage"),
        Result("lag", "mm", "largest lag of a ball behind its mean place in the cage"),
        Result("excursion", "mm", "lead and lag together"),
        Result("pocket_use", words="excursion over the clearance of the pockets"),
        Result("momentum_gap", words="radial force that loads only one ring over the radial load"),
        Result("outer_radial_load", "N", "radial force that the outer ring takes"),
    ),
    of_ball=(Result("advance", "mm", "of the ball at its azimuth, on the arc of the pitch circle", is_signed=True),),
    scope="Lead and lag are what a cage that turns evenly must leave free; forces of the cage are not computed, nor, "
    "under raceway control, is the inertia of balls along their orbit, which makes them smaller at speed.",
)
