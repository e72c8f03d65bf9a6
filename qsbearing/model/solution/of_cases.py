"""What solutions of a bearing and of a set have in common: cases with a status each, stiffnesses, a preload's state."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.above import Plotted
from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.solution import preload_state
from qsbearing.model.solution.case_index import CasePlace, Index, case_place
from qsbearing.model.solution.preload_state import PreloadLoads
from qsbearing.model.solution.result_keys import DISPLACEMENT, LOAD
from qsbearing.model.solution.status import STATUS_OF_CODE


@dataclass(frozen=True)
class LeftOut:
    """An effect or choice that was left out."""

    effect: str
    """Its name in `qsbearing.model.effects.EFFECTS`."""
    estimated_error: Any
    """Largest relative error of all that is read, expected of leaving it out; shape (*cases)."""


@dataclass(frozen=True)
class Choice:
    """What was asked, what is in the solution and what is not."""

    tolerance: float
    effects: tuple[str, ...]
    """Names of the effects and choices that the solution has, at their finest."""
    added: tuple[str, ...]
    """Those of them that the scene did not name."""
    left_out: tuple[LeftOut, ...]
    solves: int
    """How often the scene was solved to choose."""


class SolutionOfCases(Plotted):
    """Arrays lead with the case axes: none for a single case."""

    choice: Choice | None = None
    """What was chosen and left out where effects were chosen automatically; None where they are named."""
    thermal: Any = None
    """Temperatures and heats (`systems/heat/state.py`), where their steady state is asked for."""

    def __init__(self, shape: tuple[int, ...], seconds: float, solve_alike: Callable[[Any], Any] | None) -> None:
        self.shape = shape
        """Of the case axes; () for a single case."""
        self.seconds = seconds
        """Wall time of the solve [s]."""
        self._solve_alike = solve_alike  # None where nothing is solved besides

    if TYPE_CHECKING:  # what each kind has of its own

        @property
        def iterations(self) -> Any: ...
        @property
        def residual(self) -> Any: ...
        @property
        def displacement(self) -> NDArray: ...
        @property
        def load(self) -> NDArray: ...
        @property
        def stiffness(self) -> NDArray: ...
        @property
        def compliance(self) -> NDArray: ...
        @property
        def preload_loads(self) -> PreloadLoads | None: ...

    @property
    @abstractmethod
    def codes(self) -> NDArray:
        """How each of the flattened cases ended, by the kernel's codes; shape (case)."""

    def _shaped(self, array: NDArray, *tail: int) -> Any:
        shaped = array.reshape(self.shape + tail)
        return shaped[()] if not shaped.shape else shaped

    def place(self, index: Index) -> CasePlace:
        """The index of one case along each case axis.

        Raises:
            ValueError: the index is missing or does not name one case of this solution.
        """
        return case_place(index, self.shape)

    def flat_index(self, index: Index) -> int:
        """The number of a case, counted along the flattened case axes."""
        place = self.place(index)
        return int(np.ravel_multi_index(place, self.shape)) if place else 0

    def _summary(self) -> str:
        return f"{self.status}, {self.iterations} iterations, residual {self.residual:.1e}"

    def _channels(self) -> list[str]:
        """Displacement and load of a single case."""
        shown = []
        for title, results, values in (("displacement", DISPLACEMENT, self.displacement), ("load", LOAD, self.load)):
            channels = (f"{each.key} {np.asarray(each.of(values)) + 0.0:.6g}" for each in results)  # + 0.0: no "-0"
            shown.append(f"  {title}: {', '.join(channels)}")
        return shown

    @property
    def converged(self) -> Any:
        """Whether each case is solved; shape (*cases)."""
        return self._shaped(self.codes == CONVERGED)

    @property
    def status(self) -> Any:
        """`Status` of a single case, or an array of their names; shape (*cases)."""
        if not self.shape:
            return STATUS_OF_CODE[int(self.codes[0])]
        names = np.array([str(STATUS_OF_CODE[code]) for code in sorted(STATUS_OF_CODE)])
        return self._shaped(names[self.codes])

    def counts(self) -> str:
        """How many cases ended how, and the first of each kind that is not solved."""
        shown = []
        for code, status in STATUS_OF_CODE.items():
            cases = np.flatnonzero(self.codes == code)
            if cases.size:
                where = "" if code == CONVERGED else f" (the first: {self._case_name(cases[0])})"
                shown.append(f"{cases.size} {status}{where}")
        return ", ".join(shown)

    def _case_name(self, number: int) -> str:
        place = tuple(map(int, np.unravel_index(number, self.shape)))
        return str(place[0] if len(place) == 1 else place)

    def _known(self, array: NDArray) -> NDArray:
        """Of the flattened cases, NaN where they are not solved."""
        solved = self.codes == CONVERGED
        return np.where(solved.reshape(-1, *[1] * (array.ndim - 1)), array, np.nan)

    @property
    def locked_stiffness(self) -> NDArray:
        """Of each channel while all others are kept from moving, the diagonal of `stiffness`; shape (*cases, 5), SI.

        How fast a channel's load grows with its own displacement; NaN where a case is not solved.
        """
        return np.diagonal(self.stiffness, axis1=-2, axis2=-1)

    @property
    def effective_stiffness(self) -> NDArray:
        """Of each free channel while the other free ones keep their loads; shape (*cases, 5), SI.

        The reciprocal of the diagonal of `compliance`: what two solves with neighbouring loads show, at most the locked
        stiffness of a bearing at rest. NaN where `compliance` is: for channels whose displacement is prescribed, where
        a case is not solved, and where nothing resists some free direction.
        """
        return 1.0 / np.diagonal(self.compliance, axis1=-2, axis2=-1)

    @property
    def preload_state(self) -> Any:
        """maintained, reduced, lost or excessive; shape (*cases), of a set (*cases, row); empty where not solved and
        where no preload is given; None where nothing preloads.

        Lost and reduced: in operation, external loads included, below 1 % and below half of what is given. Excessive:
        without external loads above three times it.
        """
        return None if self.preload_loads is None else preload_state.states(self.preload_loads)[()]

    @property
    def preload_share(self) -> Any:
        """What of the given preload is there in operation without external loads [-]; shape (*cases), of a set
        (*cases, row); NaN where none is given; None without preload."""
        return None if self.preload_loads is None else preload_state.share(self.preload_loads)[()]


def may_solve_alike(solution: SolutionOfCases) -> bool:
    """Whether another scene or set may be solved as this one was; not so of a row of a set, which is solved with it."""
    return solution._solve_alike is not None


def solve_alike(solution: Any, of: Any) -> Any:
    """Another scene or set with the threads, and of a set the tolerance, of this solution."""
    return solution._solve_alike(of)
