"""Frequencies that a bearing shows in vibration: of its cage, of balls passing a point of either raceway, of ball spin.

    cage  omega_m/(2 pi)       outer pass  Z |omega_m - omega_o|/(2 pi)       inner pass  Z |omega_i - omega_m|/(2 pi)
    ball  |omega_o - omega_m| (1 + g cos ao)/g/(2 pi): how often the ball's surface rolls round on the outer raceway

The textbook takes both contact angles at the nominal one. Loaded angles differ: in motors with axially sprung
deep-groove bearings (CWRU data, 6205 and 6203) that alone moves the ball-pass frequencies by 0.25 to 0.45 %.

Range: no skidding. A cage under light load runs some tenths of a per cent slower (0.3 to 0.6 % on the MFPT rig).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.compiled import entry
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.ball_motion import (
    AXIS,
    MOTION,
    ball_orbit,
    gamma,
    motion_arrays,
    orbit_at_equal_angles,
    ring_speeds,
)
from qsbearing.readings.bearing_numbers import BearingNumbers
from qsbearing.readings.entry import Reading, check_solution, simply
from qsbearing.readings.passes import filled, of_balls

NEEDS = ("load", "sine", "cosine"), AXIS


@dataclass(frozen=True)
class FrequencySet:
    """Frequencies of each case; arrays of shape (*cases) [Hz]."""

    cage: NDArray
    """Of the cage about the bearing axis: the mean of the balls' orbits [Hz]."""
    ball_pass_inner: NDArray
    """Balls passing a point of the inner raceway (BPFI) [Hz]."""
    ball_pass_outer: NDArray
    """Balls passing a point of the outer raceway (BPFO) [Hz]."""
    ball_spin: NDArray
    """The ball's rolling turns [Hz]; its defect strikes both raceways once a turn, that is at twice this (BSF)."""


@dataclass(frozen=True)
class Frequencies:
    """Of the solved contact angles, and next to them the textbook's."""

    solved: FrequencySet
    """NaN where a case is not solved or no ball touches both raceways."""
    nominal: FrequencySet
    """At the nominal contact angle: the free one, or zero for deep groove."""
    orbit_spread: NDArray
    """(fastest - slowest)/mean orbital speed of the balls that touch both raceways: what the cage takes up [-];
    (*cases)."""


def frequencies(solution: Solution) -> Frequencies:
    """Frequencies of every case from the solved contact angles, and the textbook's.

    Returns:
        Frequencies [Hz] from the solved angles, and the textbook's.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(f"{qs.readings.frequencies(solution).solved.ball_pass_outer:.1f} Hz")
        1212.8 Hz
    """
    check_solution("frequencies", solution)
    numbers = BearingNumbers(solution.scene.bearing)
    inner, outer = ring_speeds(solution)
    g = gamma(solution)[..., 0]
    solution.read_at_once(*NEEDS)
    loads = of_balls(solution.inner.load, solution.outer.load)
    orbit, rolled, spread = filled(solution, 3, _add_orbits, motion_arrays(solution), *loads, of_cases=True)
    solved = _set(numbers.ball_count, inner[..., 0], outer[..., 0], orbit, rolled, solution.shape)
    cosine = g * np.cos(numbers.nominal_angle)
    nominal_orbit = orbit_at_equal_angles(cosine, inner[..., 0], outer[..., 0])
    rolled = np.abs(outer[..., 0] - nominal_orbit) * (1.0 + cosine) / g
    nominal = _set(numbers.ball_count, inner[..., 0], outer[..., 0], nominal_orbit, rolled, solution.shape)
    return Frequencies(solved, nominal, spread)


def _set(
    count: NDArray, inner: NDArray, outer: NDArray, orbit: NDArray, spin: NDArray, shape: tuple[int, ...]
) -> FrequencySet:
    """The four frequencies of an orbital speed and of the balls' rolling on the outer raceway."""
    turns = [orbit, count * np.abs(inner - orbit), count * np.abs(orbit - outer), spin]
    return FrequencySet(*(np.broadcast_to(value / (2.0 * pi), shape) for value in turns))


@entry(MOTION, array_of(float, 2), array_of(float, 2), int, int, array_of(float, 2))
def _add_orbits(
    motion: tuple[Any, ...], inner_load: NDArray, outer_load: NDArray, begin: int, stop: int, out: NDArray
) -> None:
    """Mean orbital speed, mean rolling and the orbits' spread, of the balls that touch both raceways."""
    _, gamma, _, outer_speed, _, _, outer_cosine, _, _, _ = motion
    for k in range(begin, stop):
        number, orbits, turns, fastest, slowest = 0, 0.0, 0.0, -inf, inf
        for j in range(inner_load.shape[1]):
            if not (inner_load[k, j] > 0.0 and outer_load[k, j] > 0.0):
                continue
            number += 1
            orbit = ball_orbit(motion, k, j)
            orbits += orbit
            turns += abs(outer_speed[k] - orbit) * (1.0 + gamma[k] * outer_cosine[k, j]) / gamma[k]
            fastest, slowest = max(fastest, orbit), min(slowest, orbit)
        if number == 0:
            out[0, k], out[1, k], out[2, k] = nan, nan, nan
            continue
        mean = orbits / number
        out[0, k], out[1, k] = mean, turns / number
        out[2, k] = (fastest - slowest) / abs(mean) if mean != 0.0 else nan


_NAMES = ("cage", "ball_pass_inner", "ball_pass_outer", "ball_spin")
_NOMINAL = "at the nominal contact angle"
ENTRY = Reading(
    name="frequencies",
    gives="cage, ball pass, ball spin from the solved angles, and the textbook's",
    by="no slip",
    take=simply(frequencies),
    needs=NEEDS,
    of_case=(
        *(Result(name, "Hz", path=f"solved.{name}") for name in _NAMES),
        *(Result(f"nominal_{n}", "Hz", f"{n.replace('_', ' ')}, {_NOMINAL}", path=f"nominal.{n}") for n in _NAMES),
        Result("orbit_spread", words="range of the balls' orbital speeds over their mean"),
    ),
)
