"""`qsbearing catalogue`: the bearings that can be named, with their sources."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from qsbearing.cli.output import print_table, refuse

if TYPE_CHECKING:
    from qsbearing.io.catalogue import Entry


@click.command(short_help="List the bearings that can be named, and their sources.")
@click.argument("name", required=False)
def catalogue(name: str | None) -> None:
    """List the bearings that can be named, or with NAME where each number of one comes from."""
    from qsbearing.io import tables
    from qsbearing.io.catalogue import entries

    print_table(tables.catalogue(entries()) if name is None else tables.catalogue_entry(entry_named(name)))


def entry_named(name: str) -> Entry:
    """The catalogue's entry; ends with exit code 2 where there is none."""
    from qsbearing.io.catalogue import find, nearest

    entry = find(name)
    if entry is None:
        refuse(f"{name!r} is not in the catalogue. {nearest(name)}")
    return entry
