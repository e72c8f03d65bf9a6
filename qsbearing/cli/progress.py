"""A progress bar for long studies."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def progress_bar() -> Iterator[Callable[[int, int], None]]:
    """A bar with rate and time left, where there is a terminal to show it; yields what tells it of points done."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    columns = (BarColumn(), TextColumn("{task.fields[shown]}"), TimeRemainingColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("", total=None, shown="")

        def update(done: int, count: int) -> None:
            speed = progress.tasks[0].speed or 0.0
            shown = f"{done:,} of {count:,} points, {speed:,.0f} per second"
            progress.update(task, completed=done, total=count, shown=shown)

        yield update
