"""What `qsbearing run` does with a file of a set."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING

from qsbearing.cli.output import UNSOLVED, note, print_table, print_text, refuse
from qsbearing.cli.scene import solving

if TYPE_CHECKING:
    from qsbearing.io.output_file import Writer
    from qsbearing.sets.bearing_set import BearingSet


def run_set(
    of: BearingSet, as_json: bool, targets: Mapping[str, str], write: Mapping[str, Writer], accuracy: float | None
) -> None:
    """Solve a set and show it; ends with the exit code where it is not solved."""
    from qsbearing.sets.solve import solve_set

    problems = []
    if "--plot" in targets:
        problems.append("--plot: pictures of a run are of single bearings; --csv writes every ball of every row")
    if accuracy is not None:
        problems.append("--accuracy: the effects of a set are those that its file names")
    if problems:
        refuse("\nqsbearing: ".join(problems))
    with solving():
        solution = solve_set(of)
    if as_json:
        from qsbearing.io.set_record import set_record

        print_text(json.dumps(set_record(solution), indent=1, allow_nan=False) + "\n")
    else:
        from qsbearing.io.set_report import set_result

        print_table(set_result(solution))
    if not solution.converged:
        for target in targets.values():
            note(f"{target} is not written: there is no solution to write")
        sys.exit(UNSOLVED)
    if "--csv" in targets:
        from qsbearing.io.csv_table import csv_text
        from qsbearing.io.set_record import set_columns

        text = csv_text({name: values.tolist() for name, values in set_columns(solution).items()})
        try:
            write["--csv"](text.encode("utf-8"))
        except OSError as error:  # a disk that filled up meanwhile
            refuse(f"cannot write: {error}")
