"""`fem-check report`: the validation report."""

from __future__ import annotations

from pathlib import Path

import click

from fem_check.cli.output import BOOK, RESULTS, refuse, require
from qsbearing.cli.output import print_text, print_wrote
from qsbearing.model.validation import printable


@click.command("report", short_help="Write the validation report from records.")
@click.option(
    "--out",
    default=RESULTS,
    show_default=True,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for the report.",
)
@click.option(
    "--records",
    default=None,
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder with the records; by default that of --out, or, if it has none, the records of the package.",
)
@click.option(
    "--previous",
    default=None,
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    help="Folder with the records of an earlier release to compare with.",
)
def report(out: Path, records: Path | None, previous: Path | None) -> None:
    """Write the validation report as HTML and PDF, and its rows as CSV and JSON, from records only; no check is run.

    Exit codes: 0 written, whatever the verdicts in it, 2 no records or a missing dependency.
    """
    require("fem", *BOOK, "typst")
    from fem_check.report import evidence, files
    from fem_check.running import records_store

    try:
        folder = records or (out if records_store.read_all(out) else records_store.FOLDER)
        current = evidence.read(folder)
        written = files.write(current, None if previous is None else evidence.read(previous, alone=True), out)
    except records_store.RecordError as problem:
        refuse(str(problem))
    except OSError as problem:
        refuse(f"{problem.filename or out}: cannot be read or written: {problem.strerror or problem}")
    print_wrote(written)
    print_text(f"from the records in {printable(str(folder))}\n")
