"""`qsbearing catalogue`: the bearings that can be named, with their sources."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from qsbearing.cli.output import print_table, refuse

if TYPE_CHECKING:
    from qsbearing.files.catalogue import CatalogueEntry


@click.command(short_help="List the bearings that can be named, and their sources.")
@click.argument("name", required=False)
@click.option("--bore", type=float, metavar="MM", help="Bore diameter.")
@click.option("--angle", type=float, metavar="DEG", help="Free contact angle: 15, 17 or 25.")
@click.option("--series", default="", metavar="SERIES", help="Beginning of the name: 719, 72, KH70, KH719.")
@click.option(
    "--hybrid/--steel", default=None, help="Only bearings with ceramic balls, or only those with steel balls."
)
def catalogue(name: str | None, bore: float | None, angle: float | None, series: str, hybrid: bool | None) -> None:
    """List the bearings that a scene can name; with NAME, show where each number of that bearing comes from.

    The options select standard spindle bearings.

    Exit codes: 0 listed, 2 no such bearing.
    """
    from qsbearing.files.catalogue import chosen, entries
    from qsbearing.results import tables

    is_choice = bool(series) or (bore, angle, hybrid) != (None, None, None)
    if name is not None:
        if is_choice:
            refuse("give a NAME or options, not both: the options select spindle bearings")
        print_table(tables.catalogue_entry(entry_named(name)))
        return
    if not is_choice:
        print_table(tables.catalogue(entries()))
        return
    bearings = chosen(bore, angle, series, hybrid)
    if not bearings:
        bores = sorted({f"{entry.dimensions['bore_diameter_mm']:g}" for entry in chosen()}, key=float)
        listed = f"bores are {', '.join(bores)} mm, free contact angles 15, 17 and 25 deg"
        refuse(f"no spindle bearing matches all of these options; {listed}")
    print_table(tables.spindle_table(bearings))


def entry_named(name: str) -> CatalogueEntry:
    """The catalogue's entry; ends with exit code 2 where there is none."""
    from qsbearing.files.catalogue import find
    from qsbearing.files.sheet_by_name import nearest

    entry = find(name)
    if entry is None:
        refuse(f"{name!r} is not in the catalogue. {nearest(name)}")
    return entry
