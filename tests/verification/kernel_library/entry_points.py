"""What a library exports: for each entry a function of arrays of 64-bit slots, in LLVM's intermediate code.

It is given objects of Python for arrays, then numbers as they are. From the structures that numpy declares for compiled
code it reads whether the arrays are of the declared kinds, and what numba's function takes for an array: what it may
own (nothing here), how many elements and how large, data, dimensions, strides. Arrays are in C order, so strides follow
from the dimensions.
"""

from __future__ import annotations

from typing import Any

from numba.core import types

from qsbearing.model.compiler.compiled import CompiledEntry
from qsbearing.model.compiler.kinds import NEEDED, Array
from qsbearing.model.compiler.machine_code import DATA, DIMENSION_COUNT, DIMENSIONS, DTYPE, FLAGS, REFUSED, TYPE

PREFIX = "qsk_"


def letters(returned: Any) -> str:
    """The numbers that a function returns, in the letters of `struct`."""
    if isinstance(returned, types.NoneType):
        return ""
    parts = list(returned) if isinstance(returned, types.BaseTuple) else [returned]
    return "".join({types.float64: "d", types.int64: "q"}[each] for each in parts)


class EntryPoint:
    """One of them.

    Args:
        name: of numba's function.
        returns: the letters of what it returns.
    """

    def __init__(self, entry: CompiledEntry, name: str, returns: str) -> None:
        self.symbol = PREFIX + entry.name.removeprefix("qsbearing.").replace(".", "_")
        self._lines: list[str] = []
        self._types, self._given = ["ptr", "ptr"], ["ptr %results" if returns else "ptr %nothing", "ptr %exception"]
        kinds = entry.flat_kinds
        arrays = [kind for kind in kinds if isinstance(kind, Array)]
        for place in range(len(arrays)):
            self._line(f"%object{place} = {self._slot('slots', place, 'ptr')}")
        self._check(arrays)
        places = {True: iter(range(len(arrays))), False: iter(range(len(arrays), len(kinds)))}
        for kind in kinds:
            is_array = isinstance(kind, Array)
            (self._take_array if is_array else self._take_number)(next(places[is_array]), kind)
        self.text = "\n".join(
            [
                f'declare i32 @"{name}"({", ".join(self._types)})',
                f"define dllexport i32 @{self.symbol}(ptr %results, ptr %slots, ptr %expected) {{",
                "  %exception = alloca ptr",
                "  %nothing = alloca ptr",
                *self._lines,
                f'  %status = call i32 @"{name}"({", ".join(self._given)})',
                "  ret i32 %status",
                "refused:",
                f"  ret i32 {REFUSED}",
                "}",
            ]
        )

    def _check(self, arrays: list[Array]) -> None:
        """That what is given as arrays is of numpy's type, and then of the declared kinds."""
        self._line("%unchecked = icmp eq ptr %expected, null")
        self._line("br i1 %unchecked, label %run, label %types")
        self._line("types:")
        type_of_all = self._slot("expected", len(arrays), "ptr")
        self._line(f"%type = {type_of_all}")
        for place in range(len(arrays)):
            found = self._field(f"%object{place}", TYPE, "ptr")
            self._refuse_unless("ptr", found, "%type")
        for place, kind in enumerate(arrays):
            self._refuse_unless("i32", self._field(f"%object{place}", DIMENSION_COUNT, "i32"), str(kind.ndim))
            flags = self._made(f"and i32 {self._field(f'%object{place}', FLAGS, 'i32')}, {NEEDED}")
            self._refuse_unless("i32", flags, str(NEEDED))
            dtype = self._made(self._slot("expected", place, "ptr"))
            self._refuse_unless("ptr", self._field(f"%object{place}", DTYPE, "ptr"), dtype)
        self._line("br label %run")
        self._line("run:")

    def _refuse_unless(self, kind: str, one: str, other: str) -> None:
        same, following = self._made(f"icmp eq {kind} {one}, {other}"), f"next{len(self._lines)}"
        self._line(f"br i1 {same}, label %{following}, label %refused")
        self._line(f"{following}:")

    def _take_number(self, place: int, kind: type) -> None:
        if kind is bool:
            self._give("i1", self._made(f"trunc i64 {self._made(self._slot('slots', place, 'i64'))} to i1"))
        else:
            of = "double" if kind is float else "i64"
            self._give(of, self._made(self._slot("slots", place, of)))

    def _take_array(self, place: int, kind: Array) -> None:
        data = self._field(f"%object{place}", DATA, "ptr")
        dimensions = self._field(f"%object{place}", DIMENSIONS, "ptr")
        shape = [self._field(dimensions, 8 * axis, "i64") for axis in range(kind.ndim)]
        size, items = str(kind.dtype.itemsize), "1"
        strides: list[str] = []
        stride = size
        for of_axis in reversed(shape):
            strides.insert(0, stride)
            stride, items = self._made(f"mul i64 {stride}, {of_axis}"), self._made(f"mul i64 {items}, {of_axis}")
        for of_part, part in (("ptr", "null"), ("ptr", "null"), ("i64", items), ("i64", size), ("ptr", data)):
            self._give(of_part, part)
        for each in (*shape, *strides):
            self._give("i64", each)

    def _slot(self, array: str, place: int, kind: str) -> str:
        return f"load {kind}, ptr {self._made(f'getelementptr i64, ptr %{array}, i64 {place}')}"

    def _field(self, of: str, offset: int, kind: str) -> str:
        return self._made(f"load {kind}, ptr {self._made(f'getelementptr i8, ptr {of}, i64 {offset}')}")

    def _made(self, instruction: str) -> str:
        """The name of what an instruction makes."""
        name = f"%v{len(self._lines)}"
        self._line(f"{name} = {instruction}")
        return name

    def _give(self, kind: str, value: str) -> None:
        self._types.append(kind)
        self._given.append(f"{kind} {value}")

    def _line(self, text: str) -> None:
        self._lines.append(f"  {text}")
