"""`qsbearing init`: a commented scene file to start from."""

from __future__ import annotations

import click

from qsbearing.cli.catalogue import entry_named
from qsbearing.cli.output import print_text


@click.command(short_help="Print a commented scene file.")
@click.argument("name", required=False)
def init(name: str | None) -> None:
    """Print a commented scene file: B218 spelled out, or the catalogue bearing NAME."""
    from qsbearing.io.template import scene_template

    print_text(scene_template(entry_named(name or "B218"), by_name=name is not None))
