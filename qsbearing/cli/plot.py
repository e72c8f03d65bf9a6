"""`qsbearing plot`: draw the results of a sweep."""

from __future__ import annotations

import os
from contextlib import ExitStack

import click

from qsbearing.cli.files import PICTURES, check_installed, claimed, draw, ending_problems, write_files
from qsbearing.cli.output import note, note_remark, refuse


@click.command(short_help="Draw the results of a sweep.")
@click.argument("results")
@click.option("-x", "x", metavar="KEY", help="Key along the horizontal axis; the longest axis if not given.")
@click.option("-y", "y", multiple=True, metavar="QUANTITY", help="A result to show; repeat it for each further result.")
@click.option(
    "--kind",
    metavar="KIND",
    help="lines, map, rose, azimuth, distribution or sensitivity; by default the kind that suits the results.",
)
@click.option(
    "--at", multiple=True, metavar="KEY=VALUE", help="Value of a further axis to show; its first if not given."
)
@click.option(
    "--out", metavar="FILE", help="Picture to write: .png, .svg or .pdf; the name of RESULTS with .png if not given."
)
def plot(
    results: str, x: str | None, y: tuple[str, ...], kind: str | None, at: tuple[str, ...], out: str | None
) -> None:
    """Draw RESULTS, a netCDF file of `qsbearing sweep`.

    Exit codes: 0 drawn, 2 bad input.
    """
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.remarked import of_results
    from qsbearing.studies.store import open_results

    check_installed("plot needs", ("xarray", "matplotlib"), "studies")
    target = out or os.path.splitext(results)[0] + ".png"  # noqa: PTH122 - pathlib costs --help its time
    with ExitStack() as stack:
        try:
            dataset = stack.enter_context(open_results(results))
        except SceneError as error:
            refuse(str(error))
        places = _places(at)
        writers = claimed(stack, {"--out": target}, ending_problems("--out", target, PICTURES))
        make = {"--out": lambda: draw(dataset, target, x=x, y=y, kind=kind, at=places)}
        try:
            write_files(writers, make)
        except (OSError, RuntimeError) as error:  # of HDF5, which reads what is drawn only now
            refuse(f"{results}: is damaged: {error}")
        for each in of_results(dataset.attrs):
            note_remark(each)
    if out is None:
        note(f"drawn to {target}")


def _places(at: tuple[str, ...]) -> dict[str, float]:
    places = {}
    for text in at:
        key, _, value = text.partition("=")
        try:
            places[key.strip()] = float(value)
        except ValueError:
            refuse(f"--at {text}: write KEY=VALUE, such as speed_rpm=10000")
    return places
