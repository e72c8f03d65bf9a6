"""`qsbearing table`: loads and stiffness over displacements and speed, for programs without bearings."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.files import check_installed, claimed, ending_problems, write_files
from qsbearing.cli.output import NOT_MET, UNSOLVED, note, note_remark, print_table, progress_bar, refuse_all
from qsbearing.cli.settings import set_option, told

if TYPE_CHECKING:
    from collections.abc import Sequence

    from qsbearing.model.validation import ErrorDetail

NEXT_LINE = "\n    "
RANGE = "write KEY, KEY=FROM:TO or KEY=VALUE, such as axial_displacement_um=-10:40"


@click.command(short_help="Tabulate loads and stiffness over displacements and speed, for other programs.")
@click.argument("scene")
@click.option(
    "--over",
    multiple=True,
    metavar="KEY[=RANGE]",
    help="An axis of the table: a displacement, a tilt or speed_rpm, with FROM:TO in the unit of the key; without a "
    "range it follows from the load; of one value it is held there. Repeat it for each axis.",
)
@set_option
@click.option(
    "--error", type=float, default=1.0, metavar="PERCENT", help="The largest error that is wished; 1 by default."
)
@click.option("--points", type=int, default=100_000, metavar="N", help="At most so many points; 100,000 by default.")
@click.option(
    "--interpolation",
    default="linear",
    metavar="HOW",
    help="By which the table will be read: linear (the default), or cubic splines.",
)
@click.option("--seed", type=int, default=0, metavar="N", help="Of the random points at which errors are measured.")
@click.option("--out", metavar="FILE.nc", help="Write the table as netCDF.")
@click.option("--csv", metavar="FILE.csv", help="Write it as CSV.")
def table(
    scene: str,
    over: tuple[str, ...],
    settings: tuple[str, ...],
    error: float,
    points: int,
    interpolation: str,
    seed: int,
    out: str | None,
    csv: str | None,
) -> None:
    """Tabulate the loads and the stiffness of SCENE over displacements and speed, for programs without bearings.

    Without --over the axes are the channels that carry a load, and the speed, if anything depends on it. Others stay as
    the scene has them. The grid is refined until interpolation between its points errs by at most --error percent of
    the scene's force, which is measured at points drawn at random. For instance: qsbearing table 7210c --over
    axial_displacement_um=-10:40 --over speed_rpm=0:24000 --out 7210c.nc

    Exit codes: 0 the table is as wished, 1 no point is solved, 2 bad input, 3 it errs by more than --error.
    """
    from qsbearing.model.validation import SceneError

    check_installed("tables need", ("xarray", "h5netcdf"), "studies")
    problems = [] if out is None else ending_problems("--out", out, (".nc",))
    problems += [] if csv is None else ending_problems("--csv", csv, (".csv",))
    axes, of_axes = _axes_of(over)
    problems += of_axes
    files = {"--out": out, "--csv": csv}
    with ExitStack() as stack:
        of, changes, problems = _checked(stack, scene, settings, files, problems, (error, points, interpolation, seed))
        writers = claimed(stack, files, problems, scene)
        from qsbearing.files.csv_table import csv_bytes
        from qsbearing.results.remarks import blocks
        from qsbearing.studies.force_table.force_table import CHECKED, tabulated
        from qsbearing.studies.force_table.shown import blocks_of, columns_of

        try:
            with progress_bar() as progress:
                made, remarks = tabulated(
                    of, axes, wished_error=error / 100.0, most_points=points, interpolation=interpolation,
                    checked_points=CHECKED, seed=seed, progress=progress,
                )  # fmt: skip
        except SceneError as wrong:
            refuse_all(_told(wrong.errors))
            raise
        solved = made.attrs["points"] > made.attrs["unsolved_points"]
        print_table([*told(changes), *blocks_of(made)])
        if solved:
            make = {
                "--out": lambda: bytes(made.to_netcdf(engine="h5netcdf")),
                "--csv": lambda: csv_bytes(columns_of(made)),
            }
            write_files(writers, make)
    for remark in blocks(remarks):
        note_remark(remark)
    if not solved:
        note("no point is solved: nothing is written")
        sys.exit(UNSOLVED)
    if not made.attrs["wish_is_met"]:
        note(f"the table errs by more than --error {error:g}: give more --points, shorter ranges or fewer axes")
        sys.exit(NOT_MET)


def _checked(
    stack: ExitStack,
    scene: str,
    settings: Sequence[str],
    files: dict[str, str | None],
    problems: list[str],
    numbers: tuple[float, int, str, int],
) -> tuple[Any, Any, list[str]]:
    """The scene, what was set, and all that is wrong so far; where there is no scene, ends with that and its errors."""
    from qsbearing.cli.scene import load_one
    from qsbearing.studies.force_table.force_table import number_errors, scene_errors

    error, points, interpolation, seed = numbers
    own = number_errors({"wished_error": error / 100.0, "most_points": points}, interpolation)
    problems = [*problems, *_told(own), *([] if seed >= 0 else [f"--seed {seed}: must not be negative"])]
    try:
        of, _, changes = load_one(scene, settings)
    except SystemExit:
        claimed(stack, files, problems)
        raise
    if hasattr(of, "rows"):
        return (
            of,
            changes,
            [*problems, f"{scene}: is a set of rows; a table is of one bearing: give it a scene of its own"],
        )
    return of, changes, [*problems, *_told(scene_errors(of))]


def _axes_of(over: Sequence[str]) -> tuple[dict[str, Any], list[str]]:
    """The axes that are named, by the fields of an operation, in SI; and what is wrong with them."""
    from qsbearing.files.keys import OF_OPERATION
    from qsbearing.model.validation import alike, question
    from qsbearing.studies.force_table.table_axes import FIELDS, over_errors

    fields = {OF_OPERATION[field].name: field for field in FIELDS}
    axes: dict[str, Any] = {}
    problems = []
    for text in over:
        name, equals, values = (part.strip() for part in text.partition("="))
        name = name.removeprefix("operation.")
        field = fields.get(name)
        if field is None or field in axes:
            meant = question(alike(name, fields)) or f"One of: {', '.join(fields)}"
            problems.append(
                f"--over {text}: is {f'no axis of a table{NEXT_LINE}{meant}' if field is None else 'named twice'}"
            )
            continue
        try:
            ends = [float(each) for each in values.split(":")] if equals else []
            if len(ends) > 2:
                raise ValueError
        except ValueError:
            problems.append(f"--over {text}: {RANGE}")
            continue
        axes[field] = (OF_OPERATION[field].si(ends[0]), OF_OPERATION[field].si(ends[-1])) if ends else None
    return axes, [*problems, *_told(over_errors(axes))]


def _told(errors: Sequence[ErrorDetail]) -> list[str]:
    """Errors by the options that they are of, in the units of files."""
    return [str(_by_option(each)) for each in errors]


_OPTIONS = {"most_points": "--points", "interpolation": "--interpolation", "over": "--over"}


def _by_option(error: ErrorDetail) -> Any:
    from qsbearing.files.file_errors import translate
    from qsbearing.files.keys import OF_OPERATION

    if error.field == "wished_error" and error.allowed:
        percent = 100.0 * error.allowed[0], 100.0 * error.allowed[1]
        said = translate(error)
        return replace(said, key="--error", value=100.0 * error.value, unit="%", allowed=percent)
    if error.field.startswith("over."):
        field = error.field.removeprefix("over.")
        return replace(translate(replace(error, field=f"operation.{field}")), key=f"--over {OF_OPERATION[field].name}")
    said = translate(error)
    return replace(said, key=_OPTIONS.get(error.field, said.key))
