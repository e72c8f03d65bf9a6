"""`qsbearing run --points`: a scene at each row of a table."""

from __future__ import annotations

import os
import sys
from collections import Counter
from typing import TYPE_CHECKING, Any

from qsbearing.cli.ball_sets import note_of_lists
from qsbearing.cli.files import ending, ending_problems, how_to_install, missing
from qsbearing.cli.output import (
    UNSOLVED,
    note,
    print_table,
    print_text,
    print_wrote,
    progress_bar,
    refuse,
    refuse_all,
    warnings_as_notes,
)
from qsbearing.cli.settings import changed_read

if TYPE_CHECKING:
    from collections.abc import Sequence

    from qsbearing.studies.remarked import Look
    from qsbearing.studies.study import Read

_NEEDS: dict[str, tuple[str, ...]] = {".csv": (), ".xlsx": ("openpyxl",), ".parquet": ("pyarrow",)}
SHOWN = 5


def run_points(
    scene: str,
    settings: Sequence[str],
    points: str | None,
    out: str | None,
    decimal: str | None,
    others: dict[str, Any],
) -> None:
    """Solve the scene at each row and write the rows with their results; ends the command."""
    problems = [f"{name}: cannot be used with --points, whose results go to --out" for name in others]
    for option, target in (("--points", points), ("--out", out)):
        if target is None:
            problems.append(f"{option} FILE is missing: --points and --out go together")
        else:
            problems += _problems(option, target)
    if points and out and os.path.realpath(points) == os.path.realpath(out):
        problems.append("--out: the same file as --points")
    refuse_all(problems)
    assert points is not None and out is not None  # said to be missing
    looks: list[Look] = []
    from qsbearing.model.validation import SceneError

    try:
        with warnings_as_notes():
            _, read, changes = changed_read(scene, settings, lambda _: None)
    except SceneError as error:
        refuse(str(error))
    table = _solved(read, points, out, decimal, looks)
    note_of_lists(read.document)
    for each in changes:
        print_text(f"Set: {each}\n")
    counts = Counter(table["status"])
    print_text(f"{counts['converged']:,} of {len(table['status']):,} rows solved\n")
    bad = [i for i, status in enumerate(table["status"]) if status != "converged"]
    for i in bad[:SHOWN]:
        print_text(f"row {i + 1}: {table['status'][i]}, {table['reason'][i]}\n")
    if len(bad) > SHOWN:
        print_text(f"and {len(bad) - SHOWN:,} more, with their reasons in the file\n")
    from qsbearing.studies.remarked import of_look, together

    print_table(of_look(together(looks), len(table["status"])))
    print_wrote([out])
    if not counts["converged"]:
        sys.exit(UNSOLVED)


def _solved(scene: Read, points: str, out: str, decimal: str | None, looks: list[Look]) -> dict[str, list[Any]]:
    """The rows with their results, written; what is solved before anything fails is kept beside them as CSV."""
    from qsbearing.files.csv_table import csv_bytes
    from qsbearing.files.output_file import kept_rows, output_file
    from qsbearing.model.validation import SceneError
    from qsbearing.studies.design.point_table import read_table, solve_table, table_bytes

    done = 0
    kept = ""
    try:
        with output_file(out) as write, kept_rows(out) as (file, part):

            def keep(columns: dict[str, list[Any]]) -> None:
                nonlocal done, kept
                file.write(csv_bytes(columns, with_headings=not done))
                file.flush()
                done, kept = done + len(columns["status"]), str(part)

            with warnings_as_notes(), progress_bar() as progress:
                table = solve_table(scene, read_table(points, decimal), points, progress, keep, looks)
            write(table_bytes(table, ending(out)))
            kept = ""
        return table
    except SceneError as error:
        refuse(str(error))
    except MemoryError:
        refuse(f"--out {out}: there is not enough memory to write it")
    except (OSError, ValueError) as error:
        refuse(f"--out {out}: {getattr(error, 'strerror', None) or error}")
    finally:
        if kept:
            note(f"{done:,} rows with their results are kept in {kept}, as CSV")


def _problems(option: str, target: str) -> list[str]:
    form = ending(target)
    lacks = missing(*_NEEDS.get(form, ()))
    needs = [f"{option} *{form} needs {' and '.join(lacks)}: {how_to_install('tables')}"] if lacks else []
    return ending_problems(option, target, tuple(_NEEDS)) + needs
