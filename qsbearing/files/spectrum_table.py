"""Operating points with shares of time in a scene file, [[spectrum]]: one scene with a case for each point."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.table_checks import Errors, checked, table_model
from qsbearing.model.operation import Operation
from qsbearing.model.scene.keys import OPERATION, SPECTRUM, SPECTRUM_POINT
from qsbearing.model.scene.scene import Scene

if TYPE_CHECKING:
    from qsbearing.systems.sets.bearing_set import BearingSet

_POINT = table_model("spectrum", SPECTRUM)
SceneOrSet = TypeVar("SceneOrSet", bound="Scene | BearingSet")


def over_spectrum(
    document: dict[str, Any], file: str, label: str, made_of: Callable[[dict[str, Any], str, str], SceneOrSet]
) -> SceneOrSet:
    """The scene or set of a parsed file with [[spectrum]]; its reading "spectrum" holds the shares.

    What all points share stands in [operation]; a point may replace any of it.

    Args:
        made_of: makes a scene or set of a file without a spectrum.

    Raises:
        SceneFileError: everything that is wrong with it.
    """
    errors: Errors = []
    rest = {key: value for key, value in document.items() if key != "spectrum"}
    points, shares = _points(document["spectrum"], errors)
    scenes = []
    for number, point in enumerate(points, 1):
        common = rest.get("operation", {})
        operation = common | point if isinstance(common, dict) else common
        try:
            scenes.append(made_of(rest | {"operation": operation}, file, label))
        except SceneFileError as error:
            found = [_of_point(each, number, point) for each in error.errors]  # type: ignore[arg-type]
            errors += [each for each in found if each not in errors]
    rows = rest.get("rows", ()) if isinstance(rest.get("rows"), list) else ()
    own = {f"row {number}.": row for number, row in enumerate(rows, 1) if isinstance(row, dict) and "readings" in row}
    for path, table in {"": rest, **own}.items():
        asked = table.get("readings") or {}
        if "life" not in asked and (path or len(own) < len(rows) or not rows):
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
    changes: dict[str, Any] = {"operation": Operation(**stacked), "readings": {**scenes[0].readings, **spectrum}}
    if not isinstance(scenes[0], Scene):
        changes["rows"] = tuple(
            row if row.readings is None else replace(row, readings={**row.readings, **spectrum})
            for row in scenes[0].rows
        )
    return replace(scenes[0], **changes)


def _points(tables: Any, errors: Errors) -> tuple[list[dict[str, Any]], list[float]]:
    """The points' own keys of [operation], and their shares."""
    if not isinstance(tables, list) or not tables:
        cause = "Write [[spectrum]] for each operating point, with share = 0.25 and its keys of [operation] below it"
        errors.append(FileErrorDetail("[[spectrum]]", "is not a list of tables", cause=cause))
        return [], []
    points, shares = [], []
    for number, table in enumerate(tables, 1):
        path = f"{SPECTRUM_POINT} {number}"
        good, unusable = checked(_POINT, path, table, errors)
        share = good.pop("share", None)
        if share is None:
            if "share" not in unusable:
                cause = "Its part of the time, 0 to 1; the shares of all points add up to 1"
                errors.append(FileErrorDetail(f"{path}.share", "missing", cause=cause))
        elif not 0.0 <= share <= 1.0:
            cause = f"In per cent? {share:.6g} % = {share / 100:.6g}" if 1.0 < share <= 100.0 else ""
            errors.append(FileErrorDetail(f"{path}.share", "is outside its range", share, "", (0.0, 1.0), cause))
        points.append(good)
        shares.append(np.nan if share is None else share)
    total = sum(shares)
    if np.isfinite(total) and abs(total - 1.0) > WHOLE and all(0.0 <= share <= 1.0 for share in shares):
        cause = "Parts of the time, which together are all of it"
        errors.append(
            FileErrorDetail("spectrum.share", f"adds up to {total:.6g} over all points, not to 1", cause=cause)
        )
    return points, shares


WHOLE = 1e-6
"""Shares must add up to one to this (chosen: they are written with a few digits)."""


def _of_point(error: FileErrorDetail, number: int, point: dict[str, Any]) -> FileErrorDetail:
    """An error of an operation as that of a point, where the point has the key or nothing has it."""
    table, _, key = error.key.partition(".")
    if table.strip("[]") != "operation" or (error.value is not None and key not in point):
        return error
    return replace(error, key=f"{SPECTRUM_POINT} {number}" + (f".{key}" if key else ""))


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
