"""Cases of a set, directly: Newton's method from the set as mounted, and the admissibility of what it finds.

What does not end in a sound equilibrium is left to `qsbearing.systems.sets`, which goes by way of each row's own solve.
"""

from __future__ import annotations

import numpy as np
from numpy import ndarray, recarray

from qsbearing.model.compiler.compiled import entry, kernel
from qsbearing.model.compiler.kinds import array_of
from qsbearing.model.effects.raceway_control import OUTER, PER_BALL
from qsbearing.model.kernel.admissibility import (
    CONVERGED,
    NO_FORCE,
    any_demands_friction,
    contradicted_controls,
    inadmissibility,
)
from qsbearing.model.kernel.assembly import set_at_rest
from qsbearing.model.kernel.ball_inertia import is_moving
from qsbearing.model.kernel.case import CASE, OWN_BALL, RESULT
from qsbearing.model.kernel.initial_guess import split_contacts, thrust_at_rest
from qsbearing.model.kernel.newton_step import is_far
from qsbearing.model.kernel.ring import couple_channels
from qsbearing.model.kernel.shaft import SHAFT_SYSTEM, SHAFTS, Shafts, ShaftSystem, move_rows
from qsbearing.model.kernel.shaft_newton import shaft_descent, shaft_newton
from qsbearing.model.kernel.solve_case import UNFINISHED, deliver_positions, prepare, set_controls
from qsbearing.model.kernel.workspace import BALL, WORKSPACE


@kernel
def prepare_row(
    case: recarray, work: recarray, balls: ndarray, own: ndarray, result: recarray, position: ndarray, control: ndarray
) -> None:
    """Choose balls and channels of a row; its case prescribes displacements, of which only counts which ones vanish.

    The balls' forces are its load, which the shaft takes.
    """
    prepare(case, work, balls, own, False, result, position, control)
    work.load_factor = 0.0
    work.channel_count = 0
    for i in range(5):
        if work.in_plane[i] != 0.0:
            work.channel[work.channel_count] = i
            work.channel_count += 1
    couple_channels(case, work, balls)


@kernel
def count_carrying(cases: ndarray, matrices: ndarray, k: int, load: float) -> int:
    """Rows that carry an axial load of this sign in their own direction."""
    carrying = 0
    for r in range(cases.shape[0]):
        if matrices[r, k, 0, 0] * load > 0.0:
            carrying += 1
    return carrying


@kernel
def guess_shaft(cases: ndarray, offsets: ndarray, matrices: ndarray, shafts: Shafts, k: int) -> None:
    """First axial displacement of the shaft, unless it is held: at least so far that the rows that carry its load could
    carry it alone."""
    load = shafts.load[k, 0]
    if shafts.held[k, 0] or load == 0.0:
        return
    side = 1.0  # of rows whose grooves carry both ways the other one, where none carries in the load's direction
    carrying = count_carrying(cases, matrices, k, load)
    if carrying == 0:
        side = -1.0
        for r in range(cases.shape[0]):
            carrying += 0 if cases[r, k].one_sided or matrices[r, k, 0, 0] == 0.0 else 1
    if carrying == 0:
        return
    least = 1.0
    for r in range(cases.shape[0]):
        if matrices[r, k, 0, 0] * load * side > 0.0 and (side > 0.0 or not cases[r, k].one_sided):
            case = cases[r, k]
            alone = thrust_at_rest(case, side * abs(load) / (carrying * case.force)) * case.length
            least = min(least, side * (alone - offsets[r, k]))
    if least > 0.0:
        shafts.q[k, 0] = least if load > 0.0 else -least


@kernel
def settle_friction_and_controls(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, shafts: Shafts, system: ShaftSystem,
    k: int, tolerance: float,
) -> bool:  # fmt: skip
    """From an equilibrium to one with the cases' own friction bounds and the controls that Jones's criterion calls
    for; False where there is no such near it."""
    is_slipping = False
    for r in range(cases.shape[0]):
        case, work = cases[r, k], works[r]
        is_slipping |= any_demands_friction(case, work, balls[r], case.friction_coefficient, NO_FORCE)
        work.friction_bound = case.friction_coefficient
    if is_slipping and not shaft_newton(cases, works, balls, matrices, shafts, system, k, tolerance):
        return False
    while cases[0, k].control == PER_BALL:
        wrong, changed = 0, 0
        for r in range(cases.shape[0]):
            of_row, changed_of_row = contradicted_controls(cases[r, k], works[r], balls[r])
            wrong, changed = wrong + of_row, changed + changed_of_row
        if wrong == 0:
            break
        if changed == 0 or not shaft_newton(cases, works, balls, matrices, shafts, system, k, tolerance):
            return False
    return True


@kernel
def solve_set_case(
    cases: ndarray, works: ndarray, balls: ndarray, matrices: ndarray, offsets: ndarray, shafts: Shafts,
    system: ShaftSystem, k: int, tolerance: float,
) -> bool:  # fmt: skip
    """One case, rows prepared; whether a sound equilibrium was found.

    At speed balls start where they lie at rest at the first displacement of the shaft: the equilibrium at rest under
    the load is no better start (random sets: two iterations more, none solved that was not).
    """
    shaft = shafts.found[k]
    shaft.count = 0
    for j in range(shafts.q.shape[1]):
        if not shafts.held[k, j]:
            system.channel[shaft.count] = j
            shaft.count += 1
    guess_shaft(cases, offsets, matrices, shafts, k)
    for j in range(shafts.q.shape[1]):
        system.start[j] = shafts.q[k, j]
    moves = is_moving(cases[0, k])
    converged, descends = False, shaft.is_loose
    while True:
        if descends:
            shaft_descent(cases, works, balls, matrices, offsets, shafts, system, k)
        move_rows(cases, works, matrices, offsets, shafts, k)
        for r in range(cases.shape[0]):
            set_at_rest(cases[r, k], works[r], balls[r])
        converged = moves or shaft_newton(cases, works, balls, matrices, shafts, system, k, tolerance)
        if converged or descends:
            break
        descends = True
        for j in range(shafts.q.shape[1]):
            shafts.q[k, j] = system.start[j]
    for r in range(cases.shape[0]):
        if is_far(works[r]):
            return False
        split_contacts(cases[r, k], works[r], balls[r])
        set_controls(cases[r, k], works[r], balls[r], OUTER)
    if moves:
        converged = shaft_newton(cases, works, balls, matrices, shafts, system, k, tolerance)
    if not converged:
        return False
    if moves and not settle_friction_and_controls(cases, works, balls, matrices, shafts, system, k, tolerance):
        return False
    for r in range(cases.shape[0]):
        if inadmissibility(cases[r, k], works[r], balls[r]) != 0:
            return False
    return True


@kernel
def deliver_row(
    case: recarray, work: recarray, balls: ndarray, result: recarray, position: ndarray, control: ndarray
) -> None:
    """Write the positions of ring and balls, and the load, which the last assembly has left in the workspace."""
    deliver_positions(case, work, balls, result, position, control)
    for i in range(5):
        result.load[i] = 0.0
    for p in range(work.channel_count):
        result.load[work.channel[p]] = work.imbalance[p]


@entry(
    array_of(CASE, 2), array_of(WORKSPACE), array_of(BALL, 2), array_of(OWN_BALL, 3), array_of(float, 4),
    array_of(float, 2), SHAFTS, SHAFT_SYSTEM, float, array_of(RESULT, 2), array_of(float, 4), array_of(np.int8, 3),
)  # fmt: skip
def solve_set_cases(
    cases: ndarray,
    works: ndarray,
    balls: ndarray,
    own: ndarray,
    matrices: ndarray,
    offsets: ndarray,
    shafts: Shafts,
    system: ShaftSystem,
    tolerance: float,
    results: ndarray,
    positions: ndarray,
    controls: ndarray,
) -> None:
    """Solve cases of a set one by one; what is not solved is left unfinished.

    Args:
        cases: of shape (row, case), displacements prescribed throughout: of their values only zeros count, which say
            what vanishes by symmetry.
        works, balls: working memory, (row) and (row, ball).
        own: of unequal balls, (row, case, ball); empty where there are none.
        matrices: G, (row, case, 5, unknown); offsets: (row, case), SI.
        shafts, system: of the shafts.
        results, positions, controls: (row, case), (row, case, ball, 3), (row, case, ball): what is found, in the
            cases' units.
    """
    for k in range(cases.shape[1]):
        shaft = shafts.found[k]
        shaft.iterations = 0
        for r in range(cases.shape[0]):
            prepare_row(cases[r, k], works[r], balls[r], own[r, k], results[r, k], positions[r, k], controls[r, k])
        shaft.solved = solve_set_case(cases, works, balls, matrices, offsets, shafts, system, k, tolerance)
        for r in range(cases.shape[0]):
            result = results[r, k]
            result.iterations, result.residual, result.reached = shaft.iterations, shaft.residual, 1.0
            result.notes, result.status = 0, CONVERGED if shaft.solved else UNFINISHED
            if shaft.solved:
                deliver_row(cases[r, k], works[r], balls[r], result, positions[r, k], controls[r, k])
