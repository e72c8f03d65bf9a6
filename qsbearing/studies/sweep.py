"""`sweep`: all points of a study, chunk by chunk, on this machine or wherever an executor brings them."""

from __future__ import annotations

import logging
import os
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

from qsbearing.model.compiler.threads import thread_count
from qsbearing.model.validation import check_kind
from qsbearing.studies.chunk import Chunk, Plan, plan_of, solve_chunk
from qsbearing.studies.dataset import dataset_of
from qsbearing.studies.points import Points
from qsbearing.studies.scenes import check
from qsbearing.studies.store import Here, open_results, solve_into, store_at
from qsbearing.studies.study import Study

if TYPE_CHECKING:
    import xarray

LOG = logging.getLogger("qsbearing")

Progress = Callable[[int, int], object]
"""Called with the points done so far and all of them."""

WITHOUT_WORKERS = 60.0
"""Seconds that a cluster may be without a worker: time enough to start one again."""
LOOK = 2.0
"""Seconds between two looks at a cluster's workers."""

CHUNKS_PER_WORKER = 4
"""Chunks that wait or are under way: enough that none idles, few enough to bound the memory."""


def sweep(
    study: Study,
    executor: Executor | None = None,
    *,
    out: str | os.PathLike[str] | None = None,
    resume: bool = False,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """Solve every point of a study.

    Args:
        executor: anything of the interface of `concurrent.futures`, such as a process pool or the executor of a Dask
            client; None: this machine's cores.
        out: a netCDF file to write; an existing file is replaced at the end. Finished chunks are kept next to it until
            all are finished, so that none is lost, and the memory does not grow with the number of points.
        resume: continue with the chunks that an earlier run left there; the resulting file is the same.
        progress: called after each chunk with the points done and all points.

    Returns:
        xarray.Dataset: the results in the units of files, with `units` on each; the varied keys are coordinates.
            `status` and `reason` say of each point how it ended: a point that describes no bearing ("impossible"), or
            that has no equilibrium, holds NaN and does not stop the sweep. With `out`, the results are read from there
            as they are used.

    Raises:
        SceneError: the study is wrong whatever the point; every error, at once. Or `out` cannot be written, or another
            run is using it.
        TimeoutError: a Dask cluster has had no worker for a minute.
        ImportError: xarray is not installed (the `studies` extra).

    Examples:
        >>> results = qs.sweep(qs.Study.of("b218", {"speed_rpm": [0, 10_000]}))
        >>> print(results["ring_displacement_axial"].values.round(2))
        [35.87 14.76]
    """
    check_kind("sweep", study, "Study")
    scene = check(study)
    points = Points(study)
    plan = plan_of(study, scene, points)
    chunks: dict[int, Chunk] = {}
    with nullcontext() if out is None else store_at(out, plan, points, resume=resume) as store:
        finished = store.finished() if store else set()
        report = progress or (lambda done, count: None)
        done = sum(points.size(number) for number in finished)
        report(done, points.count)
        left = [number for number in range(points.chunk_count) if number not in finished]
        for number, chunk in solved_chunks(plan, left, executor, store.here if store else None):
            if store and isinstance(chunk, Chunk):
                store.put(number, chunk)
            elif isinstance(chunk, Chunk):
                chunks[number] = chunk
            done += points.size(number)
            report(done, points.count)
        if store is None:
            return dataset_of(plan, points, chunks)
        store.join()
    return open_results(store.out)


def solved_chunks(
    plan: Plan, numbers: list[int], executor: Executor | None, here: Here | None = None
) -> Iterator[tuple[int, Chunk | int]]:
    """The chunks of these numbers, each as soon as it is there.

    Args:
        here: a store in which the processes of an executor keep what they solve, as far as they reach it: they give
            back how many points that is, so that the client need not pass on the results.
    """
    if executor is None:
        workers = min(thread_count(), len(numbers))
        if workers <= 1:  # one chunk is shared out within the solver
            for number in numbers:
                yield number, solve_chunk(plan, number, thread_count())
            return
        with ThreadPoolExecutor(workers) as pool:
            yield from _through(partial(solve_chunk, plan), numbers, pool, workers)
        return
    task = partial(solve_chunk, plan) if here is None else partial(solve_into, here, plan)
    yield from _through(task, numbers, executor, _workers(executor))


def _workers(executor: Executor) -> int:
    client = getattr(executor, "_client", None)  # of Dask
    if client is not None:
        return max(1, sum(client.nthreads().values()))
    return int(getattr(executor, "_max_workers", None) or thread_count())


def _done(running: Iterable[Future[Any]], executor: Executor) -> Iterable[Future[Any]]:
    """Those that are done, as soon as one is.

    Raises:
        TimeoutError: a cluster has had no worker for `WITHOUT_WORKERS`.
    """
    client: Any = getattr(executor, "_client", None)  # of Dask
    without_since: float | None = None
    while not (done := wait(running, None if client is None else LOOK, FIRST_COMPLETED).done):
        if client.nthreads():  # only the wait for a cluster ends before one is done
            without_since = None
        elif without_since is None:
            without_since = time.monotonic()
            LOG.warning("the cluster has no worker: waiting %g s for one", WITHOUT_WORKERS)
        elif time.monotonic() - without_since > WITHOUT_WORKERS:
            raise TimeoutError(f"it has had no worker for {WITHOUT_WORKERS:g} s")
    return done


def _through(
    task: Callable[[int], Chunk | int], numbers: list[int], executor: Executor, workers: int
) -> Iterator[tuple[int, Chunk | int]]:
    waiting = iter(numbers)
    running: dict[Future[Chunk | int], int] = {}
    try:
        while True:
            for number in waiting:
                running[executor.submit(task, number)] = number
                if len(running) >= CHUNKS_PER_WORKER * workers:
                    break
            if not running:
                return
            # Those that failed last: what was solved beside them is not lost.
            for future in sorted(_done(running, executor), key=lambda each: each.exception() is not None):
                yield running.pop(future), future.result()
    finally:
        for future in running:
            future.cancel()
