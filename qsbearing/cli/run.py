"""`qsbearing run`: solve a scene and show what came out."""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from contextlib import ExitStack
from io import BytesIO
from typing import TYPE_CHECKING

import click

from qsbearing.cli.output import UNSOLVED, note, print_table, print_text, refuse
from qsbearing.cli.scene import load, solve, solving

if TYPE_CHECKING:
    from qsbearing.io.output_file import Writer
    from qsbearing.scene.scene import Scene
    from qsbearing.solution import Solution
    from qsbearing.studies.cost.accuracy import Reached

PICTURES = (".png", ".svg", ".pdf")


@click.command(short_help="Solve a scene; show loads, angles, stiffness.")
@click.argument("scene")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of tables, and nothing else.")
@click.option(
    "--csv",
    "csv_target",
    metavar="FILE",
    help="Also write one row per ball, with units in the headings; the ring's values follow on every row, so that the "
    "files of several runs can be stacked.",
)
@click.option(
    "--plot",
    "plot_target",
    metavar="FILE",
    help="Also draw loads, contact angles and contact ellipses; .png, .svg or .pdf.",
)
@click.option(
    "--accuracy",
    type=float,
    metavar="ERROR",
    help="Leave out or simplify what SCENE names where the results stay within this relative error of its full model: "
    "the coarsest model level that will do, by measured factors. 1e-3, for instance.",
)
def run(scene: str, as_json: bool, csv_target: str | None, plot_target: str | None, accuracy: float | None) -> None:
    """Solve SCENE: a TOML file, or the name of a catalogue bearing, whose example is then solved.

    Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input.
    """
    with ExitStack() as stack:
        given = {"--csv": csv_target, "--plot": plot_target}
        targets = {option: target for option, target in given.items() if target is not None}
        write = _claim(stack, scene, targets)
        loaded = load(scene)
        if accuracy is None:
            reached, solution = None, solve(loaded)
        else:
            reached = _solve_to(loaded, accuracy, as_json)
            solution = reached.solution
        _show(solution, reached, as_json)
        if not solution.converged:
            for target in targets.values():
                note(f"{target} is not written: there is no solution to write")
            sys.exit(UNSOLVED)
        try:
            if csv_target is not None:
                write["--csv"](_csv(solution))
            if plot_target is not None:
                write["--plot"](_picture(solution, _extension(plot_target)[1:]))
        except OSError as error:  # a disk that filled up meanwhile
            refuse(f"cannot write: {error}")


def _claim(stack: ExitStack, scene: str, targets: dict[str, str]) -> dict[str, Writer]:
    """What writes each file, by its option; all that is wrong with the files at once."""
    if not targets:
        return {}
    from qsbearing.io.output_file import output_file

    problems = []
    if "--plot" in targets:
        if _extension(targets["--plot"]) not in PICTURES:
            problems.append(f"--plot {targets['--plot']}: the name must end in one of {', '.join(PICTURES)}")
        if importlib.util.find_spec("matplotlib") is None:
            problems.append("--plot needs matplotlib: pip install 'qsbearing[plot]'")
    known: dict[str, str] = {os.path.realpath(scene): "SCENE"}
    for option, target in targets.items():
        other = known.setdefault(os.path.realpath(target), option) if target else option
        if other != option:
            problems.append(f"{option}: the same file as {other}")
    writers = {}
    for option, target in targets.items():
        try:
            writers[option] = stack.enter_context(output_file(target))
        except (OSError, ValueError) as error:
            problems.append(f"{option} {target}: {error}")
    if problems:
        refuse("\nqsbearing: ".join(problems))
    return writers


def _extension(target: str) -> str:
    return os.path.splitext(target)[1].lower()  # noqa: PTH122 - pathlib costs --help its time


def _solve_to(scene: Scene, accuracy: float, as_json: bool) -> Reached:
    """Solve with the model level that the accuracy takes; the choice is said beforehand, beside JSON on stderr."""
    from qsbearing.studies.cost import accuracy as advice
    from qsbearing.studies.cost import text

    if not advice.FINEST <= accuracy <= advice.COARSEST:
        refuse(
            f"--accuracy {accuracy:g}: is outside its range\n    allowed: {advice.FINEST:g} to {advice.COARSEST:g}, a "
            "relative error\n    1e-3 is a tenth of a per cent"
        )
    with solving():
        choice = advice.choose(scene, accuracy)
    if as_json:
        click.echo(text.before(choice), err=True)
    else:
        print_text(f"{text.before(choice)}\n\n")
    with solving():
        return advice.solve_to(choice)


def _show(solution: Solution, reached: Reached | None, as_json: bool) -> None:
    if as_json:
        from qsbearing.io.json_record import record

        found = record(solution)
        if reached is not None:
            from qsbearing.studies.cost.text import as_data

            found["accuracy"] = as_data(reached)
        print_text(json.dumps(found, indent=1, allow_nan=False) + "\n")
        return
    from qsbearing.io.report import result

    print_table(result(solution))
    if reached is not None and solution.converged:
        from qsbearing.studies.cost import text

        print_text(f"\n{text.after(reached)}\n")


def _csv(solution: Solution) -> bytes:
    from qsbearing.columns import columns
    from qsbearing.io.csv_table import csv_text

    found = columns(solution)
    if solution.scene.readings:
        from qsbearing.readings import reading_columns, take_asked

        found |= reading_columns(solution, take_asked(solution))
    return csv_text({name: values.tolist() for name, values in found.items()}).encode("utf-8")


def _picture(solution: Solution, form: str) -> bytes:
    from qsbearing.pictures import overview

    picture = BytesIO()
    overview(solution).savefig(picture, format=form)
    return picture.getvalue()
