"""An entry's machine code, called with Python's objects.

It takes an array of 64-bit slots: for each array the address of its object, whose data, shape and kind it reads from
the structure that numpy declares for compiled code (`PyArrayObject_fields`), then the numbers as they are. What it
returns goes to another array of slots.
"""

from __future__ import annotations

import ctypes
import sys
from operator import itemgetter
from struct import Struct
from typing import Any

import numpy as np

from qsbearing.model.compiler.kinds import Array, check, flat

HEAD = 16
"""Bytes of an object before its own fields, in CPython with its lock."""
TYPE, DATA, DIMENSION_COUNT, DIMENSIONS, DTYPE, FLAGS = 8, HEAD, HEAD + 8, HEAD + 16, HEAD + 40, HEAD + 48
"""Bytes from an object's address to what is read of an array."""
REFUSED = -1000
"""An argument is not of the very kind that it was made for."""
RETURNED = -2
"""Beside 0, numba's code for a return; others are exceptions."""


class MachineCode:
    """One entry of a library.

    Args:
        kinds: of its arguments, flat.
        returns: the numbers that it returns, in the letters of `struct`; "": None.
    """

    def __init__(self, name: str, run: Any, kinds: tuple[Any, ...], returns: str) -> None:
        run.argtypes, run.restype = (ctypes.c_char_p,) * 3, ctypes.c_int32
        self._name, self._run, self._kinds = name, run, kinds
        arrays = [place for place, kind in enumerate(kinds) if isinstance(kind, Array)]
        numbers = [place for place, kind in enumerate(kinds) if not isinstance(kind, Array)]
        self._in_order = itemgetter(*arrays, *numbers)
        self._count = len(arrays)
        self._pack = Struct("=" + "q" * len(arrays) + "".join("d" if kinds[k] is float else "q" for k in numbers)).pack
        self._dtypes = [kinds[place].dtype for place in arrays]
        self._expected = Struct(f"={len(arrays) + 1}q").pack(*map(id, self._dtypes), id(np.ndarray))
        self._returns = Struct(f"={returns}") if returns else None
        self._room = None if self._returns is None else ctypes.c_char * self._returns.size

    def __call__(self, *args: Any) -> Any:
        kinds = self._kinds
        given = args if len(args) == len(kinds) else tuple(flat(args))
        if len(given) != len(kinds):
            check(self._name, given, kinds)
        ordered, count = self._in_order(given), self._count
        try:
            packed = self._pack(*map(id, ordered[:count]), *ordered[count:])
        except Exception:
            check(self._name, given, kinds)
            raise
        room = None if self._room is None else self._room()
        status = self._run(room, packed, self._expected)
        if status == REFUSED:
            check(self._name, given, kinds)  # which lets pass what differs by name alone
            status = self._run(room, packed, None)
        if status not in (0, RETURNED):
            raise RuntimeError(f"{self._name} ended with status {status}")
        if room is None or self._returns is None:
            return None
        found = self._returns.unpack(room)
        return found if len(found) > 1 else found[0]


def reads_arrays() -> bool:
    """Whether arrays of this Python and numpy have the structure that machine code reads."""
    if sys.implementation.name != "cpython" or object.__basicsize__ != HEAD or ctypes.sizeof(ctypes.c_void_p) != 8:
        return False
    probe = np.zeros((3, 5, 7))

    def pointer(offset: int) -> int | None:
        return ctypes.c_void_p.from_address(id(probe) + offset).value

    count, flags = (ctypes.c_int32.from_address(id(probe) + offset).value for offset in (DIMENSION_COUNT, FLAGS))
    if (pointer(TYPE), pointer(DTYPE), count, flags) != (id(np.ndarray), id(probe.dtype), 3, probe.flags.num):
        return False
    return (
        pointer(DATA) == probe.ctypes.data
        and tuple((ctypes.c_int64 * 3).from_address(pointer(DIMENSIONS) or 0)) == probe.shape
    )
