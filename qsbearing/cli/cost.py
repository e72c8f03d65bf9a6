"""`qsbearing cost`: measure what accuracy costs."""

from __future__ import annotations

import json
import shlex
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.files import check_installed, fill, folder
from qsbearing.cli.output import UNSOLVED, note, print_table, print_text
from qsbearing.cli.scene import load_one, solve
from qsbearing.cli.settings import set_option, told, with_changes

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet


@click.command(short_help="Show what accuracy costs in time.")
@click.argument("scene")
@set_option
@click.option("--json", "as_json", is_flag=True, help="Print the record as one JSON object, and nothing else.")
@click.option("--out", metavar="DIR", help="Also write the record (JSON) and its pictures (PNG) to this folder.")
@click.option("--thorough", is_flag=True, help="Measure over the speeds too, with spread and memory: minutes.")
@click.option("--quick", is_flag=True, help="Likewise, repeated only a few times; the spread then means little.")
def cost(scene: str, settings: tuple[str, ...], as_json: bool, out: str | None, thorough: bool, quick: bool) -> None:
    """Show what accuracy costs in time, for the bearing or set of SCENE and its loads, within ten seconds.

    Each level of the model, from a static bearing to the full model, stands with its error against the full model and
    the time for one case, 1,000 and a million; a contact by finite elements stands beside them, from its record.

    With --thorough the errors are those from rest to the speeds of aero engines, times come with their spread, and time
    and memory are measured against the number of cases in a call.

    Exit codes: 0 measured, 1 the scene has no solution, 2 bad input.
    """
    if out is not None:
        check_installed("--out needs", ("matplotlib",), "plot")
    loaded = load_one(scene, settings)
    solution = solve(loaded.of)
    if not solution.converged:
        from qsbearing.remarks.of_solution import message

        note(message(solution))
        sys.exit(UNSOLVED)

    of = getattr(solution, "set", None) or solution.scene
    is_long = thorough or quick

    def measured() -> dict[str, Any]:
        from qsbearing.results import provenance
        from qsbearing.studies.cost import accuracy_table, tables

        record = _measured(of, thorough) if is_long else _look(of)
        options = [f"--{name}" for name, given in (("thorough", thorough), ("quick", quick)) if given]
        options += [f"--set={each}" for each in settings]
        record = with_changes(record, loaded.changes)
        record["provenance"] = provenance.of_run(shlex.join(["qsbearing", "cost", scene, *options]))
        if as_json:
            print_text(_json(record))
        else:
            shown = tables.report(record) if is_long else accuracy_table.blocks(record)
            print_table([*told(loaded.changes), *shown])
        return record

    if out is None:
        measured()
        return
    from qsbearing.studies.cost.figures import OF_ONE_SCENE, PICTURES, png

    place, drawn = folder(out), PICTURES if is_long else OF_ONE_SCENE
    pictures = {place / f"{name}.png": lambda record, draw=draw: png(draw(record)) for name, draw in drawn.items()}
    fill({place / "cost.json": lambda record: _json(record).encode()} | pictures, measured)


def _json(record: dict[str, Any]) -> str:
    return json.dumps(record, indent=1, allow_nan=False) + "\n"


def _look(of: Scene | BearingSet) -> dict[str, Any]:
    from qsbearing.studies.cost import accuracy_table

    with _progress(len(accuracy_table.COUNTS)) as told:
        return accuracy_table.measure(of, told)


def _measured(of: Scene | BearingSet, thorough: bool) -> dict[str, Any]:
    """The record of what everything costs."""
    from qsbearing.studies.cost import record

    chosen = record.FULL if thorough else record.QUICK
    with _progress(record.steps(chosen)) as told:
        return record.measure(of, chosen, told)


@contextmanager
def _progress(steps: int) -> Iterator[Callable[[str], None]]:
    """A progress bar where there is a terminal to show it, and what tells it of each step."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    console = Console(stderr=True)
    bar = Progress(
        *(TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    with bar as progress:
        task = progress.add_task("start", total=steps)
        yield lambda step: progress.update(task, advance=1, description=step)
