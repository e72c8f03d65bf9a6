"""The one file that knows numba: how the kernel is compiled, cached and announced.

`kernel` marks the small functions of the physics, `entry` the few that Python calls.
Only entries are written to disk, each with all that it calls compiled into it. numba
would notice a change in an entry's own file only, so the cache lives in a folder named
after a digest of the whole package: edit any formula and the kernel is rebuilt.

With the environment variable ``NUMBA_DISABLE_JIT=1`` every function here is the plain
Python that stands in the source: slower by a factor of hundreds, the same equations.
"""

from __future__ import annotations

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
        digest.update(path.read_bytes())
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
# No fastmath: the same digits on every run, and NaN stays NaN.
_OPTIONS: Any = {"error_model": "numpy", "no_cfunc_wrapper": True}


def kernel(function: F) -> F:
    """Compile a small function of the physics; it is built into the entries that call it."""
    return cast(F, numba.njit(**_OPTIONS)(function))


def entry(function: F) -> F:
    """Compile a function that Python calls: cached on disk, the interpreter's lock released."""
    _entries.add(function.__qualname__)
    before = numba_config.CACHE_DIR  # type: ignore[attr-defined]
    try:
        numba_config.CACHE_DIR = _CACHE_FOLDER or before  # type: ignore[attr-defined]
        return cast(F, numba.njit(**_OPTIONS, nogil=True, cache=_CACHE_FOLDER is not None)(function))
    finally:
        numba_config.CACHE_DIR = before  # type: ignore[attr-defined]


class _Announce(numba_event.Listener):
    """Says once, on stderr, that the kernel is being compiled: numba fires only when no cached copy was found."""

    def __init__(self) -> None:
        self.said = False

    def on_start(self, event: numba_event.Event) -> None:
        function = event.data["dispatcher"].py_func
        if not self.said and function.__module__.startswith("qsbearing") and function.__qualname__ in _entries:
            self.said = True
            where = f"kept in {_CACHE_FOLDER}" if _CACHE_FOLDER else "no folder to keep it in: each start will do this"
            print(f"qsbearing: compiling the solver, once, some seconds ({where})", file=sys.stderr, flush=True)

    def on_end(self, event: numba_event.Event) -> None:
        """Nothing to say."""


if COMPILED:
    numba_event.register("numba:compile", _Announce())
