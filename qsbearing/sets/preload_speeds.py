"""Up to which speed a set keeps its preload: found by solving it over speeds, and again where it changes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from qsbearing.scene.operation import Operation
from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.set_messages import EXCESSIVE, PreloadState, capital, row_name, states
from qsbearing.sets.solve import solve_set
from qsbearing.units import rpm
from qsbearing.validation import SPEED, ErrorDetail, SceneError, within

SPEEDS = 65
"""Solved at a time: two rounds find a speed to 1/4096 of the range."""
ROUNDS = 2


@dataclass(frozen=True)
class PreloadSpeed:
    """The lowest speed at which a row's preload is no longer maintained."""

    speed: float
    """[rad/s]"""
    row: int
    """From 0; -1 where the set has no equilibrium and no row is to blame."""
    state: str
    """lost or excessive; no_equilibrium or not_converged where the set is not solved any more."""
    sentence: str


def preload_speeds(of: BearingSet, highest_speed: float, *, threads: int | None = None) -> list[PreloadSpeed]:
    """The speeds, up to the highest given, above which some row's preload is lost or excessive; lowest first.

    The set keeps its loads and all else but the speed; one number each, no arrays. A preload counts as lost below 1 %
    of that at rest, and as excessive above three times it. What changes and changes back between two of the 64 speeds
    tried is not seen.

    Returns:
        At most one of each row and state; empty where every row's preload is maintained.

    Raises:
        SceneError: a highest speed that is none, arrays in the set, or rows that all carry in one direction.
    """
    errors = within("highest_speed", highest_speed, SPEED, 1e-3, 1e7)
    if not of.is_opposed:
        cause = "Rows that carry in opposite directions press each other"
        errors.append(ErrorDetail("rows", "have no preload: all carry in one direction", cause=cause))
    if errors:
        raise SceneError(errors)
    found: dict[tuple[int, str], float] = {}
    _search(of, 0.0, float(highest_speed), ROUNDS, found, threads)
    return [_result(of, speed, *what) for what, speed in sorted(found.items(), key=lambda each: each[1])]


def _search(
    of: BearingSet, low: float, high: float, rounds: int, found: dict[tuple[int, str], float], threads: int | None
) -> None:
    """The first speed of each new state in (low, high], refined between the two speeds where it comes."""
    speeds = np.linspace(low, high, SPEEDS)
    solution = solve_set(replace(of, operation=_at(of.operation, speeds), readings={}), threads=threads)
    if solution.shape != speeds.shape:
        raise SceneError([ErrorDetail("rows", "or what acts on them has arrays: give one number each")])
    words = states(solution)
    assert words is not None  # the set is opposed
    status, faults = np.asarray(solution.status), np.asarray(solution.row_that_gives_way)
    first: dict[tuple[int, str], int] = {}
    for k in range(speeds.size):
        if status[k] != "converged":
            first.setdefault((int(faults[k]), str(status[k])), k)
        for number, word in enumerate(words[k]):
            if word in (PreloadState.LOST, PreloadState.EXCESSIVE):
                first.setdefault((number, str(word)), k)
    for what, k in first.items():
        if what in found and rounds == ROUNDS:
            continue
        if rounds > 1 and k > 0:
            inner: dict[tuple[int, str], float] = {}
            _search(of, float(speeds[k - 1]), float(speeds[k]), rounds - 1, inner, threads)
            found[what] = inner.get(what, float(speeds[k]))
        else:
            found[what] = float(speeds[k])


def _at(operation: Operation, speed: np.ndarray) -> Operation:
    return replace(operation, speed=speed)


def _result(of: BearingSet, speed: float, row: int, state: str) -> PreloadSpeed:
    at = f"{speed / rpm:.4g} rpm"
    name = capital(row_name(of.rows[row], row)) if row >= 0 else "The set"
    said = {
        str(PreloadState.LOST): f"{name} loses its preload at {at}.",
        str(PreloadState.EXCESSIVE): f"{name}: the preload is excessive, {EXCESSIVE:g} times that at rest, at {at}.",
        "no_equilibrium": f"{name} gives way at {at}: above there is no equilibrium.",
    }
    return PreloadSpeed(speed, row, state, said.get(state, f"{name}: not solved any more at {at}."))
