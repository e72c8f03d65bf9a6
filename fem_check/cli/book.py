"""`fem-check book`: the validation book."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click
from rich.box import SIMPLE
from rich.console import Console
from rich.table import Table
from rich.text import Text

from fem_check.cli.output import OUT_OF_TOLERANCE, RESULTS, progress_bar, refuse, require


@click.command("book")
@click.argument("names", nargs=-1, metavar="[CASE ...]")
@click.option("--out", default=RESULTS, show_default=True, type=click.Path(path_type=Path, file_okay=False))
@click.option("--json", "as_json", is_flag=True, help="One record per line on stdout, and nothing else.")
def book_cases(names: tuple[str, ...], out: Path, as_json: bool) -> None:
    """Hold qsbearing against published catalogues, standards and measurements, all cases by default.

    Writes a record, a page and a picture of each case, and an index, into the folder `book` of a folder of results.
    """
    require("report", "matplotlib")
    from fem_check import book

    try:
        with progress_bar(as_json) as reporter:
            found = book.run_book(names, out, reporter("book"))
    except book.UnknownCaseError as problem:
        refuse(str(problem))
    except OSError as problem:
        refuse(f"the book in {out} cannot be written: {problem}")
    if as_json:
        for entry in found:
            print(json.dumps(entry))
    else:
        table = Table(box=SIMPLE, padding=(0, 1), pad_edge=False)
        for heading in ("case", "kind", "", "found"):
            table.add_column(heading, overflow="fold")
        for entry in found:
            style = {"pass": "green", "fail": "bold red"}[entry["verdict"]]
            table.add_row(entry["case"], entry["kind"], Text(entry["verdict"], style=style), Text(entry["summary"]))
        Console().print(table)
        Console(soft_wrap=True, highlight=False).print(f"pages: {out / 'book' / 'README.md'}")
    sys.exit(OUT_OF_TOLERANCE if any(entry["verdict"] == "fail" for entry in found) else 0)
