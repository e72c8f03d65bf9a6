"""Case records, solved: directly, and by the fallback where that finds nothing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.kernel.solve_case import BUDGET, UNFINISHED, solve_cases
from qsbearing.model.kernel.workspace import working_memory


def solve_records(
    cases: NDArray, balls: int, own: NDArray, tolerance: float, is_warm: bool, states: tuple[NDArray, NDArray, NDArray],
    *, in_lanes: bool = False, by_fallback: bool = True,
) -> None:  # fmt: skip
    """Solve case records, in place.

    Args:
        balls: length of the ball axis.
        own: of unequal balls, (case, ball); empty where there are none.
        states: results, positions and controls, which hold the start if is_warm.
        in_lanes: whether there are many, from no start.
        by_fallback: False: what is not solved directly is left UNFINISHED.
    """
    given = (cases, *working_memory(balls), own, tolerance)
    if in_lanes:
        from qsbearing.model.kernel.lanes import solve_batch

        unfinished = solve_batch(*given, BUDGET, is_warm, *states)
    else:
        unfinished = solve_cases(*given, BUDGET, is_warm, *states)
    if unfinished and by_fallback:
        from qsbearing.model.kernel.fallback import solve_unfinished

        which = np.flatnonzero(states[0]["status"] == UNFINISHED)
        solve_unfinished(which, *given, BUDGET, is_warm, *states)
