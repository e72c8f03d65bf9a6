"""Compiling in the background while a process goes on in plain Python: a detached process at low priority, one entry
at a time.

It is given the entry's name and arguments, compiles for such arguments into the user's cache, and ends. The process
that started it uses what is there when it next looks; if it ends first, the other ends its entry alone.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import Any

LOWEST = 19
"""Of priorities, as `nice` counts."""


class _Compiler:
    """The process, where one runs or has run."""

    process: subprocess.Popen[bytes] | None = None
    owner = 0
    tried: set[str] = set()  # noqa: RUF012


def is_compiling(name: str, args: tuple[Any, ...]) -> bool:
    """Whether an entry is being compiled in the background, or waits for its turn; starts it where none is.

    False where it was tried, without success, and where none can be started.
    """
    if _Compiler.owner != os.getpid():  # a fork's parent has its own
        _Compiler.process, _Compiler.owner, _Compiler.tried = None, os.getpid(), set()
    if _Compiler.process is not None and _Compiler.process.poll() is None:
        return True
    if name in _Compiler.tried or not _is_python():
        return False
    _Compiler.tried.add(name)
    try:
        _Compiler.process = _started(name, args)
    except (OSError, pickle.PicklingError):
        return False
    return True


def begin(name: str, code: str) -> None:
    """Run this code, which compiles an entry, where that was not compiled before and a process can be started."""
    from qsbearing.model.compiler.compiled_files import is_kept

    if _is_python() and not is_kept(name):
        with suppress(OSError):
            _detached(code, subprocess.DEVNULL)


def _is_python() -> bool:
    return Path(sys.executable or "").name.lower().startswith(("python", "pypy"))


def _started(name: str, args: tuple[Any, ...]) -> subprocess.Popen[bytes]:
    with tempfile.TemporaryFile() as file:
        pickle.dump((name, args), file)
        file.seek(0)
        return _detached(f"import {__name__} as c; c.main()", file)


def _detached(code: str, given: Any) -> subprocess.Popen[bytes]:
    """A process of low priority in which everything is compiled."""
    detached: dict[str, Any] = {"start_new_session": True}
    if sys.platform == "win32":
        detached = {"creationflags": subprocess.DETACHED_PROCESS | subprocess.BELOW_NORMAL_PRIORITY_CLASS}
    nice = f"import os; hasattr(os, 'nice') and os.nice({LOWEST})"
    command = [sys.executable, "-c", f"{nice}; import sys; sys.path[:0] = {sys.path!r}; {code}"]
    environment, nothing = os.environ | {"QSBEARING_COMPILED": "1"}, subprocess.DEVNULL
    return subprocess.Popen(command, stdin=given, stdout=nothing, stderr=nothing, env=environment, **detached)


def main() -> None:
    """Compile what standard input names."""
    from importlib import import_module

    name, args = pickle.load(sys.stdin.buffer)
    module, _, function = name.rpartition(".")
    getattr(import_module(module), function).use_compiled(args)
