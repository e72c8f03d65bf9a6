"""`qsbearing report`: the design report of a scene or a set, as HTML and PDF."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, NoReturn

import click

from qsbearing.cli.document_files import check_installed, folder, write
from qsbearing.cli.output import UNSOLVED, note, print_text
from qsbearing.cli.scene import load_one, solve, solving

if TYPE_CHECKING:
    from collections.abc import Callable

    from qsbearing.documents.model import Document


@click.command(short_help="Write the design report of a scene or set, HTML and PDF.")
@click.argument("scene")
@click.option("--out", metavar="DIR", required=True, help="Folder for the two files; made if it is not there.")
def report(scene: str, out: str) -> None:
    """Solve SCENE, a bearing or a set of rows, and write its design report to DIR, as one HTML page and one PDF.

    Key results and warnings, input, assumptions, effects in and left out and why, results with pictures, readings,
    curves around the operating point, and the evidence that applies.

    Exit codes: 0 written, 1 no equilibrium or not converged, 2 bad input.
    """
    from pathlib import Path

    check_installed("report")
    path = Path(scene)
    is_file = path.is_file()
    name = (path.stem if is_file else scene).lower()
    make = _maker(scene, path.read_text(encoding="utf-8") if is_file else "")
    from qsbearing.documents.html import html
    from qsbearing.documents.pdf import pdf

    into = folder(out)
    forms = {into / f"{name}_report.html": lambda found: html(found).encode(), into / f"{name}_report.pdf": pdf}
    write(forms, make)
    print_text("".join(f"wrote {each}\n" for each in forms))


def _maker(scene: str, source: str) -> Callable[[], Document]:
    """What makes the document of a scene or set; ends with the exit code where it has no solution."""
    from qsbearing.messages import message

    command = f"qsbearing report {scene} --out DIR"
    asked, of_set = load_one(scene)
    if of_set is not None:
        from qsbearing.sets.solve import solve_set

        with solving():
            solved = solve_set(of_set)
        if not solved.converged:
            _end(message(solved))
        from qsbearing.design_report import set_document

        return lambda: set_document.document(solved, source, command)
    assert asked is not None
    solution = solve(asked)
    if not solution.converged:
        _end(message(solution))
    from qsbearing.design_report.document import document

    return lambda: document(solution, asked, source, command)


def _end(message: str) -> NoReturn:
    note(message)
    sys.exit(UNSOLVED)
