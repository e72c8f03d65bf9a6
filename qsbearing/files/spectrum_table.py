"""Operating points with shares of time in a scene file, [[spectrum]] or a table's rows: one scene with a case for each
point."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from qsbearing.files import paths
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, refused
from qsbearing.files.keys import OPERATION, SHARES, SPECTRUM, SPECTRUM_POINT
from qsbearing.files.table_checks import Errors, TableModel, as_number, checked, flattened, table_model
from qsbearing.model.operation import Operation
from qsbearing.model.scene.scene import Scene

if TYPE_CHECKING:
    from qsbearing.systems.sets.bearing_set import BearingSet

_POINT = table_model("spectrum", SPECTRUM)
LABELS = ("name", "label", "point", "remark")
"""Columns of a table that tell its rows apart."""
SceneOrSet = TypeVar("SceneOrSet", bound="Scene | BearingSet")


def over_spectrum(
    document: dict[str, Any], file: str, label: str, made_of: Callable[[dict[str, Any], str, str], SceneOrSet]
) -> SceneOrSet:
    """The scene or set of a parsed file with [[spectrum]]; its reading "spectrum" holds the shares.

    What all points share stands in the file's other tables; a point may replace any number of them, by its name in
    [operation] or by its path, that cases of one scene may differ in.

    Args:
        made_of: makes a scene or set of a file without a spectrum.

    Raises:
        SceneFileError: everything that is wrong with it.
    """
    errors: Errors = []
    rest = {key: value for key, value in document.items() if key != "spectrum"}
    points, shares = _points(document["spectrum"], rest, errors)
    scenes = []
    for number, point in enumerate(points, 1):
        try:
            scenes.append(made_of(at_point(rest, point), file, label))
        except SceneFileError as error:
            of_point = [_of_point(each, number, point) for each in error.errors]  # type: ignore[arg-type]
            errors += [each for each in of_point if each not in errors]
    elsewhere = {path for point in points for path in point if path[0] != "operation"}
    for number, point in enumerate(points, 1):
        lacking = [path for path in elsewhere - set(point) if paths.value_at(rest, path) is None]
        errors += [_missing(number, ".".join(path), "the file") for path in lacking]
    rows = rest.get("rows", ()) if isinstance(rest.get("rows"), list) else ()
    own = {f"row {number}.": row for number, row in enumerate(rows, 1) if isinstance(row, dict) and "readings" in row}
    for path, table in {"": rest, **own}.items():
        requested = table.get("readings") or {}
        if isinstance(requested, dict) and "life" not in requested and (path or len(own) < len(rows) or not rows):
            cause = "Write [readings.life] below the points, with or without keys: the spectrum adds up its damage"
            errors.append(FileErrorDetail(f"{path}readings.life", "missing", cause=cause))
    if not errors:
        _find_different_channels(scenes, errors)
    if errors:
        raise SceneFileError(file, errors)
    stacked = {
        each.name: _stacked([getattr(scene.operation, each.name) for scene in scenes]) for each in fields(Operation)
    }
    spectrum = {"spectrum": {"time_share": np.array(shares)}}
    whole = scenes[0]
    if elsewhere:
        every = {path: np.array([_number(rest, point, path) for point in points], float) for path in elsewhere}
        whole = made_of(at_point(rest, points[0] | every), file, label)
    changes: dict[str, Any] = {"operation": Operation(**stacked), "readings": {**whole.readings, **spectrum}}
    if not isinstance(whole, Scene):
        changes["rows"] = tuple(
            row if row.readings is None else replace(row, readings={**row.readings, **spectrum}) for row in whole.rows
        )
    return replace(whole, **changes)


Point = dict[paths.Path, Any]


def point_in_file(given: dict[str, Any]) -> Point:
    """The numbers of a point, keys of [operation] or paths, by their paths in the file; its time left out."""
    numbers = {key: value for key, value in given.items() if key not in TIMES}
    return {tuple(key.split(".")) if "." in key else ("operation", key): each for key, each in numbers.items()}


def at_point(rest: dict[str, Any], point: Point) -> dict[str, Any]:
    """The tables of a file with the numbers of a point; without its spectrum."""
    document = copy.deepcopy({key: value for key, value in rest.items() if key != "spectrum"})
    if isinstance(document.get("operation", {}), dict):
        for path, value in point.items():
            paths.put(document, path, value)
    return document


def _number(rest: dict[str, Any], point: Point, path: paths.Path) -> float:
    return float(point[path] if path in point else paths.value_at(rest, path))


def points_of_table(
    table: dict[str, Any], folder: Path, allowed: Callable[[Path], Path] = Path
) -> list[dict[str, Any]]:
    """The points of a table [spectrum] with a file, one for each of its rows.

    Args:
        folder: where the file's name counts from.
        allowed: the place of a file that may be read; raises for others.

    Raises:
        SceneFileError: it cannot be read.
    """
    from qsbearing.files.table import read_table  # rarely asked for

    name = table.get("file")
    if not isinstance(name, str) or len(table) > 1:
        cause = (
            'Write file = "duty.csv": a column share or hours, and one for each key of [operation] or path that varies'
        )
        raise refused("[spectrum]", "is neither a list of points nor the name of a file alone", cause)
    columns = {
        heading: cells
        for heading, cells in read_table(allowed(folder / name), LABELS).items()
        if heading.lower() not in LABELS
    }
    return [dict(zip(columns, map(_cell, row), strict=True)) for row in zip(*columns.values(), strict=True)]


def _cell(cell: Any) -> Any:
    try:
        return float(cell)
    except (TypeError, ValueError):
        return cell


def _points(tables: Any, rest: dict[str, Any], errors: Errors) -> tuple[list[Point], list[float]]:
    """The points' own numbers by their paths in the file, and their shares."""
    if not isinstance(tables, list) or not tables:
        cause = "Write [[spectrum]] for each operating point, with share = 0.25 and its keys of [operation] below it"
        errors.append(FileErrorDetail("[[spectrum]]", "is not a list of tables", cause=cause))
        return [], []
    points, shares = [], []
    times = [name for name in TIMES if any(isinstance(table, dict) and name in table for table in tables)]
    time = times[0] if times else "share"
    for number, table in enumerate(tables, 1):
        path = f"{SPECTRUM_POINT} {number}"
        own, model = _without_paths(path, flattened(table) if isinstance(table, dict) else table, rest, errors)
        good, unusable = checked(model, path, own, errors)
        share, *others = (good.pop(name, None) for name in (time, *(name for name in TIMES if name != time)))
        if any(other is not None for other in others):
            errors.append(
                FileErrorDetail(path, "has a share as well as hours", cause="Keep one of the two for all points")
            )
        if share is None:
            if time not in unusable:
                cause = (
                    "Its part of the time, 0 to 1; the shares of all points add up to 1. Or give hours of all points"
                )
                errors.append(FileErrorDetail(f"{path}.{time}", "missing", cause=cause))
        elif time == "share" and not SHARES[0] <= share <= SHARES[1]:
            cause = f"In per cent? {share:.6g} % = {share / 100:.6g}" if 1.0 < share <= 100.0 else ""
            errors.append(FileErrorDetail(f"{path}.share", "is outside its range", share, "", SHARES, cause))
        elif share < 0.0:
            errors.append(FileErrorDetail(f"{path}.hours", "is negative", share, "h"))
        points.append(point_in_file(good))
        shares.append(np.nan if share is None else share)
    total = sum(shares)
    if time == "hours":
        return points, [share / total if total > 0.0 else np.nan for share in shares]
    if np.isfinite(total) and abs(total - 1.0) > WHOLE and all(SHARES[0] <= share <= SHARES[1] for share in shares):
        cause = "Parts of the time, which together are all of it"
        errors.append(
            FileErrorDetail("spectrum.share", f"adds up to {total:.6g} over all points, not to 1", cause=cause)
        )
    return points, shares


TIMES = ("share", "hours")


def _without_paths(path: str, point: Any, rest: dict[str, Any], errors: Errors) -> tuple[Any, TableModel]:
    """A point without the paths that it cannot name, and how it is built with the others."""
    known = []
    for key in [key for key in point if "." in key] if isinstance(point, dict) else []:
        at = tuple(key.split("."))
        problem, meant = paths.missing_table(rest, at), ""
        if paths.key_at(at) is None or problem:
            problem, meant = problem or "unknown key", paths.told(paths.meant(key, rest))
        elif not paths.spans_cases(at, rest):
            problem, meant = "must be the same at all points", "`qsbearing sweep` varies it"
        if problem:
            errors.append(FileErrorDetail(f"{path}.{key}", problem, cause=meant))
            point = {name: value for name, value in point.items() if name != key}
        else:
            known.append(key)
    return point, _POINT._replace(checks={**_POINT.checks, **dict.fromkeys(known, as_number)}) if known else _POINT


WHOLE = 1e-6
"""Shares must add up to one to this (chosen: they are written with a few digits)."""


def _of_point(error: FileErrorDetail, number: int, point: Point) -> FileErrorDetail:
    """An error of an operation as that of a point, where the point has the key or nothing has it."""
    table, _, key = error.key.partition(".")
    if table.strip("[]") != "operation" or (error.value is not None and ("operation", key) not in point):
        return error
    return replace(error, key=f"{SPECTRUM_POINT} {number}" + (f".{key}" if key else ""))


def _missing(number: int, key: str, common: str) -> FileErrorDetail:
    cause = f"Another point gives it: all must, or {common} for all"
    return FileErrorDetail(f"{SPECTRUM_POINT} {number}.{key}", "missing", cause=cause)


def _find_different_channels(scenes: Sequence[Scene | BearingSet], errors: Errors) -> None:
    """Every point must give the same loads and displacements."""
    for key in OPERATION:
        given = [getattr(scene.operation, key.field) is not None for scene in scenes]
        if any(given) and not all(given):
            number = given.index(False) + 1
            cause = f"Point {given.index(True) + 1} gives it: all must, or [operation] for all"
            errors.append(FileErrorDetail(f"{SPECTRUM_POINT} {number}.{key.name}", "missing", cause=cause))


def _stacked(values: list[Any]) -> Any:
    """One number for each point; None where none has one."""
    return None if values[0] is None else np.array(values, float)
