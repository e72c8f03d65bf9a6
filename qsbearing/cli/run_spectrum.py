"""What `qsbearing run` does with a load spectrum."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from qsbearing.cli.output import print_result, print_table, write_files

if TYPE_CHECKING:
    from qsbearing.io.output_file import Writer
    from qsbearing.scene.scene import Scene
    from qsbearing.solution.solution import Solution


def show_spectrum(
    solution: Solution, asked: Scene, as_json: bool, targets: Mapping[str, str], write: Mapping[str, Writer]
) -> None:
    """Show a solved spectrum and write its balls; ends with the exit code where some point is not solved."""
    from qsbearing.io.csv_table import csv_bytes
    from qsbearing.io.readings_record import all_columns, taken
    from qsbearing.io.spectrum_report import spectrum_record, spectrum_result

    readings = taken(solution)
    if as_json:
        print_result(asked, spectrum_record(solution, readings))
    else:
        print_table(spectrum_result(solution, readings))
    make = {"--csv": lambda: csv_bytes(all_columns(solution, readings))}
    write_files(targets, write, make, "" if solution.converged.all() else "not all points are solved")
