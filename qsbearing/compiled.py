"""The one file that knows numba: how the kernel is compiled, cached and announced.

`kernel` marks the functions of the solver (`inlined` its topmost), `formula` those that Python may call too, `entry`
the few through which Python solves. Only entries are written to disk, each with all that it calls compiled into it.
numba would notice a change in an entry's own file only, so the cache lives in a folder named after a digest of all
compiled files: edit any formula and the kernel is rebuilt.

With the environment variable ``NUMBA_DISABLE_JIT=1`` every function here is the plain Python that stands in the source:
slower by a factor of hundreds, the same equations.
"""

from __future__ import annotations

import gc
import hashlib
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba import config as numba_config
from numba.core import event as numba_event

F = TypeVar("F", bound=Callable[..., Any])

COMPILED = not numba_config.DISABLE_JIT  # type: ignore[attr-defined]
"""False when the kernel runs as plain Python (``NUMBA_DISABLE_JIT=1``)."""

KEPT_VERSIONS = 4
"""Compiled kernels of this many versions of the source stay in the user's cache."""


def _source_digest() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        source = path.read_bytes()
        if b"qsbearing.compiled" in source or path.name == "state.py":
            digest.update(source)
    return digest.hexdigest()[:16]


def _usable_cache_folder() -> str | None:
    """The folder for this source's compiled kernel, made; None where nothing can be written."""
    named = os.environ.get("NUMBA_CACHE_DIR")
    if named:
        root = Path(named)
    else:
        import platformdirs

        root = Path(platformdirs.user_cache_dir("qsbearing"))
    folder = root / f"kernel-{_source_digest()}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        _forget_old_kernels(root)
    except OSError:
        return None
    return str(folder) if os.access(folder, os.W_OK) else None


def _forget_old_kernels(root: Path) -> None:
    import shutil

    by_age = sorted(root.glob("kernel-*"), key=lambda path: path.stat().st_mtime, reverse=True)
    for stale in by_age[KEPT_VERSIONS:]:
        shutil.rmtree(stale, ignore_errors=True)


_CACHE_FOLDER = _usable_cache_folder() if COMPILED else None
_entries: set[str] = set()


# error_model "numpy": no hidden branch before each division; the formulas guard their own.
# no_cfunc_wrapper: nothing calls these from C, and each wrapper is another function to compile.
# _nrt: nothing here allocates, so there are no references to count.
# No fastmath: the same digits on every run, and NaN stays NaN.
_OPTIONS: Any = {"error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False, "no_rewrites": True}
_njit: Any = numba.njit  # its stubs do not know these options


def kernel(function: F) -> F:
    """Compile a function of the kernel, for the entries that call it; compiled, Python cannot call it."""
    return cast(F, _njit(**_OPTIONS, no_cpython_wrapper=True)(function))


def inlined(function: F) -> F:
    """Compile a function of the kernel into those, few, that call it.

    For the topmost: each level of calls compiles all that lies below it again, and these hold the most (three levels
    less: 9.8 s of compilation instead of 11.3, the same time a point; four functions more: 14.3 instead of 15.3 on a
    slower day).
    """
    return cast(F, _njit(**_OPTIONS, no_cpython_wrapper=True, inline="always")(function))


def formula(function: F) -> F:
    """Compile a closed formula, for the kernel and for Python alike."""
    return cast(F, _njit(**_OPTIONS)(function))


def entry(function: F) -> F:
    """Compile a function that Python calls: cached on disk, the interpreter's lock released."""
    _entries.add(function.__qualname__)
    before = numba_config.CACHE_DIR  # type: ignore[attr-defined]
    try:
        numba_config.CACHE_DIR = _CACHE_FOLDER or before  # type: ignore[attr-defined]
        return cast(F, _njit(**_OPTIONS, nogil=True, cache=_CACHE_FOLDER is not None)(function))
    finally:
        numba_config.CACHE_DIR = before  # type: ignore[attr-defined]


class _Compilation(numba_event.Listener):
    """Watches our entries being compiled: says so once, on stderr, and chooses how hard to optimise.

    numba fires only when no cached copy was found. LLVM's lowest level of optimisation makes the kernel as fast as its
    highest (9.3 and 9.8 µs a point, measured in turn) and compiles it a sixth sooner. Python's search for garbage waits
    meanwhile: there is little, among millions of live objects (6.9 s instead of 7.7, for 55 MB more).
    """

    OPTIMISATION = 1

    def __init__(self) -> None:
        self._said = False
        self._levels: list[Any] = []
        self._collects = False

    @staticmethod
    def _is_ours(event: numba_event.Event) -> bool:
        return event.data["dispatcher"].py_func.__module__.startswith("qsbearing")

    def on_start(self, event: numba_event.Event) -> None:
        if not self._is_ours(event):
            return
        if not self._levels:
            self._collects = gc.isenabled()
            gc.disable()
        level = numba_config.OPT  # type: ignore[attr-defined]
        self._levels.append(level)
        numba_config.OPT = type(level)(self.OPTIMISATION)  # type: ignore[attr-defined]
        if not self._said and event.data["dispatcher"].py_func.__qualname__ in _entries:
            self._said = True
            where = f"kept in {_CACHE_FOLDER}" if _CACHE_FOLDER else "no folder to keep it in: each start will do this"
            print(f"qsbearing: compiling the solver, once, some seconds ({where})", file=sys.stderr, flush=True)

    def on_end(self, event: numba_event.Event) -> None:
        if self._is_ours(event):
            numba_config.OPT = self._levels.pop()  # type: ignore[attr-defined]
            if self._collects and not self._levels:
                gc.enable()


if COMPILED:
    numba_event.register("numba:compile", _Compilation())
