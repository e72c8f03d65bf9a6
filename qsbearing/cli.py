"""The command line: formats and calls, computes nothing.

Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input. Whatever is heavy is imported where it is used, so
that `--help` answers at once.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

import click

from qsbearing import __version__

if TYPE_CHECKING:
    from rich.console import RenderableType

    from qsbearing.cost.accuracy import Reached
    from qsbearing.output_file import OutputFile
    from qsbearing.scene import Scene
    from qsbearing.solution import Solution

SOLVED, UNSOLVED, BAD_INPUT = 0, 1, 2

PICTURES = ("png", "svg", "pdf")


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="qsbearing")
def cli() -> None:
    """Quasi-static (Jones-Harris) model of angular-contact ball bearings.

    Start with `qsbearing run b218`, or write a scene of your own from `qsbearing init > my.toml`.
    """


@cli.command()
@click.argument("scene")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object instead of tables, and nothing else.")
@click.option(
    "--csv",
    "csv_target",
    metavar="FILE",
    help="Also write one row a ball, with units in the headings; the ring's values follow on every row, so that the "
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
    help="Leave out or simplify what SCENE names where the answer stays within this relative error of its full answer: "
    "the quickest fidelity that will do, by a measured table. 1e-3, for instance.",
)
def run(scene: str, as_json: bool, csv_target: str | None, plot_target: str | None, accuracy: float | None) -> None:
    """Solve SCENE: a TOML file, or the name of a catalogue bearing, whose example is then solved.

    Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input.
    """
    with ExitStack() as stack:
        csv_file, plot_file = _claim(stack, scene, csv_target, plot_target)
        reached = None if accuracy is None else _solve_to(scene, accuracy, as_json)
        solution = _solve(scene) if reached is None else reached.solution
        if as_json:
            _print(_json(solution, reached))
        else:
            from qsbearing import tables

            _print_table(tables.result(solution))
            if reached is not None and solution.converged:
                from qsbearing.cost import words

                _print(f"\n{words.after(reached)}\n")
        if not solution.converged:
            for file in (csv_file, plot_file):
                if file is not None:
                    click.echo(f"qsbearing: {file.target} is not written: there is no solution to write", err=True)
            sys.exit(UNSOLVED)
        _write(solution, csv_file, plot_file)


@cli.command()
@click.argument("scene")
@click.option("--json", "as_json", is_flag=True, help="Print the record as one JSON object, and nothing else.")
@click.option("--out", metavar="DIR", help="Also write the record, its tables (CSV) and pictures (PNG) to this folder.")
@click.option("--quick", is_flag=True, help="Few repeats: for a look, with a spread that means little.")
def cost(scene: str, as_json: bool, out: str | None, quick: bool) -> None:
    """Measure what accuracy costs in time, for the bearing and the loads of SCENE; takes about two minutes.

    Fidelities from a closed formula to all that the model has, each with its time, its memory and its error against the
    finest, from rest to the speeds of aero engines; the solver's tolerance; cases, balls and workers.

    Exit codes: 0 measured, 1 the scene has no solution, 2 bad input.
    """
    with ExitStack() as stack:
        folder = None
        if out is not None:
            from qsbearing.cost.outputs import OutputFolder

            try:
                folder = stack.enter_context(OutputFolder(out))
            except (OSError, ValueError) as error:
                _refuse(f"--out {out}: {error}")
        solution = _solve(scene)
        if not solution.converged:
            from qsbearing.outcome import message

            click.echo(f"qsbearing: {message(solution)}", err=True)
            sys.exit(UNSOLVED)
        found = _measure(solution.scene, quick)
        if as_json:
            import json

            _print(json.dumps(found, indent=1, allow_nan=False) + "\n")
        else:
            from qsbearing.cost import tables

            _print_table(tables.report(found))
        if folder is not None:
            try:
                folder.fill(found)
            except OSError as error:  # a disk that filled up meanwhile
                _refuse(f"cannot write: {error}")


@cli.command()
@click.argument("name", required=False)
def init(name: str | None) -> None:
    """Print a commented scene file: B218 spelled out, or the catalogue bearing NAME."""
    from qsbearing.scene_template import scene_template

    _print(scene_template(_entry(name or "B218"), by_name=name is not None))


@cli.command()
@click.argument("name", required=False)
def catalogue(name: str | None) -> None:
    """List the bearings that can be named, or with NAME where each number of one comes from."""
    from qsbearing import catalogue as data
    from qsbearing import tables

    _print_table(tables.catalogue(data.entries()) if name is None else tables.catalogue_entry(_entry(name)))


def main() -> NoReturn:
    """The console script."""
    cli.main(prog_name="qsbearing")
    sys.exit(SOLVED)


def _refuse(message: str) -> NoReturn:
    click.echo(f"qsbearing: {message}", err=True)
    sys.exit(BAD_INPUT)


def _entry(name: str) -> Any:
    from qsbearing import catalogue

    try:
        return catalogue.find(name)
    except KeyError:
        _refuse(f"{name!r} is not in the catalogue. {catalogue.nearest(name)}")


# Before solving -----------------------------------------------------------------------------------------------------


def _claim(
    stack: ExitStack, scene: str, csv_target: str | None, plot_target: str | None
) -> tuple[OutputFile | None, OutputFile | None]:
    """The places of the files to write, found to be writable; all that is wrong with them at once."""
    if csv_target is None and plot_target is None:
        return None, None
    from qsbearing.output_file import OutputFile

    problems = []
    if plot_target is not None:
        problems += _picture_problems(plot_target)
    places = {"SCENE": scene, "--csv": csv_target, "--plot": plot_target}
    named = [(words, os.path.realpath(place)) for words, place in places.items() if place]
    for position, (words, place) in enumerate(named):
        problems += [f"{words}: the same file as {other}" for other, before in named[:position] if before == place]
    files: dict[str, OutputFile | None] = {"--csv": None, "--plot": None}
    for words in files:
        target = places[words]
        if target is not None and not problems:
            try:
                files[words] = stack.enter_context(OutputFile(target))
            except (OSError, ValueError) as error:
                problems.append(f"{words} {target}: {error}")
    if problems:
        _refuse("\nqsbearing: ".join(problems))
    return files["--csv"], files["--plot"]


def _picture_problems(target: str) -> list[str]:
    from importlib.util import find_spec

    problems = []
    if _extension(target) not in PICTURES:
        kinds = ", ".join(f".{kind}" for kind in PICTURES)
        problems.append(f"--plot {target}: the name must end in one of {kinds}")
    if find_spec("matplotlib") is None:
        problems.append("--plot needs matplotlib: pip install 'qsbearing[plot]'")
    return problems


def _extension(target: str) -> str:
    return os.path.splitext(target)[1].lower().removeprefix(".")  # noqa: PTH122 - pathlib costs --help its time


@contextmanager
def _out_of_reach(module: str) -> Iterator[None]:
    """Let a module count as not installed, unless it is loaded already."""
    known = module in sys.modules
    if not known:
        sys.modules[module] = None  # type: ignore[assignment]
    try:
        yield
    finally:
        if not known:
            del sys.modules[module]


def _solve(scene: str) -> Solution:
    from qsbearing.solving import solve

    found, threads = _load(scene)
    # The compiler's start-up loads scipy.linalg, only to see whether it is there: a sixth of the whole run.
    with _out_of_reach("scipy.linalg"):
        return solve(found, threads=threads)


def _load(scene: str) -> tuple[Scene, int]:
    """The scene, and the threads to use."""
    from qsbearing.faults import SceneError
    from qsbearing.scene_file import load_scene
    from qsbearing.solving import thread_count

    try:
        threads = thread_count()  # a slip in its environment variable is found here
        return load_scene(scene), threads
    except SceneError as error:
        _refuse(str(error))
    except ValueError as error:
        if "QSBEARING_THREADS" in str(error):
            _refuse(str(error))
        raise


def _solve_to(scene: str, accuracy: float, as_json: bool) -> Reached:
    """Solve at the fidelity that the accuracy takes; the choice is told beforehand, beside JSON on standard error."""
    from qsbearing.cost import accuracy as advice
    from qsbearing.cost import words

    if not advice.FINEST <= accuracy <= advice.COARSEST:
        _refuse(
            f"--accuracy {accuracy:g}: is outside its range\n    allowed: {advice.FINEST:g} to {advice.COARSEST:g}, a "
            "relative error\n    1e-3 is a tenth of a per cent"
        )
    found, _ = _load(scene)
    with _out_of_reach("scipy.linalg"):
        choice = advice.choose(found, accuracy)
    if as_json:
        click.echo(words.before(choice), err=True)
    else:
        _print(f"{words.before(choice)}\n\n")
    return advice.solve_to(choice)


def _measure(scene: Scene, quick: bool) -> dict[str, Any]:
    """The record of what everything costs, with a progress bar where there is a terminal to show it."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    from qsbearing.cost import record, settings

    chosen = settings.QUICK if quick else settings.FULL
    console = Console(stderr=True)
    with Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TimeElapsedColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    ) as progress:
        task = progress.add_task("start", total=record.steps(chosen))

        def step(words: str) -> None:
            progress.update(task, advance=1, description=words)

        return record.measure(scene, chosen, step)


# After solving ------------------------------------------------------------------------------------------------------


def _json(solution: Solution, reached: Reached | None) -> str:
    import json

    from qsbearing.record import record

    found = record(solution)
    if reached is not None:
        from qsbearing.cost.words import as_data

        found["accuracy"] = as_data(reached)
    return json.dumps(found, indent=1, allow_nan=False) + "\n"


def _write(solution: Solution, csv_file: OutputFile | None, plot_file: OutputFile | None) -> None:
    try:
        if csv_file is not None:
            from io import StringIO

            from qsbearing.record import write_csv

            text = StringIO(newline="")
            write_csv(solution, text)
            csv_file.replace_with(text.getvalue().encode("utf-8"))
        if plot_file is not None:
            from io import BytesIO

            from qsbearing.figures import overview

            picture = BytesIO()
            overview(solution).savefig(picture, format=_extension(plot_file.target))
            plot_file.replace_with(picture.getvalue())
    except OSError as error:  # a disk that filled up meanwhile
        _refuse(f"cannot write: {error}")


def _print_table(renderable: RenderableType) -> None:
    from qsbearing.tables import text_of

    _print(text_of(renderable))


def _print(text: str) -> None:
    """Text to standard output, whatever characters it can show."""
    stream = sys.stdout
    encoding = getattr(stream, "encoding", None) or "utf-8"
    try:
        stream.write(text.encode(encoding, "replace").decode(encoding))
        stream.flush()
    except BrokenPipeError:
        # The reader has seen enough, as `| head` has. What is left in the buffer goes nowhere, or Python would try to
        # write it once more on its way out.
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
