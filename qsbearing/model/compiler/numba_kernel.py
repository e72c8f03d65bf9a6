"""The one file that knows numba, which compiles the kernel where no machine code came with the package.

The kernel's functions stand in their modules as plain Python. An entry is compiled from copies of them, whose globals
hold the dispatchers of those that they call in place of the functions: numba sees what it would see if each were
decorated, and the names stay plain.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any

import numba
import numpy as np
from numba.core import event

from qsbearing.model.compiler.kinds import Array
from qsbearing.model.compiler.library import ROOT, digest

# error_model "numpy": no hidden branch before each division; the formulas guard their own.
# No fastmath: the same digits on every run, and NaN stays NaN.
OPTIONS: Any = {"error_model": "numpy"}
njit: Any = numba.njit  # its stubs do not know these options


def public_dispatcher(function: Any, kind: str) -> Any:
    """Of a function of the kernel."""
    return njit(**OPTIONS, **({"forceinline": True} if kind == "inlined" else {}))(function)


class Dispatchers(dict[Any, Any]):
    """Of the kernel's functions, made as they are needed, from copies in namespaces that hold dispatchers.

    Args:
        kinds: of all functions of the kernel, what they are for.
        make: a dispatcher of a copy, by its kind.
    """

    def __init__(self, kinds: dict[Any, str], make: Callable[[Any, str], Any] = public_dispatcher) -> None:
        super().__init__()
        self._namespaces: dict[int, dict[str, Any]] = {}
        self._kinds, self._make = kinds, make

    def copy_of(self, function: Any) -> Any:
        """The function, in whose globals those of the kernel are dispatchers."""
        own = function.__globals__
        namespace = self._namespaces.setdefault(id(own), dict(own))
        copied = FunctionType(function.__code__, namespace, function.__name__, function.__defaults__)
        copied.__qualname__, copied.__module__ = function.__qualname__, function.__module__
        copied.__annotations__ = {}
        return copied

    def __missing__(self, function: Any) -> Any:
        self[function] = dispatcher = self._make(self.copy_of(function), self._kinds[function])
        return dispatcher

    def filled(self, function: Any) -> Any:
        """A copy of a function whose globals hold the dispatchers of all that it calls, and that those call."""
        waiting, seen = [function], set()
        while waiting:
            each = waiting.pop()
            seen.add(each)
            own, namespace = each.__globals__, self.copy_of(each).__globals__
            for name in each.__code__.co_names:
                called = own.get(name)
                if isinstance(called, FunctionType) and called in self._kinds:
                    namespace[name] = self[called]
                    if called not in seen:
                        waiting.append(called)
        return self.copy_of(function)


def signature(kinds: tuple[Any, ...]) -> tuple[Any, ...]:
    """numba's types of arguments of these kinds."""
    return tuple(numba.typeof(_example(kind)) for kind in kinds)


def _example(kind: Any) -> Any:
    if isinstance(kind, Array):
        return np.empty((0,) * kind.ndim, kind.dtype)
    if isinstance(kind, tuple):
        parts = [_example(each) for each in kind]
        return kind._make(parts) if hasattr(kind, "_make") else tuple(parts)
    return kind()


class _Said(event.Listener):
    """Says it, once, where numba compiles, as it does what its cache does not hold."""

    def __init__(self, what: str) -> None:
        self._what = what

    def on_start(self, _: event.Event) -> None:
        if self._what:
            print(f"qsbearing: {self._what}", file=sys.stderr, flush=True)
        self._what = ""

    def on_end(self, _: event.Event) -> None:
        """Nothing."""


def compiled_entry(function: Any, name: str, kinds: tuple[Any, ...], functions: dict[Any, str]) -> Any:
    """An entry's dispatcher for arguments of its kinds alone, compiled, or loaded from numba's cache; the interpreter's
    lock is released while it runs."""
    import platformdirs

    folder, before = os.environ.get("NUMBA_CACHE_DIR"), numba.config.CACHE_DIR  # type: ignore[attr-defined]
    # numba sees changes of an entry's own file alone: each version of all of them has its own folder.
    files = sorted(path for part in ("model", "readings") for path in (ROOT / "qsbearing" / part).rglob("*.py"))
    version = digest(path.relative_to(ROOT).as_posix() for path in files)[:16]
    root = Path(folder or platformdirs.user_cache_dir("qsbearing")) / f"numba-{version}"
    try:
        numba.config.CACHE_DIR = str(root)  # type: ignore[attr-defined]
        copied = Dispatchers(functions).filled(function)
        with event.install_listener("numba:compile", _Said(f"compiling {name} by numba, a minute")):
            return njit([signature(kinds)], **OPTIONS, nogil=True, cache=True)(copied)
    finally:
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]
