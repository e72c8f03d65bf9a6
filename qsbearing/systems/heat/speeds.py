"""Steady states followed from standstill in speed, past the speed at which they turn back.

Unknown are the powers x of the sources and the factor s on the speeds; the states x = f(T(x), s) form a curve,
followed by its arc length (Keller's pseudo-arclength continuation: a chord as tangent, each point corrected
perpendicular to it by MINPACK's hybrid method), which passes a fold as any other point. The curve ends where a node
reaches the limit of temperature. At the fold the feedback is 1: this curve has no steady state at a higher speed, and a
bearing that is brought there heats up without end.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import pi

import numpy as np
from numpy.typing import NDArray

from qsbearing.systems.heat.state import SpeedCurve, State
from qsbearing.systems.heat.steady import STEP, Heated

FIRST, SECOND = 0.02, 0.04
"""Of the speed: where the curve is begun, slow enough to be all but cold."""
LARGEST, SMALLEST = 0.1, 1e-4
"""Steps along the curve, in parts of the speed and of the heat that reaches the limit."""
TURN, SHARPEST, FARTHEST = 0.12, 0.25, 1.0
"""Radians by which the curve turns from step to step: about, at most while steps are not small, and at most."""
COARSE = 0.005
"""A step that is not small."""
MOST_POINTS = 200
BEND, SHORT = 0.1, 0.02
"""Of the curve of temperature over speed, both from 0 to 1: an angle [rad] that is seen as a kink, and the length of a
chord too short for that."""


class _Curve:
    def __init__(self, heated: Heated) -> None:
        assert heated.system.shape == ()
        self.heated, self.count = heated, len(heated.balance.sources)
        cold = np.zeros(self.count)
        first = heated.friction(cold)
        self.cold = heated.balance.temperatures(cold)
        rise = float((heated.balance.temperatures(first) - self.cold).max())
        room = heated.system.thermal.limit_temperature - float(self.cold.max())
        self.scale = float(np.maximum(first.sum() * max(room, 1.0) / max(rise, 1e-9), 1e-9))
        """The heat that reaches the limit, about [W]."""

    def residual(self, y: NDArray) -> NDArray:
        """Of points y = (x/scale, s); shape (source, *points)."""
        x = y[:-1] * self.scale
        return (x - self.heated.friction(x, y[-1])) / self.scale

    def corrected(self, guess: NDArray, normal: NDArray) -> NDArray | None:
        """The point of the curve in the plane through this guess; None where none is found."""
        from scipy.optimize import root

        @cache  # `root` asks for the first point's equations and slopes twice
        def residual(*y: float) -> NDArray:
            return self.residual(np.array(y))

        @cache
        def differences(*y: float) -> NDArray:
            points = np.array(y)[:, None] + STEP * np.eye(len(y))
            return (self.residual(points) - residual(*y)[:, None]) / STEP

        def equations(y: NDArray) -> NDArray:
            return np.nan_to_num(np.append(residual(*y), normal @ (y - guess)), nan=1.0)

        def slopes(y: NDArray) -> NDArray:
            return np.nan_to_num(np.vstack([differences(*y), normal]))

        zero = root(equations, guess, jac=slopes, options={"xtol": 1e-12, "maxfev": 40})
        on_curve = float(np.abs(zero.fun).max()) < 1e-9
        return zero.x if on_curve and zero.x[-1] > 0.0 else None

    def hottest(self, y: NDArray) -> float:
        return float(self.heated.balance.temperatures(y[:-1] * self.scale).max())

    def state(self, y: NDArray) -> State:
        x = y[:-1] * self.scale
        temperatures = self.heated.balance.temperatures(x)
        solution, _ = self.heated.at(temperatures, y[-1])
        return State(float(y[-1]), x, temperatures, self.heated.system.preloads(solution))


def follow_speeds(heated: Heated, until: float) -> SpeedCurve:
    """The curve of a single case, up to this multiple of the scene's speed or to the limit of temperature."""
    curve, limit = _Curve(heated), heated.system.thermal.limit_temperature
    in_speed = np.eye(curve.count + 1)[-1]
    points: list[NDArray] = []
    if not np.isfinite(curve.scale):
        return SpeedCurve((), None, None, None)  # the cold bearing has no equilibrium
    for factor in (FIRST, SECOND):
        powers = heated.friction(np.zeros(curve.count), factor) / curve.scale
        point = curve.corrected(np.append(powers, factor), in_speed)
        if point is None:
            return SpeedCurve((), None, None, None)
        points.append(point)
    step, fold = 2.0 * SECOND, None
    while len(points) < MOST_POINTS and points[-1][-1] < until and curve.hottest(points[-1]) < limit:
        chord = points[-1] - points[-2]
        tangent = chord / np.linalg.norm(chord)
        point = curve.corrected(points[-1] + step * tangent, tangent)
        turn = pi if point is None else _angle(point - points[-1], tangent)
        if point is None or turn > FARTHEST or (turn > SHARPEST and step > COARSE):
            step /= 3.0
            if step < SMALLEST:
                break
            continue
        points.append(point)
        step = min(float(np.clip(TURN / max(turn, 1e-9), 0.3, 1.5)) * step, LARGEST)
        if fold is None and points[-1][-1] < points[-2][-1]:
            fold = _fold(curve, *points[-3:])
    at_limit = _where(curve, points, lambda y: curve.hottest(y) - limit)
    kept = [point for point in points if curve.hottest(point) <= limit]
    crossing = next((point for point in kept if point[-1] >= 1.0), None)
    states = [curve.state(point) for point in _smooth(curve, kept)]
    return SpeedCurve(
        (*states, *([] if at_limit is None else [curve.state(at_limit)])),
        None if fold is None else curve.state(fold),
        None if at_limit is None else curve.state(at_limit),
        None if crossing is None else curve.state(crossing),
    )


def _smooth(curve: _Curve, points: list[NDArray]) -> list[NDArray]:
    """These points with more of the curve between them, until it bends little from chord to chord."""
    cold = float(curve.cold.max())
    room = curve.heated.system.thermal.limit_temperature - cold
    while len(points) > 2:
        most = max(point[-1] for point in points)
        chords = np.diff([(point[-1] / most, (curve.hottest(point) - cold) / room) for point in points], axis=0)
        heading = np.unwrap(np.arctan2(chords[:, 1], chords[:, 0]))
        bend = np.pad(np.abs(np.diff(heading)), 1)
        is_coarse = (np.maximum(bend[:-1], bend[1:]) > BEND) & (np.hypot(*chords.T) > SHORT)
        finer = points[:1]
        for before, after, coarse in zip(points, points[1:], is_coarse, strict=False):
            between = curve.corrected(0.5 * (before + after), after - before) if coarse else None
            finer += [after] if between is None else [between, after]
        if len(finer) == len(points) or len(finer) > MOST_POINTS:
            return points
        points = finer
    return points


def _angle(one: NDArray, other: NDArray) -> float:
    return float(np.arccos(np.clip(one @ other / (np.linalg.norm(one) * np.linalg.norm(other)), -1.0, 1.0)))


def _fold(curve: _Curve, before: NDArray, middle: NDArray, after: NDArray) -> NDArray:
    """The point of largest speed between three."""
    from scipy.optimize import minimize_scalar

    tangent = (after - before) / np.linalg.norm(after - before)

    def slower(along: float) -> float:
        point = curve.corrected(middle + along * tangent, tangent)
        return 0.0 if point is None else -float(point[-1])

    ends = (before - middle) @ tangent, (after - middle) @ tangent
    fastest = minimize_scalar(slower, bounds=ends, method="bounded", options={"xatol": 1e-6})
    point = curve.corrected(middle + fastest.x * tangent, tangent)
    return middle if point is None else point


def _where(curve: _Curve, points: list[NDArray], of: Callable[[NDArray], float]) -> NDArray | None:
    """Where a function changes sign in the last step; None where it does not."""
    from scipy.optimize import brentq

    before, after = points[-2:]
    if of(after) < 0.0:
        return None
    if of(before) >= 0.0:
        return before
    tangent = (after - before) / np.linalg.norm(after - before)

    def point(along: float) -> NDArray:
        on_curve = curve.corrected(before + along * tangent, tangent)
        return before + along * tangent if on_curve is None else on_curve

    along = brentq(lambda each: of(point(each)), 0.0, float(np.linalg.norm(after - before)), xtol=1e-8)
    return point(along)
