"""Up to which speed and how many times its loads a set keeps its preload, and what else it does, in sentences."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.documents.numbers import plain
from qsbearing.model.operation import CHANNELS
from qsbearing.model.solution.preload_state import PreloadState
from qsbearing.model.units import rpm, um
from qsbearing.model.validation import RATIO, SPEED, ErrorDetail, SceneError, check_kind, within
from qsbearing.remarks.wording import spanned
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.drives import with_torques
from qsbearing.systems.sets.preload_search import StateChange, changes, firsts, opposed_errors, sentence, together
from qsbearing.systems.sets.set_solution import SetSolution
from qsbearing.systems.sets.shaft import with_loads

LOST = str(PreloadState.LOST)
MOST = 10.0
"""Times the loads of the set: further nobody asks."""
FASTER = 1.5
"""Times the speed of the set, up to which its preload is followed."""
UNCHANGED = 0.005
"""Relative; a preload that changes by less is said to stay."""
Limits = tuple[list[StateChange], list[StateChange]]
"""Changes over speed and over loads."""


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
    of what is given, and as excessive above three times it. What changes and changes back between two of the 64 speeds
    tried is not seen, nor what comes after the first without an equilibrium.

    Returns:
        At most one of each row and state; empty where every row's preload is maintained.

    Raises:
        SceneError: a highest speed that is not positive, arrays in the set, or rows that all carry in one direction.

    Examples:
        >>> bearing = qs.load_scene("7210C").bearing
        >>> rows = qs.Row(bearing, 0.0, "+x"), qs.Row(bearing, 20 * qs.mm, "-x")
        >>> operation = qs.Operation(speed=1047.0, radial_load_y=500.0, moment_z=0.0)
        >>> pair = qs.BearingSet(rows, operation, qs.Preload(rigid=720.0))
        >>> print(qs.preload_speeds(pair, 2000.0))
        []
    """
    check_kind("preload_speeds", of, "BearingSet")
    first_changes = firsts(speed_changes(of, highest_speed, threads))
    return [PreloadSpeed(each.value, each.row, each.after, speed_sentence(of, each)) for each in first_changes]


def speed_changes(of: BearingSet, highest_speed: float, threads: int | None = None) -> list[StateChange]:
    """Everything that becomes of the preload up to this speed [rad/s], what comes back included."""
    errors = within("highest_speed", highest_speed, SPEED, 1e-3, 1e7) + opposed_errors(of)
    if errors:
        raise SceneError(errors)
    return changes(lambda speeds: set_at_speed(of, speeds), float(highest_speed), threads)


def set_at_speed(of: BearingSet, speed: ArrayLike) -> BearingSet:
    """A set at another speed of its shaft, under the loads and torques that it has at its own; without its readings."""
    shaft = with_torques(of.shaft, of.operation.speed)
    return replace(of, operation=replace(of.operation, speed=speed), shaft=shaft, readings={})


def speed_sentence(of: BearingSet, *same: StateChange) -> str:
    """What changes at which speed; the same of several rows."""

    def at(speed: Any) -> str:
        in_rpm = spanned(lambda each: f"{float(f'{each / rpm:.4g}'):.0f}", speed)
        return f"at {in_rpm} rpm"

    return sentence(of, same, at, "already at rest, under these loads")


def speed_sentences(of: BearingSet, every: Sequence[StateChange]) -> list[str]:
    """Each change once, with the rows that it is of."""
    return [speed_sentence(of, *each) for each in together(every)]


@dataclass(frozen=True)
class PreloadLoad:
    """The least multiple of the loads at which a row's preload is no longer maintained."""

    factor: float
    """Times every load and moment on the shaft; 0: speed alone does it."""
    row: int
    """From 0; -1 where the set has no equilibrium and no row is to blame."""
    state: str
    """lost; no_equilibrium or not_converged where the set is not solved any more."""
    sentence: str


def preload_loads(of: BearingSet, highest: float = MOST, *, threads: int | None = None) -> list[PreloadLoad]:
    """The multiples of the loads on the shaft, up to the highest given, above which some row loses its preload.

    All loads and moments grow together, the preload and all else stay. A preload counts as lost below 1 % of
    what is given. What changes and changes back between two of the 64 multiples tried is not seen, nor what comes after
    the first without an equilibrium.

    Returns:
        At most one of each row and state, the least first; empty where all rows keep their preload.

    Raises:
        SceneError: a highest multiple that is not positive, arrays in the set, no load, or rows that all carry in one
            direction.

    Examples:
        >>> bearing = qs.load_scene("7210C").bearing
        >>> rows = qs.Row(bearing, 0.0, "+x"), qs.Row(bearing, 20 * qs.mm, "-x")
        >>> operation = qs.Operation(speed=1047.0, radial_load_y=500.0, moment_z=0.0)
        >>> pair = qs.BearingSet(rows, operation, qs.Preload(rigid=720.0))
        >>> lost = qs.preload_loads(pair, 20.0)
        >>> print([f"{each.multiple:.1f}" for each in lost])
        []
    """
    check_kind("preload_loads", of, "BearingSet")
    first_changes = firsts(load_changes(of, highest, threads))
    return [PreloadLoad(each.value, each.row, each.after, load_sentence(of, each)) for each in first_changes]


def load_changes(of: BearingSet, highest: float = MOST, threads: int | None = None) -> list[StateChange]:
    """Everything that becomes of the preload up to this multiple, what comes back included."""
    errors = within("highest", highest, RATIO, 1e-6, 1e6) + opposed_errors(of)
    if not loads_of(of):
        errors.append(ErrorDetail("operation", "has no load or moment that could grow"))
    if errors:
        raise SceneError(errors)
    every = changes(lambda factors: loaded(of, factors), float(highest), threads)
    # A preload is excessive without any load.
    return [each for each in every if PreloadState.EXCESSIVE not in (each.before, each.after) or each.after == LOST]


def loads_of(of: BearingSet) -> dict[str, Any]:
    """The loads and moments on the shaft that are not zero, by their fields; its own, of gears and belts by numbers."""
    given = {channel.load: getattr(of.operation, channel.load) for channel in CHANNELS}
    for number, load in enumerate(of.shaft_loads, 1):
        given |= {f"load {number}, channel {i}": value for i, value in enumerate(load.values)}
    return {name: value for name, value in given.items() if value is not None and np.any(np.asarray(value) != 0.0)}


def loaded(of: BearingSet, factors: ArrayLike) -> BearingSet:
    """The set under these multiples of its loads, without its readings."""
    own = {channel.load for channel in CHANNELS}
    loads = {name: np.asarray(value, float) * factors for name, value in loads_of(of).items() if name in own}
    return replace(of, operation=replace(of.operation, **loads), shaft=with_loads(of.shaft, factors), readings={})


def load_sentence(of: BearingSet, *same: StateChange) -> str:
    """What changes at which multiple of the loads; the same of several rows."""
    return sentence(of, same, lambda factor: f"at {factor:.3g} times the loads", "before any load acts")


def load_sentences(of: BearingSet, every: Sequence[StateChange]) -> list[str]:
    """Each change once, with the rows that it is of."""
    return [load_sentence(of, *each) for each in together(every)]


def preload_summary(solution: SetSolution, known_limits: Limits | None = None) -> list[str]:
    """Sentences on the preload of a solved set, a single case.

    Args:
        known_limits: the set's `limits`, where they are known already.
    """
    of = solution.set
    if not of.is_opposed and any(of.is_two_sided):
        return [f"No preload presses the rows ({of.arrangement})."]
    if not of.is_opposed:
        return [f"All rows carry in {of.rows[0].carries}: no row presses another, the axial load alone presses them."]
    is_pressed = solution.preload_at_rest is not None and bool((solution.preload_at_rest > 0.0).any())
    return [
        _kind(solution),
        *_with_lengths(solution),
        *_fitted(solution),
        *_at_speed(solution),
        *(_limits(of, known_limits or limits(of)) if is_pressed else []),
    ]


def limits(of: BearingSet) -> Limits:
    """Where the preload is lost, excessive or comes back, over speed and over loads; empty where nothing varies with
    them."""
    turning = float(np.asarray(of.operation.speed)) != 0.0 and depends_on_speed(of)
    highest = FASTER * abs(float(np.asarray(of.operation.speed)))
    return (
        speed_changes(of, highest) if turning and of.is_opposed else [],
        load_changes(of) if loads_of(of) and of.is_opposed else [],
    )


def depends_on_speed(of: BearingSet) -> bool:
    """Whether anything in the set does."""
    return bool(of.ball_effects) or any(of.effects_of(row) for row in of.rows)


def _kind(solution: SetSolution) -> str:
    of = solution.set
    preload = of.preload
    if preload is None:
        if solution.preload_at_rest is not None and np.any(solution.preload_at_rest > 0.0):
            return "No preload is given: offsets or spacers press the rows against each other."
        return "No preload is given: at rest and cold the rows just touch."
    if preload.spring is not None:
        sprung = " and ".join(f"row {number}" for number, row in enumerate(of.rows, 1) if row.sprung)
        slid = float(solution.slide) / um
        return (
            f"A spring presses {sprung} with {float(np.asarray(preload.spring)):.6g} N, independently of speed, heat "
            f"and loads; the outer rings have slid by {slid:.4g} µm."
        )
    if preload.kind == "axial_displacement":
        pressed = f"pressed together by {float(np.asarray(preload.axial_displacement)) / um:.6g} µm"
    else:
        force = float(np.asarray(getattr(preload, preload.kind)))
        pressed = f"at which {force:.6g} N press the rows of each direction {preload.state}, at rest and cold"
    return f"The rings are held at a fixed distance, {pressed}. Speed, heat and loads change the loads on the rows."


def _with_lengths(solution: SetSolution) -> list[str]:
    given, at_rest = solution.preload_given, solution.preload_at_rest
    if given is None or at_rest is None or not np.abs(at_rest - given).max() > UNCHANGED * np.abs(given).max():
        return []
    return [f"Offsets and spacers change the preload of the rows from {_span(given)} N to {_span(at_rest)} N."]


def _fitted(solution: SetSolution) -> list[str]:
    before, after = solution.preload_unmounted, solution.preload_mounted
    if before is None or after is None or not np.abs(after - before).max() > UNCHANGED * np.abs(before).max():
        return []
    return [f"Fitting changes the preload of the rows from {_span(before)} N to {_span(after)} N, at rest and cold."]


def _span(values: NDArray, digits: int = 4) -> str:
    return " to ".join(dict.fromkeys(plain(each, f".{digits}g") for each in (values.min(), values.max())))


def _at_speed(solution: SetSolution) -> list[str]:
    at_rest, alone = solution.preload_at_rest, solution.preload_in_operation
    assert at_rest is not None and alone is not None  # the set is opposed
    pressed = at_rest > 0.0
    if not depends_on_speed(solution.set) or not np.isfinite(alone).all():
        return []
    if not pressed.any():
        return [f"In operation, without external loads, the rows are pressed with up to {alone.max():.4g} N."]
    ratios = alone[pressed] / at_rest[pressed]
    if np.abs(ratios - 1.0).max() < UNCHANGED:
        return ["In operation, without external loads, each row keeps its preload."]
    state = "before fitting" if solution.set.preload is None else solution.set.preload.state
    times = _span(ratios, 3)
    return [f"In operation, without external loads, the rows carry {times} times their preload {state}."]


def _limits(of: BearingSet, known_limits: Limits) -> list[str]:
    speeds, loads = known_limits
    said = speed_sentences(of, speeds) + load_sentences(of, loads)
    speed = float(np.asarray(of.operation.speed))
    kept = []
    if not speeds and speed != 0.0 and depends_on_speed(of):
        kept.append(f"up to {FASTER * abs(speed) / rpm:.6g} rpm ({FASTER:g} times the speed)")
    if not loads and loads_of(of):
        kept.append(f"up to {MOST:g} times the loads")
    if kept:
        said.append(f"All rows keep their preload {' and '.join(kept)}.")
    return said
