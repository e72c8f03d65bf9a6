"""An entry's machine code, called with Python's objects.

It takes an array of 64-bit slots: for each array the address of its object, whose data, shape and kind it reads from
the structure that numpy declares for compiled code (`PyArrayObject_fields`), then the numbers as they are. What it
returns goes to another array of slots.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable
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


def called(name: str, run: Any, kinds: tuple[Any, ...], returns: str) -> Callable[..., Any]:
    """One entry of a library, as Python calls it.

    Args:
        kinds: of its arguments, flat.
        returns: the numbers that it returns, in the letters of `struct`; "": None.
    """
    run.argtypes, run.restype = (ctypes.c_char_p,) * 3, ctypes.c_int32
    arrays = [place for place, kind in enumerate(kinds) if isinstance(kind, Array)]
    numbers = [place for place, kind in enumerate(kinds) if not isinstance(kind, Array)]
    in_order, count, size = itemgetter(*arrays, *numbers), len(arrays), len(kinds)
    pack = Struct("=" + "q" * count + "".join("d" if kinds[place] is float else "q" for place in numbers)).pack
    expected = Struct(f"={count + 1}q").pack(*(id(kinds[place].dtype) for place in arrays), id(np.ndarray))
    returned = Struct(f"={returns}")
    room_of = ctypes.c_char * returned.size

    def call(*args: Any) -> Any:
        given = args if len(args) == size else tuple(flat(args))
        if len(given) != size:
            check(name, given, kinds)
        ordered = in_order(given)
        try:
            packed = pack(*map(id, ordered[:count]), *ordered[count:])
        except Exception:
            check(name, given, kinds)
            raise
        room = room_of() if returns else None
        status = run(room, packed, expected)
        if status == REFUSED:
            check(name, given, kinds)  # which lets pass what differs by name alone
            status = run(room, packed, None)
        if status != 0 and status != RETURNED:
            raise RuntimeError(f"{name} ended with status {status}")
        if room is None:
            return None
        values = returned.unpack(room)
        return values if len(values) > 1 else values[0]

    return call


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
