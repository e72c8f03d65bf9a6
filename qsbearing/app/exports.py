"""What leaves the page beside the scene's own file: the design report, and the table of `run --csv`."""

from __future__ import annotations

from typing import Any

from qsbearing.app.answers import Answer, saved
from qsbearing.app.scenes import Tables, named, solution_of
from qsbearing.documents.html import html
from qsbearing.documents.installation import pip_install
from qsbearing.files.csv_table import csv_bytes
from qsbearing.files.file_errors import refused
from qsbearing.model.solution.solution import Solution
from qsbearing.remarks.of_solution import message
from qsbearing.results.readings_record import all_columns, all_taken
from qsbearing.results.set_record import set_columns

NEEDED = ("markdown_it", "pygments")
"""Of a report's page, beside what this page needs."""


def report(document: Tables, label: str) -> Answer:
    """The design report as one HTML page, of the file that the page saves."""
    from importlib.util import find_spec

    if lacks := [name for name in NEEDED if find_spec(name) is None]:
        raise refused("page", f"the report needs {', '.join(lacks)}", f"Install it: {pip_install('report')}")
    from qsbearing.reports.of_any import document_of_any

    solution = _solved(document, label)
    kept = saved(document, label)
    name = kept["file"].removesuffix(".toml")
    command = f"qsbearing report {kept['file']} --out DIR"
    made = document_of_any(solution, named(document, label), kept["text"], command)
    return {"file": f"{name}_report.html", "text": html(made)}


def table(document: Tables, label: str) -> Answer:
    """The table of every ball, as `run --csv` writes it."""
    solution = _solved(document, label)
    readings: Any = all_taken(solution)
    columns: Any = all_columns if isinstance(solution, Solution) else set_columns
    name = saved(document, label)["file"].removesuffix(".toml")
    return {"file": f"{name}.csv", "text": csv_bytes(columns(solution, readings)).decode()}


def _solved(document: Tables, label: str) -> Any:
    solution = solution_of(document, label)
    if not solution.converged:
        raise refused("page", "there is no solution to write", message(solution))
    return solution
