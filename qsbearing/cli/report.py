"""`qsbearing report`: the design report of a scene, as HTML and PDF."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import click

from qsbearing.cli.document_files import check_installed, folder, write
from qsbearing.cli.output import UNSOLVED, note, print_text
from qsbearing.cli.scene import load, solve

if TYPE_CHECKING:
    from qsbearing.documents.model import Document


@click.command(short_help="Write the design report of a scene, HTML and PDF.")
@click.argument("scene")
@click.option("--out", metavar="DIR", required=True, help="Folder for the two files; made if it is not there.")
def report(scene: str, out: str) -> None:
    """Solve SCENE and write its design report to DIR, as one HTML page and one PDF.

    Key results and warnings, input, assumptions, effects in and left out and why, results with pictures, readings,
    curves around the operating point, and the evidence that applies.

    Exit codes: 0 written, 1 no equilibrium or not converged, 2 bad input.
    """
    from pathlib import Path

    check_installed("report")
    asked = load(scene)
    solution = solve(asked)
    if not solution.converged:
        from qsbearing.messages import message

        note(message(solution))
        sys.exit(UNSOLVED)
    from qsbearing.design_report.document import document
    from qsbearing.documents.html import html
    from qsbearing.documents.pdf import pdf

    path = Path(scene)
    is_file = path.is_file()
    name = (path.stem if is_file else scene).lower()
    source = path.read_text(encoding="utf-8") if is_file else ""

    def make() -> Document:
        return document(solution, asked, source, f"qsbearing report {scene} --out DIR")

    into = folder(out)
    forms = {into / f"{name}_report.html": lambda found: html(found).encode(), into / f"{name}_report.pdf": pdf}
    write(forms, make)
    print_text("".join(f"wrote {each}\n" for each in forms))
