"""The command line: formats and calls; the checks compute. One file per command.

Whatever is heavy is imported where it is used, so that `--help` appears at once.
"""

from typing import NoReturn

import click

from fem_check.cli.book import book_cases
from fem_check.cli.contact import contact
from fem_check.cli.cost import cost
from fem_check.cli.list_checks import list_checks
from fem_check.cli.report import report
from fem_check.cli.run import run_checks
from fem_check.release.command import release
from qsbearing.cli.ended import run_to_the_end


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="qsbearing", prog_name="fem-check")
def cli() -> None:
    """Three-dimensional finite-element checks of the contacts that qsbearing takes from Hertz."""


for command in (list_checks, run_checks, book_cases, contact, cost, report, release):
    cli.add_command(command)


def main() -> NoReturn:
    """Entry point."""
    run_to_the_end(cli, "fem-check")
