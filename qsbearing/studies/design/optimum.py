"""The search: many points at once over the whole box, then Newton-like steps from the best of them.

Batches of thousands of points cost microseconds each, so a dense sample of the box (Sobol points) shows the feasible
region and starts in every basin that is wider than their distance; SLSQP of scipy, a well-kept method for smooth
equalities and inequalities, then goes to the digits that no sample reaches. Nothing here knows bearings.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.studies.design.problem import SearchProblem, Variable

Evaluate = Callable[[NDArray], NDArray]
"""Values of the variables, shape (point, variable), to results, shape (point, result); NaN where there is none."""
Progress = Callable[[int, int], object]

MET = 1e-6
"""A condition is met to this part of its value: what the search leaves, far below what a drawing states."""
APART = 0.15
"""Between two starts, in the unit cube (chosen: a few starts a basin)."""
STARTS, CHOICES = 4, 8
"""Starts of the last steps; of a problem with values to choose from, in so many combinations."""
WEIGHTS = (1.0, 10.0, 100.0, 0.1)
"""Of the violation against the cost, in ranking the points to start from."""
STEP = 1e-4
"""Of central differences, in the unit cube: truncation 1e-8, above the rounding of a solution."""
WIDEST, NARROWEST, ROUNDS = 0.1, 1e-5, 60
"""Half widths, in the unit cube, of the samples around the best point, for what is not smooth there, and how many."""
CLOUD = 512
GAIN = 1e-5
"""Of the cost, by which a sample must be better to be followed."""
FAR = 1e3
"""Stands for the violation where there is no solution."""


class NoResultError(ValueError):
    """No point has all results; `missing` says which results no point has, shape (result,)."""

    def __init__(self, missing: NDArray) -> None:
        self.missing = missing
        super().__init__("no point of the sample has all results")


@dataclass(frozen=True)
class Best:
    """Where the search ended."""

    unit: NDArray
    """In the unit cube."""
    values: NDArray
    results: NDArray
    violation: NDArray
    """Of each condition, as a part of its value; at most MET where it is met."""
    evaluations: int
    feasible_share: float
    """Of the points of the first sample, but for goals, which no sample meets to the last digit: within 1 % there."""
    scale: NDArray
    """What each condition's violation is a part of."""

    @property
    def is_feasible(self) -> bool:
        """Whether every goal and limit is met."""
        return bool((self.violation <= MET).all())


def violations(problem: SearchProblem, results: NDArray, scale: NDArray) -> NDArray:
    """Of each condition, as a part of its value: above zero where it is not met; shape (point, condition)."""
    excess = np.empty((len(results), len(problem.conditions)))
    for i, each in enumerate(problem.conditions):
        off = (results[:, i] - each.value) / scale[i]
        excess[:, i] = np.abs(off) if each.sense == "=" else -off if each.sense == ">=" else off
    return excess


def cost(problem: SearchProblem, results: NDArray, scale: NDArray) -> NDArray:
    """What the best point has least of: the objective, or minus the margin to the nearest limit; shape (point,)."""
    if problem.objective:
        return np.asarray(-results[:, -1] if problem.is_maximised else results[:, -1])
    limits = [i for i, each in enumerate(problem.conditions) if each.sense != "="]
    if not limits:
        return np.zeros(len(results))
    return np.asarray(violations(problem, results, scale)[:, limits].max(axis=1))


def search(
    problem: SearchProblem, evaluate: Evaluate, points: int, seed: int = 0, progress: Progress | None = None
) -> Best:
    """The point that meets every condition with the least cost; where none does, that of least violation.

    Args:
        evaluate: many points at once.
        points: of the sample over the whole box.
        progress: called with the points done and all that are expected.

    Raises:
        NoResultError: no point of the sample has all results.
    """
    return _Search(problem, evaluate, progress or (lambda done, count: None), points).run(seed)


class _Search:
    def __init__(self, problem: SearchProblem, evaluate: Evaluate, progress: Progress, points: int) -> None:
        self.problem, self.evaluate, self.progress, self.points = problem, evaluate, progress, points
        self.done = 0
        self.variables: tuple[Variable, ...] = problem.variables
        self.smooth = np.array([not each.values for each in self.variables])
        self.scale = np.array([abs(each.value) for each in problem.conditions])
        self.unit = 1.0

    def run(self, seed: int) -> Best:
        from scipy.stats.qmc import Sobol

        count = 1 << (self.points - 1).bit_length() if self.points > 1 else 1
        u = Sobol(len(self.variables), rng=np.random.default_rng(seed)).random(count)[: self.points]
        results = self.at(u)
        known = np.isfinite(results).all(axis=1)
        if not known.any():
            raise NoResultError(~np.isfinite(results).any(axis=0))
        u, results = u[known], results[known]
        spread = results.std(axis=0)
        self.scale[self.scale == 0.0] = np.maximum(spread[: self.scale.size][self.scale == 0.0], 1e-300)
        worst = self.worst(results)
        costs = cost(self.problem, results, self.scale)
        self.unit = float(costs.std()) or 1.0
        goals = [each.sense == "=" for each in self.problem.conditions]
        off = violations(self.problem, results, self.scale) - np.where(goals, 0.01, 0.0)
        share = float((off <= 0.0).all(axis=1).sum()) / known.size
        candidates = [
            (u[i], results[i]) for i in {int(np.argmin(np.where(worst <= MET, costs, np.inf))), int(np.argmin(worst))}
        ]
        for start in self._starts(u, worst, costs):
            candidates.append(self._polished(start))
        best = self._best(candidates)
        best = self._followed(best, seed)
        violation = violations(self.problem, best[1][None], self.scale)[0]
        values = self._values(best[0][None])[0]
        self.progress(self.done, self.done)
        return Best(best[0], values, best[1], violation, self.done, share, self.scale)

    def _followed(self, best: tuple[NDArray, NDArray], seed: int) -> tuple[NDArray, NDArray]:
        """From the best point to better ones in samples around it, narrower where none is: along walls of points
        without a solution, and kinks where another ball takes over, where slopes lead nowhere."""
        width, rounds = WIDEST, 0
        if not self.smooth.any():
            return best
        random = np.random.default_rng(seed)
        while width > NARROWEST and rounds < ROUNDS:
            rounds += 1
            near = best[0] + self.smooth * width * random.uniform(-1.0, 1.0, (CLOUD, len(self.variables)))
            near = np.clip(near, 0.0, 1.0)
            results = self.at(near)
            first = int(self.order(results)[0])
            better = self._best([best, (near[first], results[first])])
            if better is best or not self._gains(best[1], better[1]):
                width /= 3.0
            best = better
        polished = self._polished(best[0])  # which meets goals to more digits
        return best if self._gains(polished[1], best[1]) else polished

    def _gains(self, before: NDArray, after: NDArray) -> bool:
        """Whether the second is better by more than rounding."""
        both = np.array([before, after])
        worst, costs = self.worst(both), cost(self.problem, both, self.scale)
        return bool(worst[0] - worst[1] > GAIN or costs[0] - costs[1] > GAIN * abs(costs[0]))

    def _values(self, u: NDArray) -> NDArray:
        return np.stack([each.at(u[:, i]) for i, each in enumerate(self.variables)], axis=1)

    def at(self, u: NDArray) -> NDArray:
        """Results at places in the unit cube."""
        results = self.evaluate(self._values(u))
        self.done += len(u)
        self.progress(self.done, max(self.done, self.points))
        return results

    def worst(self, results: NDArray) -> NDArray:
        """The largest violation of each point, at least 0."""
        return violations(self.problem, results, self.scale).max(axis=1, initial=0.0)

    def order(self, results: NDArray) -> NDArray:
        """Numbers of the points, the best first; those without results last."""
        known = np.isfinite(results).all(axis=1)
        worst = np.where(known, self.worst(results), np.inf)
        costs = np.where(known, cost(self.problem, results, self.scale), np.inf)
        return np.lexsort((costs, np.where(worst <= MET, 0.0, worst)))

    def _best(self, candidates: list[tuple[NDArray, NDArray]]) -> tuple[NDArray, NDArray]:
        return candidates[int(self.order(np.array([results for _, results in candidates]))[0])]

    def _starts(self, u: NDArray, worst: NDArray, costs: NDArray) -> list[NDArray]:
        """Points of the sample to go on from: good by several weights of violation against cost, apart from each other;
        where values are chosen from, the best of each combination."""
        chosen: list[int] = []
        of_choice = self._values(u)[:, ~self.smooth]
        each_choice = STARTS if self.smooth.all() else 1
        for weight in WEIGHTS:
            taken = 0
            for i in np.argsort(costs / self.unit + weight * worst):
                same = [j for j in chosen if (of_choice[i] == of_choice[j]).all()]
                near = np.abs((u[i] - u[same])[:, self.smooth]).max(axis=1, initial=0.0) <= APART
                if len(same) < each_choice and not near.any():
                    chosen.append(int(i))
                    taken += 1
                if taken == (1 if self.smooth.all() else CHOICES // len(WEIGHTS)):
                    break
        return [u[i] for i in chosen]

    def _polished(self, start: NDArray) -> tuple[NDArray, NDArray]:
        """From a point to the nearest one that meets every condition, and from there to the least cost."""
        u = start.copy()
        if self.smooth.any():
            steps = _Differences(self, u)
            if self.worst(steps.centre[None])[0] > MET:
                steps.to_feasible()
            if self.worst(steps.centre[None])[0] <= 10.0 * MET:
                steps.to_least_cost()
            u = steps.u
        return u, self.at(u[None])[0]


class _Differences:
    """Results and their slopes at a point, and the steps of SLSQP from there; choices stay as they are."""

    def __init__(self, of: _Search, u: NDArray) -> None:
        self.of = of
        self.u = u
        self.free = np.flatnonzero(of.smooth)
        self._known: dict[bytes, tuple[NDArray, NDArray]] = {}

    @property
    def centre(self) -> NDArray:
        return self.local(self.u[self.free])[0]

    def local(self, x: NDArray) -> tuple[NDArray, NDArray]:
        """Results at a point, shape (result,), and their slopes, (result, free variable)."""
        mark = x.tobytes()
        if mark not in self._known:
            count = self.free.size
            places = np.repeat(self.u[None], 2 * count + 1, axis=0)
            places[:, self.free] = np.clip(x, 0.0, 1.0)
            for i, j in enumerate(self.free):
                places[1 + i, j] = min(places[0, j] + STEP, 1.0)
                places[1 + count + i, j] = max(places[0, j] - STEP, 0.0)
            results = self.of.at(places)
            up, down = results[1 : 1 + count], results[1 + count :]
            # Beside a point without a solution: the difference to the side that has one.
            right = np.where(np.isfinite(up), up, results[0])
            left = np.where(np.isfinite(down), down, results[0])
            width = np.diagonal(places[1 : 1 + count, self.free] - places[1 + count :, self.free])[:, None]
            half = np.isfinite(up).astype(float) + np.isfinite(down)
            slope = (right - left) / (width * np.maximum(half, 1.0) / 2.0)
            self._known[mark] = results[0], np.nan_to_num(slope).T
        return self._known[mark]

    def _rows(self, x: NDArray) -> tuple[NDArray, NDArray, NDArray, NDArray]:
        """Signed violations of the conditions with slopes, and the cost with its slope, in the search's unit."""
        results, slopes = self.local(x)
        problem, scale = self.of.problem, self.of.scale
        signs = np.array([-1.0 if each.sense == ">=" else 1.0 for each in problem.conditions])
        values = np.array([each.value for each in problem.conditions])
        count = signs.size
        off = signs * (results[:count] - values) / scale
        slope = (signs / scale)[:, None] * slopes[:count]
        if not np.isfinite(results).all():
            return np.full(count, FAR), np.zeros((count, x.size)), np.array(FAR), np.zeros(x.size)
        sign = -1.0 if problem.is_maximised else 1.0
        if not problem.objective:
            return off, slope, np.array(0.0), np.zeros(x.size)
        return off, slope, sign * results[-1] / self.of.unit, sign * slopes[-1] / self.of.unit

    def to_feasible(self) -> None:
        """Least t of which no condition is violated by more."""
        self._with_slack(goals_within=True)

    def to_least_cost(self) -> None:
        """Least cost among the points that meet every condition."""
        if not self.of.problem.objective:
            if any(each.sense != "=" for each in self.of.problem.conditions):
                self._with_slack(goals_within=False)
            return
        goal = np.array([each.sense == "=" for each in self.of.problem.conditions], bool)
        constraints = []
        for kind, rows, sign in (("eq", goal, 1.0), ("ineq", ~goal, -1.0)):
            if rows.any():
                constraints.append(
                    {
                        "type": kind,
                        "fun": lambda x, rows=rows, sign=sign: sign * self._rows(x)[0][rows],
                        "jac": lambda x, rows=rows, sign=sign: sign * self._rows(x)[1][rows],
                    }
                )
        x = self.u[self.free]
        self._minimise(lambda x: float(self._rows(x)[2]), lambda x: self._rows(x)[3], x, [], constraints)

    def _with_slack(self, goals_within: bool) -> None:
        goal = np.array([each.sense == "=" for each in self.of.problem.conditions], bool)
        limits = np.ones(goal.size, bool) if goals_within else ~goal

        def inside(z: NDArray) -> NDArray:
            off = self._rows(z[:-1])[0]
            below = z[-1] - off[limits]
            return np.concatenate([below, z[-1] + off[goal]]) if goals_within else below

        def inside_slope(z: NDArray) -> NDArray:
            slope = self._rows(z[:-1])[1]
            rows = np.concatenate([-slope[limits], slope[goal]]) if goals_within else -slope[limits]
            return np.column_stack([rows, np.ones(len(rows))])

        constraints = [{"type": "ineq", "fun": inside, "jac": inside_slope}]
        if not goals_within and goal.any():
            held = {
                "type": "eq",
                "fun": lambda z: self._rows(z[:-1])[0][goal],
                "jac": lambda z: np.column_stack([self._rows(z[:-1])[1][goal], np.zeros(int(goal.sum()))]),
            }
            constraints.append(held)
        x = self.u[self.free]
        off = self._rows(x)[0]
        first = float(np.max(np.where(goal, np.abs(off) if goals_within else -np.inf, off)))
        least = 0.0 if goals_within else -1.0
        slope = np.append(np.zeros(x.size), 1.0)
        start = np.append(x, max(first, least))
        self._minimise(lambda z: float(z[-1]), lambda z: slope, start, [(least, None)], constraints)

    def _minimise(
        self,
        cost: Callable[[NDArray], float],
        slope: Callable[[NDArray], NDArray],
        start: NDArray,
        more: list[tuple[float, None]],
        constraints: list[dict[str, Any]],
    ) -> None:
        """Go where SLSQP goes; bounds of what stands behind the free variables are given."""
        from scipy.optimize import minimize

        minimum = minimize(
            cost, start, jac=slope, method="SLSQP", bounds=[*[(0.0, 1.0)] * self.free.size, *more],
            constraints=constraints, options={"ftol": 1e-10, "maxiter": 40},
        )  # fmt: skip
        self._take(minimum.x[: self.free.size])

    def _take(self, x: NDArray) -> None:
        """Stand at this point, if it is better than where the steps began."""
        before, after = self.centre, self.local(np.clip(x, 0.0, 1.0))[0]
        if self.of.order(np.array([before, after]))[0] == 1:
            self.u = self.u.copy()
            self.u[self.free] = np.clip(x, 0.0, 1.0)
