"""Frequencies that a bearing shows in vibration: of its cage, of balls passing a point of either raceway, of ball spin.

    cage  omega_m/(2 pi)       outer pass  Z |omega_m - omega_o|/(2 pi)       inner pass  Z |omega_i - omega_m|/(2 pi)
    ball  |omega_o - omega_m| (1 + g cos ao)/g/(2 pi): how often the ball's surface rolls round on the outer raceway

The textbook takes both contact angles at the nominal one. Loaded angles differ: in motors with axially sprung
deep-groove bearings (CWRU data, 6205 and 6203) that alone moves the ball-pass frequencies by 0.25 to 0.45 %.

Range: no skidding. A cage under light load runs some tenths of a per cent slower (0.3 to 0.6 % on the MFPT rig).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from qsbearing.readings.ball_motion import gamma, orbit_at_equal_angles, orbital_speed, ring_speeds
from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.solution import Solution


@dataclass(frozen=True)
class FrequencySet:
    """Frequencies of each case; arrays of shape (*cases) [Hz]."""

    cage: NDArray
    """Of the cage about the bearing axis: the mean of the balls' orbits."""
    ball_pass_inner: NDArray
    """Balls passing a point of the inner raceway (BPFI)."""
    ball_pass_outer: NDArray
    """Balls passing a point of the outer raceway (BPFO)."""
    ball_spin: NDArray
    """The ball's rolling turns; a defect of the ball strikes both raceways once a turn, that is at twice this (BSF)."""


@dataclass(frozen=True)
class Frequencies:
    """Of the solved contact angles, and beside them the textbook's."""

    solved: FrequencySet
    """NaN where a case is not solved or no ball touches both raceways."""
    nominal: FrequencySet
    """At the nominal contact angle: the free one, or zero for deep groove."""
    orbit_spread: NDArray
    """(fastest - slowest)/mean orbital speed of the balls that touch both raceways: what the cage takes up [-]."""


def frequencies(solution: Solution) -> Frequencies:
    """Frequencies of every case from the solved contact angles, and the textbook's."""
    numbers = BearingNumbers(solution.scene.bearing)
    inner, outer = ring_speeds(solution)
    g = gamma(solution)
    orbit = orbital_speed(solution)
    carries = (solution.inner.load > 0.0) & (solution.outer.load > 0.0)
    rolled = g * np.cos(np.where(carries, solution.outer.angle, 0.0))
    solved = _set(numbers.ball_count, g, inner, outer, np.where(carries, orbit, np.nan), rolled, solution.shape)
    cosine = g * np.cos(numbers.nominal_angle[..., None])
    nominal_orbit = orbit_at_equal_angles(cosine, inner, outer)
    nominal = _set(numbers.ball_count, g, inner, outer, nominal_orbit, cosine, solution.shape)
    high, low = (np.where(carries, orbit, sign * np.inf) for sign in (-1.0, 1.0))
    with np.errstate(invalid="ignore", divide="ignore"):
        spread = (high.max(axis=-1) - low.min(axis=-1)) / np.abs(2.0 * pi * solved.cage)
    return Frequencies(solved, nominal, np.where(np.isfinite(spread), spread, np.nan))


def _set(
    count: NDArray,
    g: NDArray,
    inner: NDArray,
    outer: NDArray,
    orbit: NDArray,
    gamma_cosine: NDArray,
    shape: tuple[int, ...],
) -> FrequencySet:
    """The four frequencies of orbits (*cases, ball), means over the balls that have one."""
    cage = _mean(orbit)
    spin = _mean(np.abs(outer - orbit) * (1.0 + gamma_cosine) / g)
    turns = [cage, count * np.abs(inner[..., 0] - cage), count * np.abs(cage - outer[..., 0]), spin]
    return FrequencySet(*(np.broadcast_to(value / (2.0 * pi), shape) for value in turns))


def _mean(values: NDArray) -> NDArray:
    """Mean over the balls that have a number; NaN where none has."""
    exists = np.isfinite(values)
    count = exists.sum(axis=-1)
    total = np.where(exists, values, 0.0).sum(axis=-1)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)
