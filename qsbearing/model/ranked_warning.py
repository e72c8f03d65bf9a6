"""What a warning is: one short sentence, how much it matters, and where the guide says more.

A warning is a `str`, so that lists of warnings and JSON hold sentences and nothing else. Each is made in one place, by
`wrong_model`, `incomplete_model`, `check_data` or `good_to_know`; a plain string among warnings counts as `DEFAULT`.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import IntEnum


def capital(text: str) -> str:
    """The text as the beginning of a sentence."""
    return text[:1].upper() + text[1:]


class Rank(IntEnum):
    """How much a warning matters, what matters most first."""

    WRONG_MODEL = 1
    """The numbers do not describe this case: an equation is used beyond its range."""
    INCOMPLETE_MODEL = 2
    """The numbers would change with an effect that the model does not include."""
    CHECK_DATA = 3
    """The numbers describe what is given, which is unusual: a slip of input, or a design that does not work."""
    GOOD_TO_KNOW = 4
    """The numbers hold; they need a word."""

    @property
    def words(self) -> str:
        """As people read it."""
        return {1: "Wrong model", 2: "Incomplete model", 3: "Check your data", 4: "Good to know"}[self]

    @property
    def status(self) -> str:
        """Of a remark in a document."""
        return "note" if self is Rank.GOOD_TO_KNOW else "warning"


DEFAULT = Rank.CHECK_DATA


class RankedWarning(str):
    """A sentence with its rank."""

    rank: Rank
    see: str
    """Page of the guide, and its section behind a #; empty where there is none."""

    def __new__(cls, text: str, rank: Rank = DEFAULT, see: str = "") -> RankedWarning:
        found = super().__new__(cls, text)
        found.rank, found.see = rank, see
        return found

    @property
    def line(self) -> str:
        """As people read it: how much it matters, the sentence, and where the guide says more."""
        is_word = self.partition(" ")[0].islower()  # not a symbol, as aISO
        begun = capital(self) if is_word else self
        said = f"{self.rank.words}: {begun}".removesuffix(".")
        return f"{said} (see qsbearing guide {self.see})." if self.see else f"{said}."


def wrong_model(text: str, see: str) -> RankedWarning:
    """That the model does not describe this case."""
    return RankedWarning(text, Rank.WRONG_MODEL, see)


def incomplete_model(text: str, see: str) -> RankedWarning:
    """That the model lacks an effect."""
    return RankedWarning(text, Rank.INCOMPLETE_MODEL, see)


def check_data(text: str, see: str) -> RankedWarning:
    """That the input is unusual, or the design does not work."""
    return RankedWarning(text, Rank.CHECK_DATA, see)


def good_to_know(text: str, see: str) -> RankedWarning:
    """What else there is to say."""
    return RankedWarning(text, Rank.GOOD_TO_KNOW, see)


def ranked(text: str) -> RankedWarning:
    """The warning itself; of a plain string one of the default rank."""
    return text if isinstance(text, RankedWarning) else RankedWarning(text)


def said_of(which: str, text: str) -> RankedWarning:
    """The warning, with what it is said of before it."""
    known = ranked(text)
    return RankedWarning(f"{which}: {known}", known.rank, known.see)


def in_order(warnings: Iterable[str]) -> list[RankedWarning]:
    """What matters most first, else as they come."""
    return sorted(map(ranked, warnings), key=lambda each: each.rank)
