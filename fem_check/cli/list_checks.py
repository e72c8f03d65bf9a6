"""`fem-check list`."""

from __future__ import annotations

import click

from fem_check.cli.output import require
from qsbearing.cli.output import print_table
from qsbearing.documents.model import Table


@click.command("list", short_help="List the checks and the published cases.")
def list_checks() -> None:
    """List the checks (name, kind, question, tolerance) and the cases of the validation book.

    Exit codes: 0 listed, 2 a missing dependency.
    """
    require("fem", "pydantic")
    from fem_check.book.case import EVIDENCE
    from fem_check.book.cases import ALL as CASES
    from fem_check.checks import ALL, OPTIONAL

    checks = [
        row
        for check in (ALL | OPTIONAL).values()
        for row in ((check.name, check.question), ("", f"{check.kind}; tolerance: {check.tolerance}"))
    ]
    book = [
        row for case in CASES.values() for row in ((case.name, case.texts.title), ("", EVIDENCE[case.texts.evidence]))
    ]
    for heading, rows, title in (
        (("check", "question"), checks, "Checks (fem-check run)"),
        (("case", "title and kind"), book, "Published cases (fem-check book)"),
    ):
        print_table([Table(heading, rows, "ll", title, faint=range(1, len(rows), 2))])
