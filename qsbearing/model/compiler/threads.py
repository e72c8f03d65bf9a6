"""How many threads there are, and how cases are shared out among them."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

VARIABLE = "QSBEARING_THREADS"
CHUNK = 1024
"""Cases that one thread takes at a time: enough to hide Python, few enough to share out evenly."""


def thread_count(threads: int | None = None) -> int:
    """Threads to use: the argument, else the environment variable QSBEARING_THREADS, else all cores.

    Raises:
        ValueError: not a positive whole number.
    """
    if threads is None:
        named = os.environ.get(VARIABLE)
        if named is None:
            return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        try:
            threads = int(named)
        except ValueError:
            raise ValueError(f"{VARIABLE} = {named!r}: must be a whole number of threads") from None
    if threads < 1:
        raise ValueError(f"threads = {threads}: at least one is needed")
    return threads


def in_threads(work: Callable[[slice], Any], count: int, threads: int) -> None:
    """Do a work for so many cases, a stretch of them at a time; machine code releases the interpreter's lock."""
    stretches = [slice(begin, min(begin + CHUNK, count)) for begin in range(0, count, CHUNK)]
    threads = min(threads, len(stretches))
    if threads <= 1:
        for stretch in stretches:
            work(stretch)
        return
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(threads) as pool:
        for each in [pool.submit(work, stretch) for stretch in stretches]:
            each.result()
