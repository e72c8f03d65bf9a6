"""Times and memory that can be compared: taken in turn, in several fresh processes, medians with their spread.

A shared machine's speed drifts, and each process lays out its memory in its own way. So what is compared is timed in
turn within a round, ratios are taken round by round, and the rounds of several processes are pooled. Times are those of
the processor: what else the machine does between is not counted.
"""

from __future__ import annotations

import gc
import statistics
import sys
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from qsbearing.model.version import __version__
from qsbearing.results.provenance import PACKAGES, hardware, versions

ROUND = 0.01
"""Seconds that a round spends on a call that takes less: the median of its repeats is the round's value, so that what
else the machine did meanwhile drops out."""

# Some systems count a thread's time in ticks of milliseconds; there the clock must do.
now = time.thread_time if time.get_clock_info("thread_time").resolution < 1e-6 else time.perf_counter

LOW, HIGH = 0.05, 0.95
"""Quantiles of the rounds that are stated as spread."""

Times = dict[Any, list[float]]
"""Seconds of each call, round by round."""


def interleaved(calls: dict[Any, Callable[[], Any]], rounds: int) -> Times:
    """Seconds of each call, all in turn within each round, each round beginning with another one."""
    repeats = {}
    for name, call in calls.items():
        call()  # machine code is loaded
        repeats[name] = max(1, round(ROUND / max(seconds_of(call), 1e-7)))
    times: Times = {name: [] for name in calls}
    order = list(calls)
    gc.disable()
    for turn in range(rounds):
        first = turn * len(order) // max(rounds, 1)
        for name in order[first:] + order[:first]:
            times[name].append(statistics.median(seconds_of(calls[name]) for _ in range(repeats[name])))
        gc.collect()
    gc.enable()
    return times


def seconds_of(call: Callable[[], Any]) -> float:
    """Processor time of one call."""
    began = now()
    call()
    return now() - began


def in_fresh_process(function: Callable[..., Any], *arguments: Any) -> Any:
    """What the function returns in a new process."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        return pool.submit(function, *arguments).result()


def spread(values: list[float]) -> dict[str, float]:
    """Median, and the quantiles `LOW` and `HIGH`, to four digits."""
    quantiles = np.quantile(values, [0.5, LOW, HIGH])
    return {name: float(f"{value:.4g}") for name, value in zip(("median", "low", "high"), quantiles, strict=True)}


def ratio(times: Times, of: Any, to: Any) -> dict[str, float]:
    """Median and spread of the ratio of two calls, taken round by round."""
    return spread([one / other for one, other in zip(times[of], times[to], strict=True)])


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


def machine() -> dict[str, Any]:
    """The machine and the packages that the solver rests on."""
    return {**hardware(), **versions(PACKAGES), "qsbearing": __version__}


def in_a_line(facts: dict[str, Any]) -> str:
    """The machine for the foot of a figure."""
    versions = ", ".join(f"{name} {facts[name]}" for name in ("qsbearing", "python", *PACKAGES) if name in facts)
    return f"{facts['processor']}, {facts['cores']} cores, load average {facts['load_average']}; {versions}"
