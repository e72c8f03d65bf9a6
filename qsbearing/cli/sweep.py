"""`qsbearing sweep`: solve a scene over ranges, lists and distributions of its keys."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack, contextmanager, nullcontext
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.ball_sets import blocks_of_lists, note_of_lists
from qsbearing.cli.ended import INTERRUPTED
from qsbearing.cli.files import (
    check_installed,
    claimed,
    draw,
    ending,
    ending_problems,
    how_to_install,
    missing,
    picture_problems,
    write_files,
)
from qsbearing.cli.output import UNSOLVED, note, print_table, progress_bar, refuse
from qsbearing.cli.settings import set_option, told
from qsbearing.cli.vary import study_of, vary_option

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from concurrent.futures import Executor

    import xarray

    from qsbearing.studies.study import Study

TABLES = (".csv", ".parquet")
IN_MEMORY = 1 << 18
"""Points whose results are held in memory; of more they are in a file, a temporary one where none is asked for."""


@click.command(short_help="Solve a scene over ranges of its keys.")
@click.argument("scene")
@vary_option
@set_option
@click.option(
    "--samples", type=int, metavar="N", help="Number of points of the keys that vary at random; 1024 if not given."
)
@click.option("--sampling", metavar="HOW", help="random, latin_hypercube or sobol (the default).")
@click.option("--seed", type=int, metavar="N", help="Seed of the random points; 0 if not given.")
@click.option("--quantity", "-y", "quantities", multiple=True, metavar="NAME", help="A result to keep; all by default.")
@click.option(
    "--sobol",
    type=int,
    metavar="N",
    help="Instead of a sweep, compute Sobol indices from N base samples, such as 1024.",
)
@click.option("--out", metavar="FILE", help="Write all results: .nc (netCDF), .csv or .parquet.")
@click.option("--plot", "picture", metavar="FILE", help="Also draw them, as `qsbearing plot` does; .png, .svg or .pdf.")
@click.option("--overwrite", is_flag=True, help="Replace an existing file of --out, once the sweep has ended.")
@click.option(
    "--scheduler",
    metavar="ADDRESS",
    help="Solve on a Dask cluster, such as tcp://host:8786; the sweep ends if there is no worker for a minute.",
)
@click.option("--resume", is_flag=True, help="Continue an interrupted run of the same study.")
def sweep(
    scene: str,
    vary: tuple[str, ...],
    settings: tuple[str, ...],
    out: str | None,
    picture: str | None,
    sobol: int | None,
    overwrite: bool,
    scheduler: str | None,
    resume: bool,
    **given: Any,
) -> None:
    """Solve SCENE, a TOML file or a catalogue bearing's name, at every point of a study.

    A study file is a scene file with a table [vary]; a netCDF file of a sweep holds its study, which is solved again.
    Points that are impossible or have no equilibrium stay in the results with status and reason.

    With --sobol: which share of the variance of each result each random key causes, alone and together with the
    others.

    Exit codes: 0 some point is solved, 1 none is, 2 bad input.
    """
    from qsbearing.model.validation import SceneError
    from qsbearing.studies import summary
    from qsbearing.studies.scenes import base_scene

    check_installed("studies need", ("xarray", "h5netcdf"), "studies")
    problems = [*_place_problems(out, overwrite, resume), *picture_problems(picture)]
    problems += [] if sobol is None else _sobol_problems(sobol, given | {"scheduler": scheduler, "resume": resume})
    with ExitStack() as stack:
        try:
            study, changes = study_of(scene, vary, given, settings)
        except SceneError as error:
            problems.append(str(error))
        draws = claimed(stack, {"--plot": picture}, problems)
        try:
            if sobol is not None:
                results = _indices(study, sobol, out)
                print_table([*told(changes), *summary.table_of_indices(results)])
                note_of_lists(study.document)
                solved = True
            else:
                write = stack.enter_context(_table(out)) if out and ending(out) in TABLES else None
                executor = _executor(stack, scheduler)
                results = _solved(study, executor, out if write is None else None, resume, stack)
                if write:
                    write(results)
                said = [*summary.table(results), *blocks_of_lists(study.document, base_scene(study))]
                print_table([*told(changes), *said])
                solved = summary.any_is_solved(results)
        except SceneError as error:
            refuse(str(error))
        except OSError as error:
            refuse(f"cannot write: {error.strerror or error}")
        if solved:
            write_files(draws, {"--plot": lambda: draw(results, picture or "")})
        elif picture is not None:
            note(f"no point is solved: there is nothing to draw to {picture}")
    if not solved:
        sys.exit(UNSOLVED)


def _place_problems(out: str | None, overwrite: bool, resume: bool) -> list[str]:
    """Of --out, --overwrite and --resume."""
    problems = []
    form = ending(out or "")
    if out is not None and form not in (".nc", *TABLES):
        problems += ending_problems("--out", out, (".nc", *TABLES))
    elif out is not None and os.path.isfile(out) and not overwrite and not (resume and _is_unfinished(out)):  # noqa: PTH113
        problems.append(f"--out {out}: the file exists already; --overwrite replaces it")
    if form == ".parquet" and missing("pyarrow"):
        problems.append(f"--out *.parquet needs pyarrow: {how_to_install('tables')}")
    if resume and form != ".nc":
        problems.append("--resume needs --out FILE.nc: only then are the finished chunks kept")
    return problems


def _is_unfinished(out: str) -> bool:
    """Whether there is a run to go on with, which was allowed to write there."""
    from qsbearing.studies.store import folder_of

    return folder_of(out).is_dir()


def _sobol_problems(count: int, given: dict[str, Any]) -> list[str]:
    """Of --sobol, and of options that do not go with it."""
    from qsbearing.studies.sobol import count_problem

    problems = [f"--sobol {count}: {count_problem(count)}"] if count_problem(count) else []
    for name in ("samples", "sampling", "scheduler", "resume"):
        if given[name] not in (None, False):
            problems.append(f"--{name} cannot be used with --sobol, which draws and solves its own points")
    return problems


def _indices(study: Study, count: int, out: str | None) -> xarray.Dataset:
    """Sobol indices, written to a file where one is asked for."""
    from qsbearing.files.output_file import output_stream
    from qsbearing.studies.sobol import sobol_indices
    from qsbearing.studies.tables import write_indices

    with output_stream(out) if out else nullcontext() as file:
        indices = sobol_indices(study, count)
        if file is not None:
            write_indices(indices, file, ending(out or ""))
    return indices


def _executor(stack: ExitStack, scheduler: str | None) -> Executor | None:
    if scheduler is None:
        return None
    check_installed("studies need", ("distributed",), "cluster")
    import logging

    from distributed import Client

    for name in ("distributed", "distributed.client", "tornado.application"):
        logging.getLogger(name).setLevel(logging.CRITICAL)  # what concerns the user is said in a sentence
    try:
        client = stack.enter_context(Client(scheduler, timeout=5))
    except (OSError, ValueError) as error:
        refuse(f"--scheduler {scheduler}: cannot be reached ({str(error) or type(error).__name__})")
    executor: Executor = stack.enter_context(client.get_executor(pure=False, retries=3))
    return executor


@contextmanager
def _table(out: str) -> Iterator[Callable[[xarray.Dataset], None]]:
    """Claim the place of a table, before hours are spent on what it is to hold; yields what writes it."""
    from qsbearing.files.output_file import output_stream
    from qsbearing.studies.tables import write_table

    with output_stream(out) as file:
        yield lambda results: write_table(results, file, ending(out))


def _solved(study: Study, executor: Executor | None, out: str | None, resume: bool, stack: ExitStack) -> xarray.Dataset:
    from tempfile import TemporaryDirectory

    from qsbearing.studies.points import Points
    from qsbearing.studies.sweep import sweep as solve_all

    place = out
    if out is None and Points(study).count > IN_MEMORY:
        place = os.path.join(stack.enter_context(TemporaryDirectory(prefix="qsbearing-")), "results.nc")  # noqa: PTH118
    try:
        with progress_bar() as progress:
            results = solve_all(study, executor, out=place, resume=resume, progress=progress)
    except (KeyboardInterrupt, SystemExit) as stopped:  # Ctrl-C, and what `main` makes of SIGTERM
        note(f"interrupted{_kept(out)}")
        sys.exit(INTERRUPTED if isinstance(stopped, KeyboardInterrupt) else stopped.code)
    except _losses(executor) as error:
        refuse(f"--scheduler: the cluster was lost ({str(error) or type(error).__name__}){_kept(out)}")
    return stack.enter_context(results)


def _losses(executor: Executor | None) -> tuple[type[Exception], ...]:
    """What a cluster raises that is no more there, or has no worker, or whose workers die of a chunk."""
    if executor is None:
        return ()
    from concurrent.futures import CancelledError

    from distributed import KilledWorker

    return CancelledError, OSError, KilledWorker


def _kept(out: str | None) -> str:
    if not out:
        return ""
    from qsbearing.studies.store import folder_of

    return f": finished points are kept in {folder_of(out)}; --resume continues the run"
