"""A question's answer, worked out in a process beside the server: for so long at most, and while somebody waits."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any

from anyio import CapacityLimiter, to_process
from anyio.lowlevel import RunVar

LONGEST = 120.0
"""Seconds of one answer; the longest of the guide's scenes takes ten, and to compile a reading a minute."""
AT_ONCE = 8
"""Processes, and answers that are worked out beside each other; further questions wait."""
SPARED = 1.5
"""Seconds that a process may go on when nobody waits for its answer: as long as another one takes to start."""
_limiter: RunVar[CapacityLimiter] = RunVar("places")


class StoppedError(Exception):
    """An answer took too long, or nobody waits for it any more."""


async def answered(
    question: Callable[..., Any], given: dict[str, Any], left: Coroutine[Any, Any, None] | None = None
) -> Any:
    """What a question returns or raises; its work ends also where whoever awaits this is cancelled.

    Args:
        question: a function of a module, or a method of what can be pickled.
        left: returns when nobody waits for the answer any more.

    Raises:
        StoppedError: it was stopped.
    """
    work = asyncio.ensure_future(_worked(question, given))
    waits: set[asyncio.Future[Any]] = {work} if left is None else {work, asyncio.ensure_future(left)}
    try:
        await asyncio.wait(waits, timeout=LONGEST, return_when=asyncio.FIRST_COMPLETED)
        if work.done():
            return work.result()
        raise StoppedError(f"the answer took longer than {LONGEST:g} s and was stopped: ask for less at once")
    finally:
        for each in waits - {work}:
            each.cancel()
        if not work.done():
            work.add_done_callback(lambda ended: ended.cancelled() or ended.exception())
            asyncio.get_running_loop().call_later(SPARED, work.cancel)


async def prepare(question: Callable[..., Any], given: dict[str, Any]) -> None:
    """Start a process that loads what a question needs, for which others wait, and beside it a spare one."""
    places = _places()
    try:
        for count in (1, 2):
            places.total_tokens = count
            await asyncio.gather(*(_worked(question, given) for _ in range(count)))
    finally:
        places.total_tokens = AT_ONCE


async def _worked(question: Callable[..., Any], given: dict[str, Any]) -> Any:
    return await to_process.run_sync(partial(question, **given), cancellable=True, limiter=_places())


def _places() -> CapacityLimiter:
    try:
        return _limiter.get()
    except LookupError:
        _limiter.set(places := CapacityLimiter(AT_ONCE))
        return places
