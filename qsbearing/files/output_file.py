"""A file that is either written whole or not touched at all, and whose place is tried before the work begins."""

from __future__ import annotations

import os
import re
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO, NamedTuple

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

LEFT = re.compile(r"[a-z0-9_]{8}\.part")
"""How the names of temporary files end, after that of the file itself."""


class Writer(NamedTuple):
    """What fills a claimed file, and puts it in its place; of several files all are filled first."""

    temporary: Path
    place: Path

    def __call__(self, data: bytes) -> None:
        self.fill(data)
        self.put()

    def fill(self, data: bytes) -> None:
        """Write the data, so that nothing that takes room is left to do."""
        self.temporary.write_bytes(data)

    def put(self) -> None:
        """Replace what is there."""
        put_in_place(self.temporary, self.place)


@contextmanager
def output_file(target: str) -> Iterator[Writer]:
    """Claim a place for a file, and yield what puts data there in one step; without data nothing is left behind.

    Raises:
        OSError: the place cannot be written, with a text that says why.
    """
    with _claimed(target) as (temporary, place):
        yield Writer(temporary, place)


@contextmanager
def output_stream(target: str) -> Iterator[BinaryIO]:
    """A file for data that come one after the other; in place once the block ends without an error."""
    with _claimed(target) as (temporary, place):
        with temporary.open("wb") as file:
            yield file
        put_in_place(temporary, place)


@contextmanager
def kept_rows(target: str) -> Iterator[tuple[BinaryIO, Path]]:
    """A file `target`.part for what is known before the whole is: it stays if the block ends with an error.

    What a run before has left there is replaced.

    Raises:
        OSError: it cannot be written, or another run is writing it.
    """
    place = path_of_output(target)
    part = place.with_name(f"{place.name}.part")
    try:
        handle = os.open(part, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
    except OSError as error:
        raise OSError(f"{part} cannot be written: {error.strerror}") from None
    with os.fdopen(handle, "wb") as file:
        if is_locked(file) is False:
            raise OSError("another run is writing it")
        file.truncate()
        is_kept = False
        try:
            yield file, part
        except BaseException:
            is_kept = file.tell() > 0
            raise
        finally:
            if fcntl is None:
                file.close()  # Windows removes no file that is open
            if not is_kept:
                part.unlink(missing_ok=True)


def is_locked(file: BinaryIO) -> bool | None:
    """Whether this run holds the file now, until it closes it: False where another does, None where disks cannot tell.

    The system lifts the lock of a run that is killed; on Windows there is none.
    """
    if fcntl is None:
        return None
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return None
    return True


def path_of_output(target: str) -> Path:
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
    place = path_of_output(target)
    if place.exists() and not place.is_file():  # a terminal, a pipe, /dev/null: written to, never replaced
        yield place, place
        return
    temporary, held = _temporary(place)
    with held:
        _remove_left(place)
        if fcntl is None:
            held.close()  # Windows replaces no file that is open
        try:
            yield temporary, place
        finally:
            temporary.unlink(missing_ok=True)


def _temporary(place: Path) -> tuple[Path, BinaryIO]:
    """A file of the same folder, held: only there is the last step one step, and only this proves that it can be
    written."""
    while True:
        try:
            handle, name = tempfile.mkstemp(prefix=f".{place.name[:100]}.", suffix=".part", dir=place.parent)
        except OSError as error:
            raise OSError(f"cannot be written: {error.strerror}") from None
        held = os.fdopen(handle, "wb")
        is_locked(held)
        if os.path.exists(name):  # noqa: PTH110 - or another run has taken it for one that was left
            return Path(name), held
        held.close()


def _remove_left(place: Path) -> None:
    """Remove what runs to the same file have left that were killed; those that run hold theirs."""
    beginning = f".{place.name[:100]}."
    for other in place.parent.iterdir():
        if other.name.startswith(beginning) and LEFT.fullmatch(other.name[len(beginning) :]):
            with suppress(OSError), other.open("rb") as file:
                if is_locked(file):
                    other.unlink()


def _mode(place: Path) -> int:
    """Permissions of the file that is there, else those of any new file; temporary ones are the owner's alone."""
    if place.exists():
        return stat.S_IMODE(place.stat().st_mode)
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
