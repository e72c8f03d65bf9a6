"""Warnings about balls: without load, slipping, or asking for more friction than contacts offer."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import NO_CONSISTENT_CONTROL
from qsbearing.model.ranked_warning import Rank, RankedWarning, good_to_know, wrong_model
from qsbearing.model.solution.solution import Solution

Warnings = Iterator[tuple[NDArray, Callable[[int], str]]]
"""For each kind of warning: which cases of a stretch have it, and the sentence for the i-th of them."""

HYPOTHESES = "limits#hypotheses"

FRICTION_IN_DOUBT = 0.06
FRICTION_BEYOND = 0.1
"""Coefficients that lubricated steel contacts typically offer lie between these."""
FRICTION_OF_LOAD = 1.0
"""Above it friction is larger than the load that presses the contact."""
NO_FORCE = 1e-12
"""Of a case's largest contact load: less is what rounding leaves, and no load."""


def rows(array: NDArray, part: slice) -> NDArray:
    """A stretch of cases of an array (*cases, ball or channel), with zero for NaN."""
    return np.nan_to_num(array.reshape(-1, array.shape[-1])[part], nan=0.0)


def ball_warnings(solution: Solution, part: slice) -> Warnings:
    """Raceway control that contradicts itself, balls without load."""
    yield (
        (solution._results["notes"][part] & NO_CONSISTENT_CONTROL) != 0,
        lambda i: wrong_model(
            "No consistent raceway control: for some ball, whichever raceway is assumed to control it, the loads point "
            "to the other one. The last choice tried is reported.",
            HYPOTHESES,
        ),
    )
    exists = np.isfinite(solution.azimuth.reshape(-1, solution.azimuth.shape[-1])[part])
    inner, outer = rows(solution.inner.load, part), rows(solution.outer.load, part)
    least = NO_FORCE * np.maximum(inner, outer).max(axis=-1, keepdims=True)
    off_inner, off_outer = exists & (inner <= least), outer <= least
    yield (
        (off_inner & off_outer).any(axis=-1),
        lambda i: good_to_know(f"{_balls((off_inner & off_outer)[i], 'carries', 'carry')} no load.", "limits"),
    )
    yield (
        (off_inner & ~off_outer).any(axis=-1),
        lambda i: good_to_know(
            f"{_balls((off_inner & ~off_outer)[i], 'has', 'have')} left the inner raceway: only the outer raceway "
            "carries load there.",
            "limits",
        ),
    )


def _slip_warning(solution: Solution, part: slice) -> Warnings:
    moment = solution.scene.gyroscopic_moment
    if solution.slips is None or moment is None:
        return
    slips = solution.slips.reshape(-1, solution.slips.shape[-1])[part]
    given = np.broadcast_to(np.asarray(moment.friction_coefficient, float), solution.shape).reshape(-1)[part]
    sides = (solution.inner.required_friction, solution.outer.required_friction)
    asked = np.maximum(*(rows(side, part) for side in sides if side is not None))
    yield (
        np.asarray(slips.any(axis=-1)),
        lambda i: wrong_model(
            f"{_balls(slips[i], 'slips', 'slip')}: the gyroscopic moment requires a friction coefficient of "
            f"{asked[i].max():.3g}, and the contacts have {given[i]:.3g}. The ball speeds reported are those without "
            "slip.",
            HYPOTHESES,
        ),
    )


def friction_warnings(solution: Solution, part: slice) -> Warnings:
    """Friction that the gyroscopic moment asks for, and balls that slip."""
    yield from _slip_warning(solution, part)
    if solution.slips is not None:  # a coefficient is given: no need to guess what contacts offer
        return
    for name, side in (("inner", solution.inner), ("outer", solution.outer)):
        if side.required_friction is None:
            continue
        friction = rows(side.required_friction, part)

        def slipping(i: int, name: str = name, friction: NDArray = friction) -> str:
            most, balls = friction[i].max(), _ball_list(friction[i] > FRICTION_IN_DOUBT)
            is_beyond = most > FRICTION_BEYOND
            then = "expect slip" if is_beyond else "slip may begin"
            if most > FRICTION_OF_LOAD:
                then = "friction, not the contact, carries the load there, so that the ball slips"
            return RankedWarning(
                f"The gyroscopic moment requires a friction coefficient of {most:.2f} at the {name} raceway of "
                f"{balls}: {then} (typical: {FRICTION_IN_DOUBT:g} to {FRICTION_BEYOND:g}).",
                Rank.WRONG_MODEL if is_beyond else Rank.GOOD_TO_KNOW,
                HYPOTHESES,
            )

        yield friction.max(axis=-1) > FRICTION_IN_DOUBT, slipping


def _balls(which: NDArray, one: str, several: str) -> str:
    """The beginning of a sentence about some balls, with its verb in singular or plural."""
    text = _ball_list(which)
    return f"{text[0].upper()}{text[1:]} {one if which.sum() == 1 else several}"


def _ball_list(which: NDArray) -> str:
    """Some balls of a bearing, as runs of their numbers: 3 balls (no. 0, 3 to 4)."""
    numbers = np.flatnonzero(which)
    if numbers.size == which.size > 1:
        return f"all {which.size} balls"
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) != 1) + 1)
    named = ", ".join(str(run[0]) if run.size == 1 else f"{run[0]} to {run[-1]}" for run in runs)
    return f"{'1 ball' if numbers.size == 1 else f'{numbers.size} balls'} (no. {named})"
