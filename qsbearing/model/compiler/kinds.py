"""What an entry takes: the declared kind of each of its arguments, to which machine code is made once.

Machine code trusts what it is given: a number of another width, or an array in another order, would be read as it is.
So every call is checked, however the entry runs, and what differs is a defect of the caller, never a reason to compile.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

C_ORDER, ALIGNED, WRITABLE = 0x1, 0x100, 0x400
NEEDED = C_ORDER | ALIGNED | WRITABLE
"""numpy's flags of an array that machine code takes, whether it writes to it or not."""
NUMBERS: dict[Any, type] = {float: Real, int: Integral, bool: Integral}


@dataclass(frozen=True)
class Array:
    """An array in C order that may be written to."""

    dtype: np.dtype
    ndim: int

    def takes(self, value: Any) -> bool:
        """Whether it is one."""
        return (
            isinstance(value, np.ndarray)
            and value.dtype == self.dtype
            and value.ndim == self.ndim
            and value.flags.num & NEEDED == NEEDED
        )

    def __str__(self) -> str:
        # The layout of a record is what its machine code was made for.
        fields = [f"{name} {of[0].str}{of[0].shape} {of[1]}" for name, of in (self.dtype.fields or {}).items()]
        return f"{self.dtype.itemsize}-byte {', '.join(fields) or self.dtype.str} in {self.ndim} dimensions"


def array_of(dtype: DTypeLike, ndim: int = 1) -> Array:
    """The kind of an array of so many dimensions."""
    return Array(np.dtype(dtype), ndim)


def flat(parts: Iterable[Any]) -> Iterator[Any]:
    """Arguments, or their kinds, those within tuples one after another."""
    for part in parts:
        if isinstance(part, tuple):
            yield from flat(part)
        else:
            yield part


def check(name: str, args: Iterable[Any], kinds: tuple[Any, ...]) -> None:
    """Whether these are arguments for an entry.

    Raises:
        TypeError: one is of another kind than declared.
    """
    given = list(flat(args))
    if len(given) != len(kinds):
        raise TypeError(f"{name}: {len(given)} arguments; it takes {len(kinds)}")
    for place, (value, kind) in enumerate(zip(given, kinds, strict=True)):
        if isinstance(kind, Array) and not kind.takes(value):
            raise TypeError(f"{name}, argument {place}: {described(value)}; it takes {kind}, C order, writable")
        if kind in NUMBERS and not isinstance(value, NUMBERS[kind]):
            raise TypeError(f"{name}, argument {place}: {described(value)}; it takes {kind.__name__}")


def described(value: Any) -> str:
    """What an argument is, for a message."""
    if not isinstance(value, np.ndarray):
        return type(value).__name__
    order = "C order" if value.flags.c_contiguous else "another order"
    return f"{Array(value.dtype, value.ndim)}, {order}, {'writable' if value.flags.writeable else 'read-only'}"


def in_c_order(*arrays: NDArray) -> list[NDArray]:
    """The arrays, or copies in C order, that may be written to."""
    return [np.require(each, requirements=["C", "W"]) for each in arrays]
