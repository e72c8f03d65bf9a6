"""How time and memory grow: with the cases of one call, with the balls of a bearing, with threads and processes."""

from __future__ import annotations

import os
from dataclasses import replace
from functools import partial
from math import pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.cost import measuring, situations
from qsbearing.operation import CHANNELS
from qsbearing.solving import solve

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from qsbearing.cost.settings import Settings
    from qsbearing.scene import Scene

    Progress = Callable[[str], None]

CASES_OF_A_BALL_COUNT = 100
MEMORY_OF_A_BALL_COUNT = 5_000
"""Cases in one call: enough for the balls' arrays to stand out from the libraries."""


def measure(scene: Scene, settings: Settings, progress: Progress) -> dict[str, Any]:
    """Entries by cases, by ball count, by workers; each with its time and memory."""
    found = []
    for turn in range(settings.processes):
        progress(f"scaling: times, process {turn + 1} of {settings.processes}")
        found += measuring.in_fresh_processes(times, scene, settings, processes=1)
    seconds = measuring.pooled(found)
    jobs: dict[Any, tuple[Any, ...]] = {
        f"{size} cases": (memory_of, situations.many(scene, size)) for size in settings.sizes
    }
    for count in settings.ball_counts:
        larger = situations.many(with_balls(scene, count), MEMORY_OF_A_BALL_COUNT)
        jobs[f"{count} balls"] = memory_of, larger
    memory = measuring.peaks(jobs, settings.processes, progress)
    result: dict[str, Any] = {}
    for what, sizes in (("cases", settings.sizes), ("balls", settings.ball_counts)):
        result[what] = [
            {
                what: size,
                "case_s": measuring.spread(seconds[what, size]),
                "over_first": measuring.ratio(seconds, (what, size), (what, sizes[0])),
                "memory_MB": memory[f"{size} {what}"],
            }
            for size in sizes
        ]
    result["workers"] = []
    for kind in ("threads", "processes"):
        progress(f"scaling: {kind}")
        result["workers"] += workers(scene, settings, kind)
    return result


def times(scene: Scene, settings: Settings) -> measuring.Times:
    """Seconds a case by number of cases, and by ball count."""
    sizes: dict[Any, int] = {}
    tasks: dict[Any, Any] = {}
    for size in settings.sizes:
        sizes["cases", size] = size
        tasks["cases", size] = partial(solve, situations.many(scene, size), threads=1)
    for count in settings.ball_counts:
        sizes["balls", count] = CASES_OF_A_BALL_COUNT
        batch = situations.many(with_balls(scene, count), CASES_OF_A_BALL_COUNT)
        tasks["balls", count] = partial(solve, batch, threads=1)
    found = measuring.interleaved(tasks, settings.rounds)
    return {key: [value / sizes[key] for value in row] for key, row in found.items()}


def with_balls(scene: Scene, count: int) -> Scene:
    """The scene with so many balls, on a larger circle where they would not fit, at the same load a ball and the same
    speed of the balls' centres."""
    bearing, operation = scene.bearing, scene.operation
    ball, pitch = float(np.asarray(bearing.ball_diameter)), float(np.asarray(bearing.pitch_diameter))
    room = max(pitch, 1.05 * ball / sin(pi / max(count, 2)))
    share = count / float(np.asarray(bearing.ball_count))
    changed: dict[str, Any] = {"speed": float(np.asarray(operation.speed)) * pitch / room}
    for channel in CHANNELS:
        value = getattr(operation, channel.load)
        if value is not None:
            lever = room / pitch if channel.is_rotation else 1.0
            changed[channel.load] = float(np.asarray(value)) * share * lever
    return replace(
        scene,
        bearing=replace(bearing, ball_count=count, pitch_diameter=room),
        operation=replace(operation, **changed),
    )


def memory_of(scene: Scene) -> float:
    """Peak memory of this process once it has solved the scene, one thread, results kept."""
    solution = solve(scene, threads=1)
    peak = measuring.peak_MB()
    assert solution.shape is not None  # still held
    return peak


def worker_counts() -> tuple[int, ...]:
    """1, 2, 4, ... up to the cores that this process may use."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    counts = [1]
    while 2 * counts[-1] < cores:
        counts.append(2 * counts[-1])
    return tuple(sorted({*counts, cores}))


def workers(scene: Scene, settings: Settings, kind: str) -> list[dict[str, Any]]:
    """Time of one large call shared out: threads within the call, or processes with a part each."""
    counts = worker_counts()
    batch = situations.many(scene, settings.shared)
    if kind == "threads":
        tasks: dict[Any, Any] = {count: partial(solve, batch, threads=count) for count in counts}
        seconds = measuring.interleaved(tasks, settings.rounds)
        memory: dict[int, float | None] = dict.fromkeys(counts)
        for count in counts:
            memory[count] = measuring.in_fresh_processes(_threaded, batch, count, processes=1)[0]
    else:
        seconds, memory = _by_processes(scene, settings, counts)
    each = {key: [value / settings.shared for value in row] for key, row in seconds.items()}
    return [
        {
            "kind": kind,
            "count": count,
            "cases": settings.shared,
            "case_s": measuring.spread(each[count]),
            "speed_up": measuring.ratio(each, 1, count),
            "memory_MB": None if memory[count] is None else {"median": float(f"{memory[count]:.4g}")},
        }
        for count in counts
    ]


def _threaded(scene: Scene, threads: int) -> float:
    solution = solve(scene, threads=threads)
    peak = measuring.peak_MB()
    assert solution.shape is not None
    return peak


def _by_processes(
    scene: Scene, settings: Settings, counts: tuple[int, ...]
) -> tuple[measuring.Times, dict[int, float | None]]:
    """Processes started beforehand, each with its part of the cases; their answers travel back. Memory is theirs alone,
    summed."""
    from concurrent.futures import ProcessPoolExecutor
    from contextlib import ExitStack
    from multiprocessing import get_context

    with ExitStack() as stack:
        pools = {
            count: stack.enter_context(ProcessPoolExecutor(count, mp_context=get_context("spawn"))) for count in counts
        }

        def shared(count: int) -> list[Any]:
            parts = [(scene, settings.shared, k, count) for k in range(count)]
            return list(pools[count].map(_part, parts))

        tasks: dict[Any, Any] = {count: partial(shared, count) for count in counts}
        seconds = measuring.interleaved(tasks, settings.rounds)
        memory: dict[int, float | None] = {count: sum(peak for _, peak in shared(count)) for count in counts}
    return seconds, memory


def _part(work: tuple[Scene, int, int, int]) -> tuple[NDArray, float]:
    scene, cases, part, parts = work
    share = cases // parts + (part < cases % parts)
    solution = solve(situations.many(scene, share), threads=1)
    return solution.displacement, measuring.peak_MB()
