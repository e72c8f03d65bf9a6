"""`qsbearing sweep`: solve a scene over ranges, lists and distributions of its keys."""

from __future__ import annotations

import importlib.util
import os
import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any, NoReturn

import click

from qsbearing.cli.output import UNSOLVED, note, print_table, refuse
from qsbearing.cli.picture_file import PICTURES, draw_to

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Executor

    import xarray

    from qsbearing.studies.study import Study

INTERRUPTED = 130
TABLES = (".csv", ".parquet")


@click.command(short_help="Solve a scene over ranges of its keys.")
@click.argument("scene")
@click.option(
    "--vary",
    multiple=True,
    metavar="KEY=VALUES",
    help="A numeric key of the scene file and what it takes: START:STOP:COUNT, START:STOP:COUNT:log, A,B,C, "
    "normal(MEAN,SD), uniform(LOW,HIGH) or triangular(LOW,MODE,HIGH). Again for each further key; all combinations are "
    "solved.",
)
@click.option("--samples", type=int, metavar="N", help="Points of the keys that vary at random; 1024 if not given.")
@click.option("--sampling", metavar="HOW", help="random, latin_hypercube or sobol (if not given).")
@click.option("--seed", type=int, metavar="N", help="Of the random points; 0 if not given.")
@click.option("--quantity", "-y", "quantities", multiple=True, metavar="NAME", help="A result to keep; all by default.")
@click.option("--out", metavar="FILE", help="Write all results: .nc (netCDF), .csv or .parquet.")
@click.option("--plot", "picture", metavar="FILE", help="Also draw them, as `qsbearing plot` does; .png, .svg or .pdf.")
@click.option("--scheduler", metavar="ADDRESS", help="Solve on a Dask cluster, such as tcp://host:8786.")
@click.option("--resume", is_flag=True, help="Go on where an interrupted run of the same study stopped.")
def sweep(
    scene: str,
    vary: tuple[str, ...],
    out: str | None,
    picture: str | None,
    scheduler: str | None,
    resume: bool,
    **given: Any,
) -> None:
    """Solve SCENE, a TOML file or a catalogue bearing's name, at every point of a study.

    A study file is a scene file with a table [vary]. Points that are impossible or have no equilibrium stay in the
    results with status and reason.

    Exit codes: 0 some point is solved, 1 none is, 2 bad input.
    """
    from qsbearing.validation import SceneError

    _need("xarray", "h5netcdf")
    problem = _place_problem(out, resume) or _picture_problem(picture)
    try:
        study = _study(scene, vary, given)
        if problem:
            refuse(problem)
        with ExitStack() as stack:
            executor = _executor(stack, scheduler)
            results = _solved(study, executor, out, resume)
    except SceneError as error:
        refuse(f"{problem}\nqsbearing: {error}" if problem else str(error))
    except OSError as error:
        refuse(f"cannot write: {error.strerror or error}")
    from qsbearing.studies import summary

    if picture is not None:
        draw_to(results, picture)
    print_table(summary.table(results))
    if not (results["status"] == 0).any():
        sys.exit(UNSOLVED)


def _need(*modules: str) -> None:
    missing = [module for module in modules if importlib.util.find_spec(module) is None]
    if missing:
        refuse(f"studies need {' and '.join(missing)}: pip install 'qsbearing[studies]'")


def _place_problem(out: str | None, resume: bool) -> str:
    ending = os.path.splitext(out or "")[1].lower()  # noqa: PTH122 - pathlib costs --help its time
    if out is not None and ending not in (".nc", *TABLES):
        return f"--out {out}: the name must end in one of .nc, {', '.join(TABLES)}"
    if ending == ".parquet" and importlib.util.find_spec("pyarrow") is None:
        return "--out *.parquet needs pyarrow: pip install pyarrow"
    if resume and ending != ".nc":
        return "--resume needs --out FILE.nc: only there finished chunks are kept"
    return ""


def _picture_problem(picture: str | None) -> str:
    if picture is None:
        return ""
    if importlib.util.find_spec("matplotlib") is None:
        return "--plot needs matplotlib: pip install 'qsbearing[studies]'"
    if os.path.splitext(picture)[1].lower() not in PICTURES:  # noqa: PTH122
        return f"--plot {picture}: the name must end in one of {', '.join(PICTURES)}"
    if not os.path.isdir(os.path.dirname(picture) or "."):  # noqa: PTH112, PTH120
        return f"--plot {picture}: there is no such folder"
    return ""


def _study(scene: str, vary: tuple[str, ...], given: dict[str, Any]) -> Study:
    from qsbearing.studies.study import Study

    varied: dict[str, str] = {}
    for text in vary:
        key, equals, values = text.partition("=")
        if not equals or key.strip() in varied:
            fault = "is varied twice" if equals else "has no values. Write KEY=START:STOP:COUNT or KEY=A,B,C"
            refuse(f"--vary {text}: {fault}")
        varied[key.strip()] = values
    options = {name: value for name, value in given.items() if value is not None and value != ()}
    return Study.of(scene, varied, **options)


def _executor(stack: ExitStack, scheduler: str | None) -> Executor | None:
    if scheduler is None:
        return None
    _need("distributed")
    from distributed import Client

    try:
        client = stack.enter_context(Client(scheduler, timeout=5))
    except (OSError, ValueError) as error:
        refuse(f"--scheduler {scheduler}: cannot be reached ({str(error) or type(error).__name__})")
    executor: Executor = stack.enter_context(client.get_executor(pure=False, retries=3))
    return executor


def _solved(study: Study, executor: Executor | None, out: str | None, resume: bool) -> xarray.Dataset:
    from qsbearing.studies.sweep import sweep as solve_all

    ending = os.path.splitext(out or "")[1].lower()  # noqa: PTH122
    try:
        with _bar() as progress:
            results = solve_all(study, executor, out=out if ending == ".nc" else None, resume=resume, progress=progress)
    except KeyboardInterrupt:
        _interrupted(out)
    if out is not None and ending in TABLES:
        from qsbearing.studies.tables import write_table

        write_table(results, out)
    return results


def _interrupted(out: str | None) -> NoReturn:
    kept = f": finished points are kept in {out}.parts; --resume goes on" if out and out.endswith(".nc") else ""
    note(f"interrupted{kept}")
    sys.exit(INTERRUPTED)


class _bar:  # noqa: N801 - reads as a function
    """A progress bar with rate and time left, where there is a terminal to show it."""

    def __enter__(self) -> Callable[[int, int], None]:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

        console = Console(stderr=True)
        columns = (BarColumn(), TextColumn("{task.fields[shown]}"), TimeRemainingColumn())
        self._progress = Progress(*columns, console=console, transient=True, disable=not console.is_terminal)
        self._progress.start()
        task = self._progress.add_task("", total=None, shown="")

        def update(done: int, count: int) -> None:
            speed = self._progress.tasks[0].speed or 0.0
            shown = f"{done:,} of {count:,} points, {speed:,.0f} per second"
            self._progress.update(task, completed=done, total=count, shown=shown)

        return update

    def __exit__(self, *error: object) -> None:
        self._progress.stop()
