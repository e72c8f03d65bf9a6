"""The records of solved cases, and arrays of contacts and balls: read off them by the kernel, or found with them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler.threads import in_threads
from qsbearing.model.kernel import results as readings
from qsbearing.model.kernel.workspace import working_memory
from qsbearing.model.solution.flatten import CaseMaker

CHUNK = 4096
"""Cases whose records exist at a time while something is read off a large solution."""
KEPT = 5 * CHUNK
"""Solutions of up to this many cases keep all their records, 5 MB: most are read for several things, and making records
takes as long as reading a result."""


class SolvedCases:
    """All flattened cases of a solution as the kernel left them; their records are kept, or made again."""

    def __init__(
        self,
        maker: CaseMaker,
        cases: NDArray | None,
        results: NDArray,
        positions: NDArray,
        controls: NDArray,
        threads: int,
        known: Callable[[], dict[tuple[int, int], NDArray]] | None = None,
    ) -> None:
        self.maker = maker
        self._cases = cases
        self._own: NDArray | None = None
        self.results = results
        self.positions = positions
        self.controls = controls
        self.threads = threads
        """At most so many solved them, and read them off."""
        self._all_known = known
        self.following: Callable[[], NDArray] | None = None
        """What of the stiffness comes from motion that is common to all balls (case, 5, 5); None where each has its
        own."""

    @cached_property
    def _known(self) -> dict[tuple[int, int], NDArray]:
        return {} if self._all_known is None else self._all_known()

    def stretches(self) -> Iterator[tuple[slice, NDArray]]:
        """(slice, case records) of all cases, some at a time."""
        self._keep()
        if self._cases is not None:
            yield slice(0, self.maker.count), self._cases
            return
        for start in range(0, self.maker.count, CHUNK):
            stop = min(start + CHUNK, self.maker.count)
            yield slice(start, stop), self.maker.make(start, stop)

    def in_threads(self, work: Callable[[slice, NDArray], None]) -> None:
        """Do a work for all cases in threads, a stretch and its case records at a time."""
        self._keep()

        def do(part: slice) -> None:
            work(part, self.maker.make(part.start, part.stop) if self._cases is None else self._cases[part])

        in_threads(do, self.maker.count, self.threads)

    def given(
        self, part: slice, cases: NDArray
    ) -> tuple[NDArray, NDArray, NDArray, NDArray, NDArray, NDArray, NDArray]:
        """What the kernel reads of a stretch of cases."""
        memory = working_memory(self.maker.ball_axis)
        own = self.maker.own_balls(cases, part.start) if self._own is None else self._own[part]
        return cases, *memory, self.results[part], self.positions[part], self.controls[part], own

    def read(self, row: int, what: int) -> NDArray:
        """One quantity of all balls (*cases, ball), by the kernel's row and number."""
        self.read_all([(row, what)])
        return self._known[row, what]

    def read_all(self, requested: Iterable[tuple[int, int]]) -> None:
        """Read off, in threads, what is not known yet of these quantities."""
        missing = [each for each in requested if each not in self._known]
        if not missing:
            return
        if self._all_known is not None:
            raise KeyError(f"balls that friction moves have no {missing[0]}, which the kernel reads off a hypothesis")
        tables = np.full((3, readings.QUANTITIES), readings.NOT_ASKED)
        for table, place in enumerate(missing):
            tables[place] = table
        out = np.empty((len(missing), self.maker.count, self.maker.ball_axis))

        self.in_threads(lambda *part: readings.read_cases(*self.given(*part), tables, out, part[0].start))
        for place, values in zip(missing, out, strict=True):
            self._known[place] = values.reshape(*self.maker.shape, self.maker.ball_axis)

    def _keep(self) -> None:
        if self._cases is None and self.maker.count <= KEPT:
            self._cases = self.maker.make()
        if self._cases is not None and self._own is None:
            self._own = self.maker.own_balls(self._cases)


class OfSolvedCases:
    """What keeps the records of its cases, for `solved_of`."""

    def _keep_solved(self, solved: SolvedCases) -> None:
        self._solved = solved


def solved_of(solution: OfSolvedCases) -> SolvedCases:
    """The records of its cases, for what computes with them; users read results."""
    return solution._solved
