"""`qsbearing run`: solve a scene and show what came out."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING

import click

from qsbearing.cli.output import UNSOLVED, note, print_table, print_text, refuse
from qsbearing.cli.scene import load, solve, solving

if TYPE_CHECKING:
    from qsbearing.io.output_file import OutputFile
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
        files = _claim(stack, scene, {"--csv": csv_target, "--plot": plot_target})
        loaded = load(scene)
        if accuracy is None:
            reached, solution = None, solve(loaded)
        else:
            reached = _solve_to(loaded, accuracy, as_json)
            solution = reached.solution
        _show(solution, reached, as_json)
        if not solution.converged:
            for file in files.values():
                note(f"{file.target} is not written: there is no solution to write")
            sys.exit(UNSOLVED)
        _write(solution, files)


def _claim(stack: ExitStack, scene: str, targets: dict[str, str | None]) -> dict[str, OutputFile]:
    """The files to write, by their option, found to be writable; all that is wrong with them at once."""
    given = {option: target for option, target in targets.items() if target is not None}
    if not given:
        return {}
    from importlib.util import find_spec

    from qsbearing.io.output_file import OutputFile

    problems = []
    if "--plot" in given:
        if _extension(given["--plot"]) not in PICTURES:
            problems.append(f"--plot {given['--plot']}: the name must end in one of {', '.join(PICTURES)}")
        if find_spec("matplotlib") is None:
            problems.append("--plot needs matplotlib: pip install 'qsbearing[plot]'")
    known: dict[str, str] = {os.path.realpath(scene): "SCENE"}
    for option, target in given.items():
        other = known.setdefault(os.path.realpath(target), option) if target else option
        if other != option:
            problems.append(f"{option}: the same file as {other}")
    files = {}
    for option, target in given.items():
        try:
            files[option] = OutputFile(target) if problems else stack.enter_context(OutputFile(target))
        except (OSError, ValueError) as error:
            problems.append(f"{option} {target}: {error}")
    if problems:
        refuse("\nqsbearing: ".join(problems))
    return files


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
        import json

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


def _write(solution: Solution, files: dict[str, OutputFile]) -> None:
    try:
        if "--csv" in files:
            from qsbearing.io.csv_table import csv_text

            files["--csv"].replace_with(csv_text(solution).encode("utf-8"))
        if "--plot" in files:
            from io import BytesIO

            from qsbearing.pictures import overview

            picture = BytesIO()
            overview(solution).savefig(picture, format=_extension(files["--plot"].target)[1:])
            files["--plot"].replace_with(picture.getvalue())
    except OSError as error:  # a disk that filled up meanwhile
        refuse(f"cannot write: {error}")
