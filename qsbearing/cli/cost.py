"""`qsbearing cost`: measure what accuracy costs."""

from __future__ import annotations

import json
import shlex
import sys
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.files import check_installed, fill, folder
from qsbearing.cli.output import UNSOLVED, note, print_table, print_text
from qsbearing.cli.scene import load_one, solve

if TYPE_CHECKING:
    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet


@click.command(short_help="Measure what accuracy costs in time (two minutes).")
@click.argument("scene")
@click.option("--json", "as_json", is_flag=True, help="Print the record as one JSON object, and nothing else.")
@click.option("--out", metavar="DIR", help="Also write the record (JSON) and its pictures (PNG) to this folder.")
@click.option("--quick", is_flag=True, help="Repeat the measurements only a few times; their spread then means little.")
def cost(scene: str, as_json: bool, out: str | None, quick: bool) -> None:
    """Measure what accuracy costs in time, for the bearing and the loads of SCENE; takes about two minutes.

    Model levels from a static bearing to the full model are shown with their time and their error against the full
    model, from rest to the speeds of aero engines; then time and memory against the number of cases in a call.

    Exit codes: 0 measured, 1 the scene has no solution, 2 bad input.
    """
    if out is not None:
        check_installed("--out needs", ("matplotlib",), "plot")
    solution = solve(load_one(scene))
    if not solution.converged:
        from qsbearing.results.remarks import message

        note(message(solution))
        sys.exit(UNSOLVED)

    def measured() -> dict[str, Any]:
        from qsbearing.results import provenance

        found = _measure(getattr(solution, "set", None) or solution.scene, quick)
        command = ["qsbearing", "cost", scene, *(["--quick"] if quick else [])]
        found["provenance"] = provenance.of_run(shlex.join(command))
        if as_json:
            print_text(_json(found))
        else:
            from qsbearing.studies.cost import tables

            print_table(tables.report(found))
        return found

    if out is None:
        measured()
        return
    from qsbearing.studies.cost.figures import PICTURES, png

    place = folder(out)
    pictures = {place / f"{name}.png": lambda found, draw=draw: png(draw(found)) for name, draw in PICTURES.items()}
    fill({place / "cost.json": lambda found: _json(found).encode()} | pictures, measured)


def _json(found: dict[str, Any]) -> str:
    return json.dumps(found, indent=1, allow_nan=False) + "\n"


def _measure(scene: Scene | BearingSet, quick: bool) -> dict[str, Any]:
    """The record of what everything costs, with a progress bar where there is a terminal to show it."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from qsbearing.studies.cost import record

    chosen = record.QUICK if quick else record.FULL
    console = Console(stderr=True)
    bar = Progress(
        *(TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    with bar as progress:
        task = progress.add_task("start", total=record.steps(chosen))
        return record.measure(scene, chosen, lambda step: progress.update(task, advance=1, description=step))
