"""The data sheet that a designation stands for: the ratings that its maker prints, those of all makers where it names
none, or none, where its balls are guessed by the proportions of its dimension series."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from math import radians
from typing import Any

from qsbearing.files import catalogue
from qsbearing.files.designations import Designation, angles_of, read
from qsbearing.files.designations.ratings import PrintedRatings, ratings_of
from qsbearing.files.keys import COEFFICIENTS, RACEWAYS, RATINGS
from qsbearing.inference.clearance import ClearanceClass, clearance_limits
from qsbearing.inference.data_sheet import DataSheet
from qsbearing.inference.practice import RatingPractice
from qsbearing.model.bearing import BearingKind
from qsbearing.model.units import mm, um
from qsbearing.remarks.kinds import NOTE, Kind
from qsbearing.remarks.remark import Warned, remark
from qsbearing.remarks.wording import listed

_DYNAMIC, _STATIC = (key.name for key in RATINGS)
_OWN = {"ball_diameter_mm", "pitch_diameter_mm", *(key.name for key in RACEWAYS), *COEFFICIENTS}
_OWN = _OWN.union(*COEFFICIENTS.values()) - {"groove_radius_coefficient"}
"""Numbers of a ball set: a bearing of one's own, which may have any name."""
_TOLD = {_DYNAMIC, _STATIC, "rating_practice", "outer_ball_pass", "inner_ball_pass"}
"""What stands in place of printed ratings."""
_ANGLE = ("free_contact_angle_deg", "diametral_clearance_mm", "clearance_class")

SHEET_BY_NAME = Kind("sheet_by_name", NOTE, "data_sheet", "taken from the name alone: {what}")


def designation_of(given: Mapping[str, Any]) -> Designation | None:
    """What the name in a file's [bearing] tells, read as its maker's, who may stand beside it; None where it is no
    designation or names a bearing of the catalogue."""
    name, maker = given.get("name"), given.get("maker")
    if not isinstance(name, str) or catalogue.find(name) is not None:
        return None
    told = read(name)
    if told is not None and not told.maker and isinstance(maker, str) and angles_of(maker.upper()):
        return read(f"{maker} {name}") or told
    return told


def sheets_by_name(given: Mapping[str, Any], unusable: Collection[str] = ()) -> list[dict[str, Any]]:
    """What a designation adds to a file's [bearing], one table for each maker whose ratings it may have; empty where
    the file describes the bearing itself, or nothing is known of it."""
    told = designation_of(given)
    if told is None or told.is_refused or (_OWN | _TOLD) & {*given, *unusable}:
        return []
    if told.kind == BearingKind.ANGULAR_CONTACT and told.angle is None:
        return []
    maker = str(given.get("maker", told.maker)).upper()
    printed = [each for each in ratings_of(told) if maker in ("", each.maker)]
    return [_table(each) for each in printed] or _guess(told)


def nearest(name: str) -> str:
    """A sentence that helps whoever asks the catalogue for a name that it does not hold, where a file may have it."""
    if sheets_by_name({"name": name}):
        return f"In a scene file, [bearing] name = {name!r} is enough: its balls follow from ratings or are guessed."
    return catalogue.nearest(name)


def _table(printed: PrintedRatings) -> dict[str, Any]:
    table = {"maker": printed.maker, _DYNAMIC: printed.dynamic, _STATIC: printed.static}
    return table if printed.f0 is None else table | {"f0": printed.f0}


def _guess(told: Designation) -> list[dict[str, Any]]:
    """Of a usual series: none of light balls, nor of a prefix that nobody here knows."""
    if told.is_light or not told.is_prefix_known or told.outside is None:
        return []
    from qsbearing.inference.proportions import proportions_of  # behind it are the readings, with scipy

    sheet = DataSheet(
        bore_diameter=told.bore * mm,
        outside_diameter=told.outside * mm,
        free_contact_angle=None if told.angle is None else radians(told.angle),
        kind=BearingKind(told.kind),
    )
    return [] if proportions_of(sheet) is None else [{"rating_practice": RatingPractice.PROPORTIONS}]


def clearance_by_name(given: Mapping[str, Any], unusable: Collection[str] = ()) -> dict[str, Any]:
    """The clearance class of a deep-groove bearing of which a file says no clearance: that of the designation, or the
    normal one; empty where nothing is to be said, or the classes do not reach."""
    told = designation_of(given)
    if told is None or told.is_refused or told.kind != BearingKind.DEEP_GROOVE or {*_ANGLE} & {*given, *unusable}:
        return {}
    of = ClearanceClass(told.clearance_class or ClearanceClass.CN)
    return {} if clearance_limits(told.bore * mm, of) is None else {"clearance_class": of}


def said_by_name(given: Mapping[str, Any], sheets: list[dict[str, Any]], clearance: Mapping[str, Any]) -> list[Warned]:
    """What is taken from the name alone, for a list of ball sets."""
    told = designation_of(given)
    if told is None or not (sheets or clearance):
        return []
    taken = [f"{told.outside:g} x {told.width:g} mm of ISO 15" if "outside_diameter_mm" not in given else ""]
    rated = [each for each in sheets if _DYNAMIC in each]
    taken += [f"C = {each[_DYNAMIC]:g} N with C0 = {each[_STATIC]:g} N of {each['maker']}" for each in rated]
    if clearance:
        least, most = clearance_limits(told.bore * mm, clearance["clearance_class"]) or (0.0, 0.0)
        limits = f"{least / um:.0f} to {most / um:.0f} µm"
        taken.append(f"clearance {clearance['clearance_class']} of ISO 5753-1, {limits}")
    known = [each for each in taken if each]
    return [remark(SHEET_BY_NAME, what=listed(known)).said()] if known else []
