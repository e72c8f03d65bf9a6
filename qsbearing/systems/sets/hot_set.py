"""A set at given temperatures: each row with its own rings and balls, shaft, housing and oil shared."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.solution import Solution
from qsbearing.systems.heat.hot import Temperatures, at_speed, hot_row
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution


class HotSet:
    """As `qsbearing.systems.heat.hot.HotSystem` asks it."""

    def __init__(self, of: BearingSet, shape: tuple[int, ...], solve: Callable[[BearingSet], SetSolution]) -> None:
        assert of.thermal is not None
        self.of, self.shape, self._solve = of, shape, solve
        self.thermal, self.operation = of.thermal, of.operation
        self.scenes: Sequence[Scene] = tuple(map(of.turning_scene, range(len(of.rows))))
        self.readings: Sequence[Mapping[str, Any]] = tuple(
            of.readings if row.readings is None else row.readings for row in of.rows
        )

    def solve(self, temperatures: Temperatures, factor: NDArray) -> SetSolution:
        """The set's solution at these temperatures of its nodes."""
        bodies = {name: getattr(self.of, name) for name in ("shaft", "housing")}
        bodies = {
            name: replace(body, temperature=temperatures[name])
            for name, body in bodies.items()
            if body is not None and name in temperatures
        }
        own = {name: value for name, value in temperatures.items() if name not in bodies}  # rows take theirs from these
        rows = []
        for number, row in enumerate(self.of.rows):
            effects = self.of.ring_effects if row.ring_effects is None else row.ring_effects
            given = effects, self.readings[number], self.thermal, own
            effects, readings = hot_row(*given, number, len(self.of.rows))
            rows.append(replace(row, ring_effects=effects, readings=readings))
        operation = at_speed(self.operation, factor)
        return self._solve(replace(self.of, rows=tuple(rows), operation=operation, thermal=None, **bodies))

    def rows(self, solution: SetSolution) -> Sequence[Solution]:
        """Each row's own."""
        return solution.rows

    def preloads(self, solution: SetSolution) -> NDArray:
        """The axial load of each row; shape (row, *cases)."""
        return np.moveaxis(solution.axial_loads, -1, 0)
