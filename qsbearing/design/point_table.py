"""Operating points from a table: one row in, one row out, a status each."""

from __future__ import annotations

import os
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files import table as stored
from qsbearing.files.table import Columns
from qsbearing.io.csv_table import csv_bytes, inert
from qsbearing.io.file_errors import MOST_SHOWN, FileErrorDetail, SceneFileError
from qsbearing.scene.scene import Scene
from qsbearing.studies import keys
from qsbearing.studies.chunk import STATUSES, Plan, plan_of, solve_points
from qsbearing.studies.points import CHUNK, Points
from qsbearing.studies.results import Result
from qsbearing.studies.results import find as find_result
from qsbearing.studies.scenes import base_scene, scene_of_points
from qsbearing.studies.study import Study
from qsbearing.studies.variables import Axis
from qsbearing.threads import thread_count

LABELS = ("name", "label", "point", "remark")
"""Headings of columns that are copied: whatever tells the rows apart."""
CASE_ENDS = ("max", "min")
"""Of a result that each ball has, a row holds the largest and the smallest."""
OF_BALLS = ("load", "angle", "max_pressure", "required_friction", "film_parameter", "overrun_load", "edge_distance")
"""Results of each ball that a row holds, by the ends of their names."""


def read_table(path: str, decimal: str | None = None) -> Columns:
    """Columns of a .csv, .xlsx or .parquet file by their headings; an empty cell is None.

    Args:
        decimal: what stands before the decimals in a .csv file, "," or "."; None: as the file shows.

    Raises:
        SceneFileError: it cannot be read, or its decimals are ambiguous.
    """
    return stored.read_table(Path(path), LABELS, decimal)


def solve_table(
    source: str | os.PathLike[str] | dict[str, Any],
    table: dict[str, list[Any]],
    file: str = "points",
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, list[Any]]:
    """Solve a scene at each row of a table.

    Args:
        source: the scene or set.
        table: columns by heading: keys of the scene file, and `LABELS`, which are copied.
        file: what to call the table in errors.
        progress: called with the rows done and all of them.

    Returns:
        The columns of the table, then `status` (a row that describes no bearing is "impossible"), `reason`, and the
        results in the units of their names; NaN where a row has none.

    Raises:
        SceneFileError: a heading that is no key, or what is wrong with the scene whatever the row.
    """
    named = _keys(table, file)
    count = len(next(iter(table.values())))
    values, reasons = _numbers(table, named, count)
    good = np.flatnonzero([not reason for reason in reasons])
    study = Study.of(source, {key: _some(values[key][good]) for key in values})
    some = {key: column[good] for key, column in values.items()}
    plan = _plan(study, some, good.size)
    found = {result.column: np.full(count, np.nan) for result in plan.results}
    status = ["impossible"] * count
    for start in range(0, good.size, CHUNK):
        numbers = good[start : start + CHUNK]
        chunk = solve_points(plan, {key: column[numbers] for key, column in values.items()}, thread_count())
        for place, row in enumerate(numbers):
            status[row] = STATUSES[chunk.status[place]]
            reasons[row] = chunk.reasons[chunk.reason[place]]
        for result in plan.results:
            found[result.column][numbers] = chunk.results[result.name]
        if progress is not None:
            progress(int(numbers[-1]) + 1, count)
    given = table | {heading: _written(table[heading], values[key]) for heading, key in named.items()}
    results = {name: column.tolist() for name, column in found.items() if name not in table}
    return given | {"status": status, "reason": reasons} | results


def _written(cells: list[Any], numbers: NDArray) -> list[Any]:
    """Numbers as such, whole ones without a point; what is none stays as it was."""
    pairs = zip(cells, numbers.tolist(), strict=True)
    return [cell if value != value else int(value) if value == int(value) else value for cell, value in pairs]


def _keys(table: dict[str, list[Any]], file: str) -> dict[str, str]:
    """The study's key of each heading that is one."""
    errors: list[FileErrorDetail] = []
    named: dict[str, str] = {}
    for heading in table:
        key = keys.find(heading)
        if heading.lower() in LABELS:
            continue
        if key is None or key.name == keys.EACH_BALL:
            meant = keys.suggestion(heading)
            cause = f"{meant}{'' if meant.endswith('?') else '.'} Columns named {', '.join(LABELS)} are copied"
            errors.append(FileErrorDetail(f"column {heading}", "is not a numeric key of a scene", cause=cause))
        elif key.name in named.values():
            errors.append(FileErrorDetail(f"column {heading}", f"{key.name} has a column already"))
        else:
            named[heading] = key.name
    if not named and not errors:
        errors.append(FileErrorDetail("", "no column is a key of a scene, such as speed_rpm"))
    if errors:
        raise SceneFileError(file, errors[:MOST_SHOWN])
    return named


def _numbers(table: dict[str, list[Any]], named: dict[str, str], count: int) -> tuple[dict[str, NDArray], list[str]]:
    """Numbers of the columns, and of each row what is wrong with its cells; empty where nothing is."""
    values = {key: np.full(count, np.nan) for key in named.values()}
    wrong: list[list[str]] = [[] for _ in range(count)]
    for heading, key in named.items():
        for row, cell in enumerate(table[heading]):
            try:
                if isinstance(cell, bool):
                    raise ValueError
                values[key][row] = float(cell)
            except (TypeError, ValueError):
                pass
            if not np.isfinite(values[key][row]):
                wrong[row].append(f"{heading}: " + ("the cell is empty" if cell is None else "is not a finite number"))
    return values, ["; ".join(parts) for parts in wrong]


def _some(column: NDArray) -> list[float]:
    """A few values of a column, among which effects are chosen where the scene leaves them."""
    known = np.unique(column)
    return [float(known[i]) for i in dict.fromkeys((0, known.size // 2, known.size - 1))] if known.size else [0.0]


def _plan(study: Study, values: dict[str, NDArray], count: int) -> Plan:
    possible = scene_of_points(study, values, count).possible if count else np.zeros(0, bool)
    if not possible.any():
        return Plan(study, (), 1)
    first = int(np.argmax(possible))
    axes = tuple(Axis(key, (float(column[first]),)) for key, column in values.items())
    alone = study.replaced(variables=axes)
    scene = base_scene(alone)
    is_auto = isinstance(scene, Scene) and scene.tolerance is not None
    plan = plan_of(study, scene, Points(study if is_auto else alone))
    counts = values.get("ball_count")
    ball_axis = plan.ball_axis if counts is None else int(np.max(counts[possible]))
    return plan._replace(results=tuple(_kept(plan.results)), ball_axis=ball_axis)


def _kept(known: tuple[Result, ...]) -> list[Result]:
    """Results of the whole bearing, and the largest and smallest of what each ball has."""
    by_name = {each.name: each for each in known}
    kept: list[Result | None] = []
    for each in known:
        if not each.is_per_ball:
            kept.append(each)
        elif each.name.endswith(OF_BALLS):
            kept += [find_result(f"{each.name}_{end}", by_name) for end in CASE_ENDS]
    return [each for each in kept if each is not None]


def table_bytes(columns: dict[str, list[Any]], ending: str) -> bytes:
    """The columns as a file of this ending."""
    if ending == ".csv":
        return csv_bytes(columns)
    import pandas

    data = BytesIO()
    frame = pandas.DataFrame(columns)
    if ending == ".xlsx":
        frame.map(inert).to_excel(data, index=False)
    else:
        for heading in frame.columns:
            if heading.lower() not in (*LABELS, "status", "reason"):
                frame[heading] = pandas.to_numeric(frame[heading], errors="coerce")  # a column has one type
        frame.to_parquet(data, index=False)
    return data.getvalue()
