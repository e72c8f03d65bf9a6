"""Records as plain objects: what a function reads and writes is what it would on numpy's records."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from qsbearing.model.compiler import plain_records
from qsbearing.model.kernel.case import record

THING = record(
    ("number", np.float64),
    ("code", np.int8),
    ("is_so", np.bool_),
    ("several", np.float64, (3,)),
    ("matrix", np.float64, (2, 2)),
)


class Pair(NamedTuple):
    things: Any
    numbers: Any


def change(things: Any, pair: Pair, numbers: Any) -> float:
    """By all ways in which the kernel looks at its arguments."""
    row = things[1]
    for k in range(row.size):
        thing = things[1, k]
        thing.number += 0.5 * row[k].code
        thing.code, thing.is_so = k + 1, not thing.is_so
        thing.several[k] = thing.matrix[1, 0] = thing.number
    pair.things[0].number = pair.numbers[1, 0]
    pair.numbers[1, 1] = things.shape[0]
    numbers[:, 0] = 7.0
    return float(things[1, 0].number)


def arguments() -> tuple[Any, ...]:
    things, others = np.zeros((2, 3), THING), np.zeros(1, THING)
    things["number"], things["code"] = np.arange(6.0).reshape(2, 3), 4
    return things, Pair(others, np.arange(4.0).reshape(2, 2)), np.zeros((2, 2))


def as_bytes(args: tuple[Any, ...]) -> list[bytes]:
    things, (others, inside), numbers = args
    return [each.tobytes() for each in (things, others, inside, numbers)]


def test_what_a_function_does_is_the_same() -> None:
    expected, found = arguments(), arguments()
    assert plain_records.call(change, found) == change(*expected)
    assert as_bytes(found) == as_bytes(expected)
    assert as_bytes(found) != as_bytes(arguments())


def test_numbers_are_python_s_own() -> None:
    kinds = []
    plain_records.call(
        lambda things: kinds.append([type(getattr(things[0], name)) for name in THING.names]), (np.zeros(1, THING),)
    )
    assert kinds == [[float, int, bool, memoryview, memoryview]]


@pytest.mark.parametrize("value", [0.0, -8.0])
def test_what_python_refuses_numpy_gives_from_the_beginning(value: float) -> None:
    """A division by zero, and a power that is complex."""
    one = np.ones(1, THING)

    def invalid(things: Any) -> None:
        thing = things[0]
        thing.several[0] += 1.0
        thing.number += value - 1.0
        thing.matrix[0, 0] = 1.0 / thing.number if value == 0.0 else thing.number ** (1.0 / 3.0)

    with np.errstate(all="ignore"):
        plain_records.call(invalid, (one,))
    assert one["several"][0].tolist() == [2.0, 1.0, 1.0]
    assert one["number"] == value
    assert not np.isfinite(one["matrix"][0, 0, 0])
