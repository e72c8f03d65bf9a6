"""Where the compiled kernel is kept between processes: one file for each entry and the types of its arguments.

The folder is named after a digest of all compiled files, so that any changed formula is compiled anew. A file begins
with a digest of what follows, for a power cut or a failing disk leaves pages of zeros, and machine code with a wrong
page crashes, or gives wrong numbers. What follows is a pickle: it is read only where nobody but the user can write.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from time import sleep

from qsbearing.model.compiler.private_folder import fault_of, for_the_user_alone

KEPT_VERSIONS = 4
"""Compiled kernels of this many versions of the source stay in the user's cache."""
LOCK = "compiling"
_MARKED = re.compile(rb"^@(kernel|inlined|formula|entry)$", re.MULTILINE)
"""A line of the files that count."""


def _source_digest() -> str:
    digest = hashlib.sha256(f"{sys.implementation.cache_tag} {version('numba')} {version('llvmlite')}".encode())
    for path in sorted(Path(__file__).parents[2].rglob("*.py")):
        source = path.read_bytes()
        if _MARKED.search(source) or path.name in ("workspace.py", "case.py", "numba_kernel.py"):
            digest.update(source)
    return digest.hexdigest()[:16]


@cache
def usable_folder() -> tuple[Path | None, str]:
    """(the folder for this source's compiled kernel, made; why None): one to which nobody but the user can write."""
    import platformdirs

    root = Path(os.environ.get("NUMBA_CACHE_DIR") or platformdirs.user_cache_dir("qsbearing"))
    try:
        root = root.resolve()
        folder = root / f"kernel-{_source_digest()}"
        with for_the_user_alone():
            folder.mkdir(parents=True, exist_ok=True)
        fault = fault_of(folder)
        if fault is not None:
            return None, f"{fault}: remove it, or name a folder of your own in NUMBA_CACHE_DIR"
        os.utime(folder)
        _forget_old_kernels(root)
    except OSError as error:
        return None, f"{error.filename or root}: {error.strerror}"
    return (folder, "") if os.access(folder, os.W_OK) else (None, f"{folder} cannot be written to")


def _forget_old_kernels(root: Path) -> None:
    by_age = sorted(root.glob("kernel-*"), key=lambda path: path.stat().st_mtime, reverse=True)
    for stale in by_age[KEPT_VERSIONS:]:
        shutil.rmtree(stale, ignore_errors=True)


def is_kept(name: str) -> bool:
    """Whether an entry was compiled before, for some types of arguments."""
    folder, _ = usable_folder()
    return folder is not None and any(folder.glob(f"{name}-*.kernel"))


def read(name: str, key: bytes) -> bytes | None:
    """What was written under this name and key; None where nothing was, or it is damaged, which is said."""
    folder, _ = usable_folder()
    if folder is None:
        return None
    path = _path(folder, name, key)
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        print(f"qsbearing: {path}: {error.strerror}: it is compiled again", file=sys.stderr)
        return None
    if hashlib.sha256(content[32:]).digest() != content[:32]:
        print(f"qsbearing: {path} is damaged: it is compiled again", file=sys.stderr)
        with suppress(OSError):
            path.unlink()
        return None
    return content[32:]


def write(name: str, key: bytes, content: bytes) -> None:
    """Keep it, whole or not at all; a disk that is full is said."""
    folder, _ = usable_folder()
    if folder is None:
        return
    path = _path(folder, name, key)
    half = None
    try:
        with for_the_user_alone():
            folder.mkdir(parents=True, exist_ok=True)  # another version may have removed it as an old one
        with tempfile.NamedTemporaryFile(dir=folder, prefix="half-", delete=False) as file:  # the user's alone
            half = Path(file.name)
            file.write(hashlib.sha256(content).digest() + content)
            file.flush()
            os.fsync(file.fileno())
        half.replace(path)
    except OSError as error:
        print(f"qsbearing: {path} is not kept: {error.strerror}", file=sys.stderr)
    finally:
        if half is not None:
            half.unlink(missing_ok=True)


def _path(folder: Path, name: str, key: bytes) -> Path:
    return folder / f"{name}-{hashlib.sha256(key).hexdigest()[:16]}.kernel"


@contextmanager
def alone(meanwhile: Callable[[], None]) -> Iterator[None]:
    """Within, no other process compiles for this folder: waits for the one that does, and calls this from time to time.

    A lock goes with the process that holds it. On Windows there is none, and two may compile the same.
    """
    folder, _ = usable_folder()
    if folder is None or sys.platform == "win32":
        yield
        return
    import fcntl

    with ExitStack() as kept:
        is_said = False
        try:
            with for_the_user_alone():
                file = kept.enter_context((folder / LOCK).open("wb"))
            while True:
                with suppress(BlockingIOError):
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    break
                if not is_said:
                    print("qsbearing: waiting for another process that compiles", file=sys.stderr, flush=True)
                    is_said = True
                meanwhile()
                sleep(0.1)
        except OSError:  # a disk that is full, or has no locks
            pass
        yield
