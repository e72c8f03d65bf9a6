"""Workers: processes that each solve chunk after chunk, and are replaced when one does not come back.

The compiled kernel cannot be interrupted from within its process, so a scene on which it never returned would hold up
everything. Workers say what they are about to do; one that is silent too long is ended, its group is then solved scene
by scene, and the scene that still does not come back is written down as such.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from multiprocessing.connection import Connection, wait
from typing import Any

from qsbearing.cost.measuring import peak_MB

START_UP = 300.0
"""Seconds: the first worker compiles the kernel."""

PATIENCE = 120.0
"""Seconds for a group; one takes milliseconds, and up to seconds where many scenes fail and are followed up."""


RunChunk = Callable[..., dict[str, Any]]


@dataclass
class Task:
    """A chunk to solve, and what is known to go wrong in it."""

    chunk: int
    count: int
    isolated: set[int] = field(default_factory=set)
    hung: set[int] = field(default_factory=set)


def work(connection: Connection, seed: int, run_chunk: RunChunk | None) -> None:
    """The life of a worker: tasks in, heartbeats and summaries out."""
    import numpy as np

    if run_chunk is None:
        from tests.campaign.chunk import compile_detours, run_chunk

        compile_detours()  # by one worker, as the rest of the kernel
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupted campaign is ended by its employer
    np.seterr(all="ignore")  # what is not a number is found by the checks
    run_chunk(seed, 0, 1)  # the kernel is compiled, or loaded
    connection.send(("ready", memory_MB()))
    while True:
        task = connection.recv()
        if task is None:
            return
        try:
            summary = run_chunk(
                seed,
                task.chunk,
                task.count,
                isolated=task.isolated,
                hung=task.hung,
                beat=lambda group, scene: connection.send(("beat", (group, scene))),
            )
        except Exception:  # a fault of the campaign itself
            connection.send(("fault", traceback.format_exc()))
            return
        connection.send(("done", summary | {"memory_MB": memory_MB(), "worker": os.getpid()}))


def memory_MB() -> float:
    """Peak memory of this process so far; the system's plainer count starts with what the parent process had."""
    return round(peak_MB(), 1)


@dataclass
class Worker:
    """A worker as its employer sees it."""

    process: Any
    connection: Connection
    deadline: float
    task: Task | None = None
    at: tuple[int, int] = (-1, -1)


def solve_chunks(
    tasks: list[Task], seed: int, workers: int, patience: float = PATIENCE, run_chunk: RunChunk | None = None
) -> Iterator[dict[str, Any]]:
    """Summaries of all tasks, in the order in which they are done.

    Args:
        patience: seconds of silence after which a worker counts as not coming back.
        run_chunk: what a worker does with a chunk; None: `tests.campaign.chunk.run_chunk`.

    Raises:
        RuntimeError: the campaign's own code failed in a worker, or no worker starts.
    """
    context = multiprocessing.get_context("spawn")
    waiting = list(reversed(tasks))
    left = len(tasks)
    staff: list[Worker] = []

    def hire(task: Task | None) -> None:
        ours, theirs = context.Pipe()
        process = context.Process(target=work, args=(theirs, seed, run_chunk), daemon=True)
        process.start()
        theirs.close()
        staff.append(Worker(process, ours, time.monotonic() + START_UP, task))

    def next_task(worker: Worker) -> None:
        if worker.task is None:
            worker.task = waiting.pop() if waiting else None
        worker.at = (0, -1)
        worker.connection.send(worker.task)
        worker.deadline = time.monotonic() + patience

    if tasks:
        hire(None)  # the others once it is ready: the kernel is compiled once
    try:
        while left:
            for connection in wait([worker.connection for worker in staff], timeout=min(1.0, 0.25 * patience)):
                worker = next(worker for worker in staff if worker.connection is connection)
                try:
                    word, content = worker.connection.recv()
                except EOFError:
                    raise RuntimeError(f"a worker ended by itself, at {worker.task}, {worker.at}") from None
                worker.deadline = time.monotonic() + patience
                if word == "beat":
                    worker.at = content
                elif word == "fault":
                    raise RuntimeError(f"in chunk {worker.task}:\n{content}")
                elif word == "ready":
                    next_task(worker)
                    if len(staff) < min(workers, len(tasks)):
                        hire(None)
                else:
                    left -= 1
                    worker.task = None
                    yield content
                    if waiting:
                        next_task(worker)
            for worker in [worker for worker in staff if worker.task and time.monotonic() > worker.deadline]:
                worker.process.kill()
                worker.process.join()
                staff.remove(worker)
                hire(learned(worker))
    finally:
        for worker in staff:
            worker.process.kill()
            worker.process.join()


def learned(worker: Worker) -> Task:
    """The task of a worker that did not come back, with what that teaches about it."""
    from tests.campaign.sizes import GROUP

    task = worker.task
    assert task is not None
    group, scene = worker.at
    if group < 0:
        raise RuntimeError("a worker does not start")
    if scene < 0:
        task.isolated.add(group)
    else:
        task.hung.add(GROUP * group + scene)
    return task
