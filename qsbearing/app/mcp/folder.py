"""The one folder below which files are read and written."""

from __future__ import annotations

from pathlib import Path

from qsbearing.files.file_errors import refused


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
            found = (self.path / name).resolve()
        except (OSError, RuntimeError, ValueError):  # a circle of links, a null character
            found = Path()
        if not found.is_relative_to(self.path):
            raise refused(name, "is not below the folder of this server", "Names of files count from that folder")
        return found

    def new(self, name: str) -> Path:
        """Likewise of a file that is to be written.

        Raises:
            SceneFileError: there is something already, or no folder to hold it.
        """
        found = self.place(name)
        if found.exists():
            raise refused(name, "exists already", "Nothing is written over: choose another name")
        if not found.parent.is_dir():
            raise refused(name, "is in a folder that does not exist")
        return found

    def named(self, path: Path) -> str:
        """Its name, counted from the folder."""
        return path.relative_to(self.path).as_posix()
