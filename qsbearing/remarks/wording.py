"""How numbers, rows, balls and raceways stand in a sentence."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np

from qsbearing.documents.numbers import plain
from qsbearing.model.validation import Field, Sentence


class Audience(StrEnum):
    """Who reads, and so what fields and settings are called."""

    PYTHON = "python"
    FILE = "file"
    PAGE = "page"


class Words(NamedTuple):
    """How a sentence names fields."""

    reader: Audience
    spell: Callable[[Field, str], str]
    """From a field, and a path beside it where its table is not in its name."""

    def of(self, sentence: str, path: str = "") -> str:
        """A sentence in these words."""
        said = lambda each: self.spell(each, path)  # noqa: E731
        return sentence.written(said) if isinstance(sentence, Sentence) else sentence


PYTHON = Words(Audience.PYTHON, lambda field, path: str(field))


class Span(tuple[float, ...]):
    """A number of several things that a sentence speaks of at once; it reads from the smallest to the largest."""

    def __format__(self, spec: str) -> str:
        return spanned(lambda number: plain(number, spec), self)


def spanned(text: Callable[[float], str], number: Any) -> str:
    """A number, or what a `Span` reaches from and to, by the text of each."""
    if not isinstance(number, Span):
        return text(number)
    return " to ".join(dict.fromkeys(text(each) for each in (min(number), max(number))))


class Raceways(tuple[str, ...]):
    """Whose contacts or ring: `{raceways:the}` is "the inner", or "the inner and the outer"."""

    def __format__(self, spec: str) -> str:
        return " and ".join(f"{spec} {each}" for each in self)


@dataclass(frozen=True)
class Balls:
    """Some balls of a bearing."""

    numbers: tuple[int, ...]
    """From 0."""
    total: int
    """How many the bearing has."""

    def __format__(self, spec: str) -> str:
        """As runs of numbers, "3 balls (no. 0, 3 to 4)"; begins a sentence with a verb, singular/plural, if one is
        given."""
        one, _, several = spec.partition("/")
        return f"{capital(self._list())} {one if len(self.numbers) == 1 else several}" if spec else self._list()

    def _list(self) -> str:
        count = len(self.numbers)
        if count == self.total > 1:
            return f"all {count} balls"
        runs = np.split(self.numbers, np.flatnonzero(np.diff(self.numbers) != 1) + 1)
        named = ", ".join(str(run[0]) if run.size == 1 else f"{run[0]} to {run[-1]}" for run in runs)
        return f"{'1 ball' if count == 1 else f'{count} balls'} (no. {named})"


def numbered(word: str, numbers: Sequence[int]) -> str:
    """A word with numbers in their order: row 1, rows 1 and 3, rows 1 to 4."""
    first, last = numbers[0], numbers[-1]
    if len(numbers) == 1:
        return f"{word} {first}"
    if len(numbers) > 2 and last - first == len(numbers) - 1:
        return f"{word}s {first} to {last}"
    return f"{word}s {listed(map(str, numbers))}"


def listed(said: Iterable[str]) -> str:
    """One, two and three."""
    *others, last = said
    return f"{', '.join(others)} and {last}" if others else last


def capital(text: str) -> str:
    """The text as the beginning of a sentence."""
    return text[:1].upper() + text[1:]


def not_capital(text: str) -> str:
    """A sentence as the end of another."""
    return text[:1].lower() + text[1:]
