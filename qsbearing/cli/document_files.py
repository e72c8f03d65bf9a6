"""Documents as files in a folder: all of them, or none."""

from __future__ import annotations

import importlib.util
from contextlib import ExitStack
from typing import TYPE_CHECKING

from qsbearing.cli.output import refuse

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from qsbearing.documents.model import Document

NEEDED = ("jinja2", "typst", "markdown_it", "mdit_py_plugins", "pygments", "matplotlib")


def check_installed(what: str, needed: tuple[str, ...] = NEEDED, extra: str = "report") -> None:
    """End with what to install, where something is missing."""
    missing = [name for name in needed if importlib.util.find_spec(name) is None]
    if missing:
        refuse(f"{what} needs {', '.join(missing)}: pip install 'qsbearing[{extra}]'")


def folder(target: str) -> Path:
    """The folder of that name, made if it is not there; ends with exit code 2 where there cannot be one."""
    from pathlib import Path  # not above: it costs --help its time

    path = Path(target)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as error:
        refuse(f"{target}: cannot be a folder: {getattr(error, 'strerror', None) or error}")
    return path


def write(makers: dict[Path, Callable[[Document], bytes]], make: Callable[[], Document]) -> None:
    """Claim every file, then make the document and write it in each form."""
    from qsbearing.io.output_file import output_file

    with ExitStack() as stack:
        writers = {}
        for path in makers:
            try:
                writers[path] = stack.enter_context(output_file(str(path)))
            except OSError as error:
                refuse(f"{path}: {error}")
        document = make()
        found = {path: maker(document) for path, maker in makers.items()}
        try:
            for path, content in found.items():
                writers[path](content)
        except OSError as error:  # a disk that filled up meanwhile
            refuse(f"cannot write: {error}")
