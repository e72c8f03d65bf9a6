"""A scene file becomes a Scene: its tables checked, every error of all of them reported at once."""

from __future__ import annotations

import os
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

from qsbearing.files import catalogue, result_file
from qsbearing.files.bearing_table import read_bearing
from qsbearing.files.effects_table import read_effects
from qsbearing.files.file_errors import FileErrorDetail, SceneFileError, refused, translate
from qsbearing.files.file_keys import BALL_TABLES, ORIGIN, OTHER_TABLES, REPORT, REQUIRE, reading_tables
from qsbearing.files.keys import (
    EFFECT_SECTIONS,
    MAKES_SET,
    SECTIONS,
)
from qsbearing.files.limits import LARGEST_FILE
from qsbearing.files.preload_class import preload_table
from qsbearing.files.raw import STANDARD_INPUT, read_text
from qsbearing.files.readings_table import ReadReadings, errors_in_scene, read_readings
from qsbearing.files.sheet_by_name import nearest
from qsbearing.files.spectrum_table import over_spectrum, points_of_table
from qsbearing.files.stated import stated_in
from qsbearing.files.table_checks import (
    Errors,
    as_it_is,
    as_word,
    checked,
    choice_fields,
    made,
    read_fields,
    table_model,
    unknown_key,
)
from qsbearing.files.toml import read_toml
from qsbearing.model.operation import CHANNELS, Operation
from qsbearing.model.scene.preload import Preload, axial_channel_errors
from qsbearing.model.scene.requirement import Requirement
from qsbearing.model.scene.scene import Scene
from qsbearing.model.validation import SceneError, alike, printable, question

if TYPE_CHECKING:
    from qsbearing.systems.heat.network import Thermal

ONE_OF_LIST = "Choose one of those that the data sheet allows: ball_set = 1 in [bearing], or its own numbers"
STUDY_TABLES = ("vary", "study")
"""What a study file has in addition to the tables of a scene."""
_REPORT = table_model(REPORT, (), dict.fromkeys(OTHER_TABLES[REPORT], as_word) | choice_fields(BALL_TABLES))
_ORIGIN = table_model(ORIGIN, (), dict.fromkeys(OTHER_TABLES[ORIGIN], as_it_is))


def load_scene(source: str | os.PathLike[str]) -> Scene:
    """The scene of a TOML file, or a built-in example by its name.

    Args:
        source: a path, or the name of a catalogue entry, such as "b218". A file with this name has precedence; "-" is
            standard input. From a result of `qsbearing run --json` (.json) or `qsbearing sweep` (.nc), the input that
            it holds is read. A bearing given by its data sheet is a case for each set that it allows.

    Returns:
        The scene.

    Raises:
        SceneFileError: everything that is wrong with the file, at once.

    Examples:
        >>> scene = qs.load_scene("b218")
        >>> print(scene.bearing.ball_count, scene.operation.axial_load)
        16.0 17800.0
    """
    return scene_of(*document_of(source), may_infer=True)


def document_of(
    source: str | os.PathLike[str], of_study: bool = False, allowed: Callable[[Path], Path] = Path
) -> tuple[dict[str, Any], str, str]:
    """The tables of a file or of a built-in example, what to call it in errors, and the label of its bearing.

    Of a result these are the tables that it was made from.

    Args:
        of_study: of a sweep's result, with the tables of the study.
        allowed: the place of a file that may be read, and of one that it names; raises for others.

    Raises:
        SceneFileError: it cannot be read.
    """
    path = Path(source)
    if source in STANDARD_INPUT and allowed is Path:
        return _with_points(read_toml(path), Path(), allowed), "standard input", ""
    if isinstance(source, str) and path.suffix == "" and source in (path.name, "") and not is_file(path):
        entry = catalogue.named(source)
        if entry is None:
            cause = f"{nearest(source)} A scene of your own is a file, such as {source or 'my'}.toml"
            error = FileErrorDetail("", "neither a file nor a bearing of the catalogue", cause=cause)
            raise SceneFileError(repr(source), [error])
        return {"bearing": {"name": entry.name}, **deepcopy(entry.example)}, entry.name, ""
    path = allowed(path)
    if path.suffix.lower() in result_file.ENDINGS:
        document, label = result_file.input_of(path, of_study)
        return document, str(source), label
    if not is_there(path) and catalogue.find(path.stem) is not None:
        raise refused(path, "no such file", f"The catalogue's {path.stem} is run by name, without {path.suffix}")
    return _with_points(read_toml(path), path.parent, allowed), str(source), printable(path.stem)


def _with_points(document: dict[str, Any], folder: Path, allowed: Callable[[Path], Path]) -> dict[str, Any]:
    """The tables of a file, the points of a spectrum read from the file that it names."""
    table = document.get("spectrum")
    return document | {"spectrum": points_of_table(table, folder, allowed)} if isinstance(table, dict) else document


def text_of(source: str) -> str:
    """The text of a scene file that was read; empty for an example of the catalogue and for a result.

    Raises:
        SceneFileError: it cannot be read any more.
    """
    path = Path(source)
    return read_text(path, LARGEST_FILE) if is_file(path) and path.suffix.lower() not in result_file.ENDINGS else ""


def scene_of(document: dict[str, Any], file: str, label: str = "", may_infer: bool = False) -> Scene:
    """The scene of a parsed file.

    Args:
        file: what to call the file in errors.
        label: name of the bearing where the catalogue gives none.
        may_infer: whether a bearing may be given by its data sheet, whose ball sets are then the scene's cases.

    Raises:
        SceneFileError: everything that is wrong with it.
    """
    if "spectrum" in document:
        return over_spectrum(document, file, label, scene_of)
    of_set = [name for name in MAKES_SET if name in document]
    if of_set:
        cause = "A set of rows on one shaft is read by `qs.load_set` and most commands, such as `qsbearing run`"
        raise SceneFileError(
            file, [FileErrorDetail(of_set[0], "makes a set; here a single bearing is read", cause=cause)]
        )
    errors: Errors = []
    thermal, balance_keys = heated(document, errors)
    _find_unknown_tables(document, errors)
    read = read_bearing(document, label, errors, may_infer)
    bearing, stated = read.bearing, stated_in(document, read, errors)
    operation = operation_of(document, errors, is_loaded=read.preload_class is not None)
    preload = preload_of(preload_table(document, read, (), errors), operation, errors)
    effects = read_effects(document, errors)
    ring_effects = effects.made(errors, balance_keys, stated)
    asked, required = read_required(document, read_readings(document, errors), errors)
    readings = asked.made(errors, balance_keys, stated)
    if required and bearing is not None and bearing.inferred is not None:
        errors.append(FileErrorDetail(f"[{REQUIRE}]", "is not answered for a list of bearings", cause=ONE_OF_LIST))
    if thermal is not None:
        errors += map(translate, thermal.errors([readings]))
    if errors or bearing is None or operation is None:
        raise SceneFileError(file, errors)
    try:
        given: dict[str, Any] = {"readings": readings, "thermal": thermal, "require": required, **effects.fields}
        scene = Scene(bearing, operation, preload=preload, ring_effects=ring_effects, **given)
    except SceneError as error:
        raise SceneFileError(file, map(translate, error.errors)) from None
    wrong = errors_in_scene(scene, balance_keys)
    if required and thermal is not None:  # of others the tables tell
        from qsbearing.files.require_table import name_errors

        wrong += name_errors(scene)
    if wrong:
        raise SceneFileError(file, wrong)
    return scene


def read_required(
    document: dict[str, Any], asked: ReadReadings, errors: Errors
) -> tuple[ReadReadings, tuple[Requirement, ...]]:
    """What the tables of a scene or set require of results; they ask for the readings that this takes as well."""
    if document.get(REQUIRE) is None:
        return asked, ()
    from qsbearing.files import require_table  # loaded only where something is required

    required = require_table.required_in(document, errors)
    return asked.implying(require_table.readings_of(document, required)), required


def heated(document: dict[str, Any], errors: Errors) -> tuple[Thermal | None, frozenset[str]]:
    """What tables say of the heat, and the keys of temperatures that its balance will find."""
    if "thermal" not in document:
        return None, frozenset()
    from qsbearing.files.thermal_table import found_temperatures, thermal_of  # loaded only where there is heat

    balance_keys = found_temperatures(document, errors)
    return thermal_of(document, errors), balance_keys


def is_file(path: Path) -> bool:
    """Whether this is a file; no name is an error."""
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name too long, or with a null character
        return False


def is_there(path: Path) -> bool:
    """Whether there is anything of this name; no name is an error."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


# Structure: known tables and keys, values of the right kind -----------------------------------------------------------


def _find_unknown_tables(document: dict[str, Any], errors: Errors) -> None:
    errors += wrong_in_other_tables(document)
    for name, value in list(document.items()):
        if name in (*SECTIONS, "tolerance", REQUIRE, *OTHER_TABLES) or (name == "housing" and value is not None):
            continue
        if isinstance(value, dict):
            meant = alike(name, (*SECTIONS, REQUIRE))
            if name in EFFECT_SECTIONS:
                meant = [f"effects.{name}"]
            if name in reading_tables():
                meant = [f"readings.{name}"]
            cause = question(meant, "[{}]") or "A scene has [bearing], [operation], [effects] and [readings]"
            if name in STUDY_TABLES:
                meant, cause = [], "Of a study, which `qsbearing sweep` solves"
            errors.append(FileErrorDetail(f"[{name}]", "unknown table", cause=cause))
            for each in meant:
                document.setdefault(each, None)  # one mistake: the table that is meant is not missing as well
        else:
            unknown_key(name, name, "", value, errors)


def wrong_in_other_tables(document: dict[str, Any]) -> Errors:
    """What is wrong with the table for reports and that of an imported model's file; also what the latter leaves open
    and no other table shows, so that nobody solves it without."""
    errors: Errors = []
    if document.get(REPORT) is not None:
        checked(_REPORT, REPORT, document[REPORT], errors)
    good, _ = checked(_ORIGIN, ORIGIN, document[ORIGIN], errors) if document.get(ORIGIN) is not None else ({}, set())
    listed = good.get("missing") or ()
    cause = f"Once it is given, take it out of missing in [{ORIGIN}]"
    for each in listed if isinstance(listed, list) else [listed] if listed else ():
        errors.append(FileErrorDetail(f"{ORIGIN}.missing", str(each), cause=cause))
    return errors


def operation_of(document: dict[str, Any], errors: Errors, *, is_loaded: bool = False) -> Operation | None:
    """The operation of a file's table [operation]; likewise.

    Args:
        is_loaded: other tables have loads, so that this one need not.
    """
    if "operation" not in document:
        needed = "At the least one load or displacement, such as axial_load_N = 1000; speed_rpm if it turns"
        errors.append(FileErrorDetail("[operation]", "missing", cause=needed))
    table = document.get("operation")
    if table is None:
        return None
    # A number that cannot be used still says that its channel is given: NaN stands for it.
    fields = read_fields(Operation, "operation", "operation", table, errors)
    if (
        isinstance(table, dict)
        and not is_loaded
        and "preload" not in document
        and not any(channel.load in fields or channel.displacement in fields for channel in CHANNELS)
    ):
        cause = "Write axial_load_N = 0 if that is meant, or a load or displacement, such as axial_load_N = 1000"
        errors.append(FileErrorDetail("operation", "no load is given", cause=cause))
    return made(lambda: Operation(**fields), errors)


def preload_of(table: Any, operation: Operation | None, errors: Errors) -> Preload | None:
    """The preload of a table [preload], where there is one; checked together with an operation that is given."""
    if table is None:
        return None
    fields = read_fields(Preload, "preload", "preload", table, errors)
    if operation is not None:
        errors += map(translate, axial_channel_errors(operation))
    if not isinstance(table, dict):
        return None
    return made(lambda: Preload(**fields), errors)
