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

    from qsbearing.output_file import OutputFile
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
def run(scene: str, as_json: bool, csv_target: str | None, plot_target: str | None) -> None:
    """Solve SCENE: a TOML file, or the name of a catalogue bearing, whose example is then solved.

    Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input.
    """
    with ExitStack() as stack:
        csv_file, plot_file = _claim(stack, scene, csv_target, plot_target)
        solution = _solve(scene)
        if as_json:
            _print(_json(solution))
        else:
            from qsbearing import tables

            _print_table(tables.result(solution))
        if not solution.converged:
            for file in (csv_file, plot_file):
                if file is not None:
                    click.echo(f"qsbearing: {file.target} is not written: there is no solution to write", err=True)
            sys.exit(UNSOLVED)
        _write(solution, csv_file, plot_file)


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
    from qsbearing.faults import SceneError
    from qsbearing.scene_file import load_scene
    from qsbearing.solving import solve, thread_count

    try:
        threads = thread_count()  # a slip in its environment variable is found here
        found = load_scene(scene)
        # The compiler's start-up loads scipy.linalg, only to see whether it is there: a sixth of the whole run.
        with _out_of_reach("scipy.linalg"):
            return solve(found, threads=threads)
    except SceneError as error:
        _refuse(str(error))
    except ValueError as error:
        if "QSBEARING_THREADS" in str(error):
            _refuse(str(error))
        raise


# After solving ------------------------------------------------------------------------------------------------------


def _json(solution: Solution) -> str:
    import json

    from qsbearing.record import record

    return json.dumps(record(solution), indent=1, allow_nan=False) + "\n"


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
