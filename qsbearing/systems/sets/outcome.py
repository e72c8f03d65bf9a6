"""How the cases of a set ended, and where."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass
class Outcome:
    """How the flattened cases ended."""

    q: NDArray
    """The shaft's five channels, the slide of the sprung rings and what is elastic; shape (case, unknown) [m, rad]."""
    status: NDArray
    residual: NDArray
    iterations: NDArray
    fault: NDArray
    """The row that gave way; -1: none."""
    unsupported: NDArray
    """Which unknowns nothing resists although they are loaded; shape (case, unknown)."""
    reached: NDArray
    """The part of loads and speeds up to which an equilibrium was followed."""
    axial: NDArray
    """Load of each row in the direction that it carries; shape (row, case) [N]."""

    @classmethod
    def of(cls, count: int, rows: int, unknowns: int) -> Outcome:
        """Of so many cases of so many unknowns, not solved yet."""
        numbers = np.zeros(count, np.int32), np.full(count, -1, np.int16)
        return cls(
            np.zeros((count, unknowns)), np.zeros(count, np.int8), np.zeros(count), *numbers,
            np.zeros((count, unknowns), bool), np.ones(count), np.zeros((rows, count)),
        )  # fmt: skip
