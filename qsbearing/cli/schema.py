"""`qsbearing schema`: what scene, set and study files may hold, for editors."""

from __future__ import annotations

import click

from qsbearing.cli.output import print_text


@click.command(short_help="Print a JSON Schema of scene files, for editors.")
def schema() -> None:
    """Print a JSON Schema (draft-07) of scene, set and study files: an editor with it completes keys, shows what they
    mean, and marks what is wrong. `qsbearing guide how_to` tells how to use it.
    """
    import json

    from qsbearing.studies.schema import file_schema

    print_text(json.dumps(file_schema(), indent=1, ensure_ascii=False) + "\n")
