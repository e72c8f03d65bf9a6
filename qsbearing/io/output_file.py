"""A file that is either written whole or not touched at all, and whose place is tried before the work begins."""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

Writer = Callable[[bytes], object]


@contextmanager
def output_file(target: str) -> Iterator[Writer]:
    """Claim a place for a file, and yield what puts data there in one step; without data nothing is left behind.

    Raises:
        OSError: the place cannot be written, with a text that says why.
    """
    with _claimed(target) as (temporary, place):

        def write(data: bytes) -> None:
            temporary.write_bytes(data)
            put_in_place(temporary, place)

        yield write


@contextmanager
def output_stream(target: str) -> Iterator[BinaryIO]:
    """Likewise a file for data that come one after the other; in place once the block ends without an error."""
    with _claimed(target) as (temporary, place):
        with temporary.open("wb") as file:
            yield file
        put_in_place(temporary, place)


def place_of(target: str) -> Path:
    """Where a file goes: through links, so that a link stays one and what it points at is replaced.

    Raises:
        OSError: it cannot go there, with a text that says why.
    """
    place = Path(os.path.realpath(target))
    if not target:
        raise OSError("no file name is given")
    if place.is_dir() or target.endswith(os.sep):
        raise OSError("is a folder")
    if not place.parent.is_dir():
        raise OSError(f"there is no folder {place.parent}")
    if place.exists() and not os.access(place, os.W_OK):
        raise OSError("is write-protected")
    return place


def put_in_place(temporary: Path, place: Path) -> None:
    """Replace what is there, in one step, by a file of the same folder, or of the same disk at least."""
    if temporary != place:
        temporary.chmod(_mode(place))
        temporary.replace(place)


@contextmanager
def _claimed(target: str) -> Iterator[tuple[Path, Path]]:
    """Where to write meanwhile, and the place itself; the same where that is none to be replaced, as a pipe is."""
    place = place_of(target)
    if place.exists() and not place.is_file():  # a terminal, a pipe, /dev/null: written to, never replaced
        yield place, place
        return
    try:
        # In the same folder: only there is the last step one step, and only this proves that it can be written.
        handle, name = tempfile.mkstemp(prefix=f".{place.name[:100]}.", suffix=".part", dir=place.parent)
    except OSError as error:
        raise OSError(f"cannot be written: {error.strerror}") from None
    os.close(handle)
    temporary = Path(name)

    try:
        yield temporary, place
    finally:
        temporary.unlink(missing_ok=True)


def _mode(place: Path) -> int:
    """Permissions of the file that is there, else those of any new file; temporary ones are the owner's alone."""
    if place.exists():
        return stat.S_IMODE(place.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
