"""The pieces of a document: sections of paragraphs, tables, pictures, verdicts.

Text is plain unless it is `Md`: then it may hold emphasis, `code` and [links](#anchor) of Markdown. Names from records
and files stay plain, so that none of their characters means anything.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias


class Md(str):
    """Text with inline Markdown."""

    __slots__ = ()


@dataclass(frozen=True)
class Badge:
    """A verdict in one word, shown as word and colour."""

    word: str
    status: str = ""
    """pass, fail, finding or missing; the word itself if nothing is said."""

    @property
    def kind(self) -> str:
        """The status that its colour stands for."""
        return self.status or self.word


@dataclass(frozen=True)
class Bar:
    """How much of a limit is used, as a bar with a mark at the limit."""

    used: float
    """Part of it."""
    status: str = "pass"
    """As a badge has it."""

    @property
    def word(self) -> str:
        """The part, for those who do not see the bar."""
        return f"{100.0 * self.used:.0f} %" if math.isfinite(self.used) else "-"

    @property
    def length(self) -> float:
        """Part of the room for it, which ends at `LONGEST_BAR`: beyond it, the number tells."""
        return min(max(self.used, 0.0), LONGEST_BAR) / LONGEST_BAR if math.isfinite(self.used) else 0.0


LONGEST_BAR = 1.25
"""Part of a limit at which a bar ends."""

Cell: TypeAlias = "str | Badge | Bar"


@dataclass(frozen=True)
class RowGroup:
    """A row across a whole table, above those that belong to it."""

    text: str


@dataclass(frozen=True)
class Paragraph:
    """A paragraph."""

    text: str
    lead: str = ""
    """What it begins with, which a terminal shows in bold."""
    is_apart: bool = False
    """Whether a terminal has an empty line before it."""
    is_small: bool = False
    """Whether a page has it in small letters."""
    paste: str = ""
    """As that of a `Callout`."""


@dataclass(frozen=True)
class Bullets:
    """A list; numbered if its order matters."""

    items: Sequence[str]
    numbered: bool = False


@dataclass(frozen=True)
class Code:
    """Text as it is typed."""

    text: str
    language: str = ""


@dataclass(frozen=True)
class Callout:
    """A sentence that stands out: a warning, a note, or a verdict with its status."""

    text: str
    status: str = "note"
    lead: str = ""
    """What it begins with, which a terminal shows in bold and in a colour."""
    colour: str = ""
    is_apart: bool = False
    """Whether a terminal has an empty line before it."""
    paste: str = ""
    """A line that does what it asks for, or a command that says more, which a terminal shows below it."""

    @property
    def said(self) -> str:
        """The text without the command that stands below it."""
        before = self.text.removesuffix(f" (see {self.paste}).")
        return self.text if before == self.text else f"{before}."


@dataclass(frozen=True)
class Facts:
    """Names and what they are."""

    pairs: Sequence[tuple[str, Cell]]


@dataclass(frozen=True)
class Trace:
    """Where the numbers above come from: the record, the command that makes it again, and what it was made with."""

    record: str
    command: str
    made_with: str = ""


@dataclass(frozen=True)
class Table:
    """A table; `align` has a letter per column: l, r or c. With `tools` a reader may sort and filter it in HTML.

    With `stack` the cells of a row wrap below each other where an HTML page is too narrow for them side by side.
    """

    headings: Sequence[str]
    rows: Sequence[Sequence[Cell] | RowGroup]
    align: str = ""
    caption: str = ""
    tools: bool = False
    stack: bool = False
    notes: Sequence[tuple[str, str]] = ()
    """Below it: a mark that its rows have, and what it says."""
    faint: Collection[int] = ()
    """Rows, counted from 0, that a terminal shows paler than the others."""
    spare: Sequence[int] = ()
    """Columns, counted from 0, that a terminal too narrow for all leaves out, the first of them first."""

    def __post_init__(self) -> None:
        width = len(self.headings)
        if self.align and len(self.align) != width:
            raise ValueError(f"{len(self.align)} letters of alignment for {width} columns: {self.caption}")
        wrong = [row for row in self.rows if not isinstance(row, RowGroup) and len(row) != width]
        if wrong:
            raise ValueError(f"{len(wrong[0])} cells in a row of {width} columns: {wrong[0]}")
        if self.tools and any(isinstance(row, RowGroup) for row in self.rows):
            raise ValueError("a table that readers may sort has no rows across")

    @property
    def alignment(self) -> str:
        """A letter for every column."""
        return self.align or "l" + "r" * (len(self.headings) - 1)


@dataclass(frozen=True)
class Picture:
    """A picture that is part of the document, and the words for those who do not see it."""

    data: bytes
    alt: str
    caption: str = ""
    form: str = "svg"
    width: float = 1.0
    """Part of the text's width; more than 1: a page scrolls it where letters would become too small."""

    def __post_init__(self) -> None:
        if not self.alt.strip():
            raise ValueError(f"a picture without words for those who do not see it: {self.caption}")


@dataclass(frozen=True)
class Shares:
    """Parts of a whole, by name, as one bar."""

    parts: Sequence[tuple[str, float]]
    """Names and parts, which are 1 together."""


@dataclass(frozen=True)
class Columns:
    """Blocks side by side, where a page is wide enough."""

    columns: Sequence[Sequence[Block]]
    are_fitted: bool = False
    """Whether each is as wide as it is by itself, and as many stand side by side as fit; else all are equally wide."""


@dataclass(frozen=True)
class Section:
    """A heading and what stands below it."""

    title: str
    blocks: Sequence[Block]
    anchor: str = ""
    is_whole: bool = False
    """Whether all of it stands on one page of paper, which it must not be longer than."""
    is_spare: bool = False
    """Whether a front page of paper that has no room for it does without; pages on a screen have it."""

    @property
    def name(self) -> str:
        """What links point at."""
        return self.anchor or anchor_of(self.title)


Block: TypeAlias = "Paragraph | Bullets | Code | Callout | Facts | Trace | Table | Picture | Shares | Columns | Section"


@dataclass(frozen=True)
class Document:
    """A whole document."""

    title: str
    kind: str
    """What it is, in two or three words above the title."""
    sections: Sequence[Section]
    summary: str = ""
    head: Sequence[Block] = field(default_factory=tuple)
    """What stands before the contents: the verdict and the facts about it."""
    depth: int = 2
    """Levels of headings in the table of contents."""
    is_numbered: bool = False
    """Whether tables and pictures with a caption are numbered."""
    made_from: str = ""
    """What the HTML says of its source, for programs."""
    has_front_page: bool = False
    """Whether the head is the first page of paper, by itself."""

    def __post_init__(self) -> None:
        names = [section.name for section, _ in (*_walk(self.head, 1), *self.walk())]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"sections of the same name: {', '.join(twice)}")

    def walk(self) -> Iterator[tuple[Section, int]]:
        """Every section with its level, 1 for the outermost, in the order of reading."""
        yield from _walk(self.sections, 1)

    @property
    def names(self) -> set[str]:
        """What links within it may lead to."""
        return {section.name for section, _ in (*_walk(self.head, 1), *self.walk())}


def _walk(blocks: Sequence[Block], level: int) -> Iterator[tuple[Section, int]]:
    for block in blocks:
        if isinstance(block, Section):
            yield block, level
            yield from _walk(block.blocks, level + 1)
        if isinstance(block, Columns):
            for column in block.columns:
                yield from _walk(column, level)


def anchor_of(title: str) -> str:
    """A title as a name that may stand in a link."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or "section"
