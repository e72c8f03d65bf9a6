"""What a search is asked for: the variables with their ranges, and goals, limits and an objective by name."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import ceil, floor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.files.file_errors import FileErrorDetail, SceneFileError
from qsbearing.files.file_keys import REQUIRE
from qsbearing.model.bearing_errors import BALL_COUNT_RANGE
from qsbearing.model.scene.requirement import Requirement, finite_number, requirements_of
from qsbearing.studies import keys

MOST_VARIABLES = 6
"""Of a search over a scene (chosen: 16,000 points still see every pair of them in some detail)."""
RANGE = "KEY=LOW:HIGH, KEY=LOW:HIGH:log or KEY=A,B,C"
WHOLE = ("ball_count",)
"""Keys that take whole numbers only."""
_CONDITION = re.compile(r"\s*([\w.]+)\s*(<=|>=|==|=|<|>)\s*([^\s<>=]+)\s*")


@dataclass(frozen=True)
class Variable:
    """One number that is looked for: in a range, or among values."""

    key: str
    low: float
    high: float
    is_log: bool = False
    """Whether points are spread evenly over the logarithm of the range."""
    values: tuple[float, ...] = ()
    """In rising order, where only these are taken."""

    def at(self, u: NDArray) -> NDArray:
        """Values at places in the unit interval."""
        if self.values:
            place = np.minimum((u * len(self.values)).astype(int), len(self.values) - 1)
            return np.asarray(self.values)[place]
        values = self.low * (self.high / self.low) ** u if self.is_log else self.low + (self.high - self.low) * u
        return np.clip(values, self.low, self.high)

    def some(self, count: int) -> tuple[float, ...]:
        """At most so many different values, spread over the range, its ends among them."""
        spread = np.linspace(0.0, 1.0, count)
        return tuple(dict.fromkeys(float(value) for value in self.at(spread)))


Condition = Requirement
"""A goal (=) or a limit (<=, >=) of a result, in the result's unit."""


@dataclass(frozen=True)
class SearchProblem:
    """All that a search is asked for; conditions in the order goals, limits."""

    variables: tuple[Variable, ...]
    conditions: tuple[Condition, ...]
    objective: str = ""
    """The result to make small or large; empty: none."""
    is_maximised: bool = False
    required: tuple[Condition, ...] = ()
    """What the scene itself requires, as it is written; what of it can be searched for is among the conditions."""
    open: tuple[str, ...] = ()
    """What is left of it: of results that the scene does not have."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of the results in the order of the columns that a search works on: conditions, then the objective."""
        return (*(each.name for each in self.conditions), *([self.objective] if self.objective else []))


def problem_of(
    vary: Mapping[str, Any],
    goals: Iterable[str],
    limits: Iterable[str],
    minimise: str | None,
    maximise: str | None,
    file: str,
    document: dict[str, Any] | None = None,
) -> SearchProblem:
    """What was asked for in words.

    Args:
        vary: for each key "LOW:HIGH", "LOW:HIGH:log" or (LOW, HIGH), or the values to choose from: "A,B,C" or a list.
        goals, limits: "NAME=VALUE", "NAME<=VALUE" or "NAME>=VALUE".
        file: what to call it in errors.
        document: the tables of the scene that it is asked of, whose [require] counts as limits.

    Raises:
        SceneFileError: everything that is wrong with it, at once.
    """
    errors: list[FileErrorDetail] = []
    variables: dict[str, Variable] = {}
    for name, given in vary.items():
        try:
            variable = _variable(name, given, document or {})
            if variable.key in variables:
                raise ValueError("is varied twice")
            variables[variable.key] = variable
        except ValueError as error:
            errors.append(FileErrorDetail(f"vary {name}", str(error), given))
    if not 1 <= len(vary) <= MOST_VARIABLES:
        cause = f"From one to {MOST_VARIABLES}: {RANGE}"
        errors.append(FileErrorDetail("vary", f"{len(vary) or 'no'} variables", cause=cause))
    conditions = [
        *(_condition("goal", text, ("=",), errors) for text in goals),
        *(_condition("limit", text, ("<=", ">="), errors) for text in limits),
    ]
    objective = minimise or maximise or ""
    if minimise and maximise:
        errors.append(
            FileErrorDetail(
                "maximise", "is given together with minimise", maximise, cause="Keep one, and limit the other"
            )
        )
    required, _ = requirements_of((document or {}).get(REQUIRE, {}))  # what is wrong with it, the scene says
    if not conditions and not objective and not required:
        cause = "Give a goal, a limit, or a result to minimise or maximise"
        errors.append(FileErrorDetail("goal", "nothing is asked for", cause=cause))
    if errors:
        raise SceneFileError(file, errors)
    given = tuple(filter(None, conditions))
    return SearchProblem(tuple(variables.values()), given, objective.strip(), bool(maximise), required)


def _variable(name: str, given: Any, document: dict[str, Any]) -> Variable:
    """Raises ValueError with what is wrong."""
    if problem := keys.problem(name, document):
        raise ValueError(". ".join(problem))
    key = keys.known(name)
    if key.name == keys.EACH_BALL:
        raise ValueError(f"is drawn at random; of one ball it is {keys.of_ball(0)}")
    is_log = False
    if isinstance(given, str) and ":" in given:
        low, high, *rest = given.split(":")
        if rest not in ([], ["log"]):
            raise ValueError(f"is not a range. Write {RANGE}: a search chooses its points itself")
        ends, is_log = (finite_number(low), finite_number(high)), bool(rest)
    elif isinstance(given, tuple) and len(given) == 2:
        ends = (finite_number(given[0]), finite_number(given[1]))
    else:
        parts = given.split(",") if isinstance(given, str) else np.ravel(given).tolist()
        values = sorted(map(finite_number, parts))
        if len(set(values)) < max(2, len(values)):
            raise ValueError("needs at least two different values to choose from, or a range LOW:HIGH")
        return Variable(key.name, values[0], values[-1], values=tuple(values))
    low_end, high_end = ends
    if not low_end < high_end:
        raise ValueError(f"is not a range: {low_end:g} is not below {high_end:g}")
    if is_log and low_end <= 0.0:
        raise ValueError(f"starts at {low_end:g}: a logarithmic range needs a start above zero")
    if key.name in WHOLE:
        least, most = BALL_COUNT_RANGE
        if low_end < least or high_end > most:
            raise ValueError(f"is beyond what a bearing has: {least} to {most} balls")
        whole = tuple(float(value) for value in range(ceil(low_end), floor(high_end) + 1))
        if len(whole) < 2:
            raise ValueError("holds fewer than two whole numbers")
        return Variable(key.name, whole[0], whole[-1], values=whole)
    return Variable(key.name, low_end, high_end, is_log)


def _condition(kind: str, text: str, senses: tuple[str, ...], errors: list[FileErrorDetail]) -> Condition | None:
    form = f"NAME{senses[0]}VALUE"
    match = _CONDITION.fullmatch(text)
    try:
        if match is None:
            raise ValueError(f"is not of the form {form}")
        name, sense, value = match.groups()
        sense = {"<": "<=", ">": ">=", "==": "="}.get(sense, sense)
        if sense not in senses:
            other = "limit" if kind == "goal" else "goal"
            raise ValueError(f"is a {other}: a {kind} is {form}")
        return Condition(name, sense, finite_number(value))
    except ValueError as error:
        errors.append(FileErrorDetail(kind, str(error), text))
        return None
