"""How the kernel runs: as the machine code that comes with the package, else compiled by numba, else as plain Python,
with the same digits.

`kernel` marks the functions of the solver, `inlined` the small ones on each ball's path, `formula` those that Python
calls too, `entry` the few through which Python solves, with the kinds of what they take. All names stay plain functions
but for the entries, which choose at their first call. Where there is no machine code (`library` says why), an entry is
compiled by numba, if that is installed, as soon as it is to solve, or has solved, so many cases that this pays.

Environment variables:

``NUMBA_DISABLE_JIT=1``
    everything runs plain.
``QSBEARING_COMPILED=1``
    nothing does, where numba is installed or there is machine code.
``QSBEARING_LIBRARY=0``
    the machine code that comes with the package is left alone.
"""

from __future__ import annotations

import functools
import os
import sys
import threading
from collections.abc import Callable
from importlib.util import find_spec
from textwrap import shorten
from typing import Any, TypeVar, cast

import numpy as np

from qsbearing.model.compiler import kinds as of_arguments
from qsbearing.model.compiler import library, plain_records

F = TypeVar("F", bound=Callable[..., Any])

IS_PLAIN = os.environ.get("NUMBA_DISABLE_JIT", "0") not in ("0", "")
HAS_NUMBA = not IS_PLAIN and find_spec("numba") is not None
MANY = 1000
"""So many cases, in one call or in all so far, take plain Python about as long as numba takes to compile for them."""


class _Process:
    """What holds for the process."""

    always = os.environ.get("QSBEARING_COMPILED") == "1"
    fault = ""
    """Why numba cannot be loaded."""
    is_slowness_said = False
    lock = threading.RLock()


_process = _Process()
functions: dict[Any, str] = {}
"""Those of the kernel, and what they are for."""
entries: list[CompiledEntry] = []


def _mark(kind: str) -> Callable[[F], F]:
    def mark(function: F) -> F:
        functions[function] = kind
        return function

    return mark


kernel = _mark("kernel")
"""A function of the kernel, called by others of it."""
inlined = _mark("inlined")
"""A small function of each ball's evaluation and step, to stand in its callers' machine code: LLVM, left to itself,
calls most of them, and a batch takes a tenth longer. The digits are the same."""
formula = _mark("formula")
"""A closed formula, for the kernel and for Python alike."""


def entry(*kinds: Any) -> Callable[[F], F]:
    """A function of the kernel that Python calls.

    Args:
        kinds: of its arguments: `float`, `int`, `bool`, `array_of`, or a tuple of kinds. The first array leads with the
            cases.
    """

    def made(function: F) -> F:
        return cast(F, functools.wraps(function)(CompiledEntry(function, kinds)))

    return made


class CompiledEntry:
    """A function through which Python solves or reads."""

    def __init__(self, function: Any, kinds: tuple[Any, ...]) -> None:
        self.function, self.kinds = function, kinds
        self.name = f"{function.__module__}.{function.__qualname__}"
        self.flat_kinds = tuple(of_arguments.flat(kinds))
        self.has_cases = any(isinstance(kind, of_arguments.Array) for kind in self.flat_kinds)
        self.plain_cases = 0
        """Solved in plain Python so far."""
        self._run: Any = None
        self._is_sought = False
        entries.append(self)

    def __call__(self, *args: Any) -> Any:
        run = self._run
        if run is not None:
            return run(*args)
        if not self._runs_fast(args):
            try:
                return self.plain(*args)
            except (ArithmeticError, ValueError):
                # What numba gives without a word, plain Python may refuse: a number that is none.
                if not self._compile():
                    raise
        return self._run(*args)

    @property
    def is_compiled(self) -> bool:
        """Whether it is machine code in this process, or would be from its first call on."""
        return self._seek() is not None or (has_fast_code() and _process.always)

    def is_fast_for(self, cases: int) -> bool:
        """Whether a call with so many cases would run as machine code."""
        return self.is_compiled or (has_fast_code() and self.plain_cases + cases >= MANY)

    def plain(self, *args: Any) -> Any:
        """Run plain; warns of numbers that are none no more than compiled."""
        of_arguments.check(self.name, args, self.flat_kinds)
        self.plain_cases += self._cases(args)
        with np.errstate(all="ignore"):
            return plain_records.call(self.function, args)

    def by_numba(self) -> Any:
        """The function, compiled for its kinds.

        Raises:
            ImportError, OSError, MemoryError: numba cannot be loaded.
        """
        from qsbearing.model.compiler import numba_kernel

        return numba_kernel.compiled_entry(self.function, self.name, self.kinds, functions)

    def _cases(self, args: tuple[Any, ...]) -> int:
        arrays = (each for each in of_arguments.flat(args) if isinstance(each, np.ndarray))
        return int(next(arrays).size) if self.has_cases else 1

    def _seek(self) -> Any:
        if not self._is_sought and not IS_PLAIN:
            self._run, self._is_sought = library.machine_code(self.name, self.flat_kinds), True
        return self._run

    def _runs_fast(self, args: tuple[Any, ...]) -> bool:
        if self._seek() is not None:
            return True
        cases = self._cases(args)
        if not self.is_fast_for(cases):
            _say_slow(self.plain_cases + cases)
            return False
        return self._compile()

    def _compile(self) -> bool:
        """By numba; False where it is not there."""
        with _process.lock:
            try:
                self._run = self._run or (self.by_numba() if HAS_NUMBA and not _process.fault else None)
            except (ImportError, OSError, MemoryError) as error:
                _process.fault = f"numba cannot be loaded ({shorten(str(error), 150, placeholder=' ...')})"
                print(f"qsbearing: {_process.fault}: cases are solved as plain Python", file=sys.stderr, flush=True)
        return self._run is not None


def is_compiled(of: Any) -> bool:
    """Whether this entry runs as machine code in this process."""
    return bool(of.is_compiled)


def is_fast_for(of: Any, cases: int) -> bool:
    """Whether a call of this entry with so many cases would run as machine code."""
    return bool(of.is_fast_for(cases))


def has_fast_code() -> bool:
    """Whether there is another way than plain Python."""
    return not IS_PLAIN and (library.found() is not None or (HAS_NUMBA and not _process.fault))


def always_compiled() -> None:
    """From now on nothing runs plain: for those who measure."""
    _process.always = True


def _say_slow(cases: int) -> None:
    """Once, where many cases are solved plain for want of machine code."""
    if _process.is_slowness_said or IS_PLAIN or _process.fault or cases < MANY:
        return
    _process.is_slowness_said = True
    what = "solving as plain Python, hundreds of times slower"
    remedy = "the extra `compile` brings a compiler, see `qsbearing guide timing`"
    print(f"qsbearing: {what} ({library.why_none()}): {remedy}", file=sys.stderr, flush=True)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: vars(_process).update(lock=threading.RLock()))
