"""What the gate shows: the plan with its durations, progress, the final table."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.box import SIMPLE
from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

from fem_check.agreement import Progress as Report
from fem_check.release.gate import Verdict
from fem_check.release.steps import Step

WIDTH = 140
"""Of tables where no terminal limits it."""

REASONS = 5
"""Shown of each step in the table; all of them with `--json`."""
UNKNOWN = "not on record"


def plan(steps: list[Step], seconds: dict[str, float | None], kept: set[str], before: str) -> Table:
    """What will be run, and how long it took before."""
    table = Table(title=f"Durations from {before}", title_justify="left", box=SIMPLE, pad_edge=False)
    table.add_column("step")
    table.add_column("expected", justify="right")
    table.add_column("by", overflow="fold")
    for step in steps:
        text = "done, kept" if step.name in kept else duration(seconds[step.name])
        table.add_row(step.name, text, step.command)
    table.add_section()
    left = {step.name for step in steps} - kept
    known = sum(value for name in left if (value := seconds[name]) is not None)
    unknown = sum(seconds[name] is None for name in left)
    beside = f" and {unknown} steps without a record" if unknown else ""
    table.add_row("in all", duration(known), f"{len(left)} steps to run{beside}")
    return table


def duration(seconds: float | None) -> str:
    """For people."""
    if seconds is None:
        return UNKNOWN
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 6000.0 else f"{seconds / 3600.0:.1f} h"


def console(on_stderr: bool) -> Console:
    """Where tables go."""
    found = Console(stderr=on_stderr, highlight=False)
    return found if found.is_terminal else Console(stderr=on_stderr, highlight=False, width=WIDTH)


@contextmanager
def progress(
    steps: list[Step], seconds: dict[str, float | None], quiet: bool
) -> Iterator[tuple[Callable[[Step], Report], Callable[[Step, str | None], None]]]:
    """A bar of the step that runs, on stderr; yields what makes a step's progress callback, and what ends a step.

    Without a terminal, a line for each step that ended.
    """
    stderr = console(on_stderr=True)
    shown = stderr.is_terminal and not quiet
    columns = (SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[stage]}"))
    with Progress(*columns, TimeElapsedColumn(), console=stderr, transient=True, disable=not shown) as bar:
        whole = bar.add_task("all steps", total=len(steps), stage="")
        tasks = {}

        def begin(step: Step) -> Report:
            task = tasks[step.name] = bar.add_task(
                step.name, total=1.0, stage=f"expected {duration(seconds[step.name])}"
            )
            return lambda stage, part: bar.update(task, completed=part, stage=stage)

        def end(step: Step, error: str | None) -> None:
            bar.remove_task(tasks.pop(step.name))
            bar.advance(whole)
            if not quiet:
                stderr.print(f"{step.name}: {error or 'done'}", markup=False, soft_wrap=True)

        yield begin, end


def final(found: list[Verdict]) -> Table:
    """Step, verdict, why, how to run it again."""
    table = Table(box=SIMPLE, pad_edge=False)
    for heading in ("step", "verdict", "why", "how to run it again"):
        table.add_column(heading, overflow="fold", no_wrap=heading == "verdict")
    for each in found:
        word = Text("pass", style="green") if each.passes else Text("fail", style="bold red")
        shown = each.reasons[:REASONS]
        if len(each.reasons) > REASONS:
            shown.append(f"and {len(each.reasons) - REASONS} more")
        table.add_row(Text(each.step), word, Text("\n".join(shown) or each.said), Text(each.command))
    return table
