"""What each reading states about itself, in its own file: its arguments, what it takes, and how its numbers are shown.

A new reading is a file with its `ENTRY`, and two lines in `asked`, which imports and lists it: files, text, JSON, CSV,
reports, studies, `qsbearing init` and the guide follow.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

from numpy.typing import NDArray

from qsbearing.model.bearing import BallBearing
from qsbearing.model.described import Input, inputs_of
from qsbearing.model.scene.arched_rings import reading_errors
from qsbearing.model.solution.result_keys import BALL, Group, Place, Result
from qsbearing.model.solution.solution import Solution
from qsbearing.model.validation import ErrorDetail, Quantity, check_kind, raise_if_any, within


class Checked(Protocol):
    """The arguments of a reading: a frozen record that says what is wrong with it."""

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """Everything; what depends on the bearing is not judged where there is none yet."""
        ...


@dataclass(frozen=True)
class NoArguments:
    """Of a reading that needs no numbers."""

    def errors(self, bearing: BallBearing | None) -> list[ErrorDetail]:
        """None."""
        return []


def check_solution(call: str, solution: object) -> None:
    """See that a reading was given a solution whose contacts it knows.

    Raises:
        TypeError: it is no solution.
        SceneError: it is one of a four-point bearing, and the reading knows one contact with each ring.
    """
    check_kind(call, solution, "Solution")
    if solution.scene.bearing.is_arched:  # type: ignore[attr-defined]
        raise_if_any(reading_errors([call]))


P = ParamSpec("P")
A = TypeVar("A", bound=Checked)
R = TypeVar("R")


def with_arguments(
    record: Callable[P, A],
) -> Callable[[Callable[[Solution, A], R]], Callable[Concatenate[Solution, P], R]]:
    """Let a function of a solution and a record take the record's fields, checked first: SceneError with all errors."""

    def of(function: Callable[[Solution, A], R]) -> Callable[Concatenate[Solution, P], R]:
        @functools.wraps(function)
        def take(solution: Solution, *fields: P.args, **named: P.kwargs) -> R:
            check_solution(function.__name__, solution)
            given = record(*fields, **named)
            raise_if_any(given.errors(solution.scene.bearing))
            return function(solution, given)

        own = inspect.signature(function)
        parameters = [next(iter(own.parameters.values())), *inspect.signature(record).parameters.values()]
        take.__signature__ = own.replace(parameters=parameters)  # type: ignore[attr-defined]
        return take

    return of


def both_or_neither(pair: Mapping[str, tuple[Any, Quantity, float, float]], cause: str) -> list[ErrorDetail]:
    """Errors of numbers that mean something only together.

    Args:
        pair: value, quantity and range of each; None: not given.
    """
    errors: list[ErrorDetail] = []
    for name, (value, quantity, low, high) in pair.items():
        if value is not None:
            errors += within(name, value, quantity, low, high)
        elif any(other is not None for other, *_ in pair.values()):
            errors.append(ErrorDetail(name, "missing", cause=cause))
    return errors


Take = Callable[[Solution, Any, Mapping[str, Any]], Any]
"""From a solution, the arguments' record and what is taken already, by name."""


def simply(function: Callable[..., Any]) -> Take:
    """How a function is taken that rests on no other reading: one of `with_arguments`, or of a solution alone."""
    own = inspect.unwrap(function)
    if own is function:
        return lambda solution, given, taken: function(solution)
    return lambda solution, given, taken: own(solution, given)


@dataclass(frozen=True)
class ReadingTable:
    """What a table within [readings] of a scene file holds."""

    choices: tuple[str, ...] = ()
    """Words."""
    example: str = ""
    """Its lines in the file of `qsbearing init`; empty for a reading that needs no numbers, which `true` asks for."""
    note: str = ""
    """Beside its heading there."""
    inputs: tuple[Input, ...] = ()
    """Numbers; left out, those that the reading's record takes."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Reading:
    """A reading that a scene asks for by name."""

    name: str
    gives: str
    """What it gives, in the guide's list."""
    by: str
    """By what source."""
    take: Take
    record: Callable[..., Checked] = NoArguments
    """Makes the record of its arguments, in SI; one named `oil` is that of [readings.lubricant]."""
    table: ReadingTable | None = ReadingTable()
    """In a scene file; None: it has none there."""
    needs: tuple[tuple[str, ...], tuple[str, ...]] = (), ()
    """Arrays of contacts and of balls that it takes from the solution."""
    of_case: tuple[Result, ...] = ()
    """Numbers of the whole bearing; arrays of shape (*cases)."""
    of_contact: tuple[Result, ...] = ()
    """Of each contact, inner and outer; arrays of shape (*cases, ball)."""
    of_ball: tuple[Result, ...] = ()
    """Of each ball; arrays of shape (*cases, ball)."""
    scope: str = ""
    """A sentence below its tables, where its name does not state what it covers."""

    @functools.cached_property
    def in_file(self) -> ReadingTable | None:
        """Its table in a scene file, with the numbers that its record takes; None: it has none there."""
        return self.table and replace(self.table, inputs=self.table.inputs or inputs_of(self.record))

    @functools.cached_property
    def parameters(self) -> Mapping[str, inspect.Parameter]:
        """Of its record."""
        return inspect.signature(self.record).parameters

    @property
    def needs_oil(self) -> bool:
        """Whether it cannot do without an oil."""
        return "oil" in self.parameters and self.parameters["oil"].default is inspect.Parameter.empty

    def arguments(self, given: Mapping[str, Any], oil: Any) -> Checked:
        """The record of what a scene gives; None stands for what is missing, which the record's check then says."""
        own = self.parameters
        missing = [name for name, each in own.items() if each.default is each.empty and each.kind != each.VAR_KEYWORD]
        return self.record(**dict.fromkeys(missing) | dict(given) | ({"oil": oil} if "oil" in own else {}))

    @functools.cached_property
    def groups(self) -> tuple[Group, ...]:
        """All its results, the bearing's first."""
        table, of = ("readings", self.name), self.name
        whole = Group(self.of_case, prefix=of, holder=of, table=table, reading=of, source=self.by, by_words=True)
        balls = whole._replace(results=self.of_contact, axis=BALL, table=(*table, "balls"))
        sides = (
            balls._replace(raceway=side, holder=f"{of}.{side}", table=(*table, "balls", side))
            for side in ("inner", "outer")
        )
        every = whole, *sides, balls._replace(results=self.of_ball)
        return tuple(each for each in every if each.results)

    def values(self, result: Any) -> Iterator[tuple[Place, NDArray | None]]:
        """Each with the values of a result; None where that has none."""
        for group in self.groups:
            yield from ((Place(group, each), values) for each, values in group.values(None, {self.name: result}))
