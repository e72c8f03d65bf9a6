"""Newton's method on shaft, rows and balls together: what `newton` does for one ring, for the rows of a set."""

from __future__ import annotations

from math import inf

from numpy import ndarray

from qsbearing.model.compiler.compiled import kernel
from qsbearing.model.kernel.assembly import close_loops, has_closure_residual, set_at_rest
from qsbearing.model.kernel.newton import (
    CLOSINGS,
    MOST_ITERATIONS,
    NEAR,
    NEARLY,
    OPEN_ITERATIONS,
    SOLVED,
    UNSOLVED,
    verdict,
)
from qsbearing.model.kernel.newton_step import is_far, take_step
from qsbearing.model.kernel.shaft import Shafts, ShaftSystem, assemble_rows, move_rows, propose_shaft_step

# A step is halved so often at most.
MOST_HALVINGS = 20


@kernel
def close_rows(cases: ndarray, works: ndarray, balls: ndarray, k: int) -> None:
    """Close every ball's loop."""
    for r in range(cases.shape[0]):
        close_loops(cases[r, k], works[r], balls[r])


@kernel
def any_open(works: ndarray, balls: ndarray) -> bool:
    """Whether the last assembly found some loop open."""
    for r in range(works.size):
        if has_closure_residual(works[r], balls[r]):
            return True
    return False


@kernel
def shaft_newton(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, shafts: Shafts, system: ShaftSystem,
    k: int, tolerance: float,
) -> bool:  # fmt: skip
    """Iterate in place from where shaft, rows and balls are; whether it converged. The rules are those of `newton`."""
    shaft = shafts.found[k]
    iterations, closings, before, is_last, is_closed = 0, 0, -1.0, False, False
    while True:
        residual, own_residual = assemble_rows(cases, works, balls, matrices, shafts, system, k)
        shaft.residual = residual if residual < inf else 1.0
        if not residual < inf:
            return False
        convergence = verdict(residual, own_residual, before, is_last, tolerance)
        if convergence != UNSOLVED and not is_closed and any_open(works, balls):
            close_rows(cases, works, balls, k)
            closings += 1
            before, is_last, is_closed = -1.0, closings > CLOSINGS, True
            continue
        if convergence == SOLVED:
            return True
        if convergence == UNSOLVED and iterations >= MOST_ITERATIONS:
            return False
        is_last = convergence == NEARLY
        fraction = propose_shaft_step(cases, works, balls, matrices, shafts, system, k)
        if fraction < 0.0:
            return False
        before, is_closed = residual, False
        for j in range(shafts.q.shape[1]):
            shafts.q[k, j] += fraction * system.step[j]
        for r in range(cases.shape[0]):
            take_step(cases[r, k], works[r], balls[r], fraction, iterations < OPEN_ITERATIONS, residual < NEAR)
            if is_far(works[r]):
                return False
        iterations += 1
        shaft.iterations += 1


@kernel
def shaft_descent(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, offsets: ndarray, shafts: Shafts,
    system: ShaftSystem, k: int,
) -> None:  # fmt: skip
    """From the shaft's displacement to near an equilibrium at rest, across gaps where nothing resists.

    Loops are held closed, and each step is halved until the imbalance falls or still points back, R . step <= 0: the
    energy, which is convex, has then fallen all along. Across a gap R is the load, and just beyond larger.
    """
    shaft = shafts.found[k]
    unknowns = shafts.q.shape[1]
    before, fraction, halvings, iterations = inf, 0.0, 0, 0
    while True:
        move_rows(cases, works, matrices, offsets, shafts, k)
        for r in range(cases.shape[0]):
            set_at_rest(cases[r, k], works[r], balls[r])
        residual, _ = assemble_rows(cases, works, balls, matrices, shafts, system, k)
        slope = 0.0
        for a in range(shaft.count):
            slope += system.imbalance[a] * system.step[system.channel[a]]
        if not (fraction == 0.0 or residual < before or (slope <= 0.0 and residual < inf)):
            fraction, halvings = 0.5 * fraction, halvings + 1
            for j in range(unknowns):
                shafts.q[k, j] -= fraction * system.step[j]
            if halvings > MOST_HALVINGS:
                return
            continue
        if residual <= NEAR or iterations >= MOST_ITERATIONS:
            return
        fraction = propose_shaft_step(cases, works, balls, matrices, shafts, system, k)
        if fraction < 0.0:
            return
        before, halvings = residual, 0
        for j in range(unknowns):
            shafts.q[k, j] += fraction * system.step[j]
        iterations += 1
        shaft.iterations += 1
