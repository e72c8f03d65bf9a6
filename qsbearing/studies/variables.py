"""What a study varies: a key over listed values or a range, or over a distribution."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail
from qsbearing.files.unknown_key import LARGEST
from qsbearing.model.validation import comma_advice, shown
from qsbearing.studies import keys

MOST_VALUES = 1_000_000
"""Along one axis, whose values are all in memory: 60 MB of them, where samples are made as they are needed."""
_COUNT = f"the count must be a whole number from 1 to {MOST_VALUES:,}. For more, vary several keys, or one at random"

RANGE_KEYS = ("start", "stop", "count", "scale")
DISTRIBUTIONS = {
    "normal": ("mean", "standard_deviation"),
    "uniform": ("low", "high"),
    "triangular": ("low", "mode", "high"),
}
"""Each distribution with its parameters, in their order."""

RANGE = "START:STOP:COUNT, START:STOP:COUNT:log"
FORMS = f"{RANGE}, A,B,C, " + ", ".join(f"{name}({','.join(given)})" for name, given in DISTRIBUTIONS.items())
_CALL = re.compile(r"(\w+)\s*\((.*)\)")


@dataclass(frozen=True)
class Axis:
    """A key over given values, in the key's unit: an axis of the results' grid."""

    key: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class Distribution:
    """A key that varies at random, in the key's unit; samples of all such keys share one axis."""

    key: str
    kind: str
    parameters: tuple[float, ...]

    def at(self, quantile: NDArray) -> NDArray:
        """Values at these quantiles, within (0, 1)."""
        if self.kind == "normal":
            from scipy.special import ndtri

            mean, deviation = self.parameters
            return np.asarray(mean + deviation * ndtri(quantile))
        if self.kind == "uniform":
            low, high = self.parameters
            return low + (high - low) * quantile
        low, mode, high = self.parameters  # the triangle's cumulative distribution, inverted on either side of its mode
        rising = low + np.sqrt(quantile * (high - low) * (mode - low))
        falling = high - np.sqrt((1.0 - quantile) * (high - low) * (high - mode))
        return np.where(quantile * (high - low) < mode - low, rising, falling)


Variable = Axis | Distribution


class VariableError(ValueError):
    """What is wrong with one variable."""


def variable_of(name: str, given: Any, document: dict[str, Any] | None = None) -> Variable:
    """The variable of a key and what a study file or the command line gives for it.

    Args:
        name: the key, or its path in the file, such as ball_material.density_kg_m3 or rows.2.position_mm.
        document: the tables of the file; None: those of a scene.
        given: text as `--vary` has it, a list, a number, or a table: {start, stop, count, scale}, {normal = [..]}.

    Raises:
        VariableError: a sentence.
    """
    if problem := keys.problem(name, document or {}):
        raise VariableError(". ".join(problem))
    key = keys.known(name)
    if isinstance(given, str):
        return _of_text(key.name, given)
    if isinstance(given, dict):
        return _of_table(key.name, given)
    values = given if isinstance(given, list | tuple | np.ndarray) else [given]
    if len(values) > MOST_VALUES:
        raise VariableError(f"{len(values):,} values: {_COUNT}")
    return _listed(key.name, [_number(value) for value in values])


def error_of(name: str, given: Any, error: VariableError) -> FileErrorDetail:
    """The error as a study file's reader needs it."""
    return FileErrorDetail(f"vary.{name}", str(error), given)


def _of_text(key: str, text: str) -> Variable:
    call = _CALL.fullmatch(text.strip())
    if call:
        return _distribution(key, call.group(1), [_number(word) for word in call.group(2).split(",")])
    if ":" not in text:
        return _listed(key, [_number(word) for word in text.split(",")])
    start, stop, count, *scale = [word.strip() for word in text.split(":")] + [""] * max(0, 2 - text.count(":"))
    if not count or len(scale) > 1:
        raise VariableError(f"is not a range. One of: {FORMS}")
    return _range(key, _number(start), _number(stop), _number(count), scale[0] if scale else "linear")


def _of_table(key: str, table: dict[str, Any]) -> Variable:
    if set(table) & {"start", "stop", "count"}:
        unknown = set(table) - set(RANGE_KEYS)
        missing = [name for name in ("start", "stop", "count") if name not in table]
        if unknown or missing:
            problem = f"lacks {missing[0]}" if missing else f"has {sorted(unknown)[0]}, which no range has"
            raise VariableError(f"{problem}. Write {{start = 0, stop = 1, count = 11}}, or with scale = 'log'")
        start, stop, count = (_number(table[name]) for name in ("start", "stop", "count"))
        return _range(key, start, stop, count, str(table.get("scale", "linear")))
    if len(table) == 1:
        ((kind, parameters),) = table.items()
        if isinstance(parameters, list):
            return _distribution(key, kind, [_number(value) for value in parameters])
    raise VariableError("is neither a range nor a distribution. Write {start, stop, count} or {normal = [mean, sd]}")


def _number(given: Any) -> float:
    try:
        if isinstance(given, bool):
            raise TypeError
        value = float(given)
    except (TypeError, ValueError):
        cause = comma_advice(given) or f"One of: {FORMS}"
        raise VariableError(f"{shown(given)} is not a number. {cause}") from None
    if not isfinite(value):
        raise VariableError(f"{shown(given)} is endless: every value must be a finite number")
    if abs(value) > LARGEST:
        raise VariableError(f"{shown(given)} is beyond any number of a bearing (at most {LARGEST:g})")
    return value


def _listed(key: str, values: list[float]) -> Axis:
    if not values:
        raise VariableError("is an empty list")
    if len(set(values)) < len(values):
        raise VariableError("names a value twice")
    return Axis(key, tuple(values))


def _range(key: str, start: float, stop: float, count: float, scale: str) -> Axis:
    if scale not in ("linear", "log"):
        raise VariableError(f"scale {shown(scale)} is neither linear nor log")
    if count != int(count) or not 1 <= count <= MOST_VALUES:
        raise VariableError(f"{count:,.15g} values: {_COUNT}")
    if stop < start:
        raise VariableError(f"is reversed: it ends at {stop:g}, below its start {start:g}. Swap the two")
    if stop == start and count > 1:
        raise VariableError(f"is empty: it starts and ends at {start:g}")
    if scale == "log" and start <= 0.0:
        raise VariableError(f"starts at {start:g}: a logarithmic range needs a start above zero")
    spaced = np.geomspace if scale == "log" else np.linspace
    # Twelve digits: what a reader would have typed, not what rounding made of it.
    return Axis(key, tuple(float(f"{value:.12g}") for value in spaced(start, stop, int(count))))


def _distribution(key: str, kind: str, parameters: list[float]) -> Distribution:
    if kind not in DISTRIBUTIONS:
        raise VariableError(f"{shown(kind)} is not a distribution. One of {', '.join(DISTRIBUTIONS)}")
    names = DISTRIBUTIONS[kind]
    if len(parameters) != len(names):
        raise VariableError(f"{kind} takes {len(names)} numbers: {', '.join(names)}; found {len(parameters)}")
    if kind == "normal" and parameters[1] <= 0.0:
        raise VariableError(f"normal has a standard deviation of {parameters[1]:g}, which must be above zero")
    if kind != "normal" and (sorted(parameters) != parameters or parameters[0] == parameters[-1]):
        raise VariableError(f"{kind} is empty or reversed: {' < '.join(names)} must hold")
    return Distribution(key, kind, tuple(parameters))
