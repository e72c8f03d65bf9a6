"""Repeats, taken in turn: a shared machine's speed drifts, and competing figures must meet the same drift."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

from fem_check.agreement import Level
from fem_check.cost import fresh_process
from fem_check.elastic_body import Progress

A = TypeVar("A")

REPEATS = 3
MORE_REPEATS = {Level.QUICK: 0, Level.RELEASE: 2}
"""Extra rounds for what is over within `SHORT`: there a disturbance weighs most, and another look costs least."""
SHORT = 1.5
"""[s]"""


def spread(values: Sequence[float], digits: int = 3) -> dict[str, Any]:
    """Median, smallest, largest and number of repeats, to so many digits."""
    median, low, high = (float(f"{v:.{digits}g}") for v in (statistics.median(values), min(values), max(values)))
    return {"median": median, "min": low, "max": high, "runs": len(values)}


def interleaved(
    function: Callable[[A], dict[str, Any]],
    arguments: list[A],
    level: Level,
    progress: Progress,
    names: Callable[[A], str],
) -> list[list[dict[str, Any]] | str]:
    """What the function answers to each argument, round by round, each call in a process of its own.

    Every second round runs backwards. An argument that fails is answered with the sentence of its failure.
    """
    answers: list[list[dict[str, Any]] | str] = [[] for _ in arguments]
    rounds = REPEATS + MORE_REPEATS[level]
    for turn in range(rounds):
        order = range(len(arguments)) if turn % 2 == 0 else range(len(arguments) - 1, -1, -1)
        for done, index in enumerate(order):
            part = (turn + done / len(arguments)) / rounds
            earlier = answers[index]
            if isinstance(earlier, str) or (turn >= REPEATS and _is_long(earlier)):
                continue
            progress(f"round {turn + 1}: {names(arguments[index])}", part)
            try:
                earlier.append(fresh_process.call(function, arguments[index]))
            except fresh_process.ProcessError as problem:
                answers[index] = str(problem)
    return answers


def _is_long(earlier: list[dict[str, Any]]) -> bool:
    return statistics.median(run["seconds"] for run in earlier) > SHORT
