"""The folder that `qsbearing cost --out` fills: tried before any work, and filled whole or not at all."""

from __future__ import annotations

import json
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from qsbearing.io.output_file import OutputFile
from qsbearing.studies.cost import figures, tables

FILES = ("cost.json", *(f"{name}.csv" for name in tables.LISTS), *(f"{name}.png" for name in figures.PICTURES))


class OutputFolder:
    """Claims a folder, made if there is none, and all its files on entry; leaves nothing behind unless filled.

    Raises:
        OSError: the folder or a file cannot be written, or there is nothing to draw with; the text says why.
    """

    def __init__(self, target: str) -> None:
        self._target, self._folder = target, Path(target)
        self._stack = ExitStack()
        self._files: dict[str, OutputFile] = {}

    def __enter__(self) -> OutputFolder:
        if find_spec("matplotlib") is None:
            raise OSError("needs matplotlib: pip install 'qsbearing[plot]'")
        if not self._target:
            raise OSError("no folder is named")
        with ExitStack() as stack:  # undone at the first fault
            if not self._folder.is_dir():
                self._make()
                stack.callback(lambda: None if any(self._folder.iterdir()) else self._folder.rmdir())
            for name in FILES:
                try:
                    self._files[name] = stack.enter_context(OutputFile(str(self._folder / name)))
                except OSError as error:
                    raise OSError(f"{name}: {error}") from None
            self._stack = stack.pop_all()
        return self

    def _make(self) -> None:
        try:
            self._folder.mkdir()
        except FileNotFoundError:
            raise OSError(f"there is no folder {self._folder.parent}") from None
        except OSError as error:
            is_file = self._folder.exists()
            raise OSError("is a file, not a folder" if is_file else f"cannot be made: {error.strerror}") from None

    def fill(self, record: dict[str, Any]) -> None:
        """Write every table and picture of a complete record; all are made before the first is put there."""
        contents = {"cost.json": (json.dumps(record, indent=1, allow_nan=False) + "\n").encode()}
        contents |= {f"{name}.csv": tables.csv_text(record[name]).encode() for name in tables.LISTS}
        contents |= {f"{name}.png": figures.png(draw(record)) for name, draw in figures.PICTURES.items()}
        for name, data in contents.items():
            self._files[name].replace_with(data)

    def __exit__(self, *reason: object) -> None:
        self._stack.close()
