"""The steady state: temperatures at which what friction makes of them is the heat that they carry off.

With x the powers of the sources and f(T) what friction makes at the temperatures T, the network's temperatures T(x) are
linear, and

    x = f(T(x)).

Unknown are two or three powers a row. Broyden's method with a matrix of differences to begin with (the states of all
columns solved as cases of one scene), all cases of an array together. A further watt of heat makes friction grow by the
largest eigenvalue of df/dx, the feedback: below 1 a disturbance of heat dies out, at 1 the preload runs away.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.solution.solution import Solution
from qsbearing.model.units import zero_celsius
from qsbearing.model.validation import TEMPERATURE, ErrorDetail, SceneError, raise_if_any
from qsbearing.readings.asked import LUBRICANT, READINGS
from qsbearing.readings.contact_friction import ENTRY as CONTACT_FRICTION
from qsbearing.readings.lubricant import oil_of
from qsbearing.systems.heat.balance import HeatBalance
from qsbearing.systems.heat.hot import HotSystem
from qsbearing.systems.heat.network import READING_OF

DRAG = "drag"


def sources_of(friction: str, readings: Mapping[str, Any]) -> tuple[str, ...]:
    """The sources of heat that a model tells apart."""
    if READING_OF[friction] != CONTACT_FRICTION.name:
        return ("friction",)
    drags = readings[CONTACT_FRICTION.name].get("drag_coefficient") is not None
    return ("inner contacts", "outer contacts", *([DRAG] if drags else []))


def powers(solution: Solution, friction: str) -> NDArray:
    """Of each of these sources [W]; shape (source, *cases); NaN where the bearing is not solved."""
    readings = solution.scene.readings
    reading = READINGS[READING_OF[friction]]
    oil, _ = oil_of(readings[LUBRICANT]) if LUBRICANT in readings else (None, [])
    taken = reading.take(solution, reading.arguments(readings[reading.name], oil), {})
    if reading is CONTACT_FRICTION:
        parts = [taken.inner.power.sum(axis=-1), taken.outer.power.sum(axis=-1)]
        parts += [] if taken.drag_power is None else [np.nansum(taken.drag_power, axis=-1)]
    else:
        parts = [getattr(taken, friction).power]
    of_sources = np.stack([np.broadcast_to(part, solution.shape) for part in parts])
    return np.where(np.asarray(solution.converged), of_sources, np.nan)


TOLERANCE = 1e-11
"""Of the balance, over the whole heat: temperatures to some 1e-9 K; ten times what the bearing's residual leaves."""
STEP = 1e-4
"""Of differences, over the whole heat: far above rounding, and curvature does not show in three digits."""
MOST = 25
"""Iterations; a steady state takes four to eight."""


class Heated:
    """A system and its network: what friction makes at given temperatures. Counts what it solves."""

    def __init__(self, system: HotSystem) -> None:
        thermal = system.thermal
        raise_if_any(thermal.errors(system.readings))
        self.system = system
        self.balance = HeatBalance(thermal, [sources_of(thermal.friction, each) for each in system.readings])
        raise_if_any(self._too_hot_already())
        self.solved = 0
        """States of the system solved, of each case."""

    def _too_hot_already(self) -> list[ErrorDetail]:
        cold = self.balance.temperatures(np.zeros(len(self.balance.sources)))
        temperature, limit = float(cold.max()), self.system.thermal.limit_temperature
        if temperature < limit:
            return []
        hottest = self.balance.free[int(cold.argmax())].replace("_", " ")
        own = f"{temperature - zero_celsius:.4g} °C"
        cause = f"Without any friction, the {hottest} is at {own}: correct the given temperatures"
        problem = "is already reached through the given temperatures and heats, without friction"
        return [ErrorDetail("thermal.limit_temperature", problem, limit, TEMPERATURE, cause=cause)]

    def at(self, temperatures: NDArray, factor: Any = 1.0) -> tuple[Any, NDArray]:
        """The system's solution and the powers of its sources; NaN where it has no equilibrium.

        Args:
            temperatures: of the free nodes; shape (free node, *states, *cases).
            factor: on the speeds; shape (*states, *cases).
        """
        shape = temperatures.shape[1:]
        of_states = shape[: len(shape) - len(self.system.shape)]
        is_first = not self.solved
        self.solved += int(np.prod(of_states))
        try:
            solution = self.system.solve(self.balance.named(temperatures), np.asarray(factor, float))
        except SceneError:
            if is_first:
                raise
            return None, np.full((len(self.balance.sources), *shape), np.nan)
        of_rows = [powers(row, self.system.thermal.friction) for row in self.system.rows(solution)]
        return solution, np.concatenate([np.broadcast_to(each, (len(each), *shape)) for each in of_rows])

    def friction(self, x: NDArray, factor: Any = 1.0) -> NDArray:
        """f(T(x)); shapes (source, *states, *cases)."""
        return self.at(self.balance.temperatures(x), factor)[1]

    def slopes(self, x: NDArray, at_x: NDArray, factor: Any = 1.0) -> NDArray:
        """df/dx by differences; shape (source, source of x, *cases)."""
        step = STEP * np.abs(x).sum(axis=0) + 1e-6
        columns = np.eye(len(x)).reshape(len(x), len(x), *[1] * (x.ndim - 1))
        return (self.friction(x[:, None] + step * columns, factor) - at_x[:, None]) / step

    def capped(self, x: NDArray) -> NDArray:
        """As much of these powers as heats no node beyond the limit."""
        cold = self.balance.temperatures(np.zeros_like(x))
        hot = self.balance.temperatures(x)
        limit = self.system.thermal.limit_temperature
        with np.errstate(divide="ignore", invalid="ignore"):
            part = np.where(hot > limit, np.maximum(limit - cold, 0.0) / (hot - cold), 1.0)
        return np.asarray(x * part.min(axis=0))


@dataclass(frozen=True)
class Steady:
    """What was found of every case."""

    x: NDArray
    """Powers carried off [W]; shape (source, *cases)."""
    found: NDArray
    """Whether they balance; shape (*cases)."""
    solution: Any
    """Of the system there."""
    powers: NDArray
    """What friction makes there [W]."""
    slopes: NDArray
    """df/dx there."""


def find_steady(heated: Heated, start: NDArray | None = None) -> Steady:
    """The steady state of every case, from powers near it or from the cold system."""
    shape = heated.system.shape
    cold = np.zeros((len(heated.balance.sources), *shape))
    x = heated.capped(heated.friction(cold)) if start is None else start
    x = np.nan_to_num(x)
    f = heated.friction(x)
    matrix = _identity(x) - heated.slopes(x, f)
    r, reach = x - f, np.ones(shape)
    for _ in range(MOST):
        done = _balances(r, x)
        if done.all():
            break
        step = np.where(done, 0.0, reach * _solved(matrix, -r))
        trial = heated.capped(np.maximum(x + step, 0.0))
        step = trial - x
        change = trial - heated.friction(trial) - r
        usable = np.isfinite(change).all(axis=0) & np.any(step != 0.0, axis=0)
        better = usable & (np.abs(r + change).max(axis=0) < np.abs(r).max(axis=0))
        square = np.where(usable, (step * step).sum(axis=0), 1.0)
        missed = np.where(usable, change - np.einsum("ij...,j...->i...", matrix, step), 0.0)
        matrix = matrix + np.einsum("i...,j...->ij...", missed, np.where(usable, step, 0.0)) / square
        x, r = np.where(better, trial, x), np.where(better, r + change, r)
        reach = np.where(better, np.minimum(2.0 * reach, 1.0), 0.25 * reach)
    solution, f = heated.at(heated.balance.temperatures(x))
    return Steady(x, _balances(x - f, x), solution, f, heated.slopes(x, f))


def _balances(r: NDArray, x: NDArray) -> NDArray:
    with np.errstate(invalid="ignore"):
        return np.asarray(np.abs(r).max(axis=0) <= TOLERANCE * np.abs(x).sum(axis=0) + 1e-12)


def _identity(x: NDArray) -> NDArray:
    return np.eye(len(x)).reshape(len(x), len(x), *[1] * (x.ndim - 1))


def _solved(matrix: NDArray, right: NDArray) -> NDArray:
    """Of every case; zero where the matrix is none."""
    A, b = np.moveaxis(matrix, (0, 1), (-2, -1)), np.moveaxis(right, 0, -1)[..., None]
    usable = np.isfinite(A).all(axis=(-2, -1)) & np.isfinite(b).all(axis=(-2, -1))
    with np.errstate(invalid="ignore"):
        usable &= np.abs(np.linalg.det(np.where(usable[..., None, None], A, 0.0))) > 1e-12
    A = np.where(usable[..., None, None], A, np.eye(A.shape[-1]))
    return np.where(usable, np.moveaxis(np.linalg.solve(A, b)[..., 0], -1, 0), 0.0)


def feedback(slopes: NDArray) -> NDArray:
    """The largest real part of the eigenvalues of df/dx; shape (*cases)."""
    matrices = np.moveaxis(slopes, (0, 1), (-2, -1))
    known = np.isfinite(matrices).all(axis=(-2, -1))
    values = np.linalg.eigvals(np.where(known[..., None, None], matrices, 0.0)).real.max(axis=-1)
    return np.where(known, values, np.nan)
