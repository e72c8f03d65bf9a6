"""What all remarks of one code have in common: how much they matter, where the guide says more, and their sentence.

A kind is described once, where its numbers are known, and is then listed in the guide. Codes stand in JSON and in the
guide (guide/remarks.md): they are never renamed. A sentence is a format string over the remark's values, which are in
the units of their names, over whom it is about, {who}, {raceways}, {balls}, and over a field in the words of whoever
reads it: {field}.
"""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from string import Formatter
from typing import Any

from qsbearing.documents.numbers import plain
from qsbearing.model.validation import Field
from qsbearing.remarks.wording import Audience, Raceways, Words


class Severity(IntEnum):
    """How much a remark matters, what matters most first."""

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
        return self.name.replace("_", " ").capitalize() if self is not Severity.CHECK_DATA else "Check your data"

    @property
    def status(self) -> str:
        """Of a remark in a document."""
        return "note" if self is Severity.GOOD_TO_KNOW else "warning"


WRONG, INCOMPLETE, CHECK, NOTE = Severity

_NO_FIELD = Field()
BESIDE = ("who", "raceways", "balls", "field")
"""What sentences have beside the values of a remark."""
SEE_STATUSES, SEE_HEAT = "how_to#meaning-of-each-status", "how_to#heat-fits-and-rotation"
SEE_HYPOTHESES, SEE_AXIS, SEE_CHOICES = "limits#hypotheses", "ball_axis", "readings#choices-that-change-the-numbers"
SEE_PRELOAD, SEE_RINGS, SEE_ROUND = "sets#preload", "elastic_rings", "how_to#seats-out-of-round"


@dataclass(frozen=True)
class Kind:
    """All remarks of one code."""

    code: str
    severity: Severity
    see: str
    """Page of the guide, and its section behind a #."""
    sentence: str
    """A format string."""
    more: str = ""
    """A second one, of remarks that have its values."""
    say: Callable[[Mapping[str, Any], Words], str] | None = None
    """What makes the sentence where a format string cannot."""
    field: Field = _NO_FIELD
    """What to give, {field} in the sentence."""
    setting: str | Callable[[Mapping[str, Any], Words], list[str]] = ""
    """What does what it asks for, in a file: a key and its value, over the remark's values, or what makes such lines.
    Remarks without one point to the guide."""

    def __post_init__(self) -> None:
        KINDS[self.code] = self

    def text(self, values: Mapping[str, Any], words: Words, path: str = "") -> str:
        """The sentence with these in it, and fields in somebody's words.

        Args:
            path: of a field beside those that it names.
        """
        if self.say is not None:
            return self.say(values, words)
        more = self.more if all(name in values for name in _fields(self.more)) else ""
        return _IN_WORDS.vformat(self.sentence + more, (), {**values, "field": words.spell(self.field, path)})

    def outline(self, words: Words) -> str:
        """The sentence with … for each number."""
        blank = _Blank(who="the bearing", raceways=Raceways(("…",)), field=words.spell(self.field, ""))
        return (self.sentence + self.more).format_map(blank)

    def settings(self, values: Mapping[str, Any], words: Words) -> list[str]:
        """Keys with values, as they stand behind an option of the command."""
        if isinstance(self.setting, str):
            return [self.setting.format_map(values)] if self.setting else []
        return self.setting(values, words)

    def pasted(self, values: Mapping[str, Any], words: Words, see: str = "") -> str:
        """The line that a remark with these values ends with, to be pasted: options that do what it asks for, or the
        command that says more.

        Args:
            see: page of the guide in place of its own.
        """
        settings = self.settings(values, words) if words.reader is Audience.FILE else []
        options = [word for each in settings for word in ("--set", each)]
        return shlex.join(options) if options else f"qsbearing guide {see or self.see}"

    @property
    def values(self) -> tuple[str, ...]:
        """What remarks of this kind have beside whom they are about."""
        return tuple(name for name in _fields(self.sentence + self.more) if name not in BESIDE)

    @property
    def names_row(self) -> bool:
        """Whether the sentence itself names the row that it is about."""
        return "who" in _fields(self.sentence)


KINDS: dict[str, Kind] = {}
"""By their codes; each enters itself, once the file that describes it is imported."""


class _Blank(dict[str, Any]):
    """Stands for each number of a sentence."""

    def __missing__(self, name: str) -> _Blank:
        return self

    def __format__(self, spec: str) -> str:
        return f"… balls {spec.partition('/')[2]}" if "/" in spec else "…"


class _InWords(Formatter):
    """Of numbers without powers of ten."""

    def format_field(self, value: Any, spec: str) -> str:
        return plain(value, spec) if isinstance(value, float | int) and spec else format(value, spec)


_IN_WORDS = _InWords()


def in_words(number: float, spec: str) -> str:
    """A number as sentences have it, without a power of ten."""
    return _IN_WORDS.format_field(number, spec)


def _fields(sentence: str) -> list[str]:
    return list(dict.fromkeys(name for _, name, *_ in Formatter().parse(sentence) if name))
