"""A rectilinear grid whose axes are refined where interpolation errs most.

Between each two places of an axis, midpoints are solved at some of its lines: by how much interpolation errs there is
what that interval costs. The worst are halved, until none costs more than the share of an axis in the wished error.
Then points are drawn at random over the whole grid and solved: only what they say counts, and where they say more than
is wished, the share is made smaller. No random point is used twice.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import prod
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.studies.force_table.spline import Interpolation, interpolated

FIRST = 5
"""Places of an axis to begin with."""
LINES = 24
"""Lines along each axis at whose midpoints an interval is tried."""
WORTH = 0.2
"""Part of the worst interval's error from which on others are halved with it."""
FINEST = 2.0**-16
"""Part of an axis below which no interval is halved (chosen: a step that no halving smooths)."""


class GridPoints(NamedTuple):
    """What is solved at each of some points."""

    load: NDArray
    """(point, 5); NaN where there is no equilibrium."""
    stiffness: NDArray
    """(point, 5, 5)"""
    status: NDArray
    """(point,), the solver's."""
    loaded_balls: NDArray
    """(point,), of the inner raceway; -1 where there is no equilibrium."""


Evaluate = Callable[[NDArray], GridPoints]
"""Of points, shape (point, axis)."""


class Errors(NamedTuple):
    """By how much interpolation errs at points drawn at random."""

    sizes: NDArray
    """(point, 5), without those that are not judged."""
    unjudged: int
    """Points that are not solved, or lie beside points of the grid that are not."""

    @property
    def largest(self) -> NDArray:
        """Of each load; NaN where no point is judged."""
        return self.sizes.max(axis=0) if len(self.sizes) else np.full(5, np.nan)

    @property
    def of_most(self) -> NDArray:
        """What 95 % of the points do not exceed; likewise."""
        return np.quantile(self.sizes, 0.95, axis=0) if len(self.sizes) else np.full(5, np.nan)


class RefinedGrid:
    """Points solved on a grid of given axes, to be refined.

    Args:
        ends: of each axis, the lower one first.
        evaluate: solves points.
        seed: of the points at random.
    """

    def __init__(
        self, ends: Sequence[tuple[float, float]], evaluate: Evaluate, interpolation: Interpolation, seed: int
    ) -> None:
        self.evaluate, self.interpolation = evaluate, interpolation
        self.random = np.random.default_rng(seed)
        self.axes = [np.linspace(low, high, FIRST) for low, high in ends]
        self.solved = self._shaped(evaluate(_points(self.axes)))

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(map(len, self.axes))

    @property
    def count(self) -> int:
        return prod(self.shape)

    @property
    def is_whole(self) -> bool:
        """Whether every point of the grid is solved."""
        return bool((self.solved.status == 0).all())

    def refine(self, wished: float, scale: NDArray, most: int, checked: int) -> Errors:
        """Refine until the largest error at `checked` random points is as wished, or `most` points are reached.

        Args:
            wished: over the scale.
            scale: of each load; shape (5,).
        """
        share = wished
        while True:
            is_full = self._halve_all(share, scale, most)
            errors = self.measured(checked)
            worst = float(np.max(errors.largest / scale)) if len(errors.sizes) else 0.0
            if worst <= wished or is_full or share < wished * FINEST:
                return errors
            share *= min(0.7, max(0.1, wished / worst))

    def measured(self, count: int) -> Errors:
        """The errors at points that are drawn now."""
        ends = np.array([(axis[0], axis[-1]) for axis in self.axes])
        at = self.random.uniform(ends[:, 0], ends[:, 1], (count, len(self.axes)))
        sizes = np.abs(self._error(at))
        judged = np.isfinite(sizes).all(axis=1)
        return Errors(sizes[judged], int((~judged).sum()))

    def _error(self, at: NDArray) -> NDArray:
        """Interpolated less solved; shape (point, 5)."""
        if self.interpolation is Interpolation.CUBIC and not self.is_whole:
            self.interpolation = Interpolation.LINEAR  # a spline through a gap has no number anywhere
        between = interpolated(self.axes, self.solved.load, at, self.interpolation.degree)
        return np.asarray(between - self.evaluate(at).load)

    def _halve_all(self, share: float, scale: NDArray, most: int) -> bool:
        """Halve until no interval errs by more than its share; whether some could not be halved for the bound."""
        while True:
            costs = [self._costs(number, scale) for number in range(len(self.axes))]
            worst = max(float(cost.max(initial=0.0)) for cost in costs)
            if worst <= share:
                return False
            limit = max(share, WORTH * worst)
            chosen, is_full = self._within(costs, limit, most)
            if not chosen:
                return is_full
            self._insert(chosen)
            if is_full:
                return True

    def _costs(self, number: int, scale: NDArray) -> NDArray:
        """The largest error at midpoints of each interval of an axis, over the scale."""
        axis = self.axes[number]
        middles = 0.5 * (axis[1:] + axis[:-1])
        others = [each for i, each in enumerate(self.axes) if i != number]
        lines = _points(others) if others else np.zeros((1, 0))
        if len(lines) > LINES:
            lines = lines[self.random.choice(len(lines), LINES, replace=False)]
        at = np.empty((len(middles), len(lines), len(self.axes)))
        at[..., number] = middles[:, None]
        at[..., [i for i in range(len(self.axes)) if i != number]] = lines
        error = np.abs(self._error(at.reshape(-1, len(self.axes)))) / scale
        costs = np.nan_to_num(error, nan=0.0).max(axis=1).reshape(len(middles), -1).max(axis=1)
        return np.where(np.diff(axis) < FINEST * (axis[-1] - axis[0]), 0.0, costs)

    def _within(self, costs: list[NDArray], limit: float, most: int) -> tuple[list[tuple[int, float]], bool]:
        """The intervals to halve, the worst first, as far as the bound lets: axis and new place; whether it did not."""
        ranked = sorted(
            (
                (float(cost), number, i)
                for number, own in enumerate(costs)
                for i, cost in enumerate(own)
                if cost > limit
            ),
            reverse=True,
        )
        lengths = list(self.shape)
        chosen: list[tuple[int, float]] = []
        for _, number, i in ranked:
            lengths[number] += 1
            if prod(lengths) > most:
                return chosen, True
            axis = self.axes[number]
            chosen.append((number, float(0.5 * (axis[i] + axis[i + 1]))))
        return chosen, False

    def _insert(self, places: list[tuple[int, float]]) -> None:
        """Add places to axes, and solve the points that are new."""
        old, before = self.axes, self.solved
        self.axes = [
            np.sort(np.r_[axis, [place for of, place in places if of == number]]) for number, axis in enumerate(old)
        ]
        at = np.ix_(*(np.searchsorted(new, axis) for new, axis in zip(self.axes, old, strict=True)))
        is_new = np.ones(self.shape, bool)
        is_new[at] = False
        fresh = self.evaluate(_points(self.axes)[is_new.ravel()])
        parts = []
        for own, added in zip(before, fresh, strict=True):
            whole = np.empty((*self.shape, *added.shape[1:]), added.dtype)
            whole[at], whole[is_new] = own, added
            parts.append(whole)
        self.solved = GridPoints(*parts)

    def _shaped(self, solved: GridPoints) -> GridPoints:
        return GridPoints(*(each.reshape(*self.shape, *each.shape[1:]) for each in solved))


def _points(axes: Sequence[NDArray]) -> NDArray:
    """All points of a grid; shape (point, axis)."""
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
