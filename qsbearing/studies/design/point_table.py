"""Operating points from a table: one row in, one row out, a status each."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files import table as stored
from qsbearing.files.csv_table import csv_bytes, xlsx_bytes
from qsbearing.files.file_errors import MOST_SHOWN, FileErrorDetail, SceneFileError
from qsbearing.files.table import Columns
from qsbearing.model.compiler.threads import thread_count
from qsbearing.model.solution.result_keys import Place
from qsbearing.studies import keys
from qsbearing.studies.chunk import STATUSES, Plan, plan_of, solve_points
from qsbearing.studies.points import CHUNK, Points
from qsbearing.studies.remarked import Look, may_solve
from qsbearing.studies.scenes import base_scene, check_base, scenes_of_points
from qsbearing.studies.study import Source, Study, read
from qsbearing.studies.variables import Axis

LABELS = ("name", "label", "point", "remark")
"""Headings of columns that are copied: whatever tells the rows apart."""
OF_BALLS = ("load", "angle", "max_pressure", "required_friction", "film_parameter", "overrun_load", "edge_distance")
"""Results of each ball that a row holds."""


def read_table(path: str, decimal: str | None = None) -> Columns:
    """Columns of a .csv, .xlsx or .parquet file by their headings; an empty cell is None.

    Args:
        decimal: what stands before the decimals in a .csv file, "," or "."; None: as the file shows.

    Raises:
        SceneFileError: it cannot be read, or its decimals are ambiguous.
    """
    return stored.read_table(Path(path), LABELS, decimal)


def solve_table(
    source: Source,
    table: dict[str, list[Any]],
    file: str = "points",
    progress: Callable[[int, int], object] | None = None,
    keep: Callable[[Columns], object] | None = None,
    looks: list[Look] | None = None,
) -> Columns:
    """Solve a scene at each row of a table.

    Args:
        source: the scene or set.
        table: columns by heading: keys of the scene file, and `LABELS`, which are copied.
        file: what to call the table in errors.
        progress: called with the rows done and all of them.
        keep: called with the columns of some rows, as they are returned, as soon as these are solved.
        looks: where to add what is seen of remarks; None: none are looked for.

    Returns:
        The columns of the table, then `status` (a row that describes no bearing is "impossible"), `reason`, and the
        results in the units of their names; NaN where a row has none.

    Raises:
        SceneFileError: a heading that is no key, or what is wrong with the scene whatever the row.
    """
    source = read(source)
    named = _keys(table, file, source.document)
    count = len(next(iter(table.values())))
    values, reasons = _numbers(table, named, count)
    good = np.flatnonzero([not reason for reason in reasons])
    study = Study.of(source, {key: _some(values[key][good]) for key in values})
    some = {key: column[good] for key, column in values.items()}
    check_base(study)
    plan = _plan(study, some, good.size)
    given = table | {heading: _written(table[heading], values[key]) for heading, key in named.items()}
    whole: Columns = {}
    for start in range(0, count, CHUNK):
        rows = slice(start, min(start + CHUNK, count))
        numbers = good[(good >= rows.start) & (good < rows.stop)]
        columns = {result.column: np.full(rows.stop - rows.start, np.nan) for result in plan.results}
        status = ["impossible"] * (rows.stop - rows.start)
        if numbers.size:
            solves = None if looks is None else may_solve(count)
            given_here = {key: column[numbers] for key, column in values.items()}
            chunk = solve_points(plan, given_here, thread_count(), solves)
            if looks is not None:
                looks.append(chunk.remarks)
            for place, row in enumerate(numbers):
                status[row - start] = STATUSES[chunk.status[place]]
                reasons[row] = chunk.reasons[chunk.reason[place]]
            for result in plan.results:
                columns[result.column][numbers - start] = chunk.results[result.name]
        results = {name: column.tolist() for name, column in columns.items() if name not in table}
        part = {name: cells[rows] for name, cells in given.items()}
        part |= {"status": status, "reason": reasons[rows]} | results
        if keep is not None:
            keep(part)
        for name, cells in part.items():
            whole.setdefault(name, []).extend(cells)
        if progress is not None:
            progress(rows.stop, count)
    return whole


def _written(cells: list[Any], numbers: NDArray) -> list[Any]:
    """Numbers as such, whole ones without a point; what is none stays as it was."""
    pairs = zip(cells, numbers.tolist(), strict=True)
    return [cell if value != value else int(value) if value == int(value) else value for cell, value in pairs]


def _keys(table: dict[str, list[Any]], file: str, document: dict[str, Any]) -> dict[str, str]:
    """The study's key of each heading that is one."""
    errors: list[FileErrorDetail] = []
    named: dict[str, str] = {}
    for heading in table:
        key = keys.find(heading)
        if heading.lower() in LABELS:
            continue
        if key is None or key.name == keys.EACH_BALL or keys.problem(heading, document):
            problem, *meant = keys.problem(heading, document) or ("is drawn at random",)
            cause = ". ".join((f"Columns named {', '.join(LABELS)} are copied", *meant))
            errors.append(FileErrorDetail(f"column {heading}", problem, cause=cause))
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
            except (TypeError, ValueError, OverflowError):
                pass
            if not np.isfinite(values[key][row]):
                values[key][row] = np.nan
                wrong[row].append(f"{heading}: " + ("the cell is empty" if cell is None else "is not a finite number"))
    return values, ["; ".join(parts) for parts in wrong]


def _some(column: NDArray) -> list[float]:
    """A few values of a column, among which effects are chosen where the scene leaves them."""
    known = np.unique(column)
    return [float(known[i]) for i in dict.fromkeys((0, known.size // 2, known.size - 1))] if known.size else [0.0]


def _plan(study: Study, values: dict[str, NDArray], count: int) -> Plan:
    possible = scenes_of_points(study, values, count).possible if count else np.zeros(0, bool)
    if not possible.any():
        return Plan(study, (), 1)
    first = int(np.argmax(possible))
    axes = tuple(Axis(key, (float(column[first]),)) for key, column in values.items())
    alone = study.replaced(variables=axes)
    scene = base_scene(alone)
    plan = plan_of(study, scene, Points(alone if scene is None or scene.tolerance is None else study))
    counts = values.get("ball_count")
    ball_axis = plan.ball_axis if counts is None else int(np.max(counts[possible]))
    return plan._replace(results=tuple(_kept(plan.results)), ball_axis=ball_axis)


def _kept(known: tuple[Place, ...]) -> list[Place]:
    """Results of the whole bearing, and maximum, minimum and, where a sign is a direction, largest size of what each
    ball has."""
    kept: list[Place] = []
    for each in known:
        if not each.is_per_ball:
            kept.append(each)
        elif each.result.name in OF_BALLS:
            kept += each.overs
    return kept


def table_bytes(columns: Columns, ending: str) -> bytes:
    """The columns as a file of this ending; a cell that its format has no room for is a text, or empty."""
    if ending == ".csv":
        return csv_bytes(columns)
    return xlsx_bytes(columns) if ending == ".xlsx" else _parquet_bytes(columns)


def _parquet_bytes(columns: Columns) -> bytes:
    import pyarrow
    from pyarrow import parquet

    data = BytesIO()
    held = {
        name: _alike(cells) if name.lower() in (*LABELS, "status", "reason") else list(map(_number, cells))
        for name, cells in columns.items()
    }
    parquet.write_table(pyarrow.table(held), data)
    return data.getvalue()


def _alike(cells: list[Any]) -> list[Any]:
    """Labels of one kind: numbers among texts are texts too."""
    kinds = {type(cell) for cell in cells if cell is not None}
    return cells if len(kinds) <= 1 else [None if cell is None else str(cell) for cell in cells]


def _number(cell: Any) -> float | None:
    try:
        value = float(cell)
    except (TypeError, ValueError, OverflowError):
        return None
    return value if np.isfinite(value) else None
