"""What `qsbearing explain` does with a file of a set."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING

from qsbearing.cli.explained import remarks, table
from qsbearing.cli.output import UNSOLVED, note, print_table, print_text
from qsbearing.cli.scene import solving

if TYPE_CHECKING:
    from rich.console import RenderableType

    from qsbearing.sets.bearing_set import BearingSet


def show_set(of: BearingSet, as_json: bool, tolerance: float) -> None:
    """Solve a set with and without each effect and tell what matters; ends with the exit code where it is not
    solved."""
    from rich.console import Group
    from rich.padding import Padding
    from rich.text import Text

    from qsbearing.chooser.explain_set import explain_set
    from qsbearing.io.report import warnings_below
    from qsbearing.io.set_record import set_record
    from qsbearing.io.set_report import heading, rows_tables
    from qsbearing.sets.preload_summary import preload_summary

    with solving():
        solution, rows = explain_set(of, tolerance)
        said = preload_summary(solution) if solution.converged else []
    found = set_record(solution, [{}] * len(solution.rows))
    if as_json:
        of_set = {key: found[key] for key in ("status", "message", "arrangement", "warnings")}
        of_set |= {"preload": said, "tolerance": tolerance, "effects": [vars(row) for row in rows]}
        print_text(json.dumps(of_set, indent=1, allow_nan=False) + "\n")
    elif solution.converged:
        parts: list[RenderableType] = [*rows_tables(found), Text("\n".join(said)), table(rows, tolerance)]
        parts += [Group(*remarks(rows)), *warnings_below(found["warnings"])]
        print_table(Group(heading(solution, found), *(Padding(each, (1, 0, 0, 0)) for each in parts)))
    else:
        print_table(heading(solution, found))
    if not solution.converged:
        note(solution.message())
        sys.exit(UNSOLVED)
