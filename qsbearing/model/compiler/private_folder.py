"""Whether a folder holds only what its user put there: what is unpickled from it is run.

Nobody else may write to the folder, to anything in it, or to a folder above it, where another could stand in its place
(but for folders with the sticky bit, such as /tmp, in which only an owner moves his own). On Windows nothing is
checked: there files have no such owner and mode (access lists rule), and the user's cache lies in his own profile.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

HAS_OWNERS = hasattr(os, "geteuid")
"""False on Windows."""

WRITABLE_BY_OTHERS = stat.S_IWGRP | stat.S_IWOTH


@contextmanager
def for_the_user_alone() -> Iterator[None]:
    """What is made within is the user's alone, whatever mode new files have elsewhere."""
    before = os.umask(0o077)
    try:
        yield
    finally:
        os.umask(before)


def fault_of(folder: Path) -> str | None:
    """Why others may have written to a folder or to what it holds, in words that begin with a path; None if nobody may.

    Args:
        folder: without symbolic links (`Path.resolve`).

    Raises:
        OSError: it cannot be read.
    """
    if not HAS_OWNERS:
        return None
    for path in folder.parents:
        found = path.stat()
        if found.st_mode & stat.S_ISVTX:
            continue
        if found.st_mode & WRITABLE_BY_OTHERS:
            return f"{path} is writable by others"
        if path == folder.parent and found.st_uid != os.geteuid():
            return f"{path} is another user's"
    for path in (folder, *folder.rglob("*")):
        try:
            found = path.lstat()
        except FileNotFoundError:  # another process's, for a moment
            continue
        if found.st_uid != os.geteuid():
            return f"{path} is another user's"
        if stat.S_ISLNK(found.st_mode):
            return f"{path} leads elsewhere"
        if found.st_mode & WRITABLE_BY_OTHERS:
            return f"{path} is writable by others"
    return None
