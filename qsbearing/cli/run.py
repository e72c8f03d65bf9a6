"""`qsbearing run`: solve a scene and show what came out."""

from __future__ import annotations

import importlib.util
import os
from contextlib import ExitStack
from typing import TYPE_CHECKING

import click

from qsbearing.cli.output import NO_SOLUTION, print_result, print_table, refuse, write_files
from qsbearing.cli.picture_file import PICTURES, drawn, form_of
from qsbearing.cli.run_points import run_points
from qsbearing.cli.run_set import run_set
from qsbearing.cli.run_spectrum import show_spectrum
from qsbearing.cli.scene import load_scene_or_set, solve

if TYPE_CHECKING:
    from qsbearing.io.output_file import Writer
    from qsbearing.io.readings_record import Readings
    from qsbearing.scene.scene import Scene
    from qsbearing.solution.solution import Solution


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
    help="Also draw loads, contact angles and contact ellipses, of a set loads and angles of each row; .png, .svg or "
    ".pdf.",
)
@click.option(
    "--accuracy",
    type=float,
    metavar="ERROR",
    help="Choose the effects: some are left out, whether SCENE names them or not, as long as all results stay within "
    "this relative error of the full model of the operating point. 1e-3, for instance.",
)
@click.option(
    "--points",
    metavar="TABLE",
    help="Solve SCENE at each row of a table: .csv, .xlsx or .parquet; headings "
    "are keys of the scene file, such as speed_rpm. One row in, one row out, a status each.",
)
@click.option(
    "--out", metavar="TABLE", help="With --points: where the rows go with their results; .csv, .xlsx, .parquet."
)
def run(
    scene: str,
    as_json: bool,
    csv_target: str | None,
    plot_target: str | None,
    accuracy: float | None,
    points: str | None,
    out: str | None,
) -> None:
    """Solve SCENE: a TOML file, or the name of a catalogue bearing, whose example is then solved. A file with [[rows]]
    is a set of rows on one shaft: `qsbearing init --set` prints one. One with [[spectrum]] has operating points with
    shares of time, which make one life. A result, of --json (.json) or of `qsbearing sweep` (.nc), is solved again from
    the input that it holds; of a sweep the scene of its first point.

    Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input.
    """
    if points is not None or out is not None:
        others = {"--json": as_json, "--csv": csv_target, "--plot": plot_target, "--accuracy": accuracy}
        run_points(scene, points, out, {name: given for name, given in others.items() if given not in (None, False)})
        return
    with ExitStack() as stack:
        given = {"--csv": csv_target, "--plot": plot_target}
        targets = {option: target for option, target in given.items() if target is not None}
        write = _claim(stack, scene, targets)
        loaded = load_scene_or_set(scene)
        from qsbearing.scene.scene import Scene

        if not isinstance(loaded, Scene):
            run_set(loaded, as_json, targets, write, accuracy)
            return
        if accuracy is not None:
            _check(accuracy)
        is_spectrum = "spectrum" in loaded.readings
        if is_spectrum and "--plot" in targets:
            refuse("--plot: pictures are of single operating points; --csv writes every ball of every point")
        solution = solve(loaded, accuracy)
        asked = loaded if accuracy is None else solution.scene  # a file cannot ask for a choice among what it names
        if is_spectrum:
            show_spectrum(solution, asked, as_json, targets, write)
            return
        from qsbearing.io.csv_table import csv_bytes
        from qsbearing.io.readings_record import all_columns, taken

        readings = taken(solution)
        _show(solution, readings, loaded, asked, as_json)
        make = {
            "--csv": lambda: csv_bytes(all_columns(solution, readings)),
            "--plot": lambda: drawn(solution, targets["--plot"]),
        }
        write_files(targets, write, make, "" if solution.converged else NO_SOLUTION)


def _claim(stack: ExitStack, scene: str, targets: dict[str, str]) -> dict[str, Writer]:
    """What writes each file, by its option; all that is wrong with the files at once."""
    if not targets:
        return {}
    from qsbearing.io.output_file import output_file

    problems = []
    if "--plot" in targets:
        if form_of(targets["--plot"]) not in PICTURES:
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


def _check(accuracy: float) -> None:
    from qsbearing.chooser.choose import COARSEST, FINEST

    if not FINEST <= accuracy <= COARSEST:
        refuse(
            f"--accuracy {accuracy:g}: is outside its range\n    allowed: {FINEST:g} to {COARSEST:g}, a "
            "relative error\n    1e-3 is a tenth of a per cent"
        )


def _show(solution: Solution, readings: Readings, scene: Scene, asked: Scene, as_json: bool) -> None:
    if as_json:
        from qsbearing.io.json_record import record

        print_result(asked, record(solution, readings))
        return
    from qsbearing.io.report import result

    print_table(result(solution, readings))
    if solution.choice is not None:
        from rich.text import Text

        from qsbearing.messages.bearing import chosen

        print_table(Text("\n" + "\n".join(chosen(solution, scene))))
