"""Up to which speed a set keeps its preload."""

from __future__ import annotations

from dataclasses import dataclass, replace

from qsbearing.sets.bearing_set import BearingSet
from qsbearing.sets.preload_search import Change, changes, firsts, opposed_errors, sentence
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
    of what is given, and as excessive above three times it. What changes and changes back between two of the 64 speeds
    tried is not seen, nor what comes after the first without an equilibrium.

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
    return sentence(of, change, f"at {change.value / rpm:.4g} rpm", "already at rest, under these loads")
