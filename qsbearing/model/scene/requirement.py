"""What is required of a result: at least, or at most, a value in the result's own unit.

    {"life.basic_duration_h": ">= 20000", "inner.max_pressure_MPa": {"most": 1700, "source": "house rule 12"}}

Names are judged where all results are known: `qsbearing.files.require_table`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Any, NamedTuple

from qsbearing.model.validation import ErrorDetail, alike, comma_advice, question

LEAST, MOST, SOURCE = "least", "most", "source"
ENDS = {LEAST: ">=", MOST: "<="}
SENSES = {">=": ">=", "<=": "<=", ">": ">=", "<": "<=", "≥": ">=", "≤": "<="}
"""How people write a sense, and what it is."""
_BOUND = re.compile(rf"\s*({'|'.join(SENSES)})\s*([^\s<>=]+)\s*")
FORM = 'Write ">= {0}" or "<= {0}", or {{least = {0}}}, {{most = {0}}}'


class Requirement(NamedTuple):
    """One end of what a result may be, or with "=" what it shall be, as a search has it."""

    name: str
    """Of the result, as somebody wrote it."""
    sense: str
    value: float
    """In the result's unit."""
    source: str = ""
    """Whose it is."""

    def __str__(self) -> str:
        return f"{self.name} {self.sense} {self.value:g}"


def finite_number(given: Any) -> float:
    """A number, or one written as text.

    Raises:
        ValueError: it is none; says so.
    """
    try:
        value = float(given)
    except (TypeError, ValueError):
        advice = comma_advice(given)
        raise ValueError(f"{str(given).strip()!r} is not a number{f'. {advice}' if advice else ''}") from None
    if isinstance(given, bool) or not isfinite(value):
        raise ValueError(f"{given} is not a finite number")
    return value


def requirements_of(table: Any) -> tuple[tuple[Requirement, ...], list[ErrorDetail]]:
    """Those of a table, and everything that is wrong with it; fields of errors begin with `require`."""
    if not isinstance(table, Mapping):
        return (), [ErrorDetail("require", "is not a table", table, cause=f"Results below it. {FORM.format(45)}")]
    errors: list[ErrorDetail] = []
    return tuple(each for name, given in _flat(table) for each in _of_name(name, given, errors)), errors


def read_requirements(of: Any) -> list[ErrorDetail]:
    """Put requirements in the place of a table of them, in a scene or set; gives all that is wrong with it."""
    if isinstance(of.require, tuple) and all(isinstance(each, Requirement) for each in of.require):
        return []
    required, errors = requirements_of(of.require)
    object.__setattr__(of, "require", required)
    return errors


def requirement_table(of: tuple[Requirement, ...]) -> dict[str, dict[str, Any]]:
    """The table that these are read from."""
    table: dict[str, dict[str, Any]] = {}
    for each in of:
        end = LEAST if each.sense == ">=" else MOST
        table.setdefault(each.name, {})[end] = each.value
        if each.source:
            table[each.name][SOURCE] = each.source
    return table


def _flat(table: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Names with points, which files read as tables within tables."""
    for name, given in table.items():
        if isinstance(given, Mapping) and given and not any(alike(str(key), (*ENDS, SOURCE)) for key in given):
            yield from _flat(given, f"{before}{name}.")
        else:
            yield f"{before}{name}", given


def _of_name(name: str, given: Any, errors: list[ErrorDetail]) -> list[Requirement]:
    if isinstance(given, Mapping):
        return _of_table(name, given, errors)
    match = _BOUND.fullmatch(given) if isinstance(given, str) else None
    if match is None:
        number = f"{given:g}" if isinstance(given, int | float) and not isinstance(given, bool) else "45"
        problem = "has no sense: at least, or at most?" if number != "45" else "is no requirement"
        errors.append(ErrorDetail(f"require.{name}", problem, given, cause=FORM.format(number)))
        return []
    sense, text = match.groups()
    try:
        return [Requirement(name, SENSES[sense], finite_number(text))]
    except ValueError as error:
        errors.append(ErrorDetail(f"require.{name}", str(error), given))
        return []


def _of_table(name: str, given: Mapping[str, Any], errors: list[ErrorDetail]) -> list[Requirement]:
    path, known, ends = f"require.{name}", (*ENDS, SOURCE), {}
    for key, value in given.items():
        if key not in known:
            cause = question(alike(str(key), known)) or f"One of {', '.join(known)}"
            errors.append(ErrorDetail(f"{path}.{key}", "unknown key", cause=cause))
        elif key in ENDS and (isinstance(value, bool | str) or not isinstance(value, int | float)):
            errors.append(ErrorDetail(f"{path}.{key}", "is not a number", value))
        elif key in ENDS and not isfinite(value):
            errors.append(ErrorDetail(f"{path}.{key}", "is not a finite number", value))
        elif key in ENDS:
            ends[key] = float(value)
        elif not isinstance(value, str):
            errors.append(ErrorDetail(f"{path}.{key}", "is not a text", value))
    if not set(given) & set(ENDS):
        errors.append(ErrorDetail(path, "has neither least nor most", cause=FORM.format(45)))
    if len(ends) > 1 and ends[LEAST] > ends[MOST]:
        problem = f"is met by no number: {ends[LEAST]:g} at least, {ends[MOST]:g} at most"
        errors.append(ErrorDetail(path, problem, cause="Swap the two"))
    source = str(given.get(SOURCE, ""))
    return [Requirement(name, ENDS[end], value, source) for end, value in ends.items()]
