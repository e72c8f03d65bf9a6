"""The rows of a stretch of cases as the kernel solves them: each row's displacement prescribed, its load the answer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.admissibility import CONVERGED
from qsbearing.model.kernel.assembly import LEAST_LOAD
from qsbearing.model.kernel.case import RESULT
from qsbearing.model.kernel.results import stiffness_of_cases
from qsbearing.model.kernel.solve_case import UNFINISHED
from qsbearing.model.kernel.workspace import working_memory
from qsbearing.model.solution.solve_records import solve_records


class RowStates(NamedTuple):
    """What the kernel finds of a row: case records of results, ball positions and controls, in the cases' units."""

    results: NDArray
    positions: NDArray
    controls: NDArray

    def part(self, which: Any) -> RowStates:
        """Of these cases alone: a copy where they are numbers, the same memory for a slice."""
        return RowStates(self.results[which], self.positions[which], self.controls[which])

    def put(self, which: NDArray, other: RowStates) -> None:
        """Replace these cases."""
        for mine, new in zip(self, other, strict=True):
            mine[which] = new


def empty(*shape: int, position_size: int = 3) -> RowStates:
    """Room for cases of so many balls, the last of the numbers; they hold no start."""
    *cases, balls = shape
    results = np.zeros(cases, RESULT)
    results["status"] = UNFINISHED
    return RowStates(results, np.empty((*cases, balls, position_size)), np.zeros((*cases, balls), np.int8))


@dataclass
class RowCases:
    """One row over a stretch of cases."""

    cases: NDArray
    matrix: NDArray
    """G, shape (case, 5, unknown)."""
    offset: NDArray
    """How far the row is pressed together while the shaft is at its zero; shape (case,) [m]."""
    datum_shift: NDArray
    """By how much further it touches than at rest and cold; shape (case,) [m]."""
    found: RowStates
    own: NDArray
    """Records (case, ball) of unequal balls."""

    @property
    def balls(self) -> int:
        """Length of the ball axis."""
        return int(self.found.controls.shape[1])

    def displacement(self, q: NDArray, which: NDArray) -> NDArray:
        """Of the inner ring in the row's own frame, from touching at rest and cold; shape (case, 5) [m, rad]."""
        moved = np.einsum("kij,kj->ki", self.matrix[which], q)
        moved[:, 0] += self.offset[which]
        return moved

    def prescribe(self, q: NDArray, which: NDArray) -> None:
        """Put the displacement into these case records."""
        moved = self.displacement(q, which)
        length = self.cases["length"][which]
        moved[:, 0] -= self.datum_shift[which]
        moved[:, :3] /= length[:, None]
        self.cases["prescribed"][which] = moved

    def solve(
        self, q: NDArray, which: NDArray, tolerance: float, speed_factor: NDArray, is_trial: bool
    ) -> tuple[RowStates, NDArray]:
        """These cases at this displacement of the shaft, from where they were: (what is found, which are solved)."""
        self.prescribe(q, which)
        cases, state = self.cases[which], self.found.part(which)
        for name in ("inner_speed", "outer_speed"):
            cases[name] *= speed_factor
        known = state.results["status"] == CONVERGED
        for is_warm in (True, False):
            some = np.flatnonzero(known == is_warm)
            if some.size:
                own = self.own[which][some]
                part = state.part(some)
                solve_records(cases[some], self.balls, own, tolerance, is_warm, part, by_fallback=not is_trial)
                state.put(some, part)
        return state, state.results["status"] == CONVERGED

    def least_load(self, which: NDArray) -> NDArray:
        """What is less is no load, but rounding of positions; shape (case,) [N]."""
        return np.asarray(LEAST_LOAD * self.cases["series_stiffness"][which] * self.cases["force"][which])

    def load(self, state: RowStates, which: NDArray) -> NDArray:
        """On the inner ring in the row's own frame; shape (case, 5) [N, N m]."""
        force, length = self.cases["force"][which], self.cases["length"][which]
        load = state.results["load"] * force[:, None]
        load[:, 3:] *= length[:, None]
        return np.asarray(load)

    def stiffness(self, which: NDArray, speed_factor: NDArray) -> NDArray:
        """dF/du where these cases were solved; shape (case, 5, 5), SI."""
        cases = self.cases[which]
        for name in ("inner_speed", "outer_speed"):
            cases[name] *= speed_factor
        out = np.empty((which.size, 5, 5))
        stiffness_of_cases(cases, *working_memory(self.balls), *self.found.part(which), self.own[which], out)
        return out
