"""What is wrong with an input, as data: collected first, reported together.

An error names its field as Python does and holds SI values. Whoever reports it to a reader of another form (a scene
file, with units in its keys) translates names and units and nothing else.
"""

from __future__ import annotations

import dataclasses
import os
import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.units import deg, mm, rpm

_PLAIN = (float, int, np.float64)

_BETWEEN = re.compile(r"[_.\-\s]+")
_DECIMAL_COMMA = re.compile(r"([+-]?\d+),(\d+)")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+(?:\.\d*)?")

LONGEST_VALUE = 60
"""Characters of a value that a message repeats."""
FARTHEST, SHORTEST, MOST_ALIKE = 0.3, 3, 6
"""Of words that are alike: the part of the letters that may differ (chosen: `clearance` is no `tolerance`),
letters of a word below which nothing is told, and how many are told."""
MOST_DIGITS = 18
"""Of a whole number in a text: more are an integer that no array holds."""


@dataclass(frozen=True)
class Quantity:
    """What kind of number a field holds: its SI unit, and the units it is often given in."""

    unit: str
    units: tuple[tuple[str, str, float], ...] = ()
    """(as a key's ending, in words, size in SI); where several explain a mistake, the first is suggested."""


LENGTH = Quantity(
    "m", (("m", "metres", 1.0), ("mm", "millimetres", mm), ("um", "micrometres", 1e-6), ("in", "inches", 25.4 * mm))
)
ANGLE = Quantity("rad", (("rad", "radians", 1.0), ("deg", "degrees", deg), ("mrad", "milliradians", 1e-3)))
SPEED = Quantity(
    "rad/s",
    (
        ("rad_s", "radians per second", 1.0),
        ("rpm", "revolutions per minute", rpm),
        ("Hz", "revolutions per second", 2.0 * pi),
    ),
)
MODULUS = Quantity("Pa", (("Pa", "pascals", 1.0), ("MPa", "megapascals", 1e6), ("GPa", "gigapascals", 1e9)))
DENSITY = Quantity("kg/m³", (("kg_m3", "kg/m³", 1.0), ("g_cm3", "g/cm³", 1e3), ("kg_mm3", "kg/mm³", 1e9)))
FORCE = Quantity("N", (("N", "newtons", 1.0), ("kN", "kilonewtons", 1e3), ("lbf", "pounds", 4.4482216152605)))
MOMENT = Quantity(
    "N m", (("Nm", "newton metres", 1.0), ("Nmm", "newton millimetres", 1e-3), ("kNm", "kilonewton metres", 1e3))
)
PRESSURE = MODULUS
POWER = Quantity("W", (("W", "watts", 1.0), ("kW", "kilowatts", 1e3), ("hp", "horsepower", 745.7)))
VELOCITY = Quantity("m/s", (("m_s", "metres per second", 1.0), ("mm_s", "millimetres per second", 1e-3)))
TEMPERATURE = Quantity("K")
EXPANSION = Quantity("1/K")
RATIO = Quantity("-")
COUNT = Quantity("balls")


class Field(str):
    """The name of a field within a sentence, as Python has it: of the same table alone, of another with its table."""


class Setting(Field):
    """What to write for a field of a scene: a value, or the class of an effect that takes numbers."""

    field: str
    value: Any

    def __new__(cls, field: str, value: Any) -> Setting:
        is_class = isinstance(value, type)
        made = super().__new__(cls, f"{value.__name__}(...)" if is_class else f"{field}={_in_python(value)}")
        made.field, made.value = field, value
        return made

    def __getnewargs__(self) -> tuple[Any, ...]:
        return self.field, self.value


def _in_python(value: Any) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(map(_in_python, value))}{',' * (len(value) == 1)})"
    if dataclasses.is_dataclass(value):
        named = ((each, getattr(value, each.name)) for each in dataclasses.fields(value))
        given = [f"{each.name}={_in_python(own)}" for each, own in named if own is not each.default]
        return f"{type(value).__name__}({', '.join(given)})"
    return f'"{value}"' if isinstance(value, str) else repr(value)


class Sentence(str):
    """A sentence with what it names in braces. As a string it is Python's; `written` is for other readers."""

    template: str
    values: dict[str, Any]

    def __new__(cls, template: str, **values: Any) -> Sentence:
        made = super().__new__(cls, _filled(template, values, str))
        made.template, made.values = template, values
        return made

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, Any]]:
        return (self.template,), self.values

    def written(self, spell: Callable[[Any], str]) -> str:
        """The sentence with its fields, and errors within it, spelled by this function."""
        return _filled(self.template, self.values, spell)


def _filled(template: str, values: dict[str, Any], spell: Callable[[Any], str]) -> str:
    def said(value: Any) -> Any:
        if isinstance(value, tuple):
            return ("; " if any(isinstance(each, ErrorDetail) for each in value) else ", ").join(map(said, value))
        return spell(value) if isinstance(value, Field | ErrorDetail) else value

    return template.format(**{name: said(value) for name, value in values.items()})


class UnitAdvice(str):
    """The likely mistake is one of unit: a sentence for Python, empty where no unit explains it.

    Whoever prints the value in another unit works it out again, from the value and the range.
    """


@dataclass(frozen=True)
class ErrorDetail:
    """One thing wrong with one field."""

    field: str
    """The field's name in Python, e.g. `bearing.ball_diameter`."""
    problem: str
    """A sentence, the same for all values; its fields, as those of `detail` and `cause`, may be named (`Sentence`)."""
    value: Any = None
    """The offending value, SI; the first one of an array."""
    quantity: Quantity | None = None
    """What kind of number it is, with its unit; None: none."""
    allowed: tuple[float, float] | None = None
    """Inclusive range, SI."""
    cause: str = ""
    """What is likely meant, or what to write instead."""
    where: NDArray | None = dataclasses.field(default=None, compare=False, repr=False)
    """Which cases it concerns, broadcasting to the case axes; None: all of them."""
    detail: str = ""
    """More of the problem, such as its numbers."""

    def __str__(self) -> str:
        unit = f" {self.quantity.unit}" if self.quantity and self.quantity.unit != "-" else ""
        text = self.field
        if self.value is not None:
            text += f" = {shown(self.value)}{unit if isinstance(self.value, float | int) else ''}"
        text += f": {self.problem}" + (f": {self.detail}" if self.detail else "")
        if self.allowed is not None:
            text += f" (allowed: {self.allowed[0]:g} to {self.allowed[1]:g}{unit})"
        return text + (f". {self.cause}" if self.cause else "")


class SceneError(ValueError):
    """Invalid input; `errors` holds every reason found."""

    def __init__(self, errors: Iterable[ErrorDetail]) -> None:
        self.errors = tuple(errors)
        """Everything that is wrong, each an `ErrorDetail`."""
        super().__init__("\n".join(map(str, self.errors)))


def all_where(errors: Iterable[ErrorDetail]) -> NDArray | None:
    """Which cases these errors concern together; None: all."""
    masks = [error.where for error in errors]
    given = [mask for mask in masks if mask is not None]
    if len(given) < len(masks) or not given:
        return None
    return np.asarray(np.logical_or.reduce(np.broadcast_arrays(*given)))


def raise_if_any(errors: list[ErrorDetail]) -> None:
    """Raise `SceneError` with all errors, if there are any."""
    if errors:
        raise SceneError(errors)


def printable(text: str) -> str:
    """The text with every control character, terminal escape and bidirectional mark spelled as in Python: \\x1b.

    Whatever comes from a user goes through here before a message or a picture repeats it.
    """
    if text.isprintable():
        return text
    return "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text)


def whole_number(text: str) -> int | None:
    """A text of the digits 0 to 9 as a number; None of any other: to Python ² and ٢ are digits as well."""
    return int(text) if text.isascii() and text.isdigit() and len(text) <= MOST_DIGITS else None


def shown(value: Any) -> str:
    """A value as a message repeats it: on one line, and no more of it than helps."""
    try:
        text = f"{value:.10g}" if isinstance(value, float) else repr(value)
    except ValueError:
        text = "<a number of thousands of digits>"  # as far as Python prints integers
    text = printable(" ".join(text.split()))
    return text if len(text) <= LONGEST_VALUE else f"{text[: LONGEST_VALUE - 3]}..."


def comma_advice(text: object) -> str:
    """How to write a number that a text has with a comma, such as "22,225"; empty for any other text.

    A comma before three digits may stand before decimals or between thousands: both readings.
    """
    given = text.strip() if isinstance(text, str) else ""
    decimals, whole = _DECIMAL_COMMA.fullmatch(given), given.replace(",", "")
    point = f"{decimals[1]}.{decimals[2]}" if decimals else ""
    if not _THOUSANDS.fullmatch(given):
        return f"Decimals take a point: {point}" if point else ""
    if not point:
        return f"Thousands take no comma: {whole}"
    value = f"{float(point):g}"
    meant = point if point == value else f"{point}, which is {value}"
    return f"Write {whole} (thousands take no comma) or {meant} (decimals take a point)"


_REMEDIES = {
    ("BallBearing", "Scene"): "qs.{call}(qs.Scene(bearing, qs.Operation(...)))",
    ("BearingSet", "Scene"): "qs.solve_set(...)",
    ("Study", "Scene"): "qs.sweep(...)",
    ("Scene", "BearingSet"): "qs.solve(...) solves it",
    ("Scene", "Solution"): "qs.{call}(qs.solve(...))",
    ("BearingSet", "SetSolution"): "qs.{call}(qs.solve_set(...))",
    ("BearingSet", "Solution"): "give a row of its solution, qs.solve_set(...).rows[0]",
    ("SetSolution", "Solution"): "give one of its rows, solution.rows[0]",
    ("Solution", "BearingSet"): "give the set that was solved",
    ("SetSolution", "BearingSet"): "give solution.set",
    ("Scene", "Study"): "qs.Study.of(FILE, {{KEY: VALUES}}) makes one of a scene's file",
    ("BearingSet", "Study"): "qs.Study.of(FILE, {{KEY: VALUES}}) makes one of a set's file",
}
"""What to do with one kind of object where another is taken."""
_LOADED = {"Scene": "qs.load_scene({0!r})", "BearingSet": "qs.load_set({0!r})", "Study": "qs.Study.of({0!r}, ...)"}
"""How each kind is made of a file's name."""


def check_kind(call: str, given: object, *kinds: str) -> None:
    """See that a public function was given what it takes.

    Args:
        call: the function's name.
        kinds: the classes, by their names, for most of them lie above; the one whose remedy fits best last.

    Raises:
        TypeError: it was not; what to call instead.
    """
    names = [each.__name__ for each in type(given).__mro__]
    if any(kind in names for kind in kinds):
        return
    takes = f"{call} takes a {' or a '.join(kinds)}"
    loaded = next((_LOADED[kind] for kind in kinds if kind in _LOADED), "")
    if isinstance(given, str | os.PathLike) and loaded:
        raise TypeError(f"{takes}, not the name of one: qs.{call}({loaded.format(str(given))})")
    remedies = (_REMEDIES.get((name, kind), "") for kind in reversed(kinds) for name in names)
    remedy = next(filter(None, remedies), "").format(call=call)
    raise TypeError(f"{takes}, not {names[0]}{f': {remedy}' if remedy else ''}")


def numeric(field: str, value: Any, quantity: Quantity) -> tuple[NDArray | None, list[ErrorDetail]]:
    """The value as a float array, or the error that says why it is none: not a number, NaN, infinite.

    A quantity with a unit, of pint or its like, is none: numpy would take its number and drop the unit.
    """
    if hasattr(value, "m_as") or hasattr(value, "to_value"):
        cause = "Python takes plain numbers in SI, such as 10 * qs.kN; of pint value.to_base_units().magnitude"
        return None, [ErrorDetail(field, "is a quantity with a unit", str(value), quantity, cause=cause)]
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        cause = "Leave those cases out, such as value.compressed(), or give them a number with value.filled(...)"
        return None, [ErrorDetail(field, "has masked elements, which are no numbers", quantity=quantity, cause=cause)]
    try:
        if value is None or isinstance(value, str | bytes | bool) or np.iscomplexobj(value):
            raise TypeError
        array = np.asarray(value, dtype=float)
    except (TypeError, ValueError):
        return None, [ErrorDetail(field, "is not a number", value, quantity)]
    except OverflowError:
        return None, [ErrorDetail(field, "is an integer beyond any float", quantity=quantity)]
    if array.size == 0:
        return None, [ErrorDetail(field, "is an empty array", quantity=quantity)]
    infinite = ~np.isfinite(array)
    if infinite.any():
        (wrong,) = first(infinite, array)
        return None, [ErrorDetail(field, "is not a finite number", wrong, quantity, where=infinite)]
    return array, []


def first(where: NDArray, *arrays: NDArray) -> tuple[float, ...]:
    """What each array holds at the first place marked."""
    return tuple(float(np.broadcast_to(array, where.shape)[where][0]) for array in arrays)


def choose(field: str, value: Any, choices: type[StrEnum]) -> tuple[Any, list[ErrorDetail]]:
    """The member that a value names (a member itself, or its word), or the error that says which there are."""
    try:
        return choices(value), []
    except ValueError:
        return value, [ErrorDetail(field, f"is not one of {', '.join(choices)}", value)]


def within(field: str, value: Any, quantity: Quantity, low: float, high: float, meaning: str = "") -> list[ErrorDetail]:
    """Errors of a value that must be a finite number in [low, high], with a likely mistake of unit named."""
    if type(value) in _PLAIN and low <= value <= high:
        return []  # at once, for most values are plain numbers within their range
    array, errors = numeric(field, value, quantity)
    if array is None:
        return errors
    outside = (array < low) | (array > high)
    if not outside.any():
        return []
    (wrong,) = first(outside, array)
    problem = meaning or ("is negative" if wrong < 0.0 <= low else "is too small" if wrong < low else "is too large")
    cause = unit_mistake(wrong, quantity, low, high)
    return [ErrorDetail(field, problem, wrong, quantity, (low, high), cause, outside)]


def on_side(field: str, value: Any, limit: Any, outward: float, what: str) -> list[ErrorDetail]:
    """The error of a length that does not lie beyond another: above it where outward is 1, below it where -1."""
    lengths, other = np.broadcast_arrays(np.asarray(value, float), np.asarray(limit, float))
    bad = outward * (lengths - other) <= 0.0
    if not bad.any():
        return []
    wrong, least = first(bad, lengths, other)
    allowed, cause = ((least, 20.0), unit_mistake(wrong, LENGTH, least, 20.0)) if outward > 0.0 else ((0.0, least), "")
    return [ErrorDetail(field, f"is not {what}, {least / mm:.6g} mm", wrong, LENGTH, allowed, cause, bad)]


def unit_mistake(value: float, quantity: Quantity, low: float, high: float) -> UnitAdvice:
    """A sentence naming the unit in which an out-of-range SI value would be in range; empty where none would."""
    for _, name, size in quantity.units:
        if size != 1.0 and low <= value * size <= high:
            said = f"Given in {name}? Python takes SI and radians: multiply by the unit, as in 22.225 * qs.mm"
            return UnitAdvice(said)
    return UnitAdvice("")


def alike(word: str, known: Iterable[str]) -> list[str]:
    """The known words that one may be a slip of, all that are equally near; none where there are too many of them.

    Those that have all its parts, between underscores, points and blanks, of many those with the fewest others; else
    those of which the fewest letters differ, at most `FARTHEST` of the longer word, and of each longer part of it.
    Capitals do not count.
    """
    plain, names = word.lower()[:LONGEST_VALUE], list(dict.fromkeys(known))
    if same := [name for name in names if name.lower() == plain]:
        return same
    parts = _parts(plain)
    others = {name: len(own) - len(parts) for name in names if parts <= (own := _parts(name.lower()))}
    if max(map(len, parts), default=0) >= SHORTEST and 0 < len(others) <= MOST_ALIKE:
        return sorted(others, key=lambda name: others[name])
    if max(map(len, parts), default=0) < SHORTEST or not others:
        others = {name: edits for name in names if (edits := _distance(plain, name.lower())) is not None}
    nearest = [name for name, distance in others.items() if distance == min(others.values())]
    return nearest if len(nearest) <= MOST_ALIKE else []


def question(meant: Sequence[str], form: str = "{}") -> str:
    """Asks whether one of these is meant; empty where there are none.

    Args:
        form: what stands around each.
    """
    *others, last = (form.format(each) for each in meant) if meant else ("",)
    return f"Did you mean {', '.join(others)}{' or ' * bool(others)}{last}?" if meant else ""


@lru_cache(4096)
def _split(text: str) -> list[str]:
    return _BETWEEN.split(text)


def _parts(text: str) -> set[str]:
    return {*_split(text)} - {""}


def _distance(one: str, other: str) -> int | None:
    """How many letters differ; None where they are too many, in all or in one of as many parts. A part may be cut
    short, as temp of temperature."""
    parts, own = _split(one), _split(other)
    if len(parts) == len(own):
        parts = [b if len(a) >= SHORTEST and b.startswith(a) else a for a, b in zip(parts, own, strict=True)]
        one, other = "_".join(parts), "_".join(own)
    pairs = [(a, b) for a, b in zip(parts, own, strict=False) if max(len(a), len(b)) >= SHORTEST]
    if len(parts) == len(own) and None in (_edits(a, b) for a, b in pairs):
        return None
    return _edits(one, other)


def _edits(one: str, other: str) -> int | None:
    """How many letters are changed, left out, put in or exchanged with a neighbour; None beyond the bound."""
    longest = max(len(one), len(other))
    most = max(int(FARTHEST * longest), min(1, longest // SHORTEST))
    if abs(len(one) - len(other)) > most:
        return None
    lacking = sum(max(one.count(each) - other.count(each), 0) for each in set(one))
    if lacking > most:
        return None
    before: list[int] = []
    last = list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        row = [i]
        for j, own in enumerate(other, 1):
            row.append(min(last[j] + 1, row[-1] + 1, last[j - 1] + (letter != own)))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == own:
                row[-1] = min(row[-1], before[j - 2] + 1)
        if min(row) > most and min(last) >= most:
            return None
        before, last = last, row
    return last[-1] if last[-1] <= most else None
