"""What `qsbearing run` does with a file of a set."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from qsbearing.cli.output import NO_SOLUTION, print_result, print_table, refuse, write_files
from qsbearing.cli.picture_file import drawn
from qsbearing.cli.scene import solving

if TYPE_CHECKING:
    from qsbearing.io.output_file import Writer
    from qsbearing.sets.bearing_set import BearingSet


def run_set(
    of: BearingSet, as_json: bool, targets: Mapping[str, str], write: Mapping[str, Writer], accuracy: float | None
) -> None:
    """Solve a set and show it; ends with the exit code where it is not solved."""
    from qsbearing.io.csv_table import csv_bytes
    from qsbearing.io.readings_record import taken
    from qsbearing.io.set_record import set_columns, set_record
    from qsbearing.sets.solve import solve_set

    if accuracy is not None:
        refuse("--accuracy: the effects of a set are those that its file names; `qsbearing explain` tells which matter")
    with solving(of):
        solution = solve_set(of)
    readings = [taken(row) for row in solution.rows]
    if as_json:
        print_result(of, set_record(solution, readings))
    else:
        from qsbearing.io.set_report import set_result

        print_table(set_result(solution, readings))
    make = {
        "--csv": lambda: csv_bytes(set_columns(solution, readings)),
        "--plot": lambda: drawn(solution, targets["--plot"]),
    }
    write_files(targets, write, make, "" if solution.converged else NO_SOLUTION)
