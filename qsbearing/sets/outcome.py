"""How the cases of a set ended, and where."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from qsbearing.sets.rigid_shaft import UNKNOWNS


@dataclass
class Outcome:
    """How the flattened cases ended."""

    q: NDArray
    """The shaft's five channels and the slide of the sprung rings; shape (case, 6) [m, rad]."""
    status: NDArray
    residual: NDArray
    iterations: NDArray
    fault: NDArray
    """The row that gave way; -1: none."""
    unsupported: NDArray
    """Which unknowns nothing resists although they are loaded; shape (case, 6)."""
    reached: NDArray
    """The part of loads and speeds up to which an equilibrium was followed."""

    @classmethod
    def of(cls, count: int) -> Outcome:
        """Of so many cases, not solved yet."""
        numbers = np.zeros(count, np.int32), np.full(count, -1, np.int16)
        return cls(
            np.zeros((count, UNKNOWNS)), np.zeros(count, np.int8), np.zeros(count), *numbers,
            np.zeros((count, UNKNOWNS), bool), np.ones(count),
        )  # fmt: skip
