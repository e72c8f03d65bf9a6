"""Life under a spectrum of loads and speeds: operating points with their shares of time (Palmgren-Miner).

Source: ISO/TS 16281:2008, clause on varying conditions; A. Palmgren 1924. Each point uses up the share of life that its
revolutions are of its own life.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.solution.result_keys import Result
from qsbearing.model.validation import RATIO, ErrorDetail, raise_if_any, within
from qsbearing.readings.entry import Reading
from qsbearing.readings.rating_life import NEEDS, Life, life

WHOLE = 1e-6
"""Time shares must add up to one to this (chosen: shares are written with a few digits)."""


@dataclass(frozen=True)
class SpectrumLife:
    """Life under all operating points together; of shape (*cases) less the axis of the points."""

    life: NDArray
    """Revolutions of one ring against the other, as mixed as the spectrum [rev]."""
    duration: NDArray
    """The same as time [s]."""
    damage_share: NDArray
    """The part of the damage that each operating point does [-]; with the axis of the points."""


def spectrum_life(life: Life, time_share: ArrayLike, axis: int = -1) -> SpectrumLife:
    """Life of a bearing that runs through operating points, which are one case axis of a solution.

        1/t = sum_k q_k n_k/L_k        with q the shares of time, n the speeds, L each point's life

    L is the modified reference life where it was asked for, else a1 times the basic reference life. A point at rest
    does no damage. A point that is not solved makes the result NaN.

    Args:
        life: of a solution whose cases hold the operating points.
        time_share: q, one for each point; they add up to one.
        axis: the case axis of the points.

    Returns:
        Life of the spectrum, and each point's share of the damage.

    Raises:
        SceneError: shares that are negative, do not add up to one, or are not as many as the points.

    Examples:
        >>> scene = qs.load_scene("b218")
        >>> operation = dataclasses.replace(scene.operation, axial_load=np.array([10e3, 20e3]))
        >>> solution = qs.solve(dataclasses.replace(scene, operation=operation))
        >>> print(f"{qs.readings.spectrum_life(qs.readings.life(solution), [0.7, 0.3]).duration / 3600:.0f} h")
        4957 h
    """
    shares = np.atleast_1d(np.asarray(time_share, float))
    each = life.reference_rating_life
    points = each.shape[axis] if each.ndim else 0
    raise_if_any(_share_errors(points, time_share))
    shape = [1] * each.ndim
    shape[axis] = points
    turns = shares.reshape(shape) * np.abs(life.speed) / (2.0 * pi)
    damage = np.where(turns > 0.0, turns / each, 0.0)
    total = damage.sum(axis=axis)
    with np.errstate(divide="ignore", invalid="ignore"):
        duration = 1.0 / total
        part = damage / np.expand_dims(total, axis)
    return SpectrumLife(duration * turns.sum(axis=axis), duration, part)


def _share_errors(points: int | None, time_share: ArrayLike) -> list[ErrorDetail]:
    """Every error of the shares of so many operating points; None: not known how many."""
    errors = within("time_share", time_share, RATIO, 0.0, 1.0)
    if errors:
        return errors
    shares = np.atleast_1d(np.asarray(time_share, float))
    if points is not None and shares.shape != (points,):
        errors.append(ErrorDetail("time_share", f"has {shares.size} values for {points} operating points"))
    elif abs(shares.sum() - 1.0) > WHOLE:
        errors.append(ErrorDetail("time_share", f"adds up to {shares.sum():.6g}, not to 1", cause="Shares of the time"))
    return errors


@dataclass(frozen=True)
class SpectrumArguments:
    """What a spectrum takes."""

    time_share: ArrayLike

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Of the shares."""
        return _share_errors(None, self.time_share)


ENTRY = Reading(
    name="spectrum",
    gives="life and damage of operating points with shares of time; in Python `spectrum_life`",
    by="Palmgren",
    take=lambda solution, given, taken: spectrum_life(taken.get("life") or life(solution), given.time_share),
    record=SpectrumArguments,
    table=None,
    needs=NEEDS,
    of_case=(
        Result("life", "Mrev"),
        Result("duration", "h"),
        Result("damage_share"),
    ),
)
