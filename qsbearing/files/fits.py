"""Fits by name: the interference of k5, JS6, ... with a bearing of a tolerance class, by ISO 286 and ISO 492."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.table_checks import UNUSABLE, Errors
from qsbearing.inference.clearance import ClearanceClass
from qsbearing.model.effects.ring_expansion_errors import Fit
from qsbearing.model.units import mm, um
from qsbearing.model.validation import alike, question

FITTED = {"shaft": "bore", "housing": "outside"}
"""What of a bearing each seat is fitted to."""
NORMAL = "normal"
CLASS = "tolerance_class"
LARGEST = 1e5
"""Of a diameter that is looked up [mm]."""
_NAME = re.compile(r"([a-zA-Z]{1,2})([0-9]+)")


@cache
def _facts() -> dict[str, Any]:
    return tomllib.loads(files("qsbearing.files").joinpath("fits.toml").read_text("utf-8"))


@cache
def names(seat: str) -> tuple[str, ...]:
    """The fits that are known of a shaft, in small letters, or of a housing's bore, in capitals."""
    facts = _facts()["seat"]
    grades = [int(grade) for grade in facts["grade"] if grade != "3"]
    letters = [letter for letter in (*facts["upper"], *facts["lower"], "js") if letter.isalpha()]
    fits = [f"{letter}{grade}" for letter in letters for grade in grades]
    if seat == "shaft":
        return (*fits, *(name for name in facts["lower"] if not name.isalpha()))
    return (*map(str.upper, fits), *(name for name in facts["hole_upper"] if name.startswith("J")))


def classes() -> tuple[str, ...]:
    """The tolerance classes of a bearing, by all their names."""
    return (*(name for name in _facts()["bearing"]["bore"] if name != "up_to_mm"), *_facts()["class"])


def deviations(name: str, diameter: Any) -> tuple[NDArray, NDArray]:
    """Lower and upper deviation of a shaft (k5) or a hole (JS6) of this diameter [mm], in micrometres.

    NaN beyond the tables' 500 mm. Of a hole, ES = -ei + IT(n) - IT(n - 1) above 3 mm for K, M, N and P.
    """
    facts = _facts()["seat"]
    letter, grade = _parts(name)
    place = _places(facts, diameter)
    width = _at(facts["grade"][str(grade)], place)
    if letter.lower() == "js":
        return -0.5 * width, 0.5 * width
    if not letter.isupper():
        if letter in facts["upper"]:
            upper = _at(facts["upper"][letter], place)
            return upper - width, upper
        lower = _at(facts["lower"].get(letter) or facts["lower"][name], place)
        return lower, lower + width
    own = _at(facts["hole_upper"].get(name, [np.nan] * len(facts["up_to_mm"])), place)
    if letter.lower() in facts["upper"]:
        lower = -_at(facts["upper"][letter.lower()], place)
        return lower, lower + width
    if letter == "J":
        return own - width, own
    finer = np.where(place > 0, width - _at(facts["grade"][str(grade - 1)], place), 0.0)
    upper = np.where(np.isnan(own), finer - _at(facts["lower"][letter.lower()], place), own)
    return upper - width, upper


def fit(seat: str, name: str, tolerance_class: str, diameter: Any) -> Fit:
    """The fit of a seat: shaft or housing.

    Args:
        diameter: bore or outside diameter of the bearing [m].
    """
    bearing = _facts()["bearing"][FITTED[seat]]
    size = np.asarray(diameter, float) / mm
    low, high = deviations(name, size)
    below = _at(bearing[_facts()["class"].get(tolerance_class, tolerance_class)], _places(bearing, size))
    least, most = (low, high + below) if seat == "shaft" else (-below - high, -low)
    return Fit(name, tolerance_class, (least * um)[()], (most * um)[()])


def _parts(name: str) -> tuple[str, int]:
    match = _NAME.fullmatch(name)
    assert match is not None, name
    return match[1], int(match[2])


def _places(facts: dict[str, Any], diameter: Any) -> NDArray:
    """In which step of diameters; beyond a table the place behind its values, where NaN is."""
    steps = np.asarray(facts["up_to_mm"], float)
    return np.searchsorted(steps, np.round(np.asarray(diameter, float), 9))


def _at(values: list[float], place: NDArray) -> NDArray:
    return np.asarray([*values, np.nan], float)[place]


def fits_of(path: str, given: dict[str, Any], errors: Errors) -> dict[str, Any]:
    """The fits of a ring expansion and their mean interferences, in place of the words, which are taken out.

    Args:
        given: its fields in SI, with the words of fits and of the bearing's class.
    """
    named = {seat: given.pop(f"{seat}_fit") for seat in FITTED if f"{seat}_fit" in given}
    is_class_given, tolerance, before = CLASS in given, given.pop(CLASS, NORMAL), len(errors)
    if tolerance not in classes() and tolerance is not UNUSABLE:
        cause = f"One of {', '.join(classes())}. P4Y, P3, SP and UP have limits of their own: give the interference"
        if tolerance in tuple(ClearanceClass):
            cause = f'It is a class of clearance: write clearance_class = "{tolerance}" in [bearing]'
        errors.append(FileErrorDetail(f"{path}.{CLASS}", "is no tolerance class", tolerance, cause=cause))
    if is_class_given and not named:
        cause = "It is of use with shaft_fit or housing_fit"
        errors.append(FileErrorDetail(f"{path}.{CLASS}", "is given without a fit", tolerance, cause=cause))
    fits: dict[str, Any] = {f"{seat}_interference": np.nan for seat in named}
    for seat, name in named.items():
        _check(path, seat, name, given, errors)
        diameter: Any = given.get(f"{FITTED[seat]}_diameter", np.nan)
        is_length = isinstance(diameter, np.ndarray) or 0.0 < diameter < LARGEST * mm
        if len(errors) > before or not is_length or UNUSABLE in (name, tolerance):
            continue  # a diameter that is missing or none is told of besides
        made = fit(seat, name, tolerance, diameter)
        if np.isnan(made.mean).any():
            problem = f"has no limits in the tables for this {FITTED[seat]} diameter"
            cause = "They go to 250 mm of bore and 400 mm outside: give the interference"
            errors.append(FileErrorDetail(f"{path}.{seat}_fit", problem, name, cause=cause))
        else:
            fits |= {f"{seat}_fit": made, f"{seat}_interference": made.mean}
    return fits


def _check(path: str, seat: str, name: Any, rest: dict[str, Any], errors: Errors) -> None:
    field = f"{path}.{seat}_fit"
    if f"{seat}_interference" in rest:
        cause = "Keep one: the fit makes the interference"
        errors.append(FileErrorDetail(field, f"is given together with {seat}_interference_um", name, cause=cause))
    elif name not in names(seat) and name is not UNUSABLE:
        known = names(seat)
        kind, other = ("a shaft", "capitals mean holes") if seat == "shaft" else ("a hole", "small letters mean shafts")
        word = name if isinstance(name, str) else ""
        meant = question(alike(word, known))
        cause = f"{meant} ({other})" if meant else f"Known are {', '.join(known)}"
        errors.append(FileErrorDetail(field, f"is no fit of {kind} that is known", name, cause=cause))
