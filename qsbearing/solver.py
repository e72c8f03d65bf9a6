"""`solve`: all cases of a scene as it stands, in threads; the one place where the parts meet."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.flatten import CaseMaker
from qsbearing.kernel.admissibility import CONVERGED
from qsbearing.kernel.case import RESULT
from qsbearing.kernel.solve_case import UNFINISHED, solve_cases
from qsbearing.kernel.workspace import working_memory
from qsbearing.scene.scene import Scene
from qsbearing.solution import Solution

THREADS_VARIABLE = "QSBEARING_THREADS"
CHUNK = 1024
"""Cases that one thread solves at a time: enough to hide Python, few enough to share out evenly."""

TOLERANCE = 1e-12
KEPT_RECORDS = 64
"""Solutions of up to this many cases keep their case records; larger ones make them again where they are needed."""


def thread_count(threads: int | None = None) -> int:
    """Threads to use: the argument, else the environment variable QSBEARING_THREADS, else all cores.

    Raises:
        ValueError: not a positive whole number.
    """
    if threads is None:
        named = os.environ.get(THREADS_VARIABLE)
        if named is None:
            return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        try:
            threads = int(named)
        except ValueError:
            raise ValueError(f"{THREADS_VARIABLE} = {named!r}: must be a whole number of threads") from None
    if threads < 1:
        raise ValueError(f"threads = {threads}: at least one is needed")
    return threads


def solve(
    scene: Scene, *, start: Solution | None = None, threads: int | None = None, tolerance: float = TOLERANCE
) -> Solution:
    """Solve every case of a scene.

    Args:
        scene: what to solve; its array fields broadcast to the case axes.
        start: a solution near this one (same case axes and ball axis, or a single case) to continue from.
        threads: at most this many; None: the environment variable QSBEARING_THREADS, else all cores.
        tolerance: largest imbalance over the largest force at which a case counts as solved. Where rounding forbids
            it, 1e-10 is accepted and `Solution.residual` tells.

    Returns:
        Solution: raises nothing for a physical outcome; `status` and `qs.message` say what happened, case by case.

    Raises:
        ValueError: array fields that do not broadcast, a start of other axes, a tolerance or thread count out of range.
    """
    if not 0.0 < tolerance <= 0.1:
        raise ValueError(f"tolerance = {tolerance}: must lie between 0 and 0.1")
    if scene.tolerance is not None:
        raise ValueError("the scene leaves its effects to be chosen: solve it by `qsbearing.solve`")
    began = time.perf_counter()
    mounted = None if scene.as_mounted is None else solve(scene.as_mounted, threads=threads)
    maker = CaseMaker(scene, _preloaded(scene, mounted))
    count = maker.count
    found = _start(start, maker)
    cases: NDArray | None = None
    workers = thread_count(threads)

    def solve_stretch(begin: int) -> NDArray:
        stop = min(begin + CHUNK, count)
        records = maker.make(begin, stop)
        results, positions, controls = (array[begin:stop] for array in found)
        memory = working_memory(maker.ball_axis)
        given = (records, *memory, tolerance, start is not None, results, positions, controls)
        solve_cases(*given)
        if results["status"].max() == UNFINISHED:
            from qsbearing.kernel.fallback import solve_unfinished  # compiled only when a case first needs it

            solve_unfinished(np.flatnonzero(results["status"] == UNFINISHED), *given)
        return records

    if count <= KEPT_RECORDS:
        cases = solve_stretch(0)
    else:
        in_threads(solve_stretch, count, min(workers, -(-count // CHUNK)))
    return Solution(maker, cases, *found, seconds=time.perf_counter() - began, mounted=mounted)


def _preloaded(scene: Scene, mounted: Solution | None) -> dict[str, Any]:
    """What the preload makes of the axial channel."""
    if scene.preload is None:
        return {}
    if mounted is None:
        return {"axial_load": scene.preload.spring}
    return {"axial_displacement": mounted.displacement[..., 0]}


def in_threads(solve_stretch: Callable[[int], object], count: int, workers: int) -> None:
    """Solve stretches of CHUNK cases, beginning at these numbers, in so many threads."""
    first, *others = range(0, count, CHUNK)
    solve_stretch(first)  # compiled or loaded once, not by every thread
    if workers == 1:
        for begin in others:
            solve_stretch(begin)
        return
    with ThreadPoolExecutor(workers) as pool:
        for done in [pool.submit(solve_stretch, begin) for begin in others]:
            done.result()


def _start(start: Solution | None, maker: CaseMaker) -> tuple[NDArray, NDArray, NDArray]:
    """Results, ball positions and controls to fill, holding the start where there is one."""
    count, balls = maker.count, maker.ball_axis
    results = np.empty(count, RESULT)
    positions, controls = np.empty((count, balls, 3)), np.zeros((count, balls), np.int8)
    if start is None:
        return results, positions, controls
    if not isinstance(start, Solution):
        raise TypeError(f"start = {start!r}: must be a Solution")
    if start._maker.ball_axis != balls or start._maker.count not in (1, count):
        raise ValueError(
            f"start has case axes {start.shape} and {start._maker.ball_axis} balls; the scene has {maker.shape} and "
            f"{balls}: a start must match, or be a single case with as many balls"
        )
    results[:], positions[:], controls[:] = start._results, start._positions, start._controls
    # A start that failed holds no place to continue from; zero is one that every solve leaves by its own means.
    failed = results["status"] != CONVERGED
    results["displacement"][failed], positions[failed], controls[failed] = 0.0, 0.0, 0
    return results, positions, controls
