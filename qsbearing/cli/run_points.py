"""`qsbearing run --points`: a scene at each row of a table."""

from __future__ import annotations

import os
import sys
from collections import Counter
from typing import Any

from qsbearing.cli.files import ending, ending_problems, missing
from qsbearing.cli.output import UNSOLVED, print_text, print_wrote, progress_bar, refuse, refuse_all, warnings_as_notes

_NEEDS: dict[str, tuple[str, ...]] = {".csv": (), ".xlsx": ("pandas", "openpyxl"), ".parquet": ("pandas", "pyarrow")}
SHOWN = 5


def run_points(scene: str, points: str | None, out: str | None, decimal: str | None, others: dict[str, Any]) -> None:
    """Solve the scene at each row and write the rows with their results; ends the command."""
    from qsbearing.design.point_table import read_table, solve_table, table_bytes
    from qsbearing.io.output_file import output_file
    from qsbearing.validation import SceneError

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
    try:
        with output_file(out) as write:
            with warnings_as_notes(), progress_bar() as progress:
                found = solve_table(scene, read_table(points, decimal), points, progress)
            write(table_bytes(found, ending(out)))
    except SceneError as error:
        refuse(str(error))
    except (OSError, ValueError) as error:
        refuse(f"--out {out}: {error}")
    counts = Counter(found["status"])
    print_text(f"{counts['converged']:,} of {len(found['status']):,} rows solved\n")
    bad = [i for i, status in enumerate(found["status"]) if status != "converged"]
    for i in bad[:SHOWN]:
        print_text(f"row {i + 1}: {found['status'][i]}, {found['reason'][i]}\n")
    if len(bad) > SHOWN:
        print_text(f"and {len(bad) - SHOWN:,} more, with their reasons in the file\n")
    print_wrote([out])
    if not counts["converged"]:
        sys.exit(UNSOLVED)


def _problems(option: str, target: str) -> list[str]:
    form = ending(target)
    lacks = missing(*_NEEDS.get(form, ()))
    needs = [f"{option} *{form} needs {' and '.join(lacks)}: pip install 'qsbearing[tables]'"] if lacks else []
    return ending_problems(option, target, tuple(_NEEDS)) + needs
