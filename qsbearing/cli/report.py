"""`qsbearing report`: the design report of a scene or a set, as HTML and PDF."""

from __future__ import annotations

import os
import re
import shlex
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from qsbearing.cli.ball_sets import blocks_of_lists
from qsbearing.cli.files import BOXES, check_installed, fill, folder
from qsbearing.cli.output import NOT_MET, UNSOLVED, note, print_wrote, refuse
from qsbearing.cli.scene import answers_to_required, is_missed, load_scene_or_set, solve
from qsbearing.cli.settings import set_option

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from qsbearing.documents.model import Document
    from qsbearing.model.scene.scene import Scene
    from qsbearing.studies.changed_keys import ChangedKey
    from qsbearing.systems.sets.bearing_set import BearingSet

NEEDED = ("jinja2", "typst", "markdown_it", "pygments", "matplotlib")
MADE_FROM = re.compile(r'<meta name="made-from" content="([^"]*)">')


@click.command(short_help="Write the design report of a scene or set, HTML and PDF.")
@click.argument("scene")
@set_option
@click.option("--out", metavar="DIR", required=True, help="Folder for the two files; it is made if it does not exist.")
def report(scene: str, settings: tuple[str, ...], out: str) -> None:
    """Solve SCENE, a bearing or a set of rows, and write its design report to DIR, as one HTML page and one PDF.

    Of a file with [[spectrum]] it opens with the life under all operating points, and shows the one that does most
    damage.

    Page 1 answers what is required, shows the case under its load, what gives way, what the model leaves out and the
    main numbers. Warnings, results, readings, curves around the operating point, assumptions and effects, the input and
    the evidence that applies follow. Balls of a set's rows are listed with ball_tables = "each" in [report].

    Exit codes: 0 written, 1 no equilibrium or not converged, 2 bad input, 3 written, but a requirement of the file's
    [require] is not met.
    """
    from pathlib import Path

    check_installed("report needs", NEEDED, "report")
    requested, document, changes = load_scene_or_set(scene, settings)
    from qsbearing.files.scene_file import is_file, text_of

    path = Path(scene)
    name = (path.stem if is_file(path) else scene).lower()
    page = Path(out) / f"{name}_report.html"
    _refuse_another(page, path)
    solution = _solved(requested)
    required = answers_to_required(solution)
    given = [word for each in settings for word in ("--set", each)]
    command = shlex.join(["qsbearing", "report", scene, *given, "--out", "DIR"])
    source = text_of(scene)
    if changes:
        from qsbearing.studies.changed_keys import text_with

        source = text_with(document, changes)
    make = _maker(solution, requested, document, source, command, changes)
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
    if is_missed(required):
        sys.exit(NOT_MET)


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


def _solved(requested: Scene | BearingSet) -> Any:
    """Its solution; ends with the exit code where it has none."""
    from qsbearing.remarks.of_solution import message

    solution = solve(requested)
    if not solution.converged.all():
        first = int(solution.converged.argmin())
        note(f"point {first + 1}: {message(solution, first)}" if solution.shape else message(solution))
        sys.exit(UNSOLVED)
    return solution


def _maker(
    solution: Any,
    requested: Scene | BearingSet,
    tables: dict[str, Any],
    source: str,
    command: str,
    changes: Sequence[ChangedKey],
) -> Callable[[], Document]:
    """What makes the document of a scene or set."""
    from qsbearing.reports.of_any import document_of_any

    return lambda: _with_other_sets(document_of_any(solution, requested, source, command, changes), requested, tables)


def _with_other_sets(made: Document, requested: Scene | BearingSet, tables: dict[str, Any]) -> Document:
    """With the range over the ball sets of a bearing that is a list, before how the report was made."""
    from qsbearing.documents.model import Section

    blocks = blocks_of_lists(tables, requested)
    *sections, last = made.sections
    return replace(made, sections=[*sections, Section("Other ball sets", blocks), last]) if blocks else made
