"""Scenes, solutions, sets and studies in a notebook: the tables of reports, the pictures of commands."""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from typing import Any

import numpy as np

from qsbearing import pictures
from qsbearing.documents.html import part
from qsbearing.documents.model import Block, Columns, Paragraph, Table
from qsbearing.files.result_names import find
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.columns import scene_numbers
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import check_kind
from qsbearing.pictures.study import picture
from qsbearing.remarks.wording import PYTHON
from qsbearing.reports import inputs, set_inputs
from qsbearing.results import report, set_report
from qsbearing.results.readings_record import all_taken
from qsbearing.results.tables import digits_of
from qsbearing.studies.chunk import MAIN
from qsbearing.studies.results import known_results, read
from qsbearing.studies.study import Study
from qsbearing.studies.sweep import sweep
from qsbearing.studies.variables import Axis
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.set_solution import SetSolution

MOST = 20
"""Cases of a solution in one table."""
MAIN_OF_SET = 8
"""Results of a set there."""


def html_of(shown: Any) -> str | None:
    """The tables of a scene, set, solution or study as HTML, which notebooks show; None where there are none, or what
    makes them is not installed.

    Returns:
        HTML; None where there is none.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print("<table" in qs.html_of(solution))
        True
    """
    if importlib.util.find_spec("jinja2") is None:
        return None
    try:
        return part(_blocks(shown))
    except TypeError:  # numbers that span cases where a table has one
        return None


def _blocks(shown: Any) -> Sequence[Block]:
    match shown:
        case Scene():
            return [Paragraph(shown.bearing.name or "Ball bearing"), *_tables(inputs.section(shown, "").blocks)]
        case BearingSet():
            return [Paragraph(shown.name or "Set"), *_tables(set_inputs.section(shown, "").blocks)]
        case Study():
            return _study(shown)
        case Solution() | SetSolution() if shown.shape:
            return _cases(shown)
        case Solution():
            return [*report.result(shown, all_taken(shown), PYTHON), *report.pulse(shown)]
    return [*set_report.set_result(shown, all_taken(shown), PYTHON), *report.pulse(shown)]


def _tables(blocks: Sequence[Block]) -> list[Block]:
    """One below the other, those that a page has side by side too."""
    tables: list[Block] = []
    for each in blocks:
        if isinstance(each, Columns):
            tables += [table for column in each.columns for table in _tables(column)]
        elif isinstance(each, Table):
            tables.append(each)
    return tables


def _study(study: Study) -> list[Block]:
    rows = [
        (each.key, f"{len(each.values):,} from {each.values[0]:g} to {each.values[-1]:g}")
        if isinstance(each, Axis)
        else (each.key, f"{each.kind}({', '.join(f'{number:g}' for number in each.parameters)})")
        for each in study.variables
    ]
    count = int(np.prod([len(each.values) for each in study.axes], dtype=int)) * max(study.samples, 1)
    what = f"Study of {study.label or study.file}: {count:,} points. qs.sweep solves it, plot() draws it"
    return [Paragraph(what), Table(("key", "what it takes"), rows, "ll")]


def _cases(solution: Solution | SetSolution) -> list[Block]:
    """A row for each of the first cases: what varies, and the main results."""
    known = known_results(solution)
    names = MAIN if isinstance(solution, Solution) else list(known)[:MAIN_OF_SET]
    kept = [each for name in names if (each := find(name, known))]
    values = read(solution, kept)
    columns: dict[str, Any] = {f"{each.name}\n{each.unit}": values[each.name] for each in kept}
    if isinstance(solution, Solution):
        varied = {name: values for name, values in scene_numbers(solution.scene).items() if np.size(values) > 1}
        columns = {name: np.broadcast_to(values, solution.shape) for name, values in varied.items()} | columns
    cells = [[digits_of(value) for value in np.ravel(values)[:MOST]] for values in columns.values()]
    status = [str(each) for each in np.ravel(solution.status)[:MOST]]
    heads = [name.replace("_", " ") for name in columns]
    rows = [list(row) for row in zip(*cells, status, strict=True)]
    return [Paragraph(repr(solution)), Table([*heads, "status"], rows, "r" * len(heads) + "l")]


def plot(shown: Solution | SetSolution | Study, *chosen: Any, **named: Any) -> Any:
    """Draw it, as a figure of matplotlib; also a method of each.

    Of a solution: `plot(solution, name="overview", index=None)`, one of the pictures of `qsbearing.pictures` of one
    case. Of a study, which is solved for it: the arguments of `qsbearing.pictures.study.picture`, such as
    y=["inner_load"].

    Returns:
        A figure of matplotlib.

    Raises:
        ValueError: there is no such picture.
        TypeError: it is none of them.

    Examples:
        >>> solution = qs.solve(qs.load_scene("b218"))
        >>> print(len(qs.plot(solution).axes))
        2
    """
    check_kind("plot", shown, "Solution", "SetSolution", "Study")
    if isinstance(shown, Study):
        return picture(sweep(shown), *chosen, **named)
    return _drawn(shown, *chosen, **named)


def _drawn(solution: Solution | SetSolution, name: str = "overview", index: Any = None, **named: Any) -> Any:
    if name not in pictures.__all__:
        raise ValueError(f"{name!r} is not a picture; the pictures are {', '.join(pictures.__all__)}")
    return getattr(pictures, name)(solution, index, **named)
