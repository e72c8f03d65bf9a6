"""A remark on results, as data: its code, whom it is about, its numbers. Words are filled in when somebody reads it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.validation import Field
from qsbearing.remarks.kinds import Kind, Severity
from qsbearing.remarks.wording import PYTHON, Balls, Raceways, Words, capital, listed, numbered


@dataclass(frozen=True)
class Cases:
    """In how many of several cases a remark holds; its numbers are those of the first."""

    count: int
    of: int
    first: tuple[int, ...]
    what: str = "cases"
    """What they are, where their numbers are not known to whoever reads it."""

    @property
    def words(self) -> str:
        """As sentences begin with them."""
        if self.count == self.of > 1 or self.what != "cases":
            which = f"all {self.of}" if self.count == self.of else f"{self.count} of {self.of}"
            return f"For {which} {self.what}"
        return f"{self.count} of {self.of} cases, the first {self.first[0] if len(self.first) == 1 else self.first}"


EITHER_WAY = {"both": "carries both ways", "none": "floats"}
"""Of rows that do not carry one way."""


@dataclass(frozen=True)
class Of:
    """Whom a remark is about; empty where there is nothing to tell apart."""

    bearings: tuple[str, ...] = ()
    """Of several that are compared, by their labels."""
    points: tuple[int, ...] = ()
    """Of a load spectrum, from 1."""
    rows: tuple[int, ...] = ()
    """Of a set, from 1."""
    bearing: str = ""
    """Of the one row."""
    carries: str = ""
    """Of the one row, the direction in which it carries."""
    readings: tuple[str, ...] = ()
    raceways: tuple[str, ...] = ()
    """inner, outer"""
    balls: Balls | None = None
    cases: Cases | None = None

    @property
    def row(self) -> str:
        """The rows as sentences name them."""
        way = EITHER_WAY.get(self.carries, self.carries and f"carries {self.carries}")
        beside = ", ".join(filter(None, (self.bearing, way)))
        return numbered("row", self.rows) + (f" ({beside})" if beside else "")

    def about(self, axis: str, places: tuple[Any, ...]) -> Of:
        """The same, but about these rows, raceways, ..."""
        changes: dict[str, Any] = {axis: places}
        if axis == "rows":
            changes |= {"bearing": "", "carries": ""}
        return replace(self, **changes)

    def record(self) -> dict[str, Any]:
        """As JSON has it: what there is to tell."""
        record = {each.name: getattr(self, each.name) for each in fields(self)}
        if self.balls is not None:
            record["balls"] = self.balls.numbers
        if self.cases is not None:
            record["cases"] = vars(self.cases)
        return {name: value for name, value in record.items() if value}


def of_row(row: Any, number: int) -> Of:
    """A row of a set, counted from 0."""
    return Of(rows=(number + 1,), bearing=row.bearing.name or "", carries=str(row.carries))


def row_name(row: Any, number: int) -> str:
    """A row of a set as sentences name it."""
    return of_row(row, number).row


class RemarkRecord(TypedDict):
    """A remark as JSON has it."""

    code: str
    severity: str
    """Of `Severity`, in small letters."""
    of: dict[str, Any]
    """What of `Of` there is to tell."""
    values: dict[str, Any]
    """null for a number that is not finite."""
    text: str
    paste: str
    """A line to be pasted."""


@dataclass(frozen=True)
class Remark:
    """What there is to beware of in a result, or to know of it."""

    kind: Kind
    of: Of = Of()
    values: Mapping[str, Any] = field(default_factory=dict)
    """Numbers in the units of their names, names, and choices."""

    @property
    def code(self) -> str:
        """By which programs know what is said."""
        return self.kind.code

    @property
    def text(self) -> str:
        """The sentence, and whom it is about, for readers of Python."""
        return self.written(PYTHON)

    def written(self, words: Words) -> str:
        """The sentence, and whom it is about, in somebody's words."""
        of = self.of
        names_row = len(of.rows) == 1 and of.carries and self.kind.names_row
        who = of.row if names_row else "each" if of.rows else "the bearing"
        beside = {"who": who, "raceways": Raceways(of.raceways), "balls": of.balls}
        path = f"readings.{of.readings[0]}." if of.readings else ""
        said = self.kind.text({**self.values, **beside}, words, path)
        if of.cases is not None:
            said = f"{of.cases.words}: {said}"
        if of.rows and not names_row:
            said = f"{capital(of.row)}: {said}"
        if of.points:
            said = f"{capital(numbered('point', of.points))}: {said}"
        return f"{listed(of.bearings)}: {said}" if of.bearings else said

    def said(self, words: Words = PYTHON) -> Warned:
        """In words, as `qs.warnings` gives it."""
        return Warned(self.written(words), self)

    def record(self, words: Words) -> RemarkRecord:
        """As JSON has it."""
        return {
            "code": self.code,
            "severity": self.kind.severity.name.lower(),
            "of": self.of.record(),
            "values": {name: _plain(value, words) for name, value in self.values.items()},
            "text": self.written(words),
            "paste": self.paste(words),
        }

    def paste(self, words: Words) -> str:
        """A line to be pasted: an option that does what it asks for, or the command that says more."""
        is_of_whole = not self.of.rows and not self.of.bearings
        return self.kind.pasted(self.values, words) if is_of_whole else f"qsbearing guide {self.kind.see}"


class Warned(str):
    """A remark in words; a `str`, so that lists of warnings and JSON hold sentences and nothing else."""

    remark: Remark

    def __new__(cls, text: str, remark: Remark) -> Warned:
        warned = super().__new__(cls, text)
        warned.remark = remark
        return warned

    def __reduce__(self) -> tuple[Any, ...]:
        return Warned, (str(self), self.remark)

    @property
    def rank(self) -> Severity:
        """How much it matters."""
        return self.remark.kind.severity

    @property
    def see(self) -> str:
        """Page of the guide, and its section behind a #."""
        return self.remark.kind.see

    @property
    def line(self) -> str:
        """As people read it: how much it matters, the sentence, and where the guide says more."""
        is_word = self.partition(" ")[0].islower()  # not a symbol, as aISO
        begun = capital(self) if is_word else self
        return f"{self.rank.words}: {begun.removesuffix('.')} (see qsbearing guide {self.see})."


def remark(kind: Kind, /, raceway: str = "", balls: ArrayLike | None = None, **values: Any) -> Remark:
    """A remark on a single bearing.

    Args:
        raceway: inner or outer, where it is about one.
        balls: which of them it is about, where it is about some.
        values: its numbers, in the units of their names.
    """
    of = Of(raceways=(raceway,) if raceway else (), balls=None if balls is None else some_balls(balls))
    return Remark(kind, of, values)


def some_balls(which: ArrayLike) -> Balls:
    """Those that are marked; shape (ball,)."""
    return Balls(tuple(map(int, np.flatnonzero(which))), np.size(which))


Holding = tuple[ArrayLike, Remark | Callable[[int], Remark]]
"""Where a remark holds, or by how much (0: not at all), and the remark; or what makes that of a case by its number
along the flattened axes."""
Remarks = tuple[tuple[NDArray, Remark | Callable[[int], Remark]], ...]
"""Those of a reading: where each holds, or by how much, of shape (*cases), or () where it holds of all alike; and the
remark."""


def remarks(holding: Iterable[Holding], shape: tuple[int, ...]) -> Remarks:
    """What holds in some case.

    Args:
        holding: where each holds, which broadcasts to the case axes.
        shape: the case axes of the solution; none for a single case, or for what holds of all alike.
    """
    marked = [(np.broadcast_to(np.asarray(where), shape), each) for where, each in holding]
    return tuple((where, each) for where, each in marked if where.any())


def told(holding: Iterable[Holding], place: tuple[int, ...] | None) -> list[Remark]:
    """What holds of a case, what matters most first; without a place of several, in how many cases each holds."""
    said = []
    for where, each in holding:
        where, at = np.asarray(where), 0
        if place is not None and where.shape:
            where, at = where[place], int(np.ravel_multi_index(place, where.shape))
        numbers = np.flatnonzero(where)
        if not numbers.size:
            continue
        one = each if isinstance(each, Remark) else each(at + int(numbers[0]))
        if where.shape:
            first = tuple(map(int, np.unravel_index(numbers[0], where.shape)))
            one = replace(one, of=replace(one.of, cases=Cases(numbers.size, where.size, first)))
        said.append(one)
    return in_order(said)


def in_order(said: Iterable[Remark]) -> list[Remark]:
    """What matters most first, else as they come."""
    return sorted(said, key=lambda each: each.kind.severity)


class Remarked:
    """A reading that has something to say of its numbers."""

    remarks: Remarks
    """Each with the cases in which it holds; `warnings` says them in sentences."""

    @property
    def warnings(self) -> tuple[Warned, ...]:
        """Where its numbers leave the range of their source, and what was assumed; of several cases, in how many."""
        return tuple(each.said() for each in told(self.remarks, None))


def _plain(value: Any, words: Words) -> Any:
    if isinstance(value, Field):
        return words.spell(value, "")
    if isinstance(value, str | bool):
        return value
    if isinstance(value, Sequence):
        return [_plain(each, words) for each in value]
    return float(value) if np.isfinite(value) else None
