"""A question of page 1, and a requirement that records answer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from fem_check.report.evidence import Kept
from qsbearing.documents.model import Badge


class Question(NamedTuple):
    """A row of page 1: one population, its worst case, its limit."""

    text: str
    see: str
    """The section that has more."""
    records: Sequence[Kept]
    answer: str = ""
    worst: str = ""
    limit: str = ""
    """Empty where nothing is judged, or nothing is on record."""
    basis: str = ""
    """When the limit was set, and from what."""
    verdict: Badge = Badge("not on record", "missing")
    may: str = ""
    """What the version may be used for, where this holds."""
    not_for: str = ""
    """What it is not validated for."""
    missed: str = ""
    """What is on record against it."""


def judged(is_good: bool, word: str = "pass") -> Badge:
    """A verdict."""
    return Badge(word, "pass") if is_good else Badge("missed", "fail")
