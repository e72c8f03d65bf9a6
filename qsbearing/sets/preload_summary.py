"""What a preload does in a set, in sentences: what presses the rows, what speed makes of it, and where it is lost."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.preload_loads import MOST, load_changes, load_sentence, loads_of
from qsbearing.sets.preload_search import Change
from qsbearing.sets.preload_speeds import speed_changes, speed_sentence
from qsbearing.sets.set_solution import SetSolution
from qsbearing.units import rpm, um

FASTER = 1.5
"""Times the speed of the set, up to which its preload is followed."""
UNCHANGED = 0.005
"""Relative; a preload that changes by less is said to stay."""
Limits = tuple[list[Change], list[Change]]
"""Changes over speed and over loads."""


def preload_summary(solution: SetSolution, found: Limits | None = None) -> list[str]:
    """Sentences on the preload of a solved set, a single case.

    Args:
        found: the set's `limits`, where they are known already.
    """
    of = solution.set
    if not of.is_opposed:
        return [f"All rows carry in {of.rows[0].carries}: no row presses another, the axial load alone presses them."]
    is_pressed = solution.preload_at_rest is not None and bool((solution.preload_at_rest > 0.0).any())
    return [
        _kind(solution),
        *_fitted(solution),
        *_at_speed(solution),
        *(_limits(of, found or limits(of)) if is_pressed else []),
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
        if any(np.any(np.asarray(row.offset) != 0.0) for row in of.rows):
            return "No preload is given: the offsets of the rows press them against each other."
        return "No preload is given: at rest and cold the rows just touch."
    if preload.spring is not None:
        sprung = " and ".join(f"row {number}" for number, row in enumerate(of.rows, 1) if row.sprung)
        slid = float(solution.slide) / um
        return (
            f"A spring presses {sprung} with {float(np.asarray(preload.spring)):.6g} N, whatever speed, heat and loads "
            f"do; the outer rings have slid by {slid:.4g} um."
        )
    if preload.kind == "axial_displacement":
        pressed = f"pressed together by {float(np.asarray(preload.axial_displacement)) / um:.6g} um"
    else:
        force = float(np.asarray(getattr(preload, preload.kind)))
        pressed = f"where {force:.6g} N took the rows of either direction {preload.state}, at rest and cold"
    return f"Rings are held {pressed}: speed, heat and loads change what presses the rows."


def _fitted(solution: SetSolution) -> list[str]:
    before, after = solution.preload_unmounted, solution.preload_mounted
    if before is None or after is None or not np.abs(after - before).max() > UNCHANGED * np.abs(before).max():
        return []
    return [f"Fitting changes what presses the rows from {_span(before)} N to {_span(after)} N, at rest and cold."]


def _span(values: NDArray, digits: int = 4) -> str:
    return " to ".join(dict.fromkeys(f"{each:.{digits}g}" for each in (values.min(), values.max())))


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
    return [f"In operation, without external loads, rows are pressed by {times} times their preload {state}."]


def _limits(of: BearingSet, found: Limits) -> list[str]:
    speeds, loads = found
    said = [speed_sentence(of, each) for each in speeds] + [load_sentence(of, each) for each in loads]
    speed = float(np.asarray(of.operation.speed))
    kept = []
    if not speeds and speed != 0.0 and depends_on_speed(of):
        kept.append(f"up to {FASTER * abs(speed) / rpm:.6g} rpm ({FASTER:g} times the speed)")
    if not loads and loads_of(of):
        kept.append(f"up to {MOST:g} times the loads")
    if kept:
        said.append(f"All rows keep their preload {' and '.join(kept)}.")
    return said
