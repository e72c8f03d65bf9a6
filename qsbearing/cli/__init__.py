"""The command line: formats and calls, computes nothing; one file per command.

Exit codes: 0 solved, 1 no equilibrium or not converged, 2 bad input; the others are told in `ended`. Whatever is heavy
is imported where it is used, so that `--help` appears at once.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn

import click

from qsbearing.cli.app import app
from qsbearing.cli.catalogue import catalogue
from qsbearing.cli.compare import compare
from qsbearing.cli.cost import cost
from qsbearing.cli.ended import run_to_the_end
from qsbearing.cli.explain import explain
from qsbearing.cli.figures import figures
from qsbearing.cli.find import find
from qsbearing.cli.guide import guide
from qsbearing.cli.heat import heat
from qsbearing.cli.import_model import import_model
from qsbearing.cli.init import init
from qsbearing.cli.mcp import mcp
from qsbearing.cli.plot import plot
from qsbearing.cli.report import report
from qsbearing.cli.run import run
from qsbearing.cli.schema import schema
from qsbearing.cli.skill import skill
from qsbearing.cli.stiffness import stiffness
from qsbearing.cli.sweep import sweep
from qsbearing.cli.table import table
from qsbearing.model.version import __version__


class _Commands(click.Group):
    """A group whose usage errors repeat what was typed without its control characters."""

    def make_context(self, *args: Any, **kwargs: Any) -> click.Context:
        with _printable_usage_errors():
            return super().make_context(*args, **kwargs)

    def invoke(self, ctx: click.Context) -> Any:
        with _printable_usage_errors():
            return super().invoke(ctx)


@contextmanager
def _printable_usage_errors() -> Iterator[None]:
    try:
        yield
    except click.UsageError as error:
        if isinstance(error, getattr(click.exceptions, "NoArgsIsHelpError", ())):
            raise  # its text is the help
        from qsbearing.model.validation import printable

        raise click.UsageError(printable(error.format_message()), error.ctx) from None


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="qsbearing")
def cli() -> None:
    """Quasi-static (Jones-Harris) model of angular-contact ball bearings.

    Start with `qsbearing run b218`, or write a scene of your own from `qsbearing init > my.toml`.
    """


for command in (
    run,
    explain,
    app,
    sweep,
    find,
    compare,
    plot,
    heat,
    stiffness,
    table,
    import_model,
    figures,
    cost,
    init,
    schema,
    mcp,
    skill,
    catalogue,
    report,
    guide,
):
    cli.add_command(command)


def main() -> NoReturn:
    """The console script."""
    # No matrix here is large enough for the threads of BLAS, and a small machine lacks the memory that they set aside.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    run_to_the_end(cli, "qsbearing")
