"""Records as plain Python objects: what the kernel is given when it runs as the Python that it is.

A field of a numpy record takes Python microseconds to reach, an attribute nanoseconds: a plain solve would spend nine
tenths of its time on the way to its numbers. So records become objects that hold Python's numbers, made when the kernel
first looks at them and written back when it returns; several numbers in one field are a view of the array's own memory.

Python's numbers give the digits that numpy's do, but raise where numpy's would be infinite or none, and the root of a
negative number is complex. Neither happens on the way to an equilibrium that is found; where it does, the kernel runs
again, on numpy's records.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.kinds import flat


class Record:
    """One of them."""

    def __init__(self, numbers: dict[str, Any], views: dict[str, NDArray], index: tuple[int, ...]) -> None:
        vars(self).update(numbers, _views=views, _index=index)

    def __getattr__(self, name: str) -> Any:
        """What holds several numbers, when the kernel first looks at it."""
        view = self._views[name][self._index].data
        setattr(self, name, view)
        return view


class Records(dict[Any, Any]):
    """An array of records, as far as the kernel looks at it: by numbers of all axes, or of the first ones."""

    def __init__(self, array: NDArray) -> None:
        super().__init__()
        self.array, self.shape, self.size = array, array.shape, array.size
        single, several, self._names, self._numbers = _fields(array.dtype)
        self._single = array.view(single)
        self._views = {name: array[name] for name in several}

    def __missing__(self, place: Any) -> Any:
        """Made at the first look."""
        index = place if isinstance(place, tuple) else (place,)
        element: Any
        if len(index) < self.array.ndim:
            element = Records(self.array[index])
        else:
            numbers = dict(zip(self._names, self._single.item(*index), strict=True))
            element = Record(numbers, self._views, index)
        self[place] = element
        return element

    def write_back(self) -> None:
        """Into the array."""
        for place, element in self.items():
            if isinstance(element, Records):
                element.write_back()
            else:
                self._single[place] = self._numbers(element)


@cache
def _fields(of: np.dtype) -> tuple[np.dtype, list[str], list[str], Callable[[Any], tuple[Any, ...]]]:
    """(the record without its fields of several numbers, the names of those, the others', what reads the others)."""
    fields = dict(of.fields or {})
    several = [name for name, (kind, *_) in fields.items() if kind.subdtype is not None]
    names = [name for name in fields if name not in several]
    formats, offsets = [fields[name][0] for name in names], [fields[name][1] for name in names]
    single = np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": of.itemsize})
    return single, several, names, attrgetter(*names) if names else lambda _: ()


def call(function: Callable[..., Any], args: tuple[Any, ...]) -> Any:
    """What a function of the kernel returns, its records as plain objects."""
    given = {id(each): each for each in flat(args) if isinstance(each, np.ndarray)}
    before = [array.tobytes() for array in given.values()]
    records = {key: Records(array) for key, array in given.items() if array.dtype.names}
    try:
        returned = function(*(_plain(each, records) for each in args))
    except (ArithmeticError, ValueError, TypeError):
        for array, as_it_was in zip(given.values(), before, strict=True):
            array[...] = np.frombuffer(as_it_was, array.dtype).reshape(array.shape)
        return function(*args)
    for each in records.values():
        each.write_back()
    return returned


def _plain(arg: Any, records: dict[int, Records]) -> Any:
    """Records as objects; within a tuple, also arrays that are always looked at number by number."""
    if not isinstance(arg, tuple):
        return records.get(id(arg), arg)
    parts = [each.data if _is_small(each) else _plain(each, records) for each in arg]
    return arg._make(parts) if hasattr(arg, "_make") else tuple(parts)


def _is_small(arg: Any) -> bool:
    return isinstance(arg, np.ndarray) and arg.ndim <= 2 and not arg.dtype.names
