"""What `qsbearing run` does with a file of a set."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING

from qsbearing.cli.output import UNSOLVED, note, print_result, print_table, refuse
from qsbearing.cli.picture_file import drawn
from qsbearing.cli.scene import solving

if TYPE_CHECKING:
    from qsbearing.io.output_file import Writer
    from qsbearing.sets.bearing_set import BearingSet
    from qsbearing.sets.set_solution import SetSolution


def run_set(
    of: BearingSet, as_json: bool, targets: Mapping[str, str], write: Mapping[str, Writer], accuracy: float | None
) -> None:
    """Solve a set and show it; ends with the exit code where it is not solved."""
    from qsbearing.sets.solve import solve_set

    if accuracy is not None:
        refuse("--accuracy: the effects of a set are those that its file names; `qsbearing explain` tells which matter")
    with solving():
        solution = solve_set(of)
    if as_json:
        from qsbearing.io.set_record import set_record

        print_result(of, set_record(solution))
    else:
        from qsbearing.io.set_report import set_result

        print_table(set_result(solution))
    if not solution.converged:
        for target in targets.values():
            note(f"{target} is not written: there is no solution to write")
        sys.exit(UNSOLVED)
    try:
        if "--csv" in targets:
            write["--csv"](_csv(solution))
        if "--plot" in targets:
            write["--plot"](drawn(solution, targets["--plot"]))
    except OSError as error:  # a disk that filled up meanwhile
        refuse(f"cannot write: {error}")


def _csv(solution: SetSolution) -> bytes:
    from qsbearing.io.csv_table import csv_text
    from qsbearing.io.set_record import set_columns

    return csv_text({name: values.tolist() for name, values in set_columns(solution).items()}).encode("utf-8")
