"""`qsbearing mcp`: tools for language models."""

from __future__ import annotations

import click

from qsbearing.cli.files import check_installed
from qsbearing.cli.output import refuse


@click.command(short_help="Serve tools to a language model (MCP).")
@click.option("--folder", default=".", show_default=True, metavar="DIR", help="Files are below it, no others.")
def mcp(folder: str) -> None:
    """Serve the tools describe, solve, explain, find, sweep and report to a language model, over the Model Context
    Protocol (MCP) on standard input and output. The program that talks to the model starts this command.

    Exit codes: 0 ended, 2 bad input.
    """
    check_installed("mcp needs", ("mcp", "xarray", "h5netcdf", "jinja2", "typst", "matplotlib", "tomli_w"), "mcp")
    from pathlib import Path

    from qsbearing.app.mcp.server import serve

    try:
        serve(Path(folder))
    except OSError as error:
        refuse(f"--folder {folder}: {error.strerror or error}")
