"""What the commands share: exit codes, refusals, packages that must be there, a progress bar."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

from qsbearing.cli.output import BAD_INPUT, note

LEVELS = "release has finer meshes and takes much longer."

RESULTS = "fem_check_results"
"""The working folder's own folder, unless another is named."""

OUT_OF_TOLERANCE = 1


def refuse(message: str, code: int = BAD_INPUT) -> NoReturn:
    """Say what is wrong, on stderr, and stop with the exit code for bad input, or another."""
    note(message, "fem-check")
    sys.exit(code)


FEM = ("fem", "skfem", "meshio", "matplotlib")
"""What solves contacts, for `require`."""
BOOK = ("jinja2", "markdown_it", "pygments", "matplotlib", "pydantic")
"""What writes pages of the validation book."""


def require(extra: str, *packages: str, what: str = "this") -> None:
    """Refuse a command, or what of it is named, of which packages are missing, and say how to install them."""
    missing = [name for name in packages if importlib.util.find_spec(name) is None]
    if missing:
        from qsbearing.documents.installation import pip_install  # not at the start of every command

        refuse(f"{what} needs {', '.join(missing)}: {pip_install(extra)}")


@contextmanager
def progress_bar(quiet: bool) -> Iterator[Any]:
    """A progress bar on stderr; yields a function that makes a progress callback for a named task."""
    console = Console(stderr=True)
    bar = Progress(
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.fields[stage]}"),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=quiet or not console.is_terminal,
    )
    with bar:
        tasks: dict[str, Any] = {}

        def reporter(name: str) -> Any:
            tasks[name] = bar.add_task(name, total=1.0, stage="")

            def report(stage: str, part: float) -> None:
                bar.update(tasks[name], completed=part, stage=stage)

            return report

        yield reporter
