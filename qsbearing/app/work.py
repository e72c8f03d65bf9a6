"""A question's answer, worked out beside the server: for so long at most, and for as long as somebody waits for it.

In a thread, which an exception ends. A process could be ended without one, but costs two seconds of processor time and
105 MB to start, where an answer of the page costs a quarter of a second; each that is given up, by every further edit,
would end one.
"""

from __future__ import annotations

import asyncio
import ctypes
from collections.abc import Callable, Coroutine
from contextlib import suppress
from threading import Thread
from typing import Any

LONGEST = 120.0
"""Seconds of one answer; the longest of the guide's scenes takes ten, and to compile a reading a minute."""
AT_ONCE = 8
"""Answers that are worked out beside each other; further questions wait."""
AGAIN = 0.5
"""Seconds after which work that goes on is told again to end."""
_places: dict[asyncio.AbstractEventLoop, asyncio.Semaphore] = {}


class StoppedError(Exception):
    """An answer took too long, or nobody waits for it any more."""


class _EndError(BaseException):
    """Raised within the work that is to end."""


async def answered(
    question: Callable[..., Any], given: dict[str, Any], left: Coroutine[Any, Any, None] | None = None
) -> Any:
    """What a question returns or raises; its work ends also where whoever awaits this is cancelled.

    Args:
        left: returns when nobody waits for the answer any more.

    Raises:
        StoppedError: it was stopped.
    """
    loop = asyncio.get_running_loop()
    async with _places.setdefault(loop, asyncio.Semaphore(AT_ONCE)):
        done: asyncio.Future[Any] = loop.create_future()

        def settle(put: Callable[[Any], None], outcome: Any) -> None:
            if not done.done():
                put(outcome)

        def work() -> None:
            with suppress(_EndError):
                try:
                    put, outcome = done.set_result, question(**given)
                except Exception as error:
                    put, outcome = done.set_exception, error
                with suppress(RuntimeError):  # the server has ended
                    loop.call_soon_threadsafe(settle, put, outcome)

        thread = Thread(target=work, daemon=True)
        thread.start()
        waits = {done} if left is None else {done, asyncio.ensure_future(left)}
        try:
            await asyncio.wait(waits, timeout=LONGEST, return_when=asyncio.FIRST_COMPLETED)
            if done.done():
                return done.result()
            raise StoppedError(f"the answer took longer than {LONGEST:g} s and was stopped: ask for less at once")
        finally:
            if not done.done():
                _end(thread, loop)
            for each in waits:
                each.cancel()


def _end(thread: Thread, loop: asyncio.AbstractEventLoop) -> None:
    """End what a thread of Python is at; compiled code first ends what it is at.

    Python drops an exception within a callback, as of a weak reference or its garbage collector: it is raised again
    until the thread has ended.
    """
    if thread.ident is not None and thread.is_alive():
        ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(_EndError))
        loop.call_later(AGAIN, _end, thread, loop)
