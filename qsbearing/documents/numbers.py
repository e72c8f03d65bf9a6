"""Numbers and times as people read them: no power of ten where a few places do."""

from __future__ import annotations

import math
import re
from decimal import Decimal

LEAST, MOST = 1e-7, 1e9
"""Sizes between which a number is written without a power of ten."""
UNITS = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3), ("µs", 1e-6))
LEAST_OF = (99.5 * 60.0, 99.5, 0.0995, 9.95e-5, 0.0)
"""Times from which each of them suits [s]."""


def plain(number: float, spec: str = ".5g") -> str:
    """In so many digits, as 250 and 0.00004, where `format` gives 2.5e+02 and 4e-05.

    Args:
        spec: a format specification.
    """
    text = format(number, spec)
    if "e" not in text or not LEAST <= abs(number) < MOST:
        return text
    return format(Decimal(text.strip()), "+f" if "+" in spec else "f")


MINUS = "\N{MINUS SIGN}"
_HYPHEN = re.compile(r"(?<![\w.)\]\-])-(?=\.?\d|∞)|(?<=\de)-(?=\d)")
"""That of a number and of its power of ten, neither within a name or a date nor in a range."""


def with_minus(text: str) -> str:
    """A text whose numbers have the sign of minus in place of a hyphen; nothing that programs read."""
    return _HYPHEN.sub(MINUS, text) if "-" in text else text


def that_matter(number: float) -> str:
    """In three digits, whole numbers below ten thousand in all of theirs; thousands apart from there on."""
    if not math.isfinite(number):
        return "-"
    size = abs(number)
    if size < 100.0:
        return plain(number + 0.0, ".3g")
    return f"{number:.0f}" if size < 1e4 else f"{float(f'{number:.3g}'):,.0f}"


def unit_of(seconds: float) -> tuple[str, float]:
    """The unit that suits a time, in which it has one or two places before the point, and its size [s]."""
    return next((unit for unit, least in zip(UNITS, LEAST_OF, strict=True) if seconds >= least))


def duration(seconds: float) -> str:
    """A time in two digits, in a unit that suits it."""
    unit, size = unit_of(seconds)
    return f"{plain(seconds / size, '.2g')} {unit}"
