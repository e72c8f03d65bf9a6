"""Case records, solved: directly, and by the fallback where that finds nothing; plain or compiled.

A plain solve gets fewer iterations. One that takes them all is solved again, from where it was, with more of them or
compiled: what is found, iterations included, is what the compiled kernel finds at once.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from qsbearing.model.compiler import compiled
from qsbearing.model.kernel.solve_case import BUDGET, UNFINISHED, solve_cases
from qsbearing.model.kernel.workspace import working_memory

PLAIN_BUDGET = 60
"""Iterations of a plain solve where the kernel may lie compiled: they take no less than loading it."""
PATIENT_BUDGET = 400
"""Where it does not: they take less than compiling it."""


def solve_records(
    cases: NDArray, balls: int, own: NDArray, tolerance: float, is_warm: bool, found: tuple[NDArray, NDArray, NDArray],
    *, in_lanes: bool = False, by_fallback: bool = True,
) -> None:  # fmt: skip
    """Solve case records, in place.

    Args:
        balls: length of the ball axis.
        own: of unequal balls, (case, ball); empty where there are none.
        found: results, positions and controls, which hold the start if is_warm.
        in_lanes: whether there are many, from no start.
        by_fallback: False: what is not solved directly is left UNFINISHED.
    """
    given = (cases, *working_memory(balls), own, tolerance)
    if in_lanes:
        from qsbearing.model.kernel.lanes import solve_batch

        unfinished = solve_batch(*given, BUDGET, is_warm, *found)
    else:
        unfinished = _solve(solve_cases, given, is_warm, found)
    if unfinished and by_fallback:
        from qsbearing.model.kernel.fallback import solve_unfinished  # compiled only when a case first needs it

        which = np.flatnonzero(found[0]["status"] == UNFINISHED)
        with compiled.cases(which.size):
            _solve(solve_unfinished, (which, *given), is_warm, found, found[0]["iterations"].copy())


def _solve(
    entry: Any, given: tuple[Any, ...], is_warm: bool, found: tuple[NDArray, ...], earlier: NDArray | None = None
) -> Any:
    """What an entry returns, with as many iterations as the way in which it runs allows.

    Args:
        earlier: of the fallback, iterations that the results hold beside its own. It takes hundreds of them, and so is
            loaded at once where it lies compiled.
    """
    args = (*given, BUDGET, is_warm, *found)
    if not entry.runs_plain(args) or (earlier is not None and entry.load(args)):
        return entry(*args)
    start = [array.copy() for array in found]
    budgets = (PLAIN_BUDGET, PATIENT_BUDGET) if earlier is None else (PATIENT_BUDGET,)
    for budget in budgets if compiled.can_compile() else ():
        with suppress(ArithmeticError, ValueError):  # compiled, a number that is none raises nothing
            left = entry.plain(*given, budget, is_warm, *found)
            if (found[0]["iterations"] - (0 if earlier is None else earlier) < budget).all():
                return left
        for array, as_it_was in zip(found, start, strict=True):
            array[...] = as_it_was
        if entry.load(args):
            break
    return entry(*args) if entry.use_compiled(args) else entry.plain(*args)
