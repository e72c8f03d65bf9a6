"""A scene at given temperatures: its ring effects and its lubricant take those of the nodes that it has.

It asks for no heat balance any more: whatever is solved around it, as for a report's curves, keeps its temperatures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.effects import BallExpansion, RingEffect, RingExpansion
from qsbearing.model.operation import Operation
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import NODES
from qsbearing.model.solution.solution import Solution
from qsbearing.readings.asked import LUBRICANT
from qsbearing.systems.heat.balance import own_name
from qsbearing.systems.heat.network import Thermal

Temperatures = Mapping[Any, NDArray]
RING_NODES = ("inner_ring", "outer_ring", "shaft", "housing")


class HotSystem(Protocol):
    """A bearing or a set that can be solved at temperatures."""

    of: Any
    """The scene or set."""
    thermal: Thermal
    readings: Sequence[Mapping[str, Any]]
    scenes: Sequence[Scene]
    """Both of each row."""
    operation: Operation
    shape: tuple[int, ...]
    """Of its cases."""

    def alike(self, of: Any) -> HotSystem:
        """Another scene or set of the same cases, solved in the same way."""
        ...

    def solve(self, temperatures: Temperatures, factor: NDArray) -> Any:
        """Its solution at these temperatures and this multiple of its speeds.

        Raises:
            SceneError: they leave no bearing.
        """
        ...

    def rows(self, solution: Any) -> Sequence[Solution]:
        """The solution of each row."""
        ...

    def preloads(self, solution: Any) -> NDArray:
        """The axial load of each row [N]; shape (row, *cases)."""
        ...


class HotBearing:
    """A bearing alone."""

    def __init__(self, scene: Scene, shape: tuple[int, ...], solve: Callable[[Scene], Solution]) -> None:
        assert scene.thermal is not None
        self.of, self.shape, self._solve = scene, shape, solve
        self.thermal, self.operation = scene.thermal, scene.operation
        self.readings: Sequence[Mapping[str, Any]] = (scene.readings,)
        self.scenes: Sequence[Scene] = (scene,)

    def alike(self, of: Scene) -> HotBearing:
        return HotBearing(of, self.shape, self._solve)

    def solve(self, temperatures: Temperatures, factor: NDArray) -> Solution:
        effects, readings = hot_row(self.of.ring_effects, self.of.readings, self.thermal, temperatures, 0, 1)
        operation = at_speed(self.of.operation, factor)
        own: dict[str, Any] = {"ring_effects": effects, "readings": readings, "operation": operation}
        return self._solve(replace(self.of, **own, thermal=None))

    def rows(self, solution: Solution) -> Sequence[Solution]:
        return (solution,)

    def preloads(self, solution: Solution) -> NDArray:
        return np.asarray(solution.load[..., 0])[None]


def hot_row(
    effects: Iterable[RingEffect],
    readings: Mapping[str, Any],
    thermal: Thermal,
    temperatures: Temperatures,
    row: int,
    rows: int,
) -> tuple[tuple[RingEffect, ...], dict[str, Any]]:
    """The ring effects and the readings of a row at the temperatures of its nodes."""
    names = {node: own_name(node, row, rows) for node in NODES}
    own = {node: temperatures[name] for node, name in names.items() if name in temperatures}
    heated = dict(readings)
    if thermal.oil_node in own and LUBRICANT in readings:
        heated[LUBRICANT] = {**readings[LUBRICANT], "oil_temperature": own[thermal.oil_node]}
    return _with_balls(tuple(_heated(effect, own) for effect in effects), own), heated


def _with_balls(effects: tuple[RingEffect, ...], own: Temperatures) -> tuple[RingEffect, ...]:
    """A node of the balls is that of the balls between expanding rings too, though nothing names their expansion."""
    rings = next((each for each in effects if isinstance(each, RingExpansion)), None)
    if rings is None or "balls" not in own or any(isinstance(each, BallExpansion) for each in effects):
        return effects
    return (*effects, BallExpansion(own["balls"], rings.reference_temperature))


def _heated(effect: RingEffect, own: Temperatures) -> RingEffect:
    """Shaft and housing are regarded where the effect has their fits; else they only conduct."""
    if isinstance(effect, RingExpansion):
        fits = {"shaft": effect.shaft_interference, "housing": effect.housing_interference}
        regarded = [node for node in RING_NODES if node in own and fits.get(node, 0.0) is not None]
        temperatures: dict[str, Any] = {f"{node}_temperature": own[node] for node in regarded}
        return replace(effect, **temperatures)
    if isinstance(effect, BallExpansion) and "balls" in own:
        return replace(effect, ball_temperature=own["balls"])
    return effect


def at_speed(operation: Operation, factor: NDArray) -> Operation:
    """The operation at a multiple of its speeds."""
    if np.all(factor == 1.0):
        return operation
    outer = None if operation.outer_speed is None else np.asarray(operation.outer_speed, float) * factor
    return replace(operation, speed=np.asarray(operation.speed, float) * factor, outer_speed=outer)
