"""Some solved cases, and the functions that tell what holds of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.remarks.remark import Holding, Remark, told


class CaseRange(NamedTuple):
    """Some cases of a solution, one after another along its flattened axes."""

    solution: Any
    part: slice
    may_solve: bool = True
    """Whether cases may be solved again, differently, to tell; else what takes that is left out."""

    def cases(self, values: Any, kind: type = float) -> NDArray:
        """A number of each case, shape (case,), of what broadcasts to the case axes."""
        return np.broadcast_to(np.asarray(values, kind), self.solution.shape).reshape(-1)[self.part]

    def rows(self, array: NDArray) -> NDArray:
        """Those of an array (*cases, ball or channel), with zero for NaN; shape (case, ball or channel)."""
        return np.nan_to_num(array.reshape(-1, array.shape[-1])[self.part], nan=0.0)


Teller = Callable[[CaseRange], Iterable[Holding]]
"""Tells where remarks hold, and that of the i-th of the cases."""


class Subject:
    """All that there is to say of one thing, in the order in which its functions are entered."""

    def __init__(self, *tellers: Teller) -> None:
        self._tellers = [*tellers]

    def tells(self, teller: Teller) -> Teller:
        """Enter a function; above its definition."""
        self._tellers.append(teller)
        return teller

    def __call__(self, of: CaseRange) -> Iterator[Holding]:
        for teller in self._tellers:
            yield from teller(of)


def in_case(solution: Any, teller: Teller, index: Any) -> list[Remark]:
    """What holds of a solved case of a bearing or set; without an index of several, in how many each holds."""
    solved = np.ravel(solution.converged)
    if index is None and solution.shape:
        every = teller(CaseRange(solution, slice(0, solved.size)))
        return told(((np.reshape(np.where(solved, where, 0), solution.shape), each) for where, each in every), None)
    k = solution.flat_index(index)
    one = teller(CaseRange(solution, slice(k, k + 1))) if solved[k] else ()
    return told(((np.asarray(where)[0], each) for where, each in one), None)
