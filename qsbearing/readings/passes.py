"""What the passes over all contacts take and fill: plain arrays over flattened cases.

A reading has some twenty numbers of each contact. Array expressions would write and read again several temporary
arrays for each of them, which takes as long as the solve; a pass works a contact out in one go. It is compiled for one
kind of arrays, whatever they come from: those in C order that may be written to.
"""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from qsbearing.model.compiler.kinds import in_c_order
from qsbearing.model.compiler.threads import in_threads
from qsbearing.model.solution.solution import Solution

SAME_SHAPE = 1e-13
"""Ellipses of one raceway are alike but for the rounding of their axes, unless Hertz's angle is each ball's own: what
rests on b/a alone is worked out anew only where it differs by more."""


def of_cases(solution: Solution, *values: ArrayLike) -> list[NDArray]:
    """Numbers that broadcast to the case axes, one for each flattened case."""
    return [np.array(np.broadcast_to(value, solution.shape), float, order="C").reshape(-1) for value in values]


def of_balls(*arrays: NDArray) -> list[NDArray]:
    """Arrays over cases and balls, cases flattened."""
    return in_c_order(*(array.reshape(-1, array.shape[-1]) for array in arrays))


def filled(solution: Solution, tables: int, entry: Callable[..., None], *given: Any, of_cases: bool = False) -> NDArray:
    """So many tables, which a pass fills in threads; it is called with begin, stop and the tables last.

    Returns:
        Shape (table, *cases, ball), or of cases alone (table, *cases).
    """
    balls = () if of_cases else solution.azimuth.shape[-1:]
    out = np.empty((tables, prod(solution.shape), *balls))
    in_threads(lambda part: entry(*given, part.start, part.stop, out), out.shape[1], solution.threads)
    return out.reshape(tables, *solution.shape, *balls)
