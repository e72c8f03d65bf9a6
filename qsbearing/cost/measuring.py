"""Times and memory that can be compared: taken in turn, in several fresh processes, medians with their spread.

A shared machine's speed drifts, and each process lays out its memory in its own way. So what is compared is timed in
turn within a round, ratios are taken round by round, and the rounds of several processes are pooled: a later run
differs from this one as these processes differ from each other.
"""

from __future__ import annotations

import gc
import statistics
import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

SAMPLE = 2e-5
"""Seconds that one reading of the clock should span, where a call takes less."""

ROUND = 5e-4
"""Seconds that a round spends on a task, where a call takes less; their median is the round's value, so that what else
the machine did meanwhile drops out."""

LONG = 0.01
"""Seconds from which a call is read once a round only."""

LOW, HIGH = 0.05, 0.95
"""Quantiles of the rounds that are stated as spread."""

Times = dict[Any, list[float]]
"""Seconds a call of each task, round by round."""


def interleaved(tasks: dict[Any, Callable[[], Any]], rounds: int) -> Times:
    """Seconds a call of each task, all tasks in turn within each round, each round beginning with another one."""
    calls, samples = {}, {}
    for name, task in tasks.items():
        once = max(_seconds(task, 1), 1e-7)
        if once < LONG:
            once = max(min(_seconds(task, 1) for _ in range(2)), 1e-7)
        calls[name] = max(1, round(SAMPLE / once))
        samples[name] = max(3 if once < LONG else 1, round(ROUND / (calls[name] * once)))
    times: Times = {name: [] for name in tasks}
    order = list(tasks)
    collecting = gc.isenabled()
    gc.disable()
    try:
        for turn in range(rounds):
            first = turn * len(order) // max(rounds, 1)
            for name in order[first:] + order[:first]:
                values = [_seconds(tasks[name], calls[name]) for _ in range(samples[name])]
                times[name].append(statistics.median(values))
            gc.collect()
    finally:
        if collecting:
            gc.enable()
    return times


def _seconds(task: Callable[[], Any], calls: int) -> float:
    began = time.perf_counter()
    for _ in range(calls):
        task()
    return (time.perf_counter() - began) / calls


def in_fresh_processes(function: Callable[..., Any], *arguments: Any, processes: int) -> list[Any]:
    """What the function returns in each of so many new processes, one after the other."""
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    results = []
    for _ in range(processes):
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            results.append(pool.submit(function, *arguments).result())
    return results


def peaks(
    jobs: dict[Any, tuple[Any, ...]], repeats: int, progress: Callable[[str], None]
) -> dict[Any, dict[str, float] | None]:
    """Peak memory that each job, a function and its arguments, reports from processes of its own [MB].

    Two at a time: peaks, unlike times, do not disturb each other. None for a job that reports none.
    """
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    with ProcessPoolExecutor(2, mp_context=get_context("spawn"), max_tasks_per_child=1) as pool:
        waiting = {name: [pool.submit(*job) for _ in range(repeats)] for name, job in jobs.items()}
        found: dict[Any, dict[str, float] | None] = {}
        for name, futures in waiting.items():
            progress(f"memory: {name}")
            known = [peak for future in futures if (peak := future.result()) is not None]
            found[name] = spread(known) if known else None
    return found


def pooled(runs: Iterable[Times]) -> Times:
    """The rounds of several processes together."""
    together: Times = {}
    for run in runs:
        for name, seconds in run.items():
            together.setdefault(name, []).extend(seconds)
    return together


def spread(values: list[float]) -> dict[str, float]:
    """Median, and the quantiles `LOW` and `HIGH`, to four digits."""
    ordered = sorted(values)

    def quantile(part: float) -> float:
        place = part * (len(ordered) - 1)
        below = int(place)
        above = min(below + 1, len(ordered) - 1)
        return ordered[below] + (place - below) * (ordered[above] - ordered[below])

    found = {"median": statistics.median(ordered), "low": quantile(LOW), "high": quantile(HIGH)}
    return {name: float(f"{value:.4g}") for name, value in found.items()}


def ratio(times: Times, of: Any, to: Any) -> dict[str, float]:
    """Median and spread of the ratio of two tasks, taken round by round."""
    return spread([one / other for one, other in zip(times[of], times[to], strict=True)])


ROUNDING = 1e-3
"""Medians closer than this are the same: memory hardly spreads at all."""


def agrees(stated: dict[str, float], again: dict[str, float]) -> bool:
    """Whether a later median lies within the spread stated before."""
    margin = ROUNDING * stated["median"]
    return stated["low"] - margin <= again["median"] <= stated["high"] + margin


def peak_MB() -> float:
    """Peak resident memory of this process so far."""
    status = Path("/proc/self/status")
    if status.is_file():  # the other count starts with what the parent process had
        for line in status.read_text(encoding="utf-8").splitlines():
            if line.startswith("VmHWM:"):
                return float(line.split()[1]) / 1024.0
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1024.0 / (1024.0 if sys.platform == "darwin" else 1.0)
