"""`fem-check book`: the validation book."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import click

from fem_check.cli.output import BOOK, OUT_OF_TOLERANCE, RESULTS, progress_bar, refuse, require
from fem_check.rows import row_text
from qsbearing.cli.output import print_table, print_wrote
from qsbearing.documents.model import Badge, Table

KINDS = {"M": "measured", "C": "computed", "B": "program"}
"""Of a case, in a word: a measurement, a published calculation, a result of another program."""


@click.command("book", short_help="Compare qsbearing with published results and measurements.")
@click.argument("names", nargs=-1, metavar="[CASE ...]")
@click.option(
    "--out",
    default=RESULTS,
    show_default=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder of results; the cases are written into its folder `book`.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON record per line, and nothing else.")
def book_cases(names: tuple[str, ...], out: Path, as_json: bool) -> None:
    """Compare qsbearing with published catalogues, standards and measurements: the named cases, or else all.

    Writes a record of each case, and one page with all of them, book.html.

    Exit codes: 0 all within tolerance, 1 a case is out of tolerance, 2 bad input or a missing dependency.
    """
    require("fem", *BOOK)
    from fem_check import book
    from fem_check.report.files import write_book

    try:
        for case in book.selected(names):
            require("fem", *case.needs, what=f"case {case.name}")
        with progress_bar(as_json) as reporter:
            entries = book.run_book(names, out, reporter("book"))
        page = write_book(out)
    except book.UnknownCaseError as problem:
        refuse(str(problem))
    except OSError as problem:
        refuse(f"--out {out}: the book cannot be written: {problem.strerror or problem}")
    if as_json:
        for entry in entries:
            print(json.dumps(entry))
    else:
        rows = [
            (entry["case"], KINDS[entry["kind"]], Badge(entry["verdict"]), row_text.short_exponents(entry["summary"]))
            for entry in entries
        ]
        print_table([Table(("case", "kind", "", "found"), rows, "llll", "Published cases")])
        print_wrote([page])
    sys.exit(OUT_OF_TOLERANCE if any(entry["verdict"] == "fail" for entry in entries) else 0)
