"""A file of a set becomes a BearingSet: a scene file with [[rows]], one table for each row on the shaft."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from dataclasses import replace
from math import nan
from typing import Any, NamedTuple

from qsbearing.files.ball_lists import listed_in, said_of
from qsbearing.files.bearing_table import NO_BEARING, ReadBearing, read_bearing
from qsbearing.files.effects_table import ReadEffects, read_effects, read_tables, ring_effects
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, translate
from qsbearing.files.file_keys import OTHER_TABLES, REQUIRE
from qsbearing.files.keys import SECTIONS, SET_TABLES
from qsbearing.files.preload_class import preload_table
from qsbearing.files.readings_table import ReadReadings, errors_in_scene, read_readings
from qsbearing.files.row_bearing import whole_bearing
from qsbearing.files.scene_file import (
    document_of,
    heated,
    operation_of,
    preload_of,
    read_required,
    wrong_in_other_tables,
)
from qsbearing.files.set_keys import GRAVITY, OTHERS
from qsbearing.files.shaft_tables import housing_stiffness, surroundings
from qsbearing.files.spectrum_table import over_spectrum
from qsbearing.files.stated import Stated, stated_in
from qsbearing.files.table_checks import (
    UNUSABLE,
    Errors,
    as_it_is,
    as_word,
    did_you_mean,
    judged,
    read_fields,
    unknown_key,
)
from qsbearing.model.bearing import BallBearing, BearingKind
from qsbearing.model.described import choices_of
from qsbearing.model.validation import ErrorDetail, SceneError, Sentence, alike, question
from qsbearing.systems.sets.bearing_set import BearingSet
from qsbearing.systems.sets.row import Direction, Row, placement_errors

TABLES = (*SECTIONS, *SET_TABLES)
LISTED = ("rows", "spacers", "floating")
"""Those that are lists of tables."""
_WORDS: dict[str, Any] = {name: as_it_is if kind is bool else as_word for name, kind in choices_of(Row).items()}
OF_OTHERS = tuple(name for name in OTHERS["rows"] if name not in _WORDS)
"""Tables within a row, which are judged as those of a scene are."""


def load_set(source: str | os.PathLike[str]) -> BearingSet:
    """The set of a TOML file.

    Of a bearing that is given by its data sheet or number the ball set that fits best is taken, with a UserWarning.

    Returns:
        The set.

    Raises:
        SceneFileError: everything that is wrong with the file, at once.

    Examples:
        >>> from pathlib import Path
        >>> file = Path("pair.toml")
        >>> lines = file.write_text('''bearing = { name = "7210C" }
        ... rows = [ { position_mm = 0, carries = "+x" }, { position_mm = 20, carries = "-x" } ]
        ... operation = { speed_rpm = 0 }
        ... preload = { rigid_N = 720 }''')
        >>> print(len(qs.load_set(file).rows))
        2
    """
    document, file, label = document_of(source)
    of = set_of(document, file, label)
    for each in said_of(listed_in(document)):
        warnings.warn(each, stacklevel=2)
    return of


def set_of(document: dict[str, Any], file: str, label: str = "") -> BearingSet:
    """The set of a parsed file.

    Args:
        file: what to call the file in errors.
        label: the set's name.

    Raises:
        SceneFileError: everything that is wrong with it.
    """
    if "spectrum" in document:
        return over_spectrum(document, file, label, set_of)
    errors: Errors = []
    thermal, balance_keys = heated(document, errors)
    _find_unknown_tables(document, errors)
    common = read_bearing(document, "", errors) if "bearing" in document else NO_BEARING
    effects = read_effects(document, errors)
    asked, required = read_required(document, read_readings(document, errors), errors)
    shared = _Shared(document, common, stated_in(document, common, errors), effects, asked, balance_keys)
    read = _rows(document, shared, errors)
    rows = [each.row for each in read if each.row is not None]
    is_loaded = _is_loaded(document) or common.preload_class is not None
    operation = operation_of({"operation": {}} | document, errors, is_loaded=is_loaded)
    preload = preload_of(preload_table(document, common, (each.bearing for each in read), errors), None, errors)
    if effects.fields.pop("traction", None) is not None and effects.fields.get("raceway_control") != "friction":
        cause = "Leave it out; a bearing of the set alone is solved with friction"
        errors.append(FileErrorDetail("effects.traction", "moves no balls of a set", cause=cause))
    # Where every row has its own, nothing is lacking that no bearing of all states.
    if "bearing" not in document and all(each.has_effects for each in read):
        effects = effects._replace(tables={})
    ring_effects = effects.made(errors, balance_keys, shared.stated)
    if "bearing" not in document and all(each.has_readings for each in read):
        asked = ReadReadings({})
    readings = asked.made(errors, balance_keys, shared.stated)
    around = surroundings(document, errors)
    if thermal is not None:
        errors += map(translate, thermal.errors([readings if row.readings is None else row.readings for row in rows]))
    if errors or operation is None:
        raise SceneFileError(file, errors)
    try:
        given: dict[str, Any] = {"readings": readings, "thermal": thermal, "name": label, **around, "require": required}
        of = BearingSet(tuple(rows), operation, preload, ring_effects=ring_effects, **effects.fields, **given)
    except SceneError as error:
        raise SceneFileError(file, map(_translated, error.errors)) from None
    wrong = _errors_of_readings(of, balance_keys)
    if required:
        from qsbearing.files.require_table import name_errors

        wrong += name_errors(of)
    if wrong:
        raise SceneFileError(file, wrong)
    return of


def _is_loaded(document: dict[str, Any]) -> bool:
    """Whether anything but [operation] and [preload] loads rows: the shaft's loads or weight, springs, or lengths."""
    shaft = document.get("shaft")
    rows = document.get("rows")
    of_shaft = isinstance(shaft, dict) and not shaft.keys().isdisjoint(("loads", "gears", "belts", GRAVITY.name))
    of_rows = isinstance(rows, list) and any("offset_um" in row for row in rows if isinstance(row, dict))
    groups = document.get("floating")
    of_groups = isinstance(groups, list) and any(key != "rows" for group in groups for key in group)
    return of_shaft or of_rows or of_groups or "spacers" in document


def _translated(error: ErrorDetail) -> FileErrorDetail:
    if error.field == "reference_position":
        error = replace(error, field="shaft.reference_position")
    return translate(error)


def _find_unknown_tables(document: dict[str, Any], errors: Errors) -> None:
    errors += wrong_in_other_tables(document)
    for name, value in list(document.items()):
        if name in (*TABLES, "tolerance", REQUIRE, *OTHER_TABLES):
            continue
        if isinstance(value, dict | list):
            known = f"A set has [[rows]], {', '.join(f'[{table}]' for table in TABLES if table != 'rows')}"
            meant = [f"[[{each}]]" if each in LISTED else f"[{each}]" for each in alike(name, (*TABLES, REQUIRE))]
            cause = question(meant) or known
            errors.append(FileErrorDetail(f"[{name}]", "unknown table", cause=cause))
        else:
            unknown_key(name, name, "", value, errors)


class _Shared(NamedTuple):
    """What the tables beside the rows state."""

    document: dict[str, Any]
    bearing: ReadBearing
    stated: Stated
    effects: ReadEffects
    asked: ReadReadings
    balance_keys: frozenset[str]


class _ReadRow(NamedTuple):
    row: Row | None = None
    """None where errors were found."""
    bearing: ReadBearing = NO_BEARING
    """Its own."""
    has_effects: bool = False
    """Of its own, or those of all, with the numbers of its own bearing; likewise readings."""
    has_readings: bool = False


def _rows(document: dict[str, Any], shared: _Shared, errors: Errors) -> list[_ReadRow]:
    tables = document.get("rows")
    if not isinstance(tables, list) or not tables:
        cause = 'Write [[rows]] for each row, with position_mm = 0 and carries = "+x" below it'
        errors.append(
            FileErrorDetail("[[rows]]", "missing" if tables is None else "is not a list of tables", cause=cause)
        )
        return []
    rows = []
    for number, table in enumerate(tables, 1):
        own: Errors = []
        rows.append(_row(table, f"row {number}", shared, own))
        errors += own
    return rows


def _row(table: Any, path: str, shared: _Shared, errors: Errors) -> _ReadRow:
    plain = {key: value for key, value in table.items() if key not in OF_OTHERS} if isinstance(table, dict) else table
    read = read_fields(Row, "rows", path, plain, errors, _WORDS)
    fields = {"position": nan, "offset": 0.0} | read
    if not isinstance(table, dict):
        return _ReadRow()
    if "position" not in read:
        cause = "Give the position of the balls' centres along the shaft; it sets the distances between rows"
        errors.append(FileErrorDetail(f"{path}.position_mm", "missing", cause=cause))
    carries, sprung = fields.pop("carries", None), fields.pop("sprung", False)
    errors += map(translate, judged(placement_errors(path, **fields)))
    if not isinstance(sprung, bool) and sprung is not UNUSABLE:
        errors.append(FileErrorDetail(f"{path}.sprung", "is neither true nor false", sprung))
    within: Errors = []
    if "housing_stiffness" in table:
        fields["housing_stiffness"] = housing_stiffness(table["housing_stiffness"], "housing_stiffness", within)
    effects = read_tables(table, within)
    asked = read_readings(table, within).implying(shared.asked.required) if "readings" in table else None
    bearing, stated = shared.bearing.bearing, shared.stated
    own = NO_BEARING
    if "bearing" in table:
        whole = whole_bearing(table, shared.document.get("bearing"))
        own = read_bearing({"bearing": whole}, "", within, is_of_row=True)
        bearing, stated = own.bearing, stated._replace(bearing=own)
        if not effects and shared.effects.deviations is None and stated.takes(shared.effects.tables.values()):
            effects = shared.effects.tables
        if asked is None and stated.takes(shared.asked.tables.values()):
            asked = shared.asked
    elif shared.document.get("bearing") is None:
        cause = "Give [bearing], which all rows share, or a table [rows.bearing] below each [[rows]]"
        within.append(FileErrorDetail("bearing", "missing", cause=cause))
    if carries is not UNUSABLE and not (carries is None and is_deep_groove(bearing, table.get("bearing"))):
        errors += _direction_errors(carries, path)
    made_effects = ring_effects(effects.values(), within, shared.balance_keys, stated)
    readings = None if asked is None else asked.made(within, shared.balance_keys, stated)
    errors += _below(path, within)
    if isinstance(table.get("bearing"), dict) and "name" not in table["bearing"]:
        own = own._replace(
            name="", entry=None
        )  # what the catalogue prints of a bearing is not of one with other numbers
    without = _ReadRow(None, own, bool(effects), asked is not None)
    if errors or bearing is None:
        return without
    row = Row(
        bearing, **fields, carries=None if carries is None else Direction(carries), sprung=sprung,
        ring_effects=made_effects or None, readings=readings,
    )  # fmt: skip
    return without._replace(row=row)


def is_deep_groove(bearing: BallBearing | None, table: Any) -> bool:
    """Whether a row may leave out its direction; of a bearing with errors, whether its own table says its kind."""
    if bearing is not None:
        return bearing.kind is BearingKind.DEEP_GROOVE
    return isinstance(table, dict) and table.get("kind") == BearingKind.DEEP_GROOVE


def _direction_errors(carries: Any, path: str) -> Errors:
    if carries in tuple(Direction):
        return []
    cause = did_you_mean(carries, list(Direction)) or (
        'The axial load on the shaft that presses it: "+x" or "-x"; of a deep-groove row also "both" or "none"'
    )
    problem = "missing" if carries is None else "is none of the choices"
    return [FileErrorDetail(f"{path}.carries", problem, carries, cause=cause)]


def _below(path: str, errors: Iterable[FileErrorDetail]) -> Errors:
    """Errors of a table within a row."""
    return [
        replace(
            each,
            key=f"{path}.{each.key.removeprefix('effects.')}",
            cause=each.cause.written(lambda table: f"rows.{table}") if isinstance(each.cause, Sentence) else each.cause,
        )
        for each in errors
    ]


def _errors_of_readings(of: BearingSet, heat: frozenset[str]) -> Errors:
    """What is wrong with readings that only the whole row shows; what all rows have alike is said once."""
    by_row = [errors_in_scene(of.turning_scene(number), heat) for number in range(len(of.rows))]
    if all(each == by_row[0] for each in by_row):
        return by_row[0]
    return [error for number, errors in enumerate(by_row, 1) for error in _below(f"row {number}", errors)]
