"""Worker processes that solve one range of scenes after another, and are replaced when one does not come back.

The compiled kernel cannot be interrupted from within its process, so a scene on which it never returned would hold up
everything. A range that takes too long is ended together with its process and tried again in halves, down to the one
scene at fault.
"""

from __future__ import annotations

import multiprocessing
import signal
import time
from collections.abc import Callable, Iterator
from typing import Any

PATIENCE = 300.0
"""Seconds for a range; a chunk takes some, with a process that starts and a machine that others use."""

POLL = 0.01
"""Seconds between looks at the workers."""

Range = tuple[int, int]


def solve_ranges(
    ranges: list[Range], solve: Callable[[int, int], Any], workers: int, patience: float = PATIENCE
) -> Iterator[tuple[Range, Any]]:
    """(range, `solve(first, stop)`) in the order in which they are done; (range, None) for a scene that hangs.

    Raises:
        Exception: what `solve` raises, with the traceback of its process.
    """
    context = multiprocessing.get_context("spawn")
    waiting = ranges[::-1]
    pools: list[Any] = []
    running: dict[Any, tuple[Range, Any, float]] = {}

    def start(pool: Any = None) -> None:
        if not waiting:
            return
        if pool is None:
            # An interrupted campaign is ended by its main process.
            pools.append(pool := context.Pool(1, signal.signal, (signal.SIGINT, signal.SIG_IGN)))
        part = waiting.pop()
        running[pool] = part, pool.apply_async(solve, part), time.monotonic() + patience

    try:
        for _ in range(min(workers, len(ranges))):
            start()
        while running:
            time.sleep(POLL)
            for pool, (part, result, deadline) in list(running.items()):
                first, stop = part
                if result.ready():
                    del running[pool]
                    start(pool)
                    yield part, result.get()
                elif time.monotonic() > deadline:
                    del running[pool]
                    pool.terminate()
                    middle = (first + stop) // 2
                    waiting += [(middle, stop), (first, middle)] if stop - first > 1 else []
                    start()
                    if stop - first == 1:
                        yield part, None
    finally:
        for pool in pools:
            pool.terminate()
            pool.join()
