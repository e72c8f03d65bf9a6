"""How the kernel runs: as the plain Python that stands in the source, or compiled, whichever answers sooner.

A usual case takes plain Python some hundredths of a second: less than numba takes to be imported, and a hundredth of
what it takes to compile. So the first cases of a process run plain, with the same digits. numba is loaded when plain
Python has taken as long as loading takes, and the kernel is compiled when it has taken as long as one may wait for
that. What a known number of cases would still take counts as taken.

`kernel` marks the functions of the solver, `inlined` the small ones on each ball's path, `formula` those that Python
calls too, `entry` the few through which Python solves. All names stay plain functions but for the entries, which
decide; `numba_kernel` is told of the functions when it is needed.

Environment variables:

``NUMBA_DISABLE_JIT=1``
    everything runs plain.
``QSBEARING_COMPILED=1``
    nothing does.
``QSBEARING_BACKGROUND_COMPILER=0``
    no second process is started that compiles (`compile_in_background`).
"""

from __future__ import annotations

import functools
import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from textwrap import shorten
from time import thread_time
from typing import Any, TypeVar, cast

import numpy as np

from qsbearing.model.compiler import plain_records

F = TypeVar("F", bound=Callable[..., Any])

HAS_NUMBA = find_spec("numba") is not None
COMPILED = HAS_NUMBA and os.environ.get("NUMBA_DISABLE_JIT", "0") in ("0", "")
"""False when the kernel runs as plain Python only."""
ALWAYS = COMPILED and os.environ.get("QSBEARING_COMPILED") == "1"

# Seconds of processor time that plain Python may take before the other is chosen: about what loading takes, with numba
# and once numba is there, and half of what compiling the solver takes.
LOADING, LOADING_MORE, COMPILING = 0.5, 0.1, 4.0
SHARE = 0.1
"""An entry is loaded or compiled only if this part of the time was its own."""
FEW = 4
"""So many cases at once may run plain before it is known what one takes."""
MANY = 1000
"""So many always pay."""


class _Work(threading.local):
    """What a thread is at."""

    cases = 1
    """In the call at hand."""
    to_come = 0.0
    """Seconds of plain Python that the cases to come would take, this call's included."""
    plain = 0.0
    """Seconds of plain Python so far."""


class _Process:
    """What holds for the process."""

    always = ALWAYS
    compiles_in_background = False
    """Whether a process may be started that compiles."""
    fault = ""
    """Why numba cannot be loaded."""
    plain = 0.0
    """Seconds of plain Python so far, of all threads."""
    is_slowness_said = False
    lock = threading.RLock()


_work, _process = _Work(), _Process()
_functions: dict[Any, str] = {}
_entries: list[Entry] = []


def kernel(function: F) -> F:
    """A function of the kernel, called by others of it."""
    _functions[function] = "kernel"
    return function


def inlined(function: F) -> F:
    """A small function of each ball's evaluation and step, to stand in its callers' machine code.

    Left to itself, LLVM calls most of them: a batch takes a tenth longer. The digits are the same.
    """
    _functions[function] = "inlined"
    return function


def formula(function: F) -> F:
    """A closed formula, for the kernel and for Python alike."""
    _functions[function] = "formula"
    return function


def entry(function: F) -> F:
    """A function of the kernel that Python calls, with plain numbers, arrays and tuples of them."""
    return cast(F, functools.wraps(function)(Entry(function)))


class Entry:
    """A function through which Python solves or reads: plain, or compiled as soon as that pays."""

    def __init__(self, function: Any) -> None:
        self.function = function
        self.name = f"{function.__module__}.{function.__qualname__}"
        self._plain = 0.0
        self._compiled: Any = None
        _entries.append(self)

    def __call__(self, *args: Any) -> Any:
        if self._compiled is not None:
            return self._compiled(*args)
        if self.runs_plain(args):
            try:
                return self.plain(*args)
            except (ArithmeticError, ValueError):
                # What numba gives without a word, plain Python may refuse: a number that is none.
                if not self.use_compiled(args):
                    raise
        return (self._compiled or self.plain)(*args)

    @property
    def is_compiled(self) -> bool:
        """Whether it is, in this process."""
        return self._compiled is not None

    def plain(self, *args: Any) -> Any:
        """Run plain; warns of numbers that are none no more than compiled."""
        began = thread_time()
        try:
            with np.errstate(all="ignore"):
                return plain_records.call(self.function, args)
        finally:
            taken = thread_time() - began
            self._plain += taken
            _work.plain += taken
            _process.plain += taken

    def runs_plain(self, args: tuple[Any, ...]) -> bool:
        """Whether these arguments are for plain Python; loads or compiles it where they are not."""
        if self._compiled is not None:
            return False
        if not can_compile():
            _say_slow()
            return True
        if _process.always:
            return not self.use_compiled(args)
        if not self._pays(LOADING_MORE if "numba" in sys.modules else LOADING):
            return True
        if self.load(args):
            return False
        if self._compiles_in_background(args):
            return True
        return not (self._pays(COMPILING) and self.use_compiled(args))

    def load(self, args: tuple[Any, ...]) -> bool:
        """Use the compiled form if it was compiled before; whether it is used from now on."""
        if self._compiled is None and can_compile():
            from qsbearing.model.compiler.compiled_files import is_kept

            if is_kept(self.name):
                self._use_compiled(args, False)
        return self._compiled is not None

    def use_compiled(self, args: tuple[Any, ...]) -> bool:
        """Load or compile it for such arguments; False where numba cannot be loaded."""
        if self._compiled is None and can_compile():
            self._use_compiled(args, True)
        return self._compiled is not None

    def _use_compiled(self, args: tuple[Any, ...], compiles: bool) -> None:
        with _process.lock:
            if self._compiled is not None:
                return
            try:
                from qsbearing.model.compiler import numba_kernel
            except (ImportError, OSError, MemoryError) as error:
                _process.fault = f"numba cannot be loaded ({shorten(str(error), 150, placeholder=' ...')})"
                print(f"qsbearing: {_process.fault}: cases are solved as plain Python", file=sys.stderr, flush=True)
                return
            self._compiled = numba_kernel.compiled_entry(self.function, self.name, args, _functions, compiles)

    def _pays(self, price: float) -> bool:
        """Whether plain Python has cost as much, or would with what is known to come."""
        if _work.cases >= MANY or (self._plain == 0.0 and _work.cases > FEW):
            return True
        own = self._plain * (1.0 + _work.to_come / _process.plain if _process.plain else 1.0)
        return _process.plain + _work.to_come >= price and own >= SHARE * price

    def _compiles_in_background(self, args: tuple[Any, ...]) -> bool:
        """Whether another process compiles it, or is about to, while this one can go on."""
        if not _process.compiles_in_background or _work.to_come >= COMPILING or _work.cases >= MANY:
            return False
        from qsbearing.model.compiler import background_compiler

        with _process.lock:
            return background_compiler.is_compiling(self.name, args)


@contextmanager
def cases(count: int, to_come: float = 0.0) -> Iterator[None]:
    """What is called within is for so many cases at once; plain Python would take so many seconds more in all."""
    before = _work.cases, _work.to_come
    _work.cases, _work.to_come = count, to_come
    try:
        yield
    finally:
        _work.cases, _work.to_come = before


def plain_seconds() -> float:
    """Processor time that this thread has spent in plain Python."""
    return _work.plain


def is_compiled(entry: Any) -> bool:
    """Whether this entry is, in this process."""
    return bool(entry.is_compiled)


def can_compile() -> bool:
    """Whether there is another way than plain Python."""
    return COMPILED and not _process.fault


def may_run_plain(count: int) -> bool:
    """Whether some of so many cases may run plain before others are compiled."""
    return can_compile() and not (_process.always or count >= MANY)


def always_compiled() -> None:
    """From now on nothing runs plain: for those who measure."""
    _process.always = COMPILED


def compile_in_background() -> None:
    """From now on a second process may compile what this one will need: for those who go on solving."""
    _process.compiles_in_background = COMPILED and os.environ.get("QSBEARING_BACKGROUND_COMPILER", "1") != "0"


def _say_slow() -> None:
    """Once, where many cases are solved plain for want of numba."""
    if _process.is_slowness_said or HAS_NUMBA or _work.cases < MANY:
        return
    _process.is_slowness_said = True
    what = "solving a batch as plain Python, hundreds of times slower: install numba (pip install numba)"
    print(f"qsbearing: {what}", file=sys.stderr, flush=True)


def _after_fork() -> None:
    _process.lock = threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_after_fork)
