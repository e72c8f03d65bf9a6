"""Up to which speed a set keeps its preload."""

from __future__ import annotations

from dataclasses import dataclass, replace

from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.preload_search import Change, changes, firsts, opposed_errors
from qsbearing.sets.set_messages import EXCESSIVE, PreloadState, capital, row_name
from qsbearing.units import rpm
from qsbearing.validation import SPEED, SceneError, within


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
    found = firsts(speed_changes(of, highest_speed, threads))
    return [PreloadSpeed(each.value, each.row, each.after, speed_sentence(of, each)) for each in found]


def speed_changes(of: BearingSet, highest_speed: float, threads: int | None = None) -> list[Change]:
    """Everything that becomes of the preload up to this speed [rad/s], what comes back included; else likewise."""
    errors = within("highest_speed", highest_speed, SPEED, 1e-3, 1e7) + opposed_errors(of)
    if errors:
        raise SceneError(errors)
    return changes(
        lambda speeds: replace(of, operation=replace(of.operation, speed=speeds), readings={}),
        *(float(highest_speed), threads),
    )


def speed_sentence(of: BearingSet, change: Change) -> str:
    """What changes at which speed."""
    at = f"{change.value / rpm:.4g} rpm"
    name = capital(row_name(of.rows[change.row], change.row)) if change.row >= 0 else "The set"
    if change.after == PreloadState.LOST and change.value == 0.0:
        return f"{name} has lost its preload already at rest, under these loads."
    said = {
        str(PreloadState.MAINTAINED): f"{name} has its preload back at {at}.",
        str(PreloadState.LOST): f"{name} loses its preload at {at}.",
        str(PreloadState.EXCESSIVE): f"{name}: the preload is excessive, {EXCESSIVE:g} times that at rest, at {at}.",
        "no_equilibrium": f"{name} gives way at {at}: above there is no equilibrium.",
    }
    return said.get(change.after, f"{name}: not solved any more at {at}.")
