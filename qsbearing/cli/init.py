"""`qsbearing init`: a commented scene file to start from."""

from __future__ import annotations

import click

from qsbearing.cli.catalogue import entry_named
from qsbearing.cli.output import print_text


@click.command(short_help="Print a commented scene file.")
@click.argument("name", required=False)
@click.option("--set", "as_set", is_flag=True, help="Print a set: two rows on one shaft, preloaded against each other.")
def init(name: str | None, as_set: bool) -> None:
    """Print a commented scene file: B218 spelled out, or the catalogue bearing NAME; with --set a pair of 7210C, or of
    NAME."""
    from qsbearing.files.template import scene_template, set_template

    if as_set:
        print_text(set_template(entry_named(name or "7210C")))
        return

    print_text(scene_template(entry_named(name or "B218"), by_name=name is not None))
