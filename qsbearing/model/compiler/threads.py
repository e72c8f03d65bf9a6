"""How many threads there are, and how cases are shared out among them."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

from qsbearing.model.compiler import compiled

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
    """Do a work, which releases the interpreter's lock where it is compiled, for so many cases: a stretch of them at a
    time.

    Where it may pay to run them plain, the first is done alone, which tells what the others would take, and then twice
    as many each time.
    """
    if count == 1:
        work(slice(0, 1))
        return
    done, plain = 0, 0.0
    while done < count and compiled.may_run_plain(count):
        part = slice(done, min(max(1, 2 * done), count))
        before = compiled.plain_seconds()
        with compiled.cases(part.stop - done, plain / done * (count - done) if done else 0.0):
            work(part)
        done, plain = part.stop, plain + compiled.plain_seconds() - before
        if compiled.plain_seconds() == before:
            break
    stretches = [slice(begin, min(begin + CHUNK, count)) for begin in range(done, count, CHUNK)]

    def do(stretch: slice) -> None:
        with compiled.cases(count):
            work(stretch)

    threads = min(threads, len(stretches))
    if stretches:
        do(stretches[0])  # compiled or loaded once, not by every thread
    if threads <= 1:
        for stretch in stretches[1:]:
            do(stretch)
        return
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(threads) as pool:
        for each in [pool.submit(do, stretch) for stretch in stretches[1:]]:
            each.result()
