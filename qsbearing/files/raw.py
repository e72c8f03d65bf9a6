"""The bytes of a file: a regular one, and no more of it than may be read."""

from __future__ import annotations

import os
import stat
import sys
from pathlib import Path
from typing import BinaryIO

from qsbearing.files.file_errors import SceneFileError, refused

STANDARD_INPUT = ("-", "/dev/stdin")
"""Names under which what another program prints is read."""


def read_bytes(path: Path, most: int, what: str) -> bytes:
    """All bytes of a file.

    Args:
        most: bytes that it may have.
        what: the kind of file, as in "a scene file".

    Raises:
        SceneFileError: it is no regular file, cannot be read, or is longer.
    """
    try:
        check_regular(path, what)
        # Without waiting: a pipe may have taken the file's place meanwhile.
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
        with os.fdopen(handle, "rb") as file:
            return _bounded(file, path, most, what)
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        if isinstance(error, SceneFileError):
            raise
        raise _unreadable(path, error) from None


def check_regular(path: Path, what: str) -> None:
    """See that there is a file that ends: no folder, pipe or device.

    Raises:
        SceneFileError: there is none.
    """
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError) as error:
        raise _unreadable(path, error) from None
    if stat.S_ISDIR(mode):
        raise refused(path, f"is a folder, not {what}")
    if not stat.S_ISREG(mode):
        cause = "`-` in place of a name reads what another program prints" if what == "a scene file" else ""
        raise refused(path, "is a pipe or device; only files are read", cause)


def read_text(path: Path, most: int, what: str = "a scene file") -> str:
    """The text of a file; of `STANDARD_INPUT` what it holds until its end.

    Raises:
        SceneFileError: it cannot be read, is longer, or is not UTF-8.
    """
    if str(path) in STANDARD_INPUT:
        if sys.stdin is None:
            raise refused(path, "standard input is closed")
        return decoded(_bounded(sys.stdin.buffer, path, most, what), path)
    return decoded(read_bytes(path, most, what), path)


def decoded(data: bytes, path: Path) -> str:
    """Bytes as text.

    Raises:
        SceneFileError: they are not UTF-8.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        coding = "UTF-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "Latin-1 (ANSI)"
        cause = f"Saved as {coding}? Save it again as UTF-8"
        line = data[: error.start].count(b"\n") + 1
        raise refused(path, f"is not UTF-8 text (byte {error.start + 1}, line {line})", cause) from None


def _bounded(file: BinaryIO, path: Path, most: int, what: str) -> bytes:
    data = file.read(most + 1)
    if len(data) > most:
        raise refused(path, f"is longer than {most / 1e6:g} MB: {what} is shorter")
    return data


def _unreadable(path: Path, error: Exception) -> SceneFileError:
    if isinstance(error, FileNotFoundError):
        return refused(path, "no such file")
    return refused(path, f"cannot be read: {getattr(error, 'strerror', None) or error}")
