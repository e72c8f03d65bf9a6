"""A stretch of cases by the compiled Newton's method on shaft, rows and balls together; most need nothing else."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.shaft import SHAFT, Shafts, shaft_system
from qsbearing.model.kernel.solve_sets import solve_set_cases
from qsbearing.model.kernel.workspace import BALL, WORKSPACE
from qsbearing.systems.sets.equilibrium import Stretch
from qsbearing.systems.sets.row_cases import Found


def solve_directly(s: Stretch, cases: NDArray, own: NDArray, matrices: NDArray, offsets: NDArray, found: Found) -> None:
    """Solve all cases of a stretch that this method solves; they are marked as solved there.

    Args:
        cases: case records of all rows, (row, case); own, matrices, offsets and found likewise: what the stretch holds
            row by row, offsets counting from where the row touches in operation.
    """
    rows, _, balls = found.controls.shape
    shafts = Shafts(s.load, s.held, s.scale(), s.elasticity, s.rigid, s.place.copy(), np.zeros(s.count, SHAFT))
    # Of displacements that are prescribed, the kernel looks at which ones vanish.
    moving = ~s.held | (s.place != 0.0)
    cases["prescribed"] = ((matrices != 0.0) & moving[:, None, :]).any(axis=-1)
    memory = np.zeros(rows, WORKSPACE), np.zeros((rows, balls), BALL)
    solve_set_cases(cases, *memory, own, matrices, offsets, shafts, shaft_system(s.unknowns), s.tolerance, *found)
    which = shafts.found["solved"]
    s.solved[:] = which
    s.q[which], s.residual[which] = shafts.q[which], shafts.found["residual"][which]
    s.iterations[:] = shafts.found["iterations"]
