"""Repeats, taken in turn: a shared machine's speed drifts, and compared times must see the same drift."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from math import exp, pi, sqrt
from typing import Any, TypeVar

import numpy as np
from scipy.stats import t as student

from fem_check.agreement import Level
from fem_check.cost import fresh_process
from fem_check.elastic_body import Progress

A = TypeVar("A")

CONFIDENCE = 0.999
"""That a ratio comes out between its bounds when all is measured anew: of sixty, all do in 94 runs of 100."""
REPEATS = 3
MORE_REPEATS = {Level.QUICK: 0, Level.RELEASE: 2}
"""Extra rounds for what takes less than `SHORT`: there a disturbance weighs most, and a repeat costs least."""
SHORT = 1.5
"""[s]"""


def spread(values: Sequence[float]) -> dict[str, Any]:
    """Median, smallest, largest and number of repeats."""
    return {**_short(statistics.median(values), min(values), max(values)), "runs": len(values)}


def _short(median: float, low: float, high: float) -> dict[str, Any]:
    """To three digits: more would be noise."""
    return {name: float(f"{v:.3g}") for name, v in (("median", median), ("low", low), ("high", high))}


def ratios(series: list[list[float]], reference: int) -> list[dict[str, Any] | None]:
    """Each series over the reference's, round by round: the median, and between what another run's median will lie.

    Args:
        series: values by round; empty for what was not measured, whose ratio is None.
        reference: index of the series to compare with.

    The bounds are those of Student's t for the difference of two medians of logarithms, with `CONFIDENCE` in each.
    Three rounds estimate their own scatter poorly, so no series is taken to scatter less than all do together.
    """
    logs = [np.log([own / other for own, other in zip(values, series[reference], strict=False)]) for values in series]
    others = [each for index, each in enumerate(logs) if index != reference and len(each) > 1]
    freedom = sum(len(each) - 1 for each in others)
    pooled = sum(float(((each - each.mean()) ** 2).sum()) for each in others) / max(freedom, 1)
    found: list[dict[str, Any] | None] = []
    for index, each in enumerate(logs):
        if not len(each):
            found.append(None)
            continue
        middle = float(np.median(each))
        half = 0.0
        if index != reference and freedom:
            variance = max(pooled, float(each.var(ddof=1)) if len(each) > 1 else 0.0)
            # Two medians, each with pi/2 times the variance of a mean.
            half = float(student.ppf(0.5 + 0.5 * CONFIDENCE, freedom)) * sqrt(pi * variance / len(each))
        found.append(_short(exp(middle), exp(middle - half), exp(middle + half)))
    return found


def interleaved(
    function: Callable[[A], dict[str, Any]],
    arguments: list[A],
    level: Level,
    progress: Progress,
    names: Callable[[A], str],
) -> list[list[dict[str, Any]] | str]:
    """Results of the function for each argument, round by round, each call in a process of its own.

    Every second round runs backwards. For an argument that fails the result is the message of the failure.
    """
    results: list[list[dict[str, Any]] | str] = [[] for _ in arguments]
    rounds = REPEATS + MORE_REPEATS[level]
    for turn in range(rounds):
        order = range(len(arguments)) if turn % 2 == 0 else range(len(arguments) - 1, -1, -1)
        for done, index in enumerate(order):
            part = (turn + done / len(arguments)) / rounds
            earlier = results[index]
            if isinstance(earlier, str) or (turn >= REPEATS and _is_long(earlier)):
                continue
            progress(f"round {turn + 1}: {names(arguments[index])}", part)
            try:
                earlier.append(fresh_process.call(function, arguments[index]))
            except fresh_process.ProcessError as problem:
                results[index] = str(problem)
    return results


def _is_long(earlier: list[dict[str, Any]]) -> bool:
    return statistics.median(run["seconds"] for run in earlier) > SHORT
