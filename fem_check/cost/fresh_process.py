"""A function called in a process of its own: its memory is its own, and nothing is left from the call before."""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any, TypeVar

A = TypeVar("A")
R = TypeVar("R")

LOADED = ["fem_check.cost.configurations"]
"""Modules that the processes start with, so that loading them is not measured."""


class ProcessError(Exception):
    """The process could not do its work; the message says why."""


def _context() -> Any:
    # A server that has loaded the modules and started no thread: each process is a copy of it, made in milliseconds.
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload(LOADED)
    return context


def _work(sending: Connection, function: Callable[[A], R], argument: A) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent is asked to stop, and ends this process
    try:
        sending.send((True, function(argument)))
    except Exception as problem:
        sending.send((False, f"{type(problem).__name__}: {problem}"))


def call(function: Callable[[A], R], argument: A) -> R:
    """Call a module's function with an argument in a new process.

    Raises:
        ProcessError: it raised, or its process was ended from outside (out of memory, mostly).
    """
    context = _context()
    receiving, sending = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(sending, function, argument), daemon=True)
    process.start()
    sending.close()
    try:
        done, result = receiving.recv()
    except EOFError:
        process.join()
        raise ProcessError(f"its process ended with code {process.exitcode}, as it does when memory runs out") from None
    finally:
        receiving.close()
        if process.is_alive():
            process.join(timeout=5.0 if process.exitcode is not None else 0.5)
        if process.is_alive():
            process.terminate()
            process.join()
    if not done:
        raise ProcessError(result)
    return result
