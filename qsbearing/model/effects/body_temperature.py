"""The temperature of each part of a bearing, and where it comes from: given, or assumed by a rule that has a name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

GIVEN, REFERENCE, MEAN = "given", "reference temperature", "mean of the rings"


class BodyTemperature(NamedTuple):
    """A temperature, and where it comes from."""

    value: Any
    """[K]"""
    taken_from: str
    """given, as the inner ring, as the outer ring, mean of the rings, or reference temperature."""

    @property
    def is_assumed(self) -> bool:
        """Whether nobody gave it."""
        return self.taken_from != GIVEN


def body_temperatures(effects: Iterable[Any]) -> dict[str, BodyTemperature]:
    """Of shaft, rings, housing and balls where these ring effects give any; a ring that does not grow stays at the
    reference temperature."""
    rings, balls = _of_rings_and_balls(effects)
    own = None if balls is None else balls.ball_temperature
    if own is None and (rings is None or not rings.is_warm):
        return {}
    if rings is None:
        cold = BodyTemperature(balls.reference_temperature, REFERENCE)
        of_rings = {"inner_ring": cold, "outer_ring": cold}
    else:
        of_rings = rings.temperatures
    mean = BodyTemperature(_mean_of_rings(of_rings), MEAN)
    return {**of_rings, "balls": mean if own is None else BodyTemperature(own, GIVEN)}


def assumed_of_balls(effects: Iterable[Any]) -> tuple[Any, Any] | None:
    """The temperature of balls without one of their own between rings of which one is given a temperature, and the
    reference temperature [K]; else None."""
    rings, balls = _of_rings_and_balls(effects)
    if balls is not None or rings is None:
        return None
    if rings.inner_ring_temperature is None and rings.outer_ring_temperature is None:
        return None
    return _mean_of_rings(rings.temperatures), rings.reference_temperature


def _of_rings_and_balls(effects: Iterable[Any]) -> tuple[Any, Any]:
    """The effects that have temperatures; None for what there is not."""
    there = tuple(effects)
    names = "inner_ring_temperature", "ball_temperature"
    rings, balls = (next((each for each in there if hasattr(each, name)), None) for name in names)
    return rings, balls


def _mean_of_rings(temperatures: Mapping[str, BodyTemperature]) -> Any:
    inner, outer = (np.asarray(temperatures[f"{side}_ring"].value, float) for side in ("inner", "outer"))
    return (0.5 * (inner + outer))[()]
