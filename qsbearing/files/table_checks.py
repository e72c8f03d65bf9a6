"""Tables of a scene file: values of the right kind under known keys, and materials, which stand in several tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from enum import StrEnum
from functools import cache
from math import isfinite, isnan, nan
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

import numpy as np

from qsbearing.files.file_errors import MOST_SHOWN, FileErrorDetail, translate
from qsbearing.files.file_keys import BALL_TABLES, ShownBalls, find
from qsbearing.files.keys import BALL_DEVIATIONS, MATERIALS, Key, key_of, named, required_of
from qsbearing.files.unknown_key import Suggestion, suggest
from qsbearing.files.usual_words import other_kind
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.model.bearing import BearingKind
from qsbearing.model.described import choices_of, lists_of, materials_of, numbers_of, parts_of
from qsbearing.model.effects import MomentShares
from qsbearing.model.effects.traction import TractionLaw
from qsbearing.model.material import BY_NAME, STAINLESS_STEEL, Material, material_named
from qsbearing.model.scene.scene import Scene
from qsbearing.model.solution.result_keys import printed_unit
from qsbearing.model.validation import ErrorDetail, Field, SceneError, Sentence, alike, comma_advice, question

CHOICES_OF_FILES: dict[str, Any] = {
    **choices_of(DataSheet), "moment_shares": MomentShares, "law": TractionLaw, BALL_TABLES: ShownBalls,
    **choices_of(Scene),
}  # fmt: skip
"""The keys of a file whose words are those of a choice."""
UNUSABLE: Any = object()
"""What stands where a file has a word, a table or a list that cannot be used."""
Errors = list[FileErrorDetail]
Made = TypeVar("Made")
Check = Callable[[Any, list[Any]], Any]
"""Gives the usable value; adds to the list what it refuses."""


class TableModel(NamedTuple):
    """How a table is built."""

    section: str
    checks: Mapping[str, Check]
    """Of its keys. A value of None is one that is not given."""


def as_number(value: Any, refused: list[Any]) -> Any:
    """A finite number: neither true nor "22.225" is one. A study puts an array, over its cases, in its place."""
    if isinstance(value, np.ndarray):
        return value
    try:
        if isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value):
            return float(value)
    except OverflowError:
        pass
    refused.append(value)
    return None


def as_whole_number(value: Any, refused: list[Any]) -> Any:
    """A number without a decimal point."""
    return value if type(value) is int else refused.append(value)


def as_word(value: Any, refused: list[Any]) -> Any:
    """Text in quotation marks."""
    return value if isinstance(value, str) else refused.append(value)


def as_it_is(value: Any, refused: list[Any]) -> Any:
    """What is looked at later."""
    return value


def list_of(check: Check) -> Check:
    """A list of such values, or an array of a study's."""

    def check_list(value: Any, refused: list[Any]) -> Any:
        if isinstance(value, np.ndarray):
            return value
        return [check(each, refused) for each in value] if isinstance(value, list) else refused.append(value)

    return check_list


def _one_of(choice: type[StrEnum]) -> Check:
    """A word that becomes the choice."""

    def check_choice(value: Any, refused: list[Any]) -> Any:
        try:
            return choice(value)
        except ValueError:
            return refused.append(value)

    check_choice.choice = choice  # type: ignore[attr-defined]
    return check_choice


def choice_fields(*names: str) -> dict[str, Check]:
    """The checks of choices."""
    return {name: _one_of(CHOICES_OF_FILES[name]) for name in names}


def table_model(section: str, keys: tuple[Key, ...], others: Mapping[str, Check] = MappingProxyType({})) -> TableModel:
    """How a table is built: numbers under its keys, and what else it has."""
    return TableModel(section, {key.name: as_number for key in keys} | dict(others))


class _Form(NamedTuple):
    """How the tables of a class are read."""

    numbers: dict[str, Key]
    lists: dict[str, Key]
    materials: tuple[str, ...]
    checks: dict[str, Check]


@cache  # a search reads a file's tables a thousand times
def _form(of: Any) -> _Form:
    numbers, lists = ({key.name: key for key in map(key_of, each(of))} for each in (numbers_of, lists_of))
    checks: dict[str, Check] = dict.fromkeys(numbers, as_number) | dict.fromkeys(lists, list_of(as_number))
    checks |= dict.fromkeys((*materials_of(of), *parts_of(of)), as_it_is)
    words = choices_of(of)
    checks |= {name: as_it_is if kind is bool else _one_of(kind) for name, kind in words.items()}
    return _Form(numbers, lists, materials_of(of), checks)


def read_fields(
    of: Any, section: str, path: str, table: Any, errors: Errors, others: Mapping[str, Check] = MappingProxyType({})
) -> dict[str, Any]:
    """What a table states of the fields of a class, in SI by the names that Python has; NaN and `UNUSABLE` stand where
    it tries to.

    Args:
        section: whose keys are likely meant by one that is unknown.
        others: what it may have that is no field, or is checked in another way; it stays as it is.
    """
    numbers, lists, materials, own = _form(of)
    checks = {**own, **others}
    good, unusable = checked(TableModel(section, checks), path, table, errors)
    stand_ins: dict[str, Any] = {
        name: nan if checks[name] is as_number else UNUSABLE for name in unusable if name in checks
    }
    fields: dict[str, Any] = {}
    for name, value in (stand_ins | good).items():
        if name in materials:
            fields[name] = material(f"{path}.{name}", value, errors)
        elif name in others or value is UNUSABLE:
            fields[lists[name].field if name in lists else name] = value
        elif name in numbers:
            fields[numbers[name].field] = numbers[name].si(value)
        elif name in lists:
            fields[lists[name].field] = [lists[name].si(each) for each in value]
        else:
            fields[name] = value
    return fields


def checked(model: TableModel, path: str, table: Any, errors: Errors) -> tuple[dict[str, Any], set[str]]:
    """The table's usable values; and the keys that have none although the file tries to give one."""
    if not isinstance(table, dict):
        cause = Sentence("Write it as [{table}], keys below it", table=Field(path))
        errors.append(FileErrorDetail(path, "is not a table", table, cause=cause))
        return {}, set()
    unusable: set[str] = set()
    good: dict[str, Any] = {}
    for name, check in model.checks.items():
        if table.get(name) is None:
            continue
        refused: list[Any] = []
        good[name] = check(table[name], refused)
        if refused:
            del good[name]
            unusable.add(name)
            choice = getattr(check, "choice", CHOICES_OF_FILES.get(name))
            errors += [_wrong_value(f"{path}.{name}", name, each, choice) for each in refused]
    for name in table:
        if name not in model.checks:
            meant = unknown_key(f"{path}.{name}", str(name), model.section, table[name], errors)
            unusable |= {meant} if meant not in table else set()
    return good, unusable


def unknown_key(path: str, name: str, section: str, value: Any, errors: Errors) -> str:
    """Add the error of an unknown key; returns the known one that is meant, empty where none is.

    Args:
        path: of the key in the file.
        name, section, value: as for `suggest`.
    """
    few = len(errors) < MOST_SHOWN  # to look for what is meant takes a millisecond, and of more nothing is shown
    meant = suggest(name, section, value) if few else Suggestion("")
    errors.append(FileErrorDetail(path, "unknown key", cause=meant.sentence))
    return meant.key


def _wrong_value(path: str, name: str, value: Any, choice: Any) -> FileErrorDetail:
    if choice is not None:
        names = list(choice)
        cause = other_kind(value) if choice is BearingKind else ""
        cause = cause or did_you_mean(value, names) or f"One of {', '.join(names)}"
        if name == "clearance_class":
            cause += ". How exact a bearing is made, such as P5, is tolerance_class in [effects.ring_expansion]"
        return FileErrorDetail(path, "is none of the choices", value, cause=cause)
    if name == "ball":
        cause = 'Write ball = ["centrifugal_force", "gyroscopic_moment"], or one of the two'
        return FileErrorDetail(path, "is not a list of ball effects", value, cause=cause)
    if name == BALL_DEVIATIONS.name:
        cause = "Write a number for each ball, as in [0.5, -0.2, 0, ...]"
        return FileErrorDetail(path, "is not a list of finite numbers", value, cause=cause)
    key = find(path)
    if key is None:
        return FileErrorDetail(path, "is not a word in quotation marks", value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return FileErrorDetail(path, "is not a finite number (floats end at 1.8e308)", value, key.unit)
    cause = f"A number{f' in {printed_unit(key.unit)}' if key.unit else ''}"
    cause += "" if isinstance(value, bool) else ", without quotation marks"
    if advice := comma_advice(value):
        cause += f". {advice}"
    return FileErrorDetail(path, "is not a number", value, key.unit, cause=cause)


def did_you_mean(value: Any, known: Sequence[str]) -> str:
    word = value.lower().replace(" ", "_").replace("-", "_") if isinstance(value, str) else ""
    return question(alike(word, known))


def flattened(table: dict[str, Any], before: str = "") -> dict[str, Any]:
    """Tables within a table as keys with points."""
    out: dict[str, Any] = {}
    for name, value in table.items():
        out |= flattened(value, f"{before}{name}.") if isinstance(value, dict) else {before + name: value}
    return out


def si(keys: tuple[Key, ...], good: dict[str, Any]) -> dict[str, float]:
    """The numbers of a table by their Python names."""
    return {key.field: key.si(good[key.name]) for key in keys if key.name in good}


def judged(errors: Iterable[ErrorDetail]) -> list[ErrorDetail]:
    """The errors of Python's objects, but for the NaN that stands where the file has no usable number."""
    return [each for each in errors if not (isinstance(each.value, float) and isnan(each.value))]


def add_missing(of: Any, path: str, fields: dict[str, Any], errors: Errors, detail: str = "") -> None:
    """Say what a table lacks without which there is no object of the class, with NaN in its place."""
    for key in required_of(of):
        if key.field not in fields:
            errors.append(FileErrorDetail(f"{path}.{key.name}", "missing", detail=detail))
            fields[key.field] = nan


def made(make: Callable[[], Made], errors: Errors) -> Made | None:
    """What a table's numbers make in Python; None where it refuses them, with its reasons among the errors."""
    try:
        return make()
    except SceneError as error:
        errors += map(translate, judged(error.errors))
        return None


def material(path: str, value: Any, errors: Errors) -> Material:
    """A material by its name or its table; NaN stands for what there is not."""
    unknown = Material(nan, nan, nan)
    if isinstance(value, dict):
        fields = read_fields(Material, "material", path, value, errors)
        add_missing(Material, path, fields, errors)
        return Material(**vars(unknown) | fields)
    if value is None or value is UNUSABLE:
        return unknown
    if not isinstance(value, str):
        errors.append(FileErrorDetail(path, "is not a word in quotation marks", value))
        return unknown
    known = material_named(value)
    if known is STAINLESS_STEEL and value.lower().startswith("stainless") and path.rpartition(".")[2] in MATERIALS:
        cause = "Bearings are of 440C, which write; if it really is the steel of shafts and housings, write 1.4301"
        errors.append(FileErrorDetail(path, "is the name of several materials", value, cause=cause))
        return unknown
    if known is None:
        others = f"One of {', '.join(BY_NAME)}, or a table with {', '.join(named(required_of(Material)))}"
        cause = question(alike(value, BY_NAME)) or others
        errors.append(FileErrorDetail(path, "is not a known material", value, cause=cause))
        return unknown
    return known
