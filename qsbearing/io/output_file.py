"""A file that is either written whole or not touched at all, and whose place is tried before the work begins."""

from __future__ import annotations

import os
import stat
import tempfile
from pathlib import Path
from types import TracebackType


class OutputFile:
    """Claims a place for a file on entry, and fills it on `replace_with`; leaves nothing behind otherwise.

    Raises:
        OSError: the place cannot be written, with a text that says why.
    """

    def __init__(self, target: str) -> None:
        self.target = target
        # Through links, so that a link stays one and what it points at is replaced.
        self._place = Path(os.path.realpath(target))
        self._temporary: Path | None = None

    def __enter__(self) -> OutputFile:
        place, folder = self._place, self._place.parent
        if not self.target:
            raise OSError("no file name is given")
        if place.is_dir() or self.target.endswith(os.sep):
            raise OSError("is a folder")
        if not folder.is_dir():
            raise OSError(f"there is no folder {folder}")
        if place.exists() and not os.access(place, os.W_OK):
            raise OSError("is write-protected")
        if self._is_device:
            return self
        try:
            # In the same folder: only there is the last step one step, and only this proves that it can be written.
            handle, name = tempfile.mkstemp(prefix=f".{place.name[:100]}.", suffix=".part", dir=folder)
        except OSError as error:
            raise OSError(f"cannot be written: {error.strerror}") from None
        os.close(handle)
        self._temporary = Path(name)
        return self

    @property
    def _is_device(self) -> bool:
        """A terminal, a pipe, /dev/null: written to, never replaced."""
        return self._place.exists() and not self._place.is_file()

    def replace_with(self, data: bytes) -> None:
        """Put the data in place, in one step."""
        if self._temporary is None:
            self._place.write_bytes(data)
            return
        self._temporary.write_bytes(data)
        self._temporary.chmod(self._mode())
        self._temporary.replace(self._place)
        self._temporary = None

    def _mode(self) -> int:
        """Permissions of the file that is there, else those of any new file; temporary ones are the owner's alone."""
        if self._place.exists():
            return stat.S_IMODE(self._place.stat().st_mode)
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if self._temporary is not None:
            self._temporary.unlink(missing_ok=True)
