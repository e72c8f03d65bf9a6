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

    checks = _table("Checks (fem-check run)")
    for check in (ALL | OPTIONAL).values():
        checks.add_row(check.name, f"{check.question}\n[dim]{check.kind}; tolerance: {check.tolerance}[/dim]")
    book = _table("Published cases (fem-check book)")
    for case in CASES.values():
        book.add_row(case.name, f"{case.texts.title}\n[dim]{EVIDENCE[case.texts.evidence]}[/dim]")
    Console(highlight=False).print(checks, "", book)


def _table(title: str) -> Table:
    """Names, whole at 80 columns, and what there is to say of each."""
    table = Table(
        title=title, title_justify="left", title_style="bold", box=None, show_header=False, padding=(0, 2, 0, 0)
    )
    table.add_column(no_wrap=True)
    table.add_column()
    return table
