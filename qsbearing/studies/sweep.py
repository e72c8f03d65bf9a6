"""`sweep`: all points of a study, chunk by chunk, on this machine or wherever an executor brings them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from typing import TYPE_CHECKING

from qsbearing.studies.chunk import Chunk, Plan, plan_of, solve_chunk
from qsbearing.studies.dataset import dataset_of
from qsbearing.studies.points import Points
from qsbearing.studies.scenes import check
from qsbearing.studies.store import Store, open_results
from qsbearing.studies.study import Study
from qsbearing.threads import thread_count

if TYPE_CHECKING:
    import xarray

Progress = Callable[[int, int], object]
"""Called with the points done so far and all of them."""

AHEAD = 4
"""Chunks per worker that wait or are under way: enough that none idles, few enough to bound the memory."""


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
        out: a netCDF file to write. Finished chunks are kept beside it until all are there, so that nothing finished
            is lost, and the memory is bounded whatever the number of points.
        resume: go on with the chunks that an earlier run left there; the file is the same in the end.
        progress: called after each chunk with the points done and all points.

    Returns:
        xarray.Dataset: the results in the units of files, with `units` on each; the varied keys are coordinates.
            `status` and `reason` say of each point how it ended: a point that describes no bearing ("impossible"), or
            that has no equilibrium, holds NaN and stops nothing. With `out` it is read from there as it is used.

    Raises:
        SceneError: the study is wrong whatever the point; every error, at once.
        ImportError: xarray is not installed (the `studies` extra).
    """
    scene = check(study)
    points = Points(study)
    plan = plan_of(study, scene, points)
    chunks: dict[int, Chunk] = {}
    store = None if out is None else Store(out, plan, points, resume=resume)
    finished = store.finished() if store else set()
    report = progress or (lambda done, count: None)
    done = sum(points.size(number) for number in finished)
    report(done, points.count)
    left = [number for number in range(points.chunk_count) if number not in finished]
    for number, chunk in solved_chunks(plan, left, executor):
        if store:
            store.put(number, chunk)
        else:
            chunks[number] = chunk
        done += chunk.status.size
        report(done, points.count)
    if store is None:
        return dataset_of(plan, points, chunks)
    store.join()
    return open_results(store.out)


def solved_chunks(plan: Plan, numbers: list[int], executor: Executor | None) -> Iterator[tuple[int, Chunk]]:
    """The chunks of these numbers, each as soon as it is there."""
    if executor is None:
        workers = min(thread_count(), len(numbers))
        if workers <= 1:  # one chunk is shared out within the solver
            for number in numbers:
                yield number, solve_chunk(plan, number, thread_count())
            return
        with ThreadPoolExecutor(workers) as pool:
            yield from _through(plan, numbers, pool, workers)
        return
    yield from _through(plan, numbers, executor, _workers(executor))


def _workers(executor: Executor) -> int:
    client = getattr(executor, "_client", None)  # of Dask
    if client is not None:
        return max(1, sum(client.nthreads().values()))
    return int(getattr(executor, "_max_workers", None) or thread_count())


def _through(plan: Plan, numbers: list[int], executor: Executor, workers: int) -> Iterator[tuple[int, Chunk]]:
    waiting = iter(numbers)
    running: dict[Future[Chunk], int] = {}
    try:
        while True:
            for number in waiting:
                running[executor.submit(solve_chunk, plan, number)] = number
                if len(running) >= AHEAD * workers:
                    break
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                yield running.pop(future), future.result()
    finally:
        for future in running:
            future.cancel()
