"""`fem-check list`."""

from __future__ import annotations

import click
from rich.console import Console
from rich.table import Table


@click.command("list")
def list_checks() -> None:
    """List the checks (name, kind, question, tolerance) and the cases of the validation book."""
    from fem_check.book.case import EVIDENCE
    from fem_check.book.cases import ALL as CASES
    from fem_check.checks import ALL, OPTIONAL

    table = Table(show_lines=False)
    for heading in ("check", "kind", "question", "tolerance"):
        table.add_column(heading, overflow="fold")
    for check in (ALL | OPTIONAL).values():
        table.add_row(check.name, str(check.kind), check.question, check.tolerance)
    book = Table(title="fem-check book", show_lines=False)
    for heading in ("case", "evidence", "title"):
        book.add_column(heading, overflow="fold")
    for case in CASES.values():
        book.add_row(case.name, EVIDENCE[case.texts.evidence], case.texts.title)
    Console().print(table, book)
