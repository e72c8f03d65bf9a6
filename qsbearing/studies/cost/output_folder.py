"""The folder that `qsbearing cost --out` fills: tried before any work, and filled whole or not at all."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from qsbearing.io.output_file import output_file
from qsbearing.studies.cost import figures

FILES = ("cost.json", *(f"{name}.png" for name in figures.PICTURES))


@contextmanager
def output_folder(target: str) -> Iterator[Callable[[dict[str, Any]], None]]:
    """Claim a folder, made if there is none, and all its files; yield what fills it with a complete record.

    Every picture is made before the first is put there; without a record nothing is left behind.

    Raises:
        OSError: the folder or a file cannot be written, or there is nothing to draw with; the text says why.
    """
    if find_spec("matplotlib") is None:
        raise OSError("needs matplotlib: pip install 'qsbearing[plot]'")
    if not target:
        raise OSError("no folder is named")
    folder = Path(target)
    with ExitStack() as stack:
        if not folder.is_dir():
            _make(folder)
            stack.callback(lambda: None if any(folder.iterdir()) else folder.rmdir())
        write = {}
        for name in FILES:
            try:
                write[name] = stack.enter_context(output_file(str(folder / name)))
            except OSError as error:
                raise OSError(f"{name}: {error}") from None

        def fill(record: dict[str, Any]) -> None:
            contents = {"cost.json": (json.dumps(record, indent=1, allow_nan=False) + "\n").encode()}
            contents |= {f"{name}.png": figures.png(draw(record)) for name, draw in figures.PICTURES.items()}
            for name, data in contents.items():
                write[name](data)

        yield fill


def _make(folder: Path) -> None:
    try:
        folder.mkdir()
    except FileNotFoundError:
        raise OSError(f"there is no folder {folder.parent}") from None
    except OSError as error:
        raise OSError("is a file, not a folder" if folder.exists() else f"cannot be made: {error.strerror}") from None
