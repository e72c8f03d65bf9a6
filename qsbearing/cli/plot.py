"""`qsbearing plot`: draw the results of a sweep."""

from __future__ import annotations

import importlib.util
import os

import click

from qsbearing.cli.output import note, refuse
from qsbearing.cli.picture_file import draw_to


@click.command(short_help="Draw the results of a sweep.")
@click.argument("results")
@click.option("-x", "x", metavar="KEY", help="Along the horizontal axis; the longest axis if not given.")
@click.option("-y", "y", multiple=True, metavar="QUANTITY", help="A result to show; again for each further one.")
@click.option(
    "--kind",
    metavar="KIND",
    help="lines, map, rose, azimuth, distribution or sensitivity; if not what suits the results.",
)
@click.option("--at", multiple=True, metavar="KEY=VALUE", help="Of a further axis, the value to show; its first.")
@click.option("--out", metavar="FILE", help=".png, .svg or .pdf; the name of RESULTS with .png if not given.")
def plot(
    results: str, x: str | None, y: tuple[str, ...], kind: str | None, at: tuple[str, ...], out: str | None
) -> None:
    """Draw RESULTS, a netCDF file of `qsbearing sweep`.

    Exit codes: 0 drawn, 2 bad input.
    """
    from qsbearing.studies.store import open_results
    from qsbearing.validation import SceneError

    for module in ("xarray", "matplotlib"):
        if importlib.util.find_spec(module) is None:
            refuse(f"plot needs {module}: pip install 'qsbearing[studies]'")
    target = out or os.path.splitext(results)[0] + ".png"  # noqa: PTH122 - pathlib costs --help its time
    try:
        with open_results(results) as dataset:
            draw_to(dataset, target, x=x, y=y, kind=kind, at=_places(at))
    except SceneError as error:
        refuse(str(error))
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
