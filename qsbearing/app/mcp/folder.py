"""The one folder below which files are read and written."""

from __future__ import annotations

import re
from pathlib import Path

from qsbearing.files.file_errors import refused

DEVICES = {"CON", "PRN", "AUX", "NUL", *(f"{port}{number}" for port in ("COM", "LPT") for number in range(10))}
"""Names that mean devices on Windows, with any ending."""
_FORBIDDEN = re.compile(r'[<>:"|?*\\\x00-\x1f]')


class Folder:
    """One that was there at the start."""

    def __init__(self, path: Path) -> None:
        self.path = path.resolve(strict=True)

    def place(self, name: str | Path) -> Path:
        """Where a file is, through all links.

        Raises:
            SceneFileError: that is elsewhere.
        """
        try:
            path = (self.path / name).resolve()
            # Up to Python 3.12 a circle of links is an error; from 3.13 on what leads into it is given back as it is.
            is_within = path.is_relative_to(self.path) and not any(map(Path.is_symlink, (path, *path.parents)))
        except (OSError, RuntimeError, ValueError):  # a null character, a name too long
            is_within = False
        if not is_within:
            raise refused(name, "is not below the folder of this server", "Names of files count from that folder")
        return path

    def new(self, name: str) -> Path:
        """The path of a file below the folder that is to be written.

        Raises:
            SceneFileError: there is something already, no folder to hold it, or not every system has such names.
        """
        path = self.place(name)
        stem = path.name.partition(".")[0].strip().upper()
        if not stem or stem in DEVICES or _FORBIDDEN.search(path.name):
            raise refused(name, "is no name for a file", "Letters, digits, - and _ make one that every system has")
        if path.exists():
            raise refused(name, "exists already", "Nothing is written over: choose another name")
        if not path.parent.is_dir():
            raise refused(name, "is in a folder that does not exist")
        return path

    def named(self, path: Path) -> str:
        """Its name, counted from the folder."""
        return path.relative_to(self.path).as_posix()
