"""The folder that `qsbearing cost --out` fills: tried before any work, and filled whole or not at all."""

from __future__ import annotations

import json
from contextlib import ExitStack
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from qsbearing.cost import figures, tables
from qsbearing.cost.record import PARTS
from qsbearing.output_file import OutputFile

FILES = ("cost.json", *(f"{part}.csv" for part in PARTS), *(f"{name}.png" for name in figures.PICTURES))


class OutputFolder:
    """Claims a folder, made if there is none, and the places of all its files on entry; leaves nothing behind unless
    filled.

    Raises:
        OSError: the folder or a file cannot be written, or there is nothing to draw with; the text says why.
    """

    def __init__(self, target: str) -> None:
        self.target = target
        self._folder = Path(target)
        self._made = False
        self._stack = ExitStack()
        self._files: dict[str, OutputFile] = {}

    def __enter__(self) -> OutputFolder:
        if find_spec("matplotlib") is None:
            raise OSError("needs matplotlib: pip install 'qsbearing[plot]'")
        if not self.target:
            raise OSError("no folder is named")
        try:
            self._made = not self._folder.exists()
            self._folder.mkdir(exist_ok=True)
        except FileNotFoundError:
            raise OSError(f"there is no folder {self._folder.parent}") from None
        except FileExistsError:
            raise OSError("is a file, not a folder") from None
        except OSError as error:
            raise OSError(f"cannot be made: {error.strerror}") from None
        try:
            for name in FILES:
                self._files[name] = self._stack.enter_context(OutputFile(str(self._folder / name)))
        except OSError as error:
            self._leave()
            raise OSError(f"{name}: {error}") from None
        return self

    def fill(self, record: dict[str, Any]) -> None:
        """Write every table and picture of a complete record; all are made before the first is put in place."""
        contents = {"cost.json": (json.dumps(record, indent=1, allow_nan=False) + "\n").encode()}
        contents |= {f"{part}.csv": tables.csv_text(record, part).encode() for part in PARTS}
        contents |= {f"{name}.png": figures.png(draw(record)) for name, draw in figures.PICTURES.items()}
        for name, data in contents.items():
            self._files[name].replace_with(data)
        self._made = False

    def _leave(self) -> None:
        self._stack.close()
        if self._made:
            self._folder.rmdir()

    def __exit__(self, *reason: object) -> None:
        self._leave()
