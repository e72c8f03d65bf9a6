"""`qsbearing report`: the design report of a scene or a set, as HTML and PDF."""

from __future__ import annotations

import os
import re
import shlex
import sys
from dataclasses import replace
from typing import TYPE_CHECKING

import click

from qsbearing.cli.files import BOXES, check_installed, fill, folder
from qsbearing.cli.output import UNSOLVED, note, print_wrote, refuse
from qsbearing.cli.scene import load_scene_or_set, solve

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from qsbearing.documents.model import Document
    from qsbearing.model.scene.scene import Scene
    from qsbearing.systems.sets.bearing_set import BearingSet

NEEDED = ("jinja2", "typst", "markdown_it", "mdit_py_plugins", "pygments", "matplotlib")
MADE_FROM = re.compile(r'<meta name="made-from" content="([^"]*)">')


@click.command(short_help="Write the design report of a scene or set, HTML and PDF.")
@click.argument("scene")
@click.option("--out", metavar="DIR", required=True, help="Folder for the two files; it is made if it does not exist.")
def report(scene: str, out: str) -> None:
    """Solve SCENE, a bearing or a set of rows, and write its design report to DIR, as one HTML page and one PDF.

    Of a file with [[spectrum]] it opens with the life under all operating points, and shows the one that does most
    damage.

    It contains key results and warnings, the input, assumptions, the effects that are simulated or left out and why,
    results with pictures, readings, curves around the operating point, and the evidence that applies.

    Exit codes: 0 written, 1 no equilibrium or not converged, 2 bad input.
    """
    from pathlib import Path

    check_installed("report needs", NEEDED, "report")
    requested = load_scene_or_set(scene)
    from qsbearing.files.scene_file import is_file, text_of

    path = Path(scene)
    name = (path.stem if is_file(path) else scene).lower()
    page = Path(out) / f"{name}_report.html"
    _refuse_another(page, path)
    make = _maker(requested, text_of(scene), shlex.join(["qsbearing", "report", scene, "--out", "DIR"]))
    from qsbearing.documents.html import html
    from qsbearing.documents.pdf import pdf

    folder(out)
    printed = page.with_suffix(".pdf")
    forms = {
        page: lambda document: html(document).encode(),
        printed: lambda document: pdf(document, lacking=lambda: note(BOXES.format(where=printed))),
    }
    made_from = _from_folder(path, page.parent) if is_file(path) else ""
    fill(forms, lambda: replace(make(), made_from=made_from))
    print_wrote(forms)


def _from_folder(path: Path, folder: Path) -> str:
    """A scene's file as the report names it: from the report's own folder, so that both may move together."""
    from urllib.parse import quote

    try:
        place = os.path.relpath(path.resolve(), folder.resolve())
    except ValueError:  # on another drive
        place = str(path.resolve())
    return quote(os.fsencode(place))


def _refuse_another(page: Path, path: Path) -> None:
    """End where the report that is there is of another file, which is there as well."""
    from urllib.parse import unquote_to_bytes

    from qsbearing.files.scene_file import is_file

    if not is_file(page):
        return
    with page.open(encoding="utf-8", errors="replace") as file:
        match = MADE_FROM.search(file.read(2000))
    other = page.parent / os.fsdecode(unquote_to_bytes(match[1] if match else ""))
    if other.is_file() and not (path.exists() and other.samefile(path)):
        refuse(f"{page}: is the report of {other.resolve()}, which it would replace\n    Choose another --out")


def _maker(requested: Scene | BearingSet, source: str, command: str) -> Callable[[], Document]:
    """What makes the document of a scene or set; ends with the exit code where it has no solution."""
    from qsbearing.remarks.of_solution import message

    solution = solve(requested)
    if not solution.converged.all():
        first = int(solution.converged.argmin())
        note(f"point {first + 1}: {message(solution, first)}" if solution.shape else message(solution))
        sys.exit(UNSOLVED)
    from qsbearing.reports.of_any import document_of_any

    return lambda: document_of_any(solution, requested, source, command)
