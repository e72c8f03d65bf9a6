"""A table [bearing] that is a data sheet: balls and grooves, which it does not print, are inferred."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from qsbearing.files.designations import read
from qsbearing.files.file_errors import FileErrorDetail, translate
from qsbearing.files.keys import (
    BEARING,
    COEFFICIENTS,
    DATA_SHEET,
    DIAMETERS,
    IN_PLACE,
    MATERIALS,
    RACEWAYS,
    RATINGS,
    SHEET_WORDS,
)
from qsbearing.files.table_checks import Errors, material, si
from qsbearing.inference.data_sheet import DataSheet, needs_ratings
from qsbearing.model.bearing import BallBearing, Outline
from qsbearing.model.validation import SceneError, printable

if TYPE_CHECKING:
    from qsbearing.inference.infer import InferredBearing
    from qsbearing.remarks.remark import Warned

_BALLS, _RADII = {"ball_count", "ball_diameter_mm"}, set(COEFFICIENTS["groove_radius_coefficient"])
_SIZE, _RATINGS = ({key.name for key in keys} for keys in (DIAMETERS, RATINGS))
_OF_SHEET = (*(key.name for key in DATA_SHEET), *SHEET_WORDS)
_KEYS = tuple(key for key in (*BEARING, *IN_PLACE) if key.field in DataSheet.__dataclass_fields__)
CLEARANCE_CLASS = "clearance_class"
PRINTED_THERE = "As the data sheet prints it"
DIMENSIONS_ALONE = (
    f"{PRINTED_THERE}. Dimensions alone do not tell the balls: some series have them a third smaller than others, and "
    "lives guessed from proportions are up to 8 times off"
)


def is_data_sheet(given: Collection[str]) -> bool:
    """Whether these keys of [bearing] are a data sheet: ratings or dimensions in place of balls or grooves, or a class
    in place of the clearance."""
    has = {*given, *(radius for name, radii in COEFFICIENTS.items() if name in given for radius in radii)}
    lacking = (_BALLS | _RADII) - has
    if CLEARANCE_CLASS in has:
        return True
    return bool(lacking) and (bool(has & {*_RATINGS, *_OF_SHEET}) or (has >= _SIZE and lacking >= _BALLS))


def without_sheet(given: dict[str, Any]) -> Errors:
    """What would tell balls and grooves, taken out of a table that gives them; who made it does no harm."""
    given.pop("maker", None)
    unused = {key: given.pop(key) for key in _OF_SHEET if key in given}
    cause = "Leave it out: ball set and grooves are given"
    return [FileErrorDetail(f"bearing.{key}", "has no use", each, cause=cause) for key, each in unused.items()]


def bearing_of_sheet(
    given: dict[str, Any],
    sheets: list[dict[str, Any]],
    by_name: list[Warned],
    label: str,
    outline: Outline | None,
    errors: Errors,
    may_infer: bool,
) -> BallBearing | None:
    """Every bearing that the data sheet allows, as arrays; None where errors were found and added.

    Where one is needed it is that of the set chosen, or the one that fits best, whose name says so.

    Args:
        sheets: what the name adds, one table for each maker.
        by_name: what is said of that.
    """
    before = len(errors)
    others = _RADII | {*COEFFICIENTS, *(key.name for key in RACEWAYS)} - {"groove_radius_coefficient"}
    for name in sorted(others & {*given}):
        cause = "Give groove_radius_coefficient, of both grooves, pitch_diameter_mm and diametral_clearance_mm"
        errors.append(FileErrorDetail(f"bearing.{name}", "is not used beside a data sheet", given[name], cause=cause))
    is_rated = needs_ratings(given, "_mm") or _RATINGS & {*given}
    needed = _SIZE | (_RATINGS if is_rated and not sheets else set())
    missing = sorted(needed - {*given})
    for number, name in enumerate(missing):
        cause = DIMENSIONS_ALONE if name in _RATINGS and not _RATINGS & {*missing[:number]} else PRINTED_THERE
        errors.append(FileErrorDetail(f"bearing.{name}", "missing", cause=cause))
    if any(isinstance(each, np.ndarray) for each in given.values()):
        errors.append(FileErrorDetail("bearing", "varies, and its balls are not given", cause="Give balls and grooves"))
    fields: dict[str, Any] = {side: material(f"bearing.{side}", given.get(side, "steel"), errors) for side in MATERIALS}
    if len(errors) > before:
        return None
    chosen = given.get("ball_set")
    told = read(given.get("name", ""))
    fields |= {"maker": told.maker} if told is not None else {}
    fields |= {"name": printable(given.get("name", label))}
    rows = [given | each for each in sheets] or [given]
    words = ("kind", *SHEET_WORDS)
    try:
        sheets_given = (
            DataSheet(**fields | si(_KEYS, row) | {name: row[name] for name in words if name in row}) for row in rows
        )
        inferred = _inferred(*sheets_given)
    except SceneError as error:
        errors += map(translate, error.errors)
        return None
    inferred = replace(inferred, remarks=(*by_name, *inferred.remarks))
    if chosen is not None or not may_infer:
        return _chosen(inferred, 1 if chosen is None else chosen, outline, errors)
    return replace(inferred.bearing, inferred=inferred, outline=outline)


@lru_cache(16)  # a search reads a file's tables a thousand times
def _inferred(*sheets: DataSheet) -> InferredBearing:
    # Rarely asked for, and behind it are the readings, with scipy.
    from qsbearing.inference.infer import infer_bearing

    return infer_bearing(*sheets)


def _chosen(inferred: InferredBearing, number: float, outline: Outline | None, errors: Errors) -> BallBearing | None:
    """The set of this number in the list that `qsbearing run` prints, with its usual groove radius."""
    sets = int(inferred.set_number[-1]) + 1
    if number not in range(1, sets + 1):
        cause = f"A whole number from 1 to {sets}: `qsbearing run` without it lists the sets that the data sheet allows"
        errors.append(FileErrorDetail("bearing.ball_set", "is not on the list", number, cause=cause))
        return None
    case = int(np.flatnonzero(inferred.set_number == number - 1)[0])
    name = f"{inferred.bearing.name}, ball set {number:.0f} of {sets}"
    return replace(inferred.at(case), name=name, outline=outline)


def refusal(bearing: BallBearing) -> str:
    """A sentence for those who solve one bearing, of one that is a list."""
    return "" if bearing.inferred is None else f"a data sheet allows several ball sets. {_one_of(bearing.inferred)}"


_BALL_SET = ("ball_count", "ball_diameter", "pitch_diameter")


def _one_of(inferred: InferredBearing) -> str:
    """How to go on with a single one."""
    best: Any = inferred.at(0)
    numbers = {key.name: key.in_file(getattr(best, key.field)) for key in BEARING if key.field in _BALL_SET}
    numbers["groove_radius_coefficient"] = round(best.inner_groove_radius / best.ball_diameter, 4)
    lines = ", ".join(f"{name} = {value:.6g}" for name, value in numbers.items())
    return (
        "`qsbearing run` and `qs.load_scene` solve all of them, of one bearing at one operating point. Or choose one: "
        "ball_set = 1 takes the first of the list that `qsbearing run` prints, "
        f"which the ratings fit best, with {lines}, which often is not the true one"
    )


def sheet_tables(bearing: BallBearing) -> dict[str, Any]:
    """The numbers and words of a data sheet, as a file has them."""
    sheet = bearing.inferred.sheet
    given = {name: getattr(sheet, name) for name in ("name", "kind", *SHEET_WORDS)}
    table: dict[str, Any] = {name: str(each) for name, each in given.items() if each}
    numbers = {key: getattr(sheet, key.field) for key in _KEYS}
    if bearing.inferred.others:  # of several makers, which the name tells again
        table.pop("maker", None)
        numbers = {key: each for key, each in numbers.items() if key.name not in (*_RATINGS, "f0")}
    table |= {key.name: key.in_file(each) for key, each in numbers.items() if each is not None}
    return table if sheet.ball_count is None else table | {"ball_count": int(sheet.ball_count)}
