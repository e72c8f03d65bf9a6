"""`fem-check list`."""

from __future__ import annotations

import click

from qsbearing.cli.output import print_table
from qsbearing.io.tables import plain_table


@click.command("list")
def list_checks() -> None:
    """List the checks (name, kind, question, tolerance) and the cases of the validation book."""
    from fem_check.book.case import EVIDENCE
    from fem_check.book.cases import ALL as CASES
    from fem_check.checks import ALL, OPTIONAL

    checks = plain_table("Checks (fem-check run)", ("check", "question"), left=(0, 1))
    for check in (ALL | OPTIONAL).values():
        checks.add_row(check.name, f"{check.question}\n[dim]{check.kind}; tolerance: {check.tolerance}[/dim]")
    book = plain_table("Published cases (fem-check book)", ("case", "kind"), left=(0, 1))
    for case in CASES.values():
        book.add_row(case.name, f"{case.texts.title}\n[dim]{EVIDENCE[case.texts.evidence]}[/dim]")
    for table in (checks, book):
        table.columns[1].no_wrap = False
        print_table(table)
